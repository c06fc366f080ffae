//! Extensions, forces and energies of connections at a state, for outputs.

use super::between::Between;
use super::forces::{CoordinatesAndRates, SpatialLaw, deflection_at};
use super::site::CoordinateRow;
use super::wedge::{WedgeLaw, WedgeState};
use super::{Connections, FrictionRule, Spatial};
use crate::body::Body;
use crate::contact_state::ContactState;
use crate::energy::Energies;

/// A connection (SI); components in the order of [`super::Law::coordinates`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ConnectionState {
    /// Extensions, extension positive.
    pub extensions: Vec<f64>,
    /// Their rates.
    pub velocities: Vec<f64>,
    /// Forces and moments in the direction of the extension: -f acts on body A, +f on body B.
    pub forces: Vec<f64>,
    /// Contact state, if it has friction.
    pub contact_state: Option<ContactState>,
    /// Internal forces and motions of a wedge.
    pub wedge: Option<WedgeState>,
    /// Stored energy, accumulators included, J.
    pub energy: f64,
}

impl Connections {
    /// The power of each wedge's friction on its column, W, with the number of its connection.
    pub fn column_powers(
        &self,
        coordinates: CoordinatesAndRates<'_>,
        internal: &[f64],
        mut each: impl FnMut(usize, f64),
    ) {
        for wedge in &self.wedges {
            let (inside, rates) = self.inside(wedge, coordinates, internal);
            each(wedge.site.connection, -inside.column_friction * rates[0]);
        }
    }

    /// Calls `each` with the number of each wedge's connection and the deflection of its coil, m, extension
    /// positive.
    pub fn coil_deflections(
        &self,
        coordinates: CoordinatesAndRates<'_>,
        internal: &[f64],
        mut each: impl FnMut(usize, f64),
    ) {
        for wedge in &self.wedges {
            let (inside, _) = self.inside(wedge, coordinates, internal);
            each(wedge.site.connection, inside.coil_extension);
        }
    }

    /// Returns the internal state of a wedge, and the rates of its strokes.
    fn inside(
        &self,
        wedge: &Spatial<WedgeLaw>,
        coordinates: CoordinatesAndRates<'_>,
        internal: &[f64],
    ) -> (WedgeState, [f64; 3]) {
        let motion = wedge.site.motion(coordinates);
        let deflection = deflection_at(wedge.internal, internal);
        let mut inside = WedgeState::default();
        let (extensions, rates) = (motion.extensions, motion.rates);
        wedge.law.evaluate_with(
            extensions,
            rates,
            deflection,
            self.friction_rules.wedges,
            |state| {
                inside = state;
            },
        );
        (inside, rates)
    }

    /// Returns the states of all connections at given coordinates and rates; adds their energies to
    /// `energies`.
    pub fn states(
        &self,
        bodies: &[Body],
        coordinates: CoordinatesAndRates<'_>,
        internal: &[f64],
        energies: &mut Energies,
    ) -> Vec<ConnectionState> {
        let mut all: Vec<ConnectionState> = self
            .all
            .iter()
            .map(|connection| {
                let count = connection.law.coordinates().len();
                ConnectionState {
                    extensions: vec![0.0; count],
                    velocities: vec![0.0; count],
                    forces: vec![0.0; count],
                    ..ConnectionState::default()
                }
            })
            .collect();
        let springs = self.springs.iter().map(|axis| {
            let motion = axis.site.motion(coordinates);
            let ([s], [v]) = (motion.extensions, motion.rates);
            (
                &axis.site,
                s,
                v,
                axis.law.evaluate(s, v).force,
                axis.law.energy(s),
            )
        });
        let gaps = self.gaps.iter().map(|axis| {
            let motion = axis.site.motion(coordinates);
            let ([s], [v]) = (motion.extensions, motion.rates);
            (
                &axis.site,
                s,
                v,
                axis.law.evaluate(s, v).force,
                axis.law.energy(s),
            )
        });
        for (site, extension, rate, force, energy) in springs.chain(gaps) {
            let state = &mut all[site.connection];
            state.extensions[site.component] = extension;
            state.velocities[site.component] = rate;
            state.forces[site.component] = force;
            state.energy += energy;
            energies.spring += energy;
        }
        for surface in &self.surfaces {
            let state = &mut all[surface.site.connection];
            fill(
                surface,
                self.friction_rules.surfaces,
                coordinates,
                internal,
                state,
            );
            let spring = surface.law.energy(state.extensions[0]);
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
            fill(wedge, self.friction_rules.wedges, coordinates, internal, state);
            let (inside, _) = self.inside(wedge, coordinates, internal);
            let deflection = deflection_at(wedge.internal, internal);
            let coil = wedge.law.energy(inside.coil_extension);
            let held = wedge.law.accumulator.energy(deflection);
            state.wedge = Some(inside);
            state.energy = coil + held;
            energies.coil += coil;
            energies.bristle += held;
        }
        // Components without spring and damper have no force, but an extension.
        self.fill_idle(bodies, coordinates, &mut all);
        all
    }

    /// Extensions of components without a law.
    fn fill_idle(
        &self,
        bodies: &[Body],
        (positions, rates): CoordinatesAndRates<'_>,
        all: &mut [ConnectionState],
    ) {
        for (connection, state) in self.all.iter().zip(all) {
            if !matches!(connection.law, super::Law::Springs(_)) {
                continue;
            }
            for (component, coordinate) in connection.law.coordinates().into_iter().enumerate() {
                if let Some(markers) = connection.markers {
                    let numbers = [connection.a, connection.b];
                    let own = Between::new([coordinate], numbers, bodies, markers);
                    let levers = own.levers_at(positions);
                    let speeds = own.both(rates);
                    let [row] = &levers.by_coordinates;
                    state.extensions[component] = levers.extensions[0];
                    state.velocities[component] = row.iter().zip(&speeds).map(|(a, b)| a * b).sum();
                    continue;
                }
                let along = |coordinates: &[[f64; 6]], body: usize| {
                    let center = bodies[body].frame.origin;
                    let offset = std::array::from_fn(|k| connection.point[k] - center[k]);
                    CoordinateRow::new(coordinate, offset, &[None; 6]).along(&coordinates[body])
                };
                let extension = |coordinates: &[[f64; 6]]| {
                    along(coordinates, connection.a) - along(coordinates, connection.b)
                };
                state.extensions[component] = extension(positions);
                state.velocities[component] = extension(rates);
            }
        }
    }
}

/// Extensions, rates, forces and contact state of a friction element.
fn fill<L: SpatialLaw>(
    element: &Spatial<L>,
    rule: FrictionRule,
    coordinates: CoordinatesAndRates<'_>,
    internal: &[f64],
    state: &mut ConnectionState,
) {
    let motion = element.site.motion(coordinates);
    let (extensions, rates) = (motion.extensions, motion.rates);
    let deflection = deflection_at(element.internal, internal);
    let done = element.law.force_at(extensions, rates, deflection, rule);
    let law_says = match rule {
        FrictionRule::Law => done.friction,
        _ => {
            element
                .law
                .force_at(extensions, rates, deflection, FrictionRule::Law)
                .friction
        }
    };
    state.contact_state = Some(law_says.contact_state());
    // A wedge without a longitudinal component leaves it out.
    let components: &[usize] = match state.extensions.len() {
        2 => &[0, 2],
        _ => &[0, 1, 2],
    };
    for (target, &k) in components.iter().enumerate() {
        state.extensions[target] = extensions[k];
        state.velocities[target] = rates[k];
        state.forces[target] = done.force[k];
    }
}
