//! Control coils: by their numbers, of the thesis, or by their name in the catalog.

use quantity::Kind;
use truck::Spring;
use wedge::parameters::{ControlCoil as ThesisCoil, Damping};

use super::sections::{self, spring_stiffnesses};
use super::wedges::Draft;
use crate::case::coil;
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::section::{Names, Range};
use crate::case::tree::NodeValue;
use crate::reader::{CaseReader, DAMPING, PRELOAD, STIFFNESS};

const INCH: f64 = 0.0254;
const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// Coils by their name.
#[derive(Clone)]
pub(super) struct Named {
    name: String,
    counts: [usize; 2],
    /// In the nominal layout, m.
    height: f64,
    shear_ratio: f64,
    solid_stiffness: f64,
}

/// Kinds of control coils.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum CoilKind {
    Shear,
    Thesis,
    Nothing,
    /// By a name of the catalog.
    Named,
}

const COIL_KINDS: Names<CoilKind> = &[
    ("shear", CoilKind::Shear),
    ("thesis", CoilKind::Thesis),
    ("nothing", CoilKind::Nothing),
];
/// Keys that only the thesis's coil has.
const OF_THESIS: [&str; 6] = [
    "table",
    "free_length",
    "nominal_length",
    "rotational_damping",
    "acts_at",
    "pulls",
];
/// Keys that only a coil with shear stiffness has.
const OF_SHEAR: [&str; 4] = ["preload", "shear_stiffness", "solid_travel", "solid_stiffness"];
/// Those that a coil by its name has not, since they follow from its heights.
const NOT_NAMED: [&str; 4] = ["preload", "stiffness", "shear_stiffness", "solid_travel"];
/// Keys that only a coil by its name has.
const OF_NAMED: [&str; 4] = ["outer", "inner", "height", "shear_ratio"];
/// Keys of both.
const OF_COILS: [&str; 2] = ["stiffness", "damping"];

/// Height of control coils on side frames in the nominal layout, m: 1.4085 in above the solid height of the
/// coils of the catalog, the travel to it in input files of NUCARS (derived).
const COIL_HEIGHT: f64 = (6.5625 + 1.4085) * INCH;
/// Stiffness of a control coil beyond its solid height, N/m.
const SOLID_STIFFNESS: f64 = 250_000.0 * POUND_FORCE / INCH;
/// Control coils of a wedge in each other, or beside each other, at the most.
const MOST_COILS: usize = 2;

/// Returns the thesis's coil (Steets 2007, table 3-2), and its place below the wedge.
pub(super) fn thesis_coil(damping: Damping) -> (ThesisCoil, [f64; 3]) {
    let own = wedge::thesis::parameters(damping, 0.0, 0.0);
    (own.coil, own.wedge.center_of_gravity)
}

impl Named {
    /// Returns what is usual beside this spring and this coil of the thesis.
    pub(super) fn usual(damping: Damping, spring: &Spring, thesis: &ThesisCoil) -> Self {
        Self {
            name: "B-353".to_owned(),
            counts: [1, 1],
            height: match damping {
                Damping::Variable => COIL_HEIGHT,
                Damping::Constant => thesis.nominal_length,
            },
            shear_ratio: spring.shear_stiffness / spring.stiffness,
            solid_stiffness: SOLID_STIFFNESS,
        }
    }
}

impl Draft {
    /// Returns the name of the coils of the catalog that a section takes; none if it takes another kind.
    fn named(&self, r: &CaseReader<'_>, path: &str) -> Option<String> {
        let given = r.at(&format!("{path}.kind"));
        match given.map(|node| &node.value) {
            None if self.kind == CoilKind::Named => Some(self.named.name.clone()),
            Some(NodeValue::Text(text)) if COIL_KINDS.iter().all(|(name, _)| name != text) => {
                Some(self.named.name.clone())
            }
            _ => None,
        }
    }

    /// Reads coils by their name.
    fn named_coil(&mut self, r: &mut CaseReader<'_>, name: &str) {
        let comment = "\"shear\": by its numbers; \"thesis\"; \"nothing\": broken; or by its name in the \
                       catalog of [coils], outer and inner coil";
        let Some(kind) = sections::coil_kind(r, (&self.known, name), comment) else {
            return;
        };
        let own = &mut self.named;
        own.counts = sections::coil_counts(r, (&kind, MOST_COILS), own.counts);
        own.height = sections::coil_height(r, (&kind, own.counts), own.height);
        let comment = "shear stiffness of the coils over their stiffness";
        r.number(
            "shear_ratio",
            Range::NotNegative,
            Reach::Positive,
            &mut own.shear_ratio,
            comment,
        );
        let beyond = "beyond the solid height";
        r.quantity("solid_stiffness", STIFFNESS, &mut own.solid_stiffness, beyond);
        let mut damping = self.spring.damping;
        r.quantity("damping", DAMPING, &mut damping, "in every direction");
        let standing = (own.height, own.shear_ratio, own.solid_stiffness);
        self.spring = Spring {
            damping,
            ..sections::coils_together(&kind, own.counts, standing)
        };
        own.name = kind.name;
    }

    /// Reads the control coil of all wedges, or of the one whose section has this path.
    pub(super) fn coil(&mut self, r: &mut CaseReader<'_>, path: &str) {
        let comment = "\"shear\": a coil with shear stiffness; \"thesis\": a line from seat to wedge \
                       (Steets 2007); \"nothing\": broken; or a name of [coils], such as \"B-353\"";
        let name = self.named(r, path);
        match name {
            Some(_) => self.kind = CoilKind::Named,
            None => r.choice("kind", COIL_KINDS, &mut self.kind, comment),
        }
        let others: &[(&[&'static str], &str)] = match self.kind {
            CoilKind::Shear => &[(&OF_THESIS, "thesis"), (&OF_NAMED, "B-353")],
            CoilKind::Named => &[(&OF_THESIS, "thesis"), (&NOT_NAMED, "shear")],
            CoilKind::Thesis => &[(&OF_SHEAR, "shear"), (&OF_NAMED, "B-353")],
            CoilKind::Nothing => &[
                (&OF_THESIS, "thesis"),
                (&OF_SHEAR, "shear"),
                (&OF_COILS, "shear"),
                (&OF_NAMED, "B-353"),
            ],
        };
        for (keys, kind) in others {
            for key in *keys {
                let full = format!("{path}.{key}");
                if r.has(&full) {
                    let problem = Problem::new(format!("`{full}` is a key of the coil of kind \"{kind}\""));
                    let help = format!("leave it out, or write {path}.kind = \"{kind}\"");
                    r.problem(&full, problem.label("of another kind").help(help));
                    r.expect(path, keys);
                }
            }
        }
        if self.kind == CoilKind::Nothing {
            return;
        }
        if let Some(name) = name {
            self.named_coil(r, &name);
            return;
        }
        if self.kind == CoilKind::Shear {
            r.quantity(
                "preload",
                PRELOAD,
                &mut self.spring.preload,
                "in the nominal layout",
            );
            spring_stiffnesses(r, &mut self.spring, false);
            r.quantity("damping", DAMPING, &mut self.spring.damping, "in every direction");
            return;
        }
        coil::thesis_coil(r, &mut self.thesis, self.damping);
        let place = (Kind::Length, Range::Any, Reach::Signed(INCH));
        let comment = "of the wedge's center of gravity from the coil's end, x towards the bolster";
        r.triple("center_of_gravity", place, &mut self.to_center, comment);
    }
}
