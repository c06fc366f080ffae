//! analytic, limits, input: rails whose sections change along the track.

use std::fmt::Write as _;
use std::path::Path;

use car::Wheels;
use study::car::CarCase;
use study::case::Tables;
use study::run::Run;

use crate::problems::in_words;

/// A folder with a rail of one crown, the same lowered, a worn one, and a list of the first two.
fn folder(fall: f64) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let rail = |name: &str, crown: f64, fall: f64| {
        let mut text = "y [mm], z [mm]\n".to_owned();
        for i in -32..=32 {
            let y = f64::from(i);
            writeln!(text, "{y}, {:.6}", (crown * crown - y * y).sqrt() - crown - fall).unwrap();
        }
        std::fs::write(folder.path().join(name), text).unwrap();
    };
    rail("a.csv", 300.0, 0.0);
    rail("b.csv", 300.0, fall);
    rail("worn.csv", 900.0, 0.0);
    let list = "0 1000\n2\n0 0\n1\n0 'a.csv'\n 20.0 'b.csv'\n";
    std::fs::write(folder.path().join("rails.slcs"), list).unwrap();
    folder
}

fn case(lines: &str, folder: &Path) -> CarCase {
    let text = format!(
        "model = \"car\"\n{lines}\n[wheels]\nprofile = \"cone_1:20\"\n[track]\n\
         support = {{ kind = \"rigid\" }}\n\
         segments = [{{ tangent = \"80 m\" }}]\n"
    );
    CarCase::parse("case.toml", &text, folder, &[])
        .unwrap_or_else(|error| panic!("{}", in_words(error.problems())))
}

fn words_of(lines: &str, folder: &Path) -> String {
    let text = format!("model = \"car\"\n{lines}\n");
    in_words(
        CarCase::parse("case.toml", &text, folder, &[])
            .unwrap_err()
            .problems(),
    )
}

/// A car that coasts down a slope made of two sections gains the energy of its height.
#[test]
fn analytic_a_car_coasts_down_rails_that_fall() {
    let folder = folder(40.0);
    let lines = "speed = { kind = \"coasting\", value = \"10 m/s\" }\n[rails]\nprofile = \"rails.slcs\"\n\
                 slices_from = \"20 m\"\n[simulation]\nduration = \"4.5 s\"\n[start]\ndistance = \"9 m\"";
    let case = case(lines, folder.path());
    let result = Run::new(&case).unwrap().finish(|_| ());
    assert!(result.summary.complete, "{:?}", result.summary.stopped);
    let column = |name: &str| {
        let place = result.columns.iter().position(|own| own.name == name).unwrap();
        result.values[place].clone()
    };
    let (distance, speed) = (column("distance"), column("speed"));
    let last = speed.len() - 1;
    assert!(distance[last] > 52.0, "{}", distance[last]);
    let own = &case.parameters;
    let mass = own.weight() / own.gravity;
    let rolling = 4.0 * own.wheelset.about_axle / own.wheel_radius().powi(2);
    let gain = 2.0 * own.gravity * 0.040 * mass / (mass + rolling);
    let found = speed[last].powi(2) - speed[0].powi(2);
    assert!((found / gain - 1.0).abs() < 0.02, "{found} {gain}");
}

/// A rail that goes over into itself is that rail, to the bit; one that becomes another does something.
#[test]
fn limits_a_change_to_the_same_profile_is_none() {
    let folder = folder(1.0);
    let run = |over: &str| {
        let lines = format!(
            "[rails]\nprofile = \"a.csv\"\n{over}\n[simulation]\nduration = \"1 s\"\n\
             [speed]\nvalue = \"20 m/s\"\n\
             [start]\ndistance = \"9 m\"\naxle_shift = \"4 mm\""
        );
        Run::new(&case(&lines, folder.path())).unwrap().finish(|_| ())
    };
    let plain = run("");
    let same = run("over_distance = [{ from = \"20 m\", profile = \"a.csv\" }]");
    assert_eq!(plain.values, same.values);
    let other = run("over_distance = [{ from = \"20 m\", profile = \"worn.csv\" }]");
    assert!(other.summary.complete);
    assert_ne!(plain.values, other.values);
    assert!(
        other
            .summary
            .assumptions
            .iter()
            .any(|own| own.contains("left rail changes along the track")),
        "{:?}",
        other.summary.assumptions
    );
}

/// Each rail may change by itself; the case written and read again is the same, and its files go with it.
#[test]
fn input_lists_and_changes_are_read_written_and_packed() {
    let folder = folder(1.0);
    let lines = "[rails]\nprofile = \"a.csv\"\nchange_length = \"2 m\"\nover_distance = [{ from = \
                 \"200 ft\", profile = \"worn.csv\" }, { from = \"70 m\", profile = \"a.csv\" }]\n\
                 [rails.right]\nprofile = \
                 \"rails.slcs\"\nslices_from = \"50 m\"\n[simulation]\nduration = \"1 s\"";
    let case = case(lines, folder.path());
    let again = CarCase::parse("again.toml", case.to_toml_embedded(), folder.path(), &[]).unwrap();
    let (text, files) = case.packed();
    let other = tempfile::tempdir().unwrap();
    for file in &files {
        let path = other.path().join(&file.name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, file.content(std::fs::read(&file.path).unwrap())).unwrap();
    }
    assert_eq!(files.len(), 4, "{files:?}");
    let packed = CarCase::parse("packed.toml", &text, Tables::below(other.path()), &[]);
    let packed = packed.unwrap_or_else(|error| panic!("{}", in_words(error.problems())));
    for case in [&case, &again, &packed] {
        let Wheels::OnRails(own) = &case.parameters.wheels else {
            panic!("profiles are expected");
        };
        let places = own
            .rails_over
            .each_ref()
            .map(|own| own.as_ref().unwrap().places().to_vec());
        assert_eq!(places[0].len(), 4);
        for (own, expected) in places[0].iter().zip([60.96, 62.96, 70.0, 72.0]) {
            assert!((own - expected).abs() < 1e-9, "{own}");
        }
        assert_eq!(places[1], [50.0, 70.0]);
        let tops = own.rails_over[1]
            .as_ref()
            .unwrap()
            .profiles()
            .iter()
            .map(|own| own.top()[1]);
        let tops: Vec<f64> = tops.collect();
        assert!((tops[0] - tops[1] - 1e-3).abs() < 1e-9, "{tops:?}");
    }
}

#[test]
fn input_rails_that_change_wrongly_are_told() {
    let folder = folder(1.0);
    let one = |lines: &str| words_of(lines, folder.path());
    let over = "over_distance = [{ from = \"200 ft\", profile = \"worn.csv\" }]";
    for (lines, expected) in [
        (
            "[rails]\nover_distance = [{ from = \"200 ft\", profile = \"none.csv\" }]".to_owned(),
            "there is no file",
        ),
        (
            "[rails]\nover_distance = [{ from = \"200 ft\", profile = \"worn.csv\" }, \
             { from = \"201 ft\", profile = \"a.csv\" }]"
                .to_owned(),
            "places must rise, each by more than rails.change_length",
        ),
        (
            "[rails]\nover_distance = [{ from = \"20 ft\", profile = \"worn.csv\" }]".to_owned(),
            "or start earlier",
        ),
        (
            "[rails]\nover_distance = \"worn.csv\"".to_owned(),
            "tables are expected",
        ),
        (
            "[rails]\nover_distance = [{ form = \"20 ft\", profile = \"worn.csv\" }]".to_owned(),
            "from",
        ),
        ("[rails]\nprofile = \"rails.slcs\"".to_owned(), "slices_from"),
        (
            format!("[rails]\nprofile = \"rails.slcs\"\nslices_from = \"70 m\"\n{over}"),
            "write one of them",
        ),
        (
            format!("[rails]\n{over}\n[wheels]\ntables = true"),
            "leave out wheels.tables",
        ),
        (
            format!(
                "[rails]\n{over}\n[wheels]\ngeometry = \"linear\"\n[track]\nsupport = {{ kind = \
                 \"rigid\" }}"
            ),
            "linear wheels roll on rails that do not change",
        ),
        ("[rails]\nchange_length = \"0 m\"".to_owned(), "greater than zero"),
    ] {
        let words = one(&lines);
        assert!(words.contains(expected), "{lines}\n{words}");
    }
    std::fs::write(
        folder.path().join("bad.slcs"),
        "0 1000\n1\n0 0\n1\n0 'gone.csv'\n",
    )
    .unwrap();
    let words = one("[rails]\nprofile = \"bad.slcs\"");
    assert!(words.contains("gone.csv"), "{words}");
    let text = "model = \"car\"\n[rails]\nprofile = \"up.slcs\"\n";
    std::fs::write(folder.path().join("up.slcs"), "0 1000\n1\n0 0\n1\n0 '../a.csv'\n").unwrap();
    let below = CarCase::parse("case.toml", text, Tables::below(folder.path()), &[]).unwrap_err();
    let words = in_words(below.problems());
    assert!(words.contains("does not lie in the folder"), "{words}");
}
