//! An instance with its variables by their names.

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::instance::Instance;
use fmi::source::Source;

/// An instance with its variables by their names, and the length of its steps, s.
pub struct Part {
    pub instance: Instance,
    pub description: Description,
    pub interval: f64,
}

impl Part {
    pub fn new(source: Source, version: Version, interface: Interface, interval: f64) -> Self {
        let description = Description::new(&source).unwrap();
        let instance = Instance::of("part", None, source, version, interface).unwrap();
        Self {
            instance,
            description,
            interval,
        }
    }

    pub fn reference(&self, name: &str) -> u32 {
        let mut all = self.description.variables.iter();
        let found = all.find(|variable| variable.name == name);
        found
            .unwrap_or_else(|| panic!("there is no variable {name}"))
            .reference
    }

    pub fn set(&mut self, name: &str, value: f64) {
        self.instance.set_float(self.reference(name), value).unwrap();
    }

    pub fn get(&mut self, name: &str) -> f64 {
        self.instance.get_float(self.reference(name)).unwrap()
    }

    pub fn begin(&mut self) {
        self.instance.enter_initialization().unwrap();
        self.instance.exit_initialization().unwrap();
    }

    pub fn step(&mut self) {
        self.instance
            .do_step(self.instance.time(), self.interval)
            .unwrap();
    }
}
