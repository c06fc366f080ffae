//! Problems made of closures.

use crate::block_lu::BlockLu;
use crate::kinks::KinkSigns;
use crate::problem::{Problem, Singular};

type Function<'a> = Box<dyn FnMut(f64, &[f64], &mut [f64]) + Send + 'a>;
type Start<'a> = Box<dyn FnMut(f64, &[f64], &mut [u8]) + Send + 'a>;
type Margins<'a> = Box<dyn FnMut(f64, &[f64], &[u8], &mut [f64]) + Send + 'a>;
type Stiffness<'a> = Box<dyn FnMut(f64, &[f64]) -> f64 + Send + 'a>;
type NextMode<'a> = Box<dyn FnMut(f64, &[f64], usize, u8) -> u8 + Send + 'a>;

type Kinks<'a> = Box<dyn FnMut(f64, &[f64], &mut KinkSigns) + Send + 'a>;

/// Discrete switches made of closures.
struct Switches<'a> {
    count: usize,
    initial: Start<'a>,
    margins: Margins<'a>,
    next: NextMode<'a>,
}

/// A [`Problem`] made of closures, with a dense Jacobian matrix.
///
/// ```
/// use integrate::{Integrator, Options, Ordinary};
/// // Harmonic oscillator; its switch records the sign of the position.
/// let problem = Ordinary::new(
///     vec![1.0; 2],
///     |_, x, dx| {
///         dx[0] = x[1];
///         dx[1] = -x[0];
///     },
///     |_, _, jacobian| jacobian.copy_from_slice(&[0.0, 1.0, -1.0, 0.0]),
/// )
/// .switches(
///     1,
///     |_, x, modes| modes[0] = u8::from(x[0] < 0.0),
///     |_, x, modes, margins| margins[0] = if modes[0] == 0 { x[0] + 1e-9 } else { 1e-9 - x[0] },
///     |_, _, _, mode| 1 - mode,
/// );
/// let mut integrator = Integrator::new(problem, Options::default(), 0.0, &[1.0, 0.0])?;
/// while integrator.events().is_empty() {
///     integrator.step_to(f64::INFINITY)?;
/// }
/// assert!((integrator.events()[0].time - std::f64::consts::FRAC_PI_2).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Ordinary<'a> {
    scales: Vec<f64>,
    derivative: Function<'a>,
    jacobian: Function<'a>,
    time_derivative: Option<Function<'a>>,
    switches: Option<Switches<'a>>,
    layer_bounds: Vec<f64>,
    stiffness: Option<Stiffness<'a>>,
    /// How many values and directions, and what writes them.
    kinks: Option<((usize, usize), Kinks<'a>)>,
    /// Whether the kinks told are all there are.
    pieces: bool,
    /// Ends of segments, ascending.
    breaks: Vec<f64>,
    displacements: usize,
    matrix: BlockLu,
}

impl std::fmt::Debug for Ordinary<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Ordinary")
            .field("scales", &self.scales)
            .finish_non_exhaustive()
    }
}

impl<'a> Ordinary<'a> {
    /// A problem with as many states as there are error scales: `derivative(t, x, dx)` writes the right-hand side,
    /// `jacobian(t, x, matrix)` its partial derivatives row by row (the matrix comes filled with zeros).
    pub fn new(
        scales: Vec<f64>,
        derivative: impl FnMut(f64, &[f64], &mut [f64]) + Send + 'a,
        jacobian: impl FnMut(f64, &[f64], &mut [f64]) + Send + 'a,
    ) -> Self {
        let matrix = BlockLu::new(&[scales.len()], &[]);
        Self {
            displacements: scales.len(),
            scales,
            derivative: Box::new(derivative),
            jacobian: Box::new(jacobian),
            time_derivative: None,
            switches: None,
            layer_bounds: Vec::new(),
            stiffness: None,
            kinks: None,
            pieces: false,
            breaks: Vec::new(),
            matrix,
        }
    }

    /// The right-hand side depends on time: `function(t, x, df_dt)` writes its partial derivative.
    #[must_use]
    pub fn time_derivative(mut self, function: impl FnMut(f64, &[f64], &mut [f64]) + Send + 'a) -> Self {
        self.time_derivative = Some(Box::new(function));
        self
    }

    /// Times at which the explicit time dependence has a kink or jump.
    #[must_use]
    pub fn breaks(mut self, mut times: Vec<f64>) -> Self {
        times.sort_by(f64::total_cmp);
        self.breaks = times;
        self
    }

    /// What tells kinks beforehand, see [`KinkSigns`]: as many values and directions as `function(t, x, signs)` writes.
    #[must_use]
    pub fn kinks(
        mut self,
        values: usize,
        directions: usize,
        function: impl FnMut(f64, &[f64], &mut KinkSigns) + Send + 'a,
    ) -> Self {
        self.kinks = Some(((values, directions), Box::new(function)));
        self
    }

    /// The kinks told are all there are, see [`Problem::tells_pieces`].
    #[must_use]
    pub fn in_pieces(mut self) -> Self {
        self.pieces = true;
        self
    }

    /// How fast the fastest part of the problem answers, 1/s, see [`Problem::stiffness`]: `function(t, x)`.
    #[must_use]
    pub fn stiffness(mut self, function: impl FnMut(f64, &[f64]) -> f64 + Send + 'a) -> Self {
        self.stiffness = Some(Box::new(function));
        self
    }

    /// How many leading states are displacements, see [`Problem::displacements`]; without this call all are.
    #[must_use]
    pub fn displacements(mut self, count: usize) -> Self {
        self.displacements = count;
        self
    }

    /// The largest admissible errors while a direction is in its layer, see [`Problem::layer_bounds`].
    #[must_use]
    pub fn layer_bounds(mut self, bounds: Vec<f64>) -> Self {
        self.layer_bounds = bounds;
        self
    }

    /// Discrete switches, see [`Problem`]: `initial(t, x, modes)`, `margins(t, x, modes, margins)`,
    /// `next(t, x, index, mode)`.
    #[must_use]
    pub fn switches(
        mut self,
        count: usize,
        initial: impl FnMut(f64, &[f64], &mut [u8]) + Send + 'a,
        margins: impl FnMut(f64, &[f64], &[u8], &mut [f64]) + Send + 'a,
        next: impl FnMut(f64, &[f64], usize, u8) -> u8 + Send + 'a,
    ) -> Self {
        self.switches = Some(Switches {
            count,
            initial: Box::new(initial),
            margins: Box::new(margins),
            next: Box::new(next),
        });
        self
    }
}

impl Problem for Ordinary<'_> {
    fn dimension(&self) -> usize {
        self.scales.len()
    }

    fn displacements(&self) -> usize {
        self.displacements
    }

    fn layer_bounds(&self) -> &[f64] {
        &self.layer_bounds
    }

    fn scales(&self) -> &[f64] {
        &self.scales
    }

    fn segment(&mut self, start: f64) -> f64 {
        self.breaks
            .iter()
            .copied()
            .find(|time| *time > start)
            .unwrap_or(f64::INFINITY)
    }

    fn derivative(&mut self, time: f64, x: &[f64], dx: &mut [f64]) {
        (self.derivative)(time, x, dx);
    }

    fn linearize(&mut self, time: f64, x: &[f64], _dx: &[f64], df_dt: &mut [f64]) {
        self.matrix.clear();
        if let Some(block) = self.matrix.block_mut(0, 0) {
            (self.jacobian)(time, x, block);
        }
        if let Some(function) = &mut self.time_derivative {
            function(time, x, df_dt);
        }
    }

    fn stiffness(&mut self, time: f64, x: &[f64]) -> f64 {
        match &mut self.stiffness {
            Some(function) => function(time, x),
            None => f64::INFINITY,
        }
    }

    fn factor(&mut self, shift: f64) -> Result<(), Singular> {
        self.matrix.factor_shifted(shift)
    }

    fn solve(&mut self, b: &mut [f64]) {
        self.matrix.solve(b);
    }

    fn kink_counts(&self) -> (usize, usize) {
        self.kinks.as_ref().map_or((0, 0), |(counts, _)| *counts)
    }

    fn kinks(&mut self, time: f64, x: &[f64], signs: &mut KinkSigns) {
        if let Some((_, function)) = &mut self.kinks {
            function(time, x, signs);
        }
    }

    fn tells_pieces(&self) -> bool {
        self.pieces
    }

    fn switch_count(&self) -> usize {
        self.switches.as_ref().map_or(0, |switches| switches.count)
    }

    fn initial_modes(&mut self, time: f64, x: &[f64], modes: &mut [u8]) {
        if let Some(switches) = &mut self.switches {
            (switches.initial)(time, x, modes);
        }
    }

    /// Time and states: what the functions are told.
    fn sign_count(&self) -> usize {
        1 + self.dimension()
    }

    fn signs(&mut self, time: f64, x: &[f64], signs: &mut [f64]) {
        signs[0] = time;
        signs[1..].copy_from_slice(x);
    }

    fn group_margins(&mut self, _: usize, signs: &[f64], modes: &[u8], margins: &mut [f64]) {
        if let Some(switches) = &mut self.switches {
            (switches.margins)(signs[0], &signs[1..], modes, margins);
        }
    }

    fn next_mode(&mut self, _: usize, signs: &[f64], index: usize, mode: u8) -> u8 {
        match &mut self.switches {
            Some(switches) => (switches.next)(signs[0], &signs[1..], index, mode),
            None => mode,
        }
    }
}
