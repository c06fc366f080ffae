//! The data of the interactive page: `wedgelab.view/1`, described in `docs/view.md`.
//!
//! - [`data`]: numbers as text, each list once.
//! - [`chart`]: figures as curves instead of drawings.
//! - [`run`]: a run's columns, and which belong in one plot; [`kept`]: a run as its own page keeps it.
//! - [`scene`]: what a run looks like: bodies, solids, coils, contacts; [`truck`] and [`half_truck`]: that of
//!   a truck and of a half-truck, by what both have in common; [`rolling`]: track, wheels and contact patches
//!   of all that rolls, [`wheelset`]: one wheelset, [`vehicle`]: bodies and elements of a user, [`car`]: a
//!   car of two trucks, [`mode_shape`]: a motion about its steady running.
//!
//! All numbers are in SI units; how they are shown in either system stands with them.

pub mod car;
mod carriage;
pub mod chart;
pub mod data;
pub mod half_truck;
pub mod kept;
pub mod mode_shape;
mod pressure;
pub mod rolling;
pub mod run;
pub mod scene;
mod stand_alone;
pub mod truck;
pub mod vehicle;
pub mod wheelset;

use std::collections::BTreeMap;

use quantity::{Kind, System as Units};
use serde::Serialize;

use crate::figures::Exhibit;
use data::{Data, List, Precision};
use kept::KeptView;
use run::Recording;

/// The name and version of what is written.
pub const SCHEMA: &str = "wedgelab.view/1";

/// The units in which a kind of quantity is shown.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct KindUnits {
    /// Its US customary unit; empty for pure numbers.
    pub us: &'static str,
    /// Its SI unit.
    pub si: &'static str,
    /// The factor from SI to US customary.
    pub us_from_si: f64,
}

/// The whole document.
#[derive(Clone, Debug, Serialize)]
pub struct View {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// The system of units that is shown first: `us` or `si`.
    pub units: &'static str,
    /// The units of each kind of quantity.
    pub quantities: BTreeMap<String, KindUnits>,
    /// Lists of numbers. All others name them by their place.
    pub data: Vec<List>,
    /// The figures by name.
    pub figures: BTreeMap<String, chart::Chart>,
    /// The runs.
    pub runs: Vec<run::RunView>,
}

impl View {
    /// Returns the document of these runs and figures, whose numbers are in `units`, which are shown first.
    #[must_use]
    pub fn new<'e>(
        units: Units,
        recordings: impl IntoIterator<Item = Recording>,
        exhibits: impl IntoIterator<Item = &'e Exhibit>,
    ) -> Self {
        Self::with(units, recordings, exhibits, Precision::Exact)
    }

    /// Returns the same, with the figures' curves to a precision.
    pub(crate) fn with<'e>(
        units: Units,
        recordings: impl IntoIterator<Item = Recording>,
        exhibits: impl IntoIterator<Item = &'e Exhibit>,
        precision: Precision,
    ) -> Self {
        let mut data = Data::default();
        let runs = recordings
            .into_iter()
            .map(|recording| recording.into_view(&mut data))
            .collect();
        // Flow charts have no curves: they stay as they are drawn.
        let curves = exhibits
            .into_iter()
            .filter(|exhibit| exhibit.figure.flow.is_none());
        let figures = curves
            .map(|exhibit| {
                let chart = chart::Chart::new(&exhibit.figure, units, precision, &mut data);
                (exhibit.name.clone(), chart)
            })
            .collect();
        Self {
            schema: SCHEMA,
            units: units.name(),
            quantities: quantities(),
            data: data.into_lists(),
            figures,
            runs,
        }
    }

    /// Returns the document as JSON that may stand in a `script` element: no `<` in it.
    ///
    /// # Errors
    /// Errors of the JSON writer.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        Ok(escaped(&serde_json::to_string(self)?))
    }

    /// Returns the same with runs that come from other pages.
    ///
    /// # Errors
    /// Errors of the JSON writer.
    pub fn to_json_with(
        &self,
        kept: impl IntoIterator<Item = KeptView>,
    ) -> Result<String, serde_json::Error> {
        let mut document = serde_json::to_value(self)?;
        for own in kept {
            own.add_to(&mut document);
        }
        Ok(escaped(&serde_json::to_string(&document)?))
    }
}

fn escaped(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// Returns a kind's name in the document.
#[must_use]
pub fn kind_name(kind: Kind) -> String {
    match serde_json::to_value(kind) {
        Ok(serde_json::Value::String(name)) => name,
        _ => String::new(),
    }
}

fn quantities() -> BTreeMap<String, KindUnits> {
    let shown = |kind: Kind| KindUnits {
        us: kind.label(Units::Us),
        si: kind.label(Units::Si),
        us_from_si: kind.from_si(Units::Us),
    };
    Kind::ALL
        .into_iter()
        .map(|kind| (kind_name(kind), shown(kind)))
        .collect()
}
