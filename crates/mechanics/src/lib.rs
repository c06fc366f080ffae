//! Rigid bodies with free coordinates, and the elements between them.
//!
//! Bodies have absolute coordinates, each measured from its own reference frame ([`body`], [`frame`]).
//! Elements compute a force and a moment from the relative motion of markers on two bodies ([`link`],
//! [`contact`], [`coil`]). A [`system::System`] assembles them for the integrator, with exact derivatives
//! from the same functions, and an energy ledger. [`connection`]s, the element laws of the industry's vehicle
//! programs, act on coordinates instead.
//!
//! ```
//! use mechanics::body::Body;
//! use mechanics::coil::{Coil, CoilLaw};
//! use mechanics::frame::Frame;
//! use mechanics::link::Marker;
//! use mechanics::system::{Model, System};
//! use mechanics::vector::Vector;
//!
//! let ground = Body::prescribed("ground", Frame::fixed([0.0; 3], [0.0; 3]));
//! let mass = Body { mass: 2.0, free: [false, false, true, false, false, false], ..ground.clone() }; // kg
//! let spring = Coil {
//!     end: Vector([0.0; 3]),
//!     acts_at: Vector([0.0; 3]),
//!     law: CoilLaw::Linear { stiffness: 100.0 }, // N/m
//!     free_length: 1.0,
//!     damping: 0.0,
//!     rotational_damping: 0.0,
//!     pulls: true,
//! };
//! let below = Marker::new([0.0, 0.0, -1.0], [0.0; 3]);
//! let model = Model {
//!     bodies: vec![ground, mass],
//!     gravity: [0.0, 0.0, -10.0],
//!     coils: vec![(1, 0, below, spring)],
//!     ..Model::default()
//! };
//! let mut system = System::new(model)?;
//! let seen = system.observe(0.0, &[0.1, 0.0]); // 0.1 m above its place, at rest
//! let (lifted, stretched) = (2.0 * 10.0 * 0.1, 0.5 * 100.0 * 0.1_f64.powi(2)); // J
//! assert!((seen.energies.gravity - lifted).abs() < 1e-12);
//! assert!((seen.energies.coil - stretched).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Modules
//!
//! - `vector`, `orientation`, `frame`: algebra, the three angles, reference frames that may move;
//! - `body`: a rigid body, its kinematics finite or linearized; mass matrix, inertia forces;
//! - `link`: `Marker`; pose and twist of a body relative to a marker, on which elements depend
//!   (`RelativeMotion`);
//! - `contact`, `contact/`, `surface`, `friction/`, `coil`, `characteristic`: the elements and their laws;
//!   points of a face four at a time, on planes and curved surfaces, plain or refined by an `Interface`;
//! - `motion`, `spline`: prescribed motions with their derivatives and discontinuities;
//! - `system/model.rs`, `build.rs`: `Model` (bodies with finite or linearized kinematics, carriers of bodies
//!   that spin, faces, coils, connections) → `System`;
//! - `system/kinematics.rs`: frames, markers and bodies at a time and a state: all, or those of one face;
//! - `system/forces.rs`: the right-hand side;
//! - `system/jacobian.rs`: the Jacobian, element by element, and the derivatives of inertia;
//! - `system/contact_states.rs`: open, stick, slip, and their thresholds;
//! - `system/observe.rs`, `loads.rs`, `energies.rs`, `contact_losses.rs`: derived quantities: all of them;
//!   forces and moments alone; stored energies alone; powers lost at contact points alone;
//! - `system/equilibrium.rs`: states of rest;
//! - `energy_balance`: the residual of an energy ledger, and its limits;
//! - `plausibility`: implausible findings in a run of any system, with their limits: an observer at output
//!   times, whose record is saved with the run;
//! - `output`: `Column`: name, kind, axes, reference point, text;
//! - `system/inputs.rs`, `evaluation.rs`, `jacobian_vector_product.rs`: prescribed motions as inputs;
//!   evaluation of all elements for any scalar; directional derivatives;
//! - `quasi_static`: the massless wedge;
//! - `element`: trait `Element`, and the part of a system that holds elements of any kind; either body of an
//!   element may be prescribed;
//! - `elements/`: elements of suspensions, one file per law: spring with shear and solid height, stop with
//!   clearance, rim;
//! - `tangent`: the wrench of an element and its derivatives by the relative motion of its markers;
//! - `connection/`: laws of differences of coordinates, one file per law: spring-dampers, gaps, surface
//!   friction, the industry's wedges; their location, with constant rows or between markers (`between.rs`),
//!   their derivatives, their contact states;
//! - `curve`: piecewise linear curves;
//! - `system/chain.rs`: derivatives of an element's relative motion by the coordinates of the bodies at both
//!   ends: its rows of the Jacobian;
//! - `system/vibration.rs`: stiffness matrix, natural frequencies and shapes;
//! - `system/eigenvalues.rs`: eigenvalues of damped and steadily driven motion.

pub mod body;
pub mod channel;
pub mod characteristic;
pub mod coil;
pub mod connection;
pub mod contact;
mod contact_state;
pub mod curve;
pub mod depth_surface;
pub mod element;
pub mod elements;
mod energy;
pub mod energy_balance;
pub mod frame;
pub mod friction;
pub mod linear;
pub mod link;
pub mod motion;
pub mod orientation;
pub mod output;
mod parts;
pub mod plausibility;
pub mod quasi_static;
pub mod spline;
pub mod surface;
pub mod system;
pub mod vector;
mod without_roll;
