//! The source of an FMU, its model, and the files in its resources.

use study::car::CarCase;
use study::case::Case;
use study::truck::TruckCase;
use study::vehicle::VehicleCase;

use crate::Error;
use crate::element::{Element, Entries, Setting};
use crate::half_truck::{self, HalfTruck};
use crate::quasi_static::QuasiStaticElement;
use crate::{car, limits, quasi_static, three_piece, truck, vehicle, wedge};

/// The file with the case.
pub const CASE: &str = "case.toml";

/// The element that an FMU holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FmuModel {
    /// The wedge with mass.
    Wedge,
    /// The quasi-static wedge.
    QuasiStatic,
    /// A half-truck without its wedges.
    Truck,
    /// A half-truck with its wedges.
    HalfTruck,
    /// A three-piece truck with wedge bodies.
    ThreePieceTruck,
    /// A freight car on its track.
    Car,
    /// A vehicle of bodies and elements.
    Vehicle,
}

impl FmuModel {
    /// Returns its name: of the model, and of the library in an FMU.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Wedge => "FrictionWedge",
            Self::QuasiStatic => "FrictionWedgeQS",
            Self::Truck => "FrictionTruck",
            Self::HalfTruck => "HalfTruck",
            Self::ThreePieceTruck => "ThreePieceTruck",
            Self::Car => "FreightCar",
            Self::Vehicle => "Vehicle",
        }
    }

    /// Returns whether it gives directional derivatives.
    #[must_use]
    pub fn has_derivatives(self) -> bool {
        matches!(self, Self::Wedge | Self::QuasiStatic)
    }

    /// The description, one line.
    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::Wedge => {
                "Friction wedge of a three-piece truck between bolster and side frame: rigid body with \
                 mass, unilateral contact at eight corners, stick-slip friction"
            }
            Self::QuasiStatic => {
                "Friction wedge of a three-piece truck between bolster and side frame: quasi-static, \
                 without mass"
            }
            Self::Truck => {
                "Loaded half of a three-piece truck without its four friction wedges: half a car on a \
                 bolster, side frames, springs"
            }
            Self::ThreePieceTruck => {
                "Three-piece truck with four friction wedges that have mass: bolster, side frames, coils, \
                 stops, adapters"
            }
            Self::Car => {
                "Freight car on its track: body and lading on two three-piece trucks with friction wedges, \
                 whose wheelsets roll on rails"
            }
            Self::Vehicle => "Vehicle of rigid bodies and force elements that its case names",
            Self::HalfTruck => {
                "Loaded half of a three-piece truck from files of NUCARS: half a car on a bolster, friction \
                 wedges, side frames, springs"
            }
        }
    }

    /// Returns its frames and signs, in a few sentences.
    pub(crate) fn conventions(self) -> &'static str {
        match self {
            Self::Wedge | Self::QuasiStatic => {
                "Fixed frame: x longitudinal, positive from the column towards the bolster; y lateral; z \
                 up. Angles turn by R = Ry(pitch) Rz(yaw) Rx(roll). Forces act on the named neighbour, \
                 along the fixed axes; moments are taken about the neighbour's turning center, the point \
                 whose displacements are the inputs."
            }
            Self::Truck => {
                "Axes: x forward, y left, z up; displacements from the drawn position, small angles. \
                 Quantities of a wedge are in the axes of that wedge, which has x from the column towards \
                 the bolster."
            }
            Self::ThreePieceTruck => {
                "Axes: x forward, y left, z up from the top of rail, origin at the truck's center; \
                 displacements of centers of gravity from the nominal (loaded) layout. Angles turn by R = \
                 Ry(pitch) Rz(yaw) Rx(roll). The warp moment acts on the bolster."
            }
            Self::Car => {
                "Fixed axes: x forward and y left where the track starts, z up. Vertical wheel forces act on \
                 the rail, positive down; lateral ones are positive where they spread the gauge. Places of \
                 axles are those against the track's center line, positive to the left."
            }
            Self::Vehicle => {
                "Fixed axes: x forward, y left, z up; displacements of centers of gravity from the nominal \
                 layout. Angles turn by R = Ry(pitch) Rz(yaw) Rx(roll). Forces of elements act on the body \
                 with end a; pushes are positive."
            }
            Self::HalfTruck => {
                "Axes: x forward, y left, z up; displacements of centers of gravity from the drawn \
                 position, small angles. Bodies, wedges and connections have the numbers of the files; \
                 forces of connections are positive in extension."
            }
        }
    }

    /// Returns the model of this name.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        let all = [
            Self::Wedge,
            Self::QuasiStatic,
            Self::Truck,
            Self::HalfTruck,
            Self::ThreePieceTruck,
            Self::Car,
            Self::Vehicle,
        ];
        all.into_iter().find(|model| model.name() == name)
    }
}

/// The source of an FMU.
#[derive(Clone, Debug)]
pub enum Source {
    /// A wedge with mass.
    Wedge(Box<Case>),
    /// A quasi-static wedge.
    QuasiStatic(Box<Case>),
    /// A half-truck that has room for wedges of the case.
    Truck(Box<Case>),
    /// The run of a half-truck.
    HalfTruck(Box<HalfTruck>),
    /// A three-piece truck.
    ThreePieceTruck(Box<TruckCase>),
    /// A freight car on its track.
    Car(Box<CarCase>),
    /// A vehicle of bodies and elements.
    Vehicle(Box<VehicleCase>),
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
            FmuModel::HalfTruck | FmuModel::ThreePieceTruck | FmuModel::Car | FmuModel::Vehicle => None,
        }
    }

    /// Returns which model it is.
    #[must_use]
    pub fn model(&self) -> FmuModel {
        match self {
            Self::Wedge(_) => FmuModel::Wedge,
            Self::QuasiStatic(_) => FmuModel::QuasiStatic,
            Self::Truck(_) => FmuModel::Truck,
            Self::HalfTruck(_) => FmuModel::HalfTruck,
            Self::ThreePieceTruck(_) => FmuModel::ThreePieceTruck,
            Self::Car(_) => FmuModel::Car,
            Self::Vehicle(_) => FmuModel::Vehicle,
        }
    }

    /// Returns name and title.
    #[must_use]
    pub fn name_and_title(&self) -> [&str; 2] {
        match self {
            Self::Wedge(case) | Self::QuasiStatic(case) | Self::Truck(case) => [&case.name, &case.title],
            Self::HalfTruck(own) => [&own.case().name, &own.case().title],
            Self::ThreePieceTruck(case) => [&case.name, &case.title],
            Self::Car(case) => [&case.name, &case.title],
            Self::Vehicle(case) => [&case.name, &case.title],
        }
    }

    /// Returns length (s) and tolerance of the default experiment.
    #[must_use]
    pub fn experiment(&self) -> [f64; 2] {
        match self {
            Self::Wedge(case) | Self::QuasiStatic(case) | Self::Truck(case) => {
                [case.simulation.duration, case.simulation.relative_tolerance]
            }
            Self::HalfTruck(own) => [own.case().duration, own.case().relative_tolerance],
            Self::ThreePieceTruck(case) => [case.simulation.duration, case.simulation.relative_tolerance],
            Self::Car(case) => [case.simulation.duration, case.simulation.relative_tolerance],
            Self::Vehicle(case) => [case.simulation.duration, case.simulation.relative_tolerance],
        }
    }

    /// Returns name and bytes of the files that say what it is made of: the case or run first, then the
    /// profiles and measured tables of a car.
    ///
    /// # Errors
    /// A profile or a table can no longer be read.
    pub fn files(&self) -> Result<Vec<(String, Vec<u8>)>, Error> {
        let mut named = Vec::new();
        let (name, text) = match self {
            Self::Wedge(case) | Self::QuasiStatic(case) | Self::Truck(case) => {
                (CASE, case.to_toml_embedded().to_owned())
            }
            Self::HalfTruck(own) => (half_truck::RESOURCE, own.text().to_owned()),
            Self::ThreePieceTruck(case) => (CASE, case.to_toml_embedded().to_owned()),
            Self::Vehicle(case) => (CASE, case.to_toml_embedded().to_owned()),
            Self::Car(case) => {
                let (text, files) = case.packed();
                named = files;
                (CASE, text)
            }
        };
        let mut files = vec![(name.to_owned(), text.into_bytes())];
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
        match self {
            Self::Wedge(case) => wedge::entries(case),
            Self::QuasiStatic(case) => quasi_static::entries(case),
            Self::Truck(case) => Ok(truck::plant(case)?.entries),
            Self::HalfTruck(own) => Ok(own.plant()?.entries),
            Self::ThreePieceTruck(case) => Ok(three_piece::plant(case, true)?.entries),
            Self::Car(case) => Ok(car::plant(case)?.entries),
            Self::Vehicle(case) => Ok(vehicle::plant(case, true)?.entries),
        }
    }

    /// Returns the element under these settings, at its start; `entries` are its own.
    ///
    /// # Errors
    /// Values that are not admissible, or from which it cannot start.
    pub fn element(&self, entries: &Entries, setting: &Setting) -> Result<Box<dyn Element>, Error> {
        Ok(match self {
            Self::Wedge(case) => Box::new(wedge::element(case, entries, setting)?),
            Self::QuasiStatic(case) => Box::new(QuasiStaticElement::new(case, entries, setting)?),
            Self::Truck(case) => Box::new(truck::element(case, setting)?),
            Self::HalfTruck(own) => Box::new(own.element(setting)?),
            Self::ThreePieceTruck(case) => Box::new(three_piece::element(case, setting)?),
            Self::Car(case) => Box::new(car::element(case, setting)?),
            Self::Vehicle(case) => Box::new(vehicle::element(case, setting)?),
        })
    }
}
