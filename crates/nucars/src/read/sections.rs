//! Cutting a file at its keywords.

use quantity::nearest;

use super::FileKind;
use crate::finding::{Findings, Severity};
use crate::lexer::Cursor;
use crate::source::{SourceText, Span, Spanned};
use crate::tree::{RawSection, Title};

/// A section: from after its keyword to the next one.
#[derive(Clone, Debug)]
pub struct FileSection {
    /// In capitals, words separated by one blank, without `\`.
    pub keyword: Spanned<String>,
    /// `$\` instead of `\`.
    pub off: bool,
    pub body: Span,
}

impl FileSection {
    pub fn is(&self, keyword: &str) -> bool {
        self.keyword.value == keyword
    }

    pub fn cursor<'a>(&self, source: &'a SourceText) -> Cursor<'a> {
        Cursor::new(source.text(), self.body.start as usize, self.body.end as usize)
    }
}

/// The most sections a file is cut into; what follows belongs to the last one.
const MOST: usize = 10_000;

/// Cuts a file at lines that begin with `\` in the first column, or with `$\` (switched off) in any.
pub fn split(source: &SourceText) -> Vec<FileSection> {
    let text = source.text();
    let bytes = text.as_bytes();
    let mut sections: Vec<FileSection> = Vec::new();
    let mut line = 0;
    while line < bytes.len() && sections.len() < MOST {
        let rest = &bytes[line..];
        let indent = rest
            .iter()
            .take_while(|byte| matches!(byte, b' ' | b'\t'))
            .count();
        let off = rest[indent..].starts_with(b"$\\");
        let length = rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
        if rest[0] == b'\\' || off {
            if let Some(last) = sections.last_mut() {
                last.body.end = Span::new(0, line).end;
            }
            let start = if off { line + indent + 1 } else { line };
            let (keyword, body) = keyword(text, start, line + length);
            sections.push(FileSection {
                keyword,
                off,
                body: Span::new(body, text.len()),
            });
        }
        line += length + 1;
    }
    sections
}

/// Returns the keyword whose `\` is at `start`, and where its section begins: at a value in its line, or with
/// the next line.
fn keyword(text: &str, start: usize, end: usize) -> (Spanned<String>, usize) {
    let line = &text[start + 1..end];
    let values = |(_, letter): &(usize, char)| matches!(letter, '\'' | '"' | '0'..='9' | '+' | '.' | '!');
    let stop = line.char_indices().find(values);
    let words = &line[..stop.map_or(line.len(), |(at, _)| at)];
    let words = words.trim_end_matches(|letter: char| letter.is_whitespace() || "-=:".contains(letter));
    let words: Vec<String> = words.split_whitespace().map(str::to_uppercase).collect();
    let shown = text[start..end].trim_end().len().min(60);
    let mut shown_end = start + shown;
    while !text.is_char_boundary(shown_end) {
        shown_end -= 1;
    }
    let body = match stop {
        Some((at, letter)) if letter != '!' => start + 1 + at,
        _ => (end + 1).min(text.len()),
    };
    (Spanned::new(words.join(" "), Span::new(start, shown_end)), body)
}

/// Returns the first section with this keyword that is not switched off; others with it are mistakes.
pub fn only<'a>(
    sections: &'a [FileSection],
    keyword: &str,
    findings: &mut Findings,
) -> Option<&'a FileSection> {
    let mut found = sections
        .iter()
        .filter(|section| !section.off && section.is(keyword));
    let first = found.next();
    for again in found {
        findings.error(
            "repeated-section",
            again.keyword.span,
            format!("`\\{keyword}` stands here a second time"),
            "only the first one is read: join the two, or switch one off by `$` before the `\\`",
        );
    }
    first
}

/// Returns the first section with this keyword, which the file must have.
pub fn required<'a>(
    sections: &'a [FileSection],
    keyword: &str,
    kind: FileKind,
    findings: &mut Findings,
) -> Option<&'a FileSection> {
    let found = only(sections, keyword, findings);
    // A file without any keyword has one mistake, not one for each.
    if found.is_none() && !sections.is_empty() {
        let off = sections.iter().find(|section| section.is(keyword));
        // What is missing stands nowhere: the end of the file is where it would go on.
        let end = sections.last().map_or(0, |last| last.body.end as usize);
        let place = off.map_or(Span::new(end, end), |off| off.keyword.span);
        let help = match off {
            Some(_) => "take away the `$` before the `\\`".to_owned(),
            None => format!(
                "a line `\\{keyword}`, with the `\\` in the first column, begins it; if the file had it, it \
                 was cut off here"
            ),
        };
        findings.error(
            "missing-section",
            place,
            format!("this {kind} has no section `\\{keyword}`"),
            help,
        );
    }
    found
}

/// Sections that are none of `known`: switched off ones are noted, unknown ones are warned of.
pub fn others(
    sections: &[FileSection],
    known: &[&str],
    source: &SourceText,
    kind: FileKind,
    findings: &mut Findings,
) -> Vec<RawSection> {
    let mut kept = Vec::new();
    for section in sections {
        let is_known = known.contains(&section.keyword.as_str());
        if is_known && !section.off {
            continue;
        }
        let keyword = section.keyword.as_str();
        if section.off {
            findings.note(
                "switched-off",
                section.keyword.span,
                format!("the section `\\{keyword}` is switched off by the `$` before it"),
                "a keyword counts only with its `\\` in the first column; take the `$` away to switch it on",
            );
        } else {
            let others = FileKind::ALL.into_iter().filter(|other| *other != kind);
            let home = others
                .into_iter()
                .find(|other| other.keywords().contains(&keyword));
            let help = match (home, nearest(keyword, known.iter().copied())) {
                (Some(home), _) => format!("it belongs into a {home}"),
                (None, Some(near)) => format!("did you mean `\\{near}`?"),
                (None, None) => format!("the sections of a {kind} are `\\{}`", known.join("`, `\\")),
            };
            findings.warning(
                "unknown-section",
                section.keyword.span,
                format!("the section `\\{keyword}` is not known in a {kind}; it is not read"),
                help,
            );
        }
        let cursor = section.cursor(source);
        let start = cursor.position();
        let lines = lines(source, Span::new(start, start + cursor.remaining()));
        kept.push(RawSection {
            keyword: section.keyword.clone(),
            off: section.off,
            lines,
        });
    }
    kept
}

/// Warns of lines that look like keywords but have blanks before the `\`, and of files without any keyword.
pub fn look_for_hidden(
    source: &SourceText,
    sections: &[FileSection],
    kind: FileKind,
    findings: &mut Findings,
) {
    if source.is_latin1() {
        findings.note(
            "encoding",
            Span::default(),
            "the file is not UTF-8; it is read as Latin-1".to_owned(),
            "only names and free text can look different",
        );
    }
    if sections.is_empty() {
        findings.error(
            "no-sections",
            Span::default(),
            match source.text().trim() {
                "" => "the file is empty".to_owned(),
                _ => "there is no keyword in the file".to_owned(),
            },
            format!(
                "a {kind} has lines such as `\\{}`, with the `\\` in the first column",
                kind.keywords()[0]
            ),
        );
    }
    for (at, _) in source.text().match_indices('\\') {
        let bytes = source.text().as_bytes();
        let blank = bytes[..at]
            .iter()
            .rev()
            .take_while(|byte| matches!(byte, b' ' | b'\t'))
            .count();
        let line = at - blank;
        let begins = line == 0 || bytes[line - 1] == b'\n';
        if blank > 0 && begins && !findings.is_full_of(Severity::Warning) {
            findings.warning(
                "hidden-keyword",
                Span::new(at, at + 1),
                "a `\\` that is not in the first column begins no section".to_owned(),
                "take away the blanks before it, or put a `!` there if it is meant to be switched off",
            );
        }
    }
}

/// Returns the lines of a piece without comments and blank ones.
pub fn lines(source: &SourceText, span: Span) -> Vec<Spanned<String>> {
    let mut at = span.start as usize;
    let mut found = Vec::new();
    for line in source.slice(span).split_inclusive('\n') {
        let text = line.trim_end();
        let begins = text.trim_start();
        if !begins.is_empty() && !begins.starts_with('!') {
            found.push(Spanned::new(text.to_owned(), Span::new(at, at + text.len())));
        }
        at += line.len();
    }
    found
}

/// Returns the title section: its first line is the title, the others are notes.
pub fn title(sections: &[FileSection], keyword: &str, source: &SourceText, findings: &mut Findings) -> Title {
    let Some(section) = only(sections, keyword, findings) else {
        if sections.is_empty() {
            return Title::default();
        }
        let place = sections
            .first()
            .map_or(Span::default(), |first| first.keyword.span);
        findings.warning(
            "missing-title",
            place,
            format!("the file has no section `\\{keyword}`"),
            "results are told apart by their titles",
        );
        return Title::default();
    };
    let mut lines = lines(source, section.body).into_iter();
    let Some(first) = lines.next() else {
        findings.warning(
            "missing-title",
            section.keyword.span,
            format!("there is no title below `\\{keyword}`"),
            "results are told apart by their titles",
        );
        return Title::default();
    };
    let blanks = first.value.len() - first.value.trim_start().len();
    let span = Span::new(first.span.start as usize + blanks, first.span.end as usize);
    Title {
        text: Spanned::new(first.value.trim_start().to_owned(), span),
        notes: lines.collect(),
    }
}
