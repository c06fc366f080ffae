//! Functional mock-up units (FMI 2.0 and 3.0), as far as no C is needed.
//!
//! - [`variable`], [`description`]: what an importer can see, as data and as `modelDescription.xml` of either
//!   version.
//! - [`source`]: what an FMU is made of: the case of a wedge, a truck or a car, or the run of
//!   a half-truck.
//! - [`element`]: the elements whose quantities the variables show: any system with named ports ([`system`]),
//!   which are the wedge ([`wedge`](mod@wedge)), the truck without wedges ([`truck`]), the half-truck
//!   ([`half_truck`]), the three-piece truck ([`three_piece`]), the car ([`car`]), the vehicle of bodies and
//!   elements ([`vehicle`](mod@vehicle)); the quasi-static wedge; and tables of a nest ([`tables`]).
//! - [`instance`]: one instance, with the states of the standard's state machine, for both versions and both
//!   kinds of interface.
//! - [`package`], [`resources`]: writing a whole FMU, and finding the case again in an unpacked one;
//!   [`limits`]: how much is read.
//! - [`ssp`]: the truck with four wedges as a system structure.
//!
//! ```
//! use fmi::description::{Description, Version};
//! use fmi::source::{FmuModel, Source};
//!
//! let case = study::case::builtin::case("vdrun_toe_0_psi_0")?;
//! let source = Source::of_case(FmuModel::Wedge, case).ok_or("made of something else")?;
//! let description = Description::new(&source)?;
//! let mut variables = description.variables.iter();
//! assert!(variables.any(|variable| variable.name == "force_on_bolster_z"));
//! assert!(description.xml(Version::Three)?.contains("fmiVersion=\"3.0\""));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod car;
pub mod description;
pub mod element;
pub mod element_state;
mod error;
mod extrapolate;
pub mod half_truck;
pub mod instance;
pub mod limits;
pub mod package;
mod quasi_static;
pub mod resources;
pub mod source;
pub mod ssp;
pub mod system;
pub mod tables;
pub mod three_piece;
pub mod truck;
pub mod unit;
pub mod variable;
pub mod vehicle;
mod watch;
pub mod wedge;

pub use error::{Category, Error, Severity};
