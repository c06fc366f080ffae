//! The summary of a run of any model.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize, Serializer};

use crate::car::summary::CarSummary;
use crate::half_truck::HalfTruckSummary;
use crate::summary::{RunSummary, Summary};
use crate::truck::summary::TruckSummary;
use crate::vehicle::summary::VehicleSummary;
use crate::wheelset::summary::WheelsetSummary;

/// The summary of a run of one model.
pub trait ModelSummary: RunSummary + Clone + Serialize + DeserializeOwned + Into<AnySummary> {
    /// Returns it from the summary of a run of any model; `None` of another one.
    fn of(any: &AnySummary) -> Option<&Self>;

    /// Reads it from JSON.
    ///
    /// # Errors
    /// It is not what its schema says.
    fn of_json(json: &[u8]) -> serde_json::Result<AnySummary> {
        serde_json::from_slice::<Self>(json).map(Into::into)
    }
}

/// Declares [`AnySummary`], made of the summary of each model, and `each_summary!`.
macro_rules! any_summary {
    ($d:tt $($(#[$doc:meta])* $model:ident($summary:ty),)+) => {
        /// The summary of a run of any model.
        #[derive(Clone, Debug, Serialize, Deserialize)]
        pub enum AnySummary {
            $($(#[$doc])* $model(Box<$summary>),)+
        }

        /// Does the same with the summary of whatever model: `each_summary!(&any, own => own.units())`.
        #[macro_export]
        macro_rules! each_summary {
            ($d any:expr, $d own:ident => $d do:expr) => {
                match $d any {
                    $($crate::models::AnySummary::$model($d own) => $d do,)+
                }
            };
        }

        $(
            impl From<$summary> for AnySummary {
                fn from(summary: $summary) -> Self {
                    Self::$model(Box::new(summary))
                }
            }

            impl ModelSummary for $summary {
                fn of(any: &AnySummary) -> Option<&Self> {
                    match any {
                        AnySummary::$model(own) => Some(own),
                        _ => None,
                    }
                }
            }
        )+
    };
}

any_summary! {
    $
    /// Of a wedge.
    Wedge(Summary),
    /// Of a half-truck from files of NUCARS.
    HalfTruck(HalfTruckSummary),
    /// Of a three-piece truck.
    Truck(TruckSummary),
    /// Of a car.
    Car(CarSummary),
    /// Of a vehicle.
    Vehicle(VehicleSummary),
    /// Of a wheelset.
    Wheelset(WheelsetSummary),
}

impl AnySummary {
    /// Returns the part that the summaries of all models have.
    #[must_use]
    pub fn shared(&self) -> &dyn RunSummary {
        each_summary!(self, own => &**own)
    }

    /// Writes the summary as `summary.json` has it: without the name of its variant.
    ///
    /// # Errors
    /// The serializer's.
    pub fn serialize_content<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        each_summary!(self, own => own.serialize(serializer))
    }
}
