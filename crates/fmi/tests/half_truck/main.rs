//! The half-truck behind the variables: the columns of its run, inputs that move it, loads, saved states, the
//! energy ledger.
#![allow(missing_docs, clippy::unwrap_used)]

mod input;
mod motion;
mod reproducible;

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::half_truck::HalfTruck;
use fmi::instance::Instance;
use fmi::source::Source;
use nucars::truck::Choices;
use study::half_truck::files::Settings;

/// A run of the thesis whose wedges have coils in the bolster and a toe.
const NAME: &str = "nucars_69_constant_toe_out";

fn settings(duration: f64) -> Settings {
    Settings {
        choices: Choices::default(),
        duration: Some(duration),
        ..Settings::default()
    }
}

fn half_truck(name: &str, duration: f64) -> HalfTruck {
    HalfTruck::built_in(name, &settings(duration)).unwrap()
}

/// An instance, and its variables by their names.
struct Part {
    instance: Instance,
    description: Description,
    bodies: Vec<u32>,
}

impl Part {
    fn of(half_truck: HalfTruck, interface: Interface) -> Self {
        let bodies = half_truck.case().truck.bodies.clone();
        let source = Source::HalfTruck(Box::new(half_truck));
        let description = Description::new(&source).unwrap();
        let instance = Instance::of("half-truck", None, source, Version::Two, interface).unwrap();
        Self {
            instance,
            description,
            bodies,
        }
    }

    fn new(interface: Interface) -> Self {
        Self::of(half_truck(NAME, 20.0), interface)
    }

    fn reference(&self, name: &str) -> u32 {
        let mut all = self.description.variables.iter();
        all.find(|variable| variable.name == name).unwrap().reference
    }

    /// Returns the place in the model of the body with this number in the files.
    fn number_of_body(&self, number: u32) -> usize {
        self.bodies.iter().position(|own| *own == number).unwrap()
    }

    fn set(&mut self, name: &str, value: f64) {
        self.instance.set_float(self.reference(name), value).unwrap();
    }

    fn choose(&mut self, name: &str, value: i32) {
        self.instance.set_integer(self.reference(name), value).unwrap();
    }

    fn get(&mut self, name: &str) -> f64 {
        self.instance.get_float(self.reference(name)).unwrap()
    }

    fn begin(&mut self) {
        self.instance.enter_initialization().unwrap();
        self.instance.exit_initialization().unwrap();
    }

    fn step(&mut self, length: f64) {
        self.instance.do_step(self.instance.time(), length).unwrap();
    }

    fn states(&mut self) -> Vec<f64> {
        let names = self.description.entries.states.iter();
        let names: Vec<String> = names.map(|state| state.name.clone()).collect();
        names.iter().map(|name| self.get(name)).collect()
    }
}
