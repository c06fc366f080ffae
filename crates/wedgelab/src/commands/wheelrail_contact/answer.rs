//! The answer of `wedgelab wheelrail contact`: JSON and a table, in the units of the question.

use std::io::{self, Write};

use quantity::{INCH, POUND_FORCE, System as Units};
use report::terminal::TerminalTable;
use serde_json::{Map, Value, json};
use wheelrail::loaded::{LoadedPatch, LoadedWheel, Seat};

/// A unit: the end of a key in JSON, its name in a table, and the factor to it from SI.
#[derive(Clone, Copy, Debug)]
pub struct Shown {
    suffix: &'static str,
    label: &'static str,
    factor: f64,
}

const fn shown(suffix: &'static str, label: &'static str, factor: f64) -> Shown {
    Shown {
        suffix,
        label,
        factor,
    }
}

/// The units of an answer.
#[derive(Clone, Copy, Debug)]
pub struct AnswerUnits {
    /// The system.
    pub system: Units,
    /// Lengths.
    pub length: Shown,
    /// Forces.
    pub force: Shown,
    /// Speeds along the track.
    pub speed: Shown,
    /// Shear moduli.
    pub modulus: Shown,
    moment: Shown,
    spin: Shown,
    pressure: Shown,
    /// Digits behind the point of places, of heights and semi-axes, and of forces.
    digits: [usize; 3],
}

/// 1000 psi, Pa.
const KSI: f64 = 1e3 * POUND_FORCE / (INCH * INCH);
const MILE_PER_HOUR: f64 = 0.447_04;

impl AnswerUnits {
    /// Returns the units of a system: millimetres with N, as those of CONTACT, or inches with lbf.
    pub fn of(system: Units) -> Self {
        match system {
            Units::Si => Self {
                system,
                length: shown("mm", "mm", 1e3),
                force: shown("n", "N", 1.0),
                speed: shown("m_per_s", "m/s", 1.0),
                modulus: shown("gpa", "GPa", 1e-9),
                moment: shown("nmm", "N mm", 1e3),
                spin: shown("per_mm", "1/mm", 1e-3),
                pressure: shown("mpa", "MPa", 1e-6),
                digits: [2, 3, 1],
            },
            Units::Us => Self {
                system,
                length: shown("in", "in", 1.0 / INCH),
                force: shown("lbf", "lbf", 1.0 / POUND_FORCE),
                speed: shown("mph", "mph", 1.0 / MILE_PER_HOUR),
                modulus: shown("ksi", "ksi", 1.0 / KSI),
                moment: shown("lbf_in", "lbf in", 1.0 / (POUND_FORCE * INCH)),
                spin: shown("per_in", "1/in", INCH),
                pressure: shown("ksi", "ksi", 1.0 / KSI),
                digits: [3, 4, 1],
            },
        }
    }

    /// Returns a patch.
    pub fn patch(&self, patch: &LoadedPatch) -> Value {
        let [x, y] = patch.creepage;
        let mut entries = Entries::default();
        entries.put("share", patch.share);
        entries.add("y", patch.y, self.length);
        entries.put("angle_rad", patch.angle);
        entries.add("normal", patch.normal, self.force);
        entries.add("fx", patch.fx, self.force);
        entries.add("fy", patch.fy, self.force);
        entries.add("spin_moment", patch.spin_moment, self.moment);
        entries.put("creepage_x", x);
        entries.put("creepage_y", y);
        entries.add("spin", patch.spin, self.spin);
        entries.add("a", patch.axes[0], self.length);
        entries.add("b", patch.axes[1], self.length);
        entries.add("greatest_pressure", patch.greatest_pressure, self.pressure);
        if let Some(strips) = &patch.strips {
            let places = 0..strips.line.len();
            let list = |of: &dyn Fn(usize) -> f64| places.clone().map(of).collect::<Vec<_>>();
            let (length, pressure) = (self.length, self.pressure);
            let mut own = Entries::default();
            own.list("x", list(&|i| strips.along[i]), length);
            own.list("y", list(&|i| strips.across[i]), length);
            own.list("half_length", list(&|i| strips.half_length[i]), length);
            own.list("pressure", list(&|i| strips.pressure(i)), pressure);
            own.add("width", strips.width, length);
            entries.put("strips", own.value());
        }
        entries.value()
    }

    /// Returns the wheel; its height is null if it has none.
    pub fn wheel(&self, wheel: &LoadedWheel) -> Value {
        let mut entries = Entries::default();
        entries.put("seat", wheel.seat.word());
        entries.add("center_y", wheel.center, self.length);
        entries.add("height", wheel.height, self.length);
        entries.add("lateral_force", wheel.force[0], self.force);
        entries.add("vertical_force", wheel.force[1], self.force);
        entries.value()
    }

    /// Writes the table of patches and a sentence on each wheel.
    pub fn write(&self, wheels: &[LoadedWheel; 2], out: &mut impl Write) -> io::Result<()> {
        let [place, size, force] = self.digits;
        let mut patches = wheels.iter().flat_map(|wheel| &wheel.patches);
        let pressure = match patches.any(|patch| patch.strips.is_some()) {
            true => "pressure on strips",
            false => "pressure of an ellipse",
        };
        let mut table = TerminalTable::new(
            1,
            &[
                ("wheel", ""),
                ("y", self.length.label),
                ("angle", "rad"),
                ("share", ""),
                ("normal", self.force.label),
                ("Fx", self.force.label),
                ("Fy", self.force.label),
                ("Mz", self.moment.label),
                ("creepage x", "1e-3"),
                ("y", "1e-3"),
                ("spin", self.spin.label),
                ("a", self.length.label),
                ("b", self.length.label),
                (pressure, self.pressure.label),
            ],
        );
        for (wheel, side) in wheels.iter().zip(["left", "right"]) {
            for patch in &wheel.patches {
                let [x, y] = patch.creepage;
                table.row([
                    side.to_owned(),
                    format!("{:.place$}", self.length.of(patch.y)),
                    format!("{:.4}", patch.angle),
                    format!("{:.2}", patch.share),
                    format!("{:.force$}", self.force.of(patch.normal)),
                    format!("{:.force$}", self.force.of(patch.fx)),
                    format!("{:.force$}", self.force.of(patch.fy)),
                    format!("{:.0}", self.moment.of(patch.spin_moment)),
                    format!("{:.4}", 1e3 * x),
                    format!("{:.4}", 1e3 * y),
                    format!("{:.3e}", self.spin.of(patch.spin)),
                    format!("{:.size$}", self.length.of(patch.axes[0])),
                    format!("{:.size$}", self.length.of(patch.axes[1])),
                    format!("{:.0}", self.pressure.of(patch.greatest_pressure)),
                ]);
            }
        }
        table.write(out)?;
        writeln!(out)?;
        let unit = self.length.label;
        for (wheel, side) in wheels.iter().zip(["left", "right"]) {
            let (y, height) = (self.length.of(wheel.center), self.length.of(wheel.height));
            match wheel.seat {
                Seat::OnRail => writeln!(
                    out,
                    "The {side} wheel's center is {height:.size$} {unit} above the top of its rail."
                )?,
                Seat::FlangeTip => writeln!(
                    out,
                    "The {side} wheel has climbed: it stands on the tip of its flange, above the flange's \
                     face; its center, at y = {y:.place$} {unit},\nis {height:.size$} {unit} above the top \
                     of its rail."
                )?,
                Seat::RimEdge => writeln!(
                    out,
                    "The {side} wheel stands on the outer edge of its rim, about to fall between the rails; \
                     its center is at y = {y:.place$} {unit}."
                )?,
                Seat::OffRail => writeln!(
                    out,
                    "The {side} wheel is off its rail: its tape circle is at y = {y:.place$} {unit}. It \
                     carries nothing."
                )?,
            }
        }
        Ok(())
    }
}

impl Shown {
    /// Returns its name in a table.
    pub fn label(&self) -> &'static str {
        self.label
    }

    /// Returns a value (SI) in this unit.
    pub fn of(&self, si: f64) -> f64 {
        self.factor * si
    }
}

/// Entries of a JSON object, in their order.
#[derive(Debug, Default)]
pub struct Entries(Map<String, Value>);

impl Entries {
    /// Appends a value.
    pub fn put(&mut self, key: &str, value: impl Into<Value>) {
        self.0.insert(key.to_owned(), value.into());
    }

    /// Appends a value (SI) in a unit, which ends its key.
    pub fn add(&mut self, key: &str, si: f64, unit: Shown) {
        self.0
            .insert(format!("{key}_{}", unit.suffix), json!(unit.of(si)));
    }

    /// Appends values (SI) in a unit, which ends their key.
    pub fn list(&mut self, key: &str, si: Vec<f64>, unit: Shown) {
        let values: Vec<f64> = si.into_iter().map(|value| unit.of(value)).collect();
        self.0.insert(format!("{key}_{}", unit.suffix), json!(values));
    }

    /// Returns the object.
    pub fn value(self) -> Value {
        Value::Object(self.0)
    }
}
