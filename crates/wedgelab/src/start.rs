//! The static table of a run's start in the terminal.

use std::io::{self, Write};

use quantity::{Kind, System as Units};
use report::terminal::TerminalTable;
use study::statics::{COILS, StaticTable};

/// Returns the static table of a run's start.
fn table(table: &StaticTable, units: Units) -> TerminalTable {
    let labels = COILS.map(|(name, kind)| (name, kind.label(units)));
    let mut head = vec![("coils at the start", "")];
    head.extend(labels);
    let mut out = TerminalTable::new(1, &head);
    for row in table.coils() {
        let mut cells = vec![row.name];
        let values = row.values.iter().zip(COILS);
        cells.extend(values.map(|(value, (_, kind))| match value {
            None => "-".to_owned(),
            Some(value) if kind == Kind::Force => format!("{value:.0}"),
            Some(value) => format!("{value:.3}"),
        }));
        out.row(cells);
    }
    out
}

/// Prints the static table of a run's start.
///
/// # Errors
/// It cannot be written.
pub fn print(statics: &StaticTable, units: Units) -> io::Result<()> {
    let mut out = io::stdout().lock();
    if let Some(words) = statics.words() {
        writeln!(out, "{words}\n")?;
    }
    table(statics, units).write(&mut out)?;
    writeln!(
        out,
        "Down from free height; left until the first coil of a group is solid.\n"
    )
}
