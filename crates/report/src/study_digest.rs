//! The digest of a study's rows for its summary page, gathered in one pass and in memory that does not grow
//! with the study: means over the values of each parameter, and of each pair of parameters.

use mechanics::energy_balance::{DOUBTFUL, Verdict};
use study::design::{Factor, Levels, Sampling, Study, Value};
use study::measures::Measures;
use study::records::{Record, Status};

/// The measure of how well the energy ledger closes.
const LEDGER_RESIDUAL: &str = "ledger_residual";
/// The measure that a wheel left its rail.
const DERAILED: &str = "derailed";
/// A list of values longer than this is cut into parts.
const MOST_LEVELS: usize = 40;
const MOST_PARTS: u64 = 16;
/// Pairs are gathered of the first so many numeric parameters.
const PAIRED: usize = 4;
/// Reasons of failed runs that are kept.
const REASONS: usize = 10;

/// The values of a parameter, sorted into places.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterAxis {
    /// Numbers or texts, each with a place of its own.
    Values {
        /// The values.
        values: Vec<Value>,
        /// The numbers in the parameter's unit; empty if not all are numbers.
        numbers: Vec<f64>,
    },
    /// A range cut into equal parts.
    Parts {
        /// Its beginning.
        from: f64,
        /// Its end.
        to: f64,
        /// True if parts are equal ratios, false if equal differences.
        logarithmic: bool,
        /// Number of parts.
        count: usize,
    },
}

impl ParameterAxis {
    fn of(factor: &Factor, sampling: &Sampling, runs: u64) -> Self {
        // Some runs should fall into each part of a pair.
        let count = ((runs as f64 / 6.0).sqrt() as u64).clamp(3, MOST_PARTS) as usize;
        let parts = |from, to, logarithmic| Self::Parts {
            from,
            to,
            logarithmic,
            count,
        };
        match &factor.levels {
            Levels::Range { count, .. }
                if *sampling == Sampling::FullFactorial && *count <= MOST_LEVELS as u64 =>
            {
                Self::values(factor, (0..*count).map(|number| factor.level(number)).collect())
            }
            Levels::Range {
                from,
                to,
                logarithmic,
                ..
            } => parts(from.min(*to), from.max(*to), *logarithmic),
            Levels::Values(values) => {
                let axis = Self::values(factor, values.clone());
                match axis.numbers() {
                    Some(numbers) if values.len() > MOST_LEVELS => {
                        let ends = numbers
                            .iter()
                            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
                                (low.min(*value), high.max(*value))
                            });
                        parts(ends.0, ends.1, false)
                    }
                    _ => axis,
                }
            }
        }
    }

    /// Values in their order; numbers in order of size.
    fn values(factor: &Factor, mut values: Vec<Value>) -> Self {
        let number = |value: &Value| value.in_unit(factor.unit()?);
        if factor.unit().is_some() {
            values.sort_by(|a, b| {
                let pair = [a, b].map(|value| number(value).unwrap_or(f64::NAN));
                pair[0].total_cmp(&pair[1])
            });
        }
        if factor.unit().is_none() {
            values.truncate(MOST_LEVELS);
        }
        let numbers: Option<Vec<f64>> = values.iter().map(number).collect();
        Self::Values {
            values,
            numbers: numbers.unwrap_or_default(),
        }
    }

    /// Number of places.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Values { values, .. } => values.len(),
            Self::Parts { count, .. } => *count,
        }
    }

    /// Returns whether it has no place.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    fn numbers(&self) -> Option<&[f64]> {
        match self {
            Self::Values { numbers, .. } if !numbers.is_empty() => Some(numbers),
            _ => None,
        }
    }

    /// Returns the middles of the places, in the parameter's unit; `None` for texts.
    #[must_use]
    pub fn middles(&self) -> Option<Vec<f64>> {
        match self {
            Self::Values { .. } => self.numbers().map(<[f64]>::to_vec),
            Self::Parts {
                from,
                to,
                logarithmic,
                count,
            } => Some(
                (0..*count)
                    .map(|part| {
                        let share = (part as f64 + 0.5) / *count as f64;
                        if *logarithmic {
                            from * libm::pow(to / from, share)
                        } else {
                            from + (to - from) * share
                        }
                    })
                    .collect(),
            ),
        }
    }

    fn place(&self, factor: &Factor, value: Option<&Value>) -> Option<usize> {
        let value = value?;
        match self {
            Self::Values { values, .. } => values.iter().position(|own| own == value),
            Self::Parts {
                from,
                to,
                logarithmic,
                count,
            } => {
                let number = value.in_unit(factor.unit()?)?;
                let share = if *logarithmic {
                    libm::log(number / from) / libm::log(to / from)
                } else {
                    (number - from) / (to - from)
                };
                share
                    .is_finite()
                    .then(|| ((share * *count as f64).max(0.0) as usize).min(count - 1))
            }
        }
    }
}

/// Mean and extremes of values that come one by one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gathered {
    /// Their number.
    pub count: u64,
    /// Their sum.
    pub sum: f64,
    /// The least.
    pub least: f64,
    /// The greatest.
    pub most: f64,
}

impl Gathered {
    const NONE: Self = Self {
        count: 0,
        sum: 0.0,
        least: f64::INFINITY,
        most: f64::NEG_INFINITY,
    };

    fn add(&mut self, value: f64) {
        if value.is_finite() {
            self.count += 1;
            self.sum += value;
            self.least = self.least.min(value);
            self.most = self.most.max(value);
        }
    }

    /// Returns the mean; `NaN` of nothing.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.sum / self.count as f64
    }
}

/// The digests of all metrics in a cell.
pub type MetricCell = Vec<Gathered>;

/// A pair of parameters: means over the places of both.
#[derive(Clone, Debug)]
pub struct ParameterPair {
    /// Their numbers among the factors.
    pub factors: [usize; 2],
    /// Measures by place: `place of the first * places of the second + place of the second`.
    pub cells: Vec<MetricCell>,
    /// Runs without measures, by place.
    pub failed: Vec<u64>,
}

/// The cells of the jam map from runs whose slope friction acts the same way.
#[derive(Clone, Debug)]
pub struct JamCells {
    /// True if these are runs with toe in; the others have toe out or none.
    pub toe_in: bool,
    /// Their toe, rad, positive out.
    pub toe: Gathered,
    /// The column's force over the coil's load, falling and rising, by place of angle and friction as in
    /// [`ParameterPair`].
    pub ratios: Vec<[Gathered; 2]>,
}

/// The jam map over angle and friction.
#[derive(Clone, Debug)]
pub struct Jam {
    /// The numbers of angle and friction among the factors.
    pub factors: [usize; 2],
    /// Toe in, and toe out or none.
    pub cells: [JamCells; 2],
}

impl Jam {
    const ANGLE: &str = "wedge.angle";
    const FRICTIONS: [&str; 2] = ["friction.column", "friction.slope"];
    const TOE: &str = "side_frame.toe";
    const RATIOS: [&str; 2] = ["column_force_ratio_down", "column_force_ratio_up"];

    /// If angle and friction are varied, by three places each at least.
    fn new(study: &Study, axes: &[ParameterAxis]) -> Option<Self> {
        let numeric = |axis: &ParameterAxis| axis.middles().is_some_and(|middles| middles.len() > 2);
        let of = |path: &str| factor_of(study, path).filter(|number| numeric(&axes[*number]));
        let (angle, friction) = (
            of(Self::ANGLE)?,
            Self::FRICTIONS.iter().find_map(|path| of(path))?,
        );
        let places = axes[angle].len() * axes[friction].len();
        let cells = [true, false].map(|toe_in| JamCells {
            toe_in,
            toe: Gathered::NONE,
            ratios: vec![[Gathered::NONE; 2]; places],
        });
        Some(Self {
            factors: [angle, friction],
            cells,
        })
    }

    fn add(&mut self, study: &Study, values: &[Option<Value>], cell: usize, measures: &Measures) {
        let varied = factor_of(study, Self::TOE).and_then(|number| values[number].as_ref());
        let varied = varied.and_then(|value| value.in_unit("rad"));
        let toe = varied.or(study.base.wedge().map(|case| case.parameters.toe));
        let Some(toe) = toe else { return };
        let cells = &mut self.cells[usize::from(toe >= 0.0)];
        cells.toe.add(toe);
        for (gathered, name) in cells.ratios[cell].iter_mut().zip(Self::RATIOS) {
            if let Some(value) = study.measures().get(measures, name) {
                gathered.add(value);
            }
        }
    }
}

/// Returns the factor that varies this path.
fn factor_of(study: &Study, path: &str) -> Option<usize> {
    let mut factors = study.factors.iter();
    factors.position(|factor| factor.paths.iter().any(|own| own == path))
}

/// The digest of a study.
#[derive(Clone, Debug)]
pub struct Digest {
    /// The parameters.
    pub axes: Vec<ParameterAxis>,
    /// For each parameter, for each of its places, the measures.
    pub effects: Vec<Vec<MetricCell>>,
    /// The pairs of numeric parameters.
    pub pairs: Vec<ParameterPair>,
    /// The jam map, if angle and friction are varied.
    pub jam: Option<Jam>,
    /// All runs together.
    pub all: MetricCell,
    /// Runs that are complete, refused, stopped, failed, derailed.
    pub ended: [u64; Status::ALL.len()],
    /// The first runs that are not complete, and why.
    pub reasons: Vec<(u64, String)>,
    /// Complete runs whose energy ledger closes badly ([`mechanics::energy_balance::DOUBTFUL`]).
    pub doubtful: u64,
    /// The largest relative residual among them, and the number of its run.
    pub worst_residual: (f64, u64),
}

impl Digest {
    /// Nothing gathered yet.
    #[must_use]
    pub fn new(study: &Study) -> Self {
        let none: MetricCell = vec![Gathered::NONE; study.measures().len()];
        let axes: Vec<ParameterAxis> = study
            .factors
            .iter()
            .map(|factor| ParameterAxis::of(factor, &study.sampling, study.count()))
            .collect();
        let numeric: Vec<usize> = (0..axes.len())
            .filter(|number| axes[*number].middles().is_some_and(|middles| middles.len() > 1))
            .take(PAIRED)
            .collect();
        let pairs = numeric.iter().enumerate().flat_map(|(place, first)| {
            let (axes, none) = (&axes, &none);
            numeric[place + 1..].iter().map(move |second| {
                let cells = axes[*first].len() * axes[*second].len();
                ParameterPair {
                    factors: [*first, *second],
                    cells: vec![none.clone(); cells],
                    failed: vec![0; cells],
                }
            })
        });
        Self {
            effects: axes.iter().map(|axis| vec![none.clone(); axis.len()]).collect(),
            pairs: pairs.collect(),
            jam: Jam::new(study, &axes),
            axes,
            all: none,
            ended: [0; Status::ALL.len()],
            reasons: Vec::new(),
            doubtful: 0,
            worst_residual: (0.0, 0),
        }
    }

    /// Returns the warning about runs whose energy ledger closes badly; `None` if there are none.
    #[must_use]
    pub fn warning(&self) -> Option<String> {
        let (residual, number) = self.worst_residual;
        (self.doubtful > 0).then(|| {
            format!(
                "the energy ledger of {} runs does not close: their relative residual (`ledger_residual`) \
                 is above {DOUBTFUL:e}, and {residual:.2e} at most, in run {number}; compute those that \
                 matter with accuracy = \"case\" or a lower simulation.relative_tolerance",
                self.doubtful
            )
        })
    }

    /// Takes in a row.
    pub fn add(&mut self, study: &Study, values: &[Option<Value>], record: &Record) {
        self.ended[record.status as usize] += 1;
        let complete = record.status == Status::Complete;
        if !complete && self.reasons.len() < REASONS {
            self.reasons.push((record.number, record.reason.clone()));
        }
        let residual = study.measures().get(&record.measures, LEDGER_RESIDUAL);
        let residual = residual.unwrap_or(0.0);
        if complete && Verdict::of(residual) != Verdict::Closed {
            self.doubtful += 1;
            if residual > self.worst_residual.0 {
                self.worst_residual = (residual, record.number);
            }
        }
        // The measures of other runs are in the table, and nowhere else: but that they derailed.
        let others = match record.status {
            Status::Derailed => derailment(study, &record.measures),
            _ => Measures::default(),
        };
        let measures = if complete { &record.measures } else { &others };
        let places: Vec<Option<usize>> = self
            .axes
            .iter()
            .zip(&study.factors)
            .zip(values)
            .map(|((axis, factor), value)| axis.place(factor, value.as_ref()))
            .collect();
        add(&mut self.all, measures);
        for (effects, place) in self.effects.iter_mut().zip(&places) {
            if let Some(cell) = place.and_then(|place| effects.get_mut(place)) {
                add(cell, measures);
            }
        }
        if let Some(jam) = self.jam.as_mut().filter(|_| complete)
            && let [Some(angle), Some(friction)] = jam.factors.map(|factor| places[factor])
        {
            let cell = angle * self.axes[jam.factors[1]].len() + friction;
            jam.add(study, values, cell, measures);
        }
        for pair in &mut self.pairs {
            let [first, second] = pair.factors;
            if let (Some(a), Some(b)) = (places[first], places[second]) {
                let cell = a * self.axes[second].len() + b;
                add(&mut pair.cells[cell], measures);
                pair.failed[cell] += u64::from(!complete);
            }
        }
    }
}

/// Returns the measures of a run that derailed, without those that are of the part until then.
fn derailment(study: &Study, measures: &Measures) -> Measures {
    let names = study.measures().iter().map(|own| own.name == DERAILED);
    let kept = names.zip(&measures.0);
    Measures(
        kept.map(|(kept, value)| if kept { *value } else { f64::NAN })
            .collect(),
    )
}

fn add(cell: &mut [Gathered], measures: &Measures) {
    for (cell, value) in cell.iter_mut().zip(&measures.0) {
        cell.add(*value);
    }
}
