//! Wear of the wedges that trucks and cars mount: how much their faces lose, and where.
//!
//! How much says the energy ledger, face by face ([`WedgeLaw`]). Where say the rows of the table: in each the
//! power that friction takes at every point of a face, and how far the face is moved over its counterface,
//! with the weight of that power. Shares of the points and of the displacements divide the ledger's energy.
//!
//! Limits: a wedge that turns over its counterface is taken as moved by the mean of its points; both halves
//! of a split wedge wear by their mean; massless wedges have no faces. What a map does over many runs is in
//! [`FaceMaps`].

mod law;
mod maps;
mod summary;

pub use law::WedgeLaw;
pub use maps::{FaceGrowth, FaceMaps, FacePace, FacePlan};
pub(crate) use summary::Over;
pub use summary::{FaceWorn, WedgeWorn, WedgesWorn};

use mechanics::system::{FaceState, Observation, System};
use mechanics::vector::Vector;
use serde::{Deserialize, Serialize};
use truck::{PLACES, WEDGE_NAMES, Wedge, WedgeKind, reversed};
use wedge::outputs::FACES;

use crate::truck::channels::{losses_at, names_of_face};

/// Displacements are sorted into squares of this side, m.
pub const SQUARE: f64 = 2e-3;

/// What the faces of wedges do in a run.
#[derive(Clone, Debug)]
pub struct WedgesWork {
    wedges: Vec<OfWedge>,
    /// Time, s, and way, m, over which it is taken.
    passed: [f64; 2],
}

/// A wedge with its faces, column and slope.
#[derive(Clone, Debug)]
struct OfWedge {
    name: String,
    /// Those on which its rise depends ([`Wedge::rise_angles`]).
    angles: [f64; 3],
    faces: [OfFace; FACES.len()],
}

/// A face of a wedge; of a split one that of both halves.
#[derive(Clone, Debug)]
struct OfFace {
    /// Their numbers among the faces of the system.
    numbers: Vec<usize>,
    /// The places of their losses among the energy terms.
    terms: Vec<usize>,
    /// Signs of the marker's axes: up the face, and to the left.
    signs: [f64; 2],
    plan: FacePlan,
    work: FaceWork,
}

/// What a face does in a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FaceWork {
    /// Energy lost in friction by the ledger, J: at the first row, and now.
    ends: Option<[f64; 2]>,
    /// The same by the rows, at each point, J.
    points: Vec<f64>,
    /// By squares of displacement, up and across, in their order, J.
    moved: Vec<([i32; 2], f64)>,
    /// Normal force times the energy, N·J.
    force: f64,
}

/// The work of all faces, as saved with a run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SavedWork {
    passed: [f64; 2],
    faces: Vec<FaceWork>,
}

impl WedgesWork {
    /// Returns none so far of the wedges of trucks, by what precedes their names; those without faces are
    /// left out.
    #[must_use]
    pub fn new(system: &System, trucks: &[(&str, &[Wedge; 4])]) -> Self {
        let mut wedges = Vec::new();
        for (prefix, own) in trucks {
            for (number, wedge) in own.iter().enumerate() {
                if wedge.kind == WedgeKind::Massless {
                    continue;
                }
                let name = format!("{prefix}{}", WEDGE_NAMES[number]);
                let [column, slope] = FacePlan::of(wedge);
                let faces = [(0, column), (1, slope)]
                    .map(|(face, plan)| OfFace::new(system, &name, (face, plan), PLACES[number][0]));
                let angles = wedge.rise_angles();
                wedges.push(OfWedge { name, angles, faces });
            }
        }
        Self {
            wedges,
            passed: [0.0; 2],
        }
    }

    /// Takes a row along, with the quadratures of the ledger (J), that stands for a time (s) and a way (m).
    pub fn take(&mut self, seen: &Observation, quadratures: &[f64], [time, way]: [f64; 2]) {
        self.passed[0] += time;
        self.passed[1] += way;
        for face in self.wedges.iter_mut().flat_map(|own| &mut own.faces) {
            let now = face.terms.iter().map(|term| quadratures[*term]).sum();
            let [first, _] = face.work.ends.unwrap_or([now; 2]);
            face.work.ends = Some([first, now]);
            if time > 0.0 {
                for number in face.numbers.clone() {
                    face.lay(&seen.faces[number], time);
                }
            }
        }
    }

    /// Returns its sums.
    #[must_use]
    pub fn saved(&self) -> SavedWork {
        let faces = self.wedges.iter().flat_map(|own| &own.faces);
        SavedWork {
            passed: self.passed,
            faces: faces.map(|own| own.work.clone()).collect(),
        }
    }

    /// Goes on from saved sums; returns false if they are those of other wedges.
    pub fn restore(&mut self, saved: SavedWork) -> bool {
        let own = || self.wedges.iter().flat_map(|own| &own.faces);
        let fits = |(own, saved): (&OfFace, &FaceWork)| own.work.points.len() == saved.points.len();
        if own().count() != saved.faces.len() || !own().zip(&saved.faces).all(fits) {
            return false;
        }
        let own = self.wedges.iter_mut().flat_map(|own| &mut own.faces);
        for (own, saved) in own.zip(saved.faces) {
            own.work = saved;
        }
        self.passed = saved.passed;
        true
    }
}

impl OfFace {
    fn new(system: &System, name: &str, (face, plan): (usize, FacePlan), end: f64) -> Self {
        let names = names_of_face(name, FACES[face]);
        let all = system.faces().iter().enumerate();
        let own = all.filter(|(_, mounted)| names.contains(&mounted.element.name));
        let [down, right] = reversed(face == 0, end);
        Self {
            numbers: own.map(|(number, _)| number).collect(),
            terms: losses_at(system, name, &[FACES[face]]),
            signs: [down, right].map(|reversed| if reversed { -1.0 } else { 1.0 }),
            work: FaceWork {
                points: vec![0.0; plan.places().len()],
                ..FaceWork::default()
            },
            plan,
        }
    }

    /// Adds what its points do in a time, s.
    fn lay(&mut self, seen: &FaceState, time: f64) {
        let (mut energy, mut force, mut moved) = (0.0, 0.0, [0.0; 2]);
        for ((point, place), sum) in seen
            .points
            .iter()
            .zip(self.plan.places())
            .zip(&mut self.work.points)
        {
            let own = time * point.friction.loss;
            *sum += own;
            energy += own;
            force += point.normal;
            let Vector([_, across, along]) = point.position;
            for (axis, at) in [along, across].into_iter().enumerate() {
                moved[axis] += own * (self.signs[axis] * at - place[axis]);
            }
        }
        if energy > 0.0 {
            let square = moved.map(|own| libm::round(own / energy / SQUARE) as i32);
            self.work.lay(square, energy);
            self.work.force += force * energy;
        }
    }
}

impl FaceWork {
    fn lay(&mut self, square: [i32; 2], energy: f64) {
        match self.moved.binary_search_by_key(&square, |own| own.0) {
            Ok(place) => self.moved[place].1 += energy,
            Err(place) => self.moved.insert(place, (square, energy)),
        }
    }

    /// Returns the energy by the ledger, J.
    fn energy(&self) -> f64 {
        self.ends.map_or(0.0, |[from, to]| (to - from).max(0.0))
    }
}
