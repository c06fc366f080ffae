//! Studies: their files, the folder's `study.json`, and records of runs; points of the sensitivity.

use std::path::Path;
use std::sync::LazyLock;

use report::study_folder::{STUDY_FILE, StudyFolder};
use reproduction::claims::{ClaimVerdict, claims};
use reproduction::sensitivity::{AXES, POINTS_FILE, PointOutcome, PointPlace, PointsFile, Space};
use study::design::{Study, Value};
use study::measures::{Measures, of_wedges};
use study::probability::Plan;
use study::records::{self, Record, Status};
use study::route::Route;

use super::cases::{messages, refused};
use super::{ReadOutcome, Reader, corpus, nowhere, refused_as_written};

/// Study files.
pub const STUDIES: Reader = Reader {
    name: "studies",
    about: "study files, and the values of their variants",
    corpus: corpus!("studies": "factorial.toml", "hypercube.toml", "list.toml", "sobol.toml"),
    dictionary: &[
        b"[vary]",
        b"[set]",
        b"[[variants]]",
        b"sampling = \"full_factorial\"",
        b"sampling = \"latin_hypercube\"",
        b"sampling = \"sobol\"",
        b"sampling = \"list\"",
        b"runs = 4503599627370496",
        b"seed = 7",
        b"accuracy = \"engineering\"",
        b"case = \"cdrun_toe_out_0.2_psi_0.012\"",
        b"{ from = 0.2, to = 0.6, count = 5 }",
        b"{ from = \"1e5 lbf/in\", to = \"1e6 lbf/in\", count = 3, scale = \"logarithmic\" }",
        b", also = [\"friction.slope\"]",
        b"side_frame.toe = ",
        b"wedge.angle = ",
        b"count = 4503599627370496",
    ],
    read: study_file,
};

/// Route files.
pub const ROUTES: Reader = Reader {
    name: "routes",
    about: "route files, and the cases of their runs",
    corpus: corpus!("routes": "two_tracks.toml"),
    dictionary: &[
        b"[tracks.curve]",
        b"[tracks.curve.set]",
        b"[seasons.dry]",
        b"[wedges]",
        b"share = 1",
        b"miles = 1e9",
        b"kilometers = 1",
        b"steps = 1000",
        b"wheels = \"each\"",
        b"coefficient = 1e-4",
        b"hardness = \"2450 MPa\"",
        b"case = \"car_tangent_empty\"",
        b"track.segments = [{ tangent = \"600 ft\" }]",
    ],
    read: route_file,
};

/// Plans of probabilities.
pub const PLANS: Reader = Reader {
    name: "plans",
    about: "plans of probabilities, and the cases of their runs",
    corpus: corpus!("plans": "rule.toml", "subset.toml"),
    dictionary: &[
        b"[uncertain]",
        b"[set]",
        b"method = \"monte_carlo\"",
        b"method = \"sobol\"",
        b"method = \"subset\"",
        b"level_probability = 0.25",
        b"distribution = \"uniform\"",
        b"distribution = \"normal\"",
        b"distribution = \"lognormal\"",
        b"deviation = 1e-300",
        b"factor = 1.0000000000000002",
        b"from = -1e308",
        b"to = 1e308",
        b"weights = [0, 1e308]",
        b"mark = \"guess\"",
        b"limit = \"aar_chapter_xi.body_roll\"",
        b"at_least = 0",
        b"indices = 1000000",
    ],
    read: plan_file,
};

/// The description in a study's folder.
pub const MANIFESTS: Reader = Reader {
    name: "manifests",
    about: "study.json in the folder of a study",
    corpus: || vec![manifest()],
    dictionary: &[
        b"\"version\":",
        b"\"runs\":",
        b"\"factors\":",
        b"\"case\":",
        b"null",
        b"1e999",
        b"\\u0000",
        b"\\ud800",
    ],
    read: manifest_file,
};

/// Records of runs.
pub const RECORDS: Reader = Reader {
    name: "records",
    about: "records of a study's runs, and bodies of records",
    corpus: record_corpus,
    dictionary: &[
        b"WLR2",
        b"WLR2\xff\xff\xff\xff",
        b"WLR2\x00\x10\x00\x00\x00\x00\x00\x00",
        b"\xff\xff\xff\xff",
        b"\x00\x00\x00\x00",
    ],
    read: record_bytes,
};

/// Points of `reproduce --sensitivity`.
pub const POINTS: Reader = Reader {
    name: "points",
    about: "points of the space of what the thesis leaves open",
    corpus: point_corpus,
    dictionary: &[
        b"\"point\":\"space 3\"",
        b"\"point\":\"friction 2 18446744073709551615\"",
        b"\"verdicts\":\"hnu\"",
        b"\"axes\":[true]",
        b"\"set\":[]",
        b"null",
        b"\n",
        b"\\ud800",
    ],
    read: points_file,
};

/// Some variants of a study, the first and the last among them.
fn some(count: u64) -> Vec<u64> {
    let mut numbers = vec![0, 1, count / 2, count - 1];
    numbers.retain(|number| *number < count);
    numbers.dedup();
    numbers
}

fn study_file(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let study = match Study::parse("study.toml", text, nowhere()) {
        Ok(study) => study,
        Err(error) => return refused(&error),
    };
    assert!(study.count() > 0, "no variants: {}", study.name);
    let mut outcome = ReadOutcome::ACCEPTED;
    for number in some(study.count()) {
        let values = study.values(number);
        assert!(
            values.len() == study.factors.len(),
            "a value missing: variant {number}"
        );
        if let Err(error) = study.case(number) {
            outcome = outcome.or(refused(&error));
        }
    }
    match Study::of_source(study.source().clone()) {
        Ok(again) => assert!(
            again.fingerprint() == study.fingerprint(),
            "another study: of its own source"
        ),
        Err(error) => refused_as_written(&messages(&error)),
    }
    outcome
}

fn route_file(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let route = match Route::parse("route.toml", text, nowhere()) {
        Ok(route) => route,
        Err(error) => return refused(&error),
    };
    let runs = route.runs();
    let shares: f64 = runs.iter().map(|own| own.share).sum();
    assert!((shares - 1.0).abs() < 1e-9, "shares that sum to {shares}");
    let mut outcome = ReadOutcome::ACCEPTED;
    for run in runs.iter().take(4) {
        if let Err(error) = route.case(run.of, &[]) {
            outcome = outcome.or(refused(&error));
        }
    }
    outcome
}

fn plan_file(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let plan = match Plan::parse("plan.toml", text, nowhere()) {
        Ok(plan) => plan,
        Err(error) => return refused(&error),
    };
    assert!(plan.most_runs() > 0, "no runs: {}", plan.name);
    let mut outcome = ReadOutcome::ACCEPTED;
    for u in [-8.0, -1.0, 0.0, 8.0] {
        let point = vec![u; plan.uncertain.len()];
        for value in plan.values(&point) {
            let finite = !matches!(value, Value::Number { value, .. } if !value.is_finite());
            assert!(finite, "no number at {u}: {}", plan.name);
        }
        if let Err(error) = plan.case(&point) {
            outcome = outcome.or(refused(&error));
        }
    }
    outcome
}

/// A study of a few variants.
static SMALL: LazyLock<Option<Study>> = LazyLock::new(|| {
    let text = include_str!("../../corpus/studies/factorial.toml");
    Study::parse("study.toml", text, nowhere()).ok()
});

/// Returns the manifest of its folder.
fn manifest() -> Vec<u8> {
    let description = SMALL.as_ref().map(Study::description);
    serde_json::to_vec_pretty(&description).unwrap_or_default()
}

fn manifest_file(input: &[u8]) -> ReadOutcome {
    let Some(study) = SMALL.as_ref() else {
        return ReadOutcome::NO_TEXT;
    };
    let Ok(folder) = tempfile::tempdir() else {
        return ReadOutcome::NO_TEXT;
    };
    let write = |path: &Path| std::fs::write(path.join(STUDY_FILE), input);
    if write(folder.path()).is_err() {
        return ReadOutcome::NO_TEXT;
    }
    match StudyFolder::open(folder.path(), study) {
        Ok(_) => ReadOutcome::ACCEPTED,
        Err(error) => ReadOutcome::refused(&error),
    }
}

/// Returns a folder with points, and what it holds with a few.
fn point_corpus() -> Vec<Vec<u8>> {
    let space = Space::default();
    let found = PointOutcome {
        verdicts: claims().map(|_| ClaimVerdict::Holds).collect(),
        axes: vec![true; AXES.len()],
        unsound: vec!["vdrun_toe_0_psi_0: it stopped".to_owned()],
    };
    let Ok(folder) = tempfile::tempdir() else {
        return Vec::new();
    };
    let kept = PointsFile::open(folder.path(), &space, false);
    let places = [
        PointPlace::Decided,
        PointPlace::Space(3),
        PointPlace::OtherFriction(1, 0),
    ];
    if let Ok(kept) = kept {
        for place in places {
            // A point that cannot be kept is missing in the corpus, no more.
            let _ = kept.keep(&space, place, &found);
        }
    }
    std::fs::read(folder.path().join(POINTS_FILE))
        .into_iter()
        .collect()
}

fn points_file(input: &[u8]) -> ReadOutcome {
    let space = Space::default();
    let Ok(folder) = tempfile::tempdir() else {
        return ReadOutcome::NO_TEXT;
    };
    let open = || PointsFile::open(folder.path(), &space, false);
    if open().is_err() || std::fs::write(folder.path().join(POINTS_FILE), input).is_err() {
        return ReadOutcome::NO_TEXT;
    }
    let places = space.places(16);
    let missing = match open() {
        Ok(kept) => kept.missing(&places),
        Err(error) => return ReadOutcome::refused(&error),
    };
    // One more is kept behind whatever is there, and found again with the others.
    let found = PointOutcome {
        verdicts: claims().map(|_| ClaimVerdict::DoesNot).collect(),
        axes: vec![false; AXES.len()],
        unsound: Vec::new(),
    };
    let Some(place) = missing.last() else {
        return ReadOutcome::ACCEPTED;
    };
    if open().is_ok_and(|kept| kept.keep(&space, *place, &found).is_ok())
        && let Ok(kept) = open()
    {
        assert!(
            kept.found(*place) == Some(&found),
            "another point: {}",
            place.key()
        );
        assert!(
            kept.missing(&places) == missing[..missing.len() - 1],
            "points were lost: {} of {}",
            missing.len(),
            places.len()
        );
    }
    ReadOutcome::ACCEPTED
}

const FINGERPRINT: u64 = 42;
/// The beginning of a record.
const MAGIC: &[u8] = b"WLR2";

fn record(number: u64, status: Status, reason: &str) -> Record {
    let mut measures = Measures(vec![f64::NAN; of_wedges().len()]);
    measures.0[3] = number as f64 / 7.0;
    Record {
        number,
        status,
        reason: reason.to_owned(),
        measures,
    }
}

fn record_corpus() -> Vec<Vec<u8>> {
    let all = [
        record(0, Status::Complete, ""),
        record(1, Status::Refused, "its values make no wedge: é"),
        record(u64::MAX, Status::Stopped, &"long ".repeat(200)),
    ];
    let written = |fingerprint: u64, records: &[Record]| {
        let mut bytes = Vec::new();
        records
            .iter()
            .for_each(|record| record.write(fingerprint, &mut bytes));
        bytes
    };
    vec![
        written(FINGERPRINT, &all[..1]),
        written(FINGERPRINT, &all),
        [
            written(FINGERPRINT, &all[1..]),
            written(7, &all),
            written(FINGERPRINT, &all),
        ]
        .concat(),
    ]
}

/// Returns a body as a record whose checksum is right.
fn framed(body: &[u8]) -> Vec<u8> {
    let mut framed = MAGIC.to_vec();
    framed.extend((body.len() as u32).to_le_bytes());
    framed.extend(crc32fast::hash(body).to_le_bytes());
    framed.extend(body);
    framed
}

fn record_bytes(input: &[u8]) -> ReadOutcome {
    let found = records::read(FINGERPRINT, input);
    assert!(found.lost <= input.len(), "too much lost: {}", found.lost);
    let mut bytes = Vec::new();
    for record in &found.records {
        record.write(FINGERPRINT, &mut bytes);
    }
    assert!(
        bytes.len() + found.lost <= input.len(),
        "more than there was: {} records",
        found.records.len()
    );
    let again = records::read(FINGERPRINT, &bytes);
    assert!(
        again.records == found.records && again.lost == 0,
        "other records: written and read again"
    );
    // As the body of a record whose checksum is right.
    let framed = records::read(FINGERPRINT, &framed(input));
    assert!(framed.records.len() <= 1 + found.records.len(), "records made up");
    ReadOutcome {
        accepted: !found.records.is_empty(),
        message: 0,
        attempts: 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn issue_048_framed_bodies_are_records() {
        let mut bytes = Vec::new();
        record(3, Status::Complete, "").write(FINGERPRINT, &mut bytes);
        assert!(bytes.starts_with(MAGIC));
        let body = &bytes[12..];
        assert!(!record_bytes(body).accepted, "a body alone is no record");
        assert_eq!(framed(body).len(), bytes.len());
        assert_eq!(framed(body), bytes);
    }
}
