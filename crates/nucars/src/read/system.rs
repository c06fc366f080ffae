//! Reading `.SYS` files.

use std::sync::Arc;

use quantity::nearest;

use super::fields::{Fields, Stop, Wrap, begins_named, begins_numbered, short};
use super::law::{characteristic, forms, piecewise_linear};
use super::sections::{self, FileSection};
use super::{FileKind, Read};
use crate::finding::{Finding, Findings, Severity};
use crate::lexer::TokenKind;
use crate::number;
use crate::source::{At, SourceText, Spanned};
use crate::tree::{
    Body, Connection, DirectionGroup, DirectionPair, Dof, Element, InputBody, Single, SystemFile, Triple,
};

pub const KEYWORDS: &[&str] = &[
    "SYSTEM TITLE",
    "BODY DATA",
    "INPUT BODY DATA",
    "CONNECTION DATA",
    "CHARACTERISTIC DATA",
    "PWL DATA",
];

/// The types of connections as typed.
const TYPES: [&str; 9] = ["1", "1.1", "1.2", "1.3", "6.3", "6.5", "6.7", "6.8", "6.9"];

/// Reads a system file.
pub fn read_system(source: &Arc<SourceText>) -> Read<SystemFile> {
    let mut findings = Findings::new(source);
    let sections = sections::split(source);
    sections::look_for_hidden(source, &sections, FileKind::System, &mut findings);
    let title = sections::title(&sections, "SYSTEM TITLE", source, &mut findings);
    let mut tree = SystemFile {
        title,
        other: sections::others(&sections, KEYWORDS, source, FileKind::System, &mut findings),
        ..SystemFile::default()
    };
    let text = source.text();
    let named = |keyword: &str, findings: &mut Findings| {
        let section = sections::required(&sections, keyword, FileKind::System, findings);
        section.map(|section| section.cursor(source))
    };
    let bodies = named("BODY DATA", &mut findings);
    let connections = named("CONNECTION DATA", &mut findings);
    let characteristics = named("CHARACTERISTIC DATA", &mut findings);
    let functions = named("PWL DATA", &mut findings);
    let inputs = sections::only(&sections, "INPUT BODY DATA", &mut findings)
        .map(|found: &FileSection| found.cursor(source));

    let lost = &mut tree.lost;
    lost.bodies = bodies.is_none();
    lost.connections = connections.is_none();
    lost.characteristics = characteristics.is_none();
    lost.piecewise_linear = functions.is_none();
    if let Some(cursor) = bodies {
        let fields = Fields::new(cursor, text, Wrap::NamedRecords, &mut findings);
        (tree.bodies, lost.bodies) = counted(fields, "body", "bodies", body);
    }
    if let Some(cursor) = inputs {
        let fields = Fields::new(cursor, text, Wrap::NamedRecords, &mut findings);
        let (list, any_lost) = counted(fields, "input body", "input bodies", input_body);
        tree.input_bodies = list;
        lost.bodies |= any_lost;
    }
    if let Some(cursor) = connections {
        let fields = Fields::new(cursor, text, Wrap::NamedRecords, &mut findings);
        (tree.connections, lost.connections) = counted(fields, "connection", "connections", connection);
    }
    if let Some(cursor) = characteristics {
        let forms = forms(&tree.connections);
        let fields = Fields::new(cursor, text, Wrap::Counted, &mut findings);
        (tree.characteristics, tree.lost.characteristics) =
            open_list(fields, |fields| characteristic(fields, &forms));
    }
    if let Some(cursor) = functions {
        let fields = Fields::new(cursor, text, Wrap::Counted, &mut findings);
        (tree.piecewise_linear, tree.lost.piecewise_linear) = open_list(fields, piecewise_linear);
    }
    Read {
        tree,
        source: Arc::clone(source),
        findings: findings.sorted(),
    }
}

/// Returns a count and so many records that begin with a number and a name; whether one was lost.
fn counted<T>(
    mut fields: Fields<'_, '_>,
    one: &'static str,
    several: &'static str,
    record: impl Fn(&mut Fields<'_, '_>) -> Result<T, Stop>,
) -> (Vec<T>, bool) {
    fields.begin(several, 0, 1);
    let Ok(count) = fields.whole(&format!("number of {several}")) else {
        return (Vec::new(), true);
    };
    let count_is_bad = fields.is_bad();
    fields.end_of_record(Severity::Warning, "the rest of the line is not read");
    let mut list = Vec::new();
    let mut lost = false;
    let mut seen: u32 = 0;
    while count_is_bad || seen < *count {
        let next = fields.cursor.peek();
        if next.is_none_or(|token| !begins_like_a_record(&fields, token.span.start)) {
            break;
        }
        seen += 1;
        fields.begin(one, seen, 1);
        match record(&mut fields) {
            Ok(value) => {
                list.push(value);
                fields.end_of_record(
                    Severity::Warning,
                    "the rest of the line is not read: correct the counts in the record",
                );
            }
            Err(Stop) => {
                lost = true;
                fields.recover(|cursor, text| begins_named(cursor, text));
            }
        }
    }
    if count_is_bad {
        return (list, true);
    }
    if seen < *count {
        lost = true;
        let place = fields
            .cursor
            .peek()
            .map_or(fields.cursor.here(), |token| token.span);
        let line = fields.cursor_line(place.start);
        let dress = |finding: Finding| {
            finding.label("says how many").help(format!(
                "write {seen} if the list is complete; it ends before line {line}"
            ))
        };
        let message = format!("the count is {}, but {seen} {several} follow", *count);
        fields
            .findings
            .add(Severity::Error, "count", count.span, message, dress);
    } else {
        let mut extra = 0_usize;
        let mut first = None;
        let mut ahead = fields.cursor;
        while let Some(token) = ahead.peek() {
            if begins_named(&mut ahead.clone(), fields.text()) {
                extra += 1;
                first.get_or_insert(token.span);
            }
            ahead.skip_past_line();
        }
        if let Some(first) = first {
            lost = true;
            let line = fields.cursor_line(first.start);
            let dress = |finding: Finding| {
                finding.label("says how many").help(format!(
                    "write {} to read them all, or put a `!` before each from line {line} on",
                    seen as usize + extra
                ))
            };
            let message = format!(
                "the count is {}, but {extra} more {several} follow, which are not read",
                *count
            );
            fields
                .findings
                .add(Severity::Error, "count", count.span, message, dress);
        }
    }
    (list, lost)
}

/// Returns whether what begins here is meant to be a record: a number, or a text in quotation marks.
fn begins_like_a_record(fields: &Fields<'_, '_>, at: u32) -> bool {
    let rest = fields.text().get(at as usize..).unwrap_or("");
    rest.starts_with(|letter: char| letter.is_ascii_digit() || letter == '\'')
}

/// Records until a line does not begin with a number; whether one was lost.
fn open_list<T>(
    mut fields: Fields<'_, '_>,
    record: impl Fn(&mut Fields<'_, '_>) -> Result<T, Stop>,
) -> (Vec<T>, bool) {
    let mut list = Vec::new();
    let mut lost = false;
    while let Some(token) = fields.cursor.peek() {
        if token.kind != TokenKind::Word || number::real(fields.text_of(token)).is_none() {
            lost |= remark_after(&mut fields, list.is_empty());
            break;
        }
        match record(&mut fields) {
            Ok(value) => list.push(value),
            Err(Stop) => {
                lost = true;
                fields.recover(|cursor, text| begins_numbered(cursor, text, 4));
            }
        }
    }
    (list, lost)
}

/// The section ends at the first line that does not begin with a number. If records follow, that line was
/// probably meant to be one, or a comment.
fn remark_after(fields: &mut Fields<'_, '_>, nothing_read: bool) -> bool {
    let Some(token) = fields.cursor.peek() else {
        return false;
    };
    let mut ahead = fields.cursor;
    let mut records = 0_usize;
    while ahead.peek().is_some() && records < 1000 {
        ahead.skip_past_line();
        if begins_numbered(&mut ahead.clone(), fields.text(), 4) {
            records += 1;
        }
    }
    if records == 0 && !nothing_read {
        return false;
    }
    let message = format!(
        "the section ends at `{}`, which is no number; {}",
        short(fields.text_of(token)),
        if records > 0 {
            "what follows is not read"
        } else {
            "nothing was read"
        }
    );
    fields
        .findings
        .add(Severity::Error, "section-ends", token.span, message, |finding| {
            finding
                .label("expected the number of a record")
                .help("put a `!` before a line of text, or correct the number")
        });
    true
}

fn dofs(fields: &mut Fields<'_, '_>, count: Spanned<u32>) -> Result<Vec<Spanned<Dof>>, Stop> {
    (0..*count).map(|_| fields.dof("degree of freedom")).collect()
}

fn body(fields: &mut Fields<'_, '_>) -> Result<Body, Stop> {
    let id = fields.key("number")?;
    fields.identify(*id);
    let name = fields.quoted("name")?;
    let position = fields.position()?;
    let count = fields.key("number of degrees of freedom")?;
    let dofs = dofs(fields, count)?;
    let mass = fields.number("mass (lb·s²/in)")?;
    let inertia = [
        fields.number("roll inertia (lb·in·s²)")?,
        fields.number("pitch inertia (lb·in·s²)")?,
        fields.number("yaw inertia (lb·in·s²)")?,
    ];
    Ok(Body {
        id,
        name,
        position,
        dofs,
        mass,
        inertia,
        span: At(fields.span()),
    })
}

fn input_body(fields: &mut Fields<'_, '_>) -> Result<InputBody, Stop> {
    let id = fields.key("number")?;
    fields.identify(*id);
    let name = fields.quoted("name")?;
    let position = fields.position()?;
    let count = fields.key("number of degrees of freedom")?;
    let dofs = dofs(fields, count)?;
    let histories = (0..*count).map(|_| fields.whole("input history"));
    let histories = histories.collect::<Result<_, _>>()?;
    let lag = fields.logical("lag")?;
    Ok(InputBody {
        id,
        name,
        position,
        dofs,
        histories,
        lag,
        span: At(fields.span()),
    })
}

fn connection(fields: &mut Fields<'_, '_>) -> Result<Connection, Stop> {
    let id = fields.key("number")?;
    fields.identify(*id);
    let name = fields.quoted("name")?;
    let kind = fields.word("type", "a type of connection that is known", "", |text| {
        let bare = if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            text
        };
        TYPES.into_iter().find(|kind| *kind == bare)
    })?;
    if kind.is_empty() {
        let near = nearest(fields.slice(kind.span), TYPES).unwrap_or("1.1");
        fields.findings.help_last(format!(
            "the types are {}; did you mean {near}?",
            TYPES.join(", ")
        ));
        return Err(Stop);
    }
    let body_a = fields.whole("body A")?;
    let body_b = fields.whole("body B")?;
    let position = fields.position()?;
    let element = element(fields, kind.value)?;
    Ok(Connection {
        id,
        name,
        kind: At(kind.span),
        body_a,
        body_b,
        position,
        element,
        span: At(fields.span()),
    })
}

fn element(fields: &mut Fields<'_, '_>, kind: &str) -> Result<Element, Stop> {
    fn single(fields: &mut Fields<'_, '_>) -> Result<Single, Stop> {
        Ok(Single {
            dof: fields.dof("direction")?,
            characteristic: fields.whole("characteristic")?,
        })
    }
    fn group(fields: &mut Fields<'_, '_>) -> Result<DirectionGroup, Stop> {
        let count = fields.key("number of directions")?;
        let dofs = (0..*count)
            .map(|_| fields.dof("direction"))
            .collect::<Result<_, _>>()?;
        let characteristics = (0..*count).map(|_| fields.whole("characteristic of a direction"));
        Ok(DirectionGroup {
            dofs,
            characteristics: characteristics.collect::<Result<_, _>>()?,
        })
    }
    fn pair(fields: &mut Fields<'_, '_>) -> Result<DirectionPair, Stop> {
        Ok(DirectionPair {
            dofs: [
                fields.dof("vertical direction")?,
                fields.dof("lateral direction")?,
            ],
            characteristic: fields.whole("characteristic")?,
        })
    }
    fn triple(fields: &mut Fields<'_, '_>) -> Result<Triple, Stop> {
        Ok(Triple {
            dofs: [
                fields.dof("first direction")?,
                fields.dof("second direction")?,
                fields.dof("third direction")?,
            ],
            characteristic: fields.whole("characteristic")?,
        })
    }
    Ok(match kind {
        "1" => Element::Parallel(single(fields)?),
        "1.1" => Element::ParallelGroup(group(fields)?),
        "1.2" => Element::Gap(single(fields)?),
        "1.3" => Element::CoilGroup(group(fields)?),
        "6.3" => Element::ViscousWedge(pair(fields)?),
        "6.5" => Element::SurfaceFriction(triple(fields)?),
        "6.7" => Element::ViscousToeWedge(pair(fields)?),
        "6.8" => Element::StickSlipWedge(pair(fields)?),
        _ => Element::StickSlipWedge3d(triple(fields)?),
    })
}
