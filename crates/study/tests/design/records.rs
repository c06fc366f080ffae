//! Records survive what happens to files.

use study::design::Study;
use study::measures::{Measures, of_wedges};
use study::models::CaseSource;
use study::records::{self, Record, Status};

use super::common::{HEAD, SHORT, study};

fn small() -> Study {
    study(&format!(
        "{HEAD}sampling = \"full_factorial\"\n{SHORT}[vary]\nfriction.column = [0.3, 0.4, 0.5]\n"
    ))
}

fn made_up(number: u64, reason: &str) -> Record {
    let mut measures = Measures(vec![f64::NAN; of_wedges().len()]);
    measures.0[3] = number as f64 / 7.0;
    Record {
        number,
        status: if reason.is_empty() {
            Status::Complete
        } else {
            Status::Stopped
        },
        reason: reason.to_owned(),
        measures,
    }
}

fn bytes(records: &[Record]) -> Vec<u8> {
    let mut bytes = Vec::new();
    for record in records {
        record.write(42, &mut bytes);
    }
    bytes
}

#[test]
fn input_whatever_is_cut_off_or_damaged_costs_its_record_only() {
    let all: Vec<Record> = (0..4)
        .map(|n| made_up(n, if n == 2 { "why: é" } else { "" }))
        .collect();
    let whole = bytes(&all);
    assert_eq!(records::read(42, &whole).records, all);
    let first = bytes(&all[..1]).len();
    for end in 0..whole.len() {
        let found = records::read(42, &whole[..end]);
        assert!(found.records.iter().zip(&all).all(|(found, own)| found == own));
        assert!(end < first || !found.records.is_empty());
    }
    // Written on after having been cut off, as a program does that goes on.
    for cut in 1..first {
        let mut torn = whole[..first - cut].to_vec();
        torn.extend(&whole[first..]);
        assert_eq!(records::read(42, &torn).records, all[1..], "cut by {cut}");
    }
    // A flipped bit anywhere.
    for place in 0..whole.len() {
        let mut damaged = whole.clone();
        damaged[place] ^= 0x10;
        let found = records::read(42, &damaged);
        let others = found.records.iter().all(|record| all.contains(record));
        assert!(
            others && found.records.len() >= 3 || found.foreign,
            "byte {place}"
        );
    }
}

#[test]
fn input_records_of_another_study_are_seen() {
    let found = records::read(43, &bytes(&[made_up(0, "")]));
    assert!(found.foreign && found.records.is_empty());
    assert_ne!(
        small().fingerprint(),
        study(&format!(
            "{HEAD}sampling = \"full_factorial\"\n{SHORT}[vary]\nfriction.column = [0.3, 0.4, 0.51]\n"
        ))
        .fingerprint()
    );
    assert_eq!(small().fingerprint(), small().fingerprint());
}

/// Parts computed apart are the same bytes as the whole, in any order.
#[test]
fn limits_parts_add_up_to_the_whole() {
    let study = small();
    let whole = records::run_all(&study, 0..study.count());
    let parts = [records::run_all(&study, 0..1), records::run_all(&study, 1..99)].concat();
    assert!(whole == parts && !whole.is_empty());
    let found = records::read(study.fingerprint(), &whole);
    assert_eq!(found.records.len(), 3);
    assert!(
        found
            .records
            .iter()
            .all(|record| record.status == Status::Complete)
    );
}

/// A study made again from its texts, as a worker elsewhere does it, is the same.
#[test]
fn limits_a_study_from_its_texts_is_the_same() {
    let study = small();
    let again = Study::of_source(study.source().clone()).unwrap();
    assert_eq!(again.fingerprint(), study.fingerprint());
    assert_eq!(again.overrides(2), study.overrides(2));
    // Also where there is no such case file.
    let mut elsewhere = study.source().clone();
    elsewhere.folder = "/nowhere".into();
    elsewhere.name = "/nowhere/some.toml".to_owned();
    let CaseSource::File { name, .. } = &mut elsewhere.case else {
        panic!("a wedge's case");
    };
    *name = format!("/nowhere/{name}");
    elsewhere.text = elsewhere
        .text
        .replace("cdrun_toe_out_0.2_psi_0.012", "some/case.toml");
    let again = Study::of_source(elsewhere).unwrap();
    assert_eq!(again.fingerprint(), study.fingerprint());
}

#[test]
fn input_variants_that_fail_are_records_with_reasons() {
    let study = study(&format!(
        "{HEAD}sampling = \"full_factorial\"\n{SHORT}[vary]\n\
         simulation.output_interval = [\"0.01 s\", \"0.015 s\"]\n\
         bolster.vertical = [\"0 in\", {{ shape = \"table\", points = [[\"0 s\", \"0 in\"], [\"0.01 \
         s\", \"0 in\"], [\"0.02 s\", \"0 in\"], [\"0.03 s\", \"0 in\"]] }}]\n\
         wedge.inertia = [[\"400 lb in^2\", \"200 lb in^2\", \"300 lb in^2\"], [\"1e-300 lb \
         in^2\", \"1e-300 lb in^2\", \"1e-300 lb in^2\"]]\n"
    ));
    let found = records::read(study.fingerprint(), &records::run_all(&study, 0..study.count()));
    assert_eq!(found.records.len(), 8);
    for record in &found.records {
        let wild = record.number % 2 == 1;
        assert_eq!(record.status == Status::Complete, !wild, "{record:?}");
        assert_eq!(record.reason.is_empty(), !wild);
    }
}

fn bytes_of(study: &Study, numbers: impl IntoIterator<Item = u64>) -> Vec<u8> {
    let mut bytes = Vec::new();
    for number in numbers {
        records::run(study, number).write(study.fingerprint(), &mut bytes);
    }
    bytes
}

/// Variants of several kinds, some of which are refused or stop.
fn mixed() -> Study {
    study(&format!(
        "{HEAD}sampling = \"full_factorial\"\n[vary]\nwedge.damping = [\"variable\", \"constant\"]\n\
         friction.law = [\"tanh\", \"bristle\"]\nsimulation.relative_tolerance = [1e-6, 1e-3]\n\
         friction.column = [0.3, 0.4]\nsimulation.output_interval = [\"0.01 s\", \"0.03 s\"]\n\
         simulation.duration = [\"0.02 s\", \"0.04 s\"]\n\
         wedge.inertia = [[\"400 lb in^2\", \"200 lb in^2\", \"300 lb in^2\"], [\"1e-300 lb \
         in^2\", \"1e-300 lb in^2\", \"1e-300 lb in^2\"]]\n"
    ))
}

#[test]
fn limits_variants_have_the_same_records_in_any_order() {
    let study = mixed();
    let bytes = records::run_all(&study, 0..study.count());
    assert!(bytes == bytes_of(&study, 0..study.count()));
    let backwards: Vec<u64> = (0..study.count()).rev().collect();
    assert!(records::run_all(&study, backwards.clone()) == bytes_of(&study, backwards));
    let found = records::read(study.fingerprint(), &bytes).records;
    assert_eq!(found.len() as u64, study.count());
    for status in [Status::Complete, Status::Refused, Status::Stopped] {
        assert!(found.iter().any(|record| record.status == status), "{status:?}");
    }
}

/// A variant whose energy ledger does not close to 1e-2 is a record of its own kind: with its reason, and
/// with its measures.
#[test]
fn energy_a_variant_whose_ledger_does_not_close_has_failed_and_keeps_its_measures() {
    let study = study(
        "case = \"vdrun_toe_0_psi_0.012\"\nsampling = \"full_factorial\"\naccuracy = \"engineering\"\n\
         [vary]\nsimulation.relative_tolerance = [1.5e-5, 1e-2]\n",
    );
    let records = [0, 1].map(|number| records::run(&study, number));
    assert_eq!(
        records.each_ref().map(|record| record.status),
        [Status::Complete, Status::Failed]
    );
    assert_eq!(Status::Failed.name(), "failed");
    let residual = of_wedges().get(&records[1].measures, "ledger_residual").unwrap();
    assert!(residual > 1e-2, "{residual}");
    assert!(
        records[1].reason.contains(&format!("{residual:.2e}")),
        "{}",
        records[1].reason
    );
    assert!(
        of_wedges()
            .get(&records[1].measures, "energy_per_cycle_side_frame")
            .is_some()
    );
    let bytes = records::run_all(&study, [0, 1]);
    assert_eq!(records::read(study.fingerprint(), &bytes).records, records);
}
