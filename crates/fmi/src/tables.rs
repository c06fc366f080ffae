//! The tables of a nest ([`study::tables`]) behind the variables: vertical force over stroke, warp moment
//! over warp angle, without states.
//!
//! ```text
//! F(s, v) = m(s) + d(s) v / √(v² + v0²),    m = (F_rising + F_falling) / 2,  d = (F_rising - F_falling) / 2
//! ```
//!
//! with the branches from the table at load, rise, friction and the rate `|v| / A`, the angular frequency of
//! the sine of the table's amplitude A whose greatest speed is v. A value of load, rise or friction outside
//! the table is held at its end, and `outside` says so; beyond the amplitude the outermost slopes go on. A
//! rate outside is held without a word: at rest it is always below the table's.

use std::path::Path;

use mechanics::plausibility::{Location, PlausibilityFinding};
use quantity::Kind;
use serde::{Deserialize, Serialize};
use study::case::Tables;
use study::packed::PackedFile;
use study::tables::NestTables;
use study::tables::grid::Point;
use study::truck::TruckCase;

use crate::element::{Element, Entries, QuantityEntry, Setting, Slopes, rate_input};
use crate::element_state::ElementState;
use crate::source::{Made, Model, Origin};
use crate::system::steps;
use crate::{Error, limits};

/// The file of the tables in an FMU.
const FILE: &str = "tables.json";
/// Inputs: stroke with its rate, warp angle with its rate, load, rise, friction.
const INPUTS: usize = 7;
/// Share of the greatest speed of the table's slowest motion at which the sign is half rounded off, unless
/// another speed is given: a choice.
const ROUNDED: f64 = 0.05;

/// Share of the amplitude by which a position may be beyond it without being called outside: co-simulation
/// carries positions a little over their turning points.
const OVERSHOOT: f64 = 1e-3;

/// Tables with the case of the truck that they are made of.
#[derive(Clone, Debug)]
pub struct TablesOrigin {
    case: TruckCase,
    tables: NestTables,
}

/// The same as a file.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Packed {
    case: String,
    tables: NestTables,
}

impl TablesOrigin {
    /// Returns the tables of a case.
    #[must_use]
    pub fn new(case: &TruckCase, tables: &NestTables) -> Self {
        Self {
            case: case.clone(),
            tables: tables.clone(),
        }
    }
}

impl Origin for TablesOrigin {
    type Case = TruckCase;

    const FILE: (&'static str, u64) = (FILE, limits::TEXT_FILE);

    fn case(&self) -> (&TruckCase, &str) {
        (&self.case, &self.case.title)
    }

    fn packed(&self) -> (String, Vec<PackedFile>) {
        let packed = Packed {
            case: self.case.to_toml_embedded().to_owned(),
            tables: self.tables.clone(),
        };
        // Numbers and texts can always be written.
        let text = serde_json::to_string(&packed).unwrap_or_default();
        (text, Vec::new())
    }

    fn parse(text: &str, folder: &Path) -> Result<Self, Error> {
        let damaged = |error: String| Error::new(format!("the FMU's {FILE} is damaged: {error}"));
        let Packed { case, tables } =
            serde_json::from_str(text).map_err(|error| damaged(error.to_string()))?;
        tables.validate().map_err(damaged)?;
        let case = TruckCase::parse(FILE, &case, Tables::from(folder), &[]);
        let case = case.map_err(|error| damaged(error.to_string()))?;
        Ok(Self { case, tables })
    }
}

/// The tables of a nest.
pub(crate) struct TablesModel;

impl Model for TablesModel {
    type Origin = TablesOrigin;

    const NAME: &'static str = "NestTables";
    const TEXT: &'static str = "Nest of a three-piece truck with its wedges, as tables: vertical force over \
                                stroke, warp moment over warp angle";
    const CONVENTIONS: &'static str = "One nest. Stroke: positive where the bolster sinks against the side \
                                       frame, from where the nest carries its load; force: positive where it \
                                       pushes the bolster up, the load in it. Warp angle: yaw of the side \
                                       frame less that of the bolster; moment: on the bolster, positive \
                                       where it turns it after the side frame.";

    fn made(origin: &TablesOrigin, setting: Option<&Setting>) -> Result<Made, Error> {
        let tables = &origin.tables;
        let entries = entries(tables);
        let element = setting.map(|setting| TablesElement::new(tables, setting));
        let element = element.transpose()?;
        Ok((
            entries,
            element.map(|element| Box::new(element) as Box<dyn Element>),
        ))
    }
}

/// Returns all quantities.
fn entries(tables: &NestTables) -> Entries {
    let ends = |k: usize| {
        let values = &tables.grid.values[k];
        [values[0], values[values.len() - 1]]
    };
    let [load, rise, friction, _] = tables.grid.middle();
    let moved = |kind: Kind, name: &str, text: &str, rate: usize| QuantityEntry {
        rate: Some(rate),
        ..QuantityEntry::of(kind, name, text).starting(0.0)
    };
    let within = |kind: Kind, name: &str, text: &str, k: usize, start: f64| {
        let [least, most] = ends(k);
        let text = format!("{text}; the table goes from {least} to {most}");
        QuantityEntry::of(kind, name, text).starting(start)
    };
    let inputs = vec![
        moved(
            Kind::Length,
            "stroke",
            "bolster below where the nest carries its load",
            1,
        ),
        rate_input(Kind::Speed, "stroke"),
        moved(
            Kind::Angle,
            "warp_angle",
            "yaw of the side frame less that of the bolster",
            3,
        ),
        rate_input(Kind::AngularSpeed, "warp_angle"),
        within(
            Kind::Force,
            "load",
            "what the nest's coils carry at zero stroke",
            0,
            load,
        ),
        within(
            Kind::Length,
            "rise",
            "rise of the wedges in their pockets",
            1,
            rise,
        ),
        within(
            Kind::Dimensionless,
            "friction",
            "friction of the wedges",
            2,
            friction,
        ),
    ];
    let outputs = vec![
        QuantityEntry::of(Kind::Force, "force", "vertical force of the nest, its load in it"),
        QuantityEntry::of(Kind::Moment, "moment", "warp moment of the nest on the bolster"),
        QuantityEntry::of(
            Kind::Dimensionless,
            "outside",
            "0; 1 where load, rise or friction are outside the table and held at its end, or stroke or \
             warp angle are beyond its amplitude",
        ),
    ];
    let slowest = tables.grid.values[3][0];
    let speeds = [
        (Kind::Speed, "stroke_rate_scale", "stroke rate"),
        (Kind::AngularSpeed, "warp_rate_scale", "warp rate"),
    ];
    let speeds = speeds.into_iter().zip(&tables.tables);
    let parameters = speeds.map(|((kind, name, words), table)| QuantityEntry {
        reach: Some([f64::MIN_POSITIVE, 1e3]),
        tunable: true,
        ..QuantityEntry::of(
            kind,
            name,
            format!("{words} at which 71 % of the loop's half width acts against the motion"),
        )
        .starting(ROUNDED * slowest * table.amplitude)
    });
    Entries {
        parameters: parameters.collect(),
        options: steps("bolster and side frame").to_vec(),
        inputs,
        outputs,
        ..Entries::default()
    }
}

/// The tables behind the variables.
#[derive(Clone, Debug)]
struct TablesElement {
    tables: NestTables,
    /// Rates at which the sign is rounded off.
    scales: [f64; 2],
    time: f64,
    inputs: Vec<f64>,
}

/// Returns the rates at which the sign is rounded off.
fn scales(parameters: &[f64]) -> Result<[f64; 2], Error> {
    match parameters {
        [stroke, warp] if *stroke > 0.0 && *warp > 0.0 && stroke.is_finite() && warp.is_finite() => {
            Ok([*stroke, *warp])
        }
        _ => Err(Error::new(
            "stroke_rate_scale and warp_rate_scale must be above zero",
        )),
    }
}

impl TablesElement {
    fn new(tables: &NestTables, setting: &Setting) -> Result<Self, Error> {
        let mut own = Self {
            tables: tables.clone(),
            scales: scales(&setting.parameters)?,
            time: setting.start_time,
            inputs: vec![0.0; INPUTS],
        };
        own.set_inputs(&setting.inputs)?;
        Ok(own)
    }

    /// Returns force, moment, and whether a value lies outside.
    fn values(&self) -> Result<[f64; 3], Error> {
        let input = |k: usize| self.inputs.get(k).copied().unwrap_or(0.0);
        let [load, rise, friction] = [input(4), input(5), input(6)];
        let grid = &self.tables.grid;
        let mut out = [0.0; 3];
        for (k, table) in self.tables.tables.iter().enumerate() {
            let (position, rate) = (input(2 * k), input(2 * k + 1));
            let at: Point = [load, rise, friction, rate.abs() / table.amplitude];
            let within = grid.clamped(at);
            let beyond = position.abs() > table.amplitude * (1.0 + OVERSHOOT);
            let is_outside = at[..3] != within[..3] || beyond;
            let [mean, half] = table.mean_and_half(grid, within, position).map_err(Error::of)?;
            let sign = rate / (rate * rate + self.scales[k] * self.scales[k]).sqrt();
            out[k] = mean + half * sign;
            if is_outside {
                out[2] = 1.0;
            }
        }
        Ok(out)
    }
}

impl Element for TablesElement {
    fn states(&self) -> &[f64] {
        &[]
    }

    fn set_states(&mut self, time: f64, states: &[f64]) -> Result<(), Error> {
        if !states.is_empty() || !time.is_finite() {
            return Err(Error::new("a finite time and no states are expected"));
        }
        self.time = time;
        Ok(())
    }

    fn set_inputs(&mut self, inputs: &[f64]) -> Result<(), Error> {
        if inputs.len() != INPUTS {
            return Err(Error::new(format!(
                "{} inputs are given; there are {INPUTS}",
                inputs.len()
            )));
        }
        if let Some(bad) = inputs.iter().find(|value| !value.is_finite()) {
            return Err(Error::new(format!("an input is {bad}; it must be finite")));
        }
        self.inputs.copy_from_slice(inputs);
        Ok(())
    }

    fn tune(&mut self, parameters: &[f64]) -> Result<(), Error> {
        self.scales = scales(parameters)?;
        Ok(())
    }

    fn step(&mut self, end: &[f64], time: f64) -> Result<(), Error> {
        if !(time > self.time && time.is_finite()) {
            return Err(Error::new(format!(
                "a step from {} s to {time} s is none",
                self.time
            )));
        }
        self.set_inputs(end)?;
        self.time = time;
        Ok(())
    }

    fn rates(&mut self, _: &mut [f64]) -> Result<(), Error> {
        Ok(())
    }

    fn indicators(&mut self, _: &mut [f64]) {}

    fn modes(&self) -> &[u8] {
        &[]
    }

    fn update_modes(&mut self) -> bool {
        false
    }

    fn outputs(&mut self, out: &mut [f64]) -> Result<(), Error> {
        for (target, value) in out.iter_mut().zip(self.values()?) {
            *target = value;
        }
        Ok(())
    }

    fn columns(&mut self, _: &mut [f64]) {}

    fn findings(&mut self) -> Vec<PlausibilityFinding> {
        Vec::new()
    }

    fn place(&self, _: Location) -> String {
        "the nest".to_owned()
    }

    fn jacobian_vector_product(&mut self, _: &[f64], _: &[f64]) -> Result<Slopes, Error> {
        Err(Error::new("tables give no directional derivatives"))
    }

    fn save(&self) -> ElementState {
        ElementState {
            time: self.time,
            states: Vec::new(),
            inputs: self.inputs.clone(),
            system: None,
        }
    }

    fn restore(&mut self, state: &ElementState) -> Result<(), Error> {
        if state.system.is_some() {
            return Err(Error::new("the saved state belongs to another model"));
        }
        state.check(0, INPUTS)?;
        self.set_inputs(&state.inputs)?;
        self.time = state.time;
        Ok(())
    }
}
