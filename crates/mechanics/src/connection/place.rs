//! How connections are put in their places.

use std::collections::BTreeMap;

use super::gap::Gap;
use super::site::{End, Row, Site};
use super::spring::Spring;
use super::surface::Surface;
use super::wedge::{Column, WedgeLaw};
use super::{Axis, Connection, Connections, Law, Options, Spatial};
use crate::body::Body;
use crate::system::{Channel, ChannelKind, Parts};

/// Puts connections in their places.
pub(crate) struct Placer<'m> {
    pub bodies: &'m [Body],
    /// For each body its number among the free ones.
    pub free_number: &'m [Option<usize>],
    /// For each body the numbers of its free coordinates.
    pub slots: &'m [[Option<usize>; 6]],
    /// What elements before them need.
    pub parts: &'m mut Parts,
    /// Rows of quadratures by (channel, free body).
    quadratures: BTreeMap<(usize, usize), usize>,
    couplings: Vec<(usize, usize)>,
    found: Connections,
}

impl<'m> Placer<'m> {
    /// Begins after the elements that `parts` is of.
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

    /// The elements of connections that have been checked, and the pairs of free bodies that they couple.
    pub fn place(
        mut self,
        connections: Vec<Connection>,
        options: &Options,
    ) -> (Connections, Vec<(usize, usize)>) {
        for kind in channels(&connections) {
            let element = String::new();
            self.parts.channels.push(Channel { kind, element });
        }
        let placer = &mut self;
        for (index, connection) in connections.iter().enumerate() {
            match &connection.law {
                Law::Springs(list) => {
                    for (component, (coordinate, law)) in list.iter().enumerate() {
                        if let Some(law) = Spring::new(law) {
                            let loss = law.damps().then_some(ChannelKind::SpringDamping);
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
                        [Some(ChannelKind::GapDamping)],
                    );
                    placer.found.gaps.push(Axis {
                        law: Gap::new(law, options),
                        site,
                    });
                }
                Law::Surface(law) => {
                    let prepared = Surface::new(law, options.accumulator_damping);
                    let losses = [
                        Some(ChannelKind::SurfaceFriction),
                        prepared.damps().then_some(ChannelKind::SurfaceDamping),
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
                        Some(ChannelKind::ColumnFriction),
                        more.then_some(ChannelKind::SlopeFriction),
                        more.then_some(ChannelKind::WedgeKinematics),
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

/// The quadratures that connections need.
pub(crate) fn channels(connections: &[Connection]) -> Vec<ChannelKind> {
    let mut kinds = Vec::new();
    for connection in connections {
        match &connection.law {
            Law::Springs(list) => {
                if list
                    .iter()
                    .any(|(_, law)| Spring::new(law).is_some_and(|law| law.damps()))
                {
                    kinds.push(ChannelKind::SpringDamping);
                }
            }
            Law::Gap(..) => kinds.push(ChannelKind::GapDamping),
            Law::Surface(law) => {
                kinds.push(ChannelKind::SurfaceFriction);
                if law.damper.as_ref().is_some_and(|curve| !curve.is_zero()) {
                    kinds.push(ChannelKind::SurfaceDamping);
                }
            }
            Law::Wedge(law) => {
                kinds.push(ChannelKind::ColumnFriction);
                if matches!(law.column, Column::Profile { .. }) {
                    kinds.extend([ChannelKind::SlopeFriction, ChannelKind::WedgeKinematics]);
                }
            }
        }
    }
    kinds.sort();
    kinds.dedup();
    kinds
}

impl Placer<'_> {
    /// The place of an element.
    fn site<const D: usize, const P: usize>(
        &mut self,
        connection: &Connection,
        index: usize,
        component: usize,
        coordinates: [usize; D],
        losses: [Option<ChannelKind>; P],
    ) -> Site<D, P> {
        let Connection { a, b, point, .. } = connection;
        let numbers = [*a, *b];
        let mut sign = -1.0;
        let ends = numbers.map(|body| {
            sign = -sign;
            End {
                body,
                free: self.free_number[body],
                size: self.slots[body].iter().flatten().count(),
                driven: self.bodies[body].is_driven(),
                sign,
            }
        });
        let rows = numbers.map(|body| {
            let center = self.bodies[body].frame.origin;
            let offset = std::array::from_fn(|k| point[k] - center[k]);
            coordinates.map(|coordinate| Row::new(coordinate, offset, &self.slots[body]))
        });
        let driven = ends.iter().any(|end| end.driven);
        let own = |kind| self.parts.channels.iter().position(|own| Some(own.kind) == kind);
        let channels = losses.map(own);
        let quadratures = ends.map(|end| channels.map(|channel| self.quadrature(channel?, end.free?)));
        let works = ends.map(|end| self.quadrature(0, end.free.filter(|_| driven)?));
        if let [Some(a), Some(b)] = ends.map(|end| end.free) {
            self.couplings.push((a, b));
        }
        Site {
            connection: index,
            component,
            ends,
            rows,
            pairs: [[0; 2]; 2],
            channels,
            quadratures,
            works,
            driven,
        }
    }

    /// The row of a quadrature by a body's states.
    fn quadrature(&mut self, channel: usize, free: usize) -> Option<usize> {
        let next = self.parts.quadrature_bodies.len();
        let row = *self.quadratures.entry((channel, free)).or_insert(next);
        if row == next {
            self.parts.quadrature_bodies.push((channel, free));
        }
        Some(row)
    }

    /// A friction element.
    fn spatial<L>(
        &mut self,
        connection: &Connection,
        index: usize,
        coordinates: [usize; 3],
        losses: [Option<ChannelKind>; 3],
        law: L,
        states: usize,
    ) -> Spatial<L> {
        let site = self.site(connection, index, 0, coordinates, losses);
        let switch = self.found.switches.len();
        self.found.switches.push(index);
        let mut internal_rows = [None; 4];
        let internal = (states == 2).then(|| {
            let group = self.parts.internal_pairs.len();
            let bodies = site.ends.iter().filter_map(|end| end.free).collect();
            self.parts.internal_pairs.push(bodies);
            let work = site.driven.then_some(0);
            let channels = site.channels.into_iter().chain([work]);
            for (row, channel) in internal_rows.iter_mut().zip(channels) {
                if let Some(channel) = channel {
                    *row = Some(self.parts.quadrature_pairs.len());
                    self.parts.quadrature_pairs.push((channel, group));
                }
            }
            2 * group
        });
        Spatial {
            law,
            site,
            internal,
            internal_rows,
            switch,
        }
    }
}
