//! The page of the reproduction.

use quantity::System as Units;
use report::page::packed;
use report::view::run::{Detail, Recording};
use report::view::{View, kept};
use reproduction::claims::Claims;
use reproduction::page::{self, Contents};
use study::case::builtin;
use study::run::Run;

#[test]
fn issue_048_the_page_holds_its_data_script_and_style() {
    let set = ["simulation.duration=0.1 s".to_owned()];
    let case = builtin::case_with("cdrun_toe_0_psi_0", &set).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| ());
    let outcomes = [(case, result)];
    let recordings = outcomes
        .iter()
        .map(|outcome| Recording::of_wedge(outcome, Detail::Full));
    let view = View::new(Units::Us, recordings, []).to_json().unwrap();
    let page = page::render(&Contents {
        outcomes: &outcomes,
        beyond: &[],
        claims: &Claims::of(Vec::new()),
        sensitivity: None,
        comparison: None,
        truck: false,
        sections: &[],
        view: &view,
    });
    for part in [".wl-scrubber", "<div data-shown=\"cdrun_toe_0_psi_0\""] {
        assert!(page.contains(part), "{part}");
    }
    let data = kept::data_in(&page).unwrap();
    assert!(data.starts_with("{\"schema\":\"wedgelab.view/1\""));
    // What folds tables, the data, the viewer, and what unpacks both.
    assert_eq!(page.matches("<script").count(), 4);
    let (_, viewer) = page.split_once("id=\"wedgelab-viewer\">").unwrap();
    let viewer = packed::unpack(viewer.split_once('<').unwrap().0).unwrap();
    assert!(viewer.contains("three.js") && viewer.len() > 600_000);
    assert_eq!(outcomes[0].1.summary.units, Units::Us);
}
