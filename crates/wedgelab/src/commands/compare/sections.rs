//! `wedgelab compare --sections`: statistics of a model against measurements.

use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

use report::comparison::ComparedResult;
use report::comparison::section_files::{SECTIONS, STATISTICS};
use report::comparison::sections::SectionComparison;
use report::terminal::TerminalTable;
use serde_json::{Value, json};
use study::sections::{Acceptance, FEWEST, SectionRequest};

use super::{Arguments, number};
use crate::failure::{Failure, say};
use crate::folders;
use crate::json;

/// Executes the command.
pub fn execute(
    arguments: &Arguments,
    request: &str,
    entries: &[ComparedResult],
) -> Result<ExitCode, Failure> {
    let request = SectionRequest::parse(request)?;
    let acceptance = arguments.accept.as_deref().map(Acceptance::read).transpose()?;
    let found = SectionComparison::of(entries, &arguments.columns, &request, acceptance.as_ref())?;
    let figures = found.figures(entries);
    let mut names: Vec<&str> = vec![STATISTICS, SECTIONS];
    names.extend(figures.iter().map(|(name, _)| name.as_str()));
    let folder = folders::check(&arguments.out, &names, arguments.force)?;
    folder.write(|files| {
        files.add(STATISTICS, |out| found.write_statistics(entries, out))?;
        files.add(SECTIONS, |out| found.write_sections(entries, out))?;
        for (name, figure) in &figures {
            files.add(name, |out| out.write_all(figure.to_svg().as_bytes()))?;
        }
        Ok(())
    })?;
    for warning in &found.warnings {
        say(&format!("warning: {warning}"));
    }
    if arguments.json {
        json::print(&document(&found, entries, folder.path(), &names))?;
        return Ok(ExitCode::SUCCESS);
    }
    print(&found, entries, acceptance.as_ref(), (folder.path(), &names))?;
    Ok(ExitCode::SUCCESS)
}

fn print(
    found: &SectionComparison,
    entries: &[ComparedResult],
    acceptance: Option<&Acceptance>,
    (folder, names): (&Path, &[&str]),
) -> io::Result<()> {
    let mut out = io::stdout().lock();
    let first = &entries[0].label;
    let count = found.sections.len();
    let ends = [found.sections[0][0], found.sections[count - 1][1]];
    let [from, to] = ends.map(|end| found.along.words(end, found.units));
    writeln!(
        out,
        "Differences from {first} in {count} sections over {}, from {from} to {to}.\n",
        found.along.column()
    )?;
    table(found, entries, acceptance.is_some()).write(&mut out)?;
    writeln!(
        out,
        "\nMean and deviation: mean and standard deviation over the sections of result less {first}, and in \
         % of the\nmean size of {first}. Quantities of each section: mean; max, the larger of the 0.15 % and \
         99.85 % percentiles\nin size; rms about the mean. Signals are not filtered."
    )?;
    if let Some(acceptance) = acceptance {
        writeln!(
            out,
            "Accepted: deviation within its limit and mean within two thirds of it (rule from memory of EN \
             14363:2016).\nLimits: {}.",
            acceptance.source
        )?;
    }
    for note in &found.notes {
        writeln!(out, "{note}")?;
    }
    writeln!(out, "\nWritten into {}: {}.", folder.display(), names.join(", "))
}

fn table(found: &SectionComparison, entries: &[ComparedResult], accepted: bool) -> TerminalTable {
    let mut head = vec![
        ("column", ""),
        ("unit", ""),
        ("result", ""),
        ("quantity", ""),
        ("sections", ""),
        ("size of", entries[0].label.as_str()),
        ("mean", ""),
        ("mean", "%"),
        ("deviation", ""),
        ("deviation", "%"),
    ];
    if accepted {
        head.extend([("limit", ""), ("verdict", "")]);
    }
    let mut table = TerminalTable::new(4, &head);
    for own in &found.rows {
        let differences = &own.differences;
        let percent = |place: usize| match differences.percent() {
            // The measured values hardly differ from zero: the percentage says nothing else.
            Some(parts) if parts[place].abs() > 1e4 => "> 10000".to_owned(),
            // Without the sign of a zero.
            Some(parts) if parts[place].abs() < 0.05 => "0.0".to_owned(),
            Some(parts) => format!("{:.1}", parts[place]),
            None => "-".to_owned(),
        };
        let few = if differences.sections < FEWEST {
            format!(" (< {FEWEST})")
        } else {
            String::new()
        };
        let mut cells = vec![
            own.column.clone(),
            own.unit.to_owned(),
            entries[own.result].label.clone(),
            own.quantity.name().to_owned(),
            format!("{}{few}", differences.sections),
            number(differences.measured),
            number(differences.mean),
            percent(0),
            number(differences.deviation),
            percent(1),
        ];
        if accepted {
            let [limit, verdict] = match own.verdict {
                Some((limit, verdict)) => [number(limit), verdict.words().to_owned()],
                None => ["-", "no limit"].map(str::to_owned),
            };
            cells.extend([limit, verdict]);
        }
        table.row(cells);
    }
    table
}

/// Returns the comparison as JSON; what is compared is named by its label.
fn document(found: &SectionComparison, entries: &[ComparedResult], folder: &Path, names: &[&str]) -> Value {
    let kind = found.along.kind();
    let ends = |end: usize| -> Vec<f64> {
        let places = found.sections.iter();
        places.map(|own| own[end] * kind.from_si(found.units)).collect()
    };
    let rows = found.rows.iter().map(|own| {
        let percent = own.differences.percent();
        let values = [0, 1].map(|side| own.values.iter().map(move |own| own[side]).collect::<Vec<f64>>());
        json!({
            "column": own.column,
            "unit": own.unit,
            "result": entries[own.result].label,
            "quantity": own.quantity.name(),
            "sections": own.differences.sections,
            "mean_size_of_first": own.differences.measured,
            "mean": own.differences.mean,
            "mean_percent": percent.map(|own| own[0]),
            "standard_deviation": own.differences.deviation,
            "standard_deviation_percent": percent.map(|own| own[1]),
            "limit": own.verdict.map(|(limit, _)| limit),
            "verdict": own.verdict.map(|(_, own)| own.words()),
            "values_of_first": values[0],
            "values": values[1],
        })
    });
    json!({
        "folder": folder,
        "files": names,
        "first": entries[0].label,
        "along": found.along.column(),
        "fewer_than_12": found.sections.len() < FEWEST,
        "sections": { "unit": kind.label(found.units), "from": ends(0), "to": ends(1) },
        "rows": rows.collect::<Vec<_>>(),
        "notes": found.notes,
        "warnings": found.warnings,
    })
}
