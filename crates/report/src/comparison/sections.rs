//! Results beside each other section by section: statistics of a model against measurements.
//!
//! The first result is the measured one. Every other result is cut into the same sections, over the distance
//! where all have it, else over time; each result is read at its own rows, straight between them. Numbers are
//! in the units of the first result. The statistics are those of [`study::sections`].

use quantity::{Kind, System as Units, nearest};
use study::sections::{
    Acceptance, Along, Cut, Differences, FEWEST, SectionQuantity, SectionRequest, SectionVerdict,
    section_values,
};

use super::energies::{SummaryPart, summaries};
use super::{ComparedResult, ComparisonError, choose, conversion};
use crate::table::{ResultTable, TableColumn};

/// Rows of a section below which its percentiles say little.
const FEW_ROWS: usize = 20;
/// Most sections that a note lists.
const LISTED: usize = 5;

/// The differences of one quantity of one column of one result from the first result's.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionRow {
    /// The column, without unit.
    pub column: String,
    /// Its unit as shown; empty for pure numbers.
    pub unit: &'static str,
    /// The result, by its place among the entries.
    pub result: usize,
    /// The quantity.
    pub quantity: SectionQuantity,
    /// The values of each section: of the first result, and of this one.
    pub values: Vec<[f64; 2]>,
    /// Their differences.
    pub differences: Differences,
    /// The limit of the standard deviation, and the verdict by it.
    pub verdict: Option<(f64, SectionVerdict)>,
}

/// The outcome of comparing results with the first one section by section.
#[derive(Clone, Debug)]
pub struct SectionComparison {
    /// Units of all numbers but the places: the first result's.
    pub units: Units,
    /// The axis that is cut.
    pub along: Along,
    /// From where to where each section goes, m or s.
    pub sections: Vec<[f64; 2]>,
    /// The rows: by column, result and quantity.
    pub rows: Vec<SectionRow>,
    /// Conversions and omissions, in words.
    pub notes: Vec<String>,
    /// What makes the numbers doubtful, in words.
    pub warnings: Vec<String>,
}

impl SectionComparison {
    /// Compares results with the first of them; `columns` chooses as in [`super::Comparison::of`], empty: the
    /// accepted ones, where there are any.
    ///
    /// # Errors
    /// See [`ComparisonError`].
    pub fn of(
        entries: &[ComparedResult],
        columns: &[String],
        request: &SectionRequest,
        acceptance: Option<&Acceptance>,
    ) -> Result<Self, ComparisonError> {
        let Some((first, others)) = entries.split_first() else {
            return Err(ComparisonError::NoCommonTime {
                spans: "there are no results".to_owned(),
            });
        };
        let mut notes = Vec::new();
        let summaries = summaries(entries, &mut notes);
        let models: Vec<_> = summaries.iter().map(SummaryPart::model).collect();
        let limited = limited(entries, acceptance)?;
        let wanted = match columns {
            [] => limited.iter().map(|(name, _)| name.clone()).collect(),
            own => own.to_vec(),
        };
        let names = choose::choose(entries, &models, &wanted, &mut notes)?;
        let along = axis(entries, request)?;
        let names: Vec<String> = names.into_iter().filter(|own| *own != along.column()).collect();
        if names.is_empty() {
            return Err(ComparisonError::Axis {
                column: along.column(),
            });
        }
        let places = entries.iter().map(|own| places(own, along));
        let places = places.collect::<Result<Vec<_>, _>>()?;
        let units = first.table.units;
        let span = common_span(entries, &places, along)?;
        let cut = request.cut(along, span, units)?;
        notes.extend(others.iter().filter_map(|own| conversion(first, own)));
        notes.extend(left_out(&cut, along, units));
        let mut warnings = rows_of_sections(entries, &places, &cut, along)?;
        if cut.sections.len() < FEWEST {
            warnings.push(format!(
                "{} sections are fewer than {FEWEST}: their mean and standard deviation say little; \
                 sections of {} would give {FEWEST}",
                cut.sections.len(),
                along.words((span[1] - span[0]) / FEWEST as f64, units)
            ));
        }
        let mut rows = Vec::new();
        for name in &names {
            let own = values_of(&first.table, name, &places[0], units, &cut.sections)?;
            let column = first.table.column(name)?;
            for (place, other) in others.iter().enumerate() {
                let theirs = values_of(&other.table, name, &places[place + 1], units, &cut.sections)?;
                for (number, quantity) in SectionQuantity::ALL.into_iter().enumerate() {
                    let pairs = own.iter().zip(&theirs);
                    let values: Vec<[f64; 2]> = pairs.map(|(a, b)| [a[number], b[number]]).collect();
                    let not_finite = || ComparisonError::NotFinite {
                        column: name.clone(),
                        result: other.label.clone(),
                    };
                    let differences = Differences::of(&values).ok_or_else(not_finite)?;
                    if !(differences.mean.is_finite() && differences.deviation.is_finite()) {
                        return Err(not_finite());
                    }
                    let limit = limit(acceptance, &limited, name, quantity, column.kind)?;
                    let limit = limit.map(|own| own * column.kind.from_si(units));
                    rows.push(SectionRow {
                        column: name.clone(),
                        unit: column.kind.label(units),
                        result: place + 1,
                        quantity,
                        values,
                        differences,
                        verdict: limit.map(|own| (own, SectionVerdict::of(&differences, own))),
                    });
                }
            }
        }
        notes.extend(turning(&rows));
        for (name, _) in limited.iter().filter(|(name, _)| !names.contains(name)) {
            notes.push(format!("The limits of {name} are not used: it is not compared."));
        }
        Ok(Self {
            units,
            along,
            sections: cut.sections,
            rows,
            notes,
            warnings,
        })
    }
}

/// Returns the columns that have limits: the results' names of them, and those of the file.
fn limited(
    entries: &[ComparedResult],
    acceptance: Option<&Acceptance>,
) -> Result<Vec<(String, String)>, ComparisonError> {
    let mut found = Vec::new();
    let Some((acceptance, first)) = acceptance.zip(entries.first()) else {
        return Ok(found);
    };
    for typed in acceptance.columns() {
        let own = first.table.find(typed).filter(|own| own.name != "time");
        let own = own.filter(|own| entries.iter().all(|entry| entry.table.find(&own.name).is_some()));
        match own {
            Some(own) => found.push((own.name.clone(), typed.to_owned())),
            None => {
                let names = first.table.columns().iter().map(|own| own.name.as_str());
                return Err(acceptance.unknown(typed, names).into());
            }
        }
    }
    Ok(found)
}

/// Returns the limit (SI) of a quantity of a column.
fn limit(
    acceptance: Option<&Acceptance>,
    limited: &[(String, String)],
    column: &str,
    quantity: SectionQuantity,
    kind: Kind,
) -> Result<Option<f64>, ComparisonError> {
    let typed = limited.iter().find(|(name, _)| name == column);
    match acceptance.zip(typed) {
        Some((acceptance, (_, typed))) => Ok(acceptance.limit(typed, quantity, kind)?),
        None => Ok(None),
    }
}

/// Returns the axis: the one that the request prescribes, else the distance where all have it.
fn axis(entries: &[ComparedResult], request: &SectionRequest) -> Result<Along, ComparisonError> {
    let name = Along::Distance.column();
    let is_distance = |own: &&TableColumn| own.kind.dimension() == Kind::Distance.dimension();
    let without = entries
        .iter()
        .find(|own| own.table.find(name).filter(is_distance).is_none());
    match (request.along(), without) {
        (Some(Along::Time), _) | (None, Some(_)) => Ok(Along::Time),
        (_, None) => Ok(Along::Distance),
        (Some(Along::Distance), Some(own)) => {
            let names = own.table.columns().iter().map(|own| own.name.as_str());
            Err(ComparisonError::NoDistance {
                file: own.table.file.clone(),
                advice: match (own.table.find(name), nearest(name, names)) {
                    (Some(_), _) => "give it a unit of length: distance_ft or distance_m".to_owned(),
                    (None, Some(near)) => format!("is `{near}` the distance? Write --map distance={near}"),
                    (None, None) => {
                        "cut by time: --sections \"2 s\", or a file with from [s], to [s]".to_owned()
                    }
                },
            })
        }
    }
}

/// Returns the places of a result's rows, m or s.
fn places(entry: &ComparedResult, along: Along) -> Result<Vec<f64>, ComparisonError> {
    let column = entry.table.column(along.column())?;
    let places = column.si();
    match places.windows(2).position(|pair| pair[1] < pair[0]) {
        Some(row) => Err(ComparisonError::NotRising {
            file: entry.table.file.clone(),
            column: along.column(),
            row: row + 2,
            before: along.words(places[row], column.units),
            value: along.words(places[row + 1], column.units),
        }),
        None => Ok(places),
    }
}

/// Returns the part of the axis that all results have.
fn common_span(
    entries: &[ComparedResult],
    places: &[Vec<f64>],
    along: Along,
) -> Result<[f64; 2], ComparisonError> {
    let ends = |own: &Vec<f64>| [own.first(), own.last()].map(|end| end.copied().unwrap_or(f64::NAN));
    let wide = [f64::NEG_INFINITY, f64::INFINITY];
    let span = places
        .iter()
        .map(ends)
        .fold(wide, |[from, to], [first, last]| [from.max(first), to.min(last)]);
    if span[0] < span[1] {
        return Ok(span);
    }
    let words = entries.iter().zip(places).map(|(entry, own)| {
        let [first, last] = ends(own).map(|end| along.words(end, entry.table.units));
        format!("{} goes from {first} to {last}", entry.label)
    });
    Err(ComparisonError::NothingBeside {
        axis: along.column(),
        spans: words.collect::<Vec<_>>().join(", "),
    })
}

/// Returns the note on what is in no section.
fn left_out(cut: &Cut, along: Along, units: Units) -> Option<String> {
    if cut.rest > 0.0
        && cut
            .sections
            .iter()
            .any(|[from, to]| cut.rest > 1e-6 * (to - from))
    {
        return Some(format!(
            "The last {} are shorter than a section and left out.",
            along.words(cut.rest, units)
        ));
    }
    let (beyond, count) = (&cut.beyond, cut.beyond.len());
    let named: Vec<String> = beyond.iter().take(LISTED).map(usize::to_string).collect();
    (count > 0).then(|| {
        format!(
            "Left out: {count} sections of the file over which not all results reach (number {}{}).",
            named.join(", "),
            if count > LISTED { " and others" } else { "" }
        )
    })
}

/// Checks that every result has rows in every section; warns of few.
fn rows_of_sections(
    entries: &[ComparedResult],
    places: &[Vec<f64>],
    cut: &Cut,
    along: Along,
) -> Result<Vec<String>, ComparisonError> {
    let mut warnings = Vec::new();
    for (entry, own) in entries.iter().zip(places) {
        let counts = cut.sections.iter().map(|[from, to]| {
            own.partition_point(|place| place <= to) - own.partition_point(|place| place < from)
        });
        let least = counts.enumerate().min_by_key(|(_, count)| *count);
        let (number, rows) = least.unwrap_or((0, 0));
        let words = cut.sections[number].map(|end| along.words(end, entry.table.units));
        let section = format!("section {} ({} to {})", number + 1, words[0], words[1]);
        if rows < 2 {
            return Err(ComparisonError::NoRows {
                file: entry.table.file.clone(),
                rows,
                section,
            });
        }
        if rows < FEW_ROWS {
            warnings.push(format!(
                "{} has {rows} rows in {section}: percentiles and rms of so few say little; name longer \
                 sections, or results with more rows",
                entry.label
            ));
        }
    }
    Ok(warnings)
}

/// Returns the values of each section of a column, in these units.
fn values_of(
    table: &ResultTable,
    name: &str,
    places: &[f64],
    units: Units,
    sections: &[[f64; 2]],
) -> Result<Vec<[f64; 3]>, ComparisonError> {
    let column = table.column(name)?;
    let values = column.in_units(units);
    let held = column.kind == Kind::Count;
    let found = sections
        .iter()
        .map(|own| section_values(places, &values, held, *own));
    found
        .collect::<Option<Vec<_>>>()
        .ok_or_else(|| ComparisonError::NotFinite {
            column: name.to_owned(),
            result: table.file.display().to_string(),
        })
}

/// Returns the note on columns whose measured means are of both signs and larger than what moves about them,
/// as in curves to both sides.
fn turning(rows: &[SectionRow]) -> Option<String> {
    const QUANTITIES: usize = SectionQuantity::ALL.len();
    let turns = |own: &&[SectionRow]| {
        let [mean, .., rms] = own else { return false };
        let measured = |own: &SectionRow| own.values.iter().map(|pair| pair[0]).collect::<Vec<f64>>();
        let (means, about) = (measured(mean), measured(rms));
        let about = about.iter().sum::<f64>() / about.len() as f64;
        means.iter().any(|own| *own > about) && means.iter().any(|own| *own < -about)
    };
    let own = rows.chunks_exact(QUANTITIES).filter(turns);
    let mut names: Vec<&str> = own.map(|own| own[0].column.as_str()).collect();
    names.dedup();
    let listed = names[..names.len().min(LISTED)].join(", ");
    (!names.is_empty()).then(|| {
        format!(
            "Measured means of both signs: {listed}{}. A model that is too small on both sides has \
             differences of both signs, which cancel in their mean: compare left and right curves by \
             files of sections.",
            if names.len() > LISTED { " and others" } else { "" }
        )
    })
}
