//! Assembly of elements between bodies.

use numerics::lanes::LANES;
use numerics::partitioned::Partitioned;

use super::FrameState;
use super::model::ModelError;
use super::mounted::Mounted;
use crate::body::{Body, Kinematics};
use crate::contact::Points;
use crate::element::tangent::{StateTangent, Tangent, TangentColumns};
use crate::energy::{EnergyTerm, EnergyTermKind};
use crate::link::{Marker, RelativeFrame, Translation};
use crate::parts::Parts;

/// Assembles elements between bodies.
pub(super) struct ElementAssembler<'m> {
    pub bodies: &'m [Body],
    pub frames: &'m [FrameState],
    pub kinematics: &'m [Kinematics<f64>],
    pub free_number: &'m [Option<usize>],
    pub parts: &'m mut Parts,
}

impl ElementAssembler<'_> {
    pub fn attach<E>(
        &mut self,
        element: E,
        name: &str,
        body: usize,
        on: usize,
        marker: Marker,
        kinds: [Option<EnergyTermKind>; 2],
        pairs: usize,
    ) -> Result<Mounted<E>, ModelError> {
        let count = self.bodies.len();
        for number in [body, on] {
            if number >= count {
                return Err(ModelError::NoSuchBody { number, count });
            }
        }
        if body == on {
            return Err(ModelError::Itself {
                body: self.bodies[body].name.clone(),
            });
        }
        let Some(number) = self.free_number[body] else {
            return Err(ModelError::NotFree {
                body: self.bodies[body].name.clone(),
            });
        };
        let on_number = self.free_number[on];
        let parts = &mut *self.parts;
        let prescribed = on_number.is_none() && !self.frames[on].fixed;
        let energy_terms = kinds.map(|kind| {
            kind.map(|kind| {
                parts.energy_terms.push(EnergyTerm {
                    kind,
                    element: name.to_owned(),
                });
                parts.energy_terms.len() - 1
            })
        });
        let quadratures = [energy_terms[0], energy_terms[1], prescribed.then_some(0)];
        let rows = [Some(number), on_number].map(|end| {
            quadratures.map(|quadrature| {
                parts.quadrature_bodies.push((quadrature?, end?));
                Some(parts.quadrature_bodies.len() - 1)
            })
        });
        let first_pair = parts.internal_pairs.len();
        let first_internal_row = parts.quadrature_pairs.len();
        for pair in first_pair..first_pair + pairs {
            parts
                .internal_pairs
                .push([Some(number), on_number].into_iter().flatten().collect());
            // Friction loss and the work of the motion depend on the bristle; what an element puts in, too.
            let [first, second] = energy_terms;
            let work = second.filter(|_| matches!(kinds[1], Some(EnergyTermKind::ElementWork)));
            for quadrature in [first, Some(0), work].into_iter().flatten() {
                parts.quadrature_pairs.push((quadrature, pair));
            }
        }
        let translates = prescribed && self.frames[on].keeps_orientation && self.frames[body].fixed;
        let translation = translates.then(|| {
            let frame = &self.frames[on];
            let ways = frame.moves.iter().map(|way| way.axis);
            let seat = &self.kinematics[on];
            let own = &self.frames[body].motion;
            Translation::new(own, &frame.motion, (frame.rest, ways), seat, &marker)
        });
        let moves = !self.frames[on].fixed || !self.frames[body].fixed;
        Ok(Mounted {
            plain: on_number.is_none() && (!moves || translation.is_some()),
            tangent: Tangent::NONE,
            state_tangent: StateTangent::NONE,
            mobilities: Vec::new(),
            rate_tangents: vec![TangentColumns::NONE; pairs.div_ceil(LANES)],
            translation,
            element,
            points: Points::default(),
            body,
            on,
            first_internal: 2 * first_pair,
            internal_count: 2 * pairs,
            energy_terms,
            on_free: on_number.is_some(),
            moves,
            prescribed,
            relative_frame: RelativeFrame::new(
                &self.frames[body].motion,
                &self.frames[on].motion,
                &self.kinematics[on],
                &marker,
            ),
            marker,
            pairs: [0; 2],
            rows,
            first_internal_row,
        })
    }
}

impl<E> Mounted<E> {
    /// Returns the numbers (among the free bodies) of the free bodies at its ends.
    pub(super) fn touches(&self, free_number: &[Option<usize>]) -> impl Iterator<Item = usize> + use<E> {
        [self.body, self.on]
            .map(|body| free_number[body])
            .into_iter()
            .flatten()
    }

    pub(super) fn find_pairs(&mut self, jacobian: &Partitioned, free_number: &[Option<usize>]) {
        if let (Some(body), Some(on)) = (free_number[self.body], free_number[self.on]) {
            self.pairs = [jacobian.pair(body, on), jacobian.pair(on, body)];
        }
    }
}
