//! Wear of a wedge's faces: volumes by closed forms on every grid, pressure that evens out, steps, stops.

use std::ops::ControlFlow;

use integrate::Integrator;
use study::case::{Case, Tables};
use study::metrics::Cycle;
use study::run::RunCase;
use study::wear::archard::Archard;
use study::wear::energy::WearByEnergy;
use study::wear::{LIMIT, WearError, WearHistory, WearLaw, WearPlan, WearStop, advance};
use wedge::Wedge;

const INCH: f64 = 0.0254;

const ARCHARD: Archard = Archard {
    coefficient: Archard::COEFFICIENT,
    hardness: Archard::HARDNESS,
};

/// Returns a case of the thesis's wedge that lasts one and a half cycles.
fn read(damping: &str, text: &str) -> Case {
    let text = format!(
        "name = \"worn\"\n[wedge]\ndamping = \"{damping}\"\n[simulation]\nduration = \"4.72 s\"\nstart = \
         \"equilibrium\"\n{text}"
    );
    Case::parse("case.toml", &text, Tables::nowhere(), &[]).unwrap()
}

fn grid(up: usize, across: usize) -> String {
    format!("[column_face]\ngrid = [{up}, {across}]\n[slope_face]\ngrid = [{up}, {across}]\n")
}

fn plan(cycles: f64, steps: u32, law: WearLaw) -> WearPlan {
    WearPlan {
        cycles,
        steps,
        most_steps: 100,
        law,
        counterface: 0.0,
    }
}

fn worn(case: &Case, plan: &WearPlan) -> WearHistory {
    let history = advance(case, plan, |_, _| ControlFlow::Continue(())).unwrap();
    assert!(history.stopped.is_none(), "{:?}", history.stopped);
    history
}

/// Returns ∫ N |v| dt over the last whole cycle of a case by the trapezoidal rule over even times, by face.
fn load_times_path(case: &Case) -> [f64; 2] {
    const SAMPLES: usize = 20_000;
    let wedge = Wedge::new(case.parameters.clone()).unwrap();
    let cycle = Cycle::of(&case.parameters).unwrap();
    let (_, end, _) = cycle.window(case.simulation.duration).unwrap();
    let mut system = wedge.system.clone();
    let mut integrator =
        Integrator::new(wedge.system.clone(), case.options(), 0.0, &wedge.initial_state).unwrap();
    let mut x = wedge.initial_state.clone();
    let (mut sums, mut next) = ([0.0; 2], 0);
    while next <= SAMPLES {
        integrator.step_to(case.simulation.duration).unwrap();
        system.segment_like(integrator.problem());
        while next <= SAMPLES {
            let time = end - cycle.period() * (1.0 - next as f64 / SAMPLES as f64);
            if time > integrator.time() {
                break;
            }
            integrator.interpolate(time, &mut x);
            let seen = system.observe(time, &x);
            let weight = if next == 0 || next == SAMPLES { 0.5 } else { 1.0 };
            for (sum, face) in sums.iter_mut().zip(&seen.faces) {
                let points = face.points.iter();
                let powers = points.map(|point| point.normal * libm::hypot(point.slip[0], point.slip[1]));
                *sum += weight * powers.sum::<f64>() * cycle.period() / SAMPLES as f64;
            }
            next += 1;
        }
    }
    sums
}

/// The volume of a face is K ∫ N |v| dt / H, computed apart from it, and is what its map holds, on every
/// grid.
#[test]
fn analytic_volumes_are_those_of_archard_on_every_grid() {
    let mut first: Option<[f64; 2]> = None;
    for points in [2, 3, 5, 9] {
        let case = read("constant", &grid(points, points));
        let cycles = 2000.0;
        let history = worn(&case, &plan(cycles, 1, WearLaw::Archard(ARCHARD)));
        let [_, last] = history.states.as_slice() else {
            panic!("{} states", history.states.len());
        };
        let paths = load_times_path(&case);
        let parameters = &history.case.parameters;
        let faces = [&parameters.column_face, &parameters.slope_face];
        for (number, face) in faces.into_iter().enumerate() {
            let wanted = ARCHARD.coefficient * paths[number] / ARCHARD.hardness * cycles;
            let volume = last.faces[number].volume;
            assert!(
                (volume - wanted).abs() < 1e-3 * wanted,
                "{points}: {volume} {wanted}"
            );
            // The trapezoidal rule over the nodes of the map.
            let map = face.wedge_wear.as_ref().unwrap();
            let [up, across] = map.places();
            let mut held = 0.0;
            for u in up.windows(2) {
                for a in across.windows(2) {
                    let corners = [(u[0], a[0]), (u[0], a[1]), (u[1], a[0]), (u[1], a[1])];
                    let mean = corners.iter().map(|(u, a)| map.depth(*u, *a)).sum::<f64>() / 4.0;
                    held += mean * (u[1] - u[0]) * (a[1] - a[0]);
                }
            }
            assert!((held - volume).abs() < 1e-9 * volume, "{points}: {held} {volume}");
        }
        // Energies of points are what the ledger says. Finer grids resist tilting less: forces differ
        // somewhat.
        assert!(last.mismatch < 1e-3, "{points}: {}", last.mismatch);
        let volumes = [0, 1].map(|face| last.faces[face].volume);
        let coarse = *first.get_or_insert(volumes);
        assert!(
            (volumes[0] - coarse[0]).abs() < 0.05 * coarse[0],
            "{volumes:?} {coarse:?}"
        );
    }
}

/// Without friction the wedge is a flat block that a constant force presses on the column: coil and slope
/// press by `(F - W)/tan θ`, and a cycle slides by four amplitudes.
#[test]
fn analytic_a_flat_block_under_constant_load() {
    let case = read(
        "constant",
        "[friction]\ncolumn = 0\nslope = 0\n[contact]\ndamping = \"200 lbf s/in\"\n[column_face]\ngrid = [3, \
         3]\n",
    );
    let parameters = &case.parameters;
    let mut wedge = Wedge::new(parameters.clone()).unwrap();
    let rest = wedge.system.observe(0.0, &wedge.initial_state);
    let lift = rest.coils[0].coil.spring - parameters.wedge.mass * parameters.gravity;
    let force = lift / libm::tan(parameters.wedge.angle);
    let wanted = ARCHARD.coefficient * force * 4.0 * INCH / ARCHARD.hardness;
    let history = worn(&case, &plan(1000.0, 2, WearLaw::Archard(ARCHARD)));
    for state in &history.states {
        let column = &state.faces[0];
        assert!(
            (column.volume_per_cycle - wanted).abs() < 1e-3 * wanted,
            "{} {wanted}",
            column.volume_per_cycle
        );
        assert!((column.mean_force - force).abs() < 1e-3 * force);
    }
    // Depth over the face, of all cycles: that of the mean pressure.
    let area = parameters.wedge.height * parameters.wedge.width;
    let last = history.states.last().unwrap();
    assert!((last.faces[0].volume / area - 1000.0 * wanted / area).abs() < 1e-3 * 1000.0 * wanted / area);
}

/// With one coefficient of friction, and sliding far above the reference speed, both laws say the same.
#[test]
fn analytic_wear_by_energy_is_archards_with_constant_friction() {
    let case = read("constant", &grid(3, 2));
    let friction = 0.4;
    let by_energy = WearLaw::Energy(WearByEnergy {
        coefficient: ARCHARD.coefficient / (friction * ARCHARD.hardness),
    });
    let column = |law: WearLaw| {
        let states = worn(&case, &plan(1.0, 1, law)).states;
        states[0].faces[0].volume_per_cycle
    };
    let (energy, archard) = (column(by_energy), column(WearLaw::Archard(ARCHARD)));
    assert!((energy - archard).abs() < 2e-3 * archard, "{energy} {archard}");
    assert!(energy < archard);
}

/// A crowned face is worn until it is pressed evenly; the wedge rises by what is worn.
#[test]
fn limits_wear_evens_out_the_pressure_of_a_crown() {
    let case = read(
        "constant",
        "[friction]\ncolumn = 0.1\n[column_face]\ngrid = [9, 2]\nwedge_surface = { shape = \"crown\", radius \
         = \"2500 in\", direction = \"up\" }\n",
    );
    let law = WearLaw::Archard(Archard {
        coefficient: 1e-3,
        ..ARCHARD
    });
    let history = worn(&case, &plan(60_000.0, 1, law));
    // The steps were divided.
    assert!(history.states.len() > 4, "{}", history.states.len());
    let middle_and_edge = |pressures: &[f64]| [pressures[4 + 6], 0.5 * (pressures[0] + pressures[2])];
    let ratio = |state: usize| {
        let [middle, edge] = middle_and_edge(&history.states[state].faces[0].pressures);
        middle / edge
    };
    let last = history.states.len() - 1;
    assert!(ratio(0) > 1.5, "{}", ratio(0));
    assert!(
        (ratio(last) - 1.0).abs() < 0.15 * (ratio(0) - 1.0),
        "{}",
        ratio(last)
    );
    // Step by step, never over the mark.
    for state in 0..last {
        assert!(ratio(state + 1) < ratio(state) + 1e-3, "{state}");
    }
    let rises: Vec<f64> = history.states.iter().map(|state| state.rise).collect();
    assert_eq!(rises[0], 0.0);
    assert!(rises.windows(2).all(|pair| pair[1] > pair[0]), "{rises:?}");
}

/// Steps of any number come to the same wear, to the order of the step.
#[test]
fn convergence_of_steps() {
    let case = read("constant", &grid(3, 2));
    let rise = |steps: u32| {
        let history = worn(&case, &plan(4000.0, steps, WearLaw::Archard(ARCHARD)));
        assert_eq!(history.states.len(), steps as usize + 1);
        let last = history.states.last().unwrap();
        assert_eq!(last.cycles, 4000.0);
        last.faces[1].depths[0]
    };
    // Rounding makes no step of its own.
    assert_eq!(
        worn(&case, &plan(1.0, 10, WearLaw::Archard(ARCHARD)))
            .states
            .len(),
        11
    );
    let [one, two, four] = [1, 2, 4].map(rise);
    assert!(
        (two - four).abs() < 0.7 * (one - four).abs(),
        "{one} {two} {four}"
    );
    assert!((one - four).abs() < 0.1 * four);
}

#[test]
fn limits_no_step_wears_more_than_its_part_of_the_penetration() {
    let case = read("variable", &grid(2, 2));
    let history = worn(&case, &plan(300_000.0, 1, WearLaw::Archard(ARCHARD)));
    let areas = case
        .parameters
        .column_face
        .areas(&case.parameters.rectangles()[0]);
    let stiffness = case.parameters.contact.stiffness;
    for pair in history.states.windows(2) {
        for (point, area) in areas.iter().enumerate() {
            let step = pair[1].faces[0].depths[point] - pair[0].faces[0].depths[point];
            // The greatest penetration is no less than the weighted mean one, which is no less than that.
            let mean = pair[0].faces[0].pressures[point] * area / stiffness;
            assert!(step <= 4.0 * LIMIT * mean, "{step} {mean}");
        }
    }
    assert!(history.states.len() > 2);
}

#[test]
fn input_what_cannot_be_worn_is_refused() {
    let refused = |case: &Case, plan: &WearPlan| match advance(case, plan, |_, _| ControlFlow::Continue(()))
        .unwrap_err()
    {
        WearStop::Error(error) => error,
        WearStop::Interrupted(reason) => panic!("{reason}"),
    };
    let law = WearLaw::Archard(ARCHARD);
    let short = Case::parse(
        "case.toml",
        "[wedge]\ndamping = \"constant\"\n[simulation]\nduration = \"3 s\"\n",
        Tables::nowhere(),
        &[],
    );
    let error = refused(&short.unwrap(), &plan(10.0, 1, law));
    assert!(matches!(error, WearError::NoCycle), "{error}");
    let case = read("constant", "");
    let error = refused(&case, &plan(1e9, 1, law));
    assert!(error.to_string().contains("steps are needed"), "{error}");
}

/// States computed before a stop are kept.
#[test]
fn limits_a_stop_keeps_the_states_before() {
    let case = read("constant", "");
    let history = advance(&case, &plan(200.0, 4, WearLaw::Archard(ARCHARD)), |done, time| {
        if done > 0.4 && time > 1.0 {
            return ControlFlow::Break("enough".to_owned());
        }
        ControlFlow::Continue(())
    })
    .unwrap();
    assert_eq!(history.states.len(), 2);
    assert!(matches!(history.stopped, Some(WearStop::Interrupted(_))));
    // The case is that of the last state.
    let depth = |number: usize| history.states[1].faces[number].depths[0];
    let parameters = &history.case.parameters;
    let map = parameters.column_face.wedge_wear.as_ref().unwrap();
    let half = [0.5 * parameters.wedge.height, 0.5 * parameters.wedge.width];
    assert!((map.depth(-half[0], -half[1]) - depth(0)).abs() <= 1e-12 * depth(0));
}

/// A flat block that a constant force presses: each place of the column is worn by the way that the block
/// makes over it, `2 K p / H` times the part of -A .. A within half a length of the place in a cycle. The
/// volume is the wedge's times the ratio.
#[test]
fn analytic_a_counterface_is_worn_where_the_wedge_slides() {
    let case = read(
        "constant",
        "[friction]\ncolumn = 0\nslope = 0\n[contact]\ndamping = \"200 lbf s/in\"\n[column_face]\ngrid = [9, \
         3]\n",
    );
    let (cycles, ratio) = (1000.0, 0.6);
    let plan = WearPlan {
        counterface: ratio,
        ..plan(cycles, 1, WearLaw::Archard(ARCHARD))
    };
    let history = worn(&case, &plan);
    let [_, last] = history.states.as_slice() else {
        panic!("{} states", history.states.len());
    };
    let counterfaces = last.counterfaces.as_ref().unwrap();
    for (own, wedge) in counterfaces.iter().zip(&last.faces) {
        let wanted = ratio * wedge.volume;
        assert!(
            (own.volume - wanted).abs() < 1e-9 * wanted,
            "{} {wanted}",
            own.volume
        );
        // What the map holds, by the trapezoidal rule.
        let map = own.map.as_ref().unwrap();
        let [up, across] = map.places();
        let cell = |places: &[f64], k: usize| {
            let last = places.len() - 1;
            0.5 * (places[(k + 1).min(last)] - places[k.saturating_sub(1)])
        };
        let mut held = 0.0;
        for (i, u) in up.iter().enumerate() {
            for (j, a) in across.iter().enumerate() {
                held += map.depth(*u, *a) * cell(up, i) * cell(across, j);
            }
        }
        assert!((held - wanted).abs() < 1e-9 * wanted, "{held} {wanted}");
    }
    let column = &last.faces[0];
    let (height, width) = (case.parameters.wedge.height, case.parameters.wedge.width);
    let pressure = column.mean_force / (height * width);
    let amplitude = INCH;
    let depth = |place: f64| {
        let reach = (place + 0.5 * height).min(amplitude) - (place - 0.5 * height).max(-amplitude);
        ratio * ARCHARD.coefficient * pressure / ARCHARD.hardness * cycles * 2.0 * reach.max(0.0)
    };
    let map = counterfaces[0].map.as_ref().unwrap();
    let [up, across] = map.places();
    // The places in time of Gauss's rule miss the end of the stroke by a part of a step, where nothing
    // slides.
    let end = -0.5 * height - amplitude;
    assert!(up[0] > end - 1e-9 && up[0] < end + 0.03 * amplitude, "{}", up[0]);
    // A sixteenth of the face is less than the travel: over the plateau and the middle of the ramps the hats
    // see straight lines alone.
    let spacing = height / 16.0;
    for side in [across[0], 0.0, across[across.len() - 1]] {
        for (place, tolerance) in [
            (0.0, 1e-3),
            (spacing, 1e-3),
            (2.0 * spacing, 1e-3),
            (0.5 * height, 0.02),
        ] {
            // The coil tilts the wedge somewhat: what is linear in its pressure cancels out of both sides.
            let found = 0.5 * (map.depth(place, side) + map.depth(-place, side));
            let wanted = depth(place);
            assert!(
                (found / wanted - 1.0).abs() < tolerance,
                "{place}: {found} {wanted}"
            );
        }
    }
    // The worn case has it.
    let own = history.case.parameters.column_face.counterface_wear.as_ref();
    assert!((own.unwrap().depth(0.0, 0.0) / depth(0.0) - 1.0).abs() < 2e-3);
}

/// While travel is short against the face, wear of both partners is that of the wedge alone at twice the
/// coefficient: depths on wedge and counterface sum to its depths at every point, uneven as they are.
#[test]
fn limits_short_travel_wears_both_partners_as_one() {
    let lines = "[bolster]\nvertical = \
                 { shape = \"sine\", amplitude = \"0.02 in\", frequency = \"0.318 Hz\" }\n\
                 [column_face]\ngrid = [5, 5]\n[slope_face]\ngrid = [5, 5]\n[side_frame]\nyaw = \"0.1 \
                 deg\"\n";
    let case = read("constant", lines);
    let law = |times: f64| {
        WearLaw::Archard(Archard {
            coefficient: times * ARCHARD.coefficient,
            ..ARCHARD
        })
    };
    let cycles = 40_000.0;
    let alone = worn(&case, &plan(cycles, 2, law(2.0)));
    let both = worn(
        &case,
        &WearPlan {
            counterface: 1.0,
            ..plan(cycles, 2, law(1.0))
        },
    );
    let (alone, both) = (alone.states.last().unwrap(), both.states.last().unwrap());
    let rectangles = case.parameters.rectangles();
    let counterfaces = both.counterfaces.as_ref().unwrap();
    for face in 0..2 {
        let properties = [&case.parameters.column_face, &case.parameters.slope_face][face];
        let deepest = alone.faces[face]
            .depths
            .iter()
            .fold(0.0_f64, |most, own| most.max(*own));
        let least = alone.faces[face]
            .depths
            .iter()
            .fold(f64::INFINITY, |least, own| least.min(*own));
        assert!(least < 0.8 * deepest, "even: {least} {deepest}");
        for (i, point) in properties.grid.points().iter().enumerate() {
            let (up, across) = rectangles[face].distances(point);
            let map = counterfaces[face].map.as_ref().unwrap();
            let sum = both.faces[face].depths[i] + map.depth(up, across);
            let wanted = alone.faces[face].depths[i];
            assert!(
                (sum - wanted).abs() < 0.1 * deepest,
                "{face} {i}: {sum} {wanted} {deepest}"
            );
        }
    }
    assert!(
        (both.rise / alone.rise - 1.0).abs() < 0.03,
        "{} {}",
        both.rise,
        alone.rise
    );
}
