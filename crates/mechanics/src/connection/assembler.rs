//! Assembly of connections between bodies.

use std::collections::BTreeMap;

use super::between::Between;
use super::gap::Gap;
use super::site::{ConnectionEnd, CoordinateRow, Site};
use super::spring::Spring;
use super::surface::Surface;
use super::wedge::{ColumnFace, WedgeLaw};
use super::{Axis, Connection, Connections, Law, Options, Spatial};
use crate::body::Body;
use crate::energy::{EnergyTerm, EnergyTermKind};
use crate::parts::Parts;

/// Assembles connections between bodies.
pub(crate) struct ConnectionAssembler<'m> {
    pub bodies: &'m [Body],
    /// For each body its number among the free ones.
    pub free_number: &'m [Option<usize>],
    /// For each body the numbers of its free coordinates.
    pub slots: &'m [[Option<usize>; 6]],
    /// Quadratures and internal states of the elements before them.
    pub parts: &'m mut Parts,
    /// Rows of quadratures by (energy term, free body).
    quadratures: BTreeMap<(usize, usize), usize>,
    couplings: Vec<(usize, usize)>,
    found: Connections,
}

impl<'m> ConnectionAssembler<'m> {
    /// Returns an assembler that begins after the elements of `parts`.
    pub fn new(
        bodies: &'m [Body],
        free_number: &'m [Option<usize>],
        slots: &'m [[Option<usize>; 6]],
        parts: &'m mut Parts,
    ) -> Self {
        Self {
            bodies,
            free_number,
            slots,
            parts,
            quadratures: BTreeMap::new(),
            couplings: Vec::new(),
            found: Connections::default(),
        }
    }

    /// Returns the elements of connections that have been checked, and the pairs of free bodies that they
    /// couple.
    pub fn attach(
        mut self,
        connections: Vec<Connection>,
        options: &Options,
    ) -> (Connections, Vec<(usize, usize)>) {
        for (kind, element) in energy_terms(&connections) {
            self.parts.energy_terms.push(EnergyTerm { kind, element });
        }
        let placer = &mut self;
        for (index, connection) in connections.iter().enumerate() {
            match &connection.law {
                Law::Springs(list) => {
                    for (component, (coordinate, law)) in list.iter().enumerate() {
                        if let Some(law) = Spring::new(law) {
                            let loss = law.damps().then_some(EnergyTermKind::SpringDamping);
                            let site = placer.site(connection, index, component, [*coordinate], [loss]);
                            placer.found.springs.push(Axis { law, site });
                        }
                    }
                }
                Law::Gap(coordinate, law) => {
                    let site = placer.site(
                        connection,
                        index,
                        0,
                        [*coordinate],
                        [Some(EnergyTermKind::GapDamping)],
                    );
                    placer.found.gaps.push(Axis {
                        law: Gap::new(law, options),
                        site,
                    });
                }
                Law::Surface(law) => {
                    let prepared = Surface::new(law, options.accumulator_damping);
                    let losses = [
                        Some(EnergyTermKind::SurfaceFriction),
                        prepared.damps().then_some(EnergyTermKind::SurfaceDamping),
                        None,
                    ];
                    let states = law.accumulator.states();
                    let surface =
                        placer.spatial(connection, index, law.coordinates, losses, prepared, states);
                    placer.found.surfaces.push(surface);
                }
                Law::Wedge(law) => {
                    let prepared = WedgeLaw::new(law, options);
                    let more = prepared.is_spatial();
                    let losses = [
                        Some(EnergyTermKind::ColumnFriction),
                        more.then_some(EnergyTermKind::SlopeFriction),
                        more.then_some(EnergyTermKind::WedgeKinematics),
                    ];
                    let wedge = placer.spatial(
                        connection,
                        index,
                        [2, 0, 1],
                        losses,
                        prepared,
                        law.accumulator.states(),
                    );
                    placer.found.wedges.push(wedge);
                }
            }
        }
        self.found.all = connections;
        (self.found, self.couplings)
    }
}

/// Returns the quadratures that connections need: kinds, with the names of accounts.
pub(crate) fn energy_terms(connections: &[Connection]) -> Vec<(EnergyTermKind, String)> {
    let mut all = Vec::new();
    for connection in connections {
        let kinds = kinds(&connection.law).into_iter();
        all.extend(kinds.map(|kind| (kind, connection.account.clone())));
    }
    all.sort();
    all.dedup();
    all
}

/// Returns the kinds of quadratures that a law needs.
fn kinds(law: &Law) -> Vec<EnergyTermKind> {
    match law {
        Law::Springs(list) => {
            let damps = |law| Spring::new(law).is_some_and(|law| law.damps());
            let damps = list.iter().any(|(_, law)| damps(law));
            damps
                .then_some(EnergyTermKind::SpringDamping)
                .into_iter()
                .collect()
        }
        Law::Gap(..) => vec![EnergyTermKind::GapDamping],
        Law::Surface(law) => {
            let damps = law.damper.as_ref().is_some_and(|curve| !curve.is_zero());
            let damping = damps.then_some(EnergyTermKind::SurfaceDamping);
            [EnergyTermKind::SurfaceFriction]
                .into_iter()
                .chain(damping)
                .collect()
        }
        Law::Wedge(law) => match law.column {
            ColumnFace::Plain { .. } => vec![EnergyTermKind::ColumnFriction],
            ColumnFace::Profile { .. } => vec![
                EnergyTermKind::ColumnFriction,
                EnergyTermKind::SlopeFriction,
                EnergyTermKind::WedgeKinematics,
            ],
        },
    }
}

impl ConnectionAssembler<'_> {
    /// Returns the site of an element: bodies, rows of its displacements, quadratures.
    fn site<const D: usize, const P: usize>(
        &mut self,
        connection: &Connection,
        index: usize,
        component: usize,
        coordinates: [usize; D],
        losses: [Option<EnergyTermKind>; P],
    ) -> Site<D, P> {
        let Connection {
            a, b, point, markers, ..
        } = connection;
        let numbers = [*a, *b];
        let mut sign = -1.0;
        let ends = numbers.map(|body| {
            sign = -sign;
            ConnectionEnd {
                body,
                free: self.free_number[body],
                size: self.slots[body].iter().flatten().count(),
                prescribed: self.bodies[body].is_moving_prescribed(),
                sign,
            }
        });
        let rows = numbers.map(|body| {
            let center = self.bodies[body].frame.origin;
            let offset = std::array::from_fn(|k| point[k] - center[k]);
            coordinates.map(|coordinate| CoordinateRow::new(coordinate, offset, &self.slots[body]))
        });
        let prescribed = ends.iter().any(|end| end.prescribed);
        let own = |kind| {
            self.parts
                .energy_terms
                .iter()
                .position(|own| Some(own.kind) == kind && own.element == connection.account)
        };
        let energy_terms = losses.map(own);
        let quadratures =
            ends.map(|end| energy_terms.map(|energy_term| self.quadrature(energy_term?, end.free?)));
        let works = ends.map(|end| self.quadrature(0, end.free.filter(|_| prescribed)?));
        if let [Some(a), Some(b)] = ends.map(|end| end.free) {
            self.couplings.push((a, b));
        }
        Site {
            connection: index,
            component,
            ends,
            rows,
            pairs: [[0; 2]; 2],
            energy_terms,
            quadratures,
            works,
            prescribed,
            between: markers.map(|own| Box::new(Between::new(coordinates, numbers, self.bodies, own))),
            slots: numbers.map(|body| self.slots[body]),
        }
    }

    /// Returns the row of a quadrature by a body's states.
    fn quadrature(&mut self, energy_term: usize, free: usize) -> Option<usize> {
        let next = self.parts.quadrature_bodies.len();
        let row = *self.quadratures.entry((energy_term, free)).or_insert(next);
        if row == next {
            self.parts.quadrature_bodies.push((energy_term, free));
        }
        Some(row)
    }

    /// Returns a friction element.
    fn spatial<L>(
        &mut self,
        connection: &Connection,
        index: usize,
        coordinates: [usize; 3],
        losses: [Option<EnergyTermKind>; 3],
        law: L,
        states: usize,
    ) -> Spatial<L> {
        let site = self.site(connection, index, 0, coordinates, losses);
        let discrete_state = self.found.discrete_states.len();
        self.found.discrete_states.push(index);
        let mut internal_rows = [None; 4];
        let internal = (states == 2).then(|| {
            let group = self.parts.internal_pairs.len();
            let bodies = site.ends.iter().filter_map(|end| end.free).collect();
            self.parts.internal_pairs.push(bodies);
            let work = site.prescribed.then_some(0);
            let energy_terms = site.energy_terms.into_iter().chain([work]);
            for (row, energy_term) in internal_rows.iter_mut().zip(energy_terms) {
                if let Some(energy_term) = energy_term {
                    *row = Some(self.parts.quadrature_pairs.len());
                    self.parts.quadrature_pairs.push((energy_term, group));
                }
            }
            2 * group
        });
        Spatial {
            law,
            site,
            internal,
            internal_rows,
            discrete_state,
        }
    }
}
