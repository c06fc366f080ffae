//! Inputs that a wedge with a body needs, and messages where the files lack them.
#![allow(clippy::unwrap_used, clippy::panic)]

use mechanics::connection::{Accumulator, ColumnFace, Law, Wedge};
use mechanics::curve::Curve;
use nucars::truck::{Choices, Truck};
use quantity::System as Units;
use study::half_truck::run::run;
use study::half_truck::wedge_bodies::{Replaced, WedgeBodyError, replace};

use crate::common::{INCH, POUND, bodies, case};

/// Replaces the wedges of a run after each of their laws was changed.
fn replaced(name: &str, change: impl Fn(u32, &mut Wedge)) -> Result<(Truck, Replaced), WedgeBodyError> {
    let mut truck = case(name, 1.0).truck;
    for place in truck.wedges().collect::<Vec<_>>() {
        let number = truck.connections[place];
        if let Law::Wedge(wedge) = &mut truck.model.connections[place].law {
            change(number, wedge);
        }
    }
    replace(&mut truck, &Choices::default(), Units::Us).map(|replaced| (truck, replaced))
}

fn refused(name: &str, change: impl Fn(u32, &mut Wedge)) -> WedgeBodyError {
    match replaced(name, change) {
        Err(error) => error,
        Ok(_) => panic!("{name} is taken"),
    }
}

#[test]
fn input_what_is_missing_is_reported() {
    let name = "nucars_69_constant_toe_out";
    let error = refused(name, |number, wedge| {
        if number == 128 {
            let hollow = vec![[-0.1, 0.001], [0.0, 0.0], [0.1, 0.002]];
            wedge.column = ColumnFace::Profile {
                depth: Curve::new(hollow).unwrap(),
                direction: 1.0,
            };
        }
    });
    assert!(
        matches!(
            error,
            WedgeBodyError::NotPlane {
                connection: 128,
                count: 2,
                ..
            }
        ),
        "{error}"
    );
    let text = error.to_string();
    assert!(
        text.contains("2 inclinations, from -1.146 to 0.5729 deg"),
        "{text}"
    );
    assert!(text.contains("one slope, or leave the wedges massless"), "{text}");

    let error = refused(name, |_, wedge| wedge.coil = Curve::constant(0.0));
    assert_eq!(error, WedgeBodyError::NoCoil { connection: 127 });
    let error = refused(name, |_, wedge| {
        wedge.accumulator = Accumulator::Viscous { damping: 1e6 }
    });
    assert_eq!(error, WedgeBodyError::NoWedge);
    for (change, what) in [
        (
            &(|wedge: &mut Wedge| wedge.angle = 1.6) as &dyn Fn(&mut Wedge),
            "wedge angle, in degrees, of",
        ),
        (&|wedge| wedge.angle = 1.3, "the slope cannot carry the wedge"),
        (
            &|wedge| wedge.column_friction = -0.1,
            "the column's friction of connection 127 is -0.1",
        ),
        (
            &|wedge| {
                wedge.accumulator = Accumulator::Bristle {
                    stiffness: 0.0,
                    damping: 1.0,
                }
            },
            "Ka (N/m) of connection 127 is 0; for a wedge body it must be positive",
        ),
    ] {
        let text = refused(name, |_, wedge| change(wedge)).to_string();
        assert!(text.contains(what), "{text}");
    }
}

#[test]
fn input_a_direction_that_nothing_tells_is_refused() {
    let mut truck = case("nucars_68_constant_toe_out", 1.0).truck;
    let places: Vec<usize> = truck.wedges().collect();
    for place in &places {
        truck.model.connections[*place].point[0] = -35.0 * INCH;
    }
    let error = replace(&mut truck, &Choices::default(), Units::Us).unwrap_err();
    assert_eq!(
        error,
        WedgeBodyError::NoDirection {
            connection: 127,
            body: 3
        }
    );
}

#[test]
fn input_what_is_taken_and_what_is_added_is_said() {
    let (truck, replaced) = replaced("nucars_69_constant_toe_out", |_, _| ()).unwrap();
    let text = replaced.assumptions.join("\n");
    for piece in [
        "wedges of connections 127, 128, 129, 130: from the files: 37.5 deg, a column inclined by 0.2 deg, \
         toe out; friction 0.4 (column) and 0.4 (slope); coil in the bolster's pocket (constant damping) \
         with 3702 lbf",
        "added: mass 50 lb, moments of inertia",
        "height 6.125 in, width 10.5 in",
        "all six coordinates free",
        "four corners a face 250000 lbf/in, 25 lbf s/in",
        "shear stiffness 1346 lbf/in",
        "sides of the pocket at 0.25 in",
        "moved away by 0.01069 in",
        "200 lb, are taken from body 1",
        "yaw springs between the same bodies (connections 117, 118) stay",
    ] {
        assert!(text.contains(piece), "{piece}\n{text}");
    }
    let before = case("nucars_69_constant_toe_out", 1.0).truck.model;
    let mass = |bodies: &[mechanics::body::Body]| bodies.iter().map(|body| body.mass).sum::<f64>();
    assert!((mass(&truck.model.bodies) / mass(&before.bodies) - 1.0).abs() < 1e-14);
    let plain = bodies("nucars_68_variable_toe_out", 1.0, &[]);
    let text = plain.assumptions.join("\n");
    assert!(
        text.contains("type 6.8 gives a direction of toe and no angle"),
        "{text}"
    );
    assert!(!text.contains("quasi-static balance"), "{text}");
    let chosen = bodies(
        "nucars_68_variable_toe_out",
        1.0,
        &["option.wedge_mass=\"30 lb\"", "option.wedge_width=\"9 in\""],
    );
    let text = chosen.assumptions.join("\n");
    assert!(
        text.contains("mass 30 lb") && text.contains("width 9 in"),
        "{text}"
    );
}

/// Wedges with viscous friction (types 6.3 and 6.7) stay as they are, beside bodies.
#[test]
fn limits_viscous_wedges_stay_massless() {
    let mut own = bodies("nucars_69_constant_toe_out", 1.0, &[]);
    let (truck, replaced) = replaced("nucars_69_constant_toe_out", |number, wedge| {
        if number == 129 {
            wedge.accumulator = Accumulator::Viscous { damping: 1e6 };
        }
    })
    .unwrap();
    assert_eq!(replaced.wedges.len(), 3);
    let text = replaced.assumptions.join("\n");
    assert!(text.contains("connections 129 are of type 6.3 or 6.7"), "{text}");
    (own.truck, own.wedge_bodies) = (truck, replaced.wedges);
    let result = run(&own, |_| ()).unwrap();
    assert!(result.summary.complete);
    assert!(result.summary.largest_relative_residual < 1e-5);
    assert_eq!(result.summary.wedges.len(), 4);
    for number in [127, 129] {
        let normal = result
            .column(&format!("wedge_{number}_column_normal_force"))
            .unwrap();
        assert!(normal.last().unwrap() / POUND > 1000.0, "{number}");
    }
    assert!(result.column("wedge_129_jammed").is_some() && result.column("wedge_129_roll").is_none());
    assert!(result.column("wedge_127_jammed").is_none() && result.column("wedge_127_roll").is_some());
}
