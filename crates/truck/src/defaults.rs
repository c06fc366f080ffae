//! Default values: one consistent set, a car of 263,000 lbf on two trucks.

use std::f64::consts::PI;

use mechanics::friction::FrictionLaw;
use mechanics::surface::SurfaceProfile;
use wedge::face::{FaceDirection, FaceProfile, FaceProperties, Grid};
use wedge::parameters::{Contact, Damping, FaceFriction, NeighbourMotion, STANDARD_GRAVITY, Start, Wear};

use crate::geometry::Geometry;
use crate::parameters::{
    Adapter, AdapterPad, Bolster, CarBody, CenterPlate, Clearance, ControlCoil, FrictionAdapter, Hysteresis,
    Lading, NestCoil, Parameters, RigidBody, SideBearing, SideBearings, SideFrame, Split, Spring, Wedge,
    WedgeKind, Wheelsets, unloaded,
};
use crate::units::{INCH, POUND, POUND_FORCE, POUND_INCH, POUND_PER_INCH, inches};

/// The radius of the crown of slope faces in service, m: 240 in, a choice, in no source.
pub const CROWN_RADIUS: f64 = 240.0 * INCH;
/// The points of faces in service: two rows of nine across, which are within 3 % of finer grids in warp.
pub const SERVICE_GRID: Grid = Grid { up: 2, across: 9 };

/// Weight lbf, moments of inertia lbf·in·s², height in.
fn body(weight: f64, inertia: [f64; 3], height: f64) -> RigidBody {
    RigidBody {
        mass: weight * POUND,
        inertia: inertia.map(|i| i * POUND_INCH),
        height: height * INCH,
    }
}

/// Clearance in, stiffness lbf/in, damping lbf·s/in.
fn clearance([clearance, stiffness, damping]: [f64; 3]) -> Clearance {
    Clearance {
        clearance: clearance * INCH,
        stiffness: stiffness * POUND_PER_INCH,
        damping: damping * POUND_PER_INCH,
    }
}

/// Preload lbf, stiffness and shear stiffness lbf/in, damping lbf·s/in; travel to solid height, in.
fn spring([preload, stiffness, shear, damping]: [f64; 4], solid: Option<f64>) -> Spring {
    Spring {
        preload: preload * POUND_FORCE,
        stiffness: stiffness * POUND_PER_INCH,
        shear_stiffness: shear * POUND_PER_INCH,
        damping: damping * POUND_PER_INCH,
        solid: solid.map(|travel| [travel * INCH, 250_000.0 * POUND_PER_INCH]),
    }
}

/// Stiffness lbf/in and damping lbf·s/in of a point.
fn contact(stiffness: f64, damping: f64) -> Contact {
    Contact {
        stiffness: stiffness * POUND_PER_INCH,
        damping: damping * POUND_PER_INCH,
    }
}

/// Bristle stiffness lbf/in and damping lbf·s/in of a face.
fn bristle(coefficient: f64, stiffness: f64, damping: f64) -> FaceFriction {
    FaceFriction {
        coefficient,
        law: FrictionLaw::Bristle {
            stiffness: stiffness * POUND_PER_INCH,
            damping: damping * POUND_PER_INCH,
        },
    }
}

impl Bolster {
    /// Returns a bolster that is rigid with half of a car, and can only move up and down: half a car on one
    /// truck falls over in pitch. The inertia of the empty one is a guess.
    #[must_use]
    pub fn with_half_car(lading: Lading) -> Self {
        Self {
            body: match lading {
                Lading::Loaded => body(123_030.0, [0.922_76e6, 8.3502e6, 8.352_76e6], 83.0),
                Lading::Empty => body(22_830.0, [1.90e5, 1.80e6, 1.80e6], 62.0),
            },
            free: [false, false, true, false, false, false],
            motion: NeighbourMotion::fixed(),
            applied: unloaded(),
        }
    }
}

/// Returns the values of an adapter of steel.
fn steel_adapter() -> FrictionAdapter {
    FrictionAdapter {
        preload: 15_691.0 * POUND_FORCE,
        contact: contact(1e6, 1000.0),
        friction: bristle(0.5, 2e6, 2e3),
        longitudinal: clearance([0.0468, 5e5, 50.0]),
        lateral: clearance([0.25, 1e6, 100.0]),
    }
}

impl Adapter {
    /// Returns an adapter of steel.
    ///
    /// The stiffness of a point, 1e6 lbf/in, is a guess from below: the roof of a pedestal on a crowned
    /// adapter is a line contact of some 6 in, which gives by 3e-8 in a pound (Hertz; derived), a fifteenth
    /// of what both points give; the rest is the pedestal's. Softer points (5e5 lbf/in) let a car that rocks
    /// sink by 0.06 in into its adapters.
    #[must_use]
    pub fn friction() -> Self {
        Self::Friction(steel_adapter())
    }

    /// Returns an elastomeric pad with the least stiffnesses that claim 32 of US patent 9,637,143 names, as
    /// stiff vertically as steel (a guess).
    #[must_use]
    pub fn pad() -> Self {
        Self::Pad(AdapterPad {
            preload: 31_382.0 * POUND_FORCE,
            stiffness: 1e6 * POUND_PER_INCH,
            shear_stiffness: 45_000.0 * POUND_PER_INCH,
            half_distance: 2.357 * INCH,
            damping: 100.0 * POUND_PER_INCH,
        })
    }
}

impl SideBearings {
    /// Returns rollers with a clearance of 0.25 in.
    #[must_use]
    pub fn rollers() -> Self {
        Self {
            distance: 25.0 * INCH,
            kind: SideBearing::Roller(clearance([0.25, 1e6, 500.0])),
        }
    }

    /// Returns constant-contact side bearings of 6,000 lbf with 5/8 in of travel.
    #[must_use]
    pub fn constant_contact() -> Self {
        Self {
            distance: 25.0 * INCH,
            kind: SideBearing::ConstantContact {
                preload: 6000.0 * POUND_FORCE,
                contact: contact(6000.0, 0.0),
                travel: 0.625 * INCH,
                solid: contact(1e6, 500.0),
                friction: bristle(0.3, 1e5, 100.0),
                hysteresis: None,
            },
        }
    }
}

impl Default for Hysteresis {
    /// Returns none yet: a limit of 0, behind 30,000 lbf/in, five times the rate of the bearing (a guess).
    fn default() -> Self {
        Self {
            limit: 0.0,
            stiffness: 3e4 * POUND_PER_INCH,
            damping: 30.0 * POUND_PER_INCH,
        }
    }
}

impl CarBody {
    /// Returns half of a car's body, free to bounce and to roll, on a center plate of 14 in with a friction
    /// of 0.2.
    ///
    /// The plate's stiffness (3e6 lbf/in a point), the rim's clearance (0.1875 in), and inertia and center of
    /// gravity of the empty body are guesses.
    #[must_use]
    pub fn new(lading: Lading, side_bearings: SideBearings) -> Self {
        Self {
            body: match lading {
                Lading::Loaded => body(121_730.0, [0.905e6, 8.12e6, 8.12e6], 83.75),
                Lading::Empty => body(21_530.0, [1.875e5, 1.805e6, 1.805e6], 65.0),
            },
            free: [false, false, true, true, false, false],
            applied: unloaded(),
            center_plate: CenterPlate {
                height: 30.0 * INCH,
                rings: vec![7.0 * INCH, 7.0 * INCH / 3.0],
                points: 8,
                contact: contact(3e6, 500.0),
                friction: bristle(0.2, 16e6, 16e3),
                rim: clearance([0.1875, 1e6, 500.0]),
            },
            side_bearings,
        }
    }
}

impl Parameters {
    /// Returns a new truck of a loaded car of 263,000 lbf: bolster held, side frames free on wheelsets that
    /// stand still. Wedges bear on the corners of flat faces, adapters have 5e5 lbf/in a point, as in the
    /// rigs that independent simulations have checked; [`Parameters::in_service`] has others.
    #[must_use]
    pub fn new(damping: Damping) -> Self {
        let (degrees, coil, control) = match damping {
            Damping::Constant => (
                37.5,
                spring([15_403.8, 6468.7, 4450.0, 0.0], Some(1.306)),
                spring([3702.2, 1979.0, 1346.0, 1.0], None),
            ),
            Damping::Variable => (
                32.0,
                spring([12_252.1, 5369.5, 3616.0, 0.0], Some(1.406)),
                spring([6303.0, 1937.0, 1317.0, 1.0], Some(1.4085)),
            ),
        };
        let angle = degrees * PI / 180.0;
        let prism = body(50.0, [1.461, 0.3756, 1.295], 18.0);
        let wedge = Wedge {
            kind: WedgeKind::Body,
            angle,
            slope_across: 0.0,
            height: 6.125 * INCH,
            width: 10.5 * INCH,
            mass: prism.mass,
            inertia: prism.inertia,
            free: [true; 6],
            toe: 0.0,
            contact: contact(2.5e5, 25.0),
            column_friction: bristle(0.4, 1e6, 1e3),
            slope_friction: bristle(0.4, 1e6, 1e3),
            column_face: FaceProperties::default(),
            slope_face: FaceProperties::default(),
            wear: Wear::default(),
            // A guess: a quarter of the wedge's height.
            rise_limit: 1.5 * INCH,
            control_coil: ControlCoil::Shear(control),
            pocket_sides: clearance([0.25, 1e6, 100.0]),
            split: Split {
                angle: 0.0,
                gap: 0.0,
                friction: bristle(0.4, 1e6, 1e3),
                outboard_share: 0.5,
                coil_distance: 0.25 * 10.5 * INCH,
            },
        };
        let quarter = |x: f64, y: f64| NestCoil {
            place: inches([3.75 * x, 3.75 * y]),
            spring: coil,
        };
        let nest = vec![
            quarter(1.0, 1.0),
            quarter(1.0, -1.0),
            quarter(-1.0, 1.0),
            quarter(-1.0, -1.0),
        ];
        let side_frame = SideFrame {
            body: body(1150.5, [900.0, 1370.0, 1370.0], 18.0),
            free: [true; 6],
            motion: NeighbourMotion::fixed(),
            applied: unloaded(),
        };
        Self {
            damping,
            gravity: STANDARD_GRAVITY,
            geometry: Geometry::default(),
            bolster: Bolster {
                body: body(1300.0, [2915.0, 142.0, 2930.0], 22.0),
                free: [false; 6],
                motion: NeighbourMotion::fixed(),
                applied: unloaded(),
            },
            side_frames: [side_frame.clone(), side_frame],
            wheelsets: Some(Wheelsets {
                motions: [NeighbourMotion::fixed(), NeighbourMotion::fixed()],
                pitching: true,
                adapter: Adapter::Friction(FrictionAdapter {
                    contact: contact(5e5, 1000.0),
                    ..steel_adapter()
                }),
            }),
            wedges: [wedge.clone(), wedge.clone(), wedge.clone(), wedge],
            load_coils: [nest.clone(), nest],
            gib: clearance([0.5, 4e6, 1000.0]),
            lands: clearance([0.21, 5e5, 50.0]),
            warp_spring: None,
            car_body: None,
            start: Start::Rest,
            lift: 0.0,
        }
    }

    /// Returns the truck with wedges and adapters as they are in service: the slope faces of all wedges
    /// crowned across, with a radius of 240 in, and 2 × 9 points on both faces; [`Adapter::friction`].
    ///
    /// The faces of [`Parameters::new`] are flat and bear on their corners, as the thesis has them, and
    /// resist warp two to four times as much. The radius is in no source: it is a choice, and neither warp
    /// nor hunting has found it.
    #[must_use]
    pub fn in_service(mut self) -> Self {
        if let Some(wheelsets) = &mut self.wheelsets {
            wheelsets.adapter = Adapter::friction();
        }
        for wedge in &mut self.wedges {
            wedge.column_face = FaceProperties {
                grid: SERVICE_GRID,
                ..FaceProperties::default()
            };
            wedge.slope_face = FaceProperties {
                grid: SERVICE_GRID,
                wedge_surface: FaceProfile {
                    profile: SurfaceProfile::Arc {
                        curvature: 1.0 / CROWN_RADIUS,
                    },
                    direction: FaceDirection::Across,
                    worn_flat: 0.0,
                },
                ..FaceProperties::default()
            };
        }
        self
    }

    /// Sets the friction of all wedges on both faces.
    #[must_use]
    pub fn with_wedge_friction(mut self, coefficient: f64) -> Self {
        for wedge in &mut self.wedges {
            wedge.column_friction.coefficient = coefficient;
            wedge.slope_friction.coefficient = coefficient;
        }
        self
    }
}
