//! Elements along a line between two points, and coils on seats.

use mechanics::curve::Curve;
use quantity::Kind;
use truck::Spring;
use vehicle::catalog::{Coil, Line};

use super::{ElementKind, FORCES};
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::section::Range;
use crate::case::table::{QuantityTable, TableForm};
use crate::reader::{CLEARANCE, CaseReader, DAMPING, LENGTH, QuantityForm, STIFFNESS};

/// Returns whether an element of this kind has two places.
pub(super) fn is_line(kind: ElementKind) -> bool {
    use ElementKind::{Damper, DraftGear, Gap, Link, Spring};
    matches!(kind, Spring | Damper | Link | Gap | DraftGear)
}

/// Returns the curve of a table, SI.
fn curve(table: &QuantityTable) -> Option<Curve> {
    let points = table
        .rows
        .iter()
        .map(|row| row.each_ref().map(quantity::Quantity::to_si));
    Curve::new(points.collect()).ok()
}

/// The keys of a spring, a damper, a link or a gap.
pub(super) fn line(r: &mut CaseReader<'_>, kind: ElementKind) -> Line {
    let (mut stiffness, mut damping, mut load) = (0.0, 0.0, 0.0);
    let mut own = Line::linear(0.0, 0.0, 0.0);
    if kind == ElementKind::Spring {
        own.is_coil = true;
        let comment = "in the nominal layout, positive in compression";
        r.quantity("load", FORCES, &mut load, comment);
    }
    let has_table = r.gives("table");
    match kind {
        ElementKind::Damper if has_table => {
            let comment = "rate of compression and force";
            own.damper = table(r, &TableForm::damper(), comment).unwrap_or(own.damper);
            r.also_known("damping");
        }
        ElementKind::Damper => {
            r.needed(
                "damping",
                DAMPING,
                &mut damping,
                "force by the rate of compression",
            );
            r.also_known("table");
        }
        ElementKind::Spring if has_table => {
            let comment = "compression from the nominal layout and force, beside the load";
            own.spring = table(r, &TableForm::coil(), comment).unwrap_or(own.spring);
            own.spring = own.spring.scaled(1.0, load);
            r.also_known("stiffness");
        }
        _ => {
            r.needed("stiffness", STIFFNESS, &mut stiffness, "along its line");
            own.spring = Curve::linear(stiffness).scaled(1.0, load);
            if kind == ElementKind::Spring {
                r.also_known("table");
            }
        }
    }
    if kind != ElementKind::Damper {
        r.quantity("damping", DAMPING, &mut damping, "along its line");
    }
    if !(kind == ElementKind::Damper && has_table) {
        own.damper = Curve::linear(damping);
    }
    match kind {
        ElementKind::Gap => {
            let mut slack = [0.0; 2];
            let comment = "how far it extends from the nominal layout before it pulls";
            r.quantity("slack_open", CLEARANCE, &mut slack[0], comment);
            let comment = "how far it is compressed before it pushes";
            r.quantity("slack_closed", CLEARANCE, &mut slack[1], comment);
            own.slack = Some(slack);
        }
        ElementKind::Spring => {
            let mut pulls = true;
            r.truth("pulls", &mut pulls, "false: it lets go where it would pull");
            if !pulls {
                own.limits[0] = 0.0;
            }
        }
        _ => {}
    }
    own
}

fn table(r: &mut CaseReader<'_>, form: &TableForm, comment: &str) -> Option<Curve> {
    let read = r.table("table", form, Reach::Wide, comment)?;
    curve(&read)
}

/// The keys of a coil on a seat.
pub(super) fn coil(r: &mut CaseReader<'_>) -> Coil {
    let mut spring = Spring::default();
    let preload: QuantityForm = (Kind::Force, Range::Positive, Reach::Positive);
    r.needed("load", preload, &mut spring.preload, "in the nominal layout");
    r.needed("stiffness", STIFFNESS, &mut spring.stiffness, "upright");
    let shear: QuantityForm = (Kind::Stiffness, Range::NotNegative, Reach::Wide);
    r.quantity("shear_stiffness", shear, &mut spring.shear_stiffness, "sideways");
    r.quantity("damping", DAMPING, &mut spring.damping, "in all directions");
    let mut travel = None;
    let comment = "from the nominal layout until it is solid; left out: never";
    r.optional("solid_travel", LENGTH, &mut travel, "\"2 in\"", comment);
    if let Some(travel) = travel {
        let mut stiffness = 20.0 * spring.stiffness;
        r.quantity(
            "solid_stiffness",
            STIFFNESS,
            &mut stiffness,
            "beyond, in addition",
        );
        spring.solid = Some([travel, stiffness]);
    } else {
        r.also_known("solid_stiffness");
        if r.gives("solid_stiffness") {
            let path = r.path("solid_stiffness");
            let problem = Problem::new(format!("`{path}` has no effect without solid_travel"));
            let help = "give solid_travel, or leave it out";
            r.problem_at(&path, problem.label("no effect").help(help));
        }
    }
    let mut length = 0.25;
    r.quantity(
        "length",
        LENGTH,
        &mut length,
        "that is drawn below its place; of no other effect",
    );
    Coil { spring, length }
}
