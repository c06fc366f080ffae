//! The matrix that Newton's method keeps from stage to stage and from step to step, and where it was formed.
//!
//! While a place is on the piece of the right-hand side on which the matrix was formed ([`super::piece`]), it serves. A matrix from another
//! piece does harm that corrections do not show: one from within a layer of friction is some hundred times as stiff as what slips, so that
//! what is missing looks as much smaller. (Several matrices, one a piece that comes back, brought nothing: decision 0043.)

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

/// The matrix.
#[derive(Debug, Default)]
pub(super) struct Kept {
    /// Whether there is one.
    there: bool,
    place: Place,
    piece: Piece,
    /// Scratch memory: what the problem told of the place that was asked for last.
    signs: KinkSigns,
    here: Piece,
}

/// What is known of the matrix at a place.
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
    /// Room for what is known of the matrix of a problem.
    pub fn new<P: Problem>(problem: &P, stride: usize) -> Self {
        let signs = KinkSigns::of(problem);
        let here = Piece::of(&signs);
        Self {
            there: false,
            place: Place {
                x: vec![0.0; stride],
                ..Place::default()
            },
            piece: here.clone(),
            signs,
            here,
        }
    }

    /// No matrix is there any more.
    pub fn forget(&mut self) {
        self.there = false;
    }
}

impl<P: Problem> Integrator<P> {
    /// What is known of the matrix at the argument.
    pub(super) fn fit_here(&mut self) -> Fit {
        self.look_here(self.newton.time);
        let kept = &self.newton.kept;
        if !kept.there {
            Fit::Other
        } else if !self.problem.tells_pieces() {
            Fit::Unknown
        } else if kept.piece.is(&kept.here) {
            Fit::Same
        } else {
            Fit::Other
        }
    }

    /// Whether the matrix fits at the argument.
    pub(super) fn still_fits(&mut self) -> bool {
        self.fit_here() == Fit::Same
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
        self.form_at(self.newton.time);
    }

    fn form_at(&mut self, time: f64) {
        let n = self.dimension;
        let (x, dx) = (&self.argument[..n], &self.slope[..n]);
        self.problem
            .linearize_for_newton(time, x, dx, &mut self.df_dt[..n]);
        let kept = &mut self.newton.kept;
        (kept.there, kept.place.time, kept.place.shift) = (true, time, 0.0);
        kept.place.x.copy_from_slice(&self.argument);
        std::mem::swap(&mut kept.piece, &mut kept.here);
    }

    /// Has the matrix factored with a shift.
    pub(super) fn factor_kept(&mut self, shift: f64) -> Result<(), Failure> {
        if self.newton.kept.place.shift != shift {
            if let Err(failure) = self.factor(shift) {
                // One that cannot be factored is not kept.
                self.newton.kept.forget();
                return Err(failure);
            }
            self.newton.kept.place.shift = shift;
        }
        Ok(())
    }

    /// Has the matrix as a saved run had it. Not counted: a run without a break has it.
    pub(super) fn form_matrix_again(&mut self, saved: Option<&Place>) {
        let n = self.dimension;
        self.newton.kept.forget();
        let Some(saved) = saved else {
            return;
        };
        self.argument.fill(0.0);
        self.argument[..n].copy_from_slice(&saved.x);
        self.problem
            .derivative(saved.time, &saved.x, &mut self.slope[..n]);
        self.look_here(saved.time);
        self.form_at(saved.time);
        if saved.shift > 0.0 && self.problem.factor(saved.shift).is_ok() {
            self.newton.kept.place.shift = saved.shift;
        }
    }

    /// Where the matrix was formed, for a saved run.
    pub(super) fn place_of_matrix(&self) -> Option<Place> {
        let Kept { there, place, .. } = &self.newton.kept;
        there.then(|| Place {
            x: place.x[..self.dimension].to_vec(),
            ..*place
        })
    }
}
