//! The right-hand side, the Jacobian and one factorization with a solution, of the wedge and of the
//! half-truck, in ns.
#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use benchmarks::{sliding_truck, sliding_wedge};
use criterion::{Criterion, criterion_group, criterion_main};
use integrate::Problem;
use wedge::parameters::Damping;

fn wedge(c: &mut Criterion) {
    for damping in [Damping::Variable, Damping::Constant] {
        let (mut wedge, x) = sliding_wedge(damping).unwrap();
        let system = &mut wedge.system;
        system.next_time_discontinuity(0.0);
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

fn half_truck(c: &mut Criterion) {
    for name in ["nucars_68_constant_toe_out", "nucars_69_constant_toe_out"] {
        let (mut system, x) = sliding_truck(name).unwrap();
        system.next_time_discontinuity(0.0);
        let (mut dx, mut df_dt) = (vec![0.0; x.len()], vec![0.0; x.len()]);
        let mut time = 2.0;
        c.bench_function(&format!("right-hand side, {name}"), |b| {
            b.iter(|| {
                time += 1e-9;
                system.derivative(time, black_box(&x), &mut dx);
                dx[20]
            });
        });
        c.bench_function(&format!("jacobian, {name}"), |b| {
            b.iter(|| {
                time += 1e-9;
                df_dt.fill(0.0);
                system.linearize(time, black_box(&x), &dx, &mut df_dt);
                df_dt[20]
            });
        });
        c.bench_function(&format!("factor and solve, {name}"), |b| {
            b.iter(|| {
                system.factor(black_box(1e4)).unwrap();
                df_dt.copy_from_slice(&dx);
                system.solve(&mut df_dt);
                df_dt[20]
            });
        });
    }
}

criterion_group!(benches, wedge, half_truck);
criterion_main!(benches);
