//! The assumptions of a car's run in words. What is said of a value holds for it, whether it is a built-in
//! one or the case's own.

use std::sync::Arc;

use car::{Drive, Parameters, ProfiledWheels, StartKind, Wheels};
use rolling::track::RailSupport;
use truck::{Wedge, WedgeKind};
use wheelrail::contact::{ContactLaw, CreepLaw, PatchForm};
use wheelrail::creep::polach;
use wheelrail::profile::Profile;
use wheelrail::wheelset::RigidWheelset;

use super::statistics::Rules;
use super::{CarCase, couplers, friction, not_round, rails};
use crate::reader::CaseText;
use crate::truck::assumptions::of_kinds;
use crate::wedge_faces;

/// Returns the assumption about a profile of wheels or rails; `typed` is what the user calls it: a nominal
/// profile or a file.
pub(crate) fn of_profile(whose: &str, typed: &str, profile: &Profile) -> String {
    let name = input::shortened(typed);
    match profile.note() {
        "" if profile.name() == "cone" => {
            format!("The profile of {whose} is {name}, a cone without a flange.")
        }
        "" => format!("The profile of {whose} is {name}."),
        note => format!("The profile of {whose} is {name}: {note}."),
    }
}

/// Returns the assumption about the rails' support in a field of gravity (m/s²); `own` begins the words.
pub(crate) fn of_support(support: Option<&RailSupport>, own: &str, gravity: f64) -> String {
    match support {
        None => "Rails do not give way.".to_owned(),
        Some(support) if support.beam.is_some() => {
            "Rails are beams on springs, of which the wheels of a truck on a side share one, quasi-static \
             and without waves; the rail rolls about its base under its wheel, which does not see what the \
             other wheel's roll adds; the roll stiffness of the foundation and the torsional stiffness of \
             the rail are guesses unless given."
                .to_owned()
        }
        Some(support) if *support == RailSupport::default_support("rail", gravity) => {
            format!("{own}; its values are guesses.")
        }
        Some(_) => format!("{own}, with the values of the track."),
    }
}

/// Appends the assumptions about the profiles of wheels and rails: of all where they are alike, else of each
/// side or each wheel.
pub(crate) fn of_wheels(text: &CaseText, own: &ProfiledWheels, list: &mut Vec<String>) {
    let typed = |paths: &[String]| {
        let found = paths
            .iter()
            .map(|path| text.as_typed(path))
            .find(|typed| !typed.is_empty());
        found.unwrap_or_default().to_owned()
    };
    let first = &own.wheels[0];
    let same = |a: &Arc<Profile>, b: &Arc<Profile>| Arc::ptr_eq(a, b);
    if own.wheels.iter().flatten().all(|wheel| same(wheel, &first[0])) {
        let paths = ["wheels.profile".to_owned()];
        list.push(of_profile("the wheels", &typed(&paths), &first[0]));
    } else {
        for (w, sides) in own.wheels.iter().enumerate() {
            for (side, wheel) in ["left", "right"].into_iter().zip(sides) {
                let axle = w + 1;
                let paths = [
                    format!("wheels.axle_{axle}.{side}.profile"),
                    format!("wheels.axle_{axle}.profile"),
                    format!("wheels.{side}.profile"),
                    "wheels.profile".to_owned(),
                ];
                list.push(of_profile(
                    &format!("the {side} wheel of axle {axle}"),
                    &typed(&paths),
                    wheel,
                ));
            }
        }
    }
    list.extend(rails::over_in_words(&own.rails_over));
    list.extend(not_round::in_words(&own.forms));
    let [left, right] = &own.rails;
    if same(left, right) {
        let paths = ["rails.left.profile", "rails.profile"].map(str::to_owned);
        list.push(of_profile("the rails", &typed(&paths), left));
    } else {
        for (side, rail) in [("left", left), ("right", right)] {
            let paths = [format!("rails.{side}.profile"), "rails.profile".to_owned()];
            list.push(of_profile(&format!("the {side} rail"), &typed(&paths), rail));
        }
    }
}

/// Returns the assumption about the contacts of wheels on rails.
pub(crate) fn of_contacts([law, right]: &[ContactLaw; 2], tables: bool, geometry: &RigidWheelset) -> String {
    let friction = match law.friction == right.friction {
        true => friction::in_words(&law.friction),
        false => format!(
            "{} on the left rail, {} on the right one",
            friction::in_words(&law.friction),
            friction::in_words(&right.friction)
        ),
    };
    format!(
        "Wheels on rails: patches by overlap {}, {}{}.",
        match geometry.pairs()[0].patch_form() {
            PatchForm::Ellipse => "with Hertz's ellipses",
            PatchForm::Strips => "on strips of half-spaces",
        },
        match law.creep {
            CreepLaw::Frictionless => "no creep forces".to_owned(),
            CreepLaw::Linear => "Kalker's linear creep without saturation".to_owned(),
            CreepLaw::ShenHedrickElkins => {
                format!("creep after Shen, Hedrick and Elkins, friction {friction}")
            }
            CreepLaw::Polach(polach::DRY) => format!("creep after Polach, friction {friction}"),
            CreepLaw::Polach(own) => format!(
                "creep after Polach with kA {} and kS {}, friction {friction}",
                own.adhesion, own.slip
            ),
            CreepLaw::Fastsim(_) => format!("creep by FASTSIM, friction {friction}"),
        },
        if tables {
            "; patches from tables over lateral shift, which have no flanges"
        } else {
            ""
        }
    )
}

/// Returns the assumption about wedges without mass and empirical warp springs, if there are any.
fn of_warp(parameters: &Parameters) -> Option<String> {
    let trucks = &parameters.trucks;
    let massless = |own: &truck::Parameters| {
        let kinds = own.wedges.iter();
        kinds.filter(|own| own.kind == WedgeKind::Massless).count()
    };
    let springs = trucks.iter().filter(|own| own.warp_spring.is_some()).count();
    match trucks.iter().map(massless).sum::<usize>() {
        0 if springs == 0 => None,
        0 => Some(
            "An empirical warp spring acts beside wedges that have mass: warp is counted twice.".to_owned(),
        ),
        count => Some(format!(
            "{count} of 8 wedges have no mass: the industry's elements, which do not lock in warp{}. Their \
             slope friction acts against the wedge's slip on the slope (over 1 mm/s), so that it feeds no \
             energy.",
            match springs {
                0 => " (warp_spring.kind = \"nothing\")",
                1 => "; an empirical warp spring stands for it in one truck",
                _ => "; an empirical warp spring stands for it",
            }
        )),
    }
}

/// Returns the assumption about what holds the speed, by a force on a body.
pub(crate) fn of_drive(drive: &Drive, body: &str) -> String {
    match drive {
        Drive::Held { .. } | Drive::Over { .. } => {
            format!(
                "A force on {body} along the track holds the speed; it stands for all that pulls and brakes."
            )
        }
        Drive::History { .. } => {
            format!(
                "A force on {body} along the track holds the speed of the history at the place where a car \
                 that follows it is; it stands for all that pulls and brakes."
            )
        }
        Drive::Coasting => "No force holds the speed.".to_owned(),
    }
}

/// Returns the assumption about the statistics.
pub(crate) fn of_rules(rules: &Rules) -> String {
    let remembered = Rules {
        filtered_columns: rules.filtered_columns,
        ..Rules::default()
    };
    match *rules == remembered {
        true => {
            "Filters, times, distances and limits of the statistics are remembered of AAR M-1001, chapter \
                 XI, 49 CFR 213.333 and EN 14363:2005: check them against your edition."
                .to_owned()
        }
        false => "Filters, times and distances of the statistics are the case's own ([output]); built-in \
                  ones and limits are remembered of AAR M-1001, chapter XI, 49 CFR 213.333 and EN \
                  14363:2005: check them against your edition."
            .to_owned(),
    }
}

/// Returns the wedges of both trucks with their names in words.
pub(super) fn named(parameters: &Parameters) -> Vec<(String, &Wedge)> {
    let [front, rear] = &parameters.trucks;
    wedge_faces::named(&[("front ", &front.wedges), ("rear ", &rear.wedges)])
}

/// What holds of a body that twists, and of the hysteresis of side bearings.
fn of_body(parameters: &Parameters) -> Vec<String> {
    let mut list = Vec::new();
    if let Some(frequency) = parameters.torsion_frequency() {
        list.push(format!(
            "The car body is two rigid halves that twist about an axis through the center of gravity, freely \
             at {frequency:.2} Hz; a joint of 100 Hz holds them in all else: no bending of a real body."
        ));
    }
    let mut bodies = parameters.trucks.iter().filter_map(|own| own.car_body.as_ref());
    if bodies.any(|own| own.side_bearings.kind.hysteresis().is_some()) {
        list.push(
            "Hysteresis of side bearings is a slider behind a spring, alike at any speed; friction on their \
             faces takes the elastic force alone."
                .to_owned(),
        );
    }
    list
}

/// Returns the assumptions of a run.
pub(super) fn of(case: &CarCase) -> Vec<String> {
    let p = &case.parameters;
    let mut list = vec![
        couplers::assumption(&p.couplers),
        "Bodies are rigid; coils, stops and faces are springs with dampers. The built-in stiffnesses of \
         contacts of wedges, center plates and adapters are guesses."
            .to_owned(),
    ];
    match &p.wheels {
        Wheels::OnRails(own) => {
            of_wheels(&case.text, own, &mut list);
            if let Some(geometry) = own.geometry.first() {
                list.push(of_contacts(&own.laws, own.tables, geometry));
            }
        }
        Wheels::Linear { .. } => list.push(
            "Linear wheels: geometry and creep of small motions, no flange, no saturation: for stability \
             alone."
                .to_owned(),
        ),
    }
    let sprung = "Each wheel has a piece of rail of its own on springs";
    list.push(of_support(p.support.as_ref(), sprung, p.gravity));
    let wedges: Vec<Wedge> = p.trucks.iter().flat_map(|own| own.wedges.clone()).collect();
    list.extend(wedge_faces::assumptions(&named(p)));
    list.extend(of_kinds(&wedges));
    list.extend(of_warp(p));
    list.extend(of_body(p));
    list.push(of_drive(&p.drive, "the car body"));
    let start = match p.start.kind {
        StartKind::Equilibrium => {
            "The car starts in equilibrium without friction, bristles undeflected, wheels rolling"
        }
        StartKind::Nominal => "The car starts in the nominal layout, which is that of the loaded car",
        StartKind::Shaken => {
            "The car starts at rest with what friction holds after 3 s at 60 mph on tangent track of FRA \
             class 3 by spectra, seeds 1 to 3 (choices), from its equilibrium, wheels rolling"
        }
    };
    let shifts = p.start.wheelset_shifts.iter().chain([&p.start.body_shift]);
    let moved = match shifts.into_iter().any(|own| *own != 0.0) {
        true => ", moved aside by the shifts of [start]",
        false => "",
    };
    list.push(format!(
        "{start}{moved}; statistics begin at {} s (start.settle).",
        p.start.settle
    ));
    list.push(of_rules(&case.rules));
    list
}
