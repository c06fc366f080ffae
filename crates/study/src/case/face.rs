//! The sections of the wedge's faces, `[column_face]` and `[slope_face]`, the same in cases of a wedge and of a
//! truck: read over values that hold where a key is left out, written line by line.

use super::field::Written;
use super::problem::{Problem, Problems};
use super::section::Section;
use super::tree::{Node, Value};
use wedge::face::{FaceProperties, Grid, LARGEST_GRID};

/// The names of the sections, in the order of [`wedge::outputs::FACES`].
pub(crate) const SECTIONS: [&str; 2] = ["column_face", "slope_face"];
/// What the sections are about.
pub(crate) const ABOUT: [&str; 2] = [
    "The wedge's vertical face at the column.",
    "The wedge's slope face at the slope of the bolster's pocket.",
];

/// `[column_face]` or `[slope_face]`
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceSection {
    /// Points up the face and across it.
    pub grid: Grid,
}

/// A line of a section.
pub(crate) struct FaceLine {
    pub key: &'static str,
    pub value: Written,
    pub comment: &'static str,
}

impl FaceSection {
    /// The keys of the section.
    pub(crate) const KEYS: &[&str] = &["grid"];

    /// Reads what a section says over these values.
    pub(crate) fn read_over(&self, s: &Section<'_>, problems: &mut Problems) -> Option<Self> {
        let grid = match s.table.get("grid") {
            Some(node) => read_grid(node, &s.path_of("grid"), problems),
            None => Some(self.grid),
        };
        Some(Self { grid: grid? })
    }

    /// Returns its lines.
    pub(crate) fn lines(&self) -> Vec<FaceLine> {
        let grid = format!("[{}, {}]", self.grid.up, self.grid.across);
        vec![FaceLine {
            key: "grid",
            value: Written::toml(grid),
            comment: "points up the face and across it, edges included; [2, 2]: the corners. More points spread the pressure",
        }]
    }

    /// Returns the face, SI.
    pub(crate) fn resolve(&self) -> FaceProperties {
        FaceProperties { grid: self.grid }
    }
}

fn read_grid(node: &Node, path: &str, problems: &mut Problems) -> Option<Grid> {
    let count = |node: &Node| match node.value {
        Value::Number(value) if value.fract() == 0.0 && (2.0..=LARGEST_GRID as f64).contains(&value) => {
            Some(value as usize)
        }
        _ => None,
    };
    if let Value::List(items) = &node.value
        && let [up, across] = items.as_slice()
        && let (Some(up), Some(across)) = (count(up), count(across))
    {
        return Some(Grid { up, across });
    }
    let found = match &node.value {
        Value::List(_) => node.place.text().to_owned(),
        other => other.describe().to_owned(),
    };
    let message = format!("`{path}` is {found}; two whole numbers from 2 to {LARGEST_GRID} are expected");
    problems.push(
        Problem::new(message)
            .at(&node.place)
            .label("points up the face and across it")
            .help(format!("write for example {path} = [5, 5]")),
    );
    None
}
