//! Findings of observers of runs: none within the limits; beyond them one with place, time and value, for any
//! model.

use crate::common::{ALL, Random, UP, body, coil, face, ground, model};
use mechanics::body::Body;
use mechanics::characteristic::Characteristic;
use mechanics::coil::CoilLaw;
use mechanics::connection::{Connection, Law, SpringDamper};
use mechanics::curve::Curve;
use mechanics::energy_balance::{EnergyBalance, Entries};
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use mechanics::plausibility::{
    FindingKind, LARGEST_COMPRESSION_SHARE, LARGEST_SMALL_ANGLE, LARGEST_TILT, LEAST_LENGTH_SHARE,
    LIFTED_SHARE, Location, PENETRATION_SHARE, Plausibility, PlausibilityFinding, PlausibilityRecord,
    RELEASED_SHARE,
};
use mechanics::system::{Model, System};
use quantity::{Kind, System as Units};

const LENGTH: f64 = 0.3;
const WIDTH: f64 = 0.2;
const STIFFNESS: f64 = 1e6;
const MASS: f64 = 25.0;
/// Rows are so far apart, s.
const INTERVAL: f64 = 0.01;

/// Returns a box whose lower face (x by y: [`LENGTH`] by [`WIDTH`]) just touches a floor.
fn box_on_floor(friction: f64) -> Model {
    let (a, b) = (0.5 * LENGTH, 0.5 * WIDTH);
    let corners = [[-a, -b, 0.0], [a, -b, 0.0], [-a, b, 0.0], [a, b, 0.0]];
    let law = FrictionLaw::Tanh {
        reference_speed: 1e-3,
    };
    let sole = face("sole", &corners, STIFFNESS, 0.0, friction, law);
    let one = body("box", MASS, [0.1; 3], [0.0; 3], ALL, [0.0; 6]);
    let mut model = model(vec![one, ground()], [0.0, 0.0, -9.81]);
    model.faces.push((0, 1, Marker::new([0.0; 3], UP), sole));
    model
}

fn system(model: Model) -> System {
    System::new(model).unwrap()
}

/// Returns the state with these coordinates of the first free body (x, y, z, roll, pitch, yaw).
fn state(system: &System, coordinates: [f64; 6]) -> Vec<f64> {
    let mut x = system.initial_state();
    x[..6].copy_from_slice(&coordinates);
    x
}

/// Returns the findings if a system starts as it is and then takes these places at times of 0.01 s, 0.02 s
/// and so on.
fn found(system: &mut System, places: &[[f64; 6]]) -> Vec<PlausibilityFinding> {
    let start = system.initial_state();
    let mut observation = Plausibility::new(system, 0.0, &start);
    for (row, place) in places.iter().enumerate() {
        let x = state(system, *place);
        observation.note(system, (row + 1) as f64 * INTERVAL, &x);
    }
    observation.findings(system, &EnergyBalance::new(0.0), INTERVAL)
}

/// Checks that a place just below a limit gives no finding, and one just above it gives one, and returns its
/// time and value.
fn at_the_limit(model: &Model, place: impl Fn(f64) -> [f64; 6], limit: f64, kind: FindingKind) {
    let mut system = system(model.clone());
    let below = found(&mut system, &[place(0.999 * limit), place(0.0)]);
    assert!(below.is_empty(), "{kind:?}: {below:?}");
    let above = found(
        &mut system,
        &[place(0.0), place(1.001 * limit), place(1.002 * limit), place(0.0)],
    );
    assert_eq!(above.len(), 1, "{kind:?}: {above:?}");
    let finding = above[0];
    assert_eq!(finding.kind, kind);
    assert_eq!((finding.since, finding.time), (Some(0.02), Some(0.03)));
    assert!(
        (finding.value / (1.002 * limit) - 1.0).abs() < 1e-6,
        "{finding:?}"
    );
    assert!((finding.limit / limit - 1.0).abs() < 1e-6, "{finding:?}");
}

#[test]
fn limits_a_box_that_leaves_its_floor_is_found() {
    let model = box_on_floor(0.3);
    at_the_limit(
        &model,
        |v| [0.0, 0.0, v, 0.0, 0.0, 0.0],
        WIDTH,
        FindingKind::Separation,
    );
    at_the_limit(
        &model,
        |v| [v, 0.0, 0.0, 0.0, 0.0, 0.0],
        LENGTH,
        FindingKind::SlidOff,
    );
    at_the_limit(
        &model,
        |v| [0.0, -v, 0.0, 0.0, 0.0, 0.0],
        WIDTH,
        FindingKind::SlidOff,
    );
}

#[test]
fn limits_deep_penetration_is_found_at_the_deepest_corner() {
    let depth = PENETRATION_SHARE * WIDTH;
    let model = box_on_floor(0.3);
    at_the_limit(
        &model,
        |v| [0.0, 0.0, -v, 0.0, 0.0, 0.0],
        depth,
        FindingKind::Penetration,
    );
    // Rolled to the left (+y down) and pitched forward (+x down): the fourth corner is the deepest.
    let angle = 2.0 * depth / LENGTH;
    let all = found(&mut system(model), &[[0.0, 0.0, 0.0, -angle, angle, 0.0]]);
    assert_eq!(
        all.iter().map(|finding| finding.location).collect::<Vec<_>>(),
        [Location::Face {
            face: 0,
            point: Some(3)
        }]
    );
}

/// A tilted box stands on an edge, so that nothing penetrates.
#[test]
fn limits_a_tilted_box_is_found_and_one_that_yaws_is_not() {
    let model = box_on_floor(0.3);
    let raised = |v: f64| [0.0, 0.0, 0.5 * LENGTH * v.sin(), 0.0, v, 0.0];
    at_the_limit(&model, raised, LARGEST_TILT, FindingKind::Tilt);
    let yawed = found(&mut system(model), &[[0.0, 0.0, 0.0, 0.0, 0.0, 1.5]]);
    assert!(yawed.is_empty(), "{yawed:?}");
}

#[test]
fn limits_coils_are_found_beyond_their_length() {
    let free = 0.25;
    let on_coil = |pulls: bool, law: Option<CoilLaw>| {
        let mut model = box_on_floor(0.3);
        model.faces.clear();
        let spring = coil([0.0; 3], [0.0; 3], 1e5, free);
        let spring = mechanics::coil::Coil {
            pulls,
            law: law.unwrap_or_else(|| spring.law.clone()),
            ..spring
        };
        model
            .coils
            .push((0, 1, Marker::new([0.0, 0.0, -free], [0.0; 3]), spring));
        model
    };
    let along = |sign: f64| move |v: f64| [0.0, 0.0, sign * v, 0.0, 0.0, 0.0];
    for pulls in [true, false] {
        let (model, limit) = (on_coil(pulls, None), LIFTED_SHARE * free);
        at_the_limit(&model, along(1.0), limit, FindingKind::Lifted { pulls });
    }
    let solid = LARGEST_COMPRESSION_SHARE * free;
    at_the_limit(&on_coil(false, None), along(-1.0), solid, FindingKind::Solid);
    // A table that stiffens ends; a straight one is a stiffness.
    let table = |points: &[[f64; 2]]| CoilLaw::Table(Characteristic::new(points.to_vec()).unwrap());
    let bent = table(&[[0.0, 0.0], [0.05, 5e3], [0.06, 5e4]]);
    at_the_limit(
        &on_coil(false, Some(bent)),
        along(-1.0),
        0.06,
        FindingKind::BeyondTable,
    );
    let straight = table(&[[0.0, 0.0], [0.05, 5e3], [0.06, 6e3]]);
    let all = found(
        &mut system(on_coil(false, Some(straight))),
        &[[0.0, 0.0, -0.1, 0.0, 0.0, 0.0]],
    );
    assert!(all.is_empty(), "{all:?}");
}

#[test]
fn limits_linearized_bodies_are_found_beyond_small_angles_and_the_size_of_the_system() {
    let one = Body::linearized("bolster", [0.0; 3], ALL, 100.0, [10.0; 3]);
    let spring = SpringDamper::spring(Curve::linear(1e6));
    let connection = Connection {
        account: String::new(),
        name: "spring".to_owned(),
        a: 0,
        b: 1,
        point: [0.3, 0.4, 0.0],
        markers: None,
        law: Law::Springs(vec![(2, spring)]),
    };
    let model = Model {
        bodies: vec![one, Body::ground()],
        connections: vec![connection],
        ..Model::default()
    };
    let turned = |v: f64| [0.0, 0.0, 0.0, 0.0, -v, 0.0];
    at_the_limit(&model, turned, LARGEST_SMALL_ANGLE, FindingKind::LargeAngle(4));
    let lifted = |v: f64| [0.0, 0.0, v, 0.0, 0.0, 0.0];
    at_the_limit(&model, lifted, 0.5, FindingKind::Displacement);
    let all = found(&mut system(model), &[turned(0.2)]);
    let words = all[0].words("the bolster", Units::Si);
    assert!(
        words.contains("pitch is 0.2 rad, where linearized levers err by 2 %"),
        "{words}"
    );
}

/// Between markers bodies may turn and travel.
#[test]
fn limits_bodies_between_markers_have_no_small_angles() {
    let one = Body::free("bolster", 100.0, [10.0; 3], [0.0; 6]);
    let at = Marker::new([0.0; 3], [0.0; 3]);
    let spring = SpringDamper::spring(Curve::linear(1e6));
    let connection = |markers: Option<[Marker; 2]>| Connection {
        account: String::new(),
        name: "spring".to_owned(),
        a: 0,
        b: 1,
        point: [0.3, 0.4, 0.0],
        markers,
        law: Law::Springs(vec![(2, spring.clone())]),
    };
    for (markers, count) in [(None, 2), (Some([at; 2]), 0)] {
        let model = Model {
            bodies: vec![one.clone(), Body::ground()],
            connections: vec![connection(markers)],
            ..Model::default()
        };
        let all = found(&mut system(model), &[[2.0, 0.0, 0.0, 0.0, -1.0, 0.0]]);
        assert_eq!(all.len(), count, "{all:?}");
    }
}

#[test]
fn limits_a_coefficient_of_friction_above_one_is_found_before_anything_moves() {
    assert!(found(&mut system(box_on_floor(1.0)), &[]).is_empty());
    let all = found(&mut system(box_on_floor(1.2)), &[]);
    assert_eq!(all.len(), 1, "{all:?}");
    assert_eq!(
        (all[0].kind, all[0].value, all[0].time),
        (FindingKind::Friction, 1.2, None)
    );
}

/// The energy of corners that begin inside is held against the scale of the ledger; what stays stored is
/// not released.
#[test]
fn energy_an_overlap_at_the_start_is_found_by_the_energy_that_it_releases() {
    let depth = 1e-3;
    let mut model = box_on_floor(0.3);
    model.bodies[0].initial[2] = -depth;
    let stored = 4.0 * 0.5 * STIFFNESS * depth * depth;
    let released = |later: f64, work: f64| {
        let mut system = system(model.clone());
        let start = system.initial_state();
        let mut observation = Plausibility::new(&mut system, 0.0, &start);
        let x = state(&system, [0.0, 0.0, -later, 0.0, 0.0, 0.0]);
        observation.note(&mut system, INTERVAL, &x);
        let mut balance = EnergyBalance::new(stored);
        balance.note(
            INTERVAL,
            &Entries {
                work,
                ..Entries::default()
            },
        );
        observation.findings(&system, &balance, INTERVAL)
    };
    let least = stored / RELEASED_SHARE;
    assert!(released(0.0, 1.01 * least).is_empty());
    assert!(released(depth, 0.1 * least).is_empty());
    let all = released(0.0, 0.99 * least);
    assert_eq!(all.len(), 1, "{all:?}");
    assert_eq!(all[0].kind, FindingKind::StoredAtStart);
    assert!((all[0].value / stored - 1.0).abs() < 1e-12, "{all:?}");
}

/// A box that sinks in and out by turns vibrates between the output times; one that goes slowly does not.
#[test]
fn limits_scatter_of_a_contact_force_is_found_with_the_frequency() {
    // Phase between output times, rad.
    let courses = [2.5, 0.14].map(|phase: f64| {
        let place = move |row: usize| -1e-4 * (1.0 + 0.5 * (row as f64 * phase).sin());
        (0..100)
            .map(|row| [0.0, 0.0, place(row), 0.0, 0.0, 0.0])
            .collect::<Vec<_>>()
    });
    let ringing = found(&mut system(box_on_floor(0.3)), &courses[0]);
    assert_eq!(ringing.len(), 1, "{ringing:?}");
    let FindingKind::CoarseOutput { frequency, .. } = ringing[0].kind else {
        unreachable!("{ringing:?}")
    };
    let expected = (4.0 * STIFFNESS / MASS).sqrt() / std::f64::consts::TAU;
    assert!((frequency / expected - 1.0).abs() < 1e-12, "{frequency}");
    assert_eq!(ringing[0].value, INTERVAL);
    assert!(found(&mut system(box_on_floor(0.3)), &courses[1]).is_empty());
}

/// A run that was saved and goes on finds the same; what cannot be its record is refused.
#[test]
fn limits_a_record_goes_on_where_it_was_saved() {
    let mut system = system(box_on_floor(1.1));
    let start = system.initial_state();
    let places = [[0.0, 0.0, 0.25, 0.1, 0.3, 0.0], [0.5, 0.0, -0.004, 0.0, 0.0, 0.1]];
    let states = places.map(|place| state(&system, place));
    let mut straight = Plausibility::new(&mut system, 0.0, &start);
    straight.note(&mut system, 0.01, &states[0]);
    let text = serde_json::to_string(straight.record()).unwrap();
    let record: PlausibilityRecord = serde_json::from_str(&text).unwrap();
    let mut resumed = Plausibility::resume(&mut system, 0.0, &start, record.clone()).unwrap();
    for observation in [&mut straight, &mut resumed] {
        observation.note(&mut system, 0.02, &states[1]);
    }
    let balance = EnergyBalance::new(0.0);
    let all = straight.findings(&system, &balance, INTERVAL);
    assert!(all.len() >= 4, "{all:?}");
    assert_eq!(all, resumed.findings(&system, &balance, INTERVAL));

    let broken: [fn(&mut PlausibilityRecord); 4] = [
        |record| record.rows = 0,
        |record| record.worst[0].value = f64::NAN,
        |record| record.faces[0].sum = -1.0,
        |record| record.worst.truncate(2),
    ];
    for spoil in broken {
        let mut record = record.clone();
        spoil(&mut record);
        assert!(Plausibility::resume(&mut system, 0.0, &start, record).is_none());
    }
}

/// A finding says place, value, time, limit and advice, in the units asked for.
#[test]
fn input_a_finding_in_words_has_all_that_a_reader_needs() {
    let mut system = system(box_on_floor(0.3));
    let all = found(
        &mut system,
        &[[0.0, 0.0, 0.3, 0.0, 0.0, 0.0], [0.0, 0.0, 25.4, 0.0, 0.0, 0.0]],
    );
    let place = all[0].location.describe(&system);
    assert_eq!(place, "the sole face of the box");
    let words = all[0].words(&place, Units::Us);
    assert_eq!(
        words,
        "the sole face of the box has left its surface: the gap is 1000 in at 0.02 s; the limit is 7.874 in \
         (the smallest extent of the face), exceeded from 0.01 s on"
    );
    let shown = all[0].to_string();
    assert!(
        shown.contains("25.4 m") && shown.ends_with(FindingKind::Separation.advice()),
        "{shown}"
    );
}

/// Two points on a line that is not quite straight along an axis, as of an adapter on a large wheel.
#[test]
fn issue_047_points_on_a_line_have_no_extent_across_it() {
    let mut model = box_on_floor(0.3);
    let points = [[-0.5 * LENGTH, 2e-13, 0.0], [0.5 * LENGTH, -2e-13, 0.0]];
    let law = FrictionLaw::Tanh {
        reference_speed: 1e-3,
    };
    model.faces[0].3 = face("sole", &points, STIFFNESS, 0.0, 0.3, law);
    let across = found(
        &mut system(model.clone()),
        &[[0.0, 0.9 * LENGTH, 0.0, 0.0, 0.0, 0.0]],
    );
    assert!(across.is_empty(), "{across:?}");
    let along = |v| [v, 0.0, 0.0, 0.0, 0.0, 0.0];
    at_the_limit(&model, along, LENGTH, FindingKind::SlidOff);
}

/// Whatever the geometry, no length is limited by what is rounding at the size of the model.
#[test]
fn issue_047_no_limit_is_below_a_millionth_of_the_size_of_the_model() {
    let mut random = Random(6);
    let mut limits = 0;
    for _ in 0..300 {
        let sizes: [f64; 3] = std::array::from_fn(|_| 10f64.powf(random.between(-16.0, 0.0)));
        let count = 1 + random.bits() % 6;
        let points: Vec<[f64; 3]> = (0..count)
            .map(|_| sizes.map(|size| size * random.between(-1.0, 1.0)))
            .collect();
        let law = FrictionLaw::Tanh {
            reference_speed: 1e-3,
        };
        let place: [f64; 6] = random.vector(1.0);
        let one = body("one", 5.0, [0.2, 0.3, 0.4], [0.0; 3], ALL, place);
        let mut model = model(vec![one, ground()], [0.0, 0.0, -9.81]);
        let own = face("sole", &points, STIFFNESS, 0.0, 0.3, law);
        model
            .faces
            .push((0, 1, Marker::new([0.0; 3], random.vector(3.0)), own));
        let length = 10f64.powf(random.between(-9.0, 0.0));
        model.coils.push((
            0,
            1,
            Marker::new([0.0; 3], [0.0; 3]),
            coil([0.0; 3], [0.0; 3], 1e4, length),
        ));
        let mut system = system(model);
        let start = system.initial_state();
        let [x, y, z, ..] = place;
        let size = (x * x + y * y + z * z).sqrt().max(2.0 * (0.4_f64 / 5.0).sqrt());
        for (kind, location, limit) in Plausibility::new(&mut system, 0.0, &start).limits() {
            if kind.quantity() == Kind::Length {
                limits += usize::from(limit.is_finite());
                assert!(
                    limit >= LEAST_LENGTH_SHARE * size,
                    "{kind:?} at {location:?}: {limit} of {size}"
                );
            }
        }
    }
    assert!(limits > 500, "{limits} limits");
}
