//! Reading `.DAT` files.

use std::sync::Arc;

use super::fields::{Fields, Stop, Wrap, short};
use super::sections::{self, FileSection};
use super::{FileKind, Read};
use crate::finding::{Finding, Findings, Severity};
use crate::lexer::TokenKind;
use crate::number;
use crate::source::{At, SourceText, Span, Spanned};
use crate::tree::{
    BodyDofs, Component, DataFile, DataRequest, DataSection, DofQuantity, ElementQuantity, Sum, Terms,
};

pub const KEYWORDS: &[&str] = &[
    "EQUILIBRIUM",
    "CURVATURE",
    "SUPERELEVATION",
    "DOF DISPLACEMENT",
    "DOF VELOCITY",
    "DOF ACCELERATION",
    "DOF FORCE",
    "CONNECTION FORCE",
    "CONNECTION FORCE SUM",
    "CONNECTION STROKE",
    "CONNECTION VELOCITY",
];

/// Reads a data file. Sections that are switched off are read as far as they can be; what is wrong with them
/// is noted only.
pub fn read_data(source: &Arc<SourceText>) -> Read<DataFile> {
    let mut findings = Findings::new(source);
    let all = sections::split(source);
    sections::look_for_hidden(source, &all, FileKind::Data, &mut findings);
    let (known, unknown): (Vec<_>, Vec<_>) = all
        .iter()
        .cloned()
        .partition(|section| KEYWORDS.contains(&section.keyword.as_str()));
    for keyword in KEYWORDS {
        sections::only(&known, keyword, &mut findings);
    }
    let other = sections::others(&unknown, KEYWORDS, source, FileKind::Data, &mut findings);
    let mut list = Vec::new();
    for section in &known {
        let mut of_request = Findings::new(source);
        let request = request(section, source, &mut of_request);
        if section.off {
            let (what, help) = match (of_request.list().first(), of_request.list().len()) {
                (None, _) => (String::new(), "take the `$` away to switch it on".to_owned()),
                (Some(first), count) => (
                    format!("; it could not be read as it is ({count} mistakes)"),
                    format!("the first one: {}", first.message()),
                ),
            };
            findings.note(
                "switched-off",
                section.keyword.span,
                format!(
                    "the section `\\{}` is switched off by the `$` before it{what}",
                    section.keyword
                ),
                help,
            );
        } else {
            findings.join(of_request);
        }
        list.push(DataSection {
            keyword: At(section.keyword.span),
            off: section.off,
            request,
        });
    }
    if list.iter().all(|section| section.off) && !all.is_empty() {
        findings.warning(
            "nothing-asked",
            all.first().map_or(Span::default(), |first| first.keyword.span),
            "the file asks for no results".to_owned(),
            "sections such as `\\CONNECTION FORCE` ask for results",
        );
    }
    Read {
        tree: DataFile {
            sections: list,
            other,
        },
        source: Arc::clone(source),
        findings: findings.sorted(),
    }
}

fn request(section: &FileSection, source: &SourceText, findings: &mut Findings) -> DataRequest {
    let mut fields = Fields::new(section.cursor(source), source.text(), Wrap::Counted, findings);
    let dofs = |fields: Fields<'_, '_>, quantity| {
        let (count, bodies) = dof_section(fields);
        DataRequest::Dofs {
            quantity,
            count,
            bodies,
        }
    };
    let components = |fields: Fields<'_, '_>, quantity| {
        let (count, components) = component_section(fields);
        DataRequest::Components {
            quantity,
            count,
            components,
        }
    };
    match section.keyword.as_str() {
        "DOF DISPLACEMENT" => dofs(fields, DofQuantity::Displacement),
        "DOF VELOCITY" => dofs(fields, DofQuantity::Velocity),
        "DOF ACCELERATION" => dofs(fields, DofQuantity::Acceleration),
        "DOF FORCE" => dofs(fields, DofQuantity::Force),
        "CONNECTION FORCE" => components(fields, ElementQuantity::Force),
        "CONNECTION STROKE" => components(fields, ElementQuantity::Stroke),
        "CONNECTION VELOCITY" => components(fields, ElementQuantity::Velocity),
        "CONNECTION FORCE SUM" => {
            let (count, sums) = sum_section(fields);
            DataRequest::Sums { count, sums }
        }
        "EQUILIBRIUM" => DataRequest::Equilibrium,
        keyword => {
            let mut values = Vec::new();
            fields.begin("track", 0, 1);
            while let Some(token) = fields.cursor.peek() {
                let Some(value) = number::whole(fields.text_of(token)) else {
                    break;
                };
                fields.cursor.next();
                values.push(Spanned::new(value, token.span));
            }
            DataRequest::Track {
                superelevation: keyword == "SUPERELEVATION",
                values,
            }
        }
    }
}

fn count(fields: &mut Fields<'_, '_>, what: &'static str) -> Option<Spanned<u32>> {
    fields.begin(what, 0, 1);
    let count = fields.key("count").ok()?;
    fields.end_of_record(Severity::Warning, "the rest of the line is not read");
    Some(count)
}

fn disagrees(findings: &mut Findings, count: Spanned<u32>, found: usize, what: &str) {
    let dress = |finding: Finding| {
        finding
            .label("says how many")
            .help(format!("write {found} if the list is complete"))
    };
    let message = format!("the count is {}, but {found} {what} are listed", *count);
    findings.add(Severity::Error, "count", count.span, message, dress);
}

/// Returns whether the next line begins with a number.
fn begins_number(fields: &Fields<'_, '_>) -> bool {
    let token = fields.cursor.peek();
    token.is_some_and(|token| token.kind == TokenKind::Word && number::real(fields.text_of(token)).is_some())
}

fn dof_section(mut fields: Fields<'_, '_>) -> (Option<Spanned<u32>>, Vec<BodyDofs>) {
    let mut bodies: Vec<BodyDofs> = Vec::new();
    let Some(count) = count(&mut fields, "list of degrees of freedom") else {
        return (None, bodies);
    };
    let mut lost = false;
    while begins_number(&fields) {
        fields.begin("line", bodies.len() as u32 + 1, 2);
        match body_dofs(&mut fields) {
            Ok(line) => bodies.push(line),
            Err(Stop) => {
                lost = true;
                fields.recover(|cursor, text| {
                    cursor
                        .next()
                        .is_some_and(|token| number::whole(&text[token.span.range()]).is_some())
                });
            }
        }
    }
    let found = bodies.iter().map(|line| line.dofs.len()).sum::<usize>();
    if !lost && found != *count as usize {
        disagrees(fields.findings, count, found, "degrees of freedom");
    }
    text_after(&mut fields);
    (Some(count), bodies)
}

fn body_dofs(fields: &mut Fields<'_, '_>) -> Result<BodyDofs, Stop> {
    let body = fields.key("body")?;
    let count = fields.key("number of degrees of freedom")?;
    fields.expect_more(*count);
    let dofs = (0..*count).map(|_| fields.dof("degree of freedom"));
    let dofs = dofs.collect::<Result<_, _>>()?;
    let help = "correct the number of degrees of freedom, the second in the line";
    if fields.end_of_record(Severity::Error, help) {
        Ok(BodyDofs { body, dofs })
    } else {
        Err(Stop)
    }
}

fn component_section(mut fields: Fields<'_, '_>) -> (Option<Spanned<u32>>, Vec<Spanned<Component>>) {
    let mut components = Vec::new();
    let Some(count) = count(&mut fields, "list of components") else {
        return (None, components);
    };
    while begins_number(&fields) {
        fields.begin("list of components", 0, usize::MAX);
        match component(&mut fields) {
            Ok(component) => components.push(component),
            Err(Stop) => break,
        }
    }
    if components.len() != *count as usize {
        disagrees(fields.findings, count, components.len(), "components");
    }
    text_after(&mut fields);
    (Some(count), components)
}

fn component(fields: &mut Fields<'_, '_>) -> Result<Spanned<Component>, Stop> {
    let none = Component {
        connection: 0,
        position: 0,
    };
    let expected = "a component: connection, `.`, position in its list of directions, such as 127.1";
    fields.word("component", expected, none, number::component)
}

/// A text where the list should go on, if more of the list follows it.
fn text_after(fields: &mut Fields<'_, '_>) {
    let Some(token) = fields.cursor.peek() else { return };
    let mut ahead = fields.cursor;
    let follows = if token.begins_line {
        ahead.skip_past_line();
        ahead
            .peek()
            .is_some_and(|token| number::real(fields.text_of(token)).is_some())
    } else {
        true
    };
    if follows {
        let message = format!("the list ends at `{}`", short(fields.text_of(token)));
        let help = "put a `!` before a line of text, or correct the number";
        fields.findings.error("section-ends", token.span, message, help);
    }
}

fn sum_section(mut fields: Fields<'_, '_>) -> (Option<Spanned<u32>>, Vec<Sum>) {
    let mut sums = Vec::new();
    let Some(count) = count(&mut fields, "sums") else {
        return (None, sums);
    };
    let mut seen = 0;
    while let Some(token) = fields.cursor.peek() {
        if token.kind == TokenKind::Word && seen >= *count {
            break;
        }
        seen += 1;
        fields.begin("sum", seen, 3);
        match sum(&mut fields) {
            Ok(sum) => sums.push(sum),
            Err(Stop) => {
                fields.recover(|cursor, _| cursor.next().is_some_and(|token| token.kind == TokenKind::Quoted))
            }
        }
    }
    if seen < *count {
        disagrees(fields.findings, count, seen as usize, "sums");
    } else if seen > *count {
        let place = sums.get(*count as usize).map_or(count.span, |sum| sum.name.span);
        let message = format!("the count of sums is {}, but {seen} stand here", *count);
        let dress = |finding: Finding| {
            finding
                .label("this and what follows is not read by NUCARS")
                .help(format!("write {seen} below the keyword to read them all"))
        };
        fields
            .findings
            .add(Severity::Warning, "count", place, message, dress);
    }
    (Some(count), sums)
}

fn sum(fields: &mut Fields<'_, '_>) -> Result<Sum, Stop> {
    let name = fields.quoted("name")?;
    let kind = fields.word(
        "kind",
        "1 (sum of connections' forces) or 2 (sum of earlier sums)",
        1,
        |text| number::whole(text).filter(|kind| (1..=2).contains(kind)),
    )?;
    if fields.is_bad() {
        return Err(Stop);
    }
    let count = fields.key("number of terms")?;
    fields.expect_more(count.saturating_mul(2));
    let terms = if *kind == 1 {
        let terms = (0..*count).map(|_| component(fields));
        Terms::Components(terms.collect::<Result<_, _>>()?)
    } else {
        let terms = (0..*count).map(|_| fields.whole("sum to be added"));
        Terms::Sums(terms.collect::<Result<_, _>>()?)
    };
    let coefficients = (0..*count).map(|_| fields.number("coefficient"));
    let coefficients = coefficients.collect::<Result<_, _>>()?;
    let span = fields.span();
    let help =
        "a sum has as many coefficients as terms: correct the number of terms, the second after the name";
    if !fields.end_of_record(Severity::Error, help) {
        return Err(Stop);
    }
    Ok(Sum {
        name,
        terms,
        coefficients,
        span: At(span),
    })
}
