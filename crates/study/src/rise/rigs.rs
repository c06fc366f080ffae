//! What rigs and straight track say of a car's truck over wedge rise: warp stiffness, damping, the speed
//! below which hunting dies.
//!
//! The rigs are those of the truck model (`truck_crowned_warp_nest_...`, `truck_crowned_vertical_...`) with
//! the nests of the car's front truck in them: geometry, wedges, coils, gibs and lands. The bolster is at
//! the height of the loaded car.
//!
//! - **Warp**: secant stiffness of a nest's moment at 10 mrad, both side frames moved against the bolster.
//! - **Damping**: energy that a cycle of the bolster takes, 0.5 in up and down at 2 rad/s.
//! - **Hunting**: at falling speed on perfect track ([`crate::car::hunting`]), the speed at which a limit
//!   cycle dies.

use std::ops::ControlFlow;

use quantity::Kind;
use serde::{Deserialize, Serialize};
use wedge::parameters::Damping;

use super::bracket::Rise;
use super::{MILE_PER_HOUR, Prepared, Survey};
use crate::car::hunting::{Boundary, HuntingSettings, falling};
use crate::models::AnyCase;
use crate::outcome::Outcome;
use crate::run::{Run, RunCase};
use crate::summary::RunSummary;
use crate::truck::TruckCase;
use crate::truck::builtin::case_with;
use crate::truck::run::TruckResult;
use crate::truck::warp::{Growth, WarpCurve};

/// Angle at which warp stiffness is taken, rad.
const ANGLE: f64 = 0.010;
/// Speeds between which hunting is looked for, m/s: 30 and 90 mph.
const SPEEDS: [f64; 2] = [30.0 * MILE_PER_HOUR, 90.0 * MILE_PER_HOUR];
/// Time in which the speed falls, s.
const RAMP: f64 = 60.0;
/// Amplitude of a wheelset from which on it hunts, m: 0.05 in.
const THRESHOLD: f64 = 0.05 * 0.0254;
/// The regime whose lading and wheels are taken for hunting.
const HUNTING: &str = "hunting";

/// What is looked at over rise.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rig {
    /// Warp stiffness, N·m/rad.
    Warp,
    /// Energy of a cycle, J.
    Damping,
    /// Speed at which hunting dies, m/s.
    Hunting,
}

/// What came of a rig.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OfRig {
    /// The rig.
    pub rig: Rig,
    /// The rise.
    pub rise: Rise,
    /// What it says, SI; none if it says nothing.
    pub value: Option<f64>,
    /// What it says besides, or why it says nothing; may be empty.
    pub note: String,
}

impl Rig {
    /// Returns its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Warp => "warp",
            Self::Damping => "damping",
            Self::Hunting => "hunting",
        }
    }
}

impl Survey {
    /// Returns the rigs at their rises: warp and damping on the grid, hunting at its ends and in its
    /// middle.
    #[must_use]
    pub fn rigs(&self) -> Vec<(Rig, Rise)> {
        let rises = self.rises();
        let middle = rises[rises.len() / 2];
        let hunts = self.regimes.iter().any(|own| own.name == HUNTING);
        let hunting = [0, middle, self.top].map(|rise| (Rig::Hunting, rise));
        let truck = rises
            .iter()
            .flat_map(|rise| [Rig::Warp, Rig::Damping].map(|rig| (rig, *rise)));
        // What takes longest begins first.
        hunting.into_iter().filter(|_| hunts).chain(truck).collect()
    }

    /// Returns all that a rig is made of, so that another car's result is not taken for it.
    #[must_use]
    pub fn rig_made_of(&self, (rig, rise): (Rig, Rise)) -> String {
        let car = self.rig_car(rig, rise);
        let case = car.and_then(|own| own.case().to_toml());
        format!("{}\n{}", rig.name(), case.unwrap_or_default())
    }

    /// Returns the run of which a rig takes the car.
    fn rig_car(&self, rig: Rig, rise: Rise) -> Option<Prepared> {
        let regime = match rig {
            Rig::Hunting => self.regimes.iter().position(|own| own.name == HUNTING)?,
            Rig::Warp | Rig::Damping => 0,
        };
        let wanted = self.wanted(&[], regime, *self.speeds(regime).first()?, rise);
        self.prepare(&wanted).ok()
    }

    /// Runs a rig; `go_on` may stop it.
    #[must_use]
    pub fn rig(&self, (rig, rise): (Rig, Rise), go_on: &dyn Fn() -> ControlFlow<String>) -> OfRig {
        let (value, note) = match self.measure(rig, rise, go_on) {
            Ok((value, note)) => (Some(value), note),
            Err(reason) => (None, reason),
        };
        OfRig {
            rig,
            rise,
            value,
            note,
        }
    }

    fn measure(
        &self,
        rig: Rig,
        rise: Rise,
        go_on: &dyn Fn() -> ControlFlow<String>,
    ) -> Result<(f64, String), String> {
        let prepared = self
            .rig_car(rig, rise)
            .ok_or("the car cannot be made at this rise")?;
        let AnyCase::Car(car) = prepared.case() else {
            return Err("no car".to_owned());
        };
        if rig == Rig::Hunting {
            let settings = HuntingSettings {
                speeds: SPEEDS,
                ramp: RAMP,
                threshold: THRESHOLD,
            };
            let ramp = falling(car, settings, |_| go_on()).map_err(|error| error.to_string())?;
            return match ramp.boundary {
                Boundary::At(speed) => Ok((speed, String::new())),
                Boundary::Everywhere => Ok((SPEEDS[0], "it hunts at all speeds down to this one".to_owned())),
                Boundary::Nowhere => Ok((SPEEDS[1], "it hunts at no speed up to this one".to_owned())),
                Boundary::Derails(speed) => Ok((speed, "a wheel leaves its rail at this speed".to_owned())),
            };
        }
        let own = &car.parameters.trucks[0];
        let damping = match own.damping {
            Damping::Constant => "constant",
            Damping::Variable => "variable",
        };
        let name = match rig {
            Rig::Warp => format!("truck_crowned_warp_nest_{damping}"),
            Rig::Damping | Rig::Hunting => format!("truck_crowned_vertical_{damping}"),
        };
        let mut case = case_with(&name, &[]).map_err(|error| self.refused(error).note)?;
        let (there, own) = (&mut case.parameters, own.clone());
        there.geometry = own.geometry;
        there.wedges = own.wedges;
        there.load_coils = own.load_coils;
        (there.gib, there.lands, there.warp_spring) = (own.gib, own.lands, own.warp_spring);
        let result = run(&case, go_on)?;
        match rig {
            Rig::Warp => {
                let curve = WarpCurve::of(&case, &result).ok_or("the truck does not warp")?;
                let at = curve.stiffness.iter().find(|own| (own.0 - ANGLE).abs() < 1e-9);
                let note = match curve.growth {
                    Growth::Unknown => String::new(),
                    other => other.name().to_owned(),
                };
                at.map(|own| (own.1, note))
                    .ok_or("warp does not reach 10 mrad".to_owned())
            }
            Rig::Damping | Rig::Hunting => {
                let cycles = &result.summary.cycles;
                let work = cycles.work.as_ref().ok_or_else(|| cycles.missing.clone())?;
                Ok((work.value / Kind::Energy.from_si(case.units()), String::new()))
            }
        }
    }
}

fn run(case: &TruckCase, go_on: &dyn Fn() -> ControlFlow<String>) -> Result<TruckResult, String> {
    let result = Run::new(case)
        .map_err(|error| error.to_string())?
        .finish_while(|_| go_on());
    match result.summary.outcome() {
        Outcome::Complete => Ok(result),
        other => Err(other.told().unwrap_or_default()),
    }
}
