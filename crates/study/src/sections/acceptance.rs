//! Limits of the deviations of a model, as data.
//!
//! ```toml
//! source = "agreed on 2026-03-01"     # where the limits are from
//! [accept.axle_1_left_vertical]       # a column
//! mean = "1000 lbf"                   # limit of the standard deviation, in the unit of the column
//! max = "2000 lbf"
//! rms = "500 lbf"
//! ```
//!
//! Rule: the standard deviation of the differences must be within the limit L, their mean within ⅔ L. The
//! rule is remembered (DynoTRAIN; EN 14363:2016): check it against your edition. No limit is built in.

use std::path::Path;

use input::file::{Expected, read_text};
use input::{FileType, limits, shortened};
use quantity::{Kind, Quantity, nearest};

use super::{Differences, SectionQuantity};
use crate::case::CaseError;
use crate::case::problem::{Problem, Problems, TomlLocation, TomlSource};
use crate::case::section::{self, CaseSection, Range};
use crate::case::tree::{self, NodeValue, TableNode, TreeNode};

/// The part of the limit of the standard deviation within which the mean must be (remembered).
pub const MEAN_SHARE: f64 = 2.0 / 3.0;

const SUBJECT: &str = "file of accepted differences";
const HELP: &str = "write source = \"...\", and for each column [accept.COLUMN] with mean, max, rms";

/// Limits of the standard deviations of differences, by column and quantity.
#[derive(Clone, Debug)]
pub struct Acceptance {
    /// Where they are from.
    pub source: String,
    columns: Vec<(String, TomlLocation, [Option<TreeNode>; 3])>,
}

/// Whether differences are accepted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SectionVerdict {
    /// Mean and standard deviation are within their limits.
    Accepted,
    /// The mean is too large.
    Mean,
    /// The standard deviation is too large.
    Deviation,
    /// Both are too large.
    Both,
}

impl SectionVerdict {
    /// Returns the verdict on differences with the limit of their standard deviation.
    #[must_use]
    pub fn of(differences: &Differences, limit: f64) -> Self {
        let mean = differences.mean.abs() <= MEAN_SHARE * limit;
        match (mean, differences.deviation <= limit) {
            (true, true) => Self::Accepted,
            (false, true) => Self::Mean,
            (true, false) => Self::Deviation,
            (false, false) => Self::Both,
        }
    }

    /// Returns it in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Accepted => "accepted",
            Self::Mean => "mean too large",
            Self::Deviation => "deviation too large",
            Self::Both => "mean and deviation too large",
        }
    }
}

impl Acceptance {
    /// Reads a file.
    ///
    /// # Errors
    /// It cannot be read, or something in it is wrong; all mistakes are reported together.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        let expected = Expected {
            what: SUBJECT,
            types: &[],
            most: limits::TEXT_FILE,
        };
        let text = read_text(path, &expected).map_err(|error| {
            let help = error.help().unwrap_or_else(|| HELP.to_owned());
            CaseError::from(Problem::new(error.to_string()).help(help))
        })?;
        let source = path.display().to_string();
        match FileType::of(text.as_bytes()) {
            Some(found) => {
                let message = format!("`{source}` is {}; a {SUBJECT} is expected", found.name());
                Err(Problem::new(message).help(HELP).into())
            }
            None => Self::parse(&source, &text),
        }
    }

    /// As from a file with this text, which `source` names in messages.
    ///
    /// # Errors
    /// Something in it is wrong.
    pub fn parse(source: &str, text: &str) -> Result<Self, CaseError> {
        let failed = |problems| CaseError::new(problems).of(SUBJECT);
        let tree = tree::parse(&TomlSource::new(source, text)).map_err(failed)?;
        let mut problems = Problems::new();
        let found = read_tree(&tree, &mut problems);
        found
            .filter(|_| problems.is_empty())
            .ok_or_else(|| failed(problems))
    }

    /// Returns the columns that have limits.
    pub fn columns(&self) -> impl Iterator<Item = &str> {
        self.columns.iter().map(|(name, ..)| name.as_str())
    }

    /// Returns the error of a column that the results do not have; `names` are those that they have.
    pub fn unknown<'n>(&self, column: &str, names: impl Iterator<Item = &'n str>) -> CaseError {
        let help = match nearest(column, names) {
            Some(near) => format!("did you mean `{near}`?"),
            None => "name a column that all results have, or use --map NAME=OTHER".to_owned(),
        };
        let message = format!("the results have no column `{}` in common", shortened(column));
        let problem = Problem::new(message).label("this column").help(help);
        let own = self.columns.iter().find(|(name, ..)| name == column);
        match own {
            Some((_, place, _)) => problem.at(place).into(),
            None => problem.into(),
        }
    }

    /// Returns the limit (SI) of the standard deviation of a column's quantity, which is of this kind; `None`
    /// if it has none.
    ///
    /// # Errors
    /// Its unit is that of another kind.
    pub fn limit(&self, column: &str, own: SectionQuantity, kind: Kind) -> Result<Option<f64>, CaseError> {
        let place = SectionQuantity::ALL.iter().position(|other| *other == own);
        let found = self.columns.iter().find(|(name, ..)| name == column);
        let (Some(place), Some((.., nodes))) = (place, found) else {
            return Ok(None);
        };
        let Some(node) = &nodes[place] else {
            return Ok(None);
        };
        if let (NodeValue::Number(value), Kind::Dimensionless | Kind::Count) = (&node.value, kind) {
            return Ok(Some(*value));
        }
        let mut problems = Problems::new();
        let path = format!("accept.{column}.{}", own.name());
        let read = section::quantity(node, &path, kind, Range::Positive, &mut problems);
        match read {
            Some(quantity) => Ok(Some(quantity.to_si())),
            None => Err(CaseError::new(problems).of(SUBJECT)),
        }
    }
}

fn read_tree(tree: &TableNode, problems: &mut Problems) -> Option<Acceptance> {
    let top = CaseSection {
        path: String::new(),
        table: tree,
        place: None,
    };
    top.allow_in(&["source", "accept"], &[], &format!("a {SUBJECT}"), problems);
    // Limits without a source are limits that nobody can check.
    let source = top.text("source", problems).map(|(text, _)| text.to_owned());
    top.require("accept", HELP, problems)?;
    let accept = top.section("accept", problems)?;
    let mut columns = Vec::new();
    for entry in &accept.table.entries {
        let Some(own) = accept.section(&entry.key, problems) else {
            continue;
        };
        let names = SectionQuantity::ALL.map(SectionQuantity::name);
        own.allow(&names, &[], problems);
        let nodes = names.map(|key| own.table.get(key).cloned());
        for (key, node) in names.iter().zip(&nodes) {
            if let Some(node) = node {
                check(node, &own.path_of(key), problems);
            }
        }
        if nodes.iter().all(Option::is_none) && problems.is_empty() {
            let message = format!("`{}` sets no limit", own.path);
            let problem = Problem::new(message).at(&entry.key_place).label("no limit");
            problems.push(problem.help("write mean, max or rms below it"));
        }
        columns.push((entry.key.clone(), entry.key_place.clone(), nodes));
    }
    if columns.is_empty() && problems.is_empty() {
        problems.push(Problem::new("no column has a limit").help(HELP));
    }
    Some(Acceptance {
        source: source?,
        columns,
    })
}

/// Notes a limit that is no number above zero, with or without unit.
fn check(node: &TreeNode, path: &str, problems: &mut Problems) {
    let (value, found) = match &node.value {
        NodeValue::Number(value) => (*value, value.to_string()),
        NodeValue::Text(text) => match Quantity::parse(text) {
            Ok(quantity) => (quantity.to_si(), shortened(text)),
            Err(error) => {
                let problem = Problem::new(format!("`{path}`: {error}")).at(&node.place);
                problems.push(problem.label("no quantity").help(error.help()));
                return;
            }
        },
        other => (f64::NAN, other.describe().to_owned()),
    };
    if !(value > 0.0 && value.is_finite()) {
        let message = format!("`{path}` is {found}; a limit above zero is expected");
        let problem = Problem::new(message).at(&node.place).label("a limit");
        problems.push(problem.help(format!(
            "write for example {path} = \"500 lbf\", or a pure number"
        )));
    }
}
