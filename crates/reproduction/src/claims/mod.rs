//! The claims: what chapters 5 to 7 of Steets (2007) say of the stand-alone runs, each with a predicate and a
//! verdict.
//!
//! One row per statement that can be decided from the twelve runs: where it stands, what it says (in our
//! words), the predicate in words and as the code that is compiled, the values found, the verdict. Statements
//! about the runs that they cannot decide have a row too, with the reason. A verdict "does not hold" is a
//! finding: a sentence says why, as far as the runs tell. Statements that compare with the comparison program
//! have a group of their own; they need runs of the half-truck ([`Evidence::with_trucks`]), and are decided
//! from our reading of its wedges.
//!
//! Words that have a number here, wherever the thesis gives none: *small*, *similar*, *close*: within 10 %;
//! *large* differences: more than 10 %; *very small*: below 5 %; *close to zero* of a ringing force: below 5
//! % of the run's peak; *zero*: below 1 % of the peak, or as the row says; a moment is *negligible* below 1 %
//! of what the face could give with its whole peak load on one edge. Where moments are *small* in one place
//! and *significant* in another, nothing in the thesis tells them apart, and the statements are undecidable.
//!
//! Verdicts are those of the runs as they are: friction keeps what the start does for seconds, and with
//! `start = "touching"` some dozen orders that are close (mostly those with yaw) come out the other way. In
//! which part of all that is open a statement holds, says [`crate::sensitivity`]. What counts peaks or
//! measures roughness depends on the rows' spacing; the thesis's is that of the built-in cases, 0.01 s.
//!
//! Forces of chapter 5 are those that its figures draw: the vertical force on the side frame with the coil's
//! part. Those of chapter 6 are the column friction.

mod comparison;
mod conclusions;
mod constant;
mod constant_yawed;
mod contradictions;
mod curved_slope;
mod evidence;
mod measures;
mod variable;
mod variable_yawed;
mod words;

use std::io::{self, Write};

use report::summary::write_json;
use serde::Serialize;
use study::half_truck::catalog::{CatalogEntry, ToeCase, YawCase};
use study::summary::SummaryValue;

pub use contradictions::{CONTRADICTIONS, Contradiction};
pub use curved_slope::curved_slope_runs;
pub use evidence::{ClaimFinding, ClaimVerdict, Evidence, NotedValue, RunId, SlopeShape, Toe};

/// Version of the structure of [`ClaimRow`], for files.
pub const SCHEMA: &str = "wedgelab.claims/1";

/// The group to which a claim belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ClaimGroup {
    /// Section 5.1.
    Variable,
    /// Section 5.2.
    VariableYawed,
    /// Section 6.1.
    Constant,
    /// Section 6.2.
    ConstantYawed,
    /// Chapter 7.
    Conclusions,
    /// Comparisons with the comparison program, of all chapters.
    Comparison,
}

impl ClaimGroup {
    /// All groups, in order.
    pub const ALL: [Self; 6] = [
        Self::Variable,
        Self::VariableYawed,
        Self::Constant,
        Self::ConstantYawed,
        Self::Conclusions,
        Self::Comparison,
    ];

    /// Returns a heading.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Variable => "Variable damping (section 5.1)",
            Self::VariableYawed => "Variable damping, bolster yawed (section 5.2)",
            Self::Constant => "Constant damping (section 6.1)",
            Self::ConstantYawed => "Constant damping, bolster yawed (section 6.2)",
            Self::Conclusions => "Conclusions (chapter 7)",
            Self::Comparison => "Against the comparison program's wedges, as we read them",
        }
    }
}

/// A statement of the thesis with what decides it.
#[derive(Clone, Debug)]
pub struct Claim {
    /// A short name that stays, such as `5.1-ringing-about-zero`.
    pub id: &'static str,
    /// The group to which it belongs.
    pub group: ClaimGroup,
    /// Its place in the thesis.
    pub place: &'static str,
    /// The statement in our words.
    pub statement: &'static str,
    /// The predicate in words, with its numbers.
    pub predicate: &'static str,
    /// The predicate as it is compiled; empty for a claim that the runs cannot decide.
    pub code: &'static str,
    /// Evaluates the predicate.
    pub evaluate: fn(&Evidence<'_>) -> ClaimFinding,
    /// The reason if it does not hold in the thesis's runs as computed here; `None` if it does.
    pub why_not: Option<&'static str>,
}

/// A claim with its verdict, ready to be shown or written.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ClaimRow {
    /// [`Claim::id`].
    pub id: &'static str,
    /// [`Claim::group`].
    pub group: ClaimGroup,
    /// [`Claim::place`].
    pub place: &'static str,
    /// [`Claim::statement`].
    pub statement: &'static str,
    /// [`Claim::predicate`].
    pub predicate: &'static str,
    /// [`Claim::code`], on one line.
    pub code: String,
    /// The verdict.
    pub verdict: ClaimVerdict,
    /// The values found, in the runs' units.
    pub values: Vec<ShownValue>,
    /// The reason if it does not hold or cannot be decided, else empty.
    pub note: String,
}

/// A value found, with its unit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ShownValue {
    /// Run and quantity of the value.
    pub label: String,
    /// The value and its unit.
    #[serde(flatten)]
    pub measure: SummaryValue,
}

/// All verdicts, as they are written into a file.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Claims {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// Number of those that hold.
    pub hold: usize,
    /// Number of those that do not hold.
    pub do_not: usize,
    /// Number of those that cannot be decided.
    pub undecided: usize,
    /// The claims in the order of the thesis.
    pub claims: Vec<ClaimRow>,
}

impl Claims {
    /// Counts rows.
    #[must_use]
    pub fn of(claims: Vec<ClaimRow>) -> Self {
        let count = |verdict| claims.iter().filter(|row| row.verdict == verdict).count();
        Self {
            schema: SCHEMA,
            hold: count(ClaimVerdict::Holds),
            do_not: count(ClaimVerdict::DoesNot),
            undecided: count(ClaimVerdict::CannotBeDecided),
            claims,
        }
    }
}

/// The name of the claims' file.
pub const FILE_NAME: &str = report::run_folder::REPRODUCTION_FILE;

/// Writes all verdicts as JSON.
///
/// # Errors
/// The writer's.
pub fn write(claims: &Claims, out: &mut dyn Write) -> io::Result<()> {
    write_json(claims, out)
}

/// The statements that a wedge like the thesis's must show: orders by toe that the text states and that
/// statics explain, lift-off and its silence, stick at the reversal, no lateral force.
pub const REQUIRED: [&str; 13] = [
    "6.1-toe-order-up",
    "6.1-toe-order-down",
    "5.1-toe-order-down",
    "5.1-lift-off-after-3-s",
    "5.1-no-dissipation-in-lift-off",
    "7.1-no-dissipation-in-lift-off",
    "5.1-rings-about-zero-any-toe",
    "5.1-stick-gives-largest-force",
    "6.1-never-lifts-off",
    "6.1-no-dissipation-only-sticking",
    "5.1-small-yaw-moment",
    "6.1-yaw-moment-negligible",
    "7.1-no-lateral-force",
];

/// Returns all claims, in the order of the thesis.
pub fn claims() -> impl Iterator<Item = &'static Claim> {
    [
        variable::CLAIMS,
        variable_yawed::CLAIMS,
        constant::CLAIMS,
        constant_yawed::CLAIMS,
        conclusions::CLAIMS,
        comparison::CLAIMS,
    ]
    .into_iter()
    .flatten()
}

/// The text on a claim that comes out otherwise than when its reasons were found.
const NOT_LOOKED_INTO: &str =
    "Why is not known: with the thesis's twelve runs as this program makes them it holds.";

/// Returns all claims with their verdicts, in the order of the thesis. Runs that are missing or incomplete
/// leave the claims that need them undecided.
#[must_use]
pub fn evaluate(evidence: &Evidence<'_>) -> Vec<ClaimRow> {
    let units = evidence.units();
    claims()
        .map(|claim| {
            let finding = (claim.evaluate)(evidence);
            ClaimRow {
                id: claim.id,
                group: claim.group,
                place: claim.place,
                statement: claim.statement,
                predicate: claim.predicate,
                code: on_one_line(claim.code),
                verdict: finding.verdict,
                values: finding
                    .values
                    .into_iter()
                    .filter(|found| !found.value.is_nan())
                    .map(|found| ShownValue {
                        label: found.label,
                        measure: SummaryValue::new(found.value, found.kind, units),
                    })
                    .collect(),
                note: match finding.verdict {
                    ClaimVerdict::Holds => String::new(),
                    ClaimVerdict::DoesNot => claim.why_not.unwrap_or(NOT_LOOKED_INTO).to_owned(),
                    ClaimVerdict::CannotBeDecided => finding.undecided,
                },
            }
        })
        .collect()
}

/// Returns whether claims are decided from this run of the half-truck: toe out, without yaw or yawed as
/// intended.
#[must_use]
pub fn needs_truck(entry: &CatalogEntry) -> bool {
    entry.toe == ToeCase::Out && entry.yaw != YawCase::Printed
}

/// Returns the verdicts on all claims, in the order of the thesis: what [`evaluate`] finds, without its
/// words.
#[must_use]
pub fn verdicts(evidence: &Evidence<'_>) -> Vec<ClaimVerdict> {
    claims().map(|claim| (claim.evaluate)(evidence).verdict).collect()
}

/// Code without the line breaks of its layout.
fn on_one_line(code: &str) -> String {
    let words: Vec<&str> = code.split_whitespace().collect();
    words
        .join(" ")
        .replace("( ", "(")
        .replace("[ ", "[")
        .replace(", )", ")")
        .replace(",)", ")")
        .replace(", ]", "]")
        .replace(",]", "]")
}

/// A claim whose predicate is compiled and shown from the same words. `runs` names the runs that it needs; in
/// `holds` they are what [`evidence::ClaimView`] shows of them.
macro_rules! claim {
    (
        id: $id:literal,
        group: $group:ident,
        place: $place:literal,
        says: $says:literal,
        test: $test:literal,
        runs: [$($run:ident),+ $(,)?],
        holds: $holds:expr
        $(, but: $but:literal)? $(,)?
    ) => {
        $crate::claims::Claim {
            id: $id,
            group: $crate::claims::ClaimGroup::$group,
            place: $place,
            statement: $says,
            predicate: $test,
            code: stringify!($holds),
            evaluate: |evidence| {
                $crate::claims::evidence::decide(
                    evidence,
                    [$($crate::claims::evidence::runs::$run),+],
                    |[$($run),+]| $holds,
                )
            },
            why_not: $crate::claims::because!($($but)?),
        }
    };
}

/// The reason, if there is one.
macro_rules! because {
    () => {
        None
    };
    ($why:literal) => {
        Some($why)
    };
}

/// A statement about the runs that they cannot decide.
macro_rules! undecidable {
    (
        id: $id:literal,
        group: $group:ident,
        place: $place:literal,
        says: $says:literal,
        reason: $reason:literal $(,)?
    ) => {
        $crate::claims::Claim {
            id: $id,
            group: $crate::claims::ClaimGroup::$group,
            place: $place,
            statement: $says,
            predicate: "none: nothing in the runs decides it",
            code: "",
            evaluate: |_| $crate::claims::ClaimFinding::undecided($reason),
            why_not: None,
        }
    };
}

use {because, claim, undecidable};
