//! The assumptions of a car's run in words.

use car::{Drive, StartKind, Wheels};
use truck::{Wedge, WedgeKind};
use wheelrail::contact::CreepLaw;

use super::CarCase;
use crate::truck::assumptions::of_kinds;

/// Returns the assumptions of a run.
pub(super) fn of(case: &CarCase) -> Vec<String> {
    let p = &case.parameters;
    let mut list = vec![
        "Out of scope: flexible bodies, braking, coupler forces.".to_owned(),
        "Bodies are rigid; coils, stops and faces are springs with dampers. Stiffnesses of contacts of \
         wedges, center plates and adapters are guesses."
            .to_owned(),
    ];
    match &p.wheels {
        Wheels::OnRails(own) => {
            list.push(
                "The profiles AAR-1B and 136RE are nominal, from memory: check them against drawings, or \
                 give profiles from files."
                    .to_owned(),
            );
            list.push(format!(
                "Wheels on rails: patches by overlap with Hertz's ellipses, {}, friction {}{}.",
                match own.law.creep {
                    CreepLaw::Frictionless => "no creep forces",
                    CreepLaw::Linear => "Kalker's linear creep without saturation",
                    CreepLaw::ShenHedrickElkins => "creep after Shen, Hedrick and Elkins",
                    CreepLaw::Polach(_) => "creep after Polach",
                    CreepLaw::Fastsim(_) => "creep by FASTSIM",
                },
                own.law.friction,
                if own.tables {
                    "; patches from tables over lateral shift, which have no flanges"
                } else {
                    ""
                }
            ));
        }
        Wheels::Linear { .. } => list.push(
            "Linear wheels: geometry and creep of small motions, no flange, no saturation: for stability \
             alone."
                .to_owned(),
        ),
    }
    list.push(match &p.support {
        Some(_) => "Each wheel has a piece of rail of its own on springs; its values are guesses.".to_owned(),
        None => "Rails do not give way.".to_owned(),
    });
    let wedges: Vec<Wedge> = p.trucks.iter().flat_map(|own| own.wedges.clone()).collect();
    list.extend(of_kinds(&wedges));
    let massless = p.trucks.iter().flat_map(|own| &own.wedges);
    let massless = massless.filter(|own| own.kind == WedgeKind::Massless).count();
    if massless > 0 {
        list.push(format!(
            "{massless} of 8 wedges have no mass: the industry's elements, which do not lock in warp{}. \
             Their slope friction acts against the wedge's slip on the slope (over 1 mm/s), so that it feeds \
             no energy.",
            match p.trucks.iter().any(|own| own.warp_spring.is_some()) {
                true => "; an empirical warp spring stands for it",
                false => " (warp_spring.kind = \"nothing\")",
            }
        ));
    }
    list.push(match &p.drive {
        Drive::Held { .. } | Drive::Over { .. } => {
            "A force on the car body along the track holds the speed; it stands for all that pulls and \
             brakes."
                .to_owned()
        }
        Drive::History { .. } => {
            "A force on the car body along the track holds the speed of the history at the place where a \
             car that follows it is; it stands for all that pulls and brakes."
                .to_owned()
        }
        Drive::Coasting => "No force holds the speed.".to_owned(),
    });
    list.push(match p.start.kind {
        StartKind::Equilibrium => {
            "The car starts in equilibrium without friction, bristles undeflected, wheels rolling; \
             statistics leave out the settling time."
                .to_owned()
        }
        StartKind::Nominal => {
            "The car starts in the nominal layout, which is that of the loaded car; statistics leave out \
             the settling time."
                .to_owned()
        }
    });
    list.push(
        "Filters, times, distances and limits of the statistics are remembered of AAR M-1001, chapter XI: \
         check them against your edition."
            .to_owned(),
    );
    list
}
