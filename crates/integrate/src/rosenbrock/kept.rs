//! The matrix that Newton's method keeps from stage to stage and from step to step, and where it was formed.
//!
//! Contact and friction are nearly linear in pieces: while the same points are closed, and slip as they did, the matrix changes little.
//! It is kept where the problem tells that the place is on the piece of the right-hand side on which it was formed. A matrix from elsewhere does
//! harm that corrections do not show: one from within a layer of friction is some hundred times as stiff as what slips, so that what
//! is missing looks as much smaller.

use serde::{Deserialize, Serialize};

use super::Integrator;
use super::attempt::Failure;
use crate::kinks::{KinkSigns, square};
use crate::problem::Problem;

/// Directions larger than this are out of their layers.
const OUTSIDE: f64 = 8.0;
/// They may turn by an angle with this cosine.
const TURNS: f64 = 0.9;
/// Sizes of directions in layers may differ by this. By 0.5 a fifth of the matrices is saved, but the losses of what sticks, which change as fast as the
/// hold of the layer, come out wrong: ledgers miss 3e-3 of the work instead of 1e-3.
const NEAR: f64 = 0.1;

/// Where the matrix was formed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Place {
    pub time: f64,
    /// States; padded while the integrator has them.
    pub x: Vec<f64>,
    /// What the matrix is factored with; zero: nothing.
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
    pub there: bool,
    pub place: Place,
    signs: KinkSigns,
    /// Scratch memory: what tells kinks at the place that was asked for last.
    here: KinkSigns,
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
    pub fn new<P: Problem>(problem: &P, stride: usize) -> Self {
        let signs = KinkSigns::of(problem);
        Self {
            place: Place {
                x: vec![0.0; stride],
                ..Place::default()
            },
            here: signs.clone(),
            signs,
            ..Self::default()
        }
    }
}

impl<P: Problem> Integrator<P> {
    /// What is known of the kept matrix at the argument.
    pub(super) fn fit_here(&mut self) -> Fit {
        self.look_here(self.underway.wanted);
        let kept = &self.newton.kept;
        if !kept.there {
            Fit::Other
        } else if !self.problem.tells_pieces() {
            Fit::Unknown
        } else if on_one_piece(&kept.signs, &kept.here) {
            Fit::Same
        } else {
            Fit::Other
        }
    }

    /// Sees what tells kinks at the argument.
    pub(super) fn look_here(&mut self, time: f64) {
        if self.problem.tells_pieces() {
            let x = &self.argument[..self.dimension];
            self.problem.kinks(time, x, &mut self.newton.kept.here);
        }
    }

    /// Forms the matrix at the argument, which was looked at last, and where the slope is known.
    pub(super) fn form_matrix(&mut self) {
        self.statistics.jacobians += 1;
        self.form_at(self.underway.wanted);
    }

    fn form_at(&mut self, time: f64) {
        let n = self.dimension;
        let (x, dx) = (&self.argument[..n], &self.slope[..n]);
        self.problem
            .linearize_for_newton(time, x, dx, &mut self.df_dt[..n]);
        let kept = &mut self.newton.kept;
        kept.there = true;
        (kept.place.time, kept.place.shift) = (time, 0.0);
        kept.place.x.copy_from_slice(&self.argument);
        std::mem::swap(&mut kept.signs, &mut kept.here);
    }

    /// Has the matrix factored with a shift.
    pub(super) fn factor_kept(&mut self, shift: f64) -> Result<(), Failure> {
        if self.newton.kept.place.shift != shift {
            // One that cannot be factored is not kept.
            self.newton.kept.there = false;
            self.factor(shift)?;
            self.newton.kept.there = true;
            self.newton.kept.place.shift = shift;
        }
        Ok(())
    }

    /// Has the matrix as a saved run had it. Not counted: a run without a break has it.
    pub(super) fn form_matrix_again(&mut self, saved: Option<&Place>) {
        let Some(saved) = saved else { return };
        let n = self.dimension;
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

/// Whether two places lie on one piece of the right-hand side, on which its derivatives are about the same.
fn on_one_piece(a: &KinkSigns, b: &KinkSigns) -> bool {
    let mut values = a.values.iter().zip(&b.values);
    let mut directions = a.directions.iter().zip(&b.directions);
    values.all(|(a, b)| (*a < 0.0) == (*b < 0.0)) && directions.all(|(a, b)| is_near(*a, *b))
}

fn is_near(a: [f64; 2], b: [f64; 2]) -> bool {
    let (square_a, square_b) = (square(&a), square(&b));
    if square_a.is_nan() || square_b.is_nan() {
        return square_a.is_nan() && square_b.is_nan();
    }
    if square_a.min(square_b) > OUTSIDE * OUTSIDE {
        let product = a[0] * b[0] + a[1] * b[1];
        return product > 0.0 && product * product > TURNS * TURNS * (square_a * square_b);
    }
    (square_a.sqrt() - square_b.sqrt()).abs() <= NEAR
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_ends_where_a_point_opens_or_its_slip_turns_or_comes_to_stick() {
        const NONE: [f64; 2] = [f64::NAN; 2];
        let signs = |value: f64, direction| KinkSigns {
            values: vec![value],
            directions: vec![direction],
        };
        let slips = signs(-1e-4, [100.0, 0.0]);
        let sticks = signs(-1e-4, [0.3, 0.0]);
        for (a, b, one) in [
            (&slips, signs(-2e-4, [30.0, 5.0]), true),
            (&slips, signs(-1e-4, [-100.0, 0.0]), false),
            (&slips, signs(-1e-4, [0.0, 100.0]), false),
            (&slips, signs(-1e-4, [2.0, 0.0]), false),
            (&slips, signs(1e-4, NONE), false),
            (&sticks, signs(-1e-4, [-0.3, 0.1]), true),
            (&sticks, signs(-1e-4, [1.0, 0.0]), false),
            (&signs(1e-4, NONE), signs(1e-5, NONE), true),
            (&signs(-1e-4, NONE), signs(1e-5, NONE), false),
        ] {
            assert_eq!(on_one_piece(a, &b), one, "{a:?}, {b:?}");
            assert_eq!(on_one_piece(&b, a), one, "{b:?}, {a:?}");
        }
    }
}
