//! Writing trees as files. Reading what was written gives an equal tree; comments and free text outside the
//! titles' sections are not written.

mod system;

use std::fmt::{Display, Write};

use crate::source::Spanned;
use crate::tree::{
    Argument, DataFile, DataRequest, DataSection, InputFile, PiecewiseLinear, RawSection, RunFile,
    SystemFile, Terms, Title,
};

/// Returns a system file's text.
pub fn write_system(file: &SystemFile) -> String {
    system::write(file)
}

/// Returns a record of `\\PWL DATA` in lines of at most seven values, as texts that other programs write have
/// it; reading it gives an equal function.
pub fn write_function(function: &PiecewiseLinear) -> String {
    let mut out = Out::default();
    let (id, count) = (&function.id, function.ordinates.len());
    let lists = [&function.ordinates, &function.abscissae];
    for (number, list) in lists.into_iter().enumerate() {
        for (line, values) in list.chunks(7).enumerate() {
            let head = match (number, line) {
                (0, 0) => format!(" {id} {count} "),
                _ => "   ".to_owned(),
            };
            out.text(&format!("{head}{}", reals(values)));
        }
    }
    out.0
}

/// Returns an input file's text.
pub fn write_input(file: &InputFile) -> String {
    let mut out = Out::default();
    out.title("INPUT TITLE", &file.title);
    out.keyword("INPUT HISTORY DATA");
    out.line(&[&file.histories.len()]);
    for history in &file.histories {
        let argument = match *history.argument {
            Argument::Time => 1,
            Argument::Distance => 2,
        };
        out.line(&[&history.number, &history.segments.len(), &argument]);
        for segment in &history.segments {
            let mut line = format!(" {} {}", segment.number, segment.shape.code());
            let values = [segment.end, segment.base[0], segment.base[1]];
            let rest = [
                segment.coefficients[0],
                segment.coefficients[1],
                segment.amplitude,
            ];
            for value in values.into_iter().chain(rest) {
                line.push(' ');
                line.push_str(&real(*value));
            }
            out.text(&line);
        }
    }
    out.others(&file.other);
    out.0
}

/// Returns a run file's text.
pub fn write_run(file: &RunFile) -> String {
    let mut out = Out::default();
    out.title("RUN TITLE", &file.title);
    let files = [
        ("SYSTEM FILE", &file.system),
        ("DATA FILE", &file.data),
        ("INPUT FILE", &file.input),
    ];
    for (keyword, name) in files {
        if let Some(name) = name {
            out.keyword(keyword);
            out.text(&quoted(name));
        }
    }
    if let Some(control) = &file.control {
        out.keyword("CONTROL CONSTANTS");
        out.line(&[&control.analysis, &control.option, &logical(*control.flag)]);
    }
    if let Some(stepping) = &file.stepping {
        out.keyword("STEPPING CONSTANTS");
        out.line(&[
            &real(*stepping.step),
            &real(*stepping.end),
            &real(*stepping.output),
        ]);
    }
    out.others(&file.other);
    out.0
}

/// Returns a data file's text.
pub fn write_data(file: &DataFile) -> String {
    let mut out = Out::default();
    for section in &file.sections {
        data_section(&mut out, section);
    }
    out.others(&file.other);
    out.0
}

fn data_section(out: &mut Out, section: &DataSection) {
    let off = if section.off { "$" } else { "" };
    out.text(&format!("{off}\\{}", section.request.keyword()));
    let count = match &section.request {
        DataRequest::Dofs { count, .. }
        | DataRequest::Components { count, .. }
        | DataRequest::Sums { count, .. } => *count,
        DataRequest::Equilibrium | DataRequest::Track { .. } => None,
    };
    if let Some(count) = count {
        out.line(&[&count]);
    }
    match &section.request {
        DataRequest::Equilibrium => {}
        DataRequest::Dofs { bodies, .. } => {
            for body in bodies {
                out.text(&format!(" {} {}{}", body.body, body.dofs.len(), list(&body.dofs)));
            }
        }
        DataRequest::Components { components, .. } => {
            for components in components.chunks(8) {
                out.text(&list(components));
            }
        }
        DataRequest::Sums { sums, .. } => {
            for sum in sums {
                let count = sum.coefficients.len();
                out.text(&format!("{} {} {count}", quoted(&sum.name), sum.terms.kind()));
                match &sum.terms {
                    Terms::Components(components) => out.text(&list(components)),
                    Terms::Sums(sums) => out.text(&list(sums)),
                }
                out.text(&reals(&sum.coefficients));
            }
        }
        DataRequest::Track { values, .. } => {
            for value in values {
                out.line(&[value]);
            }
        }
    }
}

/// A text in the making.
#[derive(Debug, Default)]
struct Out(String);

impl Out {
    fn text(&mut self, line: &str) {
        self.0.push_str(line);
        self.0.push('\n');
    }

    /// Values with blanks before them.
    fn line(&mut self, values: &[&dyn Display]) {
        for value in values {
            // Writing into a text cannot fail.
            let _ = write!(self.0, " {value}");
        }
        self.0.push('\n');
    }

    fn keyword(&mut self, keyword: &str) {
        self.text(&format!("\\{keyword}"));
    }

    fn title(&mut self, keyword: &str, title: &Title) {
        self.keyword(keyword);
        if !title.text.is_empty() {
            // A blank keeps a `\` at the beginning from being a keyword's.
            self.text(&format!(" {}", title.text.value));
            for note in &title.notes {
                self.text(note);
            }
        }
    }

    fn others(&mut self, sections: &[RawSection]) {
        for section in sections {
            let off = if section.off { "$" } else { "" };
            self.text(&format!("{off}\\{}", section.keyword));
            for line in &section.lines {
                self.text(line);
            }
        }
    }
}

fn list<T: Display>(values: &[Spanned<T>]) -> String {
    values.iter().map(|value| format!(" {value}")).collect()
}

fn reals(values: &[Spanned<f64>]) -> String {
    values
        .iter()
        .map(|value| format!(" {}", real(value.value)))
        .collect()
}

/// Returns a number that reads as the same bits, as short as can be, with a point.
fn real(value: f64) -> String {
    let text = format!("{value:?}");
    match text.split_once('e') {
        Some((digits, exponent)) if !digits.contains('.') => format!("{digits}.0E{exponent}"),
        Some((digits, exponent)) => format!("{digits}E{exponent}"),
        None => text,
    }
}

fn logical(value: bool) -> &'static str {
    if value { ".T." } else { ".F." }
}

fn quoted(text: &str) -> String {
    format!("'{}'", text.replace('\'', "''"))
}
