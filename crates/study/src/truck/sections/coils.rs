//! Coils by name: the section `[coils]`, and what the sections of load and control coils take of it.

use quantity::{Kind, Quantity};
use truck::Spring;
use truck::coils::{Coil, CoilKind, catalog};
use truck::nest::Ring;

use crate::case::field::{Reach, Written, quoted};
use crate::case::problem::{Problem, Problems};
use crate::case::section::{CaseSection, Range};
use crate::reader::schema::Form;
use crate::reader::{CaseReader, LENGTH};

const INCH: f64 = 0.0254;
const EXAMPLE: &str = "own = [{ name = \"my coil\", outer = { free_height = \"10.25 in\", solid_height = \
                       \"6.5625 in\", stiffness = \"2234 lbf/in\" } }]";
const RINGS: [(&str, Ring); 2] = [("outer", Ring::Outer), ("inner", Ring::Inner)];

/// A kind of coils as typed.
struct Typed {
    kind: CoilKind,
    toml: String,
}

/// Reads `[coils]`: returns the catalog with the user's own kinds, which come first.
pub(crate) fn coils(r: &mut CaseReader<'_>) -> Vec<CoilKind> {
    let known = catalog();
    let names: Vec<&str> = known.iter().map(|own| own.name.as_str()).collect();
    let about = format!(
        "Coils of your own, beside those of the catalog: {}.\n# [[coils.own]] name, source, and outer, \
         inner = \
         {{ free_height, solid_height, stiffness }}",
        names.join(", ")
    );
    r.section("coils", &about);
    let comment = "kinds of coils; load_springs.kind and control_coil.kind name them";
    let own = r.other(
        "own",
        Form::Other,
        comment,
        Vec::new(),
        list,
        |list: &Vec<Typed>| {
            let lines: Vec<String> = list.iter().map(|own| format!("\n    {},", own.toml)).collect();
            match lines.is_empty() {
                true => Written::toml("[]".to_owned()),
                false => Written::toml(format!("[{}\n]", lines.concat())),
            }
        },
    );
    let mut all: Vec<CoilKind> = own.into_iter().map(|own| own.kind).collect();
    all.extend(known);
    all
}

fn list(section: &CaseSection<'_>, problems: &mut Problems) -> Option<Vec<Typed>> {
    let mut list: Vec<Typed> = Vec::new();
    for own in section.tables("own", problems) {
        own.allow_in(
            &["name", "source", "outer", "inner"],
            &[],
            "a kind of coils",
            problems,
        );
        let (name, node) = own.text("name", problems)?;
        let taken = ["shear", "thesis", "nothing"];
        if name.is_empty() || taken.contains(&name) || list.iter().any(|other| other.kind.name == name) {
            let problem = Problem::new(format!("`coils.own` cannot have a kind named \"{name}\""));
            let help = "give each kind a name of its own, such as that of its drawing";
            problems.push(problem.at(&node.place).label("taken").help(help));
            return None;
        }
        let source = match own.table.get("source") {
            Some(_) => own.text("source", problems)?.0,
            None => "",
        };
        let mut toml = format!("{{ name = {}", quoted(name));
        if !source.is_empty() {
            toml += &format!(", source = {}", quoted(source));
        }
        let mut found = [None, None];
        for ((key, _), found) in RINGS.iter().zip(&mut found) {
            if own.table.get(key).is_some() {
                let (coil, text) = coil(&own.section(key, problems)?, problems)?;
                *found = Some(coil);
                toml += &format!(", {key} = {text}");
            }
        }
        let [outer, inner] = found;
        if outer.is_none() && inner.is_none() {
            let problem = Problem::new(format!(
                "the kind of coils \"{name}\" has neither outer nor inner"
            ));
            let problem = problem.label("no coil").help(format!("write {EXAMPLE}"));
            problems.push(match &own.place {
                Some(place) => problem.at(place),
                None => problem,
            });
            return None;
        }
        list.push(Typed {
            kind: CoilKind {
                name: name.to_owned(),
                outer,
                inner,
                source: source.to_owned(),
            },
            toml: toml + " }",
        });
    }
    Some(list)
}

/// Reads a coil, and its text.
fn coil(own: &CaseSection<'_>, problems: &mut Problems) -> Option<(Coil, String)> {
    const KEYS: [(&str, Kind); 3] = [
        ("free_height", Kind::Length),
        ("solid_height", Kind::Length),
        ("stiffness", Kind::Stiffness),
    ];
    own.allow_in(&KEYS.map(|(key, _)| key), &[], "a coil", problems);
    let read = KEYS.map(|(key, kind)| own.quantity(key, kind, Range::Positive, problems));
    let [Some(free), Some(solid), Some(stiffness)] = &read else {
        return None;
    };
    let coil = Coil {
        free_height: free.to_si(),
        solid_height: solid.to_si(),
        stiffness: stiffness.to_si(),
    };
    if coil.free_height <= coil.solid_height {
        let message = format!(
            "the free height of `{}`, {free}, is not above its solid height, {solid}",
            own.path
        );
        let mut problem = Problem::new(message).label("no travel");
        if let Some(node) = own.table.get("free_height") {
            problem = problem.at(&node.place);
        }
        problems.push(problem.help("free height is that without load; look whether both are exchanged"));
        return None;
    }
    let text = |own: &Quantity| quoted(own.text());
    let toml = format!(
        "{{ free_height = {}, solid_height = {}, stiffness = {} }}",
        text(free),
        text(solid),
        text(stiffness)
    );
    Some((coil, toml))
}

/// Reads which kind of coils the section takes, by its name. None if there is no such kind: that has been
/// noted.
pub(crate) fn kind(
    r: &mut CaseReader<'_>,
    (known, usual): (&[CoilKind], &str),
    comment: &str,
) -> Option<CoilKind> {
    let read = |section: &CaseSection<'_>, problems: &mut Problems| {
        let (text, _) = section.text("kind", problems)?;
        Some(text.to_owned())
    };
    let name = r.other("kind", Form::Text, comment, usual.to_owned(), read, |own| {
        Written::text(own)
    });
    let found = known.iter().find(|own| own.name == name).cloned();
    if found.is_none() {
        let names: Vec<String> = known.iter().map(|own| format!("\"{}\"", own.name)).collect();
        let problem = Problem::new(format!("there are no coils \"{name}\"")).label("not in the catalog");
        let help = format!(
            "write one of {}, or describe it in [coils]: {EXAMPLE}",
            names.join(", ")
        );
        r.problem_at(&r.path("kind"), problem.help(help));
    }
    found
}

/// Reads the numbers of outer and of inner coils.
pub(crate) fn counts(
    r: &mut CaseReader<'_>,
    (kind, most): (&CoilKind, usize),
    usual: [usize; 2],
) -> [usize; 2] {
    let mut counts = usual;
    for ((key, ring), count) in RINGS.into_iter().zip(&mut counts) {
        if kind.coil(ring).is_none() {
            *count = 0;
        }
        let comment = match ring {
            Ring::Outer => "number of outer coils",
            Ring::Inner => "number of inner coils",
        };
        let range = Range::UpTo(most as f64, "a whole number, no more than there are places");
        let read = |section: &CaseSection<'_>, problems: &mut Problems| {
            section.number(key, range, &count.to_string(), problems)
        };
        let write = |own: &f64| Written {
            toml: own.to_string(),
            ..Written::number(*own, Reach::Between(0.0, most as f64))
        };
        let own = r.other(
            key,
            Form::number(Range::NotNegative),
            comment,
            *count as f64,
            read,
            write,
        );
        let path = r.path(key);
        if own.fract() != 0.0 {
            let problem = Problem::new(format!("`{path}` is {own}")).label("no whole number");
            r.problem_at(&path, problem.help("coils are counted: write a whole number"));
        } else if own > 0.0 && kind.coil(ring).is_none() {
            let problem = Problem::new(format!("coils \"{}\" have no {key} one", kind.name));
            let problem = problem
                .label("no such coil")
                .help("write 0, or take another kind");
            r.problem_at(&path, problem);
        }
        *count = own as usize;
    }
    counts
}

/// Reads the height of the coils in the nominal layout, at which they must push and not be solid.
pub(crate) fn height(r: &mut CaseReader<'_>, (kind, counts): (&CoilKind, [usize; 2]), usual: f64) -> f64 {
    let mut height = usual;
    let comment = "of the coils in the nominal layout: with their free height it makes their load";
    r.quantity("height", LENGTH, &mut height, comment);
    check_height(r, (kind, counts), height);
    height
}

/// Notes coils that are loose or solid at a height (m).
pub(crate) fn check_height(r: &mut CaseReader<'_>, (kind, counts): (&CoilKind, [usize; 2]), height: f64) {
    for ((key, ring), count) in RINGS.into_iter().zip(counts) {
        let Some(coil) = kind.coil(ring).filter(|_| count > 0) else {
            continue;
        };
        let wrong = match height {
            _ if height >= coil.free_height => ("loose", "below its free height", coil.free_height),
            _ if height <= coil.solid_height => ("solid", "above its solid height", coil.solid_height),
            _ => continue,
        };
        let (what, must, limit) = wrong;
        let message = format!(
            "the {key} coil of kind \"{}\" is {what} in the nominal layout: it is {:.3} in high there, and \
             must be {must} of {:.4} in",
            kind.name,
            height / INCH,
            limit / INCH
        );
        let help = format!(
            "give {}, the height between the seats of the coil in the loaded car",
            r.path("height")
        );
        r.problem_at(&r.path("kind"), Problem::new(message).label(what).help(help));
    }
}

/// Returns the spring of coils that stand in each other, with the stiffness (N/m) beyond their solid height.
pub(crate) fn together(
    kind: &CoilKind,
    counts: [usize; 2],
    (height, shear_ratio, solid): (f64, f64, f64),
) -> Spring {
    let mut sum = Spring::default();
    for ((_, ring), count) in RINGS.into_iter().zip(counts) {
        let Some(coil) = kind.coil(ring) else { continue };
        let (own, count) = (coil.spring(height, shear_ratio, solid), count as f64);
        if count > 0.0 {
            sum.preload += count * own.preload;
            sum.stiffness += count * own.stiffness;
            sum.shear_stiffness += count * own.shear_stiffness;
            sum.solid = match (sum.solid, own.solid) {
                (Some(a), Some(b)) => Some(if a[0] < b[0] { a } else { b }),
                (a, b) => a.or(b),
            };
        }
    }
    sum
}
