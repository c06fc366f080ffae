//! Tables of two columns, and of three for maps: in the case file, or in a CSV file beside it.
//!
//! A CSV file has a line of names with units, `time [s], value [in]`, then one line of numbers a
//! point. Empty lines and lines that begin with `#` do not count.

use super::bounds;
use super::problem::{Problem, Problems, TomlLocation, TomlSource};
use super::section::{self, CaseSection, Range};
use super::tables::Tables;
use super::tree::{NodeValue, TreeNode};
use super::units::in_system;
use input::file::{Expected, Reason, read_text};
use input::{FileType, limits, shortened, structure};
use quantity::{Kind, Quantity, System};
use std::sync::Arc;

/// Columns of quantities: of two, the first one increases; three are a map.
#[derive(Clone, Debug, PartialEq)]
pub struct QuantityTable<const N: usize = 2> {
    /// The CSV file it comes from, as written in the case; `None` if its points stand there.
    pub file: Option<String>,
    /// The points.
    pub rows: Vec<[Quantity; N]>,
}

impl<const N: usize> QuantityTable<N> {
    /// Returns the same points in the units of a system; `kinds` are those of the columns.
    #[must_use]
    pub(crate) fn in_system(&self, kinds: [Kind; N], system: System) -> Self {
        let row = |row: &[Quantity; N]| std::array::from_fn(|i| in_system(&row[i], kinds[i], system));
        Self {
            file: self.file.clone(),
            rows: self.rows.iter().map(row).collect(),
        }
    }

    /// Returns the points as a list, as written in a case file.
    pub(crate) fn points_to_toml(&self) -> String {
        let text = |quantity: &Quantity| toml::Value::from(quantity.text()).to_string();
        let rows: Vec<String> = self
            .rows
            .iter()
            .map(|row| format!("[{}]", row.each_ref().map(text).join(", ")))
            .collect();
        format!("[\n    {},\n]", rows.join(",\n    "))
    }
}

/// The form of a table.
pub(crate) struct TableForm<const N: usize = 2> {
    names: [&'static str; N],
    pub kinds: [Kind; N],
    least: usize,
    /// True if the first column must increase.
    ordered: bool,
    /// True if the second column may fall.
    may_fall: bool,
}

impl TableForm {
    /// Time against a value of this kind, for a cubic spline.
    pub fn motion(kind: Kind) -> Self {
        TableForm {
            names: ["time", "value"],
            kinds: [Kind::Time, kind],
            least: 4,
            ordered: true,
            may_fall: true,
        }
    }

    /// Place against depth, for a cubic spline.
    pub fn profile() -> Self {
        TableForm {
            names: ["place", "depth"],
            kinds: [Kind::Length; 2],
            least: 4,
            ordered: true,
            may_fall: true,
        }
    }

    /// Compression against force.
    pub fn coil() -> Self {
        let names = ["compression", "force"];
        TableForm {
            names,
            kinds: [Kind::Length, Kind::Force],
            least: 2,
            ordered: true,
            may_fall: false,
        }
    }
}

impl TableForm {
    /// Rate of compression against force.
    pub fn damper() -> Self {
        TableForm {
            names: ["rate", "force"],
            kinds: [Kind::Speed, Kind::Force],
            ..Self::coil()
        }
    }

    /// Distance against force.
    pub fn over_distance() -> Self {
        TableForm {
            names: ["distance", "force"],
            kinds: [Kind::Distance, Kind::Force],
            may_fall: true,
            ..Self::coil()
        }
    }
}

impl TableForm {
    /// From one place to another.
    pub fn sections(kind: Kind) -> Self {
        TableForm {
            names: ["from", "to"],
            kinds: [kind; 2],
            may_fall: true,
            ..Self::coil()
        }
    }
}

impl TableForm<3> {
    /// Depths over two places.
    pub fn map() -> Self {
        TableForm {
            names: ["up", "across", "depth"],
            kinds: [Kind::Length; 3],
            least: 4,
            ordered: false,
            may_fall: true,
        }
    }
}

impl<const N: usize> TableForm<N> {
    fn units(&self) -> [&'static str; N] {
        self.kinds.map(|kind| kind.unit(System::Us))
    }

    fn example_rows(&self) -> String {
        let row = |row: usize| {
            let value = |(i, unit): (usize, &str)| format!("\"{} {unit}\"", row * (i + 1));
            let values: Vec<String> = self.units().into_iter().enumerate().map(value).collect();
            format!("[{}]", values.join(", "))
        };
        format!("[{}, {}, ...]", row(0), row(1))
    }

    fn example_header(&self) -> String {
        let columns = self.names.iter().zip(self.units());
        let columns: Vec<String> = columns.map(|(name, unit)| format!("{name} [{unit}]")).collect();
        columns.join(", ")
    }
}

/// Returns the number of values of a row, in words.
fn count_in_words(count: usize) -> &'static str {
    if count == 2 { "two" } else { "three" }
}

/// A line of a table.
pub(crate) struct Row<const N: usize> {
    pub values: [Quantity; N],
    pub place: TomlLocation,
}

/// Reads the table under one of two keys: the name of a file, or the points.
pub(super) fn read_either<const N: usize>(
    section: &CaseSection<'_>,
    file: &str,
    points: &str,
    form: &TableForm<N>,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<QuantityTable<N>> {
    match (section.table.get(file), section.table.entry(points)) {
        (Some(_), Some(second)) => {
            let message = format!("`{}` has both `{file}` and `{points}`", section.path);
            let problem = Problem::new(message)
                .at(&second.key_place)
                .label("one of them is expected");
            problems.push(problem.help("leave one of them out"));
            None
        }
        (None, None) => {
            let help = format!(
                "write {file} = \"table.csv\", or {points} = {}",
                form.example_rows()
            );
            section.require(file, &help, problems);
            None
        }
        (Some(node), None) => read(node, &section.path_of(file), form, tables, problems),
        (None, Some(entry)) => read(&entry.node, &section.path_of(points), form, tables, problems),
    }
}

/// Reads a table from the name of a file or from points. Of a file that must not be quoted, messages tell the
/// place and the kind of a mistake.
pub(crate) fn read<const N: usize>(
    node: &TreeNode,
    path: &str,
    form: &TableForm<N>,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<QuantityTable<N>> {
    match &node.value {
        NodeValue::Text(file) if !tables.may_quote() => {
            let mut found = Problems::new();
            let table = read_quoting(node, path, form, tables, &mut found);
            problems.append(found.map(|problem| problem.without_quoting(file, path, &node.place)));
            table
        }
        _ => read_quoting(node, path, form, tables, problems),
    }
}

fn read_quoting<const N: usize>(
    node: &TreeNode,
    path: &str,
    form: &TableForm<N>,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<QuantityTable<N>> {
    let (file, rows) = match &node.value {
        NodeValue::Text(file) => (
            Some(file.clone()),
            read_file(node, file, path, form, tables, problems)?,
        ),
        NodeValue::List(items) => (None, read_points(items, path, form, problems)?),
        other => {
            let message = format!("`{path}` is {}; a table is expected", other.describe());
            let help = format!("write the name of a CSV file, or {}", form.example_rows());
            problems.push(
                Problem::new(message)
                    .at(&node.place)
                    .label("not a table")
                    .help(help),
            );
            return None;
        }
    };
    check(&rows, &node.place, path, form, problems)?;
    Some(QuantityTable {
        file,
        rows: rows.into_iter().map(|row| row.values).collect(),
    })
}

fn read_points<const N: usize>(
    items: &[TreeNode],
    path: &str,
    form: &TableForm<N>,
    problems: &mut Problems,
) -> Option<Vec<Row<N>>> {
    let mut rows = Vec::with_capacity(items.len());
    let before = problems.count();
    for (at, item) in items.iter().enumerate() {
        let path = format!("{path}[{at}]");
        match &item.value {
            NodeValue::List(cells) if cells.len() == N => {
                let cells = cells.iter().zip(form.kinds);
                let values: Vec<Quantity> = cells
                    .filter_map(|(cell, kind)| section::quantity(cell, &path, kind, Range::Any, problems))
                    .collect();
                if let Ok(values) = values.try_into() {
                    rows.push(Row {
                        values,
                        place: item.place.clone(),
                    });
                }
            }
            _ => {
                let (last, others) = (form.names[N - 1], form.names[..N - 1].join(", "));
                let sort = if N == 2 { "pair" } else { "triple" };
                let message = format!("`{path}` is not a {sort} of {others} and {last}");
                let help = format!("write the points as {}", form.example_rows());
                problems.push(
                    Problem::new(message)
                        .at(&item.place)
                        .label(format!("{} quantities", count_in_words(N)))
                        .help(help),
                );
            }
        }
    }
    (problems.count() == before).then_some(rows)
}

fn read_file<const N: usize>(
    node: &TreeNode,
    file: &str,
    path: &str,
    form: &TableForm<N>,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<Vec<Row<N>>> {
    let shown = tables.shown(file);
    let full = match tables.locate(file) {
        Ok(full) => full,
        Err(refused) => {
            let problem = Problem::new(format!("`{path}`: {shown} {}", refused.reason)).at(&node.place);
            problems.push(problem.label("this file").help(refused.help));
            return None;
        }
    };
    let text = match read_text(&full, &TABLE_FILE) {
        Ok(text) => text,
        Err(mut error) => {
            error.path = shown.into();
            let (message, help) = match error.reason {
                Reason::NotFound => (
                    format!("`{path}`: there is no file {}", error.path.display()),
                    "files are looked for from the folder of the case file; check the name".to_owned(),
                ),
                _ => (
                    format!("`{path}`: {error}"),
                    error.help().unwrap_or_else(|| "name a CSV text file".to_owned()),
                ),
            };
            problems.push(
                Problem::new(message)
                    .at(&node.place)
                    .label("this file")
                    .help(help),
            );
            return None;
        }
    };
    read_csv(&TomlSource::new(shown, text), form, problems)
}

/// The expected file of a table.
const TABLE_FILE: Expected = Expected {
    what: "table",
    types: &[FileType::Results],
    most: limits::TEXT_FILE,
};

/// Reads the text of a CSV file.
pub(crate) fn read_csv<const N: usize>(
    source: &Arc<TomlSource>,
    form: &TableForm<N>,
    problems: &mut Problems,
) -> Option<Vec<Row<N>>> {
    if let Err(excess) = structure::lines(source.text()) {
        let place = TomlLocation {
            source: Arc::clone(source),
            span: excess.span(),
        };
        let problem = Problem::new(format!("the table is not read: {excess}")).at(&place);
        problems.push(problem.label("too long").help(excess.help()));
        return None;
    }
    let mut start = 0;
    let mut lines = source.text().split_inclusive('\n').filter_map(|line| {
        let at = start;
        start += line.len();
        let line = line.trim_end();
        (!line.trim_start().is_empty() && !line.trim_start().starts_with('#')).then_some((at, line))
    });
    let help = format!(
        "the first line names the columns with their units: {}",
        form.example_header()
    );
    let Some((at, header)) = lines.next() else {
        let place = TomlLocation {
            source: Arc::clone(source),
            span: 0..0,
        };
        let problem = Problem::new("the table is empty").at(&place).label("empty");
        problems.push(problem.help(help));
        return None;
    };
    let place = |at: usize, cell: &str| {
        let lead = cell.len() - cell.trim_start().len();
        TomlLocation {
            source: Arc::clone(source),
            span: at + lead..at + lead + cell.trim().len(),
        }
    };
    let mut units = Vec::new();
    for (column, (at, cell)) in cells(header, at).enumerate() {
        let unit = cell
            .split_once('[')
            .and_then(|(_, rest)| rest.trim_end().strip_suffix(']'));
        let (Some(unit), Some(&kind)) = (unit, form.kinds.get(column)) else {
            let found = if unit.is_none() {
                "has no unit"
            } else {
                "is one column too many"
            };
            let problem = Problem::new(format!("`{}` {found}", shortened(cell.trim()))).at(&place(at, cell));
            problems.push(problem.label("name [unit] is expected").help(help));
            return None;
        };
        if let Err(error) = Quantity::parse_as(&format!("1 {unit}"), kind) {
            problems.push(section::unit_problem(
                &error,
                &shortened(cell.trim()),
                kind,
                &place(at, cell),
            ));
            return None;
        }
        units.push(unit);
    }
    let found = units.len();
    let Ok(units): Result<[&str; N], _> = units.try_into() else {
        let message = format!("{} columns are expected", count_in_words(N));
        let label = if found == 1 {
            "one column only"
        } else {
            "two columns only"
        };
        problems.push(
            Problem::new(message)
                .at(&place(at, header))
                .label(label)
                .help(help),
        );
        return None;
    };
    let mut rows = Vec::new();
    for (at, line) in lines {
        let cells: Vec<(usize, &str)> = cells(line, at).collect();
        if cells.len() != N {
            let wanted = count_in_words(N);
            let message = format!("{} values in this line; {wanted} are expected", cells.len());
            let problem = Problem::new(message)
                .at(&place(at, line))
                .label(format!("{wanted} numbers"));
            problems.push(problem.help("separate the numbers with a comma, write decimals with a point"));
            return None;
        }
        let mut read = |(at, cell): (usize, &str), unit: &str, kind: Kind| {
            let number = cell.trim();
            let quantity = match number.parse::<f64>() {
                Ok(_) => Quantity::parse_as(&format!("{number} {unit}"), kind).map_err(|e| e.to_string()),
                Err(_) => Err(format!("\"{}\" is not a number", shortened(number))),
            };
            let (message, label) = match quantity {
                Ok(quantity) if section::is_bounded(&quantity, kind) => return Some(quantity),
                Ok(quantity) => (
                    format!("{quantity} is too large; it must be {}", bounds::words(kind)),
                    "too large",
                ),
                Err(message) => (message, "a number is expected"),
            };
            let problem = Problem::new(message).at(&place(at, cell)).label(label);
            problems.push(problem.help("write a finite number; the units stand in the first line"));
            None
        };
        let mut values = Vec::with_capacity(N);
        for (i, cell) in cells.into_iter().enumerate() {
            values.push(read(cell, units[i], form.kinds[i])?);
        }
        let values = values.try_into().ok()?;
        rows.push(Row {
            values,
            place: place(at, line),
        });
    }
    Some(rows)
}

/// Returns the cells of a line and where they begin.
fn cells(line: &str, at: usize) -> impl Iterator<Item = (usize, &str)> {
    let mut start = at;
    line.split(',').map(move |cell| {
        let here = start;
        start += cell.len() + 1;
        (here, cell)
    })
}

/// Checks that there are enough rows and that they are in order.
fn check<const N: usize>(
    rows: &[Row<N>],
    place: &TomlLocation,
    path: &str,
    form: &TableForm<N>,
    problems: &mut Problems,
) -> Option<()> {
    let (first, second) = (form.names[0], form.names[1]);
    if let Some(row) = rows.get(limits::TABLE_ROWS) {
        let message = format!(
            "`{path}` has {} rows; at most {} are read",
            rows.len(),
            limits::TABLE_ROWS
        );
        let problem = Problem::new(message).at(&row.place).label("one row too many");
        problems.push(problem.help("leave out rows: values between them are interpolated"));
        return None;
    }
    if rows.len() < form.least {
        let message = format!(
            "`{path}` has {} rows; at least {} are expected",
            rows.len(),
            form.least
        );
        let place = rows.first().map_or(place, |row| &row.place);
        problems.push(
            Problem::new(message)
                .at(place)
                .label("too short")
                .help("add rows to the table"),
        );
        return None;
    }
    if !form.ordered {
        return Some(());
    }
    let text = |row: &Row<N>, column: usize| row.values[column].to_string();
    for pair in rows.windows(2) {
        let [a, b] = pair else { continue };
        if b.values[0].to_si() <= a.values[0].to_si() {
            let (before, after) = (text(a, 0), text(b, 0));
            let message = format!("`{path}`: the {first} {after} does not come after {before}");
            let problem = Problem::new(message).at(&b.place).label("out of order");
            problems.push(problem.help(format!("sort the rows so that the {first} always increases")));
            return None;
        }
        if !form.may_fall && b.values[1].to_si() < a.values[1].to_si() {
            let (before, after) = (text(a, 1), text(b, 1));
            let message = format!("`{path}`: the {second} falls from {before} to {after}");
            let problem = Problem::new(message).at(&b.place).label("a negative stiffness");
            problems.push(problem.help(format!("the {second} must not fall while the {first} grows")));
            return None;
        }
    }
    if let (false, Some(a), Some(b)) = (form.may_fall, rows.first(), rows.last())
        && b.values[1].to_si() <= a.values[1].to_si()
    {
        let problem = Problem::new(format!("`{path}`: the {second} never rises")).at(&b.place);
        problems.push(
            problem
                .label("zero stiffness")
                .help(format!("the {second} must grow with the {first}")),
        );
        return None;
    }
    Some(())
}
