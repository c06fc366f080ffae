//! The right-hand side and the Jacobian of the wedge, in ns.
#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use integrate::Problem;
use std::hint::black_box;
use wedge::parameters::Damping;
use wedge::{Wedge, thesis};

fn wedge(c: &mut Criterion) {
    for damping in [Damping::Variable, Damping::Constant] {
        // A state in the middle of a branch, pressed into both faces, sliding.
        let mut wedge = Wedge::new(thesis::parameters(damping, 0.003, 0.012)).unwrap();
        let mut x = wedge.initial_state.clone();
        x[1] = 2e-5;
        x[3] = 0.006;
        x[5] = -0.04;
        let system = &mut wedge.system;
        system.segment(0.0);
        let (mut dx, mut df_dt) = (vec![0.0; x.len()], vec![0.0; x.len()]);
        let mut time = 2.0;
        c.bench_function(&format!("right-hand side, {damping:?}"), |b| {
            b.iter(|| {
                time += 1e-9;
                system.derivative(time, black_box(&x), &mut dx);
                dx[4]
            });
        });
        c.bench_function(&format!("jacobian, {damping:?}"), |b| {
            b.iter(|| {
                time += 1e-9;
                df_dt.fill(0.0);
                system.linearize(time, black_box(&x), &dx, &mut df_dt);
                df_dt[4]
            });
        });
        c.bench_function(&format!("factor and solve, {damping:?}"), |b| {
            b.iter(|| {
                system.factor(black_box(4e4)).unwrap();
                df_dt.copy_from_slice(&dx);
                system.solve(&mut df_dt);
                df_dt[4]
            });
        });
    }
}

criterion_group!(benches, wedge);
criterion_main!(benches);
