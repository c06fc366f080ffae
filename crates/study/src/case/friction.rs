//! Friction of a wedge's faces, `[friction]`: the same keys in cases of a wedge, of a truck and of a car.

use mechanics::friction::FrictionLaw;
use quantity::Kind;
use wedge::parameters::FaceFriction;

use super::field::{Reach, Written};
use super::names::{LAWS, Law};
use super::problem::Problems;
use super::section::{CaseSection, Range, name_of};
use super::tree::NodeValue;
use super::{bounds, page::FRICTION};
use crate::reader::schema::Form;
use crate::reader::{CaseReader, STIFFNESS};

/// A coefficient of friction.
pub(crate) const COEFFICIENT: Range = Range::UpTo(bounds::FRICTION, "between 0 and 10");

/// The laws at column and slope. Each keeps its numbers while another one is chosen.
#[derive(Clone)]
pub(crate) struct Laws {
    chosen: [Law; 2],
    reference_speed: f64,
    /// Stiffness and damping.
    bristle: [f64; 2],
}

impl Laws {
    /// The same law at both faces, with the usual numbers of tanh friction (Steets 2007) and these of a
    /// bristle, N/m and N·s/m.
    pub fn new(law: Law, bristle: [f64; 2]) -> Self {
        Self {
            chosen: [law; 2],
            reference_speed: 0.001 * 0.0254,
            bristle,
        }
    }

    /// Returns the law at the column or at the slope, with its numbers.
    pub fn law(&self, face: usize) -> FrictionLaw {
        match self.chosen[face] {
            Law::Tanh => FrictionLaw::Tanh {
                reference_speed: self.reference_speed,
            },
            Law::Bristle => FrictionLaw::Bristle {
                stiffness: self.bristle[0],
                damping: self.bristle[1],
            },
        }
    }

    /// Reads the current section; `faces` are the column's friction and the slope's.
    pub fn read(&mut self, r: &mut CaseReader<'_>, faces: [&mut FaceFriction; 2]) {
        let comment = "\"tanh\" (the thesis's; creeps under load) or \"bristle\" (holds); or { column = \
                       ..., slope = ... }";
        self.chosen = r.other("law", Form::Described, comment, self.chosen, read, written);
        for (key, friction) in ["column", "slope"].into_iter().zip(faces) {
            let coefficient = &mut friction.coefficient;
            r.number(key, COEFFICIENT, FRICTION, coefficient, "coefficient of friction");
        }
        let speed = (Kind::Speed, Range::Positive, Reach::Wide);
        let comment = "tanh: below it friction fades. It is part of the result: ten times it moves the \
                       forces by 20 to 30 %";
        r.quantity("reference_speed", speed, &mut self.reference_speed, comment);
        let [stiffness, damping] = &mut self.bristle;
        let comment = "bristle: tangential, per face. Not in the thesis: from the comparison program";
        r.quantity("bristle_stiffness", STIFFNESS, stiffness, comment);
        let positive = (Kind::Damping, Range::Positive, Reach::Wide);
        let comment = "bristle: tangential, per face. From the comparison program";
        r.quantity("bristle_damping", positive, damping, comment);
    }
}

/// Reads the laws at column and slope: one name, or a table of two.
fn read(s: &CaseSection<'_>, problems: &mut Problems) -> Option<[Law; 2]> {
    match &s.table.get("law")?.value {
        NodeValue::Table(table) => {
            let faces = CaseSection {
                path: s.path_of("law"),
                table,
                place: s.table.entry("law").map(|entry| entry.key_place.clone()),
            };
            faces.allow(&["column", "slope"], &[], problems);
            let column = faces.choice("column", LAWS, problems);
            let slope = faces.choice("slope", LAWS, problems);
            Some([column?, slope?])
        }
        _ => s.choice("law", LAWS, problems).map(|law| [law; 2]),
    }
}

fn written(laws: &[Law; 2]) -> Written {
    match laws {
        [column, slope] if column == slope => Written::choice(LAWS, column),
        laws => {
            let [column, slope] = laws.each_ref().map(|law| name_of(LAWS, law));
            Written::toml(format!("{{ column = \"{column}\", slope = \"{slope}\" }}"))
        }
    }
}
