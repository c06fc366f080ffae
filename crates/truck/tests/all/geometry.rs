//! Where the parts of a truck are: places of bodies, adapters and columns, and what hangs on them.

use crate::common;
use common::{INCH, POUND_FORCE};
use mechanics::motion::Motion;
use truck::{BOLSTER, Geometry, Parameters, SIDE_FRAMES, Truck, WEDGES, WHEELSETS};
use wedge::parameters::Damping;

/// A truck of other places.
fn other() -> Geometry {
    Geometry {
        wheelbase: 72.0 * INCH,
        nest_distance: 78.0 * INCH,
        journal_distance: 80.0 * INCH,
        axle_height: 19.0 * INCH,
        wedge_distance: 9.0 * INCH,
        wedge_height: 18.5 * INCH,
        seat_height: 12.0 * INCH,
        gib_height: 17.0 * INCH,
        land_height: 17.5 * INCH,
        lands: [6.5 * INCH, 2.5 * INCH],
        adapter_height: 23.5 * INCH,
        adapter: [2.5 * INCH, 1.5 * INCH],
    }
}

/// Bodies and the points of adapters are where the geometry says.
#[test]
fn analytic_bodies_and_adapters_are_where_the_geometry_says() {
    for geometry in [Geometry::default(), other()] {
        let parameters = Parameters {
            geometry,
            ..Parameters::new(Damping::Variable)
        };
        let truck = Truck::new(&parameters).unwrap();
        let seen = truck.system.clone().observe(0.0, &truck.initial_state);
        let place = |body: usize| seen.bodies[body].center_of_gravity.0.map(|own| own / INCH);
        let near = |found: [f64; 3], expected: [f64; 3]| {
            for (a, b) in found.iter().zip(expected) {
                assert!((a - b / INCH).abs() < 1e-9, "{found:?} {expected:?}");
            }
        };
        let [axle, nest] = [0.5 * geometry.wheelbase, 0.5 * geometry.nest_distance];
        near(place(WHEELSETS), [axle, 0.0, geometry.axle_height]);
        near(place(WHEELSETS + 1), [-axle, 0.0, geometry.axle_height]);
        near(place(SIDE_FRAMES), [0.0, nest, 18.0 * INCH]);
        let wedge = [geometry.wedge_distance, nest, geometry.wedge_height];
        near(place(WEDGES), wedge);
        near(place(WEDGES + 3), [-wedge[0], -wedge[1], wedge[2]]);
        near(place(BOLSTER), [0.0, 0.0, 22.0 * INCH]);
        // Faces: two of each wedge, then the adapters, left ones first.
        let points = |face: usize| seen.faces[face].point_positions.iter().map(|own| own.0);
        for (face, [end, side]) in (8..).zip([[1.0, 1.0], [-1.0, 1.0], [1.0, -1.0], [-1.0, -1.0]]) {
            let journal = 0.5 * side * geometry.journal_distance;
            let [aside, _] = geometry.adapter;
            for (found, shift) in points(face).zip([aside, -aside]) {
                let expected = [end * axle, journal + shift, geometry.adapter_height];
                near(found.map(|own| own / INCH), expected);
            }
        }
    }
}

/// The shear of load coils resists yaw of the bolster by the squares of their distances from its center.
#[test]
fn analytic_coil_shear_by_the_places_of_nests() {
    let yaw = 1e-5;
    for geometry in [Geometry::default(), other()] {
        let mut parameters = Parameters {
            geometry,
            ..Parameters::new(Damping::Variable)
        };
        parameters.bolster.motion.coordinates[5] = Motion::Constant(yaw);
        for frame in &mut parameters.side_frames {
            frame.free = [false; 6];
        }
        let truck = Truck::new(&parameters).unwrap();
        let seen = truck.system.clone().observe(0.0, &truck.initial_state);
        let moment = truck.loads(&seen).warp_moment.load_coils;
        let shear = 3616.0 * POUND_FORCE / INCH;
        let squares: f64 = [1.0, -1.0]
            .iter()
            .map(|side| {
                let y = 0.5 * geometry.nest_distance + side * 3.75 * INCH;
                4.0 * (y * y + (3.75 * INCH).powi(2))
            })
            .sum();
        let expected = -shear * squares * yaw;
        assert!((moment / expected - 1.0).abs() < 1e-6, "{moment} {expected}");
    }
}
