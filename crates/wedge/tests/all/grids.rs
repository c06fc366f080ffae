//! Faces with grids of points: sums, convergence with the number of points.

use mechanics::system::{ContactState, SystemLoads};
use wedge::face::Grid;
use wedge::outputs::{FACES, Outputs, PointNames};
use wedge::parameters::Damping;
use wedge::{Parameters, Start, Wedge, thesis};

/// Returns a wedge with yaw and toe between its neighbors, settled, with n × n points on both faces.
fn settled(up: usize, across: usize) -> Parameters {
    let mut parameters = thesis::parameters(Damping::Constant, 0.002, 0.004);
    parameters.start = Start::Equilibrium;
    parameters.column_face.grid = Grid { up, across };
    parameters.slope_face.grid = Grid { up, across };
    parameters
}

#[test]
fn analytic_pressures_add_up_to_the_forces_of_the_faces() {
    let parameters = settled(5, 4);
    let mut wedge = Wedge::new(parameters.clone()).unwrap();
    let outputs = Outputs::new(&parameters);
    let observation = wedge.system.observe(0.0, &wedge.initial_state);
    let states = vec![ContactState::Stick as u8; wedge.system.point_count()];
    let mut row = Vec::new();
    outputs.values(&wedge.system, &observation, &states, 0.0, &mut row);
    let mut loads = SystemLoads::default();
    wedge.system.loads(0.0, &wedge.initial_state, &mut loads);
    let faces = [&parameters.column_face, &parameters.slope_face];
    for (face, name) in FACES.into_iter().enumerate() {
        let areas = faces[face].areas(&parameters.rectangles()[face]);
        let points = faces[face].grid.points();
        let total: f64 = points
            .iter()
            .zip(&areas)
            .map(|(point, area)| {
                let column = format!("{name}_{}_pressure", point.number());
                let index = outputs
                    .columns()
                    .iter()
                    .position(|own| own.name == column)
                    .unwrap();
                row[index] * area
            })
            .sum();
        let SystemLoads { faces: seen, .. } = &loads;
        let normal = seen[face].normal.dot::<f64, f64>(seen[face].normal).sqrt();
        assert!(normal > 1000.0);
        assert!(
            (total - normal).abs() < 1e-12 * normal,
            "{name}: {total} {normal}"
        );
    }
    // Every state has its column, once: corners with all their columns, all points with pressure and state.
    let names: Vec<&str> = outputs
        .columns()
        .iter()
        .map(|column| column.name.as_str())
        .collect();
    assert_eq!(
        names.iter().filter(|name| name.ends_with("_pressure")).count(),
        40
    );
    assert_eq!(
        names.iter().filter(|name| name.ends_with("_state")).count(),
        40 + 8
    );
    let unique: std::collections::BTreeSet<&&str> = names.iter().collect();
    assert_eq!(unique.len(), names.len());
    let points = PointNames::new(&parameters);
    assert_eq!((points.range(0), points.range(1)), (0..20, 20..40));
    assert_eq!(points.face_and_name(3), (0, "upper_left"));
    assert_eq!(points.face_and_name(20), (1, "lower_right"));
}

#[test]
fn convergence_of_a_settled_wedge_with_the_number_of_points() {
    // The force of the column in equilibrium, and how the wedge lies.
    let found = |n: usize| -> [f64; 3] {
        let mut wedge = Wedge::new(settled(n, n)).unwrap();
        let observation = wedge.system.observe(0.0, &wedge.initial_state);
        let [x, _, z, _, _, yaw] = observation.bodies[wedge::WEDGE].coordinates;
        [x, z, yaw]
    };
    let fine = found(65);
    let error = |n: usize| -> [f64; 3] {
        let own = found(n);
        std::array::from_fn(|k| (own[k] - fine[k]).abs())
    };
    let [coarse, middle, good] = [5, 9, 17].map(error);
    for k in 0..3 {
        // Pressure ends inside the faces, so that the order is 2 on average, not from grid to grid.
        assert!(
            good[k] < 0.15 * coarse[k].max(1e-3 * fine[k].abs()),
            "{k}: {coarse:?} {middle:?} {good:?} {fine:?}"
        );
        assert!(good[k] < 5e-3 * fine[k].abs(), "{k}: {good:?} {fine:?}");
    }
}
