//! The catalog of elements between two bodies, one file a kind.
//!
//! | kind in cases | law |
//! |---|---|
//! | `spring`, `damper`, `link`, `gap` | [`Line`]: along the line between two points |
//! | `coil` | [`Coil`]: stands on a seat, with shear stiffness, and lifts off |
//! | `bushing` | [`Bushing`]: along and about three axes |
//! | `stop` | [`AxisStop`]: clearances along one axis |
//! | `dry_friction` | [`DryFriction`]: a bristle in series with a slider, in a plane |
//! | `wedge` | [`FrictionWedge`]: a rigid body with faces on pocket and column, and its control coil |
//! | `center_plate`, `side_bearing`, `adapter` | [`Plate`], [`Bearing`], [`AxleAdapter`] |
//! | `coupler` | [`Coupler`]: a given force at the end of a car, towards a like neighbor |
//! | `draft_gear` | [`DraftGear`]: a friction gear between two couplers |
//! | `force` | [`AppliedForce`]: a force over time; [`ForceOverDistance`] |
//!
//! An element of one's own implements [`CatalogElement`].

mod bushing;
mod coil;
mod coupler;
mod draft_gear;
mod force;
mod force_over_distance;
mod friction;
mod line;
mod plate;
mod stop;
mod wedge;

use std::fmt::Debug;
use std::sync::Arc;

use mechanics::body::Body;
use mechanics::element::Element as Law;
use mechanics::link::Marker;
use mechanics::output::Column;
use mechanics::system::Model;
use mechanics::vector::Vector;
use quantity::Kind;
use wheelrail::track::RailLines;

pub use bushing::Bushing;
pub use coil::Coil;
pub use coupler::Coupler;
pub use draft_gear::DraftGear;
pub use force::AppliedForce;
pub use force_over_distance::ForceOverDistance;
pub use friction::DryFriction;
pub use line::Line;
pub use plate::{AxleAdapter, Bearing, Plate};
pub use stop::AxisStop;
pub use wedge::FrictionWedge;

use crate::channel::{self, Channels, View};
use crate::drawing::Drawn;

/// One end of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attachment {
    /// The body: 0 is the ground, then those of the description from 1.
    pub body: usize,
    /// Its place in the nominal layout, m.
    pub at: [f64; 3],
}

/// An element between two bodies.
#[derive(Clone, Debug)]
pub struct Element {
    /// Its name, with which those of its columns begin.
    pub name: String,
    /// Its ends A and B: forces are those on the body with end A.
    pub ends: [Attachment; 2],
    /// Its law.
    pub law: Arc<dyn CatalogElement>,
}

/// A kind of elements.
pub trait CatalogElement: Debug + Send + Sync {
    /// Adds it to a model that has all bodies, in their nominal places, and says what is seen of it.
    ///
    /// # Errors
    /// It cannot stand there: the reason.
    fn add(&self, place: &mut Place<'_>) -> Result<(), String>;

    /// Returns the bodies of its own, in their nominal places; `ends` are its places there, m.
    fn bodies(&self, _name: &str, _ends: [[f64; 3]; 2]) -> Vec<Body> {
        Vec::new()
    }

    /// Returns what stands in its place while the vehicle comes to rest, if it is something else: the element
    /// without the friction that a rest may not depend on.
    fn at_rest(&self) -> Option<Arc<dyn CatalogElement>> {
        None
    }

    /// Returns the form in which it is drawn.
    fn drawn(&self) -> Drawn {
        Drawn::Line
    }

    /// Returns the places between which it is drawn, from those of its ends in the nominal layout, m.
    fn drawn_between(&self, ends: [[f64; 3]; 2]) -> [[f64; 3]; 2] {
        ends
    }
}

/// The place of an element in a model.
#[derive(Debug)]
pub struct Place<'p> {
    /// Its name.
    pub name: &'p str,
    /// The model.
    pub model: &'p mut Model,
    /// The numbers of the bodies with its ends A and B, and their places in the nominal layout, m.
    pub ends: [(usize, [f64; 3]); 2],
    /// The numbers of the bodies of its own.
    pub own: &'p [usize],
    /// The rails, if the vehicle is on a track.
    pub lines: Option<&'p Arc<RailLines>>,
    /// What is seen of it.
    pub channels: &'p mut Vec<Channels>,
}

impl Place<'_> {
    /// Returns the marker of an end (0 A, 1 B), turned by roll, pitch, yaw (rad).
    #[must_use]
    pub fn marker(&self, end: usize, angles: [f64; 3]) -> (usize, Marker) {
        let (body, at) = self.ends[end];
        (body, self.model.bodies[body].marker(at, angles))
    }

    /// Returns a column, whose name begins with that of the element.
    fn column(&self, name: &str, kind: Kind, text: &str) -> Column {
        channel::column(
            format!("{}_{name}", self.name),
            kind,
            format!("{}: {text}", self.name),
        )
    }

    /// Adds a channel, whose name begins with that of the element.
    pub fn channel(
        &mut self,
        name: &str,
        kind: Kind,
        text: &str,
        read: impl Fn(&View<'_>) -> f64 + Send + Sync + 'static,
    ) {
        let column = self.column(name, kind, text);
        self.channels.push(Channels::single(column, read));
    }

    /// Adds a force element between markers.
    pub fn element(&mut self, law: impl Law, a: (usize, Marker), b: (usize, Marker)) {
        self.model.add(law, a, b);
    }

    /// Adds channels of the wrench of an element on end A: the force along these axes of marker B, and the
    /// moments about them.
    pub fn wrench_channels(
        &mut self,
        law: &impl Law,
        [a, b]: [(usize, Marker); 2],
        (along, about): ([bool; 3], [bool; 3]),
    ) {
        let chosen = |chosen: [bool; 3]| (0..3).filter(move |k| chosen[*k]);
        let forces = chosen(along).map(|k| {
            let axis = ["x", "y", "z"][k];
            let text = format!("force on end A along {axis} of end B");
            self.column(&format!("force_{axis}"), Kind::Force, &text)
        });
        let moments = chosen(about).map(|k| {
            let axis = ["roll", "pitch", "yaw"][k];
            let text = format!("moment on end A about the axis of {axis} of end B");
            self.column(&format!("moment_{axis}"), Kind::Moment, &text)
        });
        let (columns, law) = (forces.chain(moments).collect(), law.clone());
        self.channels.push(Channels::new(columns, move |view, row| {
            let wrench = law.evaluate::<f64>(&view.relative(a, b));
            row.extend(chosen(along).map(|k| wrench.force.0[k]));
            row.extend(chosen(about).map(|k| wrench.moment.0[k]));
        }));
    }

    /// Adds channels of a face (its number): normal force, size of the friction force, and power lost in it.
    pub fn face_channels(&mut self, prefix: &str, face: usize) {
        let name = |what: &str| match prefix {
            "" => what.to_owned(),
            prefix => format!("{prefix}_{what}"),
        };
        let sum = |forces: &[Vector<f64>]| {
            let sum = forces.iter().fold(Vector::zero(), |sum, own| sum + *own);
            sum.dot::<f64, f64>(sum).sqrt()
        };
        let text = "normal force, all points together";
        self.channel(&name("normal_force"), Kind::Force, text, move |view| {
            let points = view.seen.faces[face].points.iter();
            points.map(|point| point.normal).sum()
        });
        let text = "size of the friction force";
        self.channel(&name("friction_force"), Kind::Force, text, move |view| {
            sum(&view.seen.faces[face].friction_forces)
        });
        let text = "power lost in friction";
        self.channel(&name("friction_loss_power"), Kind::Power, text, move |view| {
            view.seen.faces[face].friction_loss
        });
    }
}
