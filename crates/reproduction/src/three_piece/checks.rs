//! Values found in runs against expected ones, one number and one sentence each.

use std::f64::consts::PI;

use mechanics::system::{Held, StaticFriction};
use study::truck::WEDGE_NAMES;
use study::truck::loop_curve::LoopCurve;
use truck::{BOLSTER, Bolster, ControlCoil, Lading, Parameters, Truck};
use wedge::parameters::Damping;

use super::check::{Basis, Check, Found, exactly};
use super::massless::{massless, massless_trucks};
use super::rigs::{INCH, KIP_INCH, POUND, Rigs, at, coil_and_weight};

/// Returns all checks whose runs are there.
#[must_use]
pub fn checks(rigs: &Rigs) -> Vec<Check> {
    let mut found = Found {
        checks: Vec::new(),
        basis: Basis::ClosedForm,
    };
    rest(&mut found, rigs);
    frictionless(&mut found, rigs);
    plate_and_ledger(&mut found, rigs);
    found.basis = Basis::MasslessWedge;
    massless(&mut found, rigs);
    massless_trucks(&mut found, rigs);
    found.basis = Basis::IndependentCalculation;
    independent(&mut found, rigs);
    found.checks
}

/// Weights of what the nests carry, and of the side frames, lbf.
fn weights(parameters: &Parameters) -> [f64; 2] {
    masses(parameters).map(|mass| mass * parameters.gravity / POUND)
}

/// Masses of what the nests carry, and of the side frames, kg.
fn masses(parameters: &Parameters) -> [f64; 2] {
    let frames: f64 = parameters.side_frames.iter().map(|frame| frame.body.mass).sum();
    [parameters.bolster.body.mass + parameters.wedge_mass(), frames]
}

/// Nominal load (N) and vertical stiffness (N/m) of all coils on the side frames: with variable damping
/// control coils stand there too.
fn coils(parameters: &Parameters) -> [f64; 2] {
    let mut sums = [parameters.load_preload(), parameters.load_stiffness()];
    for wedge in &parameters.wedges {
        if let (Damping::Variable, ControlCoil::Shear(coil)) = (parameters.damping, &wedge.control_coil) {
            sums[0] += coil.preload;
            sums[1] += coil.stiffness;
        }
    }
    sums
}

/// Vertical stiffness (N/m) and load (N) of the four adapters.
fn adapters(parameters: &Parameters) -> Option<[f64; 2]> {
    let adapter = &parameters.wheelsets.as_ref()?.adapter;
    Some([4.0 * adapter.stiffness(), 4.0 * adapter.preload()])
}

/// Statics and the bounce of a truck under its half car.
fn rest(found: &mut Found, rigs: &Rigs) {
    for damping in ["constant", "variable"] {
        let Some((case, result)) = rigs.get(&format!("rest, {damping}")) else {
            continue;
        };
        let [carried, _] = weights(&case.parameters);
        found.add(
            format!("load of a nest, {damping} damping"),
            at(result, "left_nest_vertical_force", 0.0).map(|force| force / POUND),
            exactly(0.5 * carried),
            ("lbf", 1e-6),
            "At rest two nests carry the half car, its bolster and the wedges.",
        );
    }
    for (damping, margin, remark) in [
        (
            "constant",
            1e-4,
            "Coils and adapters in series are relieved of the lading; the wedges' forces are internal to \
             bolster and wedges.",
        ),
        (
            "variable",
            5e-3,
            "As with constant damping, and control coils carry too; the wedges' faces give a little less \
             than loaded.",
        ),
    ] {
        if let Some((empty, result)) = rigs.get(&format!("rest, {damping}_empty"))
            && let Some([adapters, on_them]) = adapters(&empty.parameters)
        {
            let parameters = &empty.parameters;
            let [carried, frames] = weights(parameters).map(|weight| weight * POUND);
            let [preload, stiffness] = coils(parameters);
            let rise = ((preload - carried) / stiffness + (on_them - carried - frames) / adapters) / INCH;
            found.add(
                format!("height of the empty car above the loaded one, {damping} damping"),
                at(result, "bolster_z", 0.0).map(|z| z / INCH),
                exactly(rise),
                ("in", margin),
                remark,
            );
        }
    }
    let half_car = Parameters {
        bolster: Bolster::with_half_car(Lading::Loaded),
        ..Parameters::new(Damping::Constant).with_wedge_friction(0.0)
    };
    found.add(
        "bounce of a truck under its half car, without friction",
        bounce(&half_car),
        two_masses(&half_car).map(exactly),
        ("Hz", 2e-3),
        "Two masses on coils and adapters; wedges go with the bolster.",
    );
}

/// Returns the frequency (Hz) of the vibration in which the bolster moves most.
fn bounce(parameters: &Parameters) -> Option<f64> {
    let mut truck = Truck::new(parameters).ok()?;
    let x = truck.system.initial_state();
    let rest = truck.system.equilibrium(0.0, &x, StaticFriction::Without).ok()?;
    let z = truck.system.position_of(BOLSTER, 2)?;
    let modes = truck.system.vibrations(0.0, &rest, Held::Nothing).ok()?.modes;
    let most = modes
        .iter()
        .filter(|mode| mode.frequency > 0.5)
        .max_by(|a, b| a.shape[z].abs().total_cmp(&b.shape[z].abs()))?;
    Some(most.frequency)
}

/// Returns the lower frequency (Hz) of two masses: the car on its coils, the side frames on their adapters.
fn two_masses(parameters: &Parameters) -> Option<f64> {
    let [upper, lower] = masses(parameters);
    let coils = parameters.load_stiffness();
    let [adapters, _] = adapters(parameters)?;
    // det(K - w² M) = 0
    let b = coils / upper + (coils + adapters) / lower;
    let c = coils * adapters / (upper * lower);
    Some((0.5 * (b - (b * b - 4.0 * c).sqrt())).sqrt() / (2.0 * PI))
}

fn frictionless(found: &mut Found, rigs: &Rigs) {
    if let Some((case, result)) = rigs.get("frictionless warp") {
        let wedge = &case.parameters.wedges[0];
        let cotangent = 1.0 / libm::tan(wedge.angle);
        let time = 4.5;
        let warp = at(result, "warp_angle", time);
        found.add(
            "roll of a wedge over the warp angle, without friction",
            at(result, "trailing_left_roll", time)
                .zip(warp)
                .map(|(roll, warp)| roll / warp),
            exactly(cotangent),
            ("-", 3e-3),
            "A wedge that is free to roll rolls by ψ cot θ and stays flush on both faces.",
        );
        let shear: f64 = case
            .parameters
            .load_coils
            .iter()
            .zip([1.0, -1.0])
            .flat_map(|(coils, way)| coils.iter().map(move |coil| (coil, way)))
            .map(|(coil, way)| {
                // A side frame turns about its own center: the seat moves by (-ψ own, ψ x).
                let [x, own] = coil.place;
                let y = own + way * case.parameters.geometry.nest();
                coil.spring.shear_stiffness * (x * x + y * own)
            })
            .sum();
        found.add(
            "moment of the load coils' shear over the warp angle, both nests",
            at(result, "warp_moment_load_coils", time)
                .zip(warp)
                .map(|(moment, warp)| moment / warp / (1e3 * KIP_INCH)),
            exactly(shear / (1e3 * KIP_INCH)),
            ("1e6 lbf·in/rad", 2e-3),
            "Each coil shears by ψ times its distance from the nest's center.",
        );
        let [coil, weight] = coil_and_weight(case);
        found.add(
            "normal force of a column, without friction",
            at(result, "leading_left_column_normal", 1.9).map(|force| force / POUND),
            exactly((coil - weight) * cotangent / POUND),
            ("lbf", 2e-2),
            "(F_s - m g)/tan θ, F_s being the coil's static load; the contacts' give relaxes the coil a \
             little.",
        );
    }
    if let Some((case, result)) = rigs.get("frictionless vertical")
        && let Some([adapters, _]) = adapters(&case.parameters)
    {
        let coils = case.parameters.load_stiffness();
        let own = LoopCurve::of(case, result);
        found.add(
            "vertical stiffness of the truck, without friction",
            own.map(|own| own.stiffness * INCH / POUND),
            exactly(coils * adapters / (coils + adapters) * INCH / POUND),
            ("lbf/in", 2e-3),
            "Coils and adapters in series; control coils with constant damping act within the bolster.",
        );
    }
    if let Some((case, result)) = rigs.get("truck_vertical_variable") {
        let losses: f64 = result.summary.cycles.losses.values().map(|loss| loss.value).sum();
        let joule = quantity::Kind::Energy.from_si(result.summary.units);
        let own = LoopCurve::of(case, result);
        found.add(
            "area of the vertical loop, variable damping",
            own.map(|own| own.energy / (POUND * INCH)),
            exactly(losses / joule / (POUND * INCH)),
            ("in·lbf", 2e-2),
            "What a cycle loses at all elements; the area is a sum over output times.",
        );
    }
}

/// Turning moment of the center plate, ledger, symmetry.
fn plate_and_ledger(found: &mut Found, rigs: &Rigs) {
    if let Some((case, result)) = rigs.get("turned plate")
        && let Some(car) = &case.parameters.car_body
    {
        let plate = &car.center_plate;
        let load = car.body.mass * case.parameters.gravity - car.side_bearings.preload();
        let radius = plate.rings.iter().fold(0.0, |most: f64, own| most.max(*own));
        found.add(
            "turning moment of the loaded center plate",
            at(result, "center_plate_turning_moment", 0.6).map(|moment| moment.abs() / KIP_INCH),
            exactly(2.0 / 3.0 * plate.friction.coefficient * load * radius / KIP_INCH),
            ("kip·in", 2e-3),
            "(2/3) μ W R: two rings of points have the friction radius of a flat plate.",
        );
    }
    let residuals = rigs
        .all()
        .map(|(_, result)| result.summary.ledger.largest_relative_residual);
    found.add(
        "largest residual of the energy ledger of any run reported here",
        residuals.reduce(f64::max),
        exactly(0.0),
        ("-", 1e-5),
        "Work, losses and stored energy add up; each loss is integrated from its own force and velocity.",
    );
    if let Some((_, result)) = rigs.get("truck_vertical_variable") {
        let normals = WEDGE_NAMES.map(|wedge| {
            result
                .column(&format!("{wedge}_column_normal"))
                .unwrap_or_default()
        });
        let [first, others @ ..] = normals;
        let largest = first.iter().fold(0.0, |most: f64, force| most.max(*force));
        let apart = others
            .iter()
            .flat_map(|own| own.iter().zip(first).map(|(a, b)| (a - b).abs()));
        found.add(
            "largest difference between wedges going up and down, over the largest normal force",
            (largest > 0.0).then(|| apart.fold(0.0, f64::max) / largest),
            exactly(0.0),
            ("-", 1e-6),
            "A symmetric rig loads its four wedges alike.",
        );
    }
}

/// Checks the rigs against calculations of another program.
fn independent(found: &mut Found, rigs: &Rigs) {
    let moment = |key: &str, time: f64| {
        let (_, result) = rigs.get(key)?;
        Some(at(result, "warp_moment", time)?.abs() / KIP_INCH)
    };
    let normal = |key: &str, time: f64| {
        let (_, result) = rigs.get(key)?;
        let all = WEDGE_NAMES
            .iter()
            .filter_map(|wedge| at(result, &format!("{wedge}_column_normal"), time));
        all.reduce(f64::max).map(|force| force / POUND)
    };
    let growth = |key: &str| Some(moment(key, 4.5)? / moment(key, 3.25)?);
    found.add(
        "warp moment at 20 mrad with a friction of 0.25",
        moment("warp, mu 0.25", 4.5),
        exactly(225.0),
        ("kip·in", 0.05),
        "With friction of 0.25 the moment has a plateau; lateral friction at the columns adds to what their \
         edges hold.",
    );
    found.add(
        "its growth from 10 to 20 mrad",
        growth("warp, mu 0.25"),
        [1.0, 1.15],
        ("-", 0.0),
        "A plateau.",
    );
    found.add(
        "growth of the warp moment of a new truck from 10 to 20 mrad",
        growth("warp, new"),
        [1.5, 2.0],
        ("-", 0.0),
        "With friction of 0.4 the nest locks, and the contacts' stiffness sets the moment.",
    );
    found.add(
        "largest normal force of its columns at 20 mrad, on the way to the other side",
        normal("warp, new", 9.5),
        [20_000.0, 30_000.0],
        ("lbf", 0.0),
        "Where the nest locks the wedges are pressed in, five to eight times as hard as without warp.",
    );
    found.add(
        "what the adapters' friction adds to the inter-axle shear moment at 20 mrad",
        rigs.get("truck_warp_axles_constant_rising")
            .and_then(|(_, result)| {
                let shear = at(result, "interaxle_shear_moment", 4.5)?.abs();
                Some((shear - at(result, "warp_moment", 4.5)?.abs()) / KIP_INCH)
            }),
        [180.0, 210.0],
        ("kip·in", 0.05),
        "Side frames turn on their bearings while the wheelsets move against each other.",
    );
    found.add(
        "normal force of a column going up and down, constant damping, no toe",
        rigs.get("truck_vertical_constant")
            .and_then(|(_, result)| at(result, "leading_left_column_normal", 5.0))
            .map(|force| force / POUND),
        exactly(3400.0),
        ("lbf", 0.05),
        "The start locks it in: the contacts' damping decides it.",
    );
}
