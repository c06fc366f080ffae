//! analytic, limits, input: surveys of wedge rise, whose runs are made up here: margins with cliffs at
//! known rises.

use std::collections::BTreeSet;

use quantity::{Kind, Quantity};
use study::models::AnyCase;
use study::rise::bracket::SIXTEENTH;
use study::rise::{Known, OfLimit, OfRun, RiseRequest, Survey, Wanted};

fn request(most: usize) -> RiseRequest {
    RiseRequest {
        car: "car_tangent_loaded".into(),
        set: Vec::new(),
        regimes: ["twist_and_roll", "constant_curve"].map(str::to_owned).into(),
        limits: "aar_chapter_xi".to_owned(),
        to: None,
        factors: None,
        most,
        full: false,
    }
}

/// The rise, sixteenths, at which a made-up car reaches its limits: rocking most at 17.9 mph, curves never;
/// `mu_0.25` takes a quarter of an inch off, `cg_98` half of that.
fn cliff(survey: &Survey, wanted: &Wanted) -> f64 {
    if survey.regimes[wanted.regime].name != "twist_and_roll" {
        return 100.0;
    }
    let taken = wanted.state.iter().map(|own| match survey.levels[*own].name() {
        "mu_0.25" => 4.0,
        "cg_98" => 2.0,
        _ => 0.0,
    });
    12.3 + (f64::from(wanted.speed) / 100.0 - 17.9).abs() - taken.sum::<f64>()
}

fn made_up(survey: &Survey, wanted: &Wanted) -> OfRun {
    let own = |limit: &study::car::limits::Limit| limit.is_for(&survey.regimes[wanted.regime].name);
    let margin = (cliff(survey, wanted) - f64::from(wanted.rise)) / 16.0;
    let limits = survey.limits.limits.iter().filter(|limit| own(limit));
    OfRun {
        status: "complete".to_owned(),
        note: String::new(),
        derailed: margin < -0.5,
        limits: limits
            .map(|limit| OfLimit {
                limit: limit.name.clone(),
                unit: limit.unit.clone(),
                value: Some(1.0),
                limit_value: Some(1.0),
                margin: Some(margin),
            })
            .collect(),
    }
}

/// Runs a survey to its end; returns its runs, each asked for once.
fn surveyed(survey: &Survey) -> Known {
    let mut known = Known::new();
    while let Some(batch) = survey.next(&known) {
        for wanted in batch.runs {
            let run = made_up(survey, &wanted);
            assert!(known.insert(wanted, run).is_none(), "asked for twice");
        }
    }
    assert!(known.len() <= survey.request.most);
    known
}

/// The cliff is found to a sixteenth of an inch at a speed within 2 mph of the worst one; conditions alone
/// and the worst two together are where they were put.
#[test]
fn analytic_a_survey_finds_cliffs_where_they_are() {
    let survey = Survey::new(request(200)).unwrap();
    let known = surveyed(&survey);
    assert!(survey.left(&known).is_empty(), "{:?}", survey.left(&known));
    let answers = survey.answers(&known);
    let of = |state: &str, limit: &str| {
        let own = answers
            .iter()
            .find(|own| survey.state_name(&own.state) == state && survey.limit(own.question).name == limit);
        own.unwrap_or_else(|| panic!("{state} {limit}"))
    };
    let own = of("as_given", "least_wheel_load");
    // 12.4 at 18 mph, which is none of the speeds of the regime.
    assert_eq!((own.bracket.kept, own.bracket.exceeded), (Some(12), Some(13)));
    assert_eq!(own.words(survey.top), "between 3/4 and 13/16 in");
    assert!((f64::from(own.speed) / 100.0 - 17.9).abs() < 0.2, "{}", own.speed);
    let never = of("as_given", "wheel_l_over_v_in_curves");
    assert_eq!(never.words(survey.top), "not reached up to 1 1/4 in");
    let softer = of("mu_0.25", "least_wheel_load").bracket;
    assert_eq!((softer.kept, softer.exceeded), (Some(8), Some(10)));
    let pair = of("mu_0.25+cg_98", "least_wheel_load").bracket;
    assert_eq!((pair.kept, pair.exceeded), (Some(6), Some(8)));
}

/// A limit that no speed of the regime reaches is found at a speed between two of them, if little is left
/// there.
#[test]
fn analytic_a_resonance_between_the_speeds_is_found() {
    let survey = Survey::new(request(200)).unwrap();
    let mut known = Known::new();
    let narrow = |wanted: &Wanted| {
        let away = (f64::from(wanted.speed) / 100.0 - 18.0) / 1.5;
        let peak = 1.0 / (1.0 + away * away);
        // At 18 mph the limit is reached at 13.6; at 16 and 20 mph not up to 20.
        1.0 - peak * f64::from(wanted.rise) / 13.6
    };
    while let Some(batch) = survey.next(&known) {
        for wanted in batch.runs {
            let mut run = made_up(&survey, &wanted);
            run.derailed = false;
            for own in &mut run.limits {
                own.margin = Some(match survey.regimes[wanted.regime].name.as_str() {
                    "twist_and_roll" => narrow(&wanted),
                    _ => 2.0,
                });
            }
            known.insert(wanted, run);
        }
    }
    let question = survey.questions()[0];
    let own = survey.answer(&known, &[], question).unwrap();
    assert_eq!(
        (own.speed, own.bracket.kept, own.bracket.exceeded),
        (1800, Some(13), Some(14))
    );
}

/// A greater number of runs asks for all that a smaller one has asked for, and for more; the same survey
/// asks the same again.
#[test]
fn limits_more_runs_go_on_where_fewer_have_ended() {
    let runs = |most: usize| -> BTreeSet<Wanted> {
        let survey = Survey::new(request(most)).unwrap();
        surveyed(&survey).into_keys().collect()
    };
    let few = runs(30);
    assert_eq!(few.len(), 30);
    assert_eq!(few, runs(30));
    let left = Survey::new(request(30)).unwrap();
    assert!(!left.left(&surveyed(&left)).is_empty());
    assert!(runs(60).is_superset(&runs(24)));
}

/// The case of a run has its rise, its speed, its condition, and the irregularities of its track.
#[test]
fn analytic_a_run_is_made_of_what_it_says() {
    let mut own = request(200);
    own.factors = Some(["mu_0.25", "track_class_3"].map(str::to_owned).into());
    let survey = Survey::new(own).unwrap();
    let made = |state: &[usize]| {
        let wanted = Wanted {
            state: state.to_vec(),
            regime: 0,
            speed: 1650,
            rise: 12,
        };
        let prepared = survey.prepare(&wanted).unwrap();
        let AnyCase::Car(car) = prepared.case() else {
            panic!("no car")
        };
        car.clone()
    };
    let (plain, both) = (made(&[]), made(&[0, 1]));
    for car in [&plain, &both] {
        assert!((car.speed() / 0.447_04 - 16.5).abs() < 1e-9);
        for truck in &car.parameters.trucks {
            for wedge in &truck.wedges {
                let [sin, cos] = [wedge.angle.sin(), wedge.angle.cos()];
                let rise = (wedge.wear.column * cos + wedge.wear.slope) / sin;
                assert!((rise / (12.0 * SIXTEENTH) - 1.0).abs() < 0.02, "{rise}");
            }
        }
    }
    let irregularities = |car: &study::car::CarCase| car.parameters.track.irregularities.len();
    assert_eq!(irregularities(&both), irregularities(&plain) + 3);
}

#[test]
fn input_what_a_survey_cannot_be() {
    let refused = |change: &dyn Fn(&mut RiseRequest), part: &str| {
        let mut own = request(200);
        change(&mut own);
        let error = Survey::new(own).unwrap_err();
        let all: Vec<String> = error
            .problems()
            .iter()
            .map(|own| own.message().to_owned())
            .collect();
        assert!(all.iter().any(|own| own.contains(part)), "{part}: {all:?}");
        assert!(
            error.problems().iter().all(|own| own.advice().is_some()),
            "{all:?}"
        );
    };
    let length = |text: &str| Some(Quantity::parse_as(text, Kind::Length).unwrap());
    let texts = |names: &[&str]| names.iter().map(|own| (*own).to_owned()).collect::<Vec<_>>();
    refused(
        &|own| own.to = length("2 in"),
        "more than the pockets hold, 1.500 in",
    );
    refused(&|own| own.to = length("10 mm"), "no whole number of sixteenths");
    refused(
        &|own| own.set = texts(&["truck.wedge.rise=0.5 in"]),
        "the rise is what a survey varies",
    );
    refused(
        &|own| own.factors = Some(texts(&["rise_0.5"])),
        "rise is what a survey varies",
    );
    refused(
        &|own| own.factors = Some(texts(&["mu_0.25", "mu_0.25"])),
        "named twice",
    );
    refused(
        &|own| own.factors = Some(texts(&["track_class_7"])),
        "no track of the name",
    );
    refused(&|own| own.regimes = texts(&["lean", "lean"]), "named twice");
    refused(&|own| own.regimes = texts(&["lean"]), "sets no limit");
    refused(
        &|own| own.car = "truck_vertical_variable".into(),
        "no case of a car",
    );
}
