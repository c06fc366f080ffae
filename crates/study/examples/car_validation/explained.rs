//! Numbers that look wrong at first sight, with their reasons: the damping of stuck vibrations, the losses of
//! leading and trailing wedges.

use std::fmt::Write;

use car::{FrictionState, Mode};
use study::car::CarCase;
use study::case::Tables;

use crate::{Failure, MPH, POUND_FORCE, column, each, run, set};

/// Motions of the loaded car with stuck friction by a separate linear model: growth (1/s), frequency (Hz),
/// the share of growth by creep of the wheels (1/s), and with twice the creep coefficients.
const SEPARATE: [(&str, [f64; 3], [f64; 2]); 3] = [
    ("upper sway", [-2.3421, 2.4586, -2.2885], [-1.2374, 2.4090]),
    ("bounce", [-1.8418, 9.4567, 0.0], [-1.8418, 9.4567]),
    ("pitch", [-4.0974, 14.1011, -0.0074], [-4.0937, 14.1011]),
];
/// Pitch without friction by the same model: growth (1/s) and frequency (Hz), coasting and held.
const PITCH: [[f64; 2]; 2] = [[-0.0179, 3.0011], [-0.0610, 3.0007]];

/// Returns the motions of the loaded car at 40 mph on linear wheels with these coefficients, lbf a wheel.
fn modes(f11: f64, f22: f64, friction: FrictionState) -> Result<Vec<Mode>, Failure> {
    let settings = set(&[
        "lading.kind=\"loaded\"",
        "track.segments=[{tangent=\"2000 ft\"}]",
        "track.support.kind=\"rigid\"",
        "wheels.geometry=\"linear\"",
        "wheels.conicity=0.1",
        "wheels.spin=false",
        // As the separate model has them.
        "truck.slope_face.wedge_surface=flat",
        "truck.slope_face.grid=[2, 2]",
        "truck.column_face.grid=[2, 2]",
        "truck.adapter.stiffness=5e5 lbf/in",
        &format!("wheels.f11=\"{f11} lbf\""),
        &format!("wheels.f22=\"{f22} lbf\""),
    ]);
    let case = CarCase::parse("car.toml", "model = \"car\"\n", Tables::nowhere(), &settings)?;
    let mut parameters = case.parameters;
    for own in parameters
        .trucks
        .iter_mut()
        .filter_map(|truck| truck.wheelsets.as_mut())
    {
        own.pitching = false;
    }
    Ok(parameters.modes(40.0 * MPH, friction)?)
}

fn near(modes: &[Mode], frequency: f64) -> Result<Mode, Failure> {
    let own = modes.iter().filter(|mode| mode.growth > -20.0);
    own.min_by(|a, b| {
        let off = |mode: &Mode| (mode.frequency - frequency).abs();
        off(a).total_cmp(&off(b))
    })
    .copied()
    .ok_or_else(|| format!("there is no vibration near {frequency} Hz").into())
}

pub fn stuck_vibrations() -> Result<String, Failure> {
    let mut out = "## Stuck vibrations\n\n\
         The loaded car at 40 mph with stuck friction (bristles are springs with dampers) on linear wheels: \
         conicity 0.1, f11 = 2.0e6 and\nf22 = 1.8e6 lbf a wheel, no spin, a support of 1e9 N/m a wheelset; \
         wedges on their corners, adapters of 5e5 lbf/in that do not pitch. Beside it a separate linear \
         model: 19 bodies, \
         springs and\ndampers in lbf, in, s, linearized by automatic differentiation. From its modes: the \
         part of the growth that is creep's.\n\n\
         | vibration | growth, 1/s, Hz | separate model | creep's part of it | growth, Hz, twice f11, f22 | \
         separate model |\n|---|---|---|---|---|---|\n"
        .to_owned();
    let usual = modes(2.0e6, 1.8e6, FrictionState::Stuck)?;
    let twice = modes(4.0e6, 3.6e6, FrictionState::Stuck)?;
    for (name, [growth, frequency, creep], [twice_growth, twice_frequency]) in SEPARATE {
        let own = near(&usual, frequency)?;
        let other = near(&twice, twice_frequency)?;
        let _ = writeln!(
            out,
            "| {name} | {:.4}, {:.4} | {growth:.4}, {frequency:.4} | {creep:.4} | {:.4}, {:.4} | \
             {twice_growth:.4}, {twice_frequency:.4} |",
            own.growth, own.frequency, other.growth, other.frequency
        );
    }
    let free = modes(2.0e6, 1.8e6, FrictionState::Absent)?;
    let pitch = near(&free, PITCH[0][1])?;
    let [coasting, held] = PITCH;
    let _ = writeln!(
        out,
        "\nThe upper sway is damped by lateral creep, to 98 %: the wheels are a damper of 8 f22/V in series \
         with the car, so that half the speed or\ntwice the coefficients nearly halve its damping. Bristles \
         and contacts make 0.05 1/s. So -1.27 1/s at 2.44 Hz, of another program, are\nthose of about twice \
         these coefficients a wheel. What counts: bristles of stuck faces as springs at each contact point, \
         the lateral slip\ny' + r φ' - V ψ at the height of the rails, and the give of the support: an axle \
         that rolls on it by φ keeps its rolling radii. (Taken as\na creepage of l φ/r at each wheel, this \
         makes -2.478 1/s at 2.478 Hz.)\n\n\
         Without friction the pitch has {:.4} 1/s at {:.4} Hz, in the separate model {:.4} at {:.4}: of \
         contacts and control coils. The force\nthat holds the speed acts 49 in below the body's center of \
         gravity and adds c h²/(2 I), here 0.043 1/s (in the separate model {:.4} in\nall). It is of the \
         control, not of the car, and is left out of linearizations.",
        pitch.growth, pitch.frequency, coasting[0], coasting[1], held[0]
    );
    Ok(out)
}

pub fn ends_of_trucks() -> Result<String, Failure> {
    let mut out = "## Leading and trailing wedges\n\n\
         Friction losses of the wedges at both ends of the trucks, 1,000 lbf·in, over the built-in runs.\n\n\
         | case | front: leading | trailing | ratio | rear: leading | trailing | ratio |\n\
         |---|---|---|---|---|---|---|\n"
        .to_owned();
    let runs = [
        ("car_twist_and_roll_loaded", "held"),
        ("car_twist_and_roll_loaded", "coasting"),
        ("car_pitch_and_bounce_loaded", "held"),
    ];
    let lines = each(&runs, |(name, kind)| {
        let result = run(name, &set(&[&format!("speed.kind={kind}")]))?;
        let mut line = format!("| `{name}`, {kind} |");
        for truck in 1..=2 {
            let [mut leading, mut trailing] = [0.0; 2];
            for side in ["left", "right"] {
                for (sum, end) in [(&mut leading, "leading"), (&mut trailing, "trailing")] {
                    let own = column(&result, &format!("truck_{truck}_{end}_{side}_friction_loss"))?;
                    *sum += own.last().copied().unwrap_or(f64::NAN) / (1e3 * POUND_FORCE * 0.0254);
                }
            }
            let _ = write!(
                line,
                " {leading:.1} | {trailing:.1} | {:.2} |",
                leading / trailing
            );
        }
        Ok(line + "\n")
    })?;
    out.extend(lines);
    out += "\nThe inputs are alike at all axles, but not at one time: the trailing axle meets each joint \
         later. Side frames stand on axles at ±35 in and\nhave their columns at ±9.8 in. At an angular \
         frequency ω both columns move by the same amplitude, with phases of ±φ,\ntan φ = (9.8/35) tan(ω 35 \
         in/V). The bolster lags behind the side frame by δ, since friction and coils must move the body. \
         With its\n\
         amplitude H in parts of that of the columns, the strokes at both ends are √(1 + H² - 2 H cos(φ ± \
         δ)), the larger one at the leading end.\nWhere wedges hardly slide (H near 1) they are as (φ + δ) \
         to (φ - δ): at 16 mph φ is 8°, and a lag of 3° makes twice the stroke. Where\nthey slide far, the \
         ends differ little.\n\n\
         Runs of a loaded car tell this from a fault (tests of the crate `car`). Rails dip by 1.5 in \
         over 30 ft, as at 50 mph:\n\n\
         | run | front: leading, J | trailing | ratio | rear: leading | trailing | ratio |\n\
         |---|---|---|---|---|---|---|\n\
         | the car stands, rails dip under all axles at once | 7772 | 7772 | 1.000 | 7772 | 7772 | 1.000 |\n\
         | it stands, they dip from the first axle to the last \
         | 2786 | 2039 | 1.366 | 3238 | 2772 | 1.168 |\n\
         | it stands, they dip from the last axle to the first \
         | 2772 | 3238 | 0.856 | 2039 | 2786 | 0.732 |\n\
         | it stands, both axles of a truck at once | 5752 | 5544 | 1.038 | 4979 | 5196 | 0.958 |\n\
         | it runs over the dip without a drive | 2779 | 1992 | 1.395 | 3213 | 2695 | 1.192 |\n\n\
         The losses swap their ends with the order of the axles, to the error of integration; the travel \
         itself, with\ncreep and drag, changes 3 %. A car that runs backward over the mirrored track loses \
         what its mirror image loses.\n";
    Ok(out)
}
