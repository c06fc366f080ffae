//! The effect of inputs on a system: loads on bodies, forces of coils, and motions of prescribed bodies.

use mechanics::coil::CoilLaw;
use mechanics::motion::Motion;
use mechanics::system::System;

use super::ports::{Ports, Six, coordinates};
use crate::Error;

/// The loads on the bodies of a system, and the laws of its coils.
#[derive(Clone, Debug)]
pub(super) struct InputLoads {
    /// On each body.
    on: Vec<Six>,
    /// The bodies that inputs load.
    loaded: Vec<usize>,
    /// Body and coordinate of each position.
    places: Vec<(usize, usize)>,
    /// The coils that have their forces from inputs.
    coils: Vec<(usize, CoilLaw)>,
    /// The factors of elements that have them from inputs.
    factors: Vec<(usize, f64)>,
}

impl InputLoads {
    pub fn new(system: &System, ports: &Ports) -> Self {
        let mut loaded: Vec<usize> = ports.loads.iter().map(|port| port.direction.body).collect();
        loaded.sort_unstable();
        loaded.dedup();
        Self {
            on: vec![[0.0; 6]; system.bodies().len()],
            loaded,
            places: coordinates(system),
            coils: Vec::new(),
            factors: Vec::new(),
        }
    }

    /// Sums what the inputs say.
    pub fn set(&mut self, ports: &Ports, inputs: &[f64]) {
        self.on.fill([0.0; 6]);
        for port in &ports.loads {
            let value = inputs.get(port.input).copied().unwrap_or(0.0);
            let load = &mut self.on[port.direction.body];
            for (sum, entry) in load.iter_mut().zip(&port.direction.row) {
                *sum += entry * value;
            }
        }
        let value = |input: usize| inputs.get(input).copied().unwrap_or(0.0);
        let factors = ports.factors.iter();
        self.factors = factors
            .map(|port| (port.element, port.sign * value(port.input)))
            .collect();
        let coils = ports.coils.iter();
        self.coils = coils
            .map(|port| {
                (
                    port.coil,
                    port.law(inputs.get(port.input).copied().unwrap_or(0.0)),
                )
            })
            .collect();
    }

    /// Puts them on a copy of the system.
    pub fn put(&self, system: &mut System) -> Result<(), Error> {
        for &body in &self.loaded {
            system.set_load(body, self.on[body]).map_err(Error::of)?;
        }
        for &(element, factor) in &self.factors {
            system.set_factor(element, factor).map_err(Error::of)?;
        }
        for (coil, law) in &self.coils {
            system.set_coil_law(*coil, law.clone()).map_err(Error::of)?;
        }
        Ok(())
    }

    /// Returns the work (J) that they do along changes of the positions, or their power (W) at speeds.
    pub fn work(&self, along: impl Iterator<Item = f64>) -> f64 {
        self.places
            .iter()
            .zip(along)
            .map(|((body, coordinate), way)| self.on[*body][*coordinate] * way)
            .sum()
    }
}

/// Replaces the motions of all bodies that inputs move; `motion` gives that of a coordinate by the numbers of
/// its two inputs.
fn drive(system: &mut System, ports: &Ports, motion: impl Fn(usize, usize) -> Motion) -> Result<(), Error> {
    let mut rest = &ports.motions[..];
    while let Some(first) = rest.first() {
        let count = rest.iter().take_while(|port| port.body == first.body).count();
        let (own, others) = rest.split_at(count);
        let mut motions: [Motion; 6] = std::array::from_fn(|_| Motion::Constant(0.0));
        for port in own {
            motions[port.coordinate] = motion(port.position, port.rate);
        }
        system.set_motions(first.body, motions).map_err(Error::of)?;
        rest = others;
    }
    Ok(())
}

/// Puts all bodies that inputs move where these say at `time` (s), to move on with their rates.
pub(super) fn place(system: &mut System, ports: &Ports, inputs: &[f64], time: f64) -> Result<(), Error> {
    drive(system, ports, |position, rate| {
        Motion::line(time, [inputs[position], inputs[rate]])
    })
}

/// Lets all bodies that inputs move go from one place to another within a step that begins at `start` (s):
/// cubics through values and rates at both ends.
pub(super) fn lead(
    system: &mut System,
    ports: &Ports,
    [from, to]: [&[f64]; 2],
    [start, duration]: [f64; 2],
) -> Result<(), Error> {
    drive(system, ports, |position, rate| {
        let (from, to) = ([from[position], from[rate]], [to[position], to[rate]]);
        Motion::between(start, duration, from, to)
    })
}

/// Lets prescribed bodies be moved, since a system takes what is held for fixed, and takes loads of the case
/// away.
pub(crate) fn release<'m>(
    motions: impl IntoIterator<Item = &'m mut Motion>,
    loads: impl IntoIterator<Item = &'m mut Motion>,
) {
    for motion in motions {
        let [value, rate, _] = motion.evaluate(0.0, 0.0);
        *motion = Motion::line(0.0, [value, rate]);
    }
    loads.into_iter().for_each(|load| *load = Motion::Constant(0.0));
}
