//! Studies: many variants of one case.
//!
//! A [`Study`] is a document (`STUDY.toml`, see `docs/study.md`) that numbers its variants from zero: which
//! values variant `i` has is a function of the document and of `i` alone, so that any number of workers, on
//! one machine or many, may compute any part of it in any order. What comes out of a variant is a
//! [record](crate::records).

mod factor;
mod latin_hypercube;
mod random;
mod read;
mod sobol;
mod values;

use std::fmt;
use std::path::{Path, PathBuf};

use quantity::System as Units;
use serde::{Deserialize, Serialize};

pub use factor::{Factor, Group, Levels, Value};
pub use latin_hypercube::LatinHypercube;
pub use sobol::{DIMENSIONS, Sobol};

pub(crate) use random::mix;
pub(crate) use read::{below, case_source, settings, value};

use crate::case::CaseError;
use crate::measures::Definitions;
use crate::models::{AnyCase, CaseSource};

/// Version of what a study computes: it grows when the same document gives another table.
pub const STUDY_VERSION: u32 = 5;

/// Studies of more runs than this are begun only if the user says so.
pub const MANY: u64 = 1_000_000;

/// The sampling of variants.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Sampling {
    /// Every value of every parameter with every other; the last parameter changes fastest.
    FullFactorial,
    /// Each parameter's range cut into as many parts as there are runs, each part taken once.
    LatinHypercube {
        /// Number of runs.
        runs: u64,
        /// The seed of the hypercube.
        seed: u64,
    },
    /// The first points of the Sobol' sequence.
    Sobol {
        /// Number of runs.
        runs: u64,
        /// The seed of the random shift; without one, the sequence as it is.
        seed: Option<u64>,
    },
    /// As written down, one after the other.
    List,
}

/// The accuracy of the integration of runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Accuracy {
    /// As the case says.
    Case,
    /// Looser than the thesis's cases are: see [`ENGINEERING`].
    Engineering,
}

/// The settings of [`Accuracy::Engineering`], unless the study sets it itself. In the six yawed cases of the
/// thesis branch forces and energies per cycle at the side frame are within 0.5 % of those at 1e-8. Over wide
/// ranges of parameters nine of ten variants are. Wedges that rattle for as long as they run lose that
/// rattling: 12 % of a branch force in two of the thesis's runs without yaw.
pub const ENGINEERING: [&str; 2] = [
    "simulation.method=\"tr-bdf2\"",
    "simulation.relative_tolerance=1.5e-5",
];

/// A study: a case and its variants.
#[derive(Clone, Debug)]
pub struct Study {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people; may be empty.
    pub title: String,
    /// The sampling of variants.
    pub sampling: Sampling,
    /// The accuracy of the integration of runs.
    pub accuracy: Accuracy,
    /// The varied parameters.
    pub factors: Vec<Factor>,
    /// Values that hold for all variants, as `--set` takes them.
    pub set: Vec<String>,
    /// The case without any variation.
    pub base: AnyCase,
    measures: Definitions,
    /// The values of a list: for each variant those of the factors, as far as it has them.
    list: Vec<Vec<Option<Value>>>,
    source: StudySource,
    count: u64,
}

/// The texts that a study was read from: what another program needs to compute a part of it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StudySource {
    /// The study file's name.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Its folder.
    pub folder: PathBuf,
    /// The case that is varied.
    pub case: CaseSource,
}

/// The values that decide the results of a study; two studies with the same description have the same table.
#[derive(Clone, Debug, Serialize)]
pub struct Description<'s> {
    /// [`STUDY_VERSION`].
    pub version: u32,
    /// The program and its version.
    pub program: String,
    /// Number of variants.
    pub runs: u64,
    /// Their sampling.
    pub sampling: &'s Sampling,
    /// The accuracy of their integration.
    pub accuracy: Accuracy,
    /// The varied parameters.
    pub factors: &'s [Factor],
    /// The values of a list.
    #[serde(skip_serializing_if = "<[_]>::is_empty")]
    pub list: &'s [Vec<Option<Value>>],
    /// Values for all variants.
    pub set: &'s [String],
    /// The case, completed, as a case file.
    pub case: String,
}

impl Study {
    /// Reads a study file.
    ///
    /// # Errors
    /// It cannot be read, or something in it or in its case is wrong; all mistakes are reported together.
    pub fn read(path: &Path) -> Result<Self, CaseError> {
        read::file(path)
    }

    /// As [`Study::read`], from a text. `source` names it in messages; the case is looked for in `folder`.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn parse(source: &str, text: &str, folder: &Path) -> Result<Self, CaseError> {
        read::text(source, text, folder, None)
    }

    /// Returns the same study from its texts, on this machine or another. Tables in files of their own are
    /// looked for where they were.
    ///
    /// # Errors
    /// As [`Study::read`].
    pub fn of_source(source: StudySource) -> Result<Self, CaseError> {
        read::text(&source.name, &source.text, &source.folder, Some(source.case))
    }

    /// Returns the texts that it was read from.
    #[must_use]
    pub fn source(&self) -> &StudySource {
        &self.source
    }

    /// Number of variants.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.count
    }

    /// Units of the table.
    #[must_use]
    pub fn units(&self) -> Units {
        self.base.units()
    }

    /// Returns the values of the variant of this number, below [`Study::count`]: one a factor, `None` where a
    /// list leaves the case's own.
    #[must_use]
    pub fn values(&self, number: u64) -> Vec<Option<Value>> {
        values::of(self, number)
    }

    /// Returns the settings over the case for the variant of this number, as `--set` takes them.
    #[must_use]
    pub fn overrides(&self, number: u64) -> Vec<String> {
        let values = self.values(number);
        let varied = self.factors.iter().zip(&values);
        let varied = varied.flat_map(|(factor, value)| {
            let own = value.as_ref().map(|value| factor.overrides(value));
            own.unwrap_or_default()
        });
        self.everywhere().chain(varied).collect()
    }

    /// Returns the case of the variant of this number.
    ///
    /// # Errors
    /// Its values do not go together.
    pub fn case(&self, number: u64) -> Result<AnyCase, CaseError> {
        self.source.case.case(&self.overrides(number))
    }

    /// Returns the measures that are kept of each variant.
    #[must_use]
    pub fn measures(&self) -> &Definitions {
        &self.measures
    }

    /// Returns the text of everything that decides its results.
    #[must_use]
    pub fn description(&self) -> Description<'_> {
        Description {
            version: STUDY_VERSION,
            program: format!("wedgelab {}", env!("CARGO_PKG_VERSION")),
            runs: self.count,
            sampling: &self.sampling,
            accuracy: self.accuracy,
            factors: &self.factors,
            list: &self.list,
            set: &self.set,
            case: self.source.case.description(&self.base),
        }
    }

    /// Returns the description in short: other studies have another number, as good as certainly.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        fingerprint(&self.description())
    }

    fn everywhere(&self) -> impl Iterator<Item = String> {
        accuracy_overrides(self.accuracy).chain(self.set.clone())
    }
}

/// Returns the hash of a description: FNV-1a over its text, whose floating-point numbers are written so that
/// they read back.
pub(crate) fn fingerprint(description: &impl fmt::Debug) -> u64 {
    let text = format!("{description:?}");
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Returns the settings of an accuracy.
fn accuracy_overrides(accuracy: Accuracy) -> impl Iterator<Item = String> {
    let set: &[&str] = match accuracy {
        Accuracy::Case => &[],
        Accuracy::Engineering => &ENGINEERING,
    };
    set.iter().map(|text| (*text).to_owned())
}
