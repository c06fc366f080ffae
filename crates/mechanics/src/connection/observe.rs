//! What connections do at a state, for outputs.

use super::forces::{Places, SpatialLaw, deflection_at};
use super::site::Row;
use super::wedge::{WedgeLaw, WedgeState};
use super::{Connections, Grip, Spatial};
use crate::body::Body;
use crate::system::{Energies, Mode};

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

impl Connections {
    /// The power of each wedge's friction on its column, W, with the number of its connection.
    pub fn column_powers(&self, places: Places<'_>, internal: &[f64], mut each: impl FnMut(usize, f64)) {
        for wedge in &self.wedges {
            let (inside, rates) = self.inside(wedge, places, internal);
            each(wedge.site.connection, -inside.column_friction * rates[0]);
        }
    }

    /// What a wedge does inside, and the rates of its strokes.
    fn inside(
        &self,
        wedge: &Spatial<WedgeLaw>,
        (positions, rates): Places<'_>,
        internal: &[f64],
    ) -> (WedgeState, [f64; 3]) {
        let site = &wedge.site;
        let (strokes, rates) = (site.strokes(positions), site.strokes(rates));
        let deflection = deflection_at(wedge.internal, internal);
        let mut inside = WedgeState::default();
        wedge
            .law
            .evaluate_with(strokes, rates, deflection, self.grips.wedges, |seen| {
                inside = seen;
            });
        (inside, rates)
    }

    /// All connections at a place; adds their energies.
    pub fn states(
        &self,
        bodies: &[Body],
        places: Places<'_>,
        internal: &[f64],
        energies: &mut Energies,
    ) -> Vec<ConnectionState> {
        let (positions, rates) = places;
        let mut all: Vec<ConnectionState> = self
            .all
            .iter()
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
            let ([s], [v]) = (axis.site.strokes(positions), axis.site.strokes(rates));
            (
                &axis.site,
                s,
                v,
                axis.law.evaluate(s, v).force,
                axis.law.energy(s),
            )
        });
        let gaps = self.gaps.iter().map(|axis| {
            let ([s], [v]) = (axis.site.strokes(positions), axis.site.strokes(rates));
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
            energies.spring += energy;
        }
        for surface in &self.surfaces {
            let state = &mut all[surface.site.connection];
            fill(surface, self.grips.surfaces, places, internal, state);
            let spring = surface.law.energy(state.strokes[0]);
            let held = surface
                .law
                .accumulator
                .energy(deflection_at(surface.internal, internal));
            state.energy = spring + held;
            energies.spring += spring;
            energies.bristle += held;
        }
        for wedge in &self.wedges {
            let state = &mut all[wedge.site.connection];
            fill(wedge, self.grips.wedges, places, internal, state);
            let (inside, _) = self.inside(wedge, places, internal);
            let deflection = deflection_at(wedge.internal, internal);
            let coil = wedge.law.energy(inside.coil_stroke);
            let held = wedge.law.accumulator.energy(deflection);
            state.wedge = Some(inside);
            state.energy = coil + held;
            energies.coil += coil;
            energies.bristle += held;
        }
        // Components that carry nothing (a coordinate without spring and damper) still have strokes.
        self.fill_idle(bodies, places, &mut all);
        all
    }

    /// Strokes of components without a law.
    fn fill_idle(&self, bodies: &[Body], (positions, rates): Places<'_>, all: &mut [ConnectionState]) {
        for (connection, state) in self.all.iter().zip(all) {
            if !matches!(connection.law, super::Law::Springs(_)) {
                continue;
            }
            for (component, coordinate) in connection.law.coordinates().into_iter().enumerate() {
                let along = |coordinates: &[[f64; 6]], body: usize| {
                    let center = bodies[body].frame.origin;
                    let offset = std::array::from_fn(|k| connection.point[k] - center[k]);
                    Row::new(coordinate, offset, &[None; 6]).along(&coordinates[body])
                };
                let stroke = |coordinates: &[[f64; 6]]| {
                    along(coordinates, connection.a) - along(coordinates, connection.b)
                };
                state.strokes[component] = stroke(positions);
                state.velocities[component] = stroke(rates);
            }
        }
    }
}

/// Strokes, rates, forces and mode of a friction element.
fn fill<L: SpatialLaw>(
    element: &Spatial<L>,
    grip: Grip,
    (positions, rates): Places<'_>,
    internal: &[f64],
    state: &mut ConnectionState,
) {
    let site = &element.site;
    let (strokes, rates) = (site.strokes(positions), site.strokes(rates));
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
