//! The control coil of a single wedge, `[control_coil]`, which trucks may have too (`kind = "thesis"`).

use mechanics::characteristic::Characteristic;
use mechanics::coil::CoilLaw;
use quantity::{Kind, Quantity, System};
use wedge::parameters::{ControlCoil, Damping};

use super::field::Reach;
use super::names::COIL_LINES;
use super::problem::Problem;
use super::section::Range;
use super::table::TableForm;
use crate::reader::{CaseReader, LENGTH};

const ALONG: (Kind, Range, Reach) = (Kind::Damping, Range::NotNegative, Reach::FromZero(2000.0));
const ROTATIONAL: (Kind, Range, Reach) = (Kind::RotationalDamping, Range::NotNegative, Reach::FromZero(1.0));
const STIFFNESS: (Kind, Range, Reach) = (Kind::Stiffness, Range::Positive, Reach::Positive);

/// The nominal length of the thesis's coil with constant damping: 7.25 in - 3702.2 lbf / (1979 lbf/in),
/// rounded to the nearest `f64`.
const PRELOADED_LENGTH: f64 = 5.379_257_200_606_367;

/// Reads the current section over a coil of the thesis.
pub(crate) fn thesis_coil(r: &mut CaseReader<'_>, coil: &mut ControlCoil, damping: Damping) {
    law(r, &mut coil.law);
    r.quantity("free_length", LENGTH, &mut coil.free_length, "without force");
    let (comment, usual) = match damping {
        Damping::Variable => ("in the nominal position; the thesis: just free", None),
        Damping::Constant => (
            "in the nominal position; the thesis: 7.25 in - 3702.2/1979 in, a preload of 3702.2 lbf",
            Quantity::new(PRELOADED_LENGTH, "in").ok(),
        ),
    };
    r.quantity_or("nominal_length", LENGTH, usual, &mut coil.nominal_length, comment);
    let along = r.quantity("damping", ALONG, &mut coil.damping, "along the coil");
    let comment = "of the wedge's rotations; the thesis uses the same number as along the coil";
    let usual = along.as_ref().and_then(rotational_damping);
    let rotational = &mut coil.rotational_damping;
    r.quantity_or("rotational_damping", ROTATIONAL, usual, rotational, comment);
    let comment = "\"center_of_gravity\": the thesis's moment equations hold no moment of the coil; or \
                   \"seat\", with its moment";
    r.choice("acts_at", COIL_LINES, &mut coil.acts_at, comment);
    let comment = "the thesis's coil pushes and pulls; false: it lifts off at its free length";
    r.truth("pulls", &mut coil.pulls, comment);
}

/// Reads a constant stiffness, or a table of compression and force.
fn law(r: &mut CaseReader<'_>, law: &mut CoilLaw) {
    let [stiffness, table] = ["stiffness", "table"].map(|key| r.gives(key));
    if stiffness && table {
        r.also_known("stiffness");
        r.also_known("table");
        let (section, path) = (r.path(""), r.path("table"));
        let section = section.trim_end_matches('.');
        let problem = Problem::new(format!("`{section}` has both `stiffness` and `table`"));
        let problem = problem
            .label("one of them is expected")
            .help("leave one of them out");
        r.problem_at_key(&path, problem);
    } else if table {
        r.also_known("stiffness");
        let comment = "compression and force; straight between the points";
        let reach = Reach::FromZero(4448.0);
        let Some(table) = r.table("table", &TableForm::coil(), reach, comment) else {
            return;
        };
        let points = table.rows.iter().map(|row| row.each_ref().map(Quantity::to_si));
        match Characteristic::new(points.collect()) {
            Ok(points) => *law = CoilLaw::Table(points),
            Err(error) => {
                let path = r.path("table");
                r.problem_at(&path, Problem::new(format!("`{path}`: {error}")));
            }
        }
    } else {
        r.also_known("table");
        let mut own = match law {
            CoilLaw::Linear { stiffness } => *stiffness,
            _ if !stiffness => return,
            _ => 0.0,
        };
        let comment = "or table = [[compression, force], ...] or table = \"coil.csv\"";
        r.quantity("stiffness", STIFFNESS, &mut own, comment);
        *law = CoilLaw::Linear { stiffness: own };
    }
}

/// Returns what the thesis writes in its moment equations (3-13, 3-18), the same C: numerically the damping
/// in lbf s/in, as lbf s in.
fn rotational_damping(damping: &Quantity) -> Option<Quantity> {
    let number = if damping.unit_text() == Kind::Damping.unit(System::Us) {
        damping.value()
    } else {
        damping.to_si() * Kind::Damping.from_si(System::Us)
    };
    Quantity::new(number, Kind::RotationalDamping.unit(System::Us)).ok()
}
