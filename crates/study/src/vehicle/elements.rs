//! The elements of a vehicle's case: the kinds of the catalog, each with its keys.

mod couplers;
mod lines;
mod seats;

use std::fmt;
use std::sync::Arc;

use mechanics::motion::Motion;
use quantity::Kind;
use truck::coils::CoilKind;
use vehicle::catalog::{
    AppliedForce, Attachment, AxisStop, Bushing, CatalogElement, DryFriction, Element, ForceOverDistance,
    FrictionWedge,
};
use wedge::parameters::Damping;

use super::like;
use crate::case::field::{Reach, Written};
use crate::case::names::DAMPINGS;
use crate::case::page::FRICTION;
use crate::case::problem::Problem;
use crate::case::section::{Names, Range};
use crate::case::table::TableForm;
use crate::case::tree::NodeValue;
use crate::reader::schema::Form;
use crate::reader::{CLEARANCE, CaseReader, DAMPING, PRELOAD, QuantityForm, STIFFNESS};
use crate::truck::wedges;

/// A kind of elements of one's own.
pub struct OwnElement {
    /// Its name in cases.
    pub kind: &'static str,
    /// Its keys.
    pub keys: &'static [OwnKey],
    /// Makes one of the values of its keys, SI, in their order.
    pub make: fn(&[f64]) -> Arc<dyn CatalogElement>,
}

impl fmt::Debug for OwnElement {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("OwnElement")
            .field("kind", &self.kind)
            .finish_non_exhaustive()
    }
}

/// A key of an element of one's own: a quantity.
#[derive(Clone, Copy, Debug)]
pub struct OwnKey {
    /// Its name.
    pub key: &'static str,
    /// What it measures.
    pub kind: Kind,
    /// Its value where it is left out, SI; none: it must be given.
    pub default: Option<f64>,
    /// What it means, in a few words.
    pub comment: &'static str,
}

/// The kinds of the catalog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ElementKind {
    Spring,
    Damper,
    Link,
    Gap,
    Coil,
    Bushing,
    Stop,
    DryFriction,
    Wedge,
    CenterPlate,
    RollerSideBearing,
    ConstantContactSideBearing,
    Adapter,
    AdapterPad,
    Coupler,
    DraftGear,
    Force,
}

const KINDS: Names<ElementKind> = &[
    ("spring", ElementKind::Spring),
    ("damper", ElementKind::Damper),
    ("link", ElementKind::Link),
    ("gap", ElementKind::Gap),
    ("coil", ElementKind::Coil),
    ("bushing", ElementKind::Bushing),
    ("stop", ElementKind::Stop),
    ("dry_friction", ElementKind::DryFriction),
    ("wedge", ElementKind::Wedge),
    ("center_plate", ElementKind::CenterPlate),
    ("roller_side_bearing", ElementKind::RollerSideBearing),
    (
        "constant_contact_side_bearing",
        ElementKind::ConstantContactSideBearing,
    ),
    ("adapter", ElementKind::Adapter),
    ("adapter_pad", ElementKind::AdapterPad),
    ("coupler", ElementKind::Coupler),
    ("draft_gear", ElementKind::DraftGear),
    ("force", ElementKind::Force),
];

const AXES: Names<usize> = &[("x", 0), ("y", 1), ("z", 2)];
const ENDS: Names<bool> = &[("ahead", true), ("behind", false)];
/// Springs and dampers about axes: moment by angle (rad), by angular velocity (rad/s).
const MOMENTS: QuantityForm = (Kind::Moment, Range::NotNegative, Reach::Positive);
const FORCES: QuantityForm = (Kind::Force, Range::Any, Reach::Signed(1e4));
const STIFFNESSES: QuantityForm = (Kind::Stiffness, Range::NotNegative, Reach::Wide);
const TURNED: QuantityForm = (Kind::Angle, Range::Any, Reach::Signed(1.6));

/// Reads `[elements.NAME]`; `bodies` are the names that their ends may have, the ground first. Returns them,
/// and what is doubtful.
pub(super) fn all(
    r: &mut CaseReader<'_>,
    bodies: &[&str],
    own: &'static [OwnElement],
) -> (Vec<Element>, Vec<String>) {
    let names = r.names("elements");
    let coils = truck::coils::catalog();
    let (mut all, mut doubts) = (Vec::with_capacity(names.len()), Vec::new());
    for name in names {
        if bodies.contains(&name) {
            let problem = Problem::new(format!("a body and an element are both named `{name}`"));
            let help = "their columns begin with the name: give one of them another";
            let path = format!("elements.{name}");
            r.problem_at_key(&path, problem.label("two parts of one name").help(help));
        }
        all.extend(element(r, name, (bodies, own, &coils), &mut doubts));
    }
    (all, doubts)
}

type Known<'k> = (&'k [&'k str], &'static [OwnElement], &'k [CoilKind]);

fn element(
    r: &mut CaseReader<'_>,
    name: &str,
    (bodies, own, coils): Known<'_>,
    doubts: &mut Vec<String>,
) -> Option<Element> {
    let path = format!("elements.{name}");
    r.section(&path, "An element. Forces are those on the body with end a.");
    if like::is_told(r, &path) {
        return None;
    }
    let Some(kind) = kind(r, &path, own) else {
        r.known_elsewhere();
        return None;
    };
    let comment = "the body with end a";
    let a = r.name_among("a", bodies, comment);
    let b = match kind {
        // Comes from outside.
        Which::Catalog(ElementKind::Force | ElementKind::Coupler) => Some(0),
        _ => r.name_among("b", bodies, "the body with end b, or \"ground\""),
    };
    let is_line = match kind {
        Which::Catalog(kind) => lines::is_line(kind),
        Which::Own(_) => r.gives("at_a") || r.gives("at_b"),
    };
    let mut at = [[0.0; 3]; 2];
    if is_line {
        r.place("at_a", &mut at[0], "end a in the nominal layout");
        r.place("at_b", &mut at[1], "end b in the nominal layout");
        for key in ["at_a", "at_b"] {
            r.expect(&path, &[key]);
        }
    } else {
        r.place("at", &mut at[0], "both ends in the nominal layout");
        at[1] = at[0];
        if matches!(kind, Which::Own(_)) {
            r.expect(&path, &["at_a", "at_b"]);
        }
    }
    let law: Arc<dyn CatalogElement> = match kind {
        Which::Own(own) => own_law(r, own),
        Which::Catalog(ElementKind::Coil) => Arc::new(lines::coil(r)),
        Which::Catalog(ElementKind::Bushing) => Arc::new(bushing(r)),
        Which::Catalog(ElementKind::Stop) => Arc::new(stop(r)),
        Which::Catalog(ElementKind::DryFriction) => Arc::new(friction(r)),
        Which::Catalog(ElementKind::Wedge) => Arc::new(wedge(r, &path, coils)),
        Which::Catalog(ElementKind::Force) => force(r),
        Which::Catalog(ElementKind::Coupler) => Arc::new(couplers::coupler(r)),
        Which::Catalog(ElementKind::DraftGear) => Arc::new(couplers::draft_gear(r)),
        Which::Catalog(kind) if lines::is_line(kind) => Arc::new(lines::line(r, kind)),
        Which::Catalog(kind) => {
            let (law, doubtful) = seats::seat(r, &path, kind);
            doubts.extend(doubtful.into_iter().map(|words| format!("{name}: {words}")));
            law
        }
    };
    let (a, b) = (a?, b?);
    let is_force = matches!(kind, Which::Catalog(ElementKind::Force | ElementKind::Coupler));
    if a == b && !is_force {
        let message = format!("{name} is between {} and itself", bodies[a]);
        let problem = Problem::new(message).label("both ends on one body");
        r.problem_at_key(
            &path,
            problem.help("name two bodies; one of them may be \"ground\""),
        );
        return None;
    }
    if is_force && a == 0 {
        let problem = Problem::new(format!("{name} acts on the ground, which stands still"));
        r.problem_at_key(&path, problem.label("no effect").help("name a body"));
        return None;
    }
    Some(Element {
        name: name.to_owned(),
        ends: [
            Attachment { body: a, at: at[0] },
            Attachment { body: b, at: at[1] },
        ],
        law,
    })
}

/// A kind of the catalog, or one of one's own.
#[derive(Clone, Copy)]
enum Which {
    Catalog(ElementKind),
    Own(&'static OwnElement),
}

fn kind(r: &mut CaseReader<'_>, path: &str, own: &'static [OwnElement]) -> Option<Which> {
    let given = r.at(&format!("{path}.kind"));
    if let Some(NodeValue::Text(name)) = given.map(|node| &node.value)
        && let Some(found) = own.iter().find(|own| own.kind == name)
    {
        let toml = Written::text(found.kind);
        r.other(
            "kind",
            Form::Text,
            "a kind of your own",
            (),
            |_, _| Some(()),
            |()| toml,
        );
        return Some(Which::Own(found));
    }
    if given.is_none() {
        let problem = Problem::new(format!("`{path}.kind` is missing"));
        let names: Vec<&str> = KINDS.iter().map(|(name, _)| *name).collect();
        let help = format!("write kind = one of \"{}\"", names.join("\", \""));
        r.problem_at_key(path, problem.label("needs a kind").help(help));
        return None;
    }
    let known = match given.map(|node| &node.value) {
        Some(NodeValue::Text(name)) => KINDS.iter().any(|(own, _)| own == name),
        _ => false,
    };
    let mut kind = ElementKind::Spring;
    r.choice("kind", KINDS, &mut kind, "of the catalog");
    known.then_some(Which::Catalog(kind))
}

fn own_law(r: &mut CaseReader<'_>, own: &OwnElement) -> Arc<dyn CatalogElement> {
    let mut values = Vec::with_capacity(own.keys.len());
    for key in own.keys {
        let form: QuantityForm = (key.kind, Range::Any, Reach::Wide);
        let mut value = key.default.unwrap_or(1.0);
        match key.default {
            Some(_) => {
                r.quantity(key.key, form, &mut value, key.comment);
            }
            None => r.needed(key.key, form, &mut value, key.comment),
        }
        values.push(value);
    }
    (own.make)(&values)
}

fn bushing(r: &mut CaseReader<'_>) -> Bushing {
    let mut own = Bushing::default();
    let comment = "along x, y, z of end b";
    r.triple("stiffness", STIFFNESSES, &mut own.stiffness, comment);
    r.triple("damping", DAMPING, &mut own.damping, comment);
    let comment = "about x, y, z: moment by angle, per rad";
    r.triple(
        "rotational_stiffness",
        MOMENTS,
        &mut own.rotational_stiffness,
        comment,
    );
    let comment = "about x, y, z: moment by angular velocity, per rad/s";
    r.triple(
        "rotational_damping",
        MOMENTS,
        &mut own.rotational_damping,
        comment,
    );
    r.triple("load", FORCES, &mut own.load, "on end a in the nominal layout");
    let comment = "roll, pitch, yaw of its axes in the nominal layout";
    r.triple("turned", TURNED, &mut own.turned, comment);
    let nothing = [
        own.stiffness,
        own.damping,
        own.rotational_stiffness,
        own.rotational_damping,
    ];
    if nothing.as_flattened().iter().all(|own| *own == 0.0) {
        let given = r.given().map(|section| section.path);
        let path = given.unwrap_or_default();
        let problem = Problem::new(format!(
            "`{path}` holds nothing: all of its stiffness and damping is zero"
        ));
        let help = "give stiffness, damping, rotational_stiffness or rotational_damping";
        r.problem_at_key(&path, problem.label("no effect").help(help));
    }
    own
}

fn stop(r: &mut CaseReader<'_>) -> AxisStop {
    let mut own = AxisStop {
        axis: 0,
        clearances: [0.0; 2],
        stiffness: 0.0,
        damping: 0.0,
    };
    r.choice("axis", AXES, &mut own.axis, "of end b");
    let comment = "of end a towards the positive axis, in the nominal layout";
    r.needed("clearance", CLEARANCE, &mut own.clearances[1], comment);
    let mut behind = None;
    r.optional(
        "clearance_behind",
        CLEARANCE,
        &mut behind,
        "\"1 in\"",
        "towards the negative axis; left out, the same",
    );
    own.clearances[0] = behind.unwrap_or(own.clearances[1]);
    let mut one_sided = false;
    r.truth(
        "one_sided",
        &mut one_sided,
        "true: nothing stops it towards the negative axis",
    );
    if one_sided {
        own.clearances[0] = f64::INFINITY;
    }
    r.needed("stiffness", STIFFNESS, &mut own.stiffness, "beyond it");
    r.quantity(
        "damping",
        DAMPING,
        &mut own.damping,
        "beyond it; a stop never pulls",
    );
    own
}

fn friction(r: &mut CaseReader<'_>) -> DryFriction {
    let mut own = DryFriction {
        axis: 2,
        normal_force: 0.0,
        normal_stiffness: 0.0,
        coefficient: 0.3,
        bristle_stiffness: 0.0,
        bristle_damping: 0.0,
        pushes: false,
    };
    r.choice(
        "axis",
        AXES,
        &mut own.axis,
        "of the normal force; friction acts across it",
    );
    r.needed(
        "normal_force",
        PRELOAD,
        &mut own.normal_force,
        "in the nominal layout",
    );
    let comment = "growth of the normal force with the compression along the axis";
    r.quantity(
        "normal_stiffness",
        STIFFNESSES,
        &mut own.normal_stiffness,
        comment,
    );
    let range = crate::case::friction::COEFFICIENT;
    r.number(
        "friction",
        range,
        FRICTION,
        &mut own.coefficient,
        "coefficient of friction",
    );
    let comment = "by which it deflects before it slips";
    r.needed(
        "bristle_stiffness",
        STIFFNESS,
        &mut own.bristle_stiffness,
        comment,
    );
    let damping: QuantityForm = (Kind::Damping, Range::Positive, Reach::Positive);
    own.bristle_damping = 1e-3 * own.bristle_stiffness;
    r.quantity(
        "bristle_damping",
        damping,
        &mut own.bristle_damping,
        "of the bristle",
    );
    let comment = "false: a clamp, whose two sides cancel; true: the normal force parts the bodies";
    r.truth("pushes", &mut own.pushes, comment);
    own
}

fn force(r: &mut CaseReader<'_>) -> Arc<dyn CatalogElement> {
    let mut axis = 2;
    r.choice(
        "axis",
        AXES,
        &mut axis,
        "along which it acts, positive along it; fixed in space, or of the track over distance on one",
    );
    if r.gives("over_distance") {
        r.also_known("value");
        if r.gives("value") {
            let problem = Problem::new("a force has a value over time or over distance, not both");
            let help = "leave out value, or over_distance";
            r.problem_at(&r.path("over_distance"), problem.label("two courses").help(help));
        }
        let comment = "of end a and force: along the track, or along x from the nominal layout without one; \
                       constant before and behind";
        let table = r.table(
            "over_distance",
            &TableForm::over_distance(),
            Reach::Signed(1e5),
            comment,
        );
        let points: Option<Vec<[f64; 2]>> = table.map(|table| {
            let rows = table.rows.iter();
            rows.map(|row| row.each_ref().map(quantity::Quantity::to_si))
                .collect()
        });
        let made = points.and_then(|points| ForceOverDistance::new(axis, &points));
        return match made {
            Some(made) => Arc::new(made),
            // What is wrong with it has been told.
            None => Arc::new(AppliedForce {
                direction: [1.0, 0.0, 0.0],
                course: Motion::Constant(0.0),
            }),
        };
    }
    r.also_known("over_distance");
    let mut course = Motion::Constant(0.0);
    r.course(
        "value",
        (Kind::Force, 1e5),
        &mut course,
        false,
        "along the axis, over time as loads are",
    );
    let mut direction = [0.0; 3];
    direction[axis] = 1.0;
    Arc::new(AppliedForce { direction, course })
}

fn wedge(r: &mut CaseReader<'_>, path: &str, coils: &[CoilKind]) -> FrictionWedge {
    let mut ahead = true;
    let comment = "where its column is: \"ahead\" of it (x), or \"behind\". a is the body with the pocket, b \
                   that with the column";
    r.choice("column", ENDS, &mut ahead, comment);
    let mut damping = Damping::Variable;
    let comment = "\"variable\": its control coil stands on b; \"constant\": in the pocket";
    r.choice("damping", DAMPINGS, &mut damping, comment);
    r.within(path);
    let wedge = wedges::alone(r, damping, coils);
    r.within("");
    FrictionWedge {
        wedge,
        damping,
        end: if ahead { 1.0 } else { -1.0 },
    }
}
