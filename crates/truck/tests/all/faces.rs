//! Crowned faces and grids of the wedges of a truck: all four mounts see the same.

use crate::common;
use common::INCH;
use mechanics::spline::Spline;
use mechanics::surface::SurfaceProfile;
use mechanics::system::StaticFriction;
use truck::{Bolster, Lading, Parameters, Truck};
use wedge::face::{FaceDirection, FaceProfile, FaceProperties, Grid, Pad};
use wedge::parameters::{Damping, Start};

/// Returns a table of depths that is deeper at one end.
fn sloping(direction: FaceDirection) -> FaceProfile {
    let places = [-7.0, -2.0, 2.0, 7.0].map(|place| place * INCH);
    let depths = [0.03, 0.004, 0.001, 0.006].map(|depth| depth * INCH);
    FaceProfile {
        profile: SurfaceProfile::Table(Spline::new(places.to_vec(), depths.to_vec()).unwrap()),
        direction,
        ..FaceProfile::default()
    }
}

fn with_faces(damping: Damping, face: &FaceProperties) -> Parameters {
    let mut parameters = Parameters {
        bolster: Bolster::with_half_car(Lading::Loaded),
        ..Parameters::new(damping).with_wedge_friction(0.0)
    };
    for wedge in &mut parameters.wedges {
        wedge.column_face = face.clone();
        wedge.slope_face = face.clone();
    }
    parameters
}

/// Deeper above or below, all four wedges lie alike; deeper on one side, those across from each other do,
/// which half a turn about z exchanges.
#[test]
fn analytic_profiles_follow_the_wedges_however_they_are_mounted() {
    for (direction, both) in [
        (FaceDirection::Up, false),
        (FaceDirection::Across, false),
        (FaceDirection::Across, true),
    ] {
        let mut face = FaceProperties {
            grid: Grid { up: 7, across: 7 },
            counterface: sloping(direction),
            ..FaceProperties::default()
        };
        if both {
            face.wedge_surface = sloping(direction);
        }
        let mut truck = Truck::new(&with_faces(Damping::Constant, &face)).unwrap();
        let x = truck.system.initial_state();
        let rest = truck
            .system
            .equilibrium(0.0, &x, StaticFriction::Without)
            .unwrap();
        let observation = truck.system.observe(0.0, &rest);
        // Points in the order of the grid, which is that of the wedge's own axes.
        let normals = |face: usize| -> Vec<f64> {
            observation.faces[face]
                .points
                .iter()
                .map(|point| point.normal)
                .collect()
        };
        // leading left, leading right, trailing left, trailing right: column and slope of each
        let pairs: &[[usize; 2]] = match direction {
            FaceDirection::Up => &[[0, 6], [1, 7], [2, 4], [3, 5], [0, 2], [1, 3]],
            FaceDirection::Across => &[[0, 6], [1, 7], [2, 4], [3, 5]],
        };
        for [a, b] in pairs {
            let (own, other) = (normals(*a), normals(*b));
            let most = own.iter().fold(0.0, |most: f64, force| most.max(*force));
            assert!(most > 100.0);
            for (own, other) in own.iter().zip(&other) {
                assert!(
                    (own - other).abs() < 1e-4 * most,
                    "{direction:?} {a} {b}: {own} {other}"
                );
            }
        }
        // The sides are told apart.
        let column = normals(0);
        let (one, other) = match direction {
            FaceDirection::Up => (column[0] + column[1], column[2] + column[3]),
            FaceDirection::Across => (column[0] + column[2], column[1] + column[3]),
        };
        assert!((one - other).abs() > 0.0 || column[0] == 0.0);
    }
}

#[test]
fn limits_a_truck_with_refined_wedges_starts_touching_and_leaves_out_what_joins_one_body() {
    let face = FaceProperties {
        grid: Grid { up: 5, across: 3 },
        counterface: FaceProfile {
            profile: SurfaceProfile::Arc {
                curvature: 1.0 / (70.0 * INCH),
            },
            direction: FaceDirection::Across,
            ..FaceProfile::default()
        },
        pad: Some(Pad {
            stiffness: 1e8,
            damping: 1e3,
            hardening: None,
            friction: 0.3,
            shear: None,
        }),
        ..FaceProperties::default()
    };
    for damping in [Damping::Constant, Damping::Variable] {
        let mut parameters = with_faces(damping, &face);
        parameters.start = Start::Touching;
        parameters.wedges[1].toe = 0.003;
        let mut truck = Truck::new(&parameters).unwrap();
        let start = truck.initial_state.clone();
        let observation = truck.system.observe(0.0, &start);
        for face in &observation.faces[..8] {
            assert!(face.points.iter().all(|point| point.gap > -1e-9));
        }
        assert_eq!(truck.system.faces()[1].element.coefficient, 0.3);
        assert_eq!(
            truck.system.faces()[8].element.surface,
            mechanics::contact::Interface::default()
        );
    }
}
