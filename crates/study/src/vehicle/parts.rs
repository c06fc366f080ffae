//! What statistics of a vehicle on a track are taken of: its wheelsets, trucks and bodies, by their names.

use vehicle::{AccelerometerOf, Description, OnTrack};

use crate::car::columns::on_truck;
use crate::car::statistics::{AxlePart, Parts, PlacePart, TruckPart};

/// Returns the parts of a vehicle whose wheels have these static loads, left and right, N.
pub(super) fn parts(description: &Description, on: &OnTrack, loads: &[[f64; 2]]) -> Parts {
    let bodies: Vec<&str> = description.bodies.iter().map(|own| own.name.as_str()).collect();
    let wheelsets = on.all_wheelsets();
    // The column of the distance, and its place.
    let (along, origin) = match (description.bodies.get(on.driven.0 - 1), wheelsets.first()) {
        (Some(body), _) => (body.name.as_str(), body.place[0]),
        (None, Some((name, x))) => (name.as_str(), *x),
        (None, None) => ("", 0.0),
    };
    let axles = wheelsets.iter().enumerate().map(|(number, (name, x))| AxlePart {
        name: name.clone(),
        loads: loads.get(number).copied().unwrap_or_default(),
        place: x - origin,
    });
    let own = (0..).zip(&on.trucks);
    let mut trucks: Vec<TruckPart> = own
        .map(|(number, own)| TruckPart {
            name: own.name.clone(),
            axles: vec![2 * number, 2 * number + 1],
        })
        .collect();
    let single = (2 * on.trucks.len()..).zip(&on.wheelsets);
    for (axle, name) in single.filter_map(|(axle, own)| Some((axle, own.truck.as_ref()?))) {
        match trucks.iter_mut().find(|own| own.name == *name) {
            Some(truck) => truck.axles.push(axle),
            None => trucks.push(TruckPart {
                name: name.clone(),
                axles: vec![axle],
            }),
        }
    }
    let accelerometers = on.all_accelerometers(&bodies);
    let taken_as = |of: AccelerometerOf| accelerometers.iter().filter(move |own| own.of == of);
    let mut rolling: Vec<usize> = taken_as(AccelerometerOf::Body).map(|own| own.body).collect();
    if rolling.is_empty() {
        rolling.push(on.driven.0);
    }
    rolling.sort_unstable();
    rolling.dedup();
    let rolling = rolling.into_iter().filter_map(|number| bodies.get(number - 1));
    let named = |own: &vehicle::Accelerometer| PlacePart::named(&*own.name);
    let on_frames = on.trucks.iter().flat_map(|own| on_truck(&own.name));
    Parts {
        distance: format!("{along}_distance"),
        speed: format!("{along}_speed"),
        force: "_force",
        axles: axles.collect(),
        trucks,
        bodies: rolling.map(|name| PlacePart::named(*name)).collect(),
        on_bodies: taken_as(AccelerometerOf::Body).map(named).collect(),
        on_trucks: on_frames
            .chain(taken_as(AccelerometerOf::Truck).map(named))
            .collect(),
    }
}
