//! A force element of one's own in a case: a spring that hardens with the cube of its compression.
//!
//! `cargo run --release -p study --example own_element`

use std::path::Path;
use std::sync::Arc;

use mechanics::element::{Element, Inputs, Wrench};
use mechanics::link::RelativeMotion;
use mechanics::vector::Vector;
use numerics::scalar::Real;
use quantity::Kind;
use study::run::Run;
use study::vehicle::{OwnElement, OwnKey, VehicleCase};
use vehicle::catalog::{CatalogElement, Place};

/// The law: upright, `F = k d + k d³/s²` against the displacement d of end A over end B.
#[derive(Clone, Debug)]
struct Hardening {
    name: String,
    stiffness: f64,
    scale: f64,
}

impl Element for Hardening {
    fn name(&self) -> &str {
        &self.name
    }
    fn inputs(&self) -> Inputs {
        Inputs::Points
    }
    fn evaluate<S: Real>(&self, motion: &RelativeMotion<S>) -> Wrench<S> {
        let d = motion.position.0[2];
        let cubic = d * d * d * (self.stiffness / (self.scale * self.scale));
        Wrench {
            force: Vector([S::zero(), S::zero(), -(d * self.stiffness) - cubic]),
            moment: Vector::zero(),
            powers: [S::zero(); 2],
        }
    }
    fn energy(&self, motion: &RelativeMotion<f64>) -> f64 {
        let d = motion.position.0[2];
        0.5 * self.stiffness * d * d * (1.0 + 0.5 * d * d / (self.scale * self.scale))
    }
}

/// Its place in a vehicle: where it acts, and what is seen of it.
#[derive(Debug)]
struct HardeningSpring {
    stiffness: f64,
    scale: f64,
}

impl CatalogElement for HardeningSpring {
    fn add(&self, place: &mut Place<'_>) -> Result<(), String> {
        let law = Hardening {
            name: place.name.to_owned(),
            stiffness: self.stiffness,
            scale: self.scale,
        };
        let ends = [0, 1].map(|end| place.marker(end, [0.0; 3]));
        place.wrench_channels(&law, ends, ([false, false, true], [false; 3]));
        place.element(law, ends[0], ends[1]);
        Ok(())
    }
}

/// Its kind and its keys in cases.
static OWN: [OwnElement; 1] = [OwnElement {
    kind: "hardening_spring",
    keys: &[
        OwnKey {
            key: "stiffness",
            kind: Kind::Stiffness,
            default: None,
            comment: "at the nominal place",
        },
        OwnKey {
            key: "scale",
            kind: Kind::Length,
            default: Some(0.05),
            comment: "displacement at which its force is twice the linear one",
        },
    ],
    make: |values| {
        Arc::new(HardeningSpring {
            stiffness: values[0],
            scale: values[1],
        })
    },
}];

const CASE: &str = r#"
model = "vehicle"
environment.gravity = "0 m/s^2"
start.kind = "nominal"

[bodies.block]
weight = "980.665 N"
at = ["0 m", "0 m", "1 m"]
free_coordinates = ["z"]
offset = ["0 m", "0 m", "0.05 m"]

[elements.spring]
kind = "hardening_spring"
a = "block"
b = "ground"
at = ["0 m", "0 m", "1 m"]
stiffness = "1e5 N/m"

[simulation]
duration = "2 s"
output_units = "si"
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let case = VehicleCase::parse_with("own.toml", CASE, Path::new(""), &[], &OWN)?;
    let result = Run::new(&case)?.finish(|_| ());
    let force = result.column("spring_force_z").unwrap_or_default();
    let most = force.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    println!("largest force {most:.1} N, twice that of a linear spring of 1e5 N/m at 0.05 m");
    assert!((most - 1e4).abs() < 1.0, "{most}");
    assert!(result.summary.complete);
    Ok(())
}
