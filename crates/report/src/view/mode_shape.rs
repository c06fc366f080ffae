//! The view of a motion about a car's steady running: the car of a run ([`super::car`]) without forces, whose
//! displacements from steady running alone are exaggerated.

use mechanics::output::Column;
use study::car::mode_shape::ModeRecording;

use super::car;
use super::run::Plot;
use super::scene::Scene;

/// Factors that the viewer offers.
const FACTORS: [f64; 6] = [50.0, 20.0, 10.0, 5.0, 2.0, 1.0];
/// The most that a body may be drawn away from its place (m) and turned (rad).
const DRAWN: [f64; 2] = [0.15, 0.25];
/// The exaggerated size beyond which displacements grow to scale, m: none comes there at first.
const LIMIT: f64 = 1.0;

/// Returns the scene without its contacts: a motion about steady running has no forces.
pub(super) fn scene(own: &ModeRecording, factor: f64) -> Option<Scene> {
    let mut scene = of_run(own)?;
    for body in &mut scene.bodies {
        for (steady, name) in body.steady.iter_mut().zip(&body.coordinates) {
            *steady = name.as_deref().map(resting);
        }
    }
    scene.factor = factor;
    scene.limit = LIMIT;
    Some(scene)
}

fn of_run(own: &ModeRecording) -> Option<Scene> {
    let mut scene = car::scene(&own.case, &own.result)?;
    scene.clear_contacts();
    scene.patches.clear();
    for coil in &mut scene.coils {
        (coil.force, coil.length) = (None, None);
    }
    Some(scene)
}

/// Returns the name of the column with the value of another in steady running.
fn resting(name: &str) -> String {
    format!("{name}_at_rest")
}

/// Returns the columns that say where bodies are in steady running, with their values.
pub(super) fn at_rest(own: &ModeRecording) -> (Vec<Column>, Vec<Vec<f64>>) {
    let rows = own.result.rows();
    let all = own.result.columns.iter().zip(&own.rest);
    let all = all.map(|(column, rest)| {
        let column = Column {
            name: resting(&column.name),
            text: format!("in steady running: {}", column.text),
            ..column.clone()
        };
        (column, vec![*rest; rows])
    });
    all.unzip()
}

/// Returns the plots: places and angles.
pub(super) fn plots(own: &ModeRecording) -> Vec<Plot> {
    let mut plots = car::plots(&own.result);
    // It stands still.
    plots.retain(|plot| plot.curves.iter().all(|(name, _)| name != "distance"));
    plots
}

/// Returns the largest factor of those that the viewer offers with which nothing is drawn too far from its
/// place; 1 without a scene.
#[must_use]
pub fn factor(own: &ModeRecording) -> f64 {
    let scene = of_run(own);
    let bodies = scene.iter().flat_map(|scene| &scene.bodies);
    let mut most = [0.0_f64; 2];
    for (k, name) in bodies.flat_map(|body| body.coordinates.iter().enumerate()) {
        let place = own
            .result
            .columns
            .iter()
            .position(|own| Some(&own.name) == name.as_ref());
        let Some(place) = place else { continue };
        let most = &mut most[k / 3];
        let moved = own.result.values[place]
            .iter()
            .map(|value| (value - own.rest[place]).abs());
        *most = moved.fold(*most, f64::max);
    }
    let fits = |factor: &f64| most.iter().zip(DRAWN).all(|(most, drawn)| factor * most <= drawn);
    FACTORS.into_iter().find(fits).unwrap_or(1.0)
}
