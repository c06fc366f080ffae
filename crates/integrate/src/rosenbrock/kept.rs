//! The matrices that Newton's method keeps from stage to stage and from step to step, and where they were formed.
//!
//! While a place is on the piece of the right-hand side on which a matrix was formed ([`super::piece`]), that matrix serves; what rattles comes back to
//! the same few pieces again and again, so that several are kept, the one that was used longest ago giving way. A matrix from another piece does
//! harm that corrections do not show: one from within a layer of friction is some hundred times as stiff as what slips, so that what
//! is missing looks as much smaller.

use serde::{Deserialize, Serialize};

use super::Integrator;
use super::attempt::Failure;
use super::piece::Piece;
use crate::kinks::KinkSigns;
use crate::problem::Problem;

/// Where a matrix was formed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Place {
    pub time: f64,
    /// States; padded while the integrator has them.
    pub x: Vec<f64>,
    /// What it is factored with; zero: nothing.
    pub shift: f64,
}

impl Place {
    /// A value that cannot be, in a run that began its smooth piece at `start`.
    pub fn damage(&self, start: f64) -> Option<f64> {
        let mut values = self.x.iter().chain([&self.time, &self.shift]).copied();
        values
            .find(|value| !value.is_finite())
            .or((self.time < start).then_some(self.time))
            .or((self.shift < 0.0).then_some(self.shift))
    }
}

/// A matrix.
#[derive(Clone, Debug, Default)]
struct Matrix {
    place: Place,
    piece: Piece,
}

/// The matrices.
#[derive(Debug, Default)]
pub(super) struct Kept {
    /// By number.
    matrices: Vec<Matrix>,
    /// The numbers of those that are there, the one used last first: the problem uses that one.
    order: Vec<usize>,
    /// Scratch memory: what the problem told of the place that was asked for last.
    signs: KinkSigns,
    here: Piece,
    /// Where in the order the first matrix is that fits there.
    found: Option<usize>,
}

/// What is known of the matrix in use at a place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fit {
    /// It was formed on the same piece.
    Same,
    /// It was formed on another piece, or there is none.
    Other,
    /// There is one, and nobody tells of pieces.
    Unknown,
}

impl Kept {
    /// Room for the matrices of a problem, there too.
    pub fn new<P: Problem>(problem: &mut P, stride: usize) -> Self {
        let signs = KinkSigns::of(problem);
        let here = Piece::of(&signs);
        let matrix = Matrix {
            place: Place {
                x: vec![0.0; stride],
                ..Place::default()
            },
            piece: here.clone(),
        };
        let count = if problem.tells_pieces() {
            problem.matrices()
        } else {
            1
        };
        for number in (0..count).rev() {
            problem.take_matrix(number);
        }
        Self {
            matrices: vec![matrix; count],
            order: Vec::with_capacity(count),
            signs,
            here,
            found: None,
        }
    }

    /// No matrix is there any more.
    pub fn forget(&mut self) {
        self.order.clear();
    }

    /// Looks for the first matrix that fits at the place that was asked for last.
    fn find(&mut self) -> Option<usize> {
        let fits = |number: &usize| self.matrices[*number].piece.is(&self.here);
        self.found = self.order.iter().position(fits);
        self.found
    }

    /// Brings what stands there to the front of the order; its number.
    fn bring(&mut self, place: usize) -> usize {
        self.order[..=place].rotate_right(1);
        self.order[0]
    }

    /// The number for a matrix to be formed, at the front of the order: that of the one that was found to fit and failed, one that is free, or
    /// that of the one that was used longest ago.
    fn make_room(&mut self) -> usize {
        let count = self.order.len();
        let place = self.found.filter(|place| *place < count).unwrap_or_else(|| {
            if count < self.matrices.len() {
                self.order.push(count);
                count
            } else {
                count - 1
            }
        });
        self.bring(place)
    }

    fn in_use(&mut self) -> &mut Matrix {
        &mut self.matrices[self.order[0]]
    }
}

impl<P: Problem> Integrator<P> {
    /// What is known of the matrix in use at the argument, after one that fits was taken if there is one.
    pub(super) fn fit_here(&mut self) -> Fit {
        self.look_here(self.newton.time);
        let kept = &mut self.newton.kept;
        if kept.order.is_empty() {
            return Fit::Other;
        }
        if !self.problem.tells_pieces() {
            return Fit::Unknown;
        }
        match kept.find() {
            None => Fit::Other,
            Some(0) => Fit::Same,
            Some(place) => {
                self.problem.take_matrix(kept.bring(place));
                Fit::Same
            }
        }
    }

    /// The same where the matrix in use has failed: another one that fits, or none.
    pub(super) fn another_fits_here(&mut self) -> Fit {
        match self.fit_here() {
            Fit::Same if self.newton.kept.found != Some(0) => Fit::Same,
            _ => Fit::Other,
        }
    }

    /// Whether the matrix in use fits at the argument.
    pub(super) fn still_fits(&mut self) -> bool {
        self.look_here(self.newton.time);
        let Kept {
            matrices,
            order,
            here,
            ..
        } = &self.newton.kept;
        order
            .first()
            .is_some_and(|number| matrices[*number].piece.is(here))
    }

    /// Sees on which piece the argument is.
    pub(super) fn look_here(&mut self, time: f64) {
        if self.problem.tells_pieces() {
            let x = &self.argument[..self.dimension];
            let Kept { signs, here, .. } = &mut self.newton.kept;
            self.problem.kinks(time, x, signs);
            here.see(signs);
        }
    }

    /// Forms a matrix at the argument, which was looked at last, and where the slope is known.
    pub(super) fn form_matrix(&mut self) {
        self.statistics.jacobians += 1;
        let number = self.newton.kept.make_room();
        self.form_at(self.newton.time, number);
    }

    fn form_at(&mut self, time: f64, number: usize) {
        let n = self.dimension;
        let (x, dx) = (&self.argument[..n], &self.slope[..n]);
        self.problem.take_matrix(number);
        self.problem
            .linearize_for_newton(time, x, dx, &mut self.df_dt[..n]);
        let Kept { matrices, here, .. } = &mut self.newton.kept;
        let Matrix { place, piece } = &mut matrices[number];
        (place.time, place.shift) = (time, 0.0);
        place.x.copy_from_slice(&self.argument);
        std::mem::swap(piece, here);
    }

    /// Has the matrix in use factored with a shift.
    pub(super) fn factor_kept(&mut self, shift: f64) -> Result<(), Failure> {
        if self.newton.kept.in_use().place.shift != shift {
            if let Err(failure) = self.factor(shift) {
                // One that cannot be factored is not kept.
                self.newton.kept.forget();
                return Err(failure);
            }
            self.newton.kept.in_use().place.shift = shift;
        }
        Ok(())
    }

    /// Has the matrices as a saved run had them. Not counted: a run without a break has them.
    pub(super) fn form_matrices_again(&mut self, saved: &[Place]) {
        let n = self.dimension;
        self.newton.kept.forget();
        // From the one used longest ago on: the last one is in use.
        let more = saved.len().saturating_sub(self.newton.kept.matrices.len());
        for (number, saved) in saved[more..].iter().enumerate() {
            self.argument.fill(0.0);
            self.argument[..n].copy_from_slice(&saved.x);
            self.problem
                .derivative(saved.time, &saved.x, &mut self.slope[..n]);
            self.look_here(saved.time);
            self.newton.kept.order.insert(0, number);
            self.form_at(saved.time, number);
            if saved.shift > 0.0 && self.problem.factor(saved.shift).is_ok() {
                self.newton.kept.in_use().place.shift = saved.shift;
            }
        }
    }

    /// Where the matrices were formed, for a saved run: from the one used longest ago on.
    pub(super) fn places_of_matrices(&self) -> Vec<Place> {
        let Kept { matrices, order, .. } = &self.newton.kept;
        let places = order.iter().rev().map(|number| &matrices[*number].place);
        let own = |place: &Place| Place {
            x: place.x[..self.dimension].to_vec(),
            ..*place
        };
        places.map(own).collect()
    }
}
