//! Variables: what an importer can see, get and set.

use crate::unit::Unit;

/// The role of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Causality {
    /// Time.
    Independent,
    /// Set before a simulation, or tuned while it runs.
    Parameter,
    /// Given by others.
    Input,
    /// For others.
    Output,
    /// An observed value.
    Local,
}

impl Causality {
    /// Returns its name in descriptions.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Independent => "independent",
            Self::Parameter => "parameter",
            Self::Input => "input",
            Self::Output => "output",
            Self::Local => "local",
        }
    }
}

/// The times at which a variable may change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variability {
    /// Never after the initialization.
    Fixed,
    /// At calls that set it.
    Tunable,
    /// At events.
    Discrete,
    /// Always.
    Continuous,
}

impl Variability {
    /// Returns its name in descriptions.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fixed => "fixed",
            Self::Tunable => "tunable",
            Self::Discrete => "discrete",
            Self::Continuous => "continuous",
        }
    }
}

/// A start value, which gives a variable its type too.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Start {
    /// A real number; none where it is calculated.
    Float(Option<f64>),
    /// An integer; none where it is calculated.
    Integer(Option<i32>),
    /// A truth value.
    Boolean(bool),
}

/// The quantity that a variable shows: the kind of quantity an element has, and its number among those.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableRole {
    /// Time.
    Time,
    /// A real parameter.
    Parameter(usize),
    /// An option: an integer or a truth value.
    Option(usize),
    /// An input.
    Input(usize),
    /// An output that depends directly on inputs.
    Output(usize),
    /// A continuous state.
    State(usize),
    /// Its rate.
    Rate(usize),
    /// A value that is only observed.
    Column(usize),
    /// A contact state.
    ContactState(usize),
    /// An event indicator.
    Indicator(usize),
}

/// A variable.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its value reference: its place in the list.
    pub reference: u32,
    /// Its name.
    pub name: String,
    /// The description, one line.
    pub text: String,
    /// The quantity that it shows.
    pub role: VariableRole,
    /// Its unit; `None` for numbers without one.
    pub unit: Option<Unit>,
    /// Its role.
    pub causality: Causality,
    /// The times at which it may change.
    pub variability: Variability,
    /// Type and start value.
    pub start: Start,
    /// Its usual size.
    pub nominal: Option<f64>,
    /// Least and greatest admissible value, where there is a reach.
    pub reach: Option<[f64; 2]>,
}

impl Variable {
    /// Returns whether its value at the start is calculated, not given.
    #[must_use]
    pub fn is_calculated(&self) -> bool {
        matches!(self.start, Start::Float(None) | Start::Integer(None))
            && self.causality != Causality::Independent
    }
}
