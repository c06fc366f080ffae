//! Load coils, as groups or single coils of a nest.

use quantity::Kind;
use truck::nest::{CatalogCoil, springs, whole_nest};
use truck::{NestCoil, Parameters, Spring};

use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::section::{Names, Range};
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
const COILS: Names<(CatalogCoil, [i8; 2])> = &{
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
    let mut all = [("", (CatalogCoil::D5Outer, [0; 2])); 18];
    let mut at = 0;
    while at < 18 {
        let kind = if at < 9 {
            CatalogCoil::D5Outer
        } else {
            CatalogCoil::D5Inner
        };
        all[at] = (NAMES[at / 9][at % 9], (kind, PLACES[at % 9]));
        at += 1;
    }
    all
};

pub(crate) fn load_springs(r: &mut CaseReader<'_>, parameters: &mut Parameters) {
    r.section("load_springs", "Load coils between bolster and side frames.");
    const KINDS: Names<NestKind> = &[
        ("groups", NestKind::Groups),
        ("single_coils", NestKind::SingleCoils),
    ];
    let mut kind = NestKind::Groups;
    let comment =
        "\"groups\": four springs a nest; \"single_coils\": D5 coils at their places in a 3 x 3 nest";
    r.choice("nest", KINDS, &mut kind, comment);
    super::geometry::seat(r, &mut parameters.geometry);
    let Some(first) = parameters.load_coils[0].first().copied() else {
        return;
    };
    let mut coil = first.spring;
    r.quantity(
        "preload",
        PRELOAD,
        &mut coil.preload,
        "of a quarter of a nest in the nominal layout",
    );
    let mut stiffness_ratio = coil.shear_stiffness / coil.stiffness;
    if kind == NestKind::Groups {
        spring_stiffnesses(r, &mut coil, true);
    } else {
        let comment = "shear stiffness of the coils over their stiffness";
        r.number(
            "shear_ratio",
            Range::NotNegative,
            Reach::Positive,
            &mut stiffness_ratio,
            comment,
        );
    }
    r.quantity(
        "damping",
        DAMPING,
        &mut coil.damping,
        "of a quarter of a nest, in every direction",
    );
    let total = 4.0 * coil.preload;
    for (nest, key) in parameters
        .load_coils
        .iter_mut()
        .zip(["missing_left", "missing_right"])
    {
        if kind == NestKind::Groups {
            nest.iter_mut().for_each(|own| own.spring = coil);
            continue;
        }
        let mut missing = Vec::new();
        let comment =
            "coils that are broken or missing, such as \"outer_leading_left\"; the others keep their loads";
        r.several(key, COILS, &mut missing, comment);
        let coils = whole_nest(parameters.damping);
        if let Some(absent) = missing.iter().find(|coil| !coils.contains(coil)) {
            let name = COILS
                .iter()
                .find(|(_, coil)| coil == absent)
                .map_or("", |(name, _)| name);
            let names: Vec<&str> = COILS
                .iter()
                .filter(|(_, own)| coils.contains(own))
                .map(|(name, _)| *name)
                .collect();
            let problem = Problem::new(format!("this nest has no coil `{name}`")).label("no such coil");
            let help = format!("its coils are {}", names.join(", "));
            r.problem(&format!("load_springs.{key}"), problem.help(help));
        }
        let all = springs(&coils, total, stiffness_ratio);
        let present = coils.iter().zip(all).filter(|(coil, _)| !missing.contains(coil));
        let damping = 4.0 * coil.damping / coils.len() as f64;
        *nest = present
            .map(|(_, own)| NestCoil {
                spring: Spring {
                    damping,
                    ..own.spring
                },
                ..own
            })
            .collect();
        if nest.is_empty() {
            let problem = Problem::new("a nest without any coil carries nothing");
            r.problem(
                &format!("load_springs.{key}"),
                problem.help("leave at least one coil in it"),
            );
        }
    }
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
