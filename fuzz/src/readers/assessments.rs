//! Assessments of freight cars: regimes, limits, conditions, what is asked for, records of runs, and
//! assessments to compare with.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use report::assessment_files::{self, AssessmentFindings, NAMES};
use report::page::assessment::{self as page, Against};
use report::study_folder::StudyFolder;
use staging::Folder;
use study::assessment::conditions::{self, Condition};
use study::assessment::{Assessment, Request};
use study::car::limits::LimitSet;
use study::car::regime::Regime;
use study::car::speeds;
use study::case::CaseError;
use study::measures::Measures;
use study::records::{Record, Status};

use super::cases::refused;
use super::{ReadOutcome, Reader, in_file, in_folder};

/// Regimes.
pub const REGIMES: Reader = Reader {
    name: "regimes",
    about: "files of regimes, and the first run of a car in them",
    corpus: || texts(Regime::all().iter().map(|own| own.text.as_str())),
    dictionary: &[
        b"[track]",
        b"[set]",
        b"file = \"track.toml\"",
        b"segments = [{ tangent = \"1000 ft\" }]",
        b"[[track.irregularities]]",
        b"spectrum = \"fra_lateral\"",
        b"speeds = [\"10 mph\", \"20 mph\"]",
        b"range = [\"10 mph\", \"70 mph\"]",
        b"distance = \"600 ft\"",
        b"settle = \"0 ft\"",
        b"lading = \"empty\"",
        b"simulation.method = \"tr-bdf2\"",
        b"speed.value = \"1 mph\"",
        b"truck.condition = \"worn\"",
        b" km/h",
    ],
    read: regime,
};

/// Limits.
pub const LIMITS: Reader = Reader {
    name: "limits",
    about: "files of limits, and the regimes that they are set for",
    corpus: || texts(LimitSet::built_in().iter().map(|own| own.text.as_str())),
    dictionary: &[
        b"[[limits]]",
        b"at_most = 0.8",
        b"at_least = \"10 %\"",
        b"at_most = \"6 deg\"",
        b"at_most = \"0.8 g0\"",
        b"regimes = \"all\"",
        b"regimes = [\"twist_and_roll\"]",
        b"measure = \"body_roll_peak_to_peak\"",
        b"measure = \"axle_sum_l_over_v\"",
        b"remark = \"\"",
    ],
    read: limits,
};

/// Conditions.
pub const CONDITIONS: Reader = Reader {
    name: "conditions",
    about: "files of conditions, and the first run of a car in them",
    corpus: condition_corpus,
    dictionary: &[
        b"[conditions.worn]",
        b"[conditions.worn.set]",
        b"title = \"\"",
        b"set = {}",
        b"truck.condition = \"worn\"",
        b"front_truck.friction.column = 0.3",
        b"lading.kind = \"empty\"",
        b"track.support = { kind = \"rigid\" }",
    ],
    read: condition_file,
};

/// What is asked for.
pub const REQUESTS: Reader = Reader {
    name: "requests",
    about: "arguments of `wedgelab assess`, one a line",
    corpus: || texts(WANTED.into_iter()),
    dictionary: &[
        b"regime ",
        b"condition ",
        b"limits ",
        b"speed ",
        b"set ",
        b"10 mph..70 mph",
        b"..",
        b" km/h",
        b"twist_and_roll",
        b"fra_213_333",
        b"broken_control_coil",
        b"wheels.profile=",
        b"track.file=",
        b"lading.kind=empty",
    ],
    read: request,
};

/// Runs beside limits.
pub const ASSESSED_RUNS: Reader = Reader {
    name: "assessed_runs",
    about: "runs of an assessment with these measures: verdicts, tables, page, and what it says of itself",
    corpus: || texts(MEASURED.into_iter()),
    dictionary: &[
        b"complete",
        b"derailed",
        b"failed",
        b"stopped",
        b"refused",
        b"derailed=1",
        b"ledger_residual=1",
        b"end_distance=",
        b"=nan",
        b"=inf",
        b"=-1e308",
        b"=5e-324",
        b" # ",
    ],
    read: assessed,
};

/// Assessments to compare with.
pub const ASSESSMENTS: Reader = Reader {
    name: "assessments",
    about: "assessment.json of `--against`, beside an assessment on its page",
    corpus: assessment_corpus,
    dictionary: &[
        b"\"schema\": \"wedgelab.assessment/1\"",
        b"\"verdicts\": [",
        b"\"worst\": null",
        b"\"value\": 1e308",
        b"\"margin\": -1e308",
        b"null",
        b"{}",
        b"[]",
        b"\\u0000",
        b"\\ud800",
    ],
    read: assessment,
};

/// Arguments, one a line.
const WANTED: [&str; 4] = [
    "regime twist_and_roll\nspeed 20 mph..40 mph\ncondition new\ncondition worn\n",
    "regime hunting\nspeed 60 mph\nspeed 100 km/h\nlimits fra_213_333\n",
    "regime spiral\nset lading.kind=empty\nset wheels.creep=fastsim\n",
    "regime constant_curve\nset front_truck.friction.column=0.3\nset name=\"a car\"\n",
];

/// Most values of each argument.
const MOST_ASKED: usize = 3;

/// Runs, one a line: number, status, measures, and behind `#` the reason.
const MEASURED: [&str; 3] = [
    "0 complete body_roll_peak_to_peak=0.05 largest_l_over_v=0.6 ledger_residual=1e-4\n\
     1 complete body_roll_peak_to_peak=0.2 largest_l_over_v=0.9 ledger_residual=1e-4\n\
     2 stopped # it stopped\n3 refused # its values make no car\n",
    "0 derailed derailed=1 end_distance=120.5 body_roll_peak_to_peak=0.15 ledger_residual=1e-3 # left\n\
     1 failed ledger_residual=0.5\n2 complete\n3 complete least_wheel_load=0.05\n",
    "",
];

fn texts<'t>(all: impl Iterator<Item = &'t str>) -> Vec<Vec<u8>> {
    all.map(|text| text.as_bytes().to_vec()).collect()
}

fn request_with(regimes: &[String], conditions: &[String], limits: &str) -> Request {
    Request {
        car: PathBuf::from("car_tangent_loaded"),
        set: Vec::new(),
        regimes: regimes.to_vec(),
        speeds: Vec::new(),
        conditions: conditions.to_vec(),
        limits: limits.to_owned(),
        refine: false,
        frictions: Vec::new(),
    }
}

/// Makes the assessment, and the case of its last run.
fn asked(request: &Request) -> ReadOutcome {
    let assessment = match Assessment::new(request) {
        Ok(assessment) => assessment,
        Err(error) => return refused(&error),
    };
    let count = assessment.study.count();
    assert!(count > 0, "no runs: {}", assessment.car);
    let _ = assessment.without_limits();
    match assessment.study.case(count - 1) {
        Ok(_) => ReadOutcome::ACCEPTED,
        Err(error) => refused(&error),
    }
}

/// A file that is named on the command line; what is read of it is what its text says.
fn named<T: PartialEq>(
    file: &Path,
    read: impl Fn(&Path) -> Result<T, CaseError>,
    parse: impl Fn(&str, &str) -> Result<T, CaseError>,
) -> Option<ReadOutcome> {
    match read(file) {
        Ok(found) => {
            let text = std::fs::read_to_string(file).unwrap_or_default();
            let again = parse(&file.display().to_string(), &text);
            assert!(
                again.is_ok_and(|again| again == found),
                "another one: of its text"
            );
            None
        }
        Err(error) => Some(refused(&error)),
    }
}

fn regime(input: &[u8]) -> ReadOutcome {
    in_file("regime.toml", input, |file| {
        if let Some(refused) = named(file, Regime::read, Regime::parse) {
            return refused;
        }
        let speeds = Regime::read(file).map_or_else(|_| Vec::new(), |own| own.speeds);
        asked(&Request {
            speeds: speeds.into_iter().take(1).collect(),
            ..request_with(&[file.display().to_string()], &[], "aar_chapter_xi")
        })
    })
}

fn limits(input: &[u8]) -> ReadOutcome {
    in_file("limits.toml", input, |file| {
        let set = match LimitSet::named_or_read(&file.display().to_string()) {
            Ok(set) => set,
            Err(error) => return refused(&error),
        };
        for limit in &set.limits {
            // What a formula needs is one, whatever it is.
            if let Some(value) = limit.number(&|_| Some(1.0)) {
                assert!(value.is_finite(), "not finite: {}", limit.name);
                let margin = limit.margin(value, value);
                assert!(
                    margin == 0.0,
                    "a margin at the limit itself: {margin}, {}",
                    limit.name
                );
            }
            let _ = (limit.regimes_in_words(), limit.value_in_words());
        }
        ReadOutcome::ACCEPTED
    })
}

fn condition_corpus() -> Vec<Vec<u8>> {
    let own = "[conditions.ours]\ntitle = \"ours\"\n[conditions.ours.set]\ntruck.condition = \"new\"\n\
               [conditions.light]\ntitle = \"without its lading\"\nset = { lading = { kind = \"empty\" } }\n";
    texts([conditions::BUILT_IN, own].into_iter())
}

fn condition_file(input: &[u8]) -> ReadOutcome {
    in_file("conditions.toml", input, |file| {
        let names = [file.display().to_string()];
        let read = |_: &Path| Condition::chosen(&names, true);
        if let Some(refused) = named(file, read, conditions::parse) {
            return refused;
        }
        let speeds = speeds::parse(&["30 mph".to_owned()], 2).unwrap_or_default();
        asked(&Request {
            speeds,
            ..request_with(&["spiral".to_owned()], &names, "aar_chapter_xi")
        })
    })
}

fn request(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let values = |key: &str| -> Vec<String> {
        let lines = text.lines().filter_map(|line| line.split_once(' '));
        let own = lines.filter(|(own, _)| *own == key);
        // Each run of an assessment is a case that is read.
        own.map(|(_, value)| value.to_owned()).take(MOST_ASKED).collect()
    };
    let speeds = match speeds::parse(&values("speed"), 3) {
        Ok(speeds) => speeds,
        Err(error) => return refused(&error),
    };
    let rising = speeds.windows(2).all(|pair| pair[0].to_si() < pair[1].to_si());
    assert!(rising, "speeds in no order: {speeds:?}");
    let limits = values("limits").pop();
    let mut regimes = values("regime");
    if regimes.is_empty() {
        regimes.push("spiral".to_owned());
    }
    asked(&Request {
        set: values("set"),
        speeds,
        ..request_with(
            &regimes,
            &values("condition"),
            limits.as_deref().unwrap_or("aar_chapter_xi"),
        )
    })
}

/// An assessment of four runs.
static SMALL: LazyLock<Option<Assessment>> = LazyLock::new(|| {
    let regimes = ["twist_and_roll", "spiral"].map(str::to_owned);
    let conditions = ["as_given", "mu_0.25"].map(str::to_owned);
    let speeds = speeds::parse(&["30 mph".to_owned()], 2).ok()?;
    let request = request_with(&regimes, &conditions, "aar_chapter_xi");
    Assessment::new(&Request { speeds, ..request }).ok()
});

/// Returns the record of a line.
fn record(assessment: &Assessment, line: &str) -> Option<Record> {
    let (values, reason) = line.split_once('#').unwrap_or((line, ""));
    let mut words = values.split_whitespace();
    let number = words.next()?.parse().ok()?;
    let status = words.next()?;
    let status = Status::ALL.into_iter().find(|own| own.name() == status)?;
    let definitions = assessment.study.measures();
    let mut measures = vec![f64::NAN; definitions.len()];
    for (name, value) in words.filter_map(|word| word.split_once('=')) {
        let place = definitions.iter().position(|own| own.name == name);
        if let (Some(place), Ok(value)) = (place, value.parse()) {
            measures[place] = value;
        }
    }
    Some(Record {
        number,
        status,
        reason: reason.trim().to_owned(),
        measures: Measures(measures),
    })
}

/// Keeps the records of an input in a study's folder, and those that are missing without measures.
fn gathered(
    assessment: &Assessment,
    text: &str,
    folder: &Path,
) -> Result<(StudyFolder, AssessmentFindings), ReadOutcome> {
    let refused = |error| ReadOutcome::refused(&error);
    let study = StudyFolder::open(folder, &assessment.study).map_err(refused)?;
    for own in text.lines().take(100).filter_map(|line| record(assessment, line)) {
        study.keep(&own).map_err(refused)?;
    }
    for number in study.missing(0).map_err(refused)? {
        let none = record(assessment, &format!("{number} refused # missing"));
        if let Some(none) = none {
            study.keep(&none).map_err(refused)?;
        }
    }
    let findings = AssessmentFindings::gather(assessment, &study).map_err(refused)?;
    Ok((study, findings))
}

fn assessed(input: &[u8]) -> ReadOutcome {
    let (Ok(text), Some(assessment)) = (std::str::from_utf8(input), SMALL.as_ref()) else {
        return ReadOutcome::NO_TEXT;
    };
    in_folder(|path| {
        let (_study, findings) = match gathered(assessment, text, path) {
            Ok(found) => found,
            Err(refused) => return refused,
        };
        let counts: usize = findings.counts().iter().sum();
        assert!(
            counts == findings.verdicts.len(),
            "a verdict without a word: {counts}"
        );
        for own in &findings.verdicts {
            let told = own.worst.as_ref().is_some_and(|worst| worst.margin.is_nan());
            assert!(!told, "a margin that is no number: {}", own.word());
        }
        let Ok(page) = page::render(assessment, &findings, &[], None) else {
            return ReadOutcome::NO_TEXT;
        };
        let written = Folder::check(path, &NAMES, true)
            .and_then(|folder| assessment_files::write(assessment, &findings, &page, &folder));
        if let Err(error) = written {
            return ReadOutcome::refused(&error);
        }
        let finite = |worst: &&study::assessment::WorstSpeed| worst.value.is_finite();
        let worst = findings.verdicts.iter().filter_map(|own| own.worst.as_ref());
        let said = worst.filter(finite).count();
        match Against::read(path) {
            Ok(against) => assert!(against.others.len() == said, "others than were written: {said}"),
            Err(error) => super::refused_as_written(&error),
        }
        ReadOutcome::ACCEPTED
    })
}

/// The findings beside which assessments are shown.
static FINDINGS: LazyLock<Option<AssessmentFindings>> = LazyLock::new(|| {
    let folder = tempfile::tempdir().ok()?;
    gathered(SMALL.as_ref()?, MEASURED[0], folder.path())
        .ok()
        .map(|(_, found)| found)
});

fn assessment_corpus() -> Vec<Vec<u8>> {
    let written = |text: &str| {
        let (assessment, folder) = (SMALL.as_ref()?, tempfile::tempdir().ok()?);
        let (_, findings) = gathered(assessment, text, folder.path()).ok()?;
        let files = Folder::check(folder.path(), &NAMES, true).ok()?;
        assessment_files::write(assessment, &findings, "", &files).ok()?;
        std::fs::read(folder.path().join(NAMES[2])).ok()
    };
    MEASURED[..2].iter().filter_map(|text| written(text)).collect()
}

fn assessment(input: &[u8]) -> ReadOutcome {
    let (Some(assessment), Some(findings)) = (SMALL.as_ref(), FINDINGS.as_ref()) else {
        return ReadOutcome::NO_TEXT;
    };
    in_file(NAMES[2], input, |file| {
        let against = match Against::read(file.parent().unwrap_or(file)) {
            Ok(against) => against,
            Err(error) => return ReadOutcome::refused(&error),
        };
        let page = page::render(assessment, findings, &[], Some(&against)).unwrap_or_default();
        super::check_page(&page);
        ReadOutcome::ACCEPTED
    })
}
