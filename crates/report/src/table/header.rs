//! Names of columns: what, then unit.
//!
//! Units are those that results are written with (`force_lbf`, `force_N`), and every other one of the table
//! of units, at the end of the name (`force_kN`, `stiffness_kN_per_mm`) or in brackets (`force [kN]`): such
//! columns are converted to the system of units of the table.

use std::collections::BTreeMap;
use std::path::Path;

use input::bounded;
use quantity::{Kind, System as Units, Unit, nearest};
use wedge::outputs::Outputs;
use wedge::parameters::Damping;

use super::error::TableError;

/// A name taken apart.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Name {
    /// As in the file.
    pub full: String,
    /// Without unit.
    pub base: String,
    pub kind: Kind,
    /// `None` for units that both systems have, and for pure numbers.
    pub units: Option<Units>,
    /// One of the unit in SI units, if it is none of those that results are written with.
    pub unit: Option<f64>,
}

impl Name {
    /// Returns the number in a system of units; without a unit of its own, the same bits as written.
    pub fn in_units(&self, written: f64, units: Units) -> f64 {
        match self.unit {
            Some(unit) => written * unit * self.kind.from_si(units),
            None => written,
        }
    }
}

/// The line of names, understood.
pub(super) struct Header {
    pub names: Vec<Name>,
    pub units: Units,
    /// Index of the time.
    pub time: usize,
}

/// The place of the line of names.
pub(super) struct HeaderLocation<'p> {
    pub file: &'p Path,
    pub line: u64,
}

impl HeaderLocation<'_> {
    fn error(&self, problem: impl Into<String>, advice: impl Into<String>) -> TableError {
        TableError::Header {
            file: self.file.to_owned(),
            line: self.line,
            problem: bounded(problem.into()),
            advice: bounded(advice.into()),
        }
    }
}

/// Understands the line of names.
pub(super) fn read(place: &HeaderLocation<'_>, cells: &[&str]) -> Result<Header, TableError> {
    if cells.iter().all(|cell| cell.parse::<f64>().is_ok()) {
        return Err(place.error(
            "numbers stand where the names of the columns are expected",
            "write a first line of names with units, such as time_s,wedge_x_in,vertical_wedge_force_lbf",
        ));
    }
    if let ([only], Some(sign)) = (cells, cells.first().and_then(|cell| cell.find([';', '\t']))) {
        let sign = if only[sign..].starts_with(';') {
            "`;`"
        } else {
            "a tab"
        };
        return Err(place.error(
            format!("{sign} stands between the names of the columns; `,` is expected"),
            "separate the columns by `,` and write decimal points",
        ));
    }
    const MOST: usize = 5000;
    if cells.len() > MOST {
        let problem = format!("{} columns; at most {MOST} are read", cells.len());
        return Err(place.error(problem, "look whether this is the file you mean"));
    }
    let known = known();
    let mut names: Vec<Name> = Vec::with_capacity(cells.len());
    for (index, cell) in cells.iter().enumerate() {
        let name = understand(place, index, cell, &known)?;
        if let Some(first) = names.iter().position(|other| other.base == name.base) {
            // One quantity in two systems of units is rather a mixture.
            mixture(place, names.iter().chain([&name]))?;
            return Err(TableError::Duplicate {
                file: place.file.to_owned(),
                line: place.line,
                name: name.base,
                first: first + 1,
                second: index + 1,
            });
        }
        names.push(name);
    }
    let Some(time) = names.iter().position(|name| name.base == "time") else {
        let near =
            nearest("time_s", cells.iter().copied()).or_else(|| nearest("time", cells.iter().copied()));
        let advice = match near {
            Some(near) => format!("is `{near}` the time? Name it time_s, in seconds"),
            None => "a table of results has a column time_s, in seconds".to_owned(),
        };
        return Err(place.error("there is no column `time_s`", advice));
    };
    let units = mixture(place, names.iter())?.unwrap_or_default();
    Ok(Header { names, units, time })
}

/// Returns the system of units of all names; an error if there are two.
fn mixture<'n>(
    place: &HeaderLocation<'_>,
    names: impl Iterator<Item = &'n Name> + Clone,
) -> Result<Option<Units>, TableError> {
    let first = |units| names.clone().find(|name| name.units == Some(units));
    match (first(Units::Us), first(Units::Si)) {
        (Some(us), Some(si)) => Err(TableError::Mixed {
            file: place.file.to_owned(),
            line: place.line,
            us: us.full.clone(),
            si: si.full.clone(),
        }),
        (Some(_), None) => Ok(Some(Units::Us)),
        (None, Some(_)) => Ok(Some(Units::Si)),
        (None, None) => Ok(None),
    }
}

/// Returns the columns that our results have, by name without unit.
fn known() -> BTreeMap<String, Kind> {
    // Their names and kinds are the same for every wedge.
    let outputs = Outputs::new(&wedge::thesis::parameters(Damping::Variable, 0.0, 0.0));
    let columns = outputs.columns().iter();
    columns.map(|column| (column.name.clone(), column.kind)).collect()
}

fn understand(
    place: &HeaderLocation<'_>,
    index: usize,
    cell: &str,
    known: &BTreeMap<String, Kind>,
) -> Result<Name, TableError> {
    if cell.is_empty() {
        let problem = format!("column {} has no name", index + 1);
        return Err(place.error(problem, "name it, with its unit, or leave it out"));
    }
    const LONGEST: usize = 200;
    if cell.len() > LONGEST {
        let problem = format!("the name of column {} has {} characters", index + 1, cell.len());
        return Err(place.error(problem, format!("give it a name of at most {LONGEST} characters")));
    }
    if bounded(cell.to_owned()) != cell {
        let problem = format!("the name of column {} holds a control character", index + 1);
        return Err(place.error(
            problem,
            "look whether the file is damaged, and name the column anew",
        ));
    }
    if let Some(kind) = known.get(cell) {
        if !kind.suffix(Units::Us).is_empty() {
            let [us, si] = [Units::Us, Units::Si].map(|units| format!("{cell}_{}", kind.suffix(units)));
            let advice = match us == si {
                true => format!("write {us}"),
                false => format!("write {us} or {si}"),
            };
            return Err(place.error(
                format!(
                    "column {} (`{cell}`) has no unit; {} is expected",
                    index + 1,
                    kind.name()
                ),
                advice,
            ));
        }
        return Ok(plain(cell, *kind));
    }
    let fits = |kind: &Kind, units: Units| {
        let suffix = kind.suffix(units);
        let base = cell.strip_suffix(suffix)?.strip_suffix('_')?;
        (!suffix.is_empty() && !base.is_empty()).then_some((suffix.len(), base))
    };
    let all = Kind::ALL
        .iter()
        .flat_map(|kind| [(kind, Units::Us), (kind, Units::Si)]);
    let endings: Vec<(Kind, Units, usize, &str)> = all
        .filter_map(|(kind, units)| fits(kind, units).map(|(length, base)| (*kind, units, length, base)))
        .collect();
    let longest = endings.iter().map(|(_, _, length, _)| *length).max();
    if let Some((base, unit)) = other_unit(cell, longest.unwrap_or(0)) {
        return converted(place, index, cell, (base, unit), known);
    }
    let Some(longest) = longest else {
        return Ok(plain(cell, Kind::Dimensionless));
    };
    let longest: Vec<_> = endings
        .into_iter()
        .filter(|(_, _, length, _)| *length == longest)
        .collect();
    let (first_kind, first_units, _, base) = longest[0];
    let kind = match known.get(base) {
        None => first_kind,
        Some(own) if longest.iter().any(|(kind, ..)| kind == own) => *own,
        Some(own) => {
            let problem = format!(
                "column {} (`{cell}`) is {}; {} is expected",
                index + 1,
                first_kind.name(),
                own.name()
            );
            let example = |units| match own.suffix(units) {
                "" => base.to_owned(),
                suffix => format!("{base}_{suffix}"),
            };
            let advice = format!("write {} or {}", example(Units::Us), example(Units::Si));
            return Err(place.error(problem, advice));
        }
    };
    let both = kind.suffix(Units::Us) == kind.suffix(Units::Si);
    Ok(Name {
        full: cell.to_owned(),
        base: base.to_owned(),
        kind,
        units: (!both).then_some(first_units),
        unit: None,
    })
}

/// Returns the name and the unit of a column whose unit, longer than `longest` bytes at the end of its name,
/// is one of the table of units; none if there is no such unit.
fn other_unit(cell: &str, longest: usize) -> Option<(&str, Unit)> {
    if let Some((base, unit)) = cell.split_once(['[', '(']) {
        let unit = unit.trim_end_matches([']', ')']);
        return Some((base.trim(), Unit::parse(unit).ok()?)).filter(|(base, _)| !base.is_empty());
    }
    // `force_min` is rather a least force than a force of minutes.
    const WORDS: [&str; 3] = ["min", "h", "t"];
    cell.match_indices('_').find_map(|(at, _)| {
        let (base, ending) = (&cell[..at], &cell[at + 1..]);
        // `force_in_lbf` is no moment.
        let inside = ending.starts_with("in_") && !ending.starts_with("in_per_");
        if base.is_empty() || ending.len() <= longest || inside || (WORDS.contains(&ending) && base != "time")
        {
            return None;
        }
        let unit = Unit::parse(&expression(ending)).ok()?;
        kind_of(unit)?;
        Some((base, unit))
    })
}

/// Returns the ending of a name as a unit: `kN_s_per_m2` is `kN s/(m^2)`.
fn expression(ending: &str) -> String {
    let product = |part: &str| -> String {
        let powers = part
            .split('_')
            .map(|unit| match unit.split_at_checked(unit.len().max(1) - 1) {
                Some((name, power @ ("2" | "3"))) => format!("{name}^{power}"),
                _ => unit.to_owned(),
            });
        powers.collect::<Vec<String>>().join(" ")
    };
    let mut parts = ending.split("_per_").map(product);
    let over = parts.next().unwrap_or_default();
    parts.fold(over, |over, under| format!("{over}/({under})"))
}

/// Returns the first kind that a unit measures.
fn kind_of(unit: Unit) -> Option<Kind> {
    let mut kinds = Kind::ALL.into_iter();
    kinds.find(|kind| *kind != Kind::Dimensionless && *kind != Kind::Count && kind.accepts(unit.dimension()))
}

/// Returns the name of a column with a unit of its own.
fn converted(
    place: &HeaderLocation<'_>,
    index: usize,
    cell: &str,
    (base, unit): (&str, Unit),
    known: &BTreeMap<String, Kind>,
) -> Result<Name, TableError> {
    let found = kind_of(unit);
    let kind = match (known.get(base), found) {
        (Some(own), _) if own.accepts(unit.dimension()) => *own,
        (None, Some(kind)) => kind,
        (own, found) => {
            let found = found.map_or("a quantity that no column has", Kind::name);
            let expected = own.map_or(String::new(), |own| format!("; {} is expected", own.name()));
            let problem = format!(
                "column {} (`{}`) is {found}{expected}",
                index + 1,
                bounded(cell.to_owned())
            );
            return Err(place.error(problem, "look at the unit, or leave the column out"));
        }
    };
    Ok(Name {
        full: cell.to_owned(),
        base: base.to_owned(),
        kind,
        units: unit.system(),
        unit: Some(unit.factor()),
    })
}

fn plain(cell: &str, kind: Kind) -> Name {
    Name {
        full: cell.to_owned(),
        base: cell.to_owned(),
        kind,
        units: None,
        unit: None,
    }
}
