//! Studies of half-trucks: the same document, other paths, measures by the numbers of the files.

use std::path::{Path, PathBuf};

use study::design::Study;
use study::models::AnyCase;
use study::records::{self, Record, Status};
use study::run::Run;

const STUDY: &str = "case = \"nucars_69_variable_toe_out\"\nsampling = \"full_factorial\"\n\
     [set]\nsimulation.duration = \"5 s\"\nsimulation.output_units = \"si\"\n\
     [vary]\nwedges.column_friction = [0.3, 0.45]\nhistory.3.factor = [0.5, 1.0]\n";

fn study(text: &str) -> Study {
    Study::parse("half.toml", text, Path::new("")).unwrap()
}

fn records(study: &Study) -> Vec<Record> {
    let bytes = records::run_all(study, 0..study.count());
    records::read(study.fingerprint(), &bytes).records
}

#[test]
fn analytic_every_measure_is_that_of_the_whole_run() {
    let study = study(STUDY);
    assert_eq!(study.count(), 4);
    let found = records(&study);
    let definitions = study.measures();
    for record in &found {
        assert_eq!((record.status, record.reason.as_str()), (Status::Complete, ""));
        let AnyCase::HalfTruck(case) = study.case(record.number).unwrap() else {
            panic!("a half-truck");
        };
        let summary = Run::new(&*case).unwrap().finish(|_| ()).summary;
        let get = |name: &str| definitions.get(&record.measures, name).unwrap();
        let mut total = 0.0;
        for (number, wedge) in &summary.wedges {
            let energy = wedge.energy_per_cycle.as_ref().unwrap().value;
            total += energy;
            assert_eq!(get(&format!("wedge_{number}_energy_per_cycle")), energy);
            let up = wedge.up.as_ref().unwrap().value;
            assert_eq!(get(&format!("wedge_{number}_mean_column_friction_up")), up);
            assert_eq!(get(&format!("wedge_{number}_jammed_share")), wedge.jammed);
        }
        assert_eq!(get("energy_per_cycle"), total);
        for (name, most) in &summary.largest_displacements {
            assert_eq!(get(&format!("largest_{name}")), most.value);
        }
        assert_eq!(get("ledger_residual"), summary.largest_relative_residual);
    }
    let energy = |number: usize| {
        definitions
            .get(&found[number].measures, "energy_per_cycle")
            .unwrap()
    };
    // More friction and more travel lose more.
    assert!(energy(1) > 1.5 * energy(0) && energy(3) > 1.2 * energy(1));
}

#[test]
fn reproducible_files_elsewhere_give_the_same_records() {
    let folder = tempfile::tempdir().unwrap();
    let data = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../nucars/data");
    for name in [
        "Bolst_wedge_sf_68_constant.sys",
        "bolst_displ_input3.inp",
        "sngl_trk_68.dat",
    ] {
        std::fs::copy(data.join(name), folder.path().join(name)).unwrap();
    }
    let run = "Bolst_wedge_sf_bolst-vert-displ_68_constant.run";
    std::fs::copy(data.join(run), folder.path().join("half.run")).unwrap();
    let text = "case = \"half.run\"\nsampling = \"list\"\n[set]\nsimulation.duration = \"0.5 s\"\n\
         [[variants]]\nwedges.coil_force = \"3000 lbf\"\n[[variants]]\nbody.1.mass = \"50000 kg\"\n";
    let here = Study::parse("half.toml", text, folder.path()).unwrap();
    let source = here.source().clone();
    drop(folder);
    let elsewhere = Study::of_source(source).unwrap();
    assert_eq!(here.fingerprint(), elsewhere.fingerprint());
    let (a, b) = (records(&here), records(&elsewhere));
    assert_eq!(a.len(), 2);
    assert!(a.iter().all(|record| record.status == Status::Complete), "{a:?}");
    assert_eq!(a, b);
}

#[test]
fn input_mistakes_are_shown_where_the_study_has_them() {
    for (from, to, expected, marked) in [
        (
            "wedges.column_friction = [0.3",
            "wedges.column_fricton = [0.3",
            "did you mean column_friction?",
            "",
        ),
        ("[0.3, 0.45]", "[0.3, -0.1]", "a number from zero on", "-0.1"),
        ("\"5 s\"", "\"5 kg\"", "a positive time", "5 kg"),
        (
            "nucars_69_variable_toe_out",
            "nucars_69_variable_toe",
            "there is neither a case file",
            "",
        ),
        (
            "sampling",
            "accuracy = \"engineering\"\nsampling",
            "a choice for case files",
            "",
        ),
        (
            "case = \"nucars_69_variable_toe_out\"",
            "case = \"missing.run\"",
            "missing.run",
            "",
        ),
    ] {
        let text = STUDY.replace(from, to);
        assert_ne!(text, STUDY);
        let error = Study::parse("half.toml", &text, Path::new("")).unwrap_err();
        let problem = &error.problems()[0];
        assert!(
            problem.message().contains(expected),
            "{to}: {}",
            problem.message()
        );
        assert_eq!(problem.source_name(), Some("half.toml"), "{to}");
        let found = problem.marked_text().unwrap_or_default();
        assert!(found.contains(marked), "{to}: marked {found}");
    }
}
