//! Wedges with mass in place of the files' massless ones.
//!
//! Each wedge of type 6.8 or 6.9 becomes a body between the two bodies of its connection, mounted as in a
//! truck ([`truck::add_wedge`]). The files say its place, its angle, both coefficients of friction, the
//! accumulator (bristles here), its coil and the column. What they do not say is added from a truck's nominal
//! wedge, and [`replace`] says so in words. The connection stays: without force, it measures the strokes.

use mechanics::connection::{Accumulator, ColumnFace, Law, SpringDamper, Wedge as Massless};
use mechanics::elements::TableSpring;
use mechanics::friction::FrictionLaw;
use nucars::truck::{Choices, Truck, WedgeBody};
use quantity::{Kind, System as Units};
use truck::{ControlCoil, Parameters, Wedge, WedgeMount, add_wedge, wedge_body};
use wedge::parameters::{Damping, FaceFriction};

mod error;
mod words;

pub use error::WedgeBodyError;
use words::{measure, rounded, warp_springs};

const INCH: f64 = 0.0254;
/// The compression up to which a coil must push, m.
const COMPRESSION: f64 = INCH;
/// Shear stiffness of a coil as a share of its stiffness: 1346 of 1979 lbf/in, 1317 of 1937.
const SHEAR_SHARE: f64 = 0.68;
/// Radius of a ring of springs that resists tilt as the coil does, m: a guess.
const COIL_RADIUS: f64 = 2.0 * INCH;
/// Inclinations of a column that differ by no more are one, rad.
const SAME_INCLINATION: f64 = 1e-6;
/// Wedges that are no farther apart along the track are at one place, m.
const SAME_PLACE: f64 = 1e-6;

/// A wedge that is a body: where it and its elements are in the model.
#[derive(Clone, Debug, PartialEq)]
pub struct MountedWedge {
    /// Its connection, which measures its strokes.
    pub connection: usize,
    /// Its body.
    pub body: usize,
    /// The body with the pocket.
    pub bolster: usize,
    /// The body with the column.
    pub side_frame: usize,
    /// Column and slope among the faces.
    pub faces: [usize; 2],
    /// Its coil among the elements.
    pub coil: usize,
    /// The place of its coil: in the pocket (constant) or on the side frame (variable).
    pub damping: Damping,
    /// Its center of gravity in the drawn layout, m.
    pub center: [f64; 3],
    /// +1: its column lies ahead of it (+x), -1: behind.
    pub end: f64,
    /// Its size, faces and coil; its column is as deep as it is at the start.
    pub wedge: Wedge,
    /// The components of its connection, as coordinates.
    pub components: Vec<usize>,
}

/// The replaced wedges, and the additions in words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Replaced {
    /// The wedges.
    pub wedges: Vec<MountedWedge>,
    /// Their assumptions.
    pub assumptions: Vec<String>,
}

/// Replaces the massless wedges of types 6.8 and 6.9 by bodies; `units` are those of the words.
///
/// # Errors
/// [`WedgeBodyError`]: the files do not describe enough.
pub fn replace(truck: &mut Truck, choices: &Choices, units: Units) -> Result<Replaced, WedgeBodyError> {
    let mut wedges = Vec::new();
    let mut groups: Vec<(Vec<String>, Vec<u32>)> = Vec::new();
    let mut massless = Vec::new();
    let all: Vec<usize> = truck.wedges().collect();
    for &place in &all {
        let number = truck.connections[place];
        let Law::Wedge(law) = truck.model.connections[place].law.clone() else {
            continue;
        };
        let Accumulator::Bristle { stiffness, damping } = law.accumulator else {
            massless.push(number.to_string());
            continue;
        };
        let made = Made::new(truck, (place, &all), (&law, [stiffness, damping]), choices)?;
        let words = made.words(&law, units);
        match groups.iter_mut().find(|(own, _)| *own == words) {
            Some((_, numbers)) => numbers.push(number),
            None => groups.push((words, vec![number])),
        }
        wedges.push(made.mount(truck, place));
    }
    if wedges.is_empty() {
        return Err(WedgeBodyError::NoWedge);
    }
    let mut assumptions = vec![
        "wedges of types 6.8 and 6.9: bodies with mass, corners with contact and friction, where the files \
         have a massless law; accumulator, branch, jamming and limit of the normal force (FWNMAX) of that \
         law do not apply; components of forces of their connections are those of column and coil on the \
         side frame"
            .to_owned(),
    ];
    for (words, numbers) in groups {
        let numbers: Vec<String> = numbers.iter().map(u32::to_string).collect();
        let which = format!("wedges of connections {}", numbers.join(", "));
        assumptions.extend(words.iter().map(|text| format!("{which}: {text}")));
    }
    if !massless.is_empty() {
        assumptions.push(format!(
            "wedges of connections {} are of type 6.3 or 6.7, with viscous friction: they stay massless",
            massless.join(", ")
        ));
    }
    assumptions.extend(take_masses(truck, &wedges, units));
    assumptions.extend(warp_springs(truck, &wedges));
    Ok(Replaced { wedges, assumptions })
}

/// Takes the wedges' masses from the bodies with their pockets, which carry them in the files.
fn take_masses(truck: &mut Truck, wedges: &[MountedWedge], units: Units) -> Vec<String> {
    let mut lines = Vec::new();
    for (bolster, number) in truck.bodies.iter().enumerate() {
        let own = wedges.iter().filter(|wedge| wedge.bolster == bolster);
        let mass: f64 = own.map(|wedge| truck.model.bodies[wedge.body].mass).sum();
        let body = &mut truck.model.bodies[bolster];
        if mass == 0.0 || body.is_prescribed() {
            continue;
        }
        let words = measure(mass, Kind::Mass, units);
        if body.mass > 2.0 * mass {
            body.mass -= mass;
            lines.push(format!(
                "the wedges' masses, {words}, are taken from body {number}, which carries them in the \
                 files; its moments of inertia stay"
            ));
        } else {
            lines.push(format!(
                "the wedges' masses, {words}, are added: body {number} is too light to carry them in the \
                 files"
            ));
        }
    }
    lines
}

/// A wedge that is to be mounted.
struct Made {
    wedge: Wedge,
    damping: Damping,
    end: f64,
    /// Depth of the column in the drawn layout, m.
    depth: f64,
    /// The coil's load in the drawn layout, N.
    load: f64,
    plain: bool,
}

impl Made {
    fn new(
        truck: &Truck,
        (place, all): (usize, &[usize]),
        (law, bristle): (&Massless, [f64; 2]),
        choices: &Choices,
    ) -> Result<Self, WedgeBodyError> {
        let number = truck.connections[place];
        check(number, law, bristle)?;
        let seat = if law.coil_in_bolster {
            Damping::Constant
        } else {
            Damping::Variable
        };
        let [mut wedge, ..] = Parameters::new(seat).wedges;
        let (end, toe, depth) = match &law.column {
            ColumnFace::Plain { toe_out } => {
                let size = choices.elements.plain_toe_angle;
                let toe = if *toe_out { size } else { -size };
                (direction(truck, place, all)?, toe, 0.0)
            }
            ColumnFace::Profile { depth, direction } => (
                *direction,
                inclination(number, depth.slopes())?,
                depth.evaluate(0.0),
            ),
        };
        let right = 0.5 * std::f64::consts::PI;
        let sum = law.angle + toe;
        if !(sum > 0.0 && sum < right) {
            return Err(WedgeBodyError::Value {
                connection: number,
                what: "the wedge angle with the column's inclination, in degrees,",
                value: sum.to_degrees(),
                must: "lie between 0 and 90",
            });
        }
        wedge.angle = law.angle;
        wedge.toe = toe;
        // A plane's distance, along its normal.
        wedge.wear.column = depth * libm::cos(toe);
        let [stiffness, damping] = bristle;
        let friction = FrictionLaw::Bristle {
            stiffness,
            damping: damping * choices.elements.accumulator_damping,
        };
        let face = |coefficient| FaceFriction {
            coefficient,
            law: friction,
        };
        wedge.column_friction = face(law.column_friction);
        wedge.slope_friction = face(law.slope_friction);
        added(&mut wedge, &choices.wedge_body);
        let coil = coil(number, law, &wedge.control_coil)?;
        let load = coil.load(0.0);
        wedge.control_coil = ControlCoil::Table(coil);
        Ok(Self {
            wedge,
            damping: seat,
            end,
            depth,
            load,
            plain: matches!(law.column, ColumnFace::Plain { .. }),
        })
    }

    /// Returns the distance by which an inclined column is moved away (m), so that corners of the upright
    /// face just touch it.
    fn gap(&self) -> f64 {
        0.5 * self.wedge.height * libm::sin(self.wedge.toe).abs()
    }

    /// Adds it to the model; its connection only measures from now on.
    fn mount(self, truck: &mut Truck, place: usize) -> MountedWedge {
        let (number, model) = (truck.connections[place], &mut truck.model);
        let components = model.connections[place].law.coordinates();
        let own = &mut model.connections[place];
        let nothing = SpringDamper {
            spring: None,
            damper: None,
            compression_limit: f64::NEG_INFINITY,
            extension_limit: f64::INFINITY,
        };
        let measured = components.iter().map(|coordinate| (*coordinate, nothing.clone()));
        own.law = Law::Springs(measured.collect());
        let (bolster, side_frame, center) = (own.a, own.b, own.point);
        let (name, body) = (format!("wedge_{number}"), model.bodies.len());
        let mut wedge = self.wedge.clone();
        wedge.wear.column += self.gap();
        model.bodies.push(wedge_body(&name, &wedge, center, self.end));
        let at = WedgeMount {
            name: &name,
            body,
            side_frame,
            bolster,
            damping: self.damping,
            end: self.end,
            center,
            from: [0.0; 3],
            gaps: [0.0; 2],
        };
        let elements = add_wedge(model, &wedge, &at);
        MountedWedge {
            connection: place,
            body,
            bolster,
            side_frame,
            faces: elements.faces,
            coil: elements.coil.unwrap_or_default(),
            damping: self.damping,
            center,
            end: self.end,
            wedge,
            components,
        }
    }
}

/// Checks the values of a wedge that its massless law would have checked.
fn check(connection: u32, law: &Massless, [stiffness, damping]: [f64; 2]) -> Result<(), WedgeBodyError> {
    let rule = |what: &'static str, value: f64, holds: bool, must: &'static str| {
        if holds {
            return Ok(());
        }
        Err(WedgeBodyError::Value {
            connection,
            what,
            value,
            must,
        })
    };
    let coefficient = |value: f64| value >= 0.0 && value.is_finite();
    let must = "be 0 or more";
    let (column, slope) = (law.column_friction, law.slope_friction);
    rule("the column's friction", column, coefficient(column), must)?;
    rule("the slope's friction", slope, coefficient(slope), must)?;
    let positive = |value: f64| value > 0.0 && value.is_finite();
    rule(
        "the accumulator's stiffness Ka (N/m)",
        stiffness,
        positive(stiffness),
        "be positive",
    )?;
    rule(
        "the accumulator's damping Ca (N·s/m)",
        damping,
        positive(damping),
        "be positive",
    )?;
    if let ColumnFace::Profile { direction, .. } = law.column {
        rule(
            "the direction XDIR",
            direction,
            direction.abs() == 1.0,
            "be 1 or -1",
        )?;
    }
    let degrees = law.angle.to_degrees();
    rule(
        "the wedge angle, in degrees,",
        degrees,
        degrees > 0.0 && degrees < 90.0,
        "lie between 0 and 90",
    )?;
    let slides = slope * libm::tan(law.angle) < 1.0;
    let must = "stay below 90 less the slope's angle of friction: beyond, the slope cannot carry the wedge";
    rule("the wedge angle, in degrees,", degrees, slides, must)
}

/// Returns the one inclination of a column with these slopes, rad, out positive.
fn inclination(connection: u32, slopes: &[f64]) -> Result<f64, WedgeBodyError> {
    let toes: Vec<f64> = slopes.iter().map(|slope| -libm::atan(*slope)).collect();
    let least = toes.iter().copied().fold(f64::INFINITY, f64::min);
    let most = toes.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if most - least <= SAME_INCLINATION {
        return Ok(toes.first().copied().unwrap_or(0.0));
    }
    let mut sorted = toes;
    sorted.sort_by(f64::total_cmp);
    sorted.dedup_by(|b, a| *b - *a <= SAME_INCLINATION);
    Err(WedgeBodyError::NotPlane {
        connection,
        count: sorted.len(),
        from: rounded(least.to_degrees()),
        to: rounded(most.to_degrees()),
    })
}

/// Returns on which side of a wedge of type 6.8 its column lies: away from the other wedges on its side
/// frame; `all` are the places of all wedges.
fn direction(truck: &Truck, place: usize, all: &[usize]) -> Result<f64, WedgeBodyError> {
    let connections = &truck.model.connections;
    let own = &connections[place];
    let others = all.iter().filter(|other| connections[**other].b == own.b);
    let mut ways = others
        .map(|other| own.point[0] - connections[*other].point[0])
        .filter(|way| way.abs() > SAME_PLACE);
    let first = ways.next().map(|way| way.signum());
    first
        .filter(|sign| ways.all(|way| way.signum() == *sign))
        .ok_or_else(|| WedgeBodyError::NoDirection {
            connection: truck.connections[place],
            body: truck.bodies.get(own.b).copied().unwrap_or_default(),
        })
}

/// Lays what is chosen over the nominal wedge.
fn added(wedge: &mut Wedge, chosen: &WedgeBody) {
    if let Some(mass) = chosen.mass {
        // The same prism, lighter or heavier.
        wedge.inertia = wedge.inertia.map(|inertia| inertia * mass / wedge.mass);
        wedge.mass = mass;
    }
    let WedgeBody {
        height,
        width,
        contact_stiffness,
        contact_damping,
        friction_directions,
        ..
    } = *chosen;
    wedge.height = height.unwrap_or(wedge.height);
    wedge.width = width.unwrap_or(wedge.width);
    wedge.contact.stiffness = contact_stiffness.unwrap_or(wedge.contact.stiffness);
    wedge.contact.damping = contact_damping.unwrap_or(wedge.contact.damping);
    for face in [&mut wedge.column_face, &mut wedge.slope_face] {
        face.friction_directions = friction_directions.unwrap_or(face.friction_directions);
    }
}

/// Returns the coil of a wedge; what the files do not say is that of the nominal one.
fn coil(connection: u32, law: &Massless, nominal: &ControlCoil) -> Result<TableSpring, WedgeBodyError> {
    let load = law.coil.scaled(-1.0, law.preload);
    let compressed = load.evaluate(-COMPRESSION);
    if !(compressed > 0.0 && compressed.is_finite()) {
        return Err(WedgeBodyError::NoCoil { connection });
    }
    let (own, damping) = match nominal {
        ControlCoil::Shear(spring) => (spring.stiffness, spring.damping),
        _ => (0.0, 0.0),
    };
    // A coil that only has a force has the nominal stiffness.
    let stiffness = match -load.slopes()[load.piece(-0.5 * COMPRESSION)] {
        slope if slope > 0.0 => slope,
        _ => own,
    };
    let mut coil = TableSpring::new("", &load);
    coil.shear_stiffness = SHEAR_SHARE * stiffness;
    coil.tilt_stiffness = 0.5 * stiffness * COIL_RADIUS * COIL_RADIUS;
    coil.damping = damping;
    Ok(coil)
}
