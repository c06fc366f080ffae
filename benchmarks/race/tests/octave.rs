//! The wedge's equations in Octave's language give the compiled rates. `cargo xtask test --only octave`
//! installs Octave and names it in `WEDGELAB_OCTAVE`.
#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used)]

use std::path::{Path, PathBuf};
use std::process::Command;

use integrate::Method;
use mechanics::friction::FrictionLaw;
use race::equations::Equations;
use race::measure::Judge;
use race::outcome::{Outcome, read_states, write_states};
use race::own;
use race::problem::RaceProblem;
use race::wedge_case::WedgeCase;
use study::case::builtin;
use wedge::parameters::Parameters;

/// By how much rates may differ, of what the forces at play would make without balancing each other.
const ROUNDING: f64 = 1e-10;

fn drivers() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("drivers")
}

/// Returns the output of an Octave that runs this driver.
fn octave(driver: &str, arguments: &[&str]) -> String {
    let program = std::env::var("WEDGELAB_OCTAVE").unwrap_or_else(|_| "octave-cli".to_owned());
    let output = Command::new(program)
        .args(["--no-init-file", "--quiet"])
        .arg(drivers().join(driver))
        .args(arguments)
        .output()
        .expect("Octave starts; `cargo xtask test --only octave` installs it");
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{complaint}");
    String::from_utf8(output.stdout).unwrap()
}

/// Returns a case as the drivers take it.
fn json(name: &str) -> String {
    WedgeCase::named(name).unwrap().json().unwrap()
}

/// Numbers of corners in each contact state; none may be zero.
#[derive(Default, Debug)]
struct Counts {
    open: usize,
    stick: usize,
    between: usize,
    slip: usize,
}

impl Counts {
    /// Counts the corners of a state: open, or by slip over reference speed. Says how large the rates would
    /// be if nothing balanced.
    fn count(
        &mut self,
        equations: &mut Equations,
        parameters: &Parameters,
        time: f64,
        z: &[f64],
    ) -> [f64; 9] {
        let FrictionLaw::Tanh { reference_speed } = parameters.column_friction.law else {
            panic!("the thesis's friction is tanh");
        };
        let x = equations.complete(z);
        let observation = equations.system().observe(time, &x);
        let wedge = &parameters.wedge;
        let mut forces = wedge.mass * parameters.gravity + observation.coils[0].coil.spring.abs();
        let mut power = 0.0;
        for point in observation.faces.iter().flat_map(|face| &face.points) {
            let slip = point.slip[0].hypot(point.slip[1]);
            let place = match slip / reference_speed {
                _ if point.normal <= 0.0 => &mut self.open,
                slip if slip < 0.5 => &mut self.stick,
                slip if slip < 3.0 => &mut self.between,
                _ => &mut self.slip,
            };
            *place += 1;
            forces += point.normal;
            power += parameters.column_friction.coefficient * point.normal * slip;
        }
        let (push, turn) = (forces / wedge.mass, 0.5 * forces * wedge.width / wedge.inertia[0]);
        [1.0, 1.0, 1.0, 1.0, push, push, turn, turn, power.max(1.0)]
    }
}

/// Times and states of a case: along a run of ours, and beside it, where corners open and close and slip in
/// all directions.
fn states_of(name: &str, equations: &Equations) -> Vec<(f64, Vec<f64>)> {
    let n = equations.dimension();
    let problem = RaceProblem::named(name).unwrap();
    let (_, states) = own::run(name, Method::Rodas5P, false, 1e-5, 60.0, 251).unwrap();
    let mut list = vec![(0.0, equations.start().to_vec())];
    for (number, row) in [5, 40, 100, 160, 220, 250].into_iter().enumerate() {
        let z = &states[row * n..(row + 1) * n];
        let time = problem.time(row);
        list.push((time, z.to_vec()));
        for (place, size) in [1e-7, 1e-4, 1e-2].into_iter().enumerate() {
            let moved = z.iter().enumerate().map(|(k, value)| {
                let angle = (1 + k + 7 * number + 31 * place) as f64;
                value + size * equations.scales()[k] * angle.sin()
            });
            list.push((time, moved.collect()));
        }
        // Hardly moving at all, where friction grows with the speed.
        for speed in [1e-6, 1e-5, 4e-5] {
            let mut slow = z.to_vec();
            slow[4..8]
                .iter_mut()
                .for_each(|rate| *rate = speed * rate.signum());
            list.push((0.25 * std::f64::consts::PI, slow));
        }
    }
    list
}

#[test]
#[ignore = "needs Octave: cargo xtask test --only octave"]
fn cross_code_the_equations_in_octave_are_the_compiled_ones() {
    // All twelve: the six without yaw cost no time, and hold more.
    let cases: Vec<String> = builtin::thesis_names().map(str::to_owned).collect();
    let folder = tempfile::tempdir().unwrap();
    let [given, found] = ["states.f64", "rates.f64"].map(|name| folder.path().join(name));
    let mut numbers = Vec::new();
    let mut expected = Vec::new();
    for name in &cases {
        let mut equations = Equations::named(name).unwrap();
        let parameters = RaceProblem::named(name).unwrap().parameters.unwrap();
        let list = states_of(name, &equations);
        let mut counts = Counts::default();
        numbers.push(list.len() as f64);
        for (time, z) in list {
            let mut rates = vec![0.0; z.len()];
            equations.rates(time, &z, &mut rates);
            let sizes = counts.count(&mut equations, &parameters, time, &z);
            expected.push((name, time, rates, sizes));
            numbers.push(time);
            numbers.extend(z);
        }
        println!("{name}: {counts:?}");
        let all = [counts.open, counts.stick, counts.between, counts.slip];
        assert!(all.iter().all(|count| *count > 0), "{name}: {counts:?}");
    }
    write_states(&given, &numbers).unwrap();
    let mut words = vec![given.to_str().unwrap(), found.to_str().unwrap()];
    let texts: Vec<String> = cases.iter().map(|name| json(name)).collect();
    words.extend(texts.iter().map(String::as_str));
    octave("wedge_rates_check.m", &words);
    let found = read_states(&found).unwrap();
    assert_eq!(found.len(), 9 * expected.len());
    let mut worst = [0.0_f64; 9];
    for ((name, time, rates, sizes), theirs) in expected.iter().zip(found.chunks_exact(9)) {
        for k in 0..9 {
            let error = (rates[k] - theirs[k]).abs() / sizes[k];
            worst[k] = worst[k].max(error);
            assert!(
                error <= ROUNDING,
                "{name} at {time} s, rate {k}: {} in Octave, {} compiled",
                theirs[k],
                rates[k]
            );
        }
    }
    println!("{} states, worst {worst:?}", expected.len());
}

#[test]
#[ignore = "needs Octave: cargo xtask test --only octave"]
fn cross_code_ode15s_with_equations_in_octave_runs_as_ours_does() {
    let (name, rows) = ("cdrun_toe_in_0.2_psi_0.012", 11);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("states.f64");
    let printed = octave(
        "ode15s_race.m",
        &[
            "octave",
            &json(name),
            name,
            "1e-7",
            "60",
            file.to_str().unwrap(),
            &rows.to_string(),
        ],
    );
    let outcome: Outcome = serde_json::from_str(&printed).unwrap();
    assert_eq!((outcome.failure.as_str(), outcome.rows), ("", rows));
    assert!(outcome.steps > 0 && outcome.cpu > 0.0);
    let mut judge = Judge::new(name).unwrap();
    let theirs = judge.quantities(&read_states(&file).unwrap(), rows).unwrap();
    let mut error = |tolerance: f64| {
        let (_, states) = own::run(name, Method::Rodas5P, false, tolerance, 60.0, rows).unwrap();
        judge.quantities(&states, rows).unwrap().error(&theirs)
    };
    let (fine, coarse) = (error(1e-8), error(1e-3));
    println!("ours at 1e-8 {fine:e}, at 1e-3 {coarse:e}; {outcome:?}");
    assert!(fine < 1e-2, "{fine:e}");
}
