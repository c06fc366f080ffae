//! analytic: the solution with positions, internal states and quadratures eliminated is that of the whole
//! matrix, for one body (which has a path of its own, up to six coordinates) and for several.

use numerics::BlockLu;
use numerics::partitioned::{Partitioned, Structure};

/// Numbers in -1 .. 1 without pattern.
fn numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Returns a structured matrix filled with numbers, the whole of `shift I - J` with the rows of the speeds
/// multiplied with M, and M.
fn filled(
    structure: &Structure,
    shift: f64,
    mut number: impl FnMut() -> f64,
) -> (Partitioned, Vec<Vec<f64>>, Vec<Vec<f64>>) {
    let mut partitioned = Partitioned::new(structure);
    let layout = partitioned.layout();
    let (n, q, u) = (layout.len(), 0, layout.speeds);
    let (s, w) = (2 * u, 2 * u + layout.internals);
    let offset = |body: usize| structure.bodies[..body].iter().sum::<usize>();
    // shift I - J, the rows of the speeds multiplied with M
    let mut whole = vec![vec![0.0; n]; n];
    let mut mass = vec![vec![0.0; u]; u];
    for (k, row) in whole.iter_mut().enumerate() {
        row[k] = shift;
        if k < u {
            row[u + k] = -1.0;
        }
    }
    for (body, &size) in structure.bodies.iter().enumerate() {
        for (k, value) in partitioned.mass_mut(body).iter_mut().enumerate() {
            let (i, j) = (offset(body) + k / size, offset(body) + k % size);
            *value = if i == j { 3.0 + number() } else { 0.3 * number() };
            mass[i][j] = *value;
            whole[u + i][u + j] = shift * *value;
        }
    }
    for row in 0..structure.bodies.len() {
        for column in 0..structure.bodies.len() {
            let Some(pair) = partitioned.find_pair(row, column) else {
                continue;
            };
            let size = structure.bodies[column];
            let (stiffness, damping) = partitioned.blocks_mut(pair);
            for (k, (stiffness, damping)) in stiffness.iter_mut().zip(damping).enumerate() {
                (*stiffness, *damping) = (5.0 * number(), number());
                let (i, j) = (u + offset(row) + k / size, offset(column) + k % size);
                whole[i][q + j] -= *stiffness;
                whole[i][u + j] -= *damping;
            }
        }
    }
    for (group, bodies) in structure.internal_pairs.iter().enumerate() {
        let own = s + 2 * group;
        for (k, value) in partitioned.internal_mut(group).iter_mut().enumerate() {
            *value = number();
            whole[own + k / 2][own + k % 2] -= *value;
        }
        for (side, body) in bodies.iter().enumerate() {
            let size = structure.bodies[*body];
            let [by_position, by_speed, force] = partitioned.side_mut(group, side);
            for k in 0..2 * size {
                (by_position[k], by_speed[k], force[k]) = (number(), number(), number());
                let (i, j) = (own + k / size, offset(*body) + k % size);
                whole[i][q + j] -= by_position[k];
                whole[i][u + j] -= by_speed[k];
                whole[u + j][i] -= force[k];
            }
        }
    }
    for (row, (quadrature, body)) in structure.quadrature_bodies.iter().enumerate() {
        let (by_position, by_speed) = partitioned.row_mut(row);
        for (k, (by_position, by_speed)) in by_position.iter_mut().zip(by_speed).enumerate() {
            (*by_position, *by_speed) = (number(), number());
            whole[w + quadrature][q + offset(*body) + k] -= *by_position;
            whole[w + quadrature][u + offset(*body) + k] -= *by_speed;
        }
    }
    for (row, (quadrature, group)) in structure.quadrature_pairs.iter().enumerate() {
        for (k, value) in partitioned.internal_row_mut(row).iter_mut().enumerate() {
            *value = number();
            whole[w + quadrature][s + 2 * group + k] -= *value;
        }
    }
    (partitioned, whole, mass)
}

fn numbers_of(structure: &Structure, shift: f64) -> impl FnMut() -> f64 {
    numbers(shift.to_bits() ^ structure.quadratures as u64)
}

/// Fills a structured matrix with numbers and solves; the largest difference from the solution of the whole
/// matrix.
fn difference(structure: &Structure, shift: f64) -> f64 {
    let mut number = numbers_of(structure, shift);
    let (mut partitioned, whole, mass) = filled(structure, shift, &mut number);
    let (n, u) = (partitioned.layout().len(), partitioned.layout().speeds);
    let mut found: Vec<f64> = (0..n).map(|_| number()).collect();
    let mut exact = found.clone();
    for i in 0..u {
        exact[u + i] = (0..u).map(|j| mass[i][j] * found[u + j]).sum();
    }
    let mut dense = BlockLu::new(&[n], &[]);
    dense.block_mut(0, 0).unwrap().copy_from_slice(&whole.concat());
    dense.factor().unwrap();
    dense.solve(&mut exact);
    partitioned.factor(shift).unwrap();
    partitioned.solve(&mut found);
    found
        .iter()
        .zip(&exact)
        .map(|(found, exact)| (found - exact).abs())
        .fold(0.0, f64::max)
}

#[test]
fn one_body_is_solved_as_the_whole_matrix() {
    for size in 1..=8 {
        for quadratures in 0..=7 {
            let structure = Structure {
                bodies: vec![size],
                quadratures,
                // one quadrature has no derivative, one has two parts
                quadrature_bodies: (1..quadratures)
                    .chain(2..3.min(quadratures))
                    .map(|k| (k, 0))
                    .collect(),
                ..Structure::default()
            };
            for shift in [7.0, 100.0] {
                let error = difference(&structure, shift);
                assert!(
                    error < 1e-14,
                    "{size} coordinates, {quadratures} quadratures: {error}"
                );
            }
        }
    }
}

#[test]
fn other_structures_are_solved_as_the_whole_matrix() {
    let bristles = |bodies: Vec<usize>, internal_pairs: Vec<Vec<usize>>| Structure {
        quadrature_bodies: (0..bodies.len()).map(|k| (k % 3, k)).collect(),
        quadrature_pairs: vec![(1, 0), (2, 0)],
        quadratures: 3,
        couplings: vec![(0, bodies.len() - 1)],
        bodies,
        internal_pairs,
    };
    let structures = [
        bristles(vec![4], vec![vec![0], vec![0]]),
        bristles(vec![4, 4], vec![vec![0, 1]]),
        bristles(vec![2, 5, 3], vec![vec![1], vec![0, 2]]),
        // Six coordinates wherever there are internal states, and one pair of these by itself.
        bristles(vec![6, 6, 2, 6], vec![vec![0, 1], vec![], vec![3, 0], vec![1]]),
    ];
    for structure in &structures {
        for shift in [20.0, 100.0] {
            let error = difference(structure, shift);
            assert!(error < 1e-13, "{structure:?}: {error}");
        }
    }
}

#[test]
fn a_singular_body_is_reported() {
    let mut partitioned = Partitioned::new(&Structure {
        bodies: vec![4],
        ..Structure::default()
    });
    assert_eq!(partitioned.factor(1.0).unwrap_err().block, 0);
}
