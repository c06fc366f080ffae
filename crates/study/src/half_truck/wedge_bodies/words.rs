//! The values that a wedge's body takes from the files, and those added, in words.

use mechanics::connection::{Law, Wedge as Massless};
use nucars::truck::Truck;
use quantity::{Kind, Number, System as Units};
use truck::ControlCoil;
use wedge::parameters::Damping;

use super::{Made, MountedWedge};

/// Returns the sentence on springs that may stand for the warp resistance that the bodies have of their own.
pub(super) fn warp_springs(truck: &Truck, wedges: &[MountedWedge]) -> Option<String> {
    let connections = &truck.model.connections;
    let ends = |place: usize| (connections[place].a, connections[place].b);
    let wedged = |place: usize| wedges.iter().any(|wedge| ends(wedge.connection) == ends(place));
    let yaws = |place: &usize| match &connections[*place].law {
        Law::Springs(springs) => springs.iter().any(|(k, own)| *k == 5 && own.spring.is_some()),
        _ => false,
    };
    let found = (0..connections.len()).filter(|place| wedged(*place)).filter(yaws);
    let numbers: Vec<String> = found.map(|place| truck.connections[place].to_string()).collect();
    (!numbers.is_empty()).then(|| {
        format!(
            "yaw springs between the same bodies (connections {}) stay; where they stand for the wedges' \
             resistance to warp, it is there twice: wedges' bodies have their own",
            numbers.join(", ")
        )
    })
}

impl Made {
    /// Returns the values taken from the files and those added, in words.
    pub(super) fn words(&self, law: &Massless, units: Units) -> Vec<String> {
        let wedge = &self.wedge;
        let measure = |value: f64, kind: Kind| measure(value, kind, units);
        let degrees = |angle: f64| Number(rounded(angle.to_degrees()));
        let toe = match wedge.toe {
            0.0 if self.plain => {
                "a vertical column (type 6.8 gives a direction of toe and no angle: give one by the option \
                 plain_toe_angle; without it the wedge hardly slides on its slope, so that it keeps the \
                 normal force that the start locked in)"
                    .to_owned()
            }
            0.0 => "a vertical column".to_owned(),
            toe => format!(
                "a column inclined by {} deg, toe {}",
                degrees(toe.abs()),
                if toe > 0.0 { "out" } else { "in" }
            ),
        };
        let toe = match self.depth {
            0.0 => toe,
            depth => format!("{toe}, {} deep in the drawn layout", measure(depth, Kind::Length)),
        };
        let (seat, coil) = match self.damping {
            Damping::Constant => ("in the bolster's pocket", "constant"),
            Damping::Variable => ("on the side frame", "variable"),
        };
        let mut lines = vec![format!(
            "from the files: {} deg, {toe}; friction {} (column) and {} (slope); coil {seat} ({coil} \
             damping) with {} in the drawn layout; the accumulator's stiffness and damping are those of the \
             bristles of both faces",
            degrees(law.angle),
            Number(law.column_friction),
            Number(law.slope_friction),
            measure(self.load, Kind::Force),
        )];
        let inertia: Vec<String> = wedge
            .inertia
            .iter()
            .map(|value| Number(rounded(value * Kind::Inertia.from_si(units))).to_string())
            .collect();
        lines.push(format!(
            "added: mass {}, moments of inertia {} {} (roll, pitch, yaw), height {}, width {}, center of \
             gravity at the connection's point, all six coordinates free",
            measure(wedge.mass, Kind::Mass),
            inertia.join(", "),
            Kind::Inertia.unit(units),
            measure(wedge.height, Kind::Length),
            measure(wedge.width, Kind::Length),
        ));
        lines.push(format!(
            "added: contact of each of four corners a face {}, {}; they are a part of the answer where the \
             slope sticks",
            measure(wedge.contact.stiffness, Kind::Stiffness),
            measure(wedge.contact.damping, Kind::Damping),
        ));
        if let ControlCoil::Table(coil) = &wedge.control_coil {
            let moment = coil.tilt_stiffness * Kind::Moment.from_si(units);
            lines.push(format!(
                "added: the coil acts below the center of gravity; its shear stiffness {}, tilt stiffness \
                 {} {}/rad (both of a guessed coil, whose ends are held in their seats), damping {}",
                measure(coil.shear_stiffness, Kind::Stiffness),
                Number(rounded(moment)),
                Kind::Moment.unit(units),
                measure(coil.damping, Kind::Damping),
            ));
        }
        let gap = self.gap();
        if gap > 0.0 {
            lines.push(format!(
                "added: the inclined column is moved away by {}, so that the upright wedge just touches it \
                 with an edge",
                measure(gap, Kind::Length),
            ));
        }
        let sides = &wedge.pocket_sides;
        lines.push(format!(
            "added: sides of the pocket at {} to each side, {}, {}",
            measure(sides.clearance, Kind::Length),
            measure(sides.stiffness, Kind::Stiffness),
            measure(sides.damping, Kind::Damping),
        ));
        lines
    }
}

/// Returns a value (SI) with its unit.
pub(super) fn measure(value: f64, kind: Kind, units: Units) -> String {
    let number = Number(rounded(value * kind.from_si(units)));
    format!("{number} {}", kind.unit(units)).trim_end().to_owned()
}

/// Returns a number rounded to four significant digits.
pub(super) fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}
