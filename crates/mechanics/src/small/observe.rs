//! Derived quantities: everything that a state says, for outputs.

use integrate::Problem;

use super::forces::{SpatialLaw, deflection_at};
use super::law::wedge::{WedgeLaw, WedgeState};
use super::{Grip, Spatial, System};
use crate::system::Mode;

/// A body's displacements from the drawn layout and their rates (SI).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BodyState {
    /// All six coordinates of its centre of gravity.
    pub coordinates: [f64; 6],
    /// Their rates.
    pub speeds: [f64; 6],
    /// Their accelerations.
    pub accelerations: [f64; 6],
}

/// A connection (SI); components in the order of [`super::Law::coordinates`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConnectionState {
    /// Strokes, extension positive.
    pub strokes: Vec<f64>,
    /// Their rates.
    pub velocities: Vec<f64>,
    /// Forces and moments in the strokes' sense: -f acts on body A, +f on body B.
    pub forces: Vec<f64>,
    /// What its friction does, if it has any.
    pub mode: Option<Mode>,
    /// What a wedge does inside.
    pub wedge: Option<WedgeState>,
    /// Stored energy, accumulators included, J.
    pub energy: f64,
}

/// Energies of the whole system, J.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energies {
    /// Kinetic energy of the free bodies.
    pub kinetic: f64,
    /// Their potential energy in the gravity field, zero in the drawn layout.
    pub gravity: f64,
    /// Energy of springs, also behind gaps and under surfaces.
    pub springs: f64,
    /// Energy of the wedges' coils.
    pub coils: f64,
    /// Energy of the force accumulators.
    pub accumulators: f64,
}

impl Energies {
    /// All of it.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.gravity + self.springs + self.coils + self.accumulators
    }
}

/// Everything that a state says.
#[derive(Clone, Debug, PartialEq)]
pub struct Observation {
    /// Time, s.
    pub time: f64,
    /// All bodies.
    pub bodies: Vec<BodyState>,
    /// All connections.
    pub connections: Vec<ConnectionState>,
    /// Energies.
    pub energies: Energies,
    /// Values of the quadratures, J, in the order of [`System::channels`].
    pub quadratures: Vec<f64>,
}

impl Observation {
    /// Energy that came from nowhere since a start with the stored energy `start` (J) and quadratures at zero: work of the
    /// inputs less what is stored and lost. Zero but for the errors of the integration.
    #[must_use]
    pub fn residual(&self, start: f64) -> f64 {
        let (work, losses) = self
            .quadratures
            .split_first()
            .map_or((0.0, 0.0), |(work, losses)| (*work, losses.iter().sum::<f64>()));
        self.energies.total() - start - work + losses
    }
}

impl System {
    /// Everything that the state `x` at `time` says.
    #[must_use]
    pub fn observe(&mut self, time: f64, x: &[f64]) -> Observation {
        let mut dx = vec![0.0; x.len()];
        self.derivative(time, x, &mut dx);
        let [_, accelerations, ..] = self.layout.split(&dx);
        let [_, _, internal, quadratures] = self.layout.split(x);
        let mut energies = Energies::default();
        for free in &self.free {
            let (place, rate) = (&self.positions[free.body], &self.rates[free.body]);
            for (j, &k) in free.free.iter().enumerate() {
                energies.kinetic += 0.5 * free.inertia[j] * rate[k] * rate[k];
                energies.gravity -= free.weight[j] * place[k];
            }
        }
        let bodies = (0..self.positions.len()).map(|body| {
            let mut state = BodyState {
                coordinates: self.positions[body],
                speeds: self.rates[body],
                accelerations: self.accelerations[body],
            };
            if let Some(number) = self.free_number[body] {
                let free = &self.free[number];
                for (j, &k) in free.free.iter().enumerate() {
                    state.accelerations[k] = accelerations[free.offset + j];
                }
            }
            state
        });
        Observation {
            time,
            bodies: bodies.collect(),
            connections: self.connections(internal, &mut energies),
            energies,
            quadratures: quadratures.to_vec(),
        }
    }

    /// The power of each wedge's friction on its column at `time` and state `x`, W, with the number of its connection: what
    /// [`System::observe`] says of it, without all the rest.
    pub fn column_powers(&mut self, time: f64, x: &[f64], mut each: impl FnMut(usize, f64)) {
        self.place(time, x);
        let [_, _, internal, _] = self.layout.split(x);
        for wedge in &self.wedges {
            let (inside, rates) = self.inside(wedge, internal);
            each(wedge.site.connection, -inside.column_friction * rates[0]);
        }
    }

    /// What a wedge does inside, and the rates of its strokes.
    fn inside(&self, wedge: &Spatial<WedgeLaw>, internal: &[f64]) -> (WedgeState, [f64; 3]) {
        let site = &wedge.site;
        let (strokes, rates) = (site.strokes(&self.positions), site.strokes(&self.rates));
        let deflection = deflection_at(wedge.internal, internal);
        let mut inside = WedgeState::default();
        wedge
            .law
            .evaluate_with(strokes, rates, deflection, self.grips.wedges, |seen| {
                inside = seen;
            });
        (inside, rates)
    }

    /// All connections; adds their energies.
    fn connections(&self, internal: &[f64], energies: &mut Energies) -> Vec<ConnectionState> {
        let connections = self.model.connections.iter();
        let mut all: Vec<ConnectionState> = connections
            .map(|connection| {
                let count = connection.law.coordinates().len();
                ConnectionState {
                    strokes: vec![0.0; count],
                    velocities: vec![0.0; count],
                    forces: vec![0.0; count],
                    ..ConnectionState::default()
                }
            })
            .collect();
        let springs = self.springs.iter().map(|axis| {
            let ([s], [v]) = (axis.site.strokes(&self.positions), axis.site.strokes(&self.rates));
            (
                &axis.site,
                s,
                v,
                axis.law.evaluate(s, v).force,
                axis.law.energy(s),
            )
        });
        let gaps = self.gaps.iter().map(|axis| {
            let ([s], [v]) = (axis.site.strokes(&self.positions), axis.site.strokes(&self.rates));
            (
                &axis.site,
                s,
                v,
                axis.law.evaluate(s, v).force,
                axis.law.energy(s),
            )
        });
        for (site, stroke, rate, force, energy) in springs.chain(gaps) {
            let state = &mut all[site.connection];
            state.strokes[site.component] = stroke;
            state.velocities[site.component] = rate;
            state.forces[site.component] = force;
            state.energy += energy;
            energies.springs += energy;
        }
        for surface in &self.surfaces {
            let state = &mut all[surface.site.connection];
            self.fill(surface, self.grips.surfaces, internal, state);
            let spring = surface.law.energy(state.strokes[0]);
            let held = surface
                .law
                .accumulator
                .energy(deflection_at(surface.internal, internal));
            state.energy = spring + held;
            energies.springs += spring;
            energies.accumulators += held;
        }
        for wedge in &self.wedges {
            let state = &mut all[wedge.site.connection];
            self.fill(wedge, self.grips.wedges, internal, state);
            let (inside, _) = self.inside(wedge, internal);
            let deflection = deflection_at(wedge.internal, internal);
            let coil = wedge.law.energy(inside.coil_stroke);
            let held = wedge.law.accumulator.energy(deflection);
            state.wedge = Some(inside);
            state.energy = coil + held;
            energies.coils += coil;
            energies.accumulators += held;
        }
        // Components that carry nothing (a coordinate without spring and damper) still have strokes.
        self.fill_idle(&mut all);
        all
    }

    /// Strokes, rates, forces and mode of a friction element.
    fn fill<L: SpatialLaw>(
        &self,
        element: &Spatial<L>,
        grip: Grip,
        internal: &[f64],
        state: &mut ConnectionState,
    ) {
        let site = &element.site;
        let (strokes, rates) = (site.strokes(&self.positions), site.strokes(&self.rates));
        let deflection = deflection_at(element.internal, internal);
        let done = element.law.act(strokes, rates, deflection, grip);
        let law_says = match grip {
            Grip::Law => done.friction,
            _ => element.law.act(strokes, rates, deflection, Grip::Law).friction,
        };
        state.mode = Some(law_says.mode());
        // A wedge without a longitudinal component leaves it out.
        let components: &[usize] = match state.strokes.len() {
            2 => &[0, 2],
            _ => &[0, 1, 2],
        };
        for (target, &k) in components.iter().enumerate() {
            state.strokes[target] = strokes[k];
            state.velocities[target] = rates[k];
            state.forces[target] = done.force[k];
        }
    }

    /// Strokes of components without a law.
    fn fill_idle(&self, all: &mut [ConnectionState]) {
        for (connection, state) in self.model.connections.iter().zip(all) {
            if !matches!(connection.law, super::Law::Springs(_)) {
                continue;
            }
            for (component, coordinate) in connection.law.coordinates().into_iter().enumerate() {
                let along = |coordinates: &[[f64; 6]], body: usize| {
                    let center = self.model.bodies[body].center_of_gravity;
                    let offset = std::array::from_fn(|k| connection.point[k] - center[k]);
                    super::place::Row::new(coordinate, offset, &[None; 6]).along(&coordinates[body])
                };
                let stroke = |coordinates: &[[f64; 6]]| {
                    along(coordinates, connection.a) - along(coordinates, connection.b)
                };
                state.strokes[component] = stroke(&self.positions);
                state.velocities[component] = stroke(&self.rates);
            }
        }
    }
}
