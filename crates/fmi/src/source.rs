//! The source of an FMU, its model, and the files in its resources.

use std::path::Path;

use study::car::CarCase;
use study::case::{Case, Tables};
use study::packed::PackedFile;
use study::run::RunCase;
use study::truck::TruckCase;
use study::vehicle::VehicleCase;

use crate::car::CarModel;
use crate::element::{Element, Entries, Setting};
use crate::half_truck::{HalfTruck, HalfTruckModel};
use crate::quasi_static::QuasiStaticModel;
use crate::tables::{TablesModel, TablesOrigin};
use crate::three_piece::ThreePieceTruckModel;
use crate::truck::TruckModel;
use crate::vehicle::VehicleModel;
use crate::wedge::WedgeModel;
use crate::{Error, limits};

/// The file with the case.
pub const CASE: &str = "case.toml";

/// The quantities of a model, and under a setting what has them, at its start.
pub(crate) type Made = (Entries, Option<Box<dyn Element>>);

/// A model of which FMUs are made.
pub(crate) trait Model {
    /// What it is made of.
    type Origin: Origin;

    /// Its name: of the model, and of the library in an FMU.
    const NAME: &'static str;
    /// The description, one line.
    const TEXT: &'static str;
    /// Its frames and signs, in a few sentences.
    const CONVENTIONS: &'static str;
    /// Whether it gives directional derivatives.
    const HAS_DERIVATIVES: bool = false;

    /// Returns all quantities; and the element under a setting, if one is given.
    ///
    /// # Errors
    /// Nothing of this model can be made of it, values are not admissible, or it cannot start from them.
    fn made(origin: &Self::Origin, setting: Option<&Setting>) -> Result<Made, Error>;
}

/// A case or a run of which FMUs are made.
pub(crate) trait Origin: Sized {
    /// What is run.
    type Case: RunCase;

    /// What it is called.
    const WORD: &'static str = "case";
    /// The file that holds it, and the most bytes of this.
    const FILE: (&'static str, u64) = (CASE, limits::TEXT_FILE);

    /// Returns what is run, and its title.
    fn case(&self) -> (&Self::Case, &str);
    /// Returns the text of its file; and the files that this names.
    fn packed(&self) -> (String, Vec<PackedFile>);
    /// Reads the text of its file in a folder.
    ///
    /// # Errors
    /// It is damaged.
    fn parse(text: &str, folder: &Path) -> Result<Self, Error>;
}

/// Makes cases origins: how each is packed, and where it looks for files.
macro_rules! cases {
    ($($case:ty: $packed:expr, $tables:expr;)+) => {$(
        impl Origin for $case {
            type Case = Self;

            fn case(&self) -> (&Self, &str) {
                (self, &self.title)
            }

            fn packed(&self) -> (String, Vec<PackedFile>) {
                $packed(self)
            }

            fn parse(text: &str, folder: &Path) -> Result<Self, Error> {
                let case = Self::parse(CASE, text, $tables(folder), &[]);
                case.map_err(|error| Error::new(format!("the FMU's {CASE} is damaged: {error}")))
            }
        }
    )+};
}

cases! {
    Case: |case: &Self| (case.to_toml_embedded().to_owned(), Vec::new()), Tables::from;
    TruckCase: |case: &Self| (case.to_toml_embedded().to_owned(), Vec::new()), Tables::from;
    VehicleCase: VehicleCase::packed, Tables::below;
    CarCase: CarCase::packed, Tables::below;
}

/// Declares the models: for each what it is made of, and the type that says all else.
macro_rules! models {
    ($($(#[$doc:meta])* $model:ident($origin:ty) = $own:ty,)+) => {
        /// The element that an FMU holds.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum FmuModel {
            $($(#[$doc])* $model,)+
        }

        impl FmuModel {
            const ALL: &'static [Self] = &[$(Self::$model,)+];

            /// Returns its name: of the model, and of the library in an FMU.
            #[must_use]
            pub fn name(self) -> &'static str {
                match self { $(Self::$model => <$own as Model>::NAME,)+ }
            }

            /// Returns whether it gives directional derivatives.
            #[must_use]
            pub fn has_derivatives(self) -> bool {
                match self { $(Self::$model => <$own as Model>::HAS_DERIVATIVES,)+ }
            }

            /// Returns what it is made of: `case` or `run`.
            #[must_use]
            pub fn origin(self) -> &'static str {
                match self { $(Self::$model => <$origin as Origin>::WORD,)+ }
            }

            /// The description, one line.
            pub(crate) fn text(self) -> &'static str {
                match self { $(Self::$model => <$own as Model>::TEXT,)+ }
            }

            /// Returns its frames and signs, in a few sentences.
            pub(crate) fn conventions(self) -> &'static str {
                match self { $(Self::$model => <$own as Model>::CONVENTIONS,)+ }
            }

            /// Returns the source in a folder; `read` gives the text of a file of at most so many bytes.
            pub(crate) fn source(
                self,
                folder: &Path,
                read: impl Fn(&str, u64) -> Result<String, Error>,
            ) -> Result<Source, Error> {
                match self {
                    $(Self::$model => {
                        let (file, most) = <$origin as Origin>::FILE;
                        let origin = <$origin as Origin>::parse(&read(file, most)?, folder)?;
                        Ok(Source::$model(Box::new(origin)))
                    })+
                }
            }
        }

        /// The source of an FMU.
        #[derive(Clone, Debug)]
        pub enum Source {
            $($(#[$doc])* $model(Box<$origin>),)+
        }

        impl Source {
            /// Returns which model it is.
            #[must_use]
            pub fn model(&self) -> FmuModel {
                match self { $(Self::$model(_) => FmuModel::$model,)+ }
            }

            fn head(&self) -> ([&str; 2], [f64; 2]) {
                match self { $(Self::$model(origin) => head(&**origin),)+ }
            }

            fn packed(&self) -> (&'static str, String, Vec<PackedFile>) {
                match self { $(Self::$model(origin) => packed(&**origin),)+ }
            }

            fn made(&self, setting: Option<&Setting>) -> Result<Made, Error> {
                match self { $(Self::$model(origin) => <$own as Model>::made(origin, setting),)+ }
            }
        }
    };
}

models! {
    /// The wedge with mass.
    Wedge(Case) = WedgeModel,
    /// The quasi-static wedge.
    QuasiStatic(Case) = QuasiStaticModel,
    /// A half-truck without its wedges, with room for those of the case.
    Truck(Case) = TruckModel,
    /// A half-truck with its wedges.
    HalfTruck(HalfTruck) = HalfTruckModel,
    /// A three-piece truck with wedge bodies.
    ThreePieceTruck(TruckCase) = ThreePieceTruckModel,
    /// A freight car on its track.
    Car(CarCase) = CarModel,
    /// A vehicle of bodies and elements.
    Vehicle(VehicleCase) = VehicleModel,
    /// Tables of a nest.
    NestTables(TablesOrigin) = TablesModel,
}

/// Returns name and title, and length (s) and tolerance of the default experiment.
fn head(origin: &impl Origin) -> ([&str; 2], [f64; 2]) {
    let (case, title) = origin.case();
    let [duration, _] = case.duration_and_interval();
    (
        [case.name(), title],
        [duration, case.options().relative_tolerance],
    )
}

/// Returns name and text of the file that holds it, and the files that this names.
fn packed<O: Origin>(origin: &O) -> (&'static str, String, Vec<PackedFile>) {
    let (text, named) = origin.packed();
    (O::FILE.0, text, named)
}

impl FmuModel {
    /// Returns the model of this name.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|model| model.name() == name)
    }
}

impl Source {
    /// Returns a model that is made of a case; none if the model is made of something else.
    #[must_use]
    pub fn of_case(model: FmuModel, case: Case) -> Option<Self> {
        let case = Box::new(case);
        match model {
            FmuModel::Wedge => Some(Self::Wedge(case)),
            FmuModel::QuasiStatic => Some(Self::QuasiStatic(case)),
            FmuModel::Truck => Some(Self::Truck(case)),
            _ => None,
        }
    }

    /// Returns name and title.
    #[must_use]
    pub fn name_and_title(&self) -> [&str; 2] {
        self.head().0
    }

    /// Returns length (s) and tolerance of the default experiment.
    #[must_use]
    pub fn experiment(&self) -> [f64; 2] {
        self.head().1
    }

    /// Returns name and bytes of the files that say what it is made of: the case or run first, then the
    /// profiles and measured tables of a car or a vehicle.
    ///
    /// # Errors
    /// A profile or a table can no longer be read.
    pub fn files(&self) -> Result<Vec<(String, Vec<u8>)>, Error> {
        let (file, text, named) = self.packed();
        let mut files = vec![(file.to_owned(), text.into_bytes())];
        for file in named {
            let bytes = limits::read(&file.path, limits::TEXT_FILE)?;
            files.push((file.name.clone(), file.content(bytes)));
        }
        Ok(files)
    }

    /// Returns all quantities.
    ///
    /// # Errors
    /// Nothing of this model can be made of it.
    pub fn entries(&self) -> Result<Entries, Error> {
        Ok(self.made(None)?.0)
    }

    /// Returns the element under these settings, at its start; `entries` are those of the description.
    ///
    /// # Errors
    /// Values that are not admissible, or from which it cannot start.
    pub fn element(&self, entries: &Entries, setting: &Setting) -> Result<Box<dyn Element>, Error> {
        let (own, element) = self.made(Some(setting))?;
        let (found, described) = (own.states.len(), entries.states.len());
        if found != described {
            return Err(Error::new(format!(
                "with these parameters it has {found} states, but the FMU was made with {described}: a \
                 damping that was zero stays zero, and one that was not stays so; export another FMU"
            )));
        }
        element.ok_or_else(|| Error::new(format!("{} has no element", self.model().name())))
    }
}
