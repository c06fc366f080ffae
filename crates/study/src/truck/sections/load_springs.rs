//! Load coils, as groups or single coils of a nest.

use quantity::Kind;
use truck::coils::CoilKind;
use truck::nest::{self, CoilPlace, PITCH, Ring, Standing, nest, springs, usual_counts};
use truck::{Parameters, Spring};

use super::coils;
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::section::{Names, Range, name_of};
use crate::reader::{CaseReader, DAMPING, LENGTH, PRELOAD, STIFFNESS};

/// Kinds of load coils: groups or single coils.
#[derive(Clone, Copy, PartialEq)]
enum NestKind {
    Groups,
    SingleCoils,
}

/// The places of a 3 × 3 nest, along x and along y, in the order of the names below.
const PLACES: [[i8; 2]; 9] = [
    [1, 1],
    [1, 0],
    [1, -1],
    [0, 1],
    [0, 0],
    [0, -1],
    [-1, 1],
    [-1, 0],
    [-1, -1],
];

/// All coils of a nest by name.
const COILS: Names<CoilPlace> = &{
    const NAMES: [[&str; 9]; 2] = [
        [
            "outer_leading_left",
            "outer_leading_middle",
            "outer_leading_right",
            "outer_middle_left",
            "outer_middle_middle",
            "outer_middle_right",
            "outer_trailing_left",
            "outer_trailing_middle",
            "outer_trailing_right",
        ],
        [
            "inner_leading_left",
            "inner_leading_middle",
            "inner_leading_right",
            "inner_middle_left",
            "inner_middle_middle",
            "inner_middle_right",
            "inner_trailing_left",
            "inner_trailing_middle",
            "inner_trailing_right",
        ],
    ];
    let mut all = [("", (Ring::Outer, [0; 2])); 18];
    let mut at = 0;
    while at < 18 {
        let kind = if at < 9 { Ring::Outer } else { Ring::Inner };
        all[at] = (NAMES[at / 9][at % 9], (kind, PLACES[at % 9]));
        at += 1;
    }
    all
};

/// Keys of groups, which single coils do not have.
const OF_GROUPS: [&str; 6] = [
    "stiffness",
    "shear_stiffness",
    "solid_travel",
    "solid_stiffness",
    "half_length",
    "half_width",
];
/// Keys of single coils, which say that coils are meant.
const OF_COILS: [&str; 4] = ["kind", "outer", "inner", "height"];

pub(crate) fn load_springs(r: &mut CaseReader<'_>, parameters: &mut Parameters, known: &[CoilKind]) {
    r.section("load_springs", "Load coils between bolster and side frames.");
    const KINDS: Names<NestKind> = &[
        ("groups", NestKind::Groups),
        ("single_coils", NestKind::SingleCoils),
    ];
    let has = |r: &CaseReader<'_>, key: &str| r.has(&format!("load_springs.{key}"));
    let by_coils = OF_COILS.iter().any(|key| has(r, key));
    let mut kind = match by_coils {
        true => NestKind::SingleCoils,
        false => NestKind::Groups,
    };
    let comment = "\"groups\": four springs a nest; \"single_coils\": coils at their places in a 3 x 3 nest, \
                   such as { kind = \"D5\", outer = 7, inner = 7 }";
    r.choice("nest", KINDS, &mut kind, comment);
    super::geometry::seat(r, &mut parameters.geometry);
    let Some(first) = parameters.load_coils[0].first().copied() else {
        return;
    };
    let mut coil = first.spring;
    let preload = "of a quarter of a nest in the nominal layout";
    match kind {
        NestKind::Groups => {
            r.quantity("preload", PRELOAD, &mut coil.preload, preload);
            spring_stiffnesses(r, &mut coil, true);
            let [mut x, mut y] = first.place;
            let comment = "from the nest's middle to each spring, along the track";
            r.quantity("half_length", LENGTH, &mut x, comment);
            r.quantity("half_width", LENGTH, &mut y, "the same across");
            damping(r, &mut coil.damping);
            for own in parameters.load_coils.iter_mut().flatten() {
                let [a, b] = own.place;
                own.place = [x.copysign(a), y.copysign(b)];
                own.spring = coil;
            }
        }
        NestKind::SingleCoils => {
            let reported = OF_GROUPS.iter().find(|key| has(r, key));
            if let Some(key) = reported {
                let path = r.path(key);
                let message = format!("`{path}` is a key of groups; here are single coils");
                let help = format!("leave it out, or write {} = \"groups\"", r.path("nest"));
                let problem = Problem::new(message).label("of groups").help(help);
                r.problem_at(&path, problem);
                r.expect("load_springs", &OF_GROUPS);
            }
            let by_load = has(r, "preload") || !by_coils;
            single_coils(r, parameters, (known, coil, by_load));
        }
    }
}

fn damping(r: &mut CaseReader<'_>, damping: &mut f64) {
    let comment = "of a quarter of a nest, in every direction";
    r.quantity("damping", DAMPING, damping, comment);
}

/// Reads single coils: their load in the nominal layout is given, or follows from their height there.
fn single_coils(
    r: &mut CaseReader<'_>,
    parameters: &mut Parameters,
    (known, group, by_load): (&[CoilKind], Spring, bool),
) {
    const PATH: &str = "load_springs";
    const MOST: usize = 9;
    let (control, travel) = (parameters.damping, group.solid.map_or(0.0, |solid| solid[0]));
    let comment = "of the coils, by the catalog of [coils]; D5 and D7 are the AAR's";
    let Some(kind) = coils::kind(r, (known, "D5"), comment) else {
        return;
    };
    let counts = coils::counts(r, (&kind, MOST), usual_counts(control));
    let Some(all) = nest(control, counts) else {
        let message = "a nest with variable damping has seven places: control coils take two of nine";
        let problem = Problem::new(message).label("too many");
        r.problem(
            "load_springs",
            problem.help("write up to 7 outer and up to 7 inner coils"),
        );
        return;
    };
    let mut preload = group.preload;
    let solid = kind.outer.or(kind.inner).map_or(0.0, |coil| coil.solid_height);
    let height = if by_load {
        if r.has("load_springs.height") {
            let problem = Problem::new("`load_springs.height` and `load_springs.preload` say the same");
            let help = "leave out the preload: it follows from the coils' height";
            r.problem("load_springs.height", problem.label("said twice").help(help));
            r.expect(PATH, &["height"]);
        }
        let comment = "of a quarter of a nest in the nominal layout: the coils have the height that it makes";
        r.quantity("preload", PRELOAD, &mut preload, comment);
        match nest::height(&all, &kind, 4.0 * preload) {
            Some(height) => {
                coils::check_height(r, (&kind, counts), height);
                height
            }
            None => 0.0,
        }
    } else {
        coils::height(r, (&kind, counts), solid + travel)
    };
    let mut pitch = PITCH;
    r.quantity("pitch", LENGTH, &mut pitch, "from one coil to the next: a guess");
    let mut shear_ratio = group.shear_stiffness / group.stiffness;
    let comment = "shear stiffness of the coils over their stiffness";
    r.number(
        "shear_ratio",
        Range::NotNegative,
        Reach::Positive,
        &mut shear_ratio,
        comment,
    );
    let mut quarter = group.damping;
    damping(r, &mut quarter);
    let standing = Standing {
        height,
        shear_ratio,
        pitch,
    };
    let springs = springs(&all, &kind, standing);
    for (own, key) in parameters
        .load_coils
        .iter_mut()
        .zip(["missing_left", "missing_right"])
    {
        let missing = missing(r, key, &all);
        let present = springs.iter().filter(|(place, _)| !missing.contains(place));
        let present = present.map(|(_, coil)| {
            let mut coil = *coil;
            coil.spring.damping = 4.0 * quarter / all.len() as f64;
            coil
        });
        *own = present.collect();
        if own.is_empty() {
            let problem = Problem::new("a nest without any coil carries nothing");
            let path = if missing.is_empty() {
                "load_springs"
            } else {
                &format!("{PATH}.{key}")
            };
            r.problem(path, problem.help("leave at least one coil in it"));
        }
    }
}

/// Reads the coils that are missing in a nest.
fn missing(r: &mut CaseReader<'_>, key: &'static str, coils: &[CoilPlace]) -> Vec<CoilPlace> {
    let mut missing = Vec::new();
    let comment =
        "coils that are broken or missing, such as \"outer_leading_left\"; the others keep their loads";
    r.several(key, COILS, &mut missing, comment);
    if let Some(absent) = missing.iter().find(|coil| !coils.contains(coil)) {
        let name = name_of(COILS, absent);
        let names: Vec<&str> = COILS
            .iter()
            .filter(|(_, own)| coils.contains(own))
            .map(|(name, _)| *name)
            .collect();
        let problem = Problem::new(format!("this nest has no coil `{name}`")).label("no such coil");
        let help = format!("its coils are {}", names.join(", "));
        r.problem(&format!("load_springs.{key}"), problem.help(help));
    }
    missing
}

/// The keys of a spring's stiffnesses.
pub(in crate::truck) fn spring_stiffnesses(r: &mut CaseReader<'_>, spring: &mut Spring, quarter: bool) {
    let of = if quarter {
        "of a quarter of a nest"
    } else {
        "along it"
    };
    r.quantity("stiffness", STIFFNESS, &mut spring.stiffness, of);
    let comment = "along and across the track";
    let shear = (Kind::Stiffness, Range::NotNegative, Reach::Wide);
    r.quantity("shear_stiffness", shear, &mut spring.shear_stiffness, comment);
    let [mut travel, mut stiffness] = [0, 1].map(|k| spring.solid.map(|solid| solid[k]));
    let comment = "from the nominal layout until its coils touch; left out, it never goes solid";
    r.optional("solid_travel", LENGTH, &mut travel, "\"1.4 in\"", comment);
    if travel.is_some() {
        r.optional(
            "solid_stiffness",
            STIFFNESS,
            &mut stiffness,
            "\"2.5e5 lbf/in\"",
            "beyond it",
        );
        if stiffness.is_none() {
            let problem = Problem::new("a coil that goes solid needs `solid_stiffness`");
            r.problem(
                "load_springs",
                problem.help("write for example solid_stiffness = \"2.5e5 lbf/in\""),
            );
        }
    }
    spring.solid = travel
        .zip(stiffness)
        .map(|(travel, stiffness)| [travel, stiffness]);
}
