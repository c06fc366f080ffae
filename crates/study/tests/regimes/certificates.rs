//! Limits, conditions and what a certificate makes of records.

use std::path::PathBuf;

use quantity::Quantity;
use study::car::limits::{Bound, LimitSet};
use study::certificate::conditions::{self, Condition};
use study::certificate::other_start::near;
use study::certificate::{Certificate, Request, verdicts, worst_run};
use study::measures::Measures;
use study::models::AnyCase;
use study::records::{Record, Status};

fn request(regimes: &[&str]) -> Request {
    Request {
        car: PathBuf::from("car_tangent_loaded"),
        set: Vec::new(),
        regimes: regimes.iter().map(|own| (*own).to_owned()).collect(),
        speeds: ["16 mph", "20 mph"]
            .map(|own| Quantity::parse(own).unwrap())
            .to_vec(),
        conditions: Vec::new(),
        limits: "aar_chapter_xi".to_owned(),
        refine: false,
    }
}

/// Returns a record of a run with these measures (SI) and zeros for the others.
fn record(certificate: &Certificate, number: u64, given: &[(&str, f64)]) -> Record {
    let definitions = certificate.study.measures();
    let mut values = vec![0.0; definitions.len()];
    for (name, value) in given {
        values[definitions.place(name).unwrap()] = *value;
    }
    Record {
        number,
        status: Status::Complete,
        reason: String::new(),
        measures: Measures(values),
    }
}

fn lowered(limit: &str) -> LimitSet {
    let text = format!(
        "title = \"ours\"\nsource = \"a letter\"\n[[limits]]\nname = \"roll\"\nquantity = \"body roll\"\n\
         measure = \"body_roll_peak_to_peak\"\nregimes = [\"twist_and_roll\"]\nat_most = \"{limit}\"\n"
    );
    LimitSet::parse("ours.toml", &text).unwrap()
}

#[test]
fn input_all_that_is_built_in_can_be_read() {
    let names: Vec<&str> = LimitSet::built_in().iter().map(|own| own.name.as_str()).collect();
    assert_eq!(names, ["aar_chapter_xi", "fra_213_333"]);
    let parsed = conditions::parse("conditions.toml", conditions::BUILT_IN).unwrap();
    assert_eq!(parsed.as_slice(), Condition::all());
    assert!(Condition::all()[0].set.is_empty());
    for name in [
        "new",
        "mu_0.25",
        "mu_0.5",
        "rise_0.25",
        "rise_0.5",
        "rise_0.75",
        "rise_1.0",
        "flat",
        "crown_60",
        "hollow_2mm",
        "hollow_4mm",
        "low_preload_side_bearing",
        "broken_control_coil",
        "missing_load_coil",
        "dry_center_plate",
        "greased_center_plate",
        "empty",
        "loaded",
        "lading_off_center",
        "massless_wedges",
        "shaken",
    ] {
        assert!(Condition::all().iter().any(|own| own.name == name), "{name}");
    }
    // The older name of a friction of 0.25.
    let named = |name: &str| Condition::chosen(&[name.to_owned()]).unwrap();
    assert_eq!(named("worn"), named("mu_0.25"));
    // All of them make cases of loaded and of empty cars.
    let request = Request {
        speeds: vec![Quantity::parse("30 mph").unwrap()],
        conditions: Condition::all().iter().map(|own| own.name.clone()).collect(),
        ..request(&["hunting", "twist_and_roll"])
    };
    let certificate = Certificate::new(&request).unwrap();
    assert_eq!(certificate.study.count(), 2 * Condition::all().len() as u64);
    for number in 0..certificate.study.count() {
        if let Err(error) = certificate.study.case(number) {
            panic!("{:?}: {:?}", certificate.study.values(number), error.problems());
        }
    }
}

/// Limits are for filtered values: where rows are too far apart for the filter there is no number, the limit
/// is neither kept nor exceeded, and the run says what to do.
#[test]
fn issue_048_raw_values_keep_no_limit() {
    let certificate = Certificate::new(&request(&["twist_and_roll"])).unwrap();
    let measured = |interval: &str, name: &str| {
        let settings = ["simulation.duration=\"2 s\"", "start.settle=\"0.5 s\"", interval];
        let case = AnyCase::built_in("car_twist_and_roll_loaded", &settings.map(str::to_owned));
        let measures = case.unwrap().unwrap().judge().unwrap().measures;
        certificate.study.measures().get(&measures, name)
    };
    let close = "simulation.output_interval=\"0.01 s\"";
    let far = "simulation.output_interval=\"0.5 s\"";
    assert!(measured(close, "least_load_time").is_some());
    assert_eq!(measured(far, "least_load_time"), None);
    assert!(measured(far, "body_roll_peak_to_peak").is_some());

    let record = record(&certificate, 0, &[("least_load_time", f64::NAN)]);
    let run = certificate.assess(&certificate.study.values(0), &record);
    let says = "no filtered value of least_wheel_load: rows are too far apart";
    assert!(run.note.starts_with(says), "{}", run.note);
    let found = verdicts(&[run]);
    let word = |name: &str| {
        let own = found
            .iter()
            .find(|own| certificate.limits.limits[own.limit].name == name);
        own.unwrap().word()
    };
    assert_eq!([word("least_wheel_load"), word("body_roll")], ["unknown", "kept"]);
}

/// A limit lowered by hand turns its row; margins are parts of the limit.
#[test]
fn analytic_margins_and_verdicts() {
    let mut certificate = Certificate::new(&request(&["twist_and_roll"])).unwrap();
    let rolls = [3.0_f64, 4.5];
    let assessed = |certificate: &Certificate| -> Vec<_> {
        (0..2)
            .map(|number| {
                let roll = ("body_roll_peak_to_peak", rolls[number as usize].to_radians());
                let record = record(certificate, number, &[roll, ("least_load_time", 40.0)]);
                certificate.assess(&certificate.study.values(number), &record)
            })
            .collect()
    };
    let runs = assessed(&certificate);
    assert_eq!(runs[1].speed, "20 mph");
    assert!((runs[1].speed_si - 8.9408).abs() < 1e-12);
    let found = verdicts(&runs);
    let of = |name: &str| {
        let limits = &certificate.limits.limits;
        let place = limits.iter().position(|own| own.name == name).unwrap();
        found.iter().find(|own| own.limit == place).unwrap()
    };
    let roll = of("body_roll");
    let worst = roll.worst.as_ref().unwrap();
    assert_eq!((worst.run, roll.word()), (1, "kept"));
    assert!((worst.value - 4.5).abs() < 1e-12 && (worst.margin - 0.25).abs() < 1e-12);
    // At least 10 %: 40 % is a third of the way from there to 100 %, where nothing is lost.
    let load = of("least_wheel_load").worst.as_ref().unwrap();
    assert!((load.margin - 1.0 / 3.0).abs() < 1e-12);
    assert_eq!(
        certificate.limits.limits[of("least_wheel_load").limit].bound,
        Bound::AtLeast
    );
    assert_eq!(worst_run(&runs, 0).unwrap().run, 1);

    certificate.limits = lowered("4 deg");
    let found = verdicts(&assessed(&certificate));
    assert_eq!(found[0].word(), "exceeded");
    assert!((found[0].worst.as_ref().unwrap().margin + 0.125).abs() < 1e-12);
    certificate.limits = lowered("5 deg");
    assert_eq!(verdicts(&assessed(&certificate))[0].word(), "kept");
}

/// A run within 15 % of a limit, kept or not, is computed from the other start, each once; both values stand
/// beside each other, and the verdict of the run stays its own.
#[test]
fn analytic_runs_near_a_limit_have_a_second_start() {
    let mut certificate = Certificate::new(&request(&["twist_and_roll"])).unwrap();
    let assessed = |certificate: &Certificate| {
        let roll = ("body_roll_peak_to_peak", 5.2_f64.to_radians());
        let runs = [0, 1].map(|number| {
            let own = if number == 0 { ("steps", 1.0) } else { roll };
            let record = record(certificate, number, &[own, ("least_load_time", 40.0)]);
            certificate.assess(&certificate.study.values(number), &record)
        });
        verdicts(&runs)
    };
    for (limit, wanted) in [
        ("6.2 deg", vec![]),
        ("6 deg", vec![1]),
        ("5 deg", vec![1]),
        ("4.5 deg", vec![]),
    ] {
        certificate.limits = lowered(limit);
        assert_eq!(near(&assessed(&certificate)), wanted, "{limit}");
    }
    certificate.limits = lowered("5.5 deg");
    let mut found = assessed(&certificate);
    let from_there = |roll: f64, status: Status| {
        let mut own = record(&certificate, 1, &[("body_roll_peak_to_peak", roll.to_radians())]);
        own.status = status;
        (1, ["equilibrium", "shaken"], own)
    };
    certificate.note(&mut found, &[]);
    assert_eq!(found[0].other_start, None);
    for (roll, status, verdict) in [
        (5.4, Status::Complete, "kept"),
        (5.6, Status::Complete, "exceeded"),
        (5.4, Status::Derailed, "exceeded"),
        (5.4, Status::Stopped, "unknown"),
    ] {
        certificate.note(&mut found, &[from_there(roll, status)]);
        let other = found[0].other_start.as_ref().unwrap();
        assert_eq!((other.verdict, found[0].word()), (verdict, "kept"));
        assert_eq!(other.value.is_some(), status != Status::Stopped);
        let words = other.words(5.2, "deg");
        assert!(
            words.contains("5.200 deg with start.kind = \"equilibrium\""),
            "{words}"
        );
        assert!(
            words.contains("with \"shaken\"") && words.contains(verdict),
            "{words}"
        );
    }
}

/// A car that derails keeps no limit; a run without numbers leaves them unknown.
#[test]
fn issue_047_derailed_and_missing_runs_are_said() {
    let mut certificate = Certificate::new(&request(&["twist_and_roll"])).unwrap();
    certificate.limits = lowered("6 deg");
    let values = |number| certificate.study.values(number);
    let mut derailed = record(&certificate, 0, &[("derailed", 1.0), ("end_distance", 152.4)]);
    derailed.status = Status::Derailed;
    derailed.reason = "at 3 s the left wheel of axle 1 left its rail".to_owned();
    let mut stopped = record(&certificate, 1, &[]);
    stopped.status = Status::Stopped;
    stopped.reason = "the step became too small".to_owned();
    stopped.measures = Measures::default();
    let good = certificate.assess(&values(0), &record(&certificate, 0, &[]));
    let gone = certificate.assess(&values(0), &derailed);
    let missing = certificate.assess(&values(1), &stopped);
    assert!(gone.note.contains("derailed 500 ft"), "{}", gone.note);
    assert_eq!(missing.note, "the step became too small");
    assert!(
        gone.note
            .ends_with("of the part until then; at 3 s the left wheel of axle 1 left its rail"),
        "{}",
        gone.note
    );
    assert_eq!((gone.status, missing.status), ("derailed", "stopped"));
    // Its roll of 0 deg keeps the limit only until it derailed.
    assert_eq!(gone.keeps(&gone.checks[0]), Some(false));
    assert_eq!(
        worst_run(&[good.clone(), gone.clone()], 0).map(|own| own.status),
        Some("derailed")
    );
    let first = verdicts(&[gone, missing.clone()]);
    assert!(first[0].worst.as_ref().unwrap().until_derailed);
    assert_eq!(
        (first[0].word(), first[0].derailed.as_slice()),
        ("exceeded", &["16 mph".to_owned()][..])
    );
    let second = verdicts(&[good, missing]);
    assert_eq!(
        (second[0].word(), second[0].missing.as_slice()),
        ("unknown", &["20 mph".to_owned()][..])
    );
}

/// The text has one mistake: in its message, in its help.
#[track_caller]
fn refused(text: &str, message: &str, help: &str) {
    let error = LimitSet::parse("ours.toml", text)
        .err()
        .unwrap_or_else(|| panic!("it is accepted:\n{text}"));
    let [problem] = error.problems() else {
        panic!("{:#?}", error.problems())
    };
    assert!(problem.message().contains(message), "{}", problem.message());
    assert!(
        problem.advice().unwrap_or("").contains(help),
        "{:?}",
        problem.advice()
    );
}

#[test]
fn input_limits_that_are_missing_or_contradict_each_other() {
    let head = "title = \"ours\"\nsource = \"a letter\"\n";
    let one = "[[limits]]\nname = \"a\"\nquantity = \"roll\"\nmeasure = \"body_roll_peak_to_peak\"\nregimes \
               = \"all\"\n";
    let good = format!("{head}{one}at_most = \"6 deg\"\n");
    assert_eq!(LimitSet::parse("ours.toml", &good).unwrap().limits.len(), 1);
    refused(head, "`limits` is missing", "[[limits]]");
    refused(&format!("{head}limits = []\n"), "no list of limits", "[[limits]]");
    refused(
        &format!("{head}{one}"),
        "neither of `at_most` and `at_least`",
        "at_most = 0.8",
    );
    refused(
        &format!("{good}at_least = \"1 deg\"\n"),
        "both of `at_most` and `at_least`",
        "two [[limits]]",
    );
    refused(&good.replace("\"6 deg\"", "6"), "at_most", "deg");
    refused(&good.replace("\"6 deg\"", "\"6 in\""), "at_most", "");
    refused(
        &good.replace("body_roll_peak_to_peak", "body_rol_peak_to_peak"),
        "no measure",
        "did you mean \"body_roll_peak_to_peak\"",
    );
    let second = one.replace("\"a\"", "\"b\"");
    refused(
        &format!("{good}{second}at_most = \"5 deg\"\n"),
        "on the same side",
        "the stricter one",
    );
    refused(
        &format!("{good}{second}at_least = \"7 deg\"\n"),
        "wants at least 7 deg",
        "correct one of them",
    );
    refused(
        &format!("{good}{one}at_most = \"5 deg\"\n"),
        "two limits `a`",
        "name of its own",
    );
    let load = good
        .replace("body_roll_peak_to_peak", "least_load_time")
        .replace("at_most = \"6 deg\"", "at_least = \"10\"");
    refused(&load, "a share in % is expected", "10 %");
}

#[test]
fn input_what_a_certificate_cannot_be() {
    let message = |request: &Request| {
        let error = Certificate::new(request)
            .err()
            .unwrap_or_else(|| panic!("it is accepted: {request:?}"));
        let problem = &error.problems()[0];
        format!("{} | {}", problem.message(), problem.advice().unwrap_or(""))
    };
    let fast = Request {
        speeds: vec![Quantity::parse("90 mph").unwrap()],
        ..request(&["twist_and_roll"])
    };
    assert!(
        message(&fast).contains("10 mph to 70 mph, not for 90 mph"),
        "{}",
        message(&fast)
    );
    let unknown = request(&["twist_and_rol"]);
    assert!(
        message(&unknown).contains("did you mean twist_and_roll?"),
        "{}",
        message(&unknown)
    );
    let twice = request(&["hunting", "hunting"]);
    assert!(message(&twice).contains("named twice"), "{}", message(&twice));
    let condition = Request {
        conditions: vec!["rise_0-5".to_owned()],
        ..request(&["hunting"])
    };
    assert!(
        message(&condition).contains("did you mean rise_0.5?"),
        "{}",
        message(&condition)
    );
    let limits = Request {
        limits: "aar_chapter".to_owned(),
        ..request(&["hunting"])
    };
    assert!(
        message(&limits).contains("aar_chapter_xi"),
        "{}",
        message(&limits)
    );
    let wedge = Request {
        car: PathBuf::from("vdrun_toe_0_psi_0"),
        ..request(&["hunting"])
    };
    assert!(message(&wedge).contains("car"), "{}", message(&wedge));
    let set = Request {
        set: vec!["truck.friction.colum=0.3".to_owned()],
        ..request(&["hunting"])
    };
    assert!(message(&set).contains("colum"), "{}", message(&set));
}
