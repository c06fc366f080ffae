//! The block-sparse factorization agrees with dense elimination.

use numerics::{BlockLu, Singular};
use proptest::prelude::*;

/// Dense solution with full pivoting by rows, written independently.
fn dense_solve(mut a: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for k in 0..n {
        let best = (k..n)
            .max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))
            .unwrap();
        a.swap(k, best);
        b.swap(k, best);
        for i in k + 1..n {
            let factor = a[i][k] / a[k][k];
            for j in k..n {
                let value = a[k][j];
                a[i][j] -= factor * value;
            }
            b[i] -= factor * b[k];
        }
    }
    for k in (0..n).rev() {
        for j in k + 1..n {
            b[k] -= a[k][j] * b[j];
        }
        b[k] /= a[k][k];
    }
    b
}

#[derive(Debug, Clone)]
struct Pattern {
    sizes: Vec<usize>,
    couplings: Vec<(usize, usize)>,
    seed: u64,
}

fn patterns() -> impl Strategy<Value = Pattern> {
    (1usize..9).prop_flat_map(|count| {
        let sizes = prop::collection::vec(prop_oneof![6 => 1usize..=6, 1 => 7usize..=9], count);
        let couplings = prop::collection::vec((0..count, 0..count), 0..2 * count);
        (sizes, couplings, any::<u64>()).prop_map(|(sizes, couplings, seed)| Pattern {
            sizes,
            couplings,
            seed,
        })
    })
}

/// Numbers between -1 and 1 from a linear congruence.
fn numbers(mut seed: u64) -> impl FnMut() -> f64 {
    move || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

proptest! {
    #[test]
    fn random_patterns_agree_with_dense_elimination(pattern in patterns(), shifted in any::<bool>()) {
        let Pattern { sizes, couplings, seed } = pattern;
        let mut number = numbers(seed);
        let mut lu = BlockLu::new(&sizes, &couplings);
        let starts: Vec<usize> = sizes.iter().scan(0, |at, size| { *at += size; Some(*at - size) }).collect();
        let n = lu.dimension();
        let mut dense = vec![vec![0.0; n]; n];
        for i in 0..sizes.len() {
            for j in 0..sizes.len() {
                let coupled = i == j || couplings.contains(&(i, j)) || couplings.contains(&(j, i));
                prop_assert_eq!(lu.find(i, j).is_some(), coupled);
                let Some(block) = lu.block_mut(i, j) else { continue };
                prop_assert_eq!(block.len(), sizes[i] * sizes[j]);
                for r in 0..sizes[i] {
                    for c in 0..sizes[j] {
                        // diagonal blocks that need exchanges of rows: dominated by their antidiagonal
                        let antidiagonal = i == j && r + c + 1 == sizes[i] && !shifted;
                        let value = 0.1 * number() + if antidiagonal { 4.0 + number() } else { 0.0 };
                        block[r * sizes[j] + c] = value;
                        dense[starts[i] + r][starts[j] + c] = value;
                    }
                }
            }
        }
        let b: Vec<f64> = (0..n).map(|_| number()).collect();
        let mut x = b.clone();
        if shifted {
            for (i, row) in dense.iter_mut().enumerate() {
                row.iter_mut().for_each(|value| *value = -*value);
                row[i] += 5.0;
            }
            lu.factor_shifted(5.0).unwrap();
        } else {
            lu.factor().unwrap();
        }
        lu.solve(&mut x);
        for (x, exact) in x.iter().zip(dense_solve(dense, b)) {
            prop_assert!((x - exact).abs() < 1e-12 * (1.0 + exact.abs()), "{} {}", x, exact);
        }
    }
}

#[test]
fn a_chain_has_no_fill() {
    for count in [50, 100, 200] {
        let couplings: Vec<_> = (1..count).map(|i| (i - 1, i)).collect();
        let lu = BlockLu::new(&vec![4; count], &couplings);
        assert_eq!(lu.stored(), 16 * (count + 2 * (count - 1)));
    }
    // a star, whose centre must come last
    let couplings: Vec<_> = (1..50).map(|i| (0, i)).collect();
    assert_eq!(BlockLu::new(&[3; 50], &couplings).stored(), 9 * (50 + 2 * 49));
}

#[test]
fn singular_blocks_are_reported() {
    for n in [1, 2, 3, 4, 5, 6, 8] {
        let mut lu = BlockLu::new(&[2, n], &[(0, 1)]);
        lu.block_mut(0, 0).unwrap().copy_from_slice(&[1.0, 0.0, 0.0, 1.0]);
        assert_eq!(lu.factor(), Err(Singular { block: 1 }), "size {n}");
        let block = lu.block_mut(1, 1).unwrap();
        for i in 0..n {
            block[i * (n + 1)] = 2.0;
        }
        assert_eq!(lu.factor(), Ok(()));
        lu.block_mut(1, 1).unwrap()[0] = f64::NAN;
        assert_eq!(lu.factor(), Err(Singular { block: 1 }));
        lu.clear();
        assert!(lu.factor().is_err());
        assert_eq!(lu.factor_shifted(1.0), Ok(()));
    }
}

#[test]
fn the_matrix_survives_its_factorization() {
    let mut lu = BlockLu::new(&[3, 2], &[(0, 1)]);
    let slot = lu.slot(0, 1);
    lu.at_mut(slot)[3] = 7.0;
    lu.factor_shifted(10.0).unwrap();
    assert_eq!(lu.block_mut(0, 1).unwrap(), &[0.0, 0.0, 0.0, 7.0, 0.0, 0.0]);
    assert_eq!(lu.find(0, 2), None);
}
