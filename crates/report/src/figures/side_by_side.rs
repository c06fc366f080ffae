//! Runs over each other: loops, time histories, and of what rolls histories over the distance.
//!
//! Every run is drawn at its own rows, in the units of the first one. A run that lacks a column is left out
//! of its panel, and the caption says so.

use ::study::each_summary;
use quantity::System as Units;

use super::{Exhibit, axis};
use crate::models::ReportSummary;
use crate::overlay::{self, words};
use crate::run_folder::RunFolder;
use crate::table::TableColumn;
use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};

/// A figure that a model has: panels of one column over another.
#[derive(Clone, Debug)]
pub struct Wanted {
    pub(crate) name: String,
    pub(crate) title: String,
    /// The caption without the runs.
    pub(crate) caption: String,
    /// Columns along both axes, and the panel's title.
    pub(crate) panels: Vec<[String; 3]>,
    /// True if it is drawn only where something moves along both axes.
    pub(crate) loops: bool,
}

impl Wanted {
    pub(crate) fn new(name: &str, title: &str, caption: &str, x: &str, columns: &[(&str, &str)]) -> Self {
        let panels = columns
            .iter()
            .map(|(y, title)| [x, *y, *title].map(str::to_owned));
        Self {
            name: name.to_owned(),
            title: title.to_owned(),
            caption: caption.to_owned(),
            panels: panels.collect(),
            loops: false,
        }
    }

    pub(crate) fn looped(self) -> Self {
        Self { loops: true, ..self }
    }

    /// With these panels instead, as loops.
    pub(crate) fn with(self, panels: impl IntoIterator<Item = [String; 3]>) -> Self {
        Self {
            panels: panels.into_iter().collect(),
            loops: true,
            ..self
        }
    }
}

/// Returns the figures of these runs over each other, in the units of the first.
#[must_use]
pub fn exhibits(runs: &[RunFolder]) -> Vec<Exhibit> {
    let Some(units) = runs.first().map(RunFolder::units) else {
        return Vec::new();
    };
    let mut wanted: Vec<Wanted> = Vec::new();
    for run in runs {
        for own in each_summary!(&run.summary, own => own.overlays(&run.table)) {
            if wanted.iter().all(|other| other.name != own.name) {
                wanted.push(own);
            }
        }
    }
    let drawn = wanted.iter().filter_map(|own| exhibit(own, runs, units));
    drawn.collect()
}

/// Returns the figure; `None` where no run has anything of it.
fn exhibit(wanted: &Wanted, runs: &[RunFolder], units: Units) -> Option<Exhibit> {
    let mut panels = Vec::new();
    let mut drawn = vec![false; runs.len()];
    for [x, y, title] in &wanted.panels {
        let mut panel = Panel::default();
        for (number, run) in runs.iter().enumerate() {
            let (Some(abscissa), Some(ordinate)) = (best(run, x), best(run, y)) else {
                continue;
            };
            let moves = |own: &TableColumn| overlay::moves(own.kind, &own.si());
            if wanted.loops && !(moves(abscissa) && moves(ordinate)) {
                continue;
            }
            if panel.curves.is_empty() {
                panel.x_label = axis(&words(x), abscissa.kind, units);
                panel.y_label = axis(&words(y), ordinate.kind, units);
            }
            drawn[number] = true;
            let points = abscissa.in_units(units).into_iter().zip(ordinate.in_units(units));
            panel
                .curves
                .push(PlotCurve::new(run.label.clone(), look(number), points));
        }
        if !panel.curves.is_empty() {
            panel.title.clone_from(title);
            panels.push(panel);
        }
    }
    if panels.is_empty() {
        return None;
    }
    let missing = runs.iter().zip(&drawn).filter(|(_, drawn)| !**drawn);
    let missing: Vec<&str> = missing.map(|(run, _)| run.label.as_str()).collect();
    let mut caption = format!("{} Each run at its own output times.", wanted.caption);
    if !missing.is_empty() {
        caption.push_str(&format!(" Not in {}.", missing.join(", ")));
    }
    let columns = if panels.len() > 1 { 2 } else { 0 };
    Some(Exhibit::new(
        format!("overlay_{}", wanted.name),
        Figure::new(wanted.title.clone(), caption, panels).in_columns(columns),
    ))
}

/// Colour and line of a run: the same in every figure.
fn look(number: usize) -> (Colour, Line) {
    match number {
        // Two runs are told apart best by black, solid, under vermillion, dashed.
        0 => (Colour::Black, Line::Solid),
        1 => (Colour::Vermillion, Line::Dashed),
        number => distinct(number),
    }
}

/// Returns the filtered column if there is one, else the raw one.
fn best<'r>(run: &'r RunFolder, name: &str) -> Option<&'r TableColumn> {
    let filtered = format!("{name}_filtered");
    let columns = run.table.columns();
    let find = |name: &str| columns.iter().find(|own| own.name == name);
    find(&filtered).or_else(|| find(name))
}
