//! Time per step of the integrator beyond the problem's own calls.

#![allow(clippy::unwrap_used)] // it may stop where it stands

use std::hint::black_box;
use std::time::Instant;

use integrate::{EventGroup, Integrator, Method, Options, Problem, ProblemStructure};

use numerics::{BlockLu, Singular};

/// 14 linear states: 10 that decay by themselves, 4 that are coupled.
struct Trivial {
    lu: BlockLu,
    shift: f64,
    discrete_states: usize,
}

impl Problem for Trivial {
    fn structure(&self) -> ProblemStructure {
        let group = EventGroup {
            discrete_states: 0..self.discrete_states,
            variables: 0..self.discrete_states,
            states: std::iter::once(0..14).collect(),
        };
        ProblemStructure {
            event_groups: vec![group],
            ..ProblemStructure::new(vec![1.0; 14])
        }
    }
    #[inline]
    fn derivative(&mut self, _: f64, x: &[f64], dx: &mut [f64]) {
        for (d, x) in dx.iter_mut().zip(x) {
            *d = -x;
        }
    }
    fn linearize(&mut self, _: f64, _: &[f64], _: &[f64], _: &mut [f64]) {
        self.lu.clear();
        let block = self.lu.at_mut(0);
        for i in 0..4 {
            block[5 * i] = -1.0;
        }
    }
    #[inline]
    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.shift = 1.0 / (shift + 1.0);
        self.lu.factor_shifted(shift)
    }
    #[inline]
    fn solve(&mut self, b: &mut [f64]) {
        let (free, coupled) = b.split_at_mut(10);
        for value in free {
            *value *= self.shift;
        }
        self.lu.solve(coupled);
    }
    fn event_variables(&mut self, _: Option<usize>, _: f64, x: &[f64], variables: &mut [f64]) {
        variables.copy_from_slice(&x[..self.discrete_states]);
    }
    fn event_functions(&mut self, _: usize, variables: &[f64], _: &[u8], functions: &mut [f64]) {
        for (function, variable) in functions.iter_mut().zip(variables) {
            *function = variable.abs() + 1.0;
        }
    }
}

fn problem(discrete_states: usize) -> Trivial {
    Trivial {
        lu: BlockLu::new(&[4], &[]),
        shift: 0.0,
        discrete_states,
    }
}

fn nanoseconds(count: u32, mut action: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..9 {
        let start = Instant::now();
        for _ in 0..count {
            action();
        }
        best = best.min(start.elapsed().as_secs_f64() * 1e9 / f64::from(count));
    }
    best
}

fn main() {
    let mut p = problem(0);
    let (x, mut y, mut f) = ([0.5; 14], [0.0; 14], [0.0; 14]);
    p.linearize(0.0, &x, &y, &mut f);
    let derivative = nanoseconds(200_000, || p.derivative(0.0, black_box(&x), black_box(&mut y)));
    let linearize = nanoseconds(200_000, || {
        p.linearize(0.0, black_box(&x), black_box(&y), black_box(&mut f))
    });
    let factor = nanoseconds(200_000, || {
        let _ = black_box(p.factor(black_box(100.0)));
    });
    let solve = nanoseconds(200_000, || p.solve(black_box(&mut y)));
    println!(
        "problem: derivative {derivative:.1} linearize {linearize:.1} factor {factor:.1} solve {solve:.1} ns"
    );
    for n in 1..=8 {
        let mut lu = BlockLu::new(&[n], &[]);
        for (i, value) in lu.at_mut(0).iter_mut().enumerate() {
            *value = libm::sin(i as f64 * 1.7) - if i % (n + 1) == 0 { 3.0 } else { 0.0 };
        }
        let mut b = vec![1.0; n];
        let factor = nanoseconds(200_000, || {
            let _ = black_box(black_box(&mut lu).factor_shifted(black_box(10.0)));
        });
        let solve = nanoseconds(200_000, || {
            b.fill(1.0);
            black_box(&lu).solve(black_box(&mut b));
        });
        println!("block {n}: factor {factor:.1} ns, solve {solve:.1} ns");
    }
    let chain: Vec<_> = (1..200).map(|i| (i - 1, i)).collect();
    let mut lu = BlockLu::new(&[4; 200], &chain);
    for i in 0..200 {
        for j in [i.max(1) - 1, (i + 1).min(199)] {
            lu.block_mut(i, j).unwrap()[0] = 1.0;
        }
    }
    let mut b = vec![1.0; 800];
    let chain_factor = nanoseconds(200, || {
        let _ = black_box(lu.factor_shifted(black_box(10.0)));
    });
    let chain_solve = nanoseconds(200, || lu.solve(black_box(&mut b)));
    println!(
        "chain of 200: factor {:.1} ns, solve {:.1} ns per block",
        chain_factor / 200.0,
        chain_solve / 200.0
    );
    for method in Method::ALL {
        for discrete_states in [0, 4] {
            let options = Options {
                method,
                fixed_step: Some(1e-9),
                ..Options::default()
            };
            let mut integrator = Integrator::new(problem(discrete_states), options, 0.0, &x).unwrap();
            let step = nanoseconds(100_000, || integrator.step_to(f64::INFINITY).unwrap());
            let s = method.tableau().stages() as f64;
            let own = s * (derivative + solve) + linearize + factor;
            println!(
                "{method} {discrete_states} discrete states: {step:.0} ns per step, {:.0} beyond the \
                 problem's calls",
                step - own
            );
        }
    }
}
