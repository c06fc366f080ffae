//! Coils at rest: what they carry, how far they are down, what is left of their travel.

use mechanics::element::Element;
use mechanics::system::Observation;

use crate::assemble::{INBOARD_HALVES, SIDE_FRAMES, Truck, WEDGES};
use crate::elements::{Law, Role};
use crate::loads::relative_motion;
use crate::mounted::MountedTruck;

/// Coils that act together: those of a nest, or those under a wedge.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CoilGroup {
    /// Their load, N.
    pub load: f64,
    /// Down from their free height, the mean by their stiffness, m; none of coils by a table.
    pub deflection: Option<f64>,
    /// Down to where the first coil is solid, m; none of coils that never are.
    pub reserve: Option<f64>,
    /// Their load there, N.
    pub solid_load: Option<f64>,
}

/// The coils of a truck at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TruckStatics {
    /// Load coils of the left and of the right nest.
    pub nests: [CoilGroup; 2],
    /// Control coils, in the order of [`WEDGE_NAMES`](crate::WEDGE_NAMES); none of broken coils, of those of
    /// the thesis, and of wedges without mass.
    pub control_coils: [Option<CoilGroup>; 4],
}

/// A coil: its load (N); by its numbers how far it is down, its stiffness (N/m), and what is left (m).
struct CoilState {
    load: f64,
    law: Option<(f64, f64, Option<f64>)>,
}

impl CoilGroup {
    /// Returns a group; none without coils.
    fn of(coils: &[CoilState]) -> Option<Self> {
        if coils.is_empty() {
            return None;
        }
        let laws: Option<Vec<_>> = coils.iter().map(|coil| coil.law).collect();
        let load = coils.iter().map(|coil| coil.load).sum();
        let Some(laws) = laws else {
            return Some(Self {
                load,
                ..Self::default()
            });
        };
        let stiffness: f64 = laws.iter().map(|(_, k, _)| k).sum();
        let deflection = Some(laws.iter().map(|(down, k, _)| down * k).sum::<f64>() / stiffness);
        let reserve = laws.iter().filter_map(|(.., left)| *left).reduce(f64::min);
        let solid_load = reserve.map(|left| load + stiffness * left);
        Some(Self {
            load,
            deflection,
            reserve,
            solid_load,
        })
    }
}

impl Truck {
    /// Returns the coils at an observation of [`Truck::system`].
    #[must_use]
    pub fn statics(&self, observation: &Observation) -> TruckStatics {
        self.mounted.statics(observation)
    }
}

impl MountedTruck {
    /// Returns the coils at an observation of the system in which the truck is.
    #[must_use]
    pub fn statics(&self, observation: &Observation) -> TruckStatics {
        let mut nests: [Vec<CoilState>; 2] = Default::default();
        let mut wedges: [Vec<CoilState>; 4] = Default::default();
        let numbers = &self.mount.bodies;
        for element in &self.added.suspension {
            let (_, _, motion) = relative_motion(&element.ends, &observation.bodies);
            let coil = match &element.law {
                Law::Spring(spring) => {
                    let [.., d] = motion.position.0;
                    CoilState {
                        load: spring.evaluate(&motion).force.0[2],
                        law: Some((
                            spring.preload / spring.stiffness - d,
                            spring.stiffness,
                            spring.solid.map(|solid| d - solid.at),
                        )),
                    }
                }
                Law::Table(spring) => CoilState {
                    load: spring.evaluate(&motion).force.0[2],
                    law: None,
                },
                // Of adapters.
                Law::Pad(_) | Law::Stop(_) | Law::Rim(_) => continue,
            };
            let [(a, _), (b, _)] = element.ends;
            match element.role {
                Role::LoadCoil => {
                    if let Some(side) = (0..2).find(|side| b == numbers[SIDE_FRAMES + side]) {
                        nests[side].push(coil);
                    }
                }
                Role::ControlCoil => {
                    let carries =
                        |wedge: &usize| a == numbers[WEDGES + wedge] || a == numbers[INBOARD_HALVES + wedge];
                    if let Some(wedge) = (0..4).find(carries) {
                        wedges[wedge].push(coil);
                    }
                }
                _ => {}
            }
        }
        TruckStatics {
            nests: nests.map(|own| CoilGroup::of(&own).unwrap_or_default()),
            control_coils: wedges.map(|own| CoilGroup::of(&own)),
        }
    }
}
