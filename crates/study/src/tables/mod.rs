//! Tables of a nest for other programs: vertical force over stroke and warp moment over warp angle, both
//! branches of the loop, over load, wedge rise, friction and rate; with their error against whole runs.
//!
//! A program with massless wedges takes them in place of its wedges and its empirical warp stiffness.
//!
//! - [`grid`]: nodes, and interpolation between them; [`read`]: lists of values as users write them,
//! - [`rig`]: the runs, one for each test and node,
//! - [`check`]: runs between the nodes and at another amplitude, and how far the tables are from them.

pub mod check;
pub mod grid;
pub mod read;
pub mod rig;

use quantity::{Kind, SixDigits, System as Units};
use serde::{Deserialize, Serialize};

use crate::case::CaseError;
use crate::truck::TruckCase;
use check::Check;
use grid::{Direction, Grid, OutsideGrid, Point};
use rig::{Branches, Test, Wanted, carried};

/// Rise of the wedges unless others are given, m: none, and 0.75 in (a guess, as of a worn truck).
pub const RISES: [f64; 2] = [0.0, 0.75 * 0.0254];
/// Friction unless others are given: guesses about 0.4 of Steets (2007).
pub const FRICTIONS: [f64; 3] = [0.2, 0.35, 0.5];
/// Rates unless others are given, Hz: that of warp tests, and about that of a car's bounce (a guess).
pub const RATES: [f64; 2] = [0.1, 1.0];
/// Loads unless others are given, over what the coils carry in the nominal layout: an empty car, about (a
/// guess), one between, and a loaded one.
pub const LOADS: [f64; 3] = [0.3, 0.6, 1.0];
/// Amplitudes of stroke (m) and warp angle (rad) unless others are given.
pub const AMPLITUDES: [f64; 2] = [0.5 * 0.0254, 0.020];
/// Greatest amplitudes, m and rad.
pub const MOST_AMPLITUDES: [f64; 2] = [0.1, 0.05];
/// Most nodes of a grid.
pub const MOST_NODES: usize = 10_000;

/// What tables are made of.
#[derive(Clone, Debug)]
pub struct TablesRequest {
    /// The truck whose nests are taken.
    pub case: TruckCase,
    /// The grid.
    pub grid: Grid,
    /// Amplitudes of stroke (m) and warp angle (rad).
    pub amplitudes: [f64; 2],
}

/// Lists as users write them; empty ones have the usual values.
#[derive(Clone, Debug, Default)]
pub struct Lists {
    /// Of load, rise, friction and rate.
    pub directions: [Vec<String>; 4],
    /// Amplitudes of stroke and warp angle.
    pub amplitudes: [Option<String>; 2],
}

impl TablesRequest {
    /// Returns the request of a case and of lists.
    ///
    /// # Errors
    /// A list is wrong, or the nests cannot have its values.
    pub fn new(case: &TruckCase, lists: &Lists) -> Result<Self, TablesError> {
        rig::check(case)?;
        let nominal = carried(&case.parameters, 0.0, 0.0);
        let usual = |direction: Direction| match direction {
            Direction::Load => LOADS.map(|share| share * nominal).to_vec(),
            Direction::Rise => RISES.to_vec(),
            Direction::Friction => FRICTIONS.to_vec(),
            Direction::Rate => RATES.map(|rate| rate * std::f64::consts::TAU).to_vec(),
        };
        let mut values: [Vec<f64>; 4] = Default::default();
        for ((own, direction), texts) in values.iter_mut().zip(Direction::ALL).zip(&lists.directions) {
            *own = match texts.as_slice() {
                [] => usual(direction),
                texts => read::list(direction, texts)?,
            };
        }
        let options = [("stroke", Kind::Length), ("angle", Kind::Angle)];
        let mut amplitudes = AMPLITUDES;
        for (k, (option, kind)) in options.into_iter().enumerate() {
            if let Some(text) = &lists.amplitudes[k] {
                amplitudes[k] = read::amplitude(option, kind, text, MOST_AMPLITUDES[k])?;
            }
        }
        let request = Self {
            case: case.clone(),
            grid: Grid { values },
            amplitudes,
        };
        request.check()?;
        Ok(request)
    }

    /// Checks the values against what the nests are.
    fn check(&self) -> Result<(), TablesError> {
        let [_, rises, ..] = &self.grid.values;
        let pockets = self.case.parameters.wedges.iter();
        let pocket = pockets
            .map(|wedge| wedge.rise_limit)
            .fold(f64::INFINITY, f64::min);
        if let Some(place) = rises.iter().position(|rise| *rise > pocket) {
            return Err(TablesError::Pocket {
                place: place + 1,
                rise: rises[place],
                pocket,
            });
        }
        if self.grid.count() > MOST_NODES {
            return Err(TablesError::TooMany(self.grid.count()));
        }
        // Every node has a height, or nothing runs.
        for wanted in self.wanted() {
            rig::case(&self.case, &wanted)?;
        }
        Ok(())
    }

    /// Returns all runs: of each test the nodes, then the checks.
    #[must_use]
    pub fn wanted(&self) -> Vec<Wanted> {
        let tests = Test::ALL.into_iter().zip(self.amplitudes);
        tests
            .flat_map(|(test, amplitude)| {
                let nodes = self.grid.nodes().map(move |at| Wanted { test, at, amplitude });
                let checks = check::places(&self.grid).into_iter();
                nodes.chain(checks.map(move |place| place.wanted(test, amplitude)))
            })
            .collect()
    }

    /// Returns the time that all runs simulate, s.
    #[must_use]
    pub fn simulated(&self) -> f64 {
        let wanted = self.wanted().into_iter();
        wanted.map(|own| own.test.duration(own.at[3])).sum()
    }

    /// Returns the tables, from what each of [`TablesRequest::wanted`] has given, in that order; none if
    /// there are fewer.
    #[must_use]
    pub fn tables(&self, found: &[Branches]) -> Option<NestTables> {
        let places = check::places(&self.grid);
        let count = self.grid.count();
        let table = |number: usize| {
            let begin = number * (count + places.len());
            let branches = found.get(begin..begin + count)?.to_vec();
            let checked = found.get(begin + count..begin + count + places.len())?;
            let test = Test::ALL[number];
            let amplitude = self.amplitudes[number];
            let mut table = Table {
                test,
                amplitude,
                positions: rig::positions(amplitude),
                branches,
                checks: Vec::new(),
            };
            let checks = places.iter().zip(checked);
            table.checks = checks
                .map(|(place, found)| Check::of(&self.grid, &table, place, found))
                .collect();
            Some(table)
        };
        Some(NestTables {
            case: self.case.name.clone(),
            title: self.case.title.clone(),
            grid: self.grid.clone(),
            tables: [table(0)?, table(1)?],
        })
    }
}

/// The table of a test.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Table {
    /// The test.
    pub test: Test,
    /// Amplitude of the motion, m or rad.
    pub amplitude: f64,
    /// Positions, m or rad, increasing.
    pub positions: Vec<f64>,
    /// The branches at the nodes of the grid, N or N·m.
    pub branches: Vec<Branches>,
    /// How far the table is from runs that are not in it.
    pub checks: Vec<Check>,
}

/// The tables of a nest.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NestTables {
    /// Name of the case.
    pub case: String,
    /// Its title.
    pub title: String,
    /// The grid.
    pub grid: Grid,
    /// Of the nest and of warp.
    pub tables: [Table; 2],
}

impl NestTables {
    /// Checks tables that were read: a grid with increasing values, branches at all nodes and positions.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn validate(&self) -> Result<(), String> {
        let increases = |values: &[f64]| {
            let pairs = values.windows(2).all(|pair| pair[0] < pair[1]);
            pairs && values.iter().all(|own| own.is_finite())
        };
        let lists = self.grid.values.iter();
        if lists
            .clone()
            .any(|values| values.is_empty() || !increases(values))
        {
            return Err("the values of its grid do not increase".to_owned());
        }
        let count = lists.map(Vec::len).try_fold(1_usize, usize::checked_mul);
        let count = count.filter(|count| *count <= MOST_NODES);
        for (table, test) in self.tables.iter().zip(Test::ALL) {
            let named = |what: &str| format!("the table of {}: {what}", test.name());
            let positions = table.positions.len();
            if table.test != test || !(table.amplitude > 0.0 && table.amplitude.is_finite()) {
                return Err(named("another one is expected, with an amplitude above zero"));
            }
            if positions < 2 || !increases(&table.positions) {
                return Err(named("two positions at least are expected, increasing"));
            }
            if Some(table.branches.len()) != count {
                return Err(named("branches at each node of the grid are expected"));
            }
            let whole = |own: &Vec<f64>| own.len() == positions && own.iter().all(|own| own.is_finite());
            let branches = table.branches.iter();
            if !branches.flat_map(|own| [&own.rising, &own.falling]).all(whole) {
                return Err(named("finite branches at each position are expected"));
            }
        }
        Ok(())
    }
}

impl Table {
    /// Returns rising and falling branch at a point of the grid and a position; beyond the positions the
    /// outermost slopes go on.
    ///
    /// # Errors
    /// The point lies outside the grid.
    pub fn at(&self, grid: &Grid, at: Point, position: f64) -> Result<[f64; 2], OutsideGrid> {
        let weights = grid.weights(at)?;
        let last = self.positions.len() - 1;
        let above = self.positions.partition_point(|own| *own <= position);
        let above = above.clamp(1, last);
        let [from, to] = [self.positions[above - 1], self.positions[above]];
        let share = (position - from) / (to - from);
        let mut sums = [0.0; 2];
        for (node, weight) in weights {
            let own = &self.branches[node];
            for (sum, branch) in sums.iter_mut().zip([&own.rising, &own.falling]) {
                // At a position its own value, to the last bit.
                *sum += weight * ((1.0 - share) * branch[above - 1] + share * branch[above]);
            }
        }
        Ok(sums)
    }

    /// Returns the mean of both branches and half of their difference at a point and a position.
    ///
    /// # Errors
    /// The point lies outside the grid.
    pub fn mean_and_half(&self, grid: &Grid, at: Point, position: f64) -> Result<[f64; 2], OutsideGrid> {
        let [rising, falling] = self.at(grid, at, position)?;
        Ok([0.5 * (rising + falling), 0.5 * (rising - falling)])
    }

    /// Returns the largest force or moment, either sign, at a node.
    #[must_use]
    pub fn largest(&self) -> f64 {
        let branches = self.branches.iter();
        let values = branches.flat_map(|own| own.rising.iter().chain(&own.falling));
        values.fold(0.0, |most, own| most.max(own.abs()))
    }
}

/// Reasons why there are no tables.
#[derive(Debug, thiserror::Error)]
pub enum TablesError {
    /// A value of a list is wrong.
    #[error("value {place} of --{option}, `{text}`: {reason}")]
    Value {
        /// The option.
        option: &'static str,
        /// Its place in the list, from one.
        place: usize,
        /// As typed.
        text: String,
        /// What is wrong.
        reason: String,
        /// What to write.
        help: String,
    },
    /// A rise that the pockets do not hold.
    #[error(
        "value {place} of --rise is {}, and the pockets hold {} (wedge.rise_limit)",
        inches(*.rise), inches(*.pocket)
    )]
    Pocket {
        /// Its place in the list, from one.
        place: usize,
        /// The rise, m.
        rise: f64,
        /// What the pockets hold, m.
        pocket: f64,
    },
    /// A load that the coils carry nowhere.
    #[error("the coils of a nest carry {} at no height, {} at most", pounds(*.load), pounds(*.most))]
    Load {
        /// The load, N.
        load: f64,
        /// The most that they carry, N.
        most: f64,
    },
    /// Wedges without mass.
    #[error("the wedges of {0} have no mass: between held bodies nothing of them can move")]
    Massless(String),
    /// More nodes than a program takes.
    #[error("the grid has {0} nodes, more than {most}", most = MOST_NODES)]
    TooMany(usize),
    /// A case that is refused.
    #[error(transparent)]
    Case(CaseError),
    /// A run that has no branches.
    #[error("the run {name} at {} {reason}", words(*.at))]
    Run {
        /// Its name.
        name: String,
        /// Load, rise, friction and rate.
        at: Point,
        /// What happened.
        reason: String,
    },
}

impl TablesError {
    /// Returns what to do; empty where the message says it.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            Self::Value { help, .. } => help.clone(),
            Self::Pocket { .. } => {
                "give a smaller rise, or with --set the rise that your pockets hold as wedge.rise_limit"
                    .to_owned()
            }
            Self::Load { .. } => "give a load between that of the empty car and that of solid coils, \
                                  per nest: half of what stands on a truck"
                .to_owned(),
            Self::Massless(_) => {
                "write wedge.kind = \"body\"; a program with massless wedges needs no table \
                                  of them"
                    .to_owned()
            }
            Self::TooMany(_) => "give fewer values, or several tables".to_owned(),
            Self::Run { .. } => "leave this value out, or run the case there alone with `wedgelab run`: a \
                                 nest that is solid or a wedge that lies loose shows in its warnings"
                .to_owned(),
            Self::Case(_) => String::new(),
        }
    }
}

fn inches(value: f64) -> String {
    format!("{} in", SixDigits(value * Kind::Length.from_si(Units::Us)))
}

fn pounds(value: f64) -> String {
    format!("{:.0} lbf", value * Kind::Force.from_si(Units::Us))
}

/// Returns a point of the grid in words.
#[must_use]
pub fn words([load, rise, friction, rate]: Point) -> String {
    format!(
        "load {}, rise {}, friction {}, rate {} Hz",
        pounds(load),
        inches(rise),
        SixDigits(friction),
        SixDigits(rate / std::f64::consts::TAU)
    )
}
