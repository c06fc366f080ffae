//! The summary of a run of any model.

use serde::{Deserialize, Serialize, Serializer};

use crate::car::summary::CarSummary;
use crate::half_truck::HalfTruckSummary;
use crate::summary::{RunSummary, Summary};
use crate::truck::summary::TruckSummary;
use crate::vehicle::summary::VehicleSummary;
use crate::wheelset::summary::WheelsetSummary;

/// Declares [`AnySummary`], made of the summary of each model.
macro_rules! any_summary {
    ($($(#[$doc:meta])* $model:ident($summary:ty),)+) => {
        /// The summary of a run of any model.
        #[derive(Clone, Debug, Serialize, Deserialize)]
        pub enum AnySummary {
            $($(#[$doc])* $model(Box<$summary>),)+
        }

        impl AnySummary {
            /// Returns the part that the summaries of all models have.
            #[must_use]
            pub fn shared(&self) -> &dyn RunSummary {
                match self {
                    $(Self::$model(own) => &**own,)+
                }
            }

            /// Writes the summary as `summary.json` has it: without the name of its variant.
            ///
            /// # Errors
            /// The serializer's.
            pub fn serialize_content<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                match self {
                    $(Self::$model(own) => own.serialize(serializer),)+
                }
            }
        }

        $(
            impl From<$summary> for AnySummary {
                fn from(summary: $summary) -> Self {
                    Self::$model(Box::new(summary))
                }
            }
        )+
    };
}

any_summary! {
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
