//! Worn faces: where they are, and how far the wedge rises, against closed forms.

use crate::common;
use common::{INCH, TOE};
use mechanics::motion::Motion;
use wedge::parameters::{Damping, Parameters, Start, Wear};
use wedge::{COLUMN, SLOPE, WEDGE, Wedge, thesis};

const BOTH: [Damping; 2] = [Damping::Variable, Damping::Constant];
const WEARS: [(f64, f64); 4] = [(0.2, 0.0), (0.0, 0.2), (0.1, 0.3), (0.3, 0.3)];

/// Returns a planar wedge at rest under a held bolster, the column and slope worn (in).
fn worn(damping: Damping, toe: f64, (column, slope): (f64, f64)) -> Parameters {
    let mut parameters = thesis::parameters(damping, toe, 0.0);
    parameters.wear = Wear {
        column: column * INCH,
        slope: slope * INCH,
    };
    parameters.wedge.free = common::free(&["x", "z"]);
    let height = match damping {
        Damping::Variable => -2.0,
        Damping::Constant => 0.3,
    };
    parameters.bolster.coordinates[2] = Motion::Constant(height * INCH);
    parameters.start = Start::Equilibrium;
    parameters
}

#[test]
fn worn_faces_lie_deeper_by_the_wear() {
    for damping in BOTH {
        for (column, slope) in WEARS {
            let mut parameters = worn(damping, 0.0, (column, slope));
            parameters.bolster.coordinates[2] = Motion::Constant(0.0);
            parameters.start = Start::Rest;
            let mut wedge = Wedge::new(parameters).unwrap();
            let start = wedge.initial_state.clone();
            let observation = wedge.system.observe(0.0, &start);
            for (face, depth) in [(COLUMN, column), (SLOPE, slope)] {
                for point in &observation.faces[face].points {
                    assert!((point.gap / INCH - depth).abs() < 1e-13, "{} {depth}", point.gap);
                }
            }
        }
    }
}

#[test]
fn the_rise_in_numbers() {
    // By hand: 0.2/tan 32°, 0.2/sin 32°, 0.3 (1 + cos 37.5°)/sin 37.5°.
    for (damping, wear, rise) in [
        (Damping::Variable, (0.2, 0.0), 0.320_067),
        (Damping::Variable, (0.0, 0.2), 0.377_416),
        (Damping::Constant, (0.3, 0.3), 0.883_772),
    ] {
        let found = worn(damping, 0.0, wear).wedge_rise() / INCH;
        assert!((found - rise).abs() < 1e-6, "{found} is not {rise}");
    }
}

#[test]
fn a_wedge_on_stiff_contacts_rises_by_the_closed_form() {
    for damping in BOTH {
        for toe in [-TOE, 0.0, TOE] {
            let height = |wear| {
                let mut parameters = worn(damping, toe, wear);
                parameters.contact.stiffness *= 1000.0;
                let expected = parameters.wedge_rise();
                let mut wedge = Wedge::new(parameters).unwrap();
                let start = wedge.initial_state.clone();
                let observation = wedge.system.observe(0.0, &start);
                (observation.bodies[WEDGE].coordinates[2] / INCH, expected / INCH)
            };
            let (unworn, _) = height((0.0, 0.0));
            for wear in WEARS {
                let (found, expected) = height(wear);
                let rise = found - unworn;
                assert!(
                    (rise - expected).abs() < 3e-5,
                    "{damping:?} {toe} {wear:?}: {rise} {expected}"
                );
            }
        }
    }
}

/// With elastic contacts penetration counts like wear that is negative for the gap: the wedge stands higher
/// by the rise of the depths N_c/k and N_s/k. The forces are those of statics without friction under F =
/// F_nominal - W - K z, so that the height is one linear equation. With toe, a wedge that is held upright
/// bears on two corners of the column only, which lie (h2/2) sin φ deeper. The coil leans as the wedge moves
/// along x; that is left out here.
#[test]
fn a_wedge_on_elastic_contacts_rises_by_the_closed_form() {
    for damping in BOTH {
        for toe in [-TOE, 0.0, TOE] {
            for wear in WEARS {
                let parameters = worn(damping, toe, wear);
                let (theta, k) = (parameters.wedge.angle, 4.0 * 2.5e5);
                // lbf, in; the height counts from the nominal position.
                let (coil, height) = match damping {
                    Damping::Variable => (3000.0, -2.0),
                    Damping::Constant => (1979.0, 0.3),
                };
                let preload = match damping {
                    Damping::Variable => 0.0,
                    Damping::Constant => 3702.2,
                };
                // The wedge follows the bolster along the column: at toe, less than it in z.
                let follows = height * theta.sin() / (theta + toe).sin();
                let free = match damping {
                    Damping::Variable => follows,
                    Damping::Constant => follows - height,
                };
                let slope = 1.0 / (theta.sin() + theta.cos() * toe.tan());
                let column = slope * theta.cos() / toe.cos();
                let corners = if toe == 0.0 { 1.0 } else { 2.0 };
                let give = (corners * column * theta.cos() + slope * toe.cos()) / (k * (theta + toe).sin());
                let inside = 0.5 * 6.125 * toe.sin().abs() * theta.cos() / (theta + toe).sin();
                let rise = parameters.wedge_rise() / INCH - inside;
                // z = follows + rise + give F with F = preload - W - coil (free + z - follows).
                let load = preload - 50.0 - coil * free;
                let above = (rise + give * load) / (1.0 + give * coil);
                let mut wedge = Wedge::new(parameters).unwrap();
                let start = wedge.initial_state.clone();
                let observation = wedge.system.observe(0.0, &start);
                let found = observation.bodies[WEDGE].coordinates[2] / INCH - follows;
                // The give is 0.01 to 0.03 in: it is there, and to 2 %.
                assert!(above - rise > 0.005, "{above} {rise}");
                assert!(
                    (found - above).abs() < 4e-4,
                    "{damping:?} {toe} {wear:?}: {found} in, expected {above}"
                );
            }
        }
    }
}

#[test]
fn wear_that_is_negative_is_refused() {
    for (path, wear) in [
        ("wedge.column_wear", (-0.1, 0.0)),
        ("wedge.slope_wear", (0.0, -0.1)),
    ] {
        let error = worn(Damping::Variable, 0.0, wear).validate().unwrap_err();
        assert_eq!(error.path, path);
        assert!(error.to_string().contains("zero or positive"));
    }
}
