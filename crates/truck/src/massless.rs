//! Wedges without mass and empirical warp springs: the industry's model of a truck, as connections.
//!
//! In rigs, whose bodies have their reference frames along the fixed axes, they act on differences of
//! coordinates, as in the industry's programs. On track the frames of bodies are turned and headings large:
//! there they act between markers on bolster and side frame, along the axes of the side frame.

use mechanics::connection::{Accumulator, ColumnFace, Connection, Law, SpringDamper, Wedge as MasslessWedge};
use mechanics::curve::{Curve, CurveError};
use mechanics::friction::FrictionLaw;
use mechanics::link::Marker;
use wedge::parameters::Damping;

use crate::parameters::{ControlCoil, Wedge};
use crate::units::{INCH, POUND_FORCE, POUND_PER_INCH};

/// Greatest normal force of a column, N: 1e5 lbf, as in NUCARS's files of a half-truck.
const NORMAL_LIMIT: f64 = 1e5 * POUND_FORCE;
/// Friction by tanh is a damping of 1e4 lbf·s/in up to the limit, as in their elements without bristles,
/// N·s/m.
const LVB: f64 = 1e4 * POUND_PER_INCH;
/// The warp of a truck at its stop in these files, rad, and the stop's stiffness, N·m/rad.
const WARP_STOP: f64 = 0.030;
const WARP_STOP_STIFFNESS: f64 = 6.4e7 * POUND_FORCE * INCH;

/// The joint of two bodies by a connection.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seat {
    /// Its point in the nominal layout, m.
    pub point: [f64; 3],
    /// Markers there, of bodies whose reference frames do not stand along the fixed axes.
    pub markers: Option<[Marker; 2]>,
}

/// Returns a nest's empirical warp spring, which has this moment (N·m) at 30 mrad and meets a stop there.
///
/// NUCARS's files have 52.5 kip·in for a worn truck, 255 for a new one, 1,275 for a stiff H-frame; they say
/// that these values stand for the missing effects of wedging action.
///
/// # Errors
/// The moment is not finite.
pub fn empirical_warp(moment: f64) -> Result<Curve, CurveError> {
    let stopped = moment + WARP_STOP_STIFFNESS * 0.01;
    Curve::mirrored_from_origin(vec![[0.0, 0.0], [WARP_STOP, moment], [WARP_STOP + 0.01, stopped]])
}

/// Returns the connection that stands for an empirical warp spring between bolster `a` and side frame `b`.
pub(crate) fn warp_spring(name: String, [a, b]: [usize; 2], at: Seat, moment: &Curve) -> Connection {
    Connection {
        name,
        account: String::new(),
        a,
        b,
        point: at.point,
        markers: at.markers,
        law: Law::Springs(vec![(5, SpringDamper::spring(moment.clone()))]),
    }
}

/// Returns the massless wedge between bolster `a` and side frame `b`; `end` is 1 at the leading end, -1 at
/// the trailing one.
pub(crate) fn massless_wedge(
    name: &str,
    [a, b]: [usize; 2],
    at: Seat,
    (wedge, damping, end): (&Wedge, Damping, f64),
) -> Connection {
    // A worn column lies deeper along its normal, a worn slope too: the wedge rises.
    let depth = wedge.wear.column / libm::cos(wedge.toe) + wedge.wear.slope / libm::cos(wedge.angle);
    let slope = -libm::tan(wedge.toe);
    let law = MasslessWedge {
        angle: wedge.angle,
        coil: coil(&wedge.control_coil),
        preload: wedge.control_coil.preload(),
        coil_in_bolster: damping == Damping::Constant,
        column: ColumnFace::Profile {
            depth: Curve::linear(slope).scaled(1.0, depth),
            direction: end,
        },
        slope_friction: wedge.slope_friction.coefficient,
        column_friction: wedge.column_friction.coefficient,
        accumulator: match wedge.column_friction.law {
            FrictionLaw::Bristle { stiffness, damping } => Accumulator::Bristle { stiffness, damping },
            FrictionLaw::Tanh { .. } => Accumulator::Viscous { damping: LVB },
        },
        normal_limit: NORMAL_LIMIT,
    };
    Connection {
        name: format!("{name}_wedge"),
        account: name.to_owned(),
        a,
        b,
        point: at.point,
        markers: at.markers,
        law: Law::Wedge(law),
    }
}

/// Returns the force of a control coil less its preload (N, negative where it pushes less) by its extension
/// (m).
fn coil(coil: &ControlCoil) -> Curve {
    match coil {
        ControlCoil::Shear(spring) => {
            let line = |extension: f64| spring.stiffness * extension;
            let solid = spring.solid.and_then(|[travel, stiffness]| {
                let pressed = line(-travel - INCH) - stiffness * INCH;
                Curve::new(vec![
                    [-travel - INCH, pressed],
                    [-travel, line(-travel)],
                    [0.0, 0.0],
                ])
                .ok()
            });
            solid.unwrap_or_else(|| Curve::linear(spring.stiffness))
        }
        ControlCoil::Table(spring) => spring.table().scaled(-1.0, spring.load(0.0)),
        ControlCoil::Nothing => Curve::linear(0.0),
        ControlCoil::Thesis(coil, _) => {
            let force = |extension: f64| coil.law.force(coil.free_length - coil.nominal_length - extension);
            let points = (-8..=8).map(|i| f64::from(i) * 0.5 * INCH);
            let points = points
                .map(|extension| [extension, force(0.0) - force(extension)])
                .collect();
            Curve::new(points).unwrap_or_else(|_| Curve::linear(force(-INCH) - force(0.0)))
        }
    }
}
