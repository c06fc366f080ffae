//! Assembly of a system from a model: its bodies and elements are numbered, checked and assembled.

use numerics::partitioned::Partitioned;

use super::assembler::ElementAssembler;
use super::error_bounds::{error_bounds, presses};
use super::jacobian::Gathered;
use super::model::{Model, ModelError};
use super::mounted::Mounted;
use super::spectral_radius::mobility;
use super::{
    FrameState, FreeBody, Linear, MountedLoad, Move, MovedBody, System, is_bristle, scale_of, scales,
    structure,
};
use crate::body::{Body, COORDINATES, Kinematics};
use crate::connection;
use crate::contact::{ContactFace, Interface, Points};
use crate::energy::{EnergyTerm, EnergyTermKind};
use crate::frame::Frame;
use crate::link::Marker;
use crate::motion::Motion;
use crate::parts::Parts;
use crate::surface::Plane;
use crate::vector::Vector;

/// Returns the system of a model.
///
/// # Errors
/// [`ModelError`]: which body or element does not fit, and why.
pub(super) fn build(model: Model) -> Result<System, ModelError> {
    let Model {
        bodies,
        gravity,
        faces,
        interfaces,
        coils,
        elements,
        connections,
        loads,
        options,
        carriers,
    } = model;
    options.check()?;
    let interfaces = by_face(interfaces, &faces)?;
    if bodies.iter().all(Body::is_prescribed) {
        return Err(ModelError::NothingFree);
    }
    let count = bodies.len();
    let mut touched = vec![false; count];
    let ends = faces.iter().flat_map(|(a, b, ..)| [*a, *b]);
    let ends = ends.chain(coils.iter().flat_map(|(a, b, ..)| [*a, *b]));
    for number in ends.chain(elements.iter().flat_map(|placement| placement.ends)) {
        *touched
            .get_mut(number)
            .ok_or(ModelError::NoSuchBody { number, count })? = true;
    }
    let mut connected = vec![false; count];
    for (index, connection) in connections.iter().enumerate() {
        connection.check(index, &bodies, &options)?;
        (connected[connection.a], connected[connection.b]) = (true, true);
    }
    for &[carrier, of] in &carriers {
        let fits = of < count && !bodies[of].linearized && carriers.iter().all(|[own, _]| *own != of);
        if !fits || connected[carrier] {
            let carrier = bodies[carrier].name.clone();
            return Err(ModelError::Carrier { carrier, body: of });
        }
        touched[of] |= touched[carrier];
    }
    let carrier_of = |body: usize| {
        carriers
            .iter()
            .find(|[_, of]| *of == body)
            .map(|[carrier, _]| *carrier)
    };
    let mut free = Vec::new();
    let mut slots = vec![[None; 6]; bodies.len()];
    let mut free_number = vec![None; bodies.len()];
    let mut offset = 0;
    for (number, body) in bodies.iter().enumerate() {
        let coordinates: Vec<usize> = (0..6).filter(|k| body.free[*k]).collect();
        if coordinates.is_empty() {
            continue;
        }
        for (slot, &k) in coordinates.iter().enumerate() {
            slots[number][k] = Some(slot);
        }
        let linear = if body.linearized {
            Some(linear(body, &coordinates, gravity)?)
        } else {
            None
        };
        if !body.frame.is_fixed() && coordinates.len() < 6 {
            return Err(ModelError::HeldInMovingFrame {
                body: body.name.clone(),
            });
        }
        free_number[number] = Some(free.len());
        let count = coordinates.len();
        free.push(FreeBody {
            body: number,
            translations: coordinates.iter().filter(|k| **k < 3).count(),
            free: coordinates,
            rigid: body.rigid(),
            offset,
            pair: 0,
            faces: Vec::new(),
            coils: Vec::new(),
            loaded: linear.is_some() || connected[number] || carrier_of(number).is_some(),
            carrier: carrier_of(number),
            linear,
            touched: touched[number],
            connected: connected[number],
        });
        offset += count;
    }
    for &[carrier, of] in &carriers {
        free_number[carrier] = free_number[of];
    }
    // Of a body with linearized kinematics that no element sees, the motions are coordinates alone.
    let frame_of = |(body, touched): (&Body, &bool)| match body.linearized && !touched {
        true => frame_state(&Frame::fixed(body.frame.origin, body.frame.orientation)),
        false => frame_state(&body.frame),
    };
    let frames: Vec<FrameState> = bodies.iter().zip(&touched).map(frame_of).collect();
    let kinematics: Vec<Kinematics<f64>> = bodies
        .iter()
        .map(|body| Kinematics::new(body.initial, [0.0; 6], body.rolls()))
        .collect();

    let mut parts = Parts {
        energy_terms: vec![EnergyTerm {
            kind: EnergyTermKind::MotionWork,
            element: String::new(),
        }],
        internal_pairs: Vec::new(),
        quadrature_bodies: Vec::new(),
        quadrature_pairs: Vec::new(),
    };
    let mut assembler = ElementAssembler {
        bodies: &bodies,
        frames: &frames,
        kinematics: &kinematics,
        free_number: &free_number,
        parts: &mut parts,
    };
    let mut mounted_faces = Vec::new();
    for ((body, on, marker, face), interface) in faces.into_iter().zip(interfaces) {
        let damped = face.points.iter().any(|point| point.damping > 0.0);
        let kinds = [
            Some(EnergyTermKind::FrictionLoss),
            damped.then_some(EnergyTermKind::ContactDampingLoss),
        ];
        let pairs = if is_bristle(&face.law) {
            face.points.len()
        } else {
            0
        };
        let name = face.name.clone();
        let face = face.refined(interface);
        let points = Points::new(&face);
        let mounted = assembler.attach(face, &name, body, on, marker, kinds, pairs)?;
        mounted_faces.push(Mounted { points, ..mounted });
    }
    let mut mounted_coils = Vec::new();
    for (body, on, marker, coil) in coils {
        let damped = coil.damping > 0.0 || coil.rotational_damping > 0.0;
        let kinds = [
            damped.then_some(EnergyTermKind::CoilDampingLoss),
            (coil.acts_at != coil.end).then_some(EnergyTermKind::CoilGuideWork),
        ];
        let name = if mounted_coils.is_empty() {
            "coil".to_owned()
        } else {
            format!("coil_{}", mounted_coils.len() + 1)
        };
        mounted_coils.push(assembler.attach(coil, &name, body, on, marker, kinds, 0)?);
    }

    let (mut mounted_elements, mut factors) = (Vec::new(), Vec::new());
    for (number, placement) in elements.into_iter().enumerate() {
        factors.extend(placement.factor.clone().map(|factor| (number, factor)));
        let is_free = |body: usize| matches!(free_number.get(body), Some(Some(_)));
        let ([body, on], marker, marked) = placement.mounted(is_free);
        let name = marked.element.name().to_owned();
        let work = marked.element.does_work().then_some(EnergyTermKind::ElementWork);
        let kinds = [Some(EnergyTermKind::ElementLoss), work];
        let pairs = usize::from(marked.element.has_states());
        mounted_elements.push(assembler.attach(marked, &name, body, on, marker, kinds, pairs)?);
    }

    let applied: Vec<MountedLoad> = loads
        .into_iter()
        .map(|applied| applied.mount(&bodies, &mut free, &free_number, &mut parts))
        .collect::<Result<_, _>>()?;
    let owned = parts.energy_terms.len();
    let assembler = connection::ConnectionAssembler::new(&bodies, &free_number, &slots, &mut parts);
    let (mut connections, coupled) = assembler.attach(connections, &options);

    let ends = |body: usize, on: usize| Some((free_number[body]?, free_number[on]?));
    let faces_at = mounted_faces.iter().map(|m| (m.body, m.on));
    let coils_at = mounted_coils.iter().map(|m| (m.body, m.on));
    let couplings = faces_at
        .chain(coils_at)
        .chain(mounted_elements.iter().map(|m| (m.body, m.on)))
        .filter_map(|(body, on)| ends(body, on))
        .chain(coupled)
        .collect();
    let mut jacobian = Partitioned::new(&structure(&free, couplings, &parts));
    let layout = jacobian.layout();
    for (number, free) in free.iter_mut().enumerate() {
        free.pair = jacobian.pair(number, number);
        if let Some(linear) = &free.linear {
            let n = free.free.len();
            for (j, inertia) in linear.inertia.iter().enumerate() {
                jacobian.mass_mut(number)[j * n + j] = *inertia;
            }
        }
    }
    connections.find_pairs(&jacobian);
    for (face, mounted) in mounted_faces.iter_mut().enumerate() {
        mounted.find_pairs(&jacobian, &free_number);
        for number in mounted.touches(&free_number) {
            free[number].faces.push(face);
        }
    }
    for (coil, mounted) in mounted_coils.iter_mut().enumerate() {
        mounted.find_pairs(&jacobian, &free_number);
        for number in mounted.touches(&free_number) {
            free[number].coils.push(coil);
        }
    }

    for mounted in &mut mounted_elements {
        mounted.find_pairs(&jacobian, &free_number);
    }

    let mut error_scales = vec![f64::INFINITY; layout.len()];
    {
        let [q, u, s, w] = layout.split_mut(&mut error_scales);
        for free in &free {
            for (j, &k) in free.free.iter().enumerate() {
                (q[free.offset + j], u[free.offset + j]) = scale_of(k);
            }
        }
        s.fill(scales::DEFLECTION);
        for (scale, energy_term) in w.iter_mut().zip(&parts.energy_terms) {
            *scale = match energy_term.kind {
                EnergyTermKind::ContactDampingLoss => scales::CONTACT_DAMPING_LOSS,
                _ => scales::ENERGY,
            };
        }
    }
    let presses: Vec<bool> = free
        .iter()
        .flat_map(|free| presses(free, &mounted_faces, &frames))
        .collect();
    let (error_bounds, layer_bounds) = error_bounds(&error_scales, layout, &mounted_faces, &presses);
    let moved: Vec<MovedBody> = bodies
        .iter()
        .enumerate()
        .filter(|(number, body)| (body.linearized || connected[*number]) && body.is_moving_prescribed())
        .map(|(body, own)| MovedBody {
            body,
            motions: Box::new(own.frame.motions.clone()),
        })
        .collect();
    let varies = applied.iter().any(|load| !load.applied.course.is_constant())
        || factors.iter().any(|(_, factor)| !factor.is_constant());
    let moves = frames.iter().any(|frame| !frame.fixed) || !moved.is_empty() || varies;
    let none = connections.is_empty() && mounted_elements.is_empty();
    let plain = none && mounted_faces.iter().all(|m| m.plain) && mounted_coils.iter().all(|m| m.plain);
    let discontinuities_complete = none && mounted_faces.iter().all(|face| face.internal_count == 0);
    let refined = mounted_faces.iter().any(|face| face.element.surface.is_refined());
    let bounded =
        plain && !refined && free.iter().all(|free| frames[free.body].fixed) && discontinuities_complete;
    for face in &mut mounted_faces {
        let body = &bodies[face.body];
        face.mobilities = face
            .element
            .points
            .iter()
            .map(|point| mobility(body, point.position))
            .collect();
    }
    for coil in &mut mounted_coils {
        coil.mobilities = vec![mobility(&bodies[coil.body], coil.element.end)];
    }
    let points = mounted_faces.iter().map(|face| face.element.points.len());
    let first_points = points
        .scan(0, |next, count| Some(std::mem::replace(next, *next + count)))
        .collect();
    let nowhere = vec![[0.0; 6]; bodies.len()];
    let positions = bodies.iter().zip(&connected).map(|(body, connected)| {
        match (body.linearized || *connected, body.is_prescribed()) {
            (true, true) => [0, 1, 2, 3, 4, 5].map(|k| body.frame.motions[k].evaluate(0.0, 0.0)[0]),
            (true, false) => body.initial,
            (false, _) => [0.0; 6],
        }
    });
    Ok(System {
        positions: positions.collect(),
        rates: nowhere.clone(),
        loads: nowhere.clone(),
        given: nowhere.clone(),
        accelerations: nowhere,
        applied,
        connections,
        moved,
        internal_ends: parts.internal_pairs,
        added: owned..parts.energy_terms.len(),
        force: vec![Vector::zero(); bodies.len()],
        moment: vec![Vector::zero(); bodies.len()],
        gathered: vec![Gathered::NONE; free.len() + carriers.len()],
        gathered_at: gathered_at(&free_number, &carriers, free.len()),
        load_rate: vec![(Vector::zero(), [0.0; 3]); bodies.len()],
        bodies,
        gravity: Vector(gravity),
        faces: mounted_faces,
        coils: mounted_coils,
        elements: mounted_elements,
        factors,
        first_points,
        energy_terms: parts.energy_terms,
        layout,
        scales: error_scales,
        error_bounds,
        layer_bounds,
        free,
        free_number,
        frames,
        frames_at: f64::NAN,
        reference: 0.0,
        kinematics,
        jacobian,
        moves,
        plain,
        bounded,
        discontinuities_complete,
        current_state: vec![f64::NAN; 2 * layout.speeds],
        current_face: (0, f64::NAN),
        points_updated: false,
    })
}

/// Returns the places at which the derivatives of each body are gathered: first those of free bodies, then
/// those of carriers.
fn gathered_at(free_number: &[Option<usize>], carriers: &[[usize; 2]], free: usize) -> Vec<usize> {
    let mut places: Vec<usize> = free_number.iter().map(|number| number.unwrap_or(0)).collect();
    for (i, [carrier, _]) in carriers.iter().enumerate() {
        places[*carrier] = free + i;
    }
    places
}

/// Returns the interface of each face.
fn by_face(
    interfaces: Vec<(usize, Interface)>,
    faces: &[(usize, usize, Marker, ContactFace<Plane>)],
) -> Result<Vec<Interface>, ModelError> {
    let mut all = vec![Interface::default(); faces.len()];
    for (face, interface) in interfaces {
        let (factors, points) = (
            interface.friction_factors.len(),
            faces.get(face).map(|own| own.3.points.len()),
        );
        match (points, all.get_mut(face)) {
            (Some(_), Some(_)) if interface.first_arm != 0.0 && !interface.shape.is_flat() => {
                return Err(ModelError::Arm { face });
            }
            (Some(points), Some(place)) if factors == 0 || factors == points => *place = interface,
            _ => {
                return Err(ModelError::Interface {
                    face,
                    faces: faces.len(),
                    factors,
                    points: points.unwrap_or_default(),
                });
            }
        }
    }
    Ok(all)
}

/// Returns the inertia and weight of a body with linearized kinematics.
fn linear(body: &Body, free: &[usize], gravity: [f64; 3]) -> Result<Linear, ModelError> {
    let still = body.frame.is_fixed() && body.frame.orientation == [0.0; 3];
    if !still || body.initial != [0.0; 6] || body.center_of_gravity != [0.0; 3] {
        let body = body.name.clone();
        return Err(ModelError::Layout { body });
    }
    for &k in free {
        let (what, value) = match k {
            0..3 => ("the mass", body.mass),
            _ => ("a moment of inertia", body.inertia[k - 3]),
        };
        if !(value > 0.0 && value.is_finite()) {
            return Err(ModelError::Mass {
                body: body.name.clone(),
                what,
                value,
                coordinate: COORDINATES[k],
            });
        }
    }
    let own = |k: usize| if k < 3 { body.mass } else { body.inertia[k - 3] };
    let weight = |k: usize| gravity.get(k).map_or(0.0, |field| body.mass * field);
    Ok(Linear {
        inertia: free.iter().map(|k| own(*k)).collect(),
        weight: free.iter().map(|k| weight(*k)).collect(),
    })
}

/// Returns a frame at time zero, and its moving translations.
fn frame_state(frame: &Frame) -> FrameState {
    let base = crate::orientation::fixed(frame.orientation);
    let (mut moves, mut rest) = (Vec::new(), Vector(frame.origin));
    for coordinate in 0..3 {
        let axis = base.column(coordinate);
        if let Motion::Constant(value) = frame.motions[coordinate] {
            rest += axis.scale(value);
        } else {
            let jet = frame.motions[coordinate].evaluate(0.0, 0.0);
            moves.push(Move {
                coordinate,
                axis,
                jet,
            });
        }
    }
    FrameState {
        fixed: frame.is_fixed(),
        keeps_orientation: frame.keeps_orientation(),
        motion: frame.evaluate(0.0, 0.0),
        moves,
        rest,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coil::{Coil, CoilLaw};
    use crate::friction::FrictionLaw;

    /// The lists from which the Jacobian is made hold each element at each free body that it touches, once
    /// and in order, so that its cost grows in proportion to the elements.
    #[test]
    fn limits_each_body_lists_the_elements_that_touch_it_once() {
        let frame = || Frame::fixed([0.0; 3], [0.0; 3]);
        let body = |free: bool| Body {
            name: String::new(),
            mass: 1.0,
            inertia: [1.0; 3],
            center_of_gravity: [0.0; 3],
            frame: frame(),
            free: [free; 6],
            initial: [0.0; 6],
            linearized: false,
        };
        let coil = Coil {
            end: Vector([0.0; 3]),
            acts_at: Vector([0.0; 3]),
            law: CoilLaw::Linear { stiffness: 1.0 },
            free_length: 1.0,
            damping: 0.0,
            rotational_damping: 0.0,
            pulls: true,
        };
        let face = ContactFace {
            name: String::new(),
            points: Vec::new(),
            surface: Plane,
            coefficient: 0.0,
            law: FrictionLaw::Tanh { reference_speed: 1.0 },
        };
        let marker = || Marker::new([0.0, 0.0, -1.0], [0.0; 3]);
        // Bodies 1, 3, 4 are free, with the numbers 0, 1, 2.
        let frees = [false, true, false, true, true];
        let ends = [(1, 0), (1, 3), (4, 3), (4, 2), (3, 1)];
        let system = build(Model {
            bodies: frees.map(body).to_vec(),
            gravity: [0.0; 3],
            faces: ends.map(|(a, b)| (a, b, marker(), face.clone())).to_vec(),
            coils: ends[1..]
                .iter()
                .map(|&(a, b)| (a, b, marker(), coil.clone()))
                .collect(),
            ..Model::default()
        })
        .unwrap();
        let faces: Vec<&[usize]> = system.free.iter().map(|free| &free.faces[..]).collect();
        let coils: Vec<&[usize]> = system.free.iter().map(|free| &free.coils[..]).collect();
        assert_eq!(faces, [&[0, 1, 4][..], &[1, 2, 4], &[2, 3]]);
        assert_eq!(coils, [&[0, 3][..], &[0, 1, 3], &[1, 2]]);
    }
}
