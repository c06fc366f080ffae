//! How a model becomes a [`System`].

use std::collections::BTreeMap;

use integrate::partitioned::{Layout, Partitioned, Structure};

use super::law::gap::Gap;
use super::law::spring::Spring;
use super::law::surface::Surface;
use super::law::wedge::WedgeLaw;
use super::model::{Connection, Kind, Law, Model};
use super::place::{End, Row, Site};
use super::{Axis, ChannelKind, FreeBody, MovedBody, Spatial, System};
use crate::motion::Motion;
use crate::system::scales;

/// What is gathered while elements are put in place.
struct Placer<'m> {
    model: &'m Model,
    /// For each body its number among the free ones.
    free_number: Vec<Option<usize>>,
    /// For each body the numbers of its free coordinates.
    slots: Vec<[Option<usize>; 6]>,
    /// For each body whether it is prescribed and moves.
    driven: Vec<bool>,
    channels: Vec<ChannelKind>,
    /// Rows of quadratures by (channel, free body).
    quadratures: BTreeMap<(usize, usize), usize>,
    structure: Structure,
    switches: Vec<usize>,
}

/// The system of a model that has been checked.
pub(super) fn build(model: Model) -> System {
    let (mut free, moved, slots) = bodies(&model);
    let mut free_number = vec![None; model.bodies.len()];
    let mut driven = vec![false; model.bodies.len()];
    for (number, free) in free.iter().enumerate() {
        free_number[free.body] = Some(number);
    }
    for moved in &moved {
        driven[moved.body] = moved.moves;
    }
    let channels = channels(&model);
    let mut placer = Placer {
        model: &model,
        free_number,
        slots,
        driven,
        quadratures: BTreeMap::new(),
        structure: Structure {
            bodies: free.iter().map(|free| free.free.len()).collect(),
            quadratures: channels.len(),
            ..Structure::default()
        },
        channels,
        switches: Vec::new(),
    };
    let (mut springs, mut gaps, mut surfaces, mut wedges) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let options = &model.options;
    for (index, connection) in model.connections.iter().enumerate() {
        match &connection.law {
            Law::Springs(list) => {
                for (component, (coordinate, law)) in list.iter().enumerate() {
                    if let Some(law) = Spring::new(law) {
                        let loss = law.damps().then_some(ChannelKind::SpringDamping);
                        let site = placer.site(index, component, [*coordinate], [loss]);
                        springs.push(Axis { law, site });
                    }
                }
            }
            Law::Gap(coordinate, law) => {
                let site = placer.site(index, 0, [*coordinate], [Some(ChannelKind::GapDamping)]);
                gaps.push(Axis {
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
                surfaces.push(placer.spatial(index, law.coordinates, losses, prepared, states));
            }
            Law::Wedge(law) => {
                let prepared = WedgeLaw::new(law, options);
                let more = prepared.is_spatial();
                let losses = [
                    Some(ChannelKind::ColumnFriction),
                    more.then_some(ChannelKind::SlopeFriction),
                    more.then_some(ChannelKind::WedgeKinematics),
                ];
                wedges.push(placer.spatial(index, [2, 0, 1], losses, prepared, law.accumulator.states()));
            }
        }
    }
    let Placer {
        channels,
        structure,
        free_number,
        switches,
        ..
    } = placer;
    let mut jacobian = Partitioned::new(&structure);
    for (number, free) in free.iter_mut().enumerate() {
        free.pair = jacobian.pair(number, number);
        let n = free.free.len();
        let mass = jacobian.mass_mut(number);
        for (j, inertia) in free.inertia.iter().enumerate() {
            mass[j * n + j] = *inertia;
        }
    }
    springs
        .iter_mut()
        .for_each(|e| find_pairs(&mut e.site, &jacobian));
    gaps.iter_mut().for_each(|e| find_pairs(&mut e.site, &jacobian));
    surfaces
        .iter_mut()
        .for_each(|e| find_pairs(&mut e.site, &jacobian));
    wedges.iter_mut().for_each(|e| find_pairs(&mut e.site, &jacobian));
    let layout = jacobian.layout();
    let nowhere = vec![[0.0; 6]; model.bodies.len()];
    System {
        scales: error_scales(&free, layout),
        free,
        moved,
        free_number,
        springs,
        gaps,
        surfaces,
        wedges,
        switches,
        channels,
        layout,
        grips: super::Grips::default(),
        moved_at: f64::NAN,
        reference: 0.0,
        positions: nowhere.clone(),
        rates: nowhere.clone(),
        accelerations: nowhere.clone(),
        loads: nowhere,
        jacobian,
        model,
    }
}

/// Free and moved bodies, and the numbers of all bodies' free coordinates.
fn bodies(model: &Model) -> (Vec<FreeBody>, Vec<MovedBody>, Vec<[Option<usize>; 6]>) {
    let (mut all_free, mut moved, mut slots) = (Vec::new(), Vec::new(), Vec::new());
    let mut offset = 0;
    for (number, body) in model.bodies.iter().enumerate() {
        let mut numbers = [None; 6];
        match &body.kind {
            Kind::Free { free, mass, inertia } if free.contains(&true) => {
                let free: Vec<usize> = (0..6).filter(|k| free[*k]).collect();
                let own = |k: usize| if k < 3 { *mass } else { inertia[k - 3] };
                for (j, &k) in free.iter().enumerate() {
                    numbers[k] = Some(j);
                }
                all_free.push(FreeBody {
                    body: number,
                    offset,
                    inertia: free.iter().map(|k| own(*k)).collect(),
                    weight: free
                        .iter()
                        .map(|k| if *k == 2 { -mass * model.gravity } else { 0.0 })
                        .collect(),
                    pair: 0,
                    free: free.clone(),
                });
                offset += free.len();
            }
            Kind::Free { .. } => {}
            Kind::Prescribed { motions } => moved.push(MovedBody {
                body: number,
                moves: !motions.iter().all(Motion::is_constant),
                motions: motions.clone(),
            }),
        }
        slots.push(numbers);
    }
    (all_free, moved, slots)
}

/// The quadratures that a model needs.
fn channels(model: &Model) -> Vec<ChannelKind> {
    let mut kinds = vec![ChannelKind::InputWork];
    for connection in &model.connections {
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
                if matches!(law.column, super::Column::Profile { .. }) {
                    kinds.extend([ChannelKind::SlopeFriction, ChannelKind::WedgeKinematics]);
                }
            }
        }
    }
    kinds.sort();
    kinds.dedup();
    kinds
}

/// Error scales: those of the systems with large displacements.
fn error_scales(free: &[FreeBody], layout: Layout) -> Vec<f64> {
    let mut all = vec![scales::ENERGY; layout.len()];
    for free in free {
        for (j, &k) in free.free.iter().enumerate() {
            let (place, speed) = match k {
                0..3 => (scales::DISPLACEMENT, scales::VELOCITY),
                _ => (scales::ANGLE, scales::ANGULAR_VELOCITY),
            };
            all[free.offset + j] = place;
            all[layout.speeds + free.offset + j] = speed;
        }
    }
    all[2 * layout.speeds..][..layout.internals].fill(scales::DEFLECTION);
    all
}

impl Placer<'_> {
    /// The place of an element.
    fn site<const D: usize, const P: usize>(
        &mut self,
        index: usize,
        component: usize,
        coordinates: [usize; D],
        losses: [Option<ChannelKind>; P],
    ) -> Site<D, P> {
        let Connection { a, b, point, .. } = &self.model.connections[index];
        let numbers = [*a, *b];
        let mut sign = -1.0;
        let ends = numbers.map(|body| {
            sign = -sign;
            End {
                body,
                free: self.free_number[body],
                size: self.slots[body].iter().flatten().count(),
                driven: self.driven[body],
                sign,
            }
        });
        let rows = numbers.map(|body| {
            let center = self.model.bodies[body].center_of_gravity;
            let offset = std::array::from_fn(|k| point[k] - center[k]);
            coordinates.map(|coordinate| Row::new(coordinate, offset, &self.slots[body]))
        });
        let driven = ends.iter().any(|end| end.driven);
        let channels = losses.map(|kind| self.channels.iter().position(|own| Some(*own) == kind));
        let quadratures = ends.map(|end| channels.map(|channel| self.quadrature(channel?, end.free?)));
        let works = ends.map(|end| self.quadrature(0, end.free.filter(|_| driven)?));
        if let [Some(a), Some(b)] = ends.map(|end| end.free) {
            self.structure.couplings.push((a, b));
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
        let next = self.quadratures.len();
        let row = *self.quadratures.entry((channel, free)).or_insert(next);
        if row == next {
            self.structure.quadrature_bodies.push((channel, free));
        }
        Some(row)
    }

    /// A friction element.
    fn spatial<L>(
        &mut self,
        index: usize,
        coordinates: [usize; 3],
        losses: [Option<ChannelKind>; 3],
        law: L,
        states: usize,
    ) -> Spatial<L> {
        let site = self.site(index, 0, coordinates, losses);
        let switch = self.switches.len();
        self.switches.push(index);
        let mut internal_rows = [None; 4];
        let internal = (states == 2).then(|| {
            let group = self.structure.internal_pairs.len();
            let bodies = site.ends.iter().filter_map(|end| end.free).collect();
            self.structure.internal_pairs.push(bodies);
            let work = site.driven.then_some(0);
            let channels = site.channels.into_iter().chain([work]);
            for (row, channel) in internal_rows.iter_mut().zip(channels) {
                if let Some(channel) = channel {
                    *row = Some(self.structure.quadrature_pairs.len());
                    self.structure.quadrature_pairs.push((channel, group));
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

/// Looks up the coupling blocks of an element.
fn find_pairs<const D: usize, const P: usize>(site: &mut Site<D, P>, jacobian: &Partitioned) {
    let free = site.ends.map(|end| end.free);
    for (row, pairs) in free.iter().zip(&mut site.pairs) {
        for (column, pair) in free.iter().zip(pairs) {
            if let (Some(row), Some(column)) = (row, column) {
                *pair = jacobian.pair(*row, *column);
            }
        }
    }
}
