//! Contact patches on strips: patches that are no ellipses.
//!
//! An interval of overlap is cut into strips along the rolling direction. Each has the local normal of the
//! rail, the local normal overlap and a semi-elliptic pressure along it; loads and half lengths come from the
//! displacements of two half-spaces, the surfaces rolled out into a plane (`solve.rs`). Curvatures of
//! profiles across the rolling direction are not used.
//!
//! The curvature along the rolling direction is `κ = (1 - e²) cos δ / r + e² κ_w` after Euler, with the mean
//! curvature κ_w of the wheel's profile in the part and `e = e_x / cos δ`, the sine of the angle between the
//! rail and the wheel's circle in the plane of contact (e_x: the axle's component along the rail).
//!
//! An interval with a valley between two maxima is cut into two parts with strips of their own, which press
//! each other down, as separate intervals do: wholly where the centers of their overlaps are up to 10 mm
//! apart, from 20 mm on not at all (a choice; other programs have such distances, too). Where the
//! valley has more than 0.45 of the smaller maximum, the interval as one part takes over (share c, the parts
//! 1 - c), wholly at 0.9. So loads are continuous where patches merge and part; strips appear and vanish with
//! no load.
//!
//! **The patch of a part** has the resultant of its strips' loads: its normal, its place (the center of the
//! loads), and the ellipse that has the same load, the same variance of the load across the rolling direction
//! and the same elastic energy `U = ½ Σ w (q h - A q a²/4)`; its approach is `5 U / (2 N)`. Creep laws other
//! than that on strips use this ellipse.
//!
//! Limits: half-spaces; a tail of overlap that is too narrow for the stations of the search lengthens an
//! interval at once, which moves its strips and changes loads by up to 1 %; strips that lie ahead of each
//! other (yaw) press each other as if they lay side by side.

mod influence;
mod kernel;
mod rates;
mod ratio;
mod solve;

use std::f64::consts::PI;

use numerics::scalar::Real;

pub use self::solve::STRIPS;
use self::solve::{Loads, PARTS, Part, solve};
use super::ellipse::Ellipse;
use super::force::cube_root;
use super::patch::ContactPatch;
use super::pose::{Frame, ProfileNode};
use super::search::{AREAS, ContactPair, Interval, NOTHING, Scan};

/// Overlap of a valley, over that at which it joins two parts wholly, from which one part takes over.
const JOINED: f64 = 0.9;
const JOINING: f64 = 0.45;
/// Least curvature along the rolling direction over that of the wheel's circle.
const LEAST_CURVATURE: f64 = 0.2;
/// Distance (m) of the centers of parts up to which they press each other wholly, and from which they do not.
const NEAR: f64 = 10e-3;
const FAR: f64 = 20e-3;

/// Loads on the strips of a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StripLoads<S> {
    /// Middle of each strip ahead of the place of the patch, m.
    pub along: [S; STRIPS],
    /// Middle of each strip towards the field side of the place of the patch, along the surfaces, m.
    pub across: [S; STRIPS],
    /// Elastic load per width, N/m; zero out of contact.
    pub line: [S; STRIPS],
    /// Half length of the contact along the rolling direction, m; zero out of contact.
    pub half_length: [S; STRIPS],
    /// Width of a strip, m.
    pub width: S,
}

impl<S: Real> StripLoads<S> {
    /// Returns the same without derivatives, in another scalar.
    #[inline(always)]
    pub(super) fn lifted<T: Real>(&self) -> StripLoads<T> {
        let lift = |value: S| T::from(value.value());
        StripLoads {
            along: self.along.map(lift),
            across: self.across.map(lift),
            line: self.line.map(lift),
            half_length: self.half_length.map(lift),
            width: lift(self.width),
        }
    }

    /// Returns the greatest pressure of a strip under the elastic load, Pa.
    #[must_use]
    pub fn pressure(&self, strip: usize) -> f64 {
        let (line, half) = (self.line[strip].value(), self.half_length[strip].value());
        if half > 0.0 { 2.0 * line / (PI * half) } else { 0.0 }
    }

    /// Returns the greatest pressure under the elastic load, Pa.
    #[must_use]
    pub fn greatest_pressure(&self) -> f64 {
        (0..STRIPS).map(|strip| self.pressure(strip)).fold(0.0, f64::max)
    }

    /// Returns the width of the contact across the rolling direction, m: of the strips with loads.
    #[must_use]
    pub fn contact_width(&self) -> f64 {
        let count = self.line.iter().filter(|line| line.value() > 0.0).count();
        self.width.value() * count as f64
    }
}

/// Rises smoothly from 0 to 1.
#[inline(always)]
fn rise<S: Real>(x: S) -> S {
    if x.value() <= 0.0 {
        return S::zero();
    }
    if x.value() >= 1.0 {
        return S::from(1.0);
    }
    x * x * (x * -2.0 + 3.0)
}

/// The strips of a part with the points at their middles.
struct Laid<S> {
    nodes: [ProfileNode<S>; STRIPS],
    cosines: [S; STRIPS],
    part: Part<S>,
    /// Center of the overlap, as a place along the surfaces, m.
    center: S,
    /// Mean of half the curvatures along the rolling direction, 1/m.
    mean_curvature: S,
}

/// An interval of overlap with its ends and, if a valley divides it, the place of that and the share with
/// which it counts as one part.
#[derive(Clone, Copy)]
struct Area<S> {
    ends: [S; 2],
    division: Option<(S, S)>,
    /// Distance to the next one, m.
    gap: S,
}

/// Returns the share with which parts press each other whose centers are at a distance (m).
fn coupling<S: Real>(distance: S) -> S {
    (rise((distance - NEAR) * (1.0 / (FAR - NEAR))) - 1.0) * -1.0
}

impl ContactPair {
    /// Gives the patches of intervals, with the loads on their strips, to `take`.
    pub(super) fn patches_on_strips<S: Real>(
        &self,
        frame: &Frame<'_, S>,
        plain: &Frame<'_, f64>,
        scan: &Scan,
        intervals: &[Option<Interval>; AREAS],
        mut take: impl FnMut(ContactPatch<S>, &StripLoads<S>),
    ) {
        let mut sorted = *intervals;
        sorted.sort_by_key(|interval| interval.map_or(usize::MAX, |own| own.stations[0]));
        let mut areas: [Option<Area<S>>; AREAS] = [None; AREAS];
        let mut count = 0_usize;
        for interval in sorted.iter().flatten().filter(|own| own.peak > NOTHING) {
            let ends = interval.ends.map(|end| self.end(frame, plain, end));
            let division = self.division(frame, plain, scan, interval.stations, JOINED);
            let division = division.map(|(valley, part)| {
                let joined = rise((part - JOINING) * (1.0 / (1.0 - JOINING)));
                (valley, joined)
            });
            if let Some(before) = count.checked_sub(1).and_then(|last| areas[last].as_mut()) {
                let [from, to] = [before.ends[1], ends[0]].map(|end| frame.node(end).place);
                let [y, z] = [to[1] - from[1], to[2] - from[2]];
                before.gap = (y * y + z * z).sqrt();
            }
            areas[count] = Some(Area {
                ends,
                division,
                gap: S::zero(),
            });
            count += 1;
        }
        let mut begin = 0;
        for i in 0..count {
            let last = i + 1 == count || areas[i].is_some_and(|area| area.gap.value() >= FAR);
            if last {
                self.near(frame, &areas[begin..=i], &mut take);
                begin = i + 1;
            }
        }
    }

    /// Gives the patches of areas near each other: for each way to take divided areas as one part or as two,
    /// with its share.
    fn near<S: Real>(
        &self,
        frame: &Frame<'_, S>,
        areas: &[Option<Area<S>>],
        take: &mut impl FnMut(ContactPatch<S>, &StripLoads<S>),
    ) {
        for way in 0..1_usize << areas.len() {
            let mut share = S::from(1.0);
            for (i, area) in areas.iter().flatten().enumerate() {
                let whole = way >> i & 1 == 1;
                share = share
                    * match (area.division, whole) {
                        (None, true) => S::from(1.0),
                        (None, false) => S::zero(),
                        (Some((_, joined)), true) => joined,
                        (Some((_, joined)), false) => (joined - 1.0) * -1.0,
                    };
            }
            if share.value() > 0.0 {
                self.together(frame, areas, way, share, take);
            }
        }
    }

    /// Gives the patches of areas, of which each is one part if its bit of `way` is set, else two.
    fn together<S: Real>(
        &self,
        frame: &Frame<'_, S>,
        areas: &[Option<Area<S>>],
        way: usize,
        share: S,
        take: &mut impl FnMut(ContactPatch<S>, &StripLoads<S>),
    ) {
        // Parts that press each other are neighbors; they are solved as the chain ends.
        let mut chain: [Option<Laid<S>>; PARTS] = [const { None }; PARTS];
        let (mut length, mut offset) = (0_usize, S::zero());
        for (i, area) in areas.iter().flatten().enumerate() {
            let [left, right] = area.ends;
            let pieces = match area.division {
                Some((valley, _)) if way >> i & 1 == 0 => [Some([left, valley]), Some([valley, right])],
                _ => [Some([left, right]), None],
            };
            for ends in pieces.into_iter().flatten() {
                let Some(own) = self.laid(frame, ends, offset) else {
                    continue;
                };
                offset += own.part.width * STRIPS as f64;
                let before = length.checked_sub(1).and_then(|last| chain[last].as_ref());
                let apart = before.is_some_and(|before| (own.center - before.center).value() >= FAR);
                if apart {
                    self.solved(frame, &chain[..length], share, take);
                    length = 0;
                }
                chain[length] = Some(own);
                length += 1;
            }
            offset += area.gap;
        }
        self.solved(frame, &chain[..length], share, take);
    }

    /// Solves a chain of parts and gives their patches.
    fn solved<S: Real>(
        &self,
        frame: &Frame<'_, S>,
        chain: &[Option<Laid<S>>],
        share: S,
        take: &mut impl FnMut(ContactPatch<S>, &StripLoads<S>),
    ) {
        let mut couplings = [[S::zero(); PARTS]; PARTS];
        for (p, own) in chain.iter().flatten().enumerate() {
            couplings[p][p] = S::from(1.0);
            for (q, other) in chain.iter().flatten().enumerate().skip(p + 1) {
                let coupling = coupling(other.center - own.center);
                (couplings[p][q], couplings[q][p]) = (coupling, coupling);
            }
        }
        let modulus = self.ellipses.material().composite_modulus();
        let mut give = |p: usize, loads: &Loads<S>| {
            if let Some(own) = &chain[p] {
                self.give(frame, own, loads, share, take);
            }
        };
        match chain {
            [] => {}
            [Some(one)] => solve(&[one.part], &couplings, modulus, &mut give),
            [Some(one), Some(two)] => solve(&[one.part, two.part], &couplings, modulus, &mut give),
            [first, ..] => {
                let Some(first) = first else { return };
                let mut parts = [first.part; PARTS];
                for (part, own) in parts.iter_mut().zip(chain.iter().flatten()) {
                    *part = own.part;
                }
                solve(&parts[..chain.len()], &couplings, modulus, &mut give);
            }
        }
    }

    /// Returns strips between two parameters of the wheel's profile, their places counted from an offset (m),
    /// with the first estimate: the ellipse of the depth and the half width of the overlap.
    fn laid<S: Real>(&self, frame: &Frame<'_, S>, [from, to]: [S; 2], offset: S) -> Option<Laid<S>> {
        let zero = S::zero();
        let nodes: [ProfileNode<S>; STRIPS] =
            std::array::from_fn(|i| frame.node(from + (to - from) * ((i as f64 + 0.5) / STRIPS as f64)));
        let cosines = nodes.map(|node| (node.slope * node.slope + 1.0).sqrt().recip());
        let mut length = zero;
        for pair in nodes.windows(2) {
            let [_, y, z] = [0, 1, 2].map(|i| pair[1].place[i] - pair[0].place[i]);
            length += (y * y + z * z).sqrt();
        }
        let width = length * (1.0 / (STRIPS - 1) as f64);
        let overlap: [S; STRIPS] = std::array::from_fn(|i| nodes[i].overlap * cosines[i]);
        let turned = frame.axle_along() * frame.axle_along();
        let angle = |node: &ProfileNode<S>| {
            let slope = node.slope - node.overlap_slope;
            let value = slope.value();
            slope.chain(libm::atan(value), 1.0 / (1.0 + value * value))
        };
        let bend = (angle(&nodes[STRIPS - 1]) - angle(&nodes[0])) / length;
        let curvature: [S; STRIPS] = std::array::from_fn(|i| {
            let round = cosines[i] / nodes[i].radius;
            let share = turned / (cosines[i] * cosines[i]);
            let whole = round + share * (bend - round);
            let least = round * LEAST_CURVATURE;
            (if whole.value() > least.value() {
                whole
            } else {
                least
            }) * 0.5
        });
        let place: [S; STRIPS] = std::array::from_fn(|i| offset + width * (i as f64 + 0.5));
        let (mut squares, mut cubes, mut mean, mut center) = (zero, zero, zero, zero);
        for i in 0..STRIPS {
            let square = overlap[i] * overlap[i];
            squares += square;
            cubes += square * overlap[i];
            mean += square * curvature[i];
            center += square * place[i];
        }
        if !(squares.value() > 0.0 && cubes.value() > 0.0 && width.value() > 0.0) {
            return None;
        }
        let mean_curvature = mean / squares;
        let depth = cubes / squares * (7.0 / 6.0);
        let half_width = squares * width / (depth * depth) * (15.0 / 16.0);
        let lateral = depth * 2.0 / (half_width * half_width);
        let ellipse = self.ellipses.of(mean_curvature * 2.0, lateral);
        let root = cube_root(ellipse.stiffness * depth * depth.sqrt());
        let [a, b] = ellipse.axes.map(|axis| axis * root);
        let share = (b / half_width) * (b / half_width);
        let least = (share - 1.0) * -1.0 * depth;
        let start = overlap.map(|h| match h.value() > least.value() {
            true => a * a * (h - least) / (depth * share),
            false => zero,
        });
        Some(Laid {
            part: Part {
                overlap,
                place,
                curvature,
                width,
                start,
            },
            nodes,
            cosines,
            center: center / squares,
            mean_curvature,
        })
    }

    /// Gives the patch of a part with its loads to `take`.
    fn give<S: Real>(
        &self,
        frame: &Frame<'_, S>,
        laid: &Laid<S>,
        loads: &Loads<S>,
        share: S,
        take: &mut impl FnMut(ContactPatch<S>, &StripLoads<S>),
    ) {
        let zero = S::zero();
        let (part, width) = (&laid.part, laid.part.width);
        let (mut load, mut energy, mut across, mut squares) = (zero, zero, zero, zero);
        let mut force = [zero; 2];
        let mut means = [zero; 5];
        for i in 0..STRIPS {
            let line = loads.line[i];
            if line.value() <= 0.0 {
                continue;
            }
            let (node, half) = (&laid.nodes[i], loads.half_length[i]);
            load += line;
            energy += line * (part.overlap[i] - part.curvature[i] * half * half * 0.25);
            across += line * part.place[i];
            squares += line * half * half;
            force[0] -= line * laid.cosines[i] * node.slope;
            force[1] += line * laid.cosines[i];
            let [x, y, z] = node.place;
            for (mean, value) in means.iter_mut().zip([x, y, z, node.profile, node.radius]) {
                *mean += line * value;
            }
        }
        if load.value() <= 0.0 {
            return;
        }
        let [x, y, z, profile, radius] = means.map(|mean| mean / load);
        let middle = across / load;
        let mut variance = zero;
        for i in 0..STRIPS {
            let away = part.place[i] - middle;
            variance += loads.line[i] * (away * away);
        }
        let b = (variance / load * 5.0).sqrt();
        let a = (squares / load * 1.25).sqrt();
        let normal = (force[0] * force[0] + force[1] * force[1]).sqrt() * width;
        let slope = -(force[0] / force[1]);
        let cosine = (slope * slope + 1.0).sqrt().recip();
        let approach = energy * width * 1.25 / normal;
        let root = cube_root(normal);
        let climb = frame.climb(y);
        // On a rail that rises the wheel touches ahead of its axle.
        let x = climb.map_or(x, |climb| x + radius * climb);
        let lateral = approach * 2.0 / (b * b);
        let patch = ContactPatch {
            share,
            place: [x, y, z],
            slope,
            cosine,
            climb,
            profile,
            radius,
            approach,
            half_width: b,
            curvatures: [laid.mean_curvature * 2.0, lateral],
            ellipse: Ellipse {
                stiffness: normal / (approach * approach.sqrt()),
                axes: [a / root, b / root],
            },
        };
        let ahead = match climb {
            None => x,
            Some(climb) => x - radius * climb,
        };
        let strips = StripLoads {
            along: std::array::from_fn(|i| laid.nodes[i].place[0] - ahead),
            across: std::array::from_fn(|i| part.place[i] - middle),
            line: loads.line,
            half_length: loads.half_length,
            width,
        };
        take(patch, &strips);
    }
}
