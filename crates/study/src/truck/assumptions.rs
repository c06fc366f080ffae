//! The assumptions of a truck's run in words.

use truck::{Adapter, WEDGE_NAMES, Wedge, WedgeKind};
use wedge::parameters::{Damping, Start};

use super::TruckCase;
use crate::wedge_faces;

const INCH: f64 = 0.0254;
const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// Assumptions of spatial and split wedges.
pub(crate) fn of_kinds(wedges: &[Wedge]) -> Vec<String> {
    let mut list = Vec::new();
    if wedges.iter().any(|wedge| wedge.slope_across != 0.0) {
        list.push(
            "Slopes across (slope_across): the sides of the pockets have no friction, and the wedge keeps \
             the center of gravity and the inertia of a prism; no source gives the angle."
                .to_owned(),
        );
    }
    if wedges.iter().any(|wedge| wedge.kind == WedgeKind::Split) {
        list.push(
            "Split wedges: each half has half of the stiffness, bristles and control coil of a whole wedge; \
             a coil under both is two half coils at split.coil_distance from the middle. The friction and \
             the gap between the halves, and their angle, are guesses."
                .to_owned(),
        );
    }
    list
}

/// Returns the assumptions of a run.
pub(super) fn of(case: &TruckCase) -> Vec<String> {
    let p = &case.parameters;
    let stiffnesses = p
        .wedges
        .each_ref()
        .map(|wedge| wedge.contact.stiffness * INCH / POUND_FORCE);
    let [least, most] = [f64::min, f64::max].map(|of| stiffnesses.into_iter().fold(stiffnesses[0], of));
    let stiffness = match least == most {
        true => format!("is {least:.4e}"),
        false => format!("is {least:.4e} to {most:.4e}"),
    };
    let mut list = vec![
        "Bodies are rigid; coils, stops and faces are springs with dampers. Coils act at one point each; \
         load coils have shear stiffness, and hold nothing when they are off their seats."
            .to_owned(),
        format!(
            "Contact stiffness {stiffness} lbf/in per corner: no source gives one, nor one for \
             bristles. In the built-in rigs contacts twice as stiff move the warp moment at 20 mrad by 58 % \
             where the nest locks (friction of 0.4) and by 0.2 % on a plateau (0.25); up and down, where \
             slopes stick, they move the largest column force by 8 to 13 %, and bristles twice as stiff by \
             6 to 13 %. `wedgelab reproduce` computes these numbers anew."
        ),
        "The built-in clearances of pockets (0.25 in), lands (0.21 in) and center plate's rim, damping of \
         contacts, and inertias of empty cars are decided, not measured."
            .to_owned(),
    ];
    list.extend(wedge_faces::assumptions(&wedge_faces::named(&[("", &p.wedges)])));
    list.extend(of_kinds(&p.wedges));
    let massless = WEDGE_NAMES.iter().zip(&p.wedges);
    let massless: Vec<String> = massless
        .filter(|(_, wedge)| wedge.kind == WedgeKind::Massless)
        .map(|(name, _)| name.replace('_', " "))
        .collect();
    if !massless.is_empty() {
        list.push(format!(
            "Wedges without mass ({}) are the industry's elements: quasi-static balance, friction of the \
             slope as the toe's sign says, no moments, small displacements; their weight is the bolster's, \
             their coils have neither shear stiffness nor damping. They do not lock in warp: the wedges' \
             part of it is left out{}.",
            massless.join(", "),
            match p.warp_spring {
                Some(_) => ", and an empirical warp spring stands for it",
                None => " (warp_spring.kind = \"nothing\")",
            }
        ));
    } else if p.warp_spring.is_some() {
        list.push(
            "An empirical warp spring acts beside wedges that have mass: warp is counted twice.".to_owned(),
        );
    }
    let mut sticking = p.wedges.iter();
    if p.damping == Damping::Constant
        && sticking.all(|wedge| wedge.toe == 0.0 && wedge.kind != WedgeKind::Massless)
    {
        list.push(
            "Constant damping without toe: slopes stick, the wedges go with the bolster, and the normal \
             forces of the columns are those that the start locked in."
                .to_owned(),
        );
    }
    list.push(match p.start {
        Start::Rest => "The run starts at rest in the nominal layout, whatever penetrates.".to_owned(),
        Start::Touching => {
            "The run starts at rest; columns and slopes were moved away until nothing penetrates.".to_owned()
        }
        Start::Equilibrium => "The run starts in static equilibrium without friction.".to_owned(),
    });
    if case.settle == 0.0 {
        list.push("The truck does not settle before time zero (start.settle).".to_owned());
    }
    if let Some(wheelsets) = &p.wheelsets {
        list.push(match wheelsets.adapter {
            Adapter::Friction(_) => "Side frames slide on the bearings with friction up to stops.".to_owned(),
            Adapter::Pad(_) => "Elastomeric pads are springs without stops.".to_owned(),
        });
        if p.side_frames.iter().any(|own| own.free == [false; 6]) {
            list.push(
                "Adapters of side frames whose motion is prescribed are left out, and the inter-axle shear \
                 moment with them."
                    .to_owned(),
            );
        }
    }
    list
}
