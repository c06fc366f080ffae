//! Rigid bodies with small displacements, joined by connections, and the element laws of the industry's vehicle
//! dynamics programs.
//!
//! Kinematics are linear: every body has six coordinates of its centre of gravity measured from the drawn layout, levers are
//! those of the layout, the mass matrix is diagonal and constant, there are no gyroscopic terms and no geometric
//! stiffness of weights (a heavy body on soft pitch springs would otherwise topple, which the programs modelled here
//! do not let it do). Axes: x forward, y left, z up. Connections act on strokes (displacement of the point on body A less
//! that on body B, extension positive): a force f in the stroke's sense acts as -f on A and +f on B.
//!
//! A [`Model`] is plain data; [`System::new`] checks it and makes a problem for the integrator, with exact derivatives
//! from the same lines as the forces, an energy ledger, static equilibrium and natural vibrations.
//!
//! How connections of the comparison program's files become [`Law`]s (its tables give ordinates first; read with
//! [`Curve::mirrored_from_origin`] as `[abscissa, ordinate]`; no table: none, or zero):
//!
//! | type | law |
//! |---|---|
//! | 1, 1.1, 1.3 | [`Law::Springs`], one [`SpringDamper`] a coordinate, with its two limits |
//! | 1.2 | [`Law::Gap`] |
//! | 6.3 | [`Law::Wedge`], [`Column::Plain`] toe out, [`Accumulator::Viscous`], both coefficients the same |
//! | 6.7 | the same with two coefficients and a toe direction |
//! | 6.5 | [`Law::Surface`] with [`Accumulator::Bristle`], coordinates 2, 0, 1 |
//! | 6.8 | [`Law::Wedge`], [`Column::Plain`], [`Accumulator::Bristle`]; a constant force is `preload` with a zero `coil`, and stands in the bolster |
//! | 6.9 | [`Law::Wedge`], [`Column::Profile`], [`Accumulator::Bristle`], no `preload` |
//!
//! State vector `(q, u, s, w)`: free coordinates of all free bodies, their rates, deflections of the force
//! accumulators (two an element), quadratures (work of the prescribed motions, every loss). SI units.

mod build;
mod curve;
mod equilibrium;
mod forces;
mod jacobian;
pub mod law;
mod model;
mod modes;
mod observe;
mod options;
mod place;
mod vibration;

use integrate::partitioned::{Layout, Partitioned};
use integrate::{Problem, Singular};

use crate::motion::Motion;
use law::Grip;
use law::gap::Gap;
use law::spring::Spring;
use law::surface::Surface;
use law::wedge::WedgeLaw;
use place::Site;

use crate::system::Mode;
pub use curve::{Curve, CurveError};
pub use equilibrium::StaticFriction;
pub use law::Accumulator;
pub use law::gap::GapDamper;
pub use law::spring::SpringDamper;
pub use law::surface::SurfaceFriction;
pub use law::wedge::{Column, Wedge, WedgeState};
pub use model::{Body, COORDINATES, Connection, Kind, Law, Model, ModelError};
pub use modes::{CLOSING_FORCE, OPENING_FORCE};
use modes::{SIGNS, Signs};
pub use observe::{BodyState, ConnectionState, Energies, Observation};
pub use options::{Branch, GapTension, NegativeRise, Options, SlopeDirection};
pub use vibration::{Held, NoVibration, Vibration, Vibrations};

/// A body that forces move.
#[derive(Clone, Debug)]
struct FreeBody {
    /// Its number among all bodies.
    body: usize,
    /// Its free coordinates.
    free: Vec<usize>,
    /// Its first position among q.
    offset: usize,
    /// Mass or moment of inertia of each free coordinate.
    inertia: Vec<f64>,
    /// Weight along each free coordinate, N.
    weight: Vec<f64>,
    /// Its diagonal block in the Jacobian.
    pair: usize,
}

/// A body that is moved.
#[derive(Clone, Debug)]
struct MovedBody {
    body: usize,
    motions: Box<[Motion; 6]>,
    moves: bool,
}

/// An element on one coordinate.
#[derive(Clone, Debug)]
struct Axis<L> {
    law: L,
    site: Site<1, 1>,
}

/// An element on three coordinates, with friction in two of them.
#[derive(Clone, Debug)]
struct Spatial<L> {
    law: L,
    site: Site<3, 3>,
    /// First internal state, if it has any.
    internal: Option<usize>,
    /// Rows of the powers and of the work by the pair of internal states.
    internal_rows: [Option<usize>; 4],
    /// Its number among the switches.
    switch: usize,
}

/// What friction does in each kind of element.
#[derive(Clone, Copy, Debug, Default)]
struct Grips {
    surfaces: Grip,
    wedges: Grip,
}

/// What a quadrature integrates; all in J.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ChannelKind {
    /// Work done by all prescribed motions on the connections.
    InputWork,
    /// Energy lost in dampers of springs.
    SpringDamping,
    /// Energy lost behind gaps.
    GapDamping,
    /// Energy lost in surface friction.
    SurfaceFriction,
    /// Energy lost in the normal dampers of surface friction.
    SurfaceDamping,
    /// Energy lost in the wedges' friction on their columns.
    ColumnFriction,
    /// Work of the wedges' friction on their slopes; over a cycle a loss, while the friction force rebounds it gives back.
    SlopeFriction,
    /// Work that goes into the simplified kinematics of the wedges (see [`law::wedge`]); small, of either sign.
    WedgeKinematics,
}

impl ChannelKind {
    /// Its name, as in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::InputWork => "input_work",
            Self::SpringDamping => "spring_damping_loss",
            Self::GapDamping => "gap_damping_loss",
            Self::SurfaceFriction => "surface_friction_loss",
            Self::SurfaceDamping => "surface_damping_loss",
            Self::ColumnFriction => "wedge_column_loss",
            Self::SlopeFriction => "wedge_slope_loss",
            Self::WedgeKinematics => "wedge_kinematics_work",
        }
    }
}

/// A system with small displacements, ready to be integrated.
#[derive(Clone, Debug)]
pub struct System {
    model: Model,
    free: Vec<FreeBody>,
    moved: Vec<MovedBody>,
    /// For each body its number among the free ones.
    free_number: Vec<Option<usize>>,
    springs: Vec<Axis<Spring>>,
    gaps: Vec<Axis<Gap>>,
    surfaces: Vec<Spatial<Surface>>,
    wedges: Vec<Spatial<WedgeLaw>>,
    /// The connection of each switch.
    switches: Vec<usize>,
    channels: Vec<ChannelKind>,
    layout: Layout,
    scales: Vec<f64>,
    /// What friction does in surfaces and in wedges.
    grips: Grips,
    /// The time at which the prescribed bodies were placed.
    moved_at: f64,
    /// A time inside the present smooth piece of the motions.
    reference: f64,
    positions: Vec<[f64; 6]>,
    rates: Vec<[f64; 6]>,
    accelerations: Vec<[f64; 6]>,
    loads: Vec<[f64; 6]>,
    jacobian: Partitioned,
}

impl System {
    /// The system of a model.
    ///
    /// # Errors
    /// What [`ModelError`] names.
    pub fn new(model: Model) -> Result<Self, ModelError> {
        model.check()?;
        Ok(build::build(model))
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// The quadratures: what each of them integrates.
    #[must_use]
    pub fn channels(&self) -> &[ChannelKind] {
        &self.channels
    }

    /// The parts of the state vector.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// The connection of each switch: connections with friction, in the order of the switches' modes
    /// ([`crate::system::Mode`]).
    #[must_use]
    pub fn switches(&self) -> &[usize] {
        &self.switches
    }

    /// The state at the start: the drawn layout, at rest, accumulators relaxed.
    #[must_use]
    pub fn initial_state(&self) -> Vec<f64> {
        vec![0.0; self.layout.len()]
    }

    /// The place of a body's coordinate (0..6) among the positions, if it is free. Its speed stands
    /// `layout().speeds` later.
    #[must_use]
    pub fn position_of(&self, body: usize, coordinate: usize) -> Option<usize> {
        let free = &self.free[(*self.free_number.get(body)?)?];
        let slot = free.free.iter().position(|k| *k == coordinate)?;
        Some(free.offset + slot)
    }

    /// The first of the two accumulator deflections of a connection in the state vector, if it has any.
    #[must_use]
    pub fn deflection_of(&self, connection: usize) -> Option<usize> {
        let surfaces = self.surfaces.iter().map(|e| (e.site.connection, e.internal));
        let wedges = self.wedges.iter().map(|e| (e.site.connection, e.internal));
        let (_, internal) = surfaces.chain(wedges).find(|(number, _)| *number == connection)?;
        Some(2 * self.layout.speeds + internal?)
    }

    /// Takes the smooth piece of the motions from another copy of the same system, so that a copy kept for
    /// observation sees the same side of a break as the one that is being integrated.
    pub fn segment_like(&mut self, other: &Self) {
        if self.reference != other.reference {
            self.reference = other.reference;
            self.moved_at = f64::NAN;
        }
    }

    /// Brings all bodies to `time` and state `x`.
    #[inline]
    fn place(&mut self, time: f64, x: &[f64]) {
        if time != self.moved_at {
            for moved in &self.moved {
                if !moved.moves && self.moved_at.is_finite() {
                    continue;
                }
                for (k, motion) in moved.motions.iter().enumerate() {
                    let [value, rate, acceleration] = motion.evaluate(time, self.reference);
                    self.positions[moved.body][k] = value;
                    self.rates[moved.body][k] = rate;
                    self.accelerations[moved.body][k] = acceleration;
                }
            }
            self.moved_at = time;
        }
        let (q, u) = x.split_at(self.layout.speeds);
        for free in &self.free {
            let (positions, rates) = (&mut self.positions[free.body], &mut self.rates[free.body]);
            for (j, &k) in free.free.iter().enumerate() {
                positions[k] = q[free.offset + j];
                rates[k] = u[free.offset + j];
            }
        }
    }
}

impl Problem for System {
    fn dimension(&self) -> usize {
        self.layout.len()
    }

    fn dynamic_states(&self) -> usize {
        self.layout.len() - self.layout.quadratures
    }

    fn displacements(&self) -> usize {
        self.layout.speeds
    }

    fn scales(&self) -> &[f64] {
        &self.scales
    }

    fn next_time_discontinuity(&mut self, start: f64) -> f64 {
        let motions = self.moved.iter().flat_map(|moved| moved.motions.iter());
        let end = motions
            .filter_map(|motion| motion.next_break(start))
            .min_by(f64::total_cmp)
            .unwrap_or(f64::INFINITY);
        self.reference = if end.is_finite() {
            0.5 * (start + end)
        } else {
            start + 1.0
        };
        self.moved_at = f64::NAN;
        end
    }

    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]) {
        self.place(time, x);
        self.forces(x, dx);
    }

    fn linearize(&mut self, time: f64, x: &[f64], _: &[f64], df_dt: &mut [f64]) {
        self.place(time, x);
        self.differentiate(x, df_dt);
    }

    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.jacobian.factor(shift)
    }

    fn solve(&mut self, b: &mut [f64]) {
        self.jacobian.solve(b);
    }

    fn discrete_state_count(&self) -> usize {
        self.switches.len()
    }

    fn initial_discrete_states(&mut self, time: f64, x: &[f64], states: &mut [u8]) {
        self.place(time, x);
        self.find_modes(x, states);
    }

    /// What presses each element (N) and the load of its accumulator.
    fn event_variable_count(&self) -> usize {
        SIGNS * self.switches.len()
    }

    fn event_variables(&mut self, time: f64, x: &[f64], variables: &mut [f64]) {
        self.place(time, x);
        self.mode_signs(x, variables);
    }

    fn group_event_functions(&mut self, _: usize, variables: &[f64], states: &[u8], functions: &mut [f64]) {
        for (i, (function, state)) in functions.iter_mut().zip(states).enumerate() {
            *function = Signs::of(variables, i).margin(Mode::from_number(*state));
        }
    }

    fn next_discrete_state(&mut self, _: usize, variables: &[f64], index: usize, state: u8) -> u8 {
        Signs::of(variables, index).next(Mode::from_number(state)) as u8
    }
}
