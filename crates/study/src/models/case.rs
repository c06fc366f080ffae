//! A case of any model.

use std::ops::ControlFlow;
use std::path::Path;
use std::sync::Arc;

use quantity::System as Units;

use super::{AnySummary, MODELS, built_in};
use crate::car::CarCase;
use crate::case::model::model;
use crate::case::problem::Problems;
use crate::case::{Case, CaseError, FieldSection, Tables, text_of, tree_with_overrides};
use crate::half_truck::HalfTruckCase;
use crate::measures::{self, Definitions, Judged, Unmeasured, half_truck};
use crate::metrics::Cycle;
use crate::result::RunResult;
use crate::run::{Run, RunCase, RunError};
use crate::truck::TruckCase;
use crate::vehicle::VehicleCase;

/// Declares [`AnyCase`], made of the case of each model.
macro_rules! any_case {
    ($($(#[$doc:meta])* $model:ident($case:ty) = $name:literal,)+) => {
        /// A case of any model, which its copies share.
        #[derive(Clone, Debug)]
        pub enum AnyCase {
            $($(#[$doc])* $model(Arc<$case>),)+
        }

        impl AnyCase {
            /// Returns the name of its model, as in [`MODELS`].
            #[must_use]
            pub fn model(&self) -> &'static str {
                match self {
                    $(Self::$model(_) => $name,)+
                }
            }
        }

        $(
            impl From<$case> for AnyCase {
                fn from(case: $case) -> Self {
                    Self::$model(Arc::new(case))
                }
            }
        )+
    };
}

any_case! {
    /// A wedge's.
    Wedge(Case) = "wedge",
    /// A half-truck's.
    HalfTruck(HalfTruckCase) = "half-truck",
    /// A truck's.
    Truck(TruckCase) = "truck",
    /// A car's.
    Car(CarCase) = "car",
    /// A vehicle's.
    Vehicle(VehicleCase) = "vehicle",
}

/// Does the same with the case of whatever model.
macro_rules! each {
    ($any:expr, $case:ident => $do:expr) => {
        match $any {
            AnyCase::Wedge($case) => $do,
            AnyCase::HalfTruck($case) => $do,
            AnyCase::Truck($case) => $do,
            AnyCase::Car($case) => $do,
            AnyCase::Vehicle($case) => $do,
        }
    };
}

impl AnyCase {
    /// Reads a case file of a wedge, of a truck (`model = "truck"`) or of a car (`model = "car"`) and lays
    /// `--set` overrides (`path.key=value`) over it.
    ///
    /// # Errors
    /// As [`Case::read`].
    pub fn read(path: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        let text = text_of(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&path.display().to_string(), &text, folder, overrides)
    }

    /// As [`AnyCase::read`], from a text, as [`Case::parse`].
    ///
    /// # Errors
    /// As [`Case::parse`].
    pub fn parse<'t>(
        source: &str,
        text: &str,
        tables: impl Into<Tables<'t>>,
        overrides: &[String],
    ) -> Result<Self, CaseError> {
        let (tree, problems) = tree_with_overrides(source, text, overrides)?;
        let named = model(&tree, &mut Problems::new());
        let mut files = MODELS.iter().filter_map(|model| model.case_files.as_ref());
        match files.find(|files| Some(files.model) == named) {
            Some(files) => (files.read)(tree, source, tables.into(), problems),
            // Says that there is no such model.
            None => Ok(Case::of_tree(tree, source, tables.into(), problems)?.into()),
        }
    }

    /// Returns the built-in case of this name, of a wedge, a truck or a car; `None` if there is none.
    ///
    /// # Errors
    /// An override is wrong.
    pub fn built_in(name: &str, overrides: &[String]) -> Result<Option<Self>, CaseError> {
        let Some(own) = built_in(name) else {
            return Ok(None);
        };
        Self::parse(
            &format!("{}.toml", own.name),
            own.text(),
            Path::new(""),
            overrides,
        )
        .map(Some)
    }

    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        each!(self, case => &case.name)
    }

    /// Returns the units of its results.
    #[must_use]
    pub fn units(&self) -> Units {
        each!(self, case => RunCase::units(&**case))
    }

    /// Returns the end of its run and the time between two rows, s.
    #[must_use]
    pub fn duration_and_interval(&self) -> [f64; 2] {
        each!(self, case => case.duration_and_interval())
    }

    /// Runs it to its end.
    ///
    /// # Errors
    /// The run cannot begin.
    pub fn run(&self) -> Result<RunResult<AnySummary>, RunError> {
        self.run_while(|_| ControlFlow::Continue(()))
    }

    /// Runs it as [`Run::finish_while`].
    ///
    /// # Errors
    /// The run cannot begin.
    pub fn run_while(
        &self,
        progress: impl FnMut(f64) -> ControlFlow<String>,
    ) -> Result<RunResult<AnySummary>, RunError> {
        each!(self, case => Ok(Run::new(&**case)?.finish_while(progress).with_summary(Into::into)))
    }

    /// Returns the cycle of its vertical motion, if that is one sine or triangle.
    #[must_use]
    pub fn cycle(&self) -> Option<Cycle> {
        match self {
            Self::Wedge(case) => Cycle::of(&case.parameters),
            Self::HalfTruck(case) => crate::half_truck::run::cycle(case),
            Self::Truck(case) => Cycle::of_motion(&case.parameters.bolster.motion.coordinates[2]),
            Self::Car(_) | Self::Vehicle(_) => None,
        }
    }

    /// Returns the wedge's case, if it is one.
    #[must_use]
    pub fn wedge(&self) -> Option<&Case> {
        match self {
            Self::Wedge(case) => Some(case),
            _ => None,
        }
    }

    /// Returns its fields as its case file has them; none of a half-truck, which is made of other files.
    #[must_use]
    pub fn fields(&self) -> Vec<FieldSection> {
        match self {
            Self::Wedge(case) => case.fields().to_vec(),
            Self::HalfTruck(_) => Vec::new(),
            Self::Truck(case) => case.fields().to_vec(),
            Self::Car(case) => case.fields().to_vec(),
            Self::Vehicle(case) => case.fields().to_vec(),
        }
    }

    /// Returns the whole case as a commented case file, with the points of tables from other files in it;
    /// `None` of a half-truck, which is made of other files.
    #[must_use]
    pub fn to_toml(&self) -> Option<String> {
        match self {
            Self::Wedge(case) => Some(case.to_toml_embedded().to_owned()),
            Self::HalfTruck(_) => None,
            Self::Truck(case) => Some(case.to_toml_embedded().to_owned()),
            Self::Car(case) => Some(case.to_toml_embedded().to_owned()),
            Self::Vehicle(case) => Some(case.to_toml_embedded().to_owned()),
        }
    }

    /// Returns the measures that a study keeps of its runs.
    #[must_use]
    pub fn definitions(&self) -> Definitions {
        match self {
            Self::Wedge(_) => measures::of_wedges().clone(),
            Self::HalfTruck(case) => half_truck::definitions(case),
            Self::Truck(_) => measures::truck::definitions(),
            Self::Car(_) => measures::car::definitions(),
            Self::Vehicle(case) => measures::vehicle::definitions(case),
        }
    }

    /// Runs it, measures it, and judges whether the measures mean something.
    ///
    /// # Errors
    /// The run cannot begin or does not come to its end.
    pub fn judge(&self) -> Result<Judged, Unmeasured> {
        match self {
            Self::Wedge(case) => measures::judge(case),
            Self::HalfTruck(case) => half_truck::judge(case),
            Self::Truck(case) => measures::truck::judge(case),
            Self::Car(case) => measures::car::judge(case),
            Self::Vehicle(case) => measures::vehicle::judge(case),
        }
    }
}
