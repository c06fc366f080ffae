//! Limits, conditions and what an assessment makes of records.

use std::path::PathBuf;
use std::sync::Arc;

use car::StartKind;
use quantity::Quantity;
use study::assessment::conditions::{self, Condition};
use study::assessment::dependence::{Change, Changed, Varied, wanted};
use study::assessment::{Assessment, Request, verdicts, worst_run};
use study::car::limits::{Bound, LimitSet};
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
        frictions: vec![0.3, 0.5],
    }
}

/// Returns a record of a run with these measures (SI) and zeros for the others.
fn record(assessment: &Assessment, number: u64, given: &[(&str, f64)]) -> Record {
    let definitions = assessment.study.measures();
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

fn lowered(limit: &str) -> Arc<LimitSet> {
    let text = format!(
        "title = \"ours\"\nsource = \"a letter\"\n[[limits]]\nname = \"roll\"\nquantity = \"body roll\"\n\
         measure = \"body_roll_peak_to_peak\"\nregimes = [\"twist_and_roll\"]\nat_most = \"{limit}\"\n"
    );
    Arc::new(LimitSet::parse("ours.toml", &text).unwrap())
}

#[test]
fn input_all_that_is_built_in_can_be_read() {
    let names: Vec<&str> = LimitSet::built_in().iter().map(|own| own.name.as_str()).collect();
    let expected = [
        "aar_chapter_xi",
        "aar_chapter_xi_1993",
        "fra_213_333",
        "fra_213_57",
        "fra_238_appendix_c",
        "en_14363",
    ];
    assert_eq!(names, expected);
    // Each value says where it is from, and each set what it lacks: none of them makes a certificate yet.
    for set in LimitSet::built_in() {
        assert!(set.limits.iter().all(|own| own.mark.is_some()), "{}", set.name);
        assert!(
            set.not_covered.as_ref().is_some_and(|own| !own.is_empty()),
            "{}",
            set.name
        );
        assert!(!set.edition.is_empty() && !set.is_complete(), "{}", set.name);
        // Windows of the set are taken by a car.
        let request = Request {
            limits: set.name.clone(),
            ..request(&["twist_and_roll"])
        };
        assert!(Assessment::new(&request).is_ok(), "{}", set.name);
    }
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
    let named = |name: &str| Condition::chosen(&[name.to_owned()], true).unwrap();
    assert_eq!(named("worn"), named("mu_0.25"));
    // All of them make cases of loaded and of empty cars.
    let request = Request {
        speeds: vec![Quantity::parse("30 mph").unwrap()],
        conditions: Condition::all().iter().map(|own| own.name.clone()).collect(),
        ..request(&["hunting", "twist_and_roll"])
    };
    let assessment = Assessment::new(&request).unwrap();
    assert_eq!(assessment.study.count(), 2 * Condition::all().len() as u64);
    for number in 0..assessment.study.count() {
        if let Err(error) = assessment.study.case(number) {
            panic!("{:?}: {:?}", assessment.study.values(number), error.problems());
        }
    }
}

/// Limits are for filtered values: where rows are too far apart for the filter there is no number, the limit
/// is neither kept nor exceeded, and the run says what to do.
#[test]
fn issue_048_raw_values_keep_no_limit() {
    let assessment = Assessment::new(&request(&["twist_and_roll"])).unwrap();
    let measured = |interval: &str, name: &str| {
        let settings = ["simulation.duration=\"2 s\"", "start.settle=\"0.5 s\"", interval];
        let case = AnyCase::built_in("car_twist_and_roll_loaded", &settings.map(str::to_owned));
        let measures = case.unwrap().unwrap().judge().unwrap().measures;
        assessment.study.measures().get(&measures, name)
    };
    let close = "simulation.output_interval=\"0.01 s\"";
    let far = "simulation.output_interval=\"0.5 s\"";
    assert!(measured(close, "least_load_time").is_some());
    assert_eq!(measured(far, "least_load_time"), None);
    assert!(measured(far, "body_roll_peak_to_peak").is_some());

    let record = record(&assessment, 0, &[("least_load_time", f64::NAN)]);
    let run = assessment.assess(&assessment.study.values(0), &record);
    let says = "least_wheel_load: no value: rows are too far apart";
    assert!(run.note.starts_with(says), "{}", run.note);
    let found = verdicts(&[run]);
    let word = |name: &str| {
        let own = found
            .iter()
            .find(|own| assessment.limits.limits[own.limit].name == name);
        own.unwrap().word()
    };
    assert_eq!([word("least_wheel_load"), word("body_roll")], ["unknown", "kept"]);
}

/// A limit lowered by hand turns its row; margins are parts of the limit.
#[test]
fn analytic_margins_and_verdicts() {
    let mut assessment = Assessment::new(&request(&["twist_and_roll"])).unwrap();
    let rolls = [3.0_f64, 4.5];
    let assessed = |assessment: &Assessment| -> Vec<_> {
        (0..2)
            .map(|number| {
                let roll = ("body_roll_peak_to_peak", rolls[number as usize].to_radians());
                let record = record(assessment, number, &[roll, ("least_load_time", 40.0)]);
                assessment.assess(&assessment.study.values(number), &record)
            })
            .collect()
    };
    let runs = assessed(&assessment);
    assert_eq!(runs[1].speed, "20 mph");
    assert!((runs[1].speed_si - 8.9408).abs() < 1e-12);
    let found = verdicts(&runs);
    let of = |name: &str| {
        let limits = &assessment.limits.limits;
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
        assessment.limits.limits[of("least_wheel_load").limit].bound,
        Bound::AtLeast
    );
    assert_eq!(worst_run(&runs, 0).unwrap().run, 1);

    assessment.limits = lowered("4 deg");
    let found = verdicts(&assessed(&assessment));
    assert_eq!(found[0].word(), "exceeded");
    assert!((found[0].worst.as_ref().unwrap().margin + 0.125).abs() < 1e-12);
    assessment.limits = lowered("5 deg");
    assert_eq!(verdicts(&assessed(&assessment))[0].word(), "kept");
}

/// A run within 15 % of a limit, kept or not, is computed from the other start, and all worst runs at
/// other frictions, each once; values stand beside each other, and the verdict of the run stays its own.
#[test]
fn analytic_runs_near_a_limit_are_varied() {
    let mut assessment = Assessment::new(&request(&["twist_and_roll"])).unwrap();
    let assessed = |assessment: &Assessment| {
        let roll = ("body_roll_peak_to_peak", 5.2_f64.to_radians());
        let runs = [0, 1].map(|number| {
            let own = if number == 0 { ("steps", 1.0) } else { roll };
            let record = record(assessment, number, &[own, ("least_load_time", 40.0)]);
            assessment.assess(&assessment.study.values(number), &record)
        });
        verdicts(&runs)
    };
    let friction = [0.3, 0.5].map(|own| (1, Change::Friction(own)));
    let with = |own: &[(u64, Change)]| [own, &friction].concat();
    for (limit, expected) in [
        ("11 deg", with(&[])),
        ("6.2 deg", with(&[])),
        ("6 deg", with(&[(1, Change::Start)])),
        ("5 deg", with(&[(1, Change::Start)])),
        ("4.5 deg", with(&[])),
        ("3 deg", with(&[])),
    ] {
        assessment.limits = lowered(limit);
        assert_eq!(wanted(&assessed(&assessment), &[0.3, 0.5]), expected, "{limit}");
    }
    assessment.limits = lowered("5.5 deg");
    let mut found = assessed(&assessment);
    let varied = |changed: Changed, roll: f64, status: Status| {
        let mut own = record(&assessment, 1, &[("body_roll_peak_to_peak", roll.to_radians())]);
        own.status = status;
        Varied {
            run: 1,
            changed,
            record: own,
        }
    };
    assessment.note(&mut found, &[]);
    assert_eq!(found[0].depends, Default::default());
    assert!(found[0].turned_by().is_empty());
    for (roll, status, verdict) in [
        (5.4, Status::Complete, "kept"),
        (5.6, Status::Complete, "exceeded"),
        (5.4, Status::Derailed, "exceeded"),
        (5.4, Status::Stopped, "unknown"),
    ] {
        let changed = Changed::Start(["equilibrium", "shaken"]);
        assessment.note(&mut found, &[varied(changed, roll, status)]);
        let other = found[0].depends.other_start.as_ref().unwrap();
        assert_eq!((other.judged.verdict, found[0].word()), (verdict, "kept"));
        assert_eq!(other.judged.value.is_some(), status != Status::Stopped);
        let turned = if verdict == "exceeded" {
            vec!["start"]
        } else {
            vec![]
        };
        assert_eq!(found[0].turned_by(), turned);
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
    // 5.2 deg at 0.4 and 5.8 deg at 0.5: 5.5 deg half way between.
    let over = |from: f64, to: f64| {
        let of = |friction: f64, roll| varied(Changed::Friction([0.4, friction]), roll, Status::Complete);
        let mut found = assessed(&assessment);
        assessment.note(&mut found, &[of(0.5, to), of(0.3, from)]);
        let own = found[0].depends.friction.clone().unwrap();
        assert_eq!([own.others[0].friction, own.others[1].friction], [0.3, 0.5]);
        (own.reached, own.words(found[0].word()), found[0].turned_by())
    };
    let (reached, words, turned) = over(4.9, 5.8);
    assert!((reached.unwrap() - 0.45).abs() < 1e-9, "{words}");
    assert!(words.contains("reached at a friction of 0.45"), "{words}");
    assert_eq!(turned, ["friction"]);
    let (reached, words, turned) = over(4.9, 5.3);
    assert_eq!((reached, turned.len()), (None, 0));
    assert_eq!(words, "kept at frictions from 0.3 to 0.5");
}

/// Limits by formulas are those of the run's car; what a formula lacks leaves its limit unknown, and is said.
#[test]
fn analytic_limits_by_formulas_follow_the_car() {
    let request = Request {
        limits: "fra_213_333".to_owned(),
        ..request(&["twist_and_roll"])
    };
    let assessment = Assessment::new(&request).unwrap();
    let of = |given: &[(&str, f64)], name: &str| {
        let record = record(&assessment, 0, given);
        let run = assessment.assess(&assessment.study.values(0), &record);
        let place = assessment.limits.limits.iter().position(|own| own.name == name);
        let check = run.checks.iter().find(|own| Some(own.limit) == place).unwrap();
        (check.value, check.allowed, check.margin, run.note)
    };
    let kip = 4_448.221_615_260_5;
    for (load, expected) in [(65.75, 0.4 + 5.0 / 65.75), (16.0, 0.4 + 5.0 / 16.0)] {
        let given = [
            ("greatest_static_axle_load", load * kip),
            ("net_axle_l_over_v", 0.3),
        ];
        let (value, allowed, margin, _) = of(&given, "net_axle_l_over_v");
        assert!((allowed.unwrap() - expected).abs() < 1e-12);
        assert_eq!(value, Some(0.3));
        assert!((margin.unwrap() - (expected - 0.3) / expected).abs() < 1e-12);
    }
    let (.., allowed, margin, note) = of(&[("least_flange_angle", f64::NAN)], "single_wheel_l_over_v");
    assert_eq!((allowed, margin), (None, None));
    assert!(
        note.contains("single_wheel_l_over_v, net_axle_l_over_v: no limit: the car lacks"),
        "{note}"
    );
    let (_, allowed, ..) = of(
        &[("least_flange_angle", 75.0_f64.to_radians())],
        "single_wheel_l_over_v",
    );
    let slope = 75.0_f64.to_radians().tan();
    assert!((allowed.unwrap() - (slope - 0.5) / (1.0 + 0.5 * slope)).abs() < 1e-12);
}

/// What is taken in full curves is no row of a straight track, and is one of a curve.
#[test]
fn limits_rows_of_curves_are_left_out_on_straight_track() {
    for (regime, curved) in [
        ("fra_class_4", false),
        ("constant_curve", true),
        ("lean", true),
        ("spiral", true),
    ] {
        let request = Request {
            limits: "en_14363".to_owned(),
            speeds: Vec::new(),
            ..request(&[regime])
        };
        let assessment = Assessment::new(&request).unwrap();
        let run = assessment.assess(&assessment.study.values(0), &record(&assessment, 0, &[]));
        let names = run
            .checks
            .iter()
            .map(|own| &*assessment.limits.limits[own.limit].name);
        let names: Vec<&str> = names.collect();
        assert_eq!(names.contains(&"y_quasi_static"), curved, "{regime}: {names:?}");
        assert!(names.contains(&"sum_y"), "{regime}");
    }
}

/// So they are where regimes have other numbers of speeds: each has its own track.
#[test]
fn limits_rows_of_curves_belong_to_their_regimes() {
    let regimes = ["static_curve", "fra_class_4", "constant_curve", "twist_and_roll"];
    let request = Request {
        limits: "en_14363".to_owned(),
        speeds: Vec::new(),
        ..request(&regimes)
    };
    let assessment = Assessment::new(&request).unwrap();
    assert_eq!(assessment.study.count(), 2 + 3 * 6);
    let limit = assessment
        .limits
        .limits
        .iter()
        .position(|own| own.name == "y_quasi_static");
    for number in 0..assessment.study.count() {
        let run = assessment.assess(
            &assessment.study.values(number),
            &record(&assessment, number, &[]),
        );
        let there = run.checks.iter().any(|own| Some(own.limit) == limit);
        assert_eq!(there, [true, false, true, false][run.regime], "{number}");
    }
}

/// Cars start shaken, unless the case, --set or a condition says otherwise.
#[test]
fn limits_cars_start_shaken_if_nothing_says_otherwise() {
    let kind = |change: &dyn Fn(&mut Request)| {
        let mut request = request(&["twist_and_roll"]);
        change(&mut request);
        let case = Assessment::new(&request).unwrap().study.case(0).unwrap();
        case.car().unwrap().parameters.start.kind
    };
    assert_eq!(kind(&|_| ()), StartKind::Shaken);
    let equilibrium = |own: &mut Request| own.set = vec!["start.kind=equilibrium".to_owned()];
    assert_eq!(kind(&equilibrium), StartKind::Equilibrium);
    assert_eq!(
        kind(&|own| own.conditions = vec!["equilibrium".to_owned()]),
        StartKind::Equilibrium
    );
    assert_eq!(
        kind(&|own| own.conditions = vec!["shaken".to_owned()]),
        StartKind::Shaken
    );
}

/// A certificate is what covers the whole rule, with values that were read in it, at the regimes' own speeds
/// and more, and is kept; everything else says why it is none.
#[test]
fn limits_only_what_is_complete_is_a_certificate() {
    let why = |extra: &str, mark: &str, roll: f64, change: &dyn Fn(&mut Request)| {
        let text = format!(
            "title = \"ours\"\nsource = \"a letter\"\n{extra}[[limits]]\nname = \"roll\"\n\
             quantity = \"body roll\"\nmeasure = \"body_roll_peak_to_peak\"\nat_most = \"6 deg\"\n\
             regimes = [\"twist_and_roll\"]\n{mark}"
        );
        let mut request = Request {
            speeds: Vec::new(),
            refine: true,
            ..request(&["twist_and_roll"])
        };
        change(&mut request);
        let mut assessment = Assessment::new(&request).unwrap();
        assessment.limits = Arc::new(LimitSet::parse("ours.toml", &text).unwrap());
        let count = assessment.study.count();
        let run = |number| {
            let record = record(
                &assessment,
                number,
                &[("body_roll_peak_to_peak", roll.to_radians())],
            );
            assessment.assess(&assessment.study.values(number), &record)
        };
        let runs: Vec<_> = (0..count).map(run).collect();
        assessment.falls_short(&verdicts(&runs)).join("; ")
    };
    let whole = "not_covered = []\n";
    let nothing = |_: &mut Request| ();
    assert_eq!(why(whole, "mark = \"source\"\n", 1.0, &nothing), "");
    assert_eq!(why(whole, "", 1.0, &nothing), "");
    for (extra, mark, roll, expected) in [
        ("", "", 1.0, "does not say what the rule asks for"),
        (
            "not_covered = [{ what = \"impacts\" }]\n",
            "",
            1.0,
            "1 part of the rule not covered",
        ),
        (whole, "mark = \"remembered\"\n", 1.0, "1 limit from memory"),
        (whole, "mark = \"guess\"\n", 1.0, "1 limit a guess"),
        (whole, "", 7.0, "1 limit exceeded"),
        (whole, "", f64::NAN, "1 limit unknown"),
    ] {
        let found = why(extra, mark, roll, &nothing);
        assert!(found.contains(expected), "{expected}: {found}");
    }
    let found = why(whole, "", 1.0, &|own| own.refine = false);
    assert!(found.contains("speeds are not those"), "{found}");
    let found = why(whole, "", 1.0, &|own| own.regimes = vec!["spiral".to_owned()]);
    assert!(found.contains("no runs of twist and roll"), "{found}");
}

/// A car that derails keeps no limit; a run without numbers leaves them unknown.
#[test]
fn issue_047_derailed_and_missing_runs_are_said() {
    let mut assessment = Assessment::new(&request(&["twist_and_roll"])).unwrap();
    assessment.limits = lowered("6 deg");
    let values = |number| assessment.study.values(number);
    let mut derailed = record(&assessment, 0, &[("derailed", 1.0), ("end_distance", 152.4)]);
    derailed.status = Status::Derailed;
    derailed.reason = "at 3 s the left wheel of axle 1 left its rail".to_owned();
    let mut stopped = record(&assessment, 1, &[]);
    stopped.status = Status::Stopped;
    stopped.reason = "the step became too small".to_owned();
    stopped.measures = Measures::default();
    let good = assessment.assess(&values(0), &record(&assessment, 0, &[]));
    let gone = assessment.assess(&values(0), &derailed);
    let missing = assessment.assess(&values(1), &stopped);
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

#[test]
fn input_what_an_assessment_cannot_be() {
    let message = |request: &Request| {
        let error = Assessment::new(request)
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
