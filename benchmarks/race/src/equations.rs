//! The equations as every other solver gets them: a state, its rates, its Jacobian matrix.
//!
//! State `z = (q, u, s, w)`: positions, speeds, bristle deflections, and one quadrature, the energy lost in
//! friction at the first face (the side frame's column), which the energy per cycle needs. Our own integrator
//! carries all quadratures of the energy ledger besides, as it always does.

use integrate::Problem as _;

use mechanics::system::{EnergyTermKind, System};
use nalgebra::DMatrix;
use numerics::Singular;

use crate::problem::{ProblemError, RaceProblem};

/// A shift of the size of the wedge's contact frequencies, 1/s; any other would do.
const SHIFT: f64 = 2e3;

/// A problem's equations in the reduced state.
pub struct Equations {
    system: System,
    /// Number of positions.
    positions: usize,
    /// Number of positions, speeds and bristle deflections.
    mechanical: usize,
    /// Place of the loss in the system's own state.
    loss: usize,
    start: Vec<f64>,
    scales: Vec<f64>,
    x: Vec<f64>,
    dx: Vec<f64>,
    df_dt: Vec<f64>,
    inverse: DMatrix<f64>,
}

impl Equations {
    /// Returns the equations of a problem of this name.
    ///
    /// # Errors
    /// There is no such problem.
    pub fn named(name: &str) -> Result<Self, ProblemError> {
        let problem = RaceProblem::named(name)?;
        Ok(Self::new(problem.system, &problem.start))
    }

    /// Returns the equations of a system that starts in this state.
    #[must_use]
    pub fn new(mut system: System, start: &[f64]) -> Self {
        let layout = system.layout();
        let mechanical = 2 * layout.speeds + layout.internals;
        let loss = system
            .energy_terms()
            .iter()
            .position(|energy_term| energy_term.kind == EnergyTermKind::FrictionLoss)
            .unwrap_or(0);
        let full_scales = system.structure().scales;
        // No problem of the race has a motion with breaks: one smooth piece.
        system.next_time_discontinuity(0.0);
        let reduce = |full: &[f64]| {
            let mut reduced = full[..mechanical].to_vec();
            reduced.push(full[mechanical + loss]);
            reduced
        };
        Self {
            positions: layout.speeds,
            mechanical,
            loss: mechanical + loss,
            start: reduce(start),
            scales: reduce(&full_scales),
            x: vec![0.0; start.len()],
            dx: vec![0.0; start.len()],
            df_dt: vec![0.0; start.len()],
            inverse: DMatrix::zeros(mechanical + 1, mechanical + 1),
            system,
        }
    }

    /// Number of states.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.mechanical + 1
    }

    /// Returns the state at the start, SI.
    #[must_use]
    pub fn start(&self) -> &[f64] {
        &self.start
    }

    /// Returns the error scale of each state: a solver's absolute tolerance is the tolerance times it.
    #[must_use]
    pub fn scales(&self) -> &[f64] {
        &self.scales
    }

    /// The reduced state out of the system's own.
    pub fn reduce(&self, full: &[f64], z: &mut [f64]) {
        z[..self.mechanical].copy_from_slice(&full[..self.mechanical]);
        z[self.mechanical] = full[self.loss];
    }

    /// Returns the system's own state out of the reduced one, other quadratures zero.
    #[must_use]
    pub fn complete(&self, z: &[f64]) -> Vec<f64> {
        let mut full = vec![0.0; self.x.len()];
        full[..self.mechanical].copy_from_slice(&z[..self.mechanical]);
        full[self.loss] = z[self.mechanical];
        full
    }

    /// Returns the system, to observe what a state says.
    pub fn system(&mut self) -> &mut System {
        &mut self.system
    }

    /// The rates of the state `z` at `time`.
    #[inline]
    pub fn rates(&mut self, time: f64, z: &[f64], dz: &mut [f64]) {
        self.x[..self.mechanical].copy_from_slice(&z[..self.mechanical]);
        self.system.derivative(time, &self.x, &mut self.dx);
        dz[..self.mechanical].copy_from_slice(&self.dx[..self.mechanical]);
        dz[self.mechanical] = self.dx[self.loss];
    }

    /// Writes the Jacobian matrix of the rates by the state, column by column.
    ///
    /// It is the matrix that our own integrator factors, read out through the same interface: the columns of
    /// `(σ - J)⁻¹` are solutions for unit vectors, and its inverse is `σ - J`. Whatever structure the matrix
    /// is kept in, the others get the same derivatives; reading them out costs them some 2 µs a matrix.
    ///
    /// # Errors
    /// `σ - J` has no inverse, which another state or time mends.
    pub fn jacobian(&mut self, time: f64, z: &[f64], jacobian: &mut [f64]) -> Result<(), Singular> {
        let n = self.dimension();
        self.x[..self.mechanical].copy_from_slice(&z[..self.mechanical]);
        self.system.derivative(time, &self.x, &mut self.dx);
        self.df_dt.fill(0.0);
        self.system.linearize(time, &self.x, &self.dx, &mut self.df_dt);
        self.system.factor(SHIFT)?;
        for column in 0..n {
            let unit = &mut self.df_dt;
            unit.fill(0.0);
            unit[if column < self.mechanical {
                column
            } else {
                self.loss
            }] = 1.0;
            self.system.solve(unit);
            for row in 0..self.mechanical {
                self.inverse[(row, column)] = unit[row];
            }
            self.inverse[(self.mechanical, column)] = unit[self.loss];
        }
        if !self.inverse.try_inverse_mut() {
            return Err(Singular { block: 0 });
        }
        let matrix = &self.inverse;
        for column in 0..n {
            for row in 0..n {
                let own = if row == column { SHIFT } else { 0.0 };
                jacobian[column * n + row] = own - matrix[(row, column)];
            }
            // What is exactly so: rates of positions are the speeds, and nothing depends on the loss.
            for row in 0..self.positions {
                jacobian[column * n + row] = if column == self.positions + row { 1.0 } else { 0.0 };
            }
        }
        jacobian[self.mechanical * n..].fill(0.0);
        Ok(())
    }
}
