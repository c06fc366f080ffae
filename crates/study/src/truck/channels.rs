//! The columns of a truck, of one alone and of those under a car.

use mechanics::body::COORDINATES;
use mechanics::channel::{Channels, Seen, WithLoads};
use mechanics::system::{EnergyTermKind, System};
use quantity::Kind;
use truck::{HALVES, HalfLoads, Loads, Parameters, WEDGE_NAMES, WedgeKind, WedgeLoads};

/// Names of the sides in columns.
pub(crate) const SIDES: [&str; 2] = ["left", "right"];
/// The energy terms of friction, with the kinematics of massless wedges and the hysteresis of side bearings.
pub(crate) const FRICTION: [EnergyTermKind; 5] = [
    EnergyTermKind::FrictionLoss,
    EnergyTermKind::SurfaceFriction,
    EnergyTermKind::ColumnFriction,
    EnergyTermKind::SlopeFriction,
    EnergyTermKind::WedgeKinematics,
];

/// A force of a part: the ending of its column's name, its meaning, its value.
type Force<P> = (&'static str, &'static str, fn(&P) -> f64);

/// Forces of a wedge.
const OF_WEDGE: [Force<WedgeLoads>; 3] = [
    ("column_normal", "normal force of the column", |own| {
        own.column_normal
    }),
    (
        "column_friction_z",
        "friction of the column alone on the side frame, along z, positive up",
        |own| own.column_friction_z,
    ),
    ("slope_normal", "normal force of the slope", |own| {
        own.slope_normal
    }),
];
/// Forces of a half of a split wedge.
const OF_HALF: [Force<HalfLoads>; 2] = [
    (
        "column_normal",
        "normal force of the half's part of the column",
        |own| own.column_normal,
    ),
    (
        "slope_normal",
        "normal force of the half's part of the slope",
        |own| own.slope_normal,
    ),
];

/// Adds the columns of a truck of a model whose loads are `L`.
pub(crate) struct TruckChannels<'t, L: 'static> {
    /// The columns of the model.
    pub table: &'t mut Channels<WithLoads<L>>,
    /// The beginning of the truck's names: nothing, or `truck_1_`.
    pub prefix: String,
    /// The axes of components, in words.
    pub frame: &'static str,
    /// The loads of the truck of this number.
    pub of: (fn(&L, usize) -> &Loads, usize),
}

impl<L: 'static> TruckChannels<'_, L> {
    fn add(
        &mut self,
        name: impl AsRef<str>,
        kind: Kind,
        text: &str,
        value: impl Fn(&Loads) -> f64 + Send + Sync + 'static,
    ) {
        let (name, (of, number)) = (format!("{}{}", self.prefix, name.as_ref()), self.of);
        let read = move |seen: &Seen<'_, L>| value(of(seen.loads, number));
        self.table.add(name, kind, self.frame, text, read);
    }

    /// Adds displacements and angles, with the texts of both.
    fn add_places(
        &mut self,
        name: &str,
        texts: [&str; 2],
        places: impl Fn(&Loads) -> [[f64; 3]; 2] + Copy + Send + Sync + 'static,
    ) {
        for (k, coordinate) in COORDINATES.into_iter().enumerate() {
            let (part, axis) = (k / 3, k % 3);
            let kind = [Kind::Length, Kind::Angle][part];
            let name = format!("{name}_{coordinate}");
            self.add(name, kind, texts[part], move |loads| places(loads)[part][axis]);
        }
    }

    /// The warp angle.
    pub fn warp_angle(&mut self) {
        let text = "mean yaw of the side frames less that of the bolster";
        self.add("warp_angle", Kind::Angle, text, |loads| loads.warp_angle);
    }

    /// The whole warp moment.
    pub fn warp_moment(&mut self) {
        let text = "moment about the truck's z axis that all elements exert on the bolster";
        self.add("warp_moment", Kind::Moment, text, |loads| {
            loads.warp_moment.total()
        });
    }

    /// The loads of the nests.
    pub fn nests(&mut self) {
        for (side, name) in SIDES.into_iter().enumerate() {
            let text = "load on the side frame from all that bolster, wedges and coils exert, positive down";
            let name = format!("{name}_nest_vertical_force");
            self.add(name, Kind::Force, text, move |loads| loads.nest_vertical[side]);
        }
    }

    /// Forces, places and angles of the wedges.
    pub fn wedges(&mut self) {
        let texts = [
            "displacement of its center of gravity from its nominal place in the truck",
            "its angle in truck axes",
        ];
        for (number, name) in WEDGE_NAMES.into_iter().enumerate() {
            for (ending, text, value) in OF_WEDGE {
                let name = format!("{name}_{ending}");
                self.add(name, Kind::Force, text, move |loads| value(&loads.wedges[number]));
            }
            self.add_places(name, texts, move |loads| {
                let own = &loads.wedges[number];
                [own.displacement, own.angles]
            });
        }
    }

    /// The halves of the wedges that are split.
    pub fn halves(&mut self, parameters: &Parameters) {
        let texts = [
            "displacement of the half's center of gravity from its nominal place",
            "the half's angle in truck axes",
        ];
        let wedges = WEDGE_NAMES.into_iter().zip(&parameters.wedges).enumerate();
        for (number, (wedge, _)) in wedges.filter(|(_, (_, own))| own.kind == WedgeKind::Split) {
            for (half, name) in HALVES.into_iter().enumerate() {
                let name = format!("{wedge}_{name}");
                for (ending, text, value) in OF_HALF {
                    let name = format!("{name}_{ending}");
                    self.add(name, Kind::Force, text, move |loads| {
                        value(&loads.wedges[number].halves[half])
                    });
                }
                self.add_places(&name, texts, move |loads| {
                    let own = &loads.wedges[number].halves[half];
                    [own.displacement, own.angles]
                });
            }
            let name = format!("{wedge}_split_normal");
            self.add(
                name,
                Kind::Force,
                "normal force between the halves",
                move |loads| loads.wedges[number].split_normal,
            );
        }
    }

    /// The rises of the wedges.
    pub fn rises(&mut self) {
        for (number, name) in WEDGE_NAMES.into_iter().enumerate() {
            let text = "height in its pocket above that of an unworn wedge in the nominal layout, as a gauge \
                        shows it";
            self.add(format!("{name}_rise"), Kind::Length, text, move |loads| {
                loads.wedges[number].rise
            });
        }
    }

    /// Load and moments of the center plate.
    pub fn center_plate(&mut self) {
        let text = "normal force of the center plate";
        self.add("center_plate_load", Kind::Force, text, |loads| {
            loads.center_plate.load
        });
        for (k, name) in ["roll", "pitch", "turning"].into_iter().enumerate() {
            let text =
                "moment of the center plate on the bolster about the truck's axes, at the plate's height";
            let name = format!("center_plate_{name}_moment");
            self.add(name, Kind::Moment, text, move |loads| {
                loads.center_plate.moment[k]
            });
        }
    }

    /// Forces of side bearings, if they have hysteresis.
    pub fn side_bearings(&mut self, parameters: &Parameters) {
        let car = parameters.car_body.as_ref();
        if car.and_then(|own| own.side_bearings.kind.hysteresis()).is_none() {
            return;
        }
        for (side, name) in SIDES.into_iter().enumerate() {
            let text = "force of the side bearing on the car body along z of the bolster: spring, solid stop \
                        and hysteresis";
            let force = format!("{name}_side_bearing_force");
            self.add(force, Kind::Force, text, move |loads| {
                loads.side_bearings[side].force
            });
            let text = "its part of the hysteresis, positive in compression";
            let hysteresis = format!("{name}_side_bearing_hysteresis");
            self.add(hysteresis, Kind::Force, text, move |loads| {
                loads.side_bearings[side].hysteresis
            });
        }
    }
}

/// The faces of a wedge, of which the last is that between halves.
pub(crate) const FACES: [&str; 3] = ["column", "slope", "split"];

/// Returns the names that a face of a wedge (`leading_left`) may have: that of the whole, those of halves.
pub(crate) fn names_of_face(wedge: &str, face: &str) -> [String; 3] {
    let [outboard, inboard] = HALVES.map(|half| format!("{wedge}_{half}_{face}"));
    [format!("{wedge}_{face}"), outboard, inboard]
}

/// Returns the places among the energy terms of what a wedge loses in friction at these faces.
pub(crate) fn losses_at(system: &System, wedge: &str, faces: &[&str]) -> Vec<usize> {
    let names = faces.iter().flat_map(|face| names_of_face(wedge, face));
    let names: Vec<String> = names.collect();
    places_of(system, |kind, element| match kind {
        EnergyTermKind::FrictionLoss => names.iter().any(|name| name == element),
        EnergyTermKind::ColumnFriction => element == wedge && faces.contains(&"column"),
        EnergyTermKind::SlopeFriction => element == wedge && faces.contains(&"slope"),
        _ => false,
    })
}

/// Returns the places of the energy terms of which kind and element are wanted.
pub(crate) fn places_of(system: &System, wanted: impl Fn(EnergyTermKind, &str) -> bool) -> Vec<usize> {
    let terms = system.energy_terms().iter().enumerate();
    let own = terms.filter(|(_, term)| wanted(term.kind, &term.element));
    own.map(|(place, _)| place).collect()
}
