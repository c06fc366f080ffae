//! `calls KIND NUMBER`: calls the wedge's `right-hand-side` or `jacobian` that many times, for counting
//! instructions.

use std::hint::black_box;
use std::process::ExitCode;

use benchmarks::sliding_wedge;
use integrate::Problem;
use wedge::parameters::Damping;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [kind, number] = arguments.as_slice() else {
        eprintln!("usage: calls right-hand-side|jacobian NUMBER");
        return ExitCode::from(2);
    };
    let (Ok(number), Ok((mut wedge, x))) = (number.parse::<u32>(), sliding_wedge(Damping::Variable)) else {
        eprintln!("NUMBER must be a whole number");
        return ExitCode::from(2);
    };
    let system = &mut wedge.system;
    system.next_time_discontinuity(0.0);
    let (mut dx, mut df_dt) = (vec![0.0; x.len()], vec![0.0; x.len()]);
    let mut time = 2.0;
    for _ in 0..number {
        time += 1e-9;
        if kind == "jacobian" {
            df_dt.fill(0.0);
            system.linearize(time, black_box(&x), &dx, &mut df_dt);
        } else {
            system.derivative(time, black_box(&x), &mut dx);
        }
        black_box((&dx, &df_dt));
    }
    ExitCode::SUCCESS
}
