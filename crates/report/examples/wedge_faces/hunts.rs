//! Hunting of the empty car on roller side bearings over ramps of the speed.

use drawing::{Figure, Panel, PlotCurve, distinct};
use study::car::hunting::Hunting;

use crate::shared::{Failure, INCH, MPH, cells, each, hunt};
use crate::{CORNERS, CROWN_60, CROWN_120, CROWN_240, FLAT, Faces, Section, head, row};

/// Durations of a ramp, s.
const RAMPS: [f64; 2] = [50.0, 100.0];

/// Runs the ramps of a car with these faces and further settings.
fn ramps(ramp: f64, (_, set): &Faces, more: &[&str]) -> Result<Hunting, Failure> {
    let mut overrides = vec!["truck.side_bearing.kind=roller".to_owned()];
    overrides.extend(set.iter().map(|own| format!("truck.{own}")));
    overrides.extend(more.iter().map(|own| (*own).to_owned()));
    hunt([30.0, 80.0], ramp, &overrides)
}

/// The same with more room between flanges and rails.
pub(crate) fn clearance() -> Result<Section, Failure> {
    let mut text =
        "### The clearance of the flanges\n\nIt bounds every limit cycle. With the back to back of \
                    wide flanges, 53 3/32 in (`wheels.tape_distance = \"59.21875 in\"`), narrow ones have \
                    0.55 in in place of 0.41 in; ramps of 50 s:\n\n"
            .to_owned();
    text += &head(&[
        "slope face",
        "clearance, in",
        "falling: dies at, mph",
        "rising: begins at, mph",
        "largest amplitude, in",
    ]);
    let faces = [CORNERS, CROWN_240, CROWN_60];
    let wide = |own: &Faces| ramps(RAMPS[0], own, &["wheels.tape_distance=59.21875 in"]);
    for ((name, _), own) in faces.iter().zip(each(&faces, wide)?) {
        let [_, others @ ..] = cells(&own);
        text += &row([(*name).to_owned(), "0.55".to_owned()].into_iter().chain(others));
    }
    text += "\nWith that room the face decides where the limit cycle dies; with 0.41 in the flanges do.\n";
    Ok(Section {
        text,
        figures: Vec::new(),
    })
}

pub(crate) fn section() -> Result<Section, Failure> {
    let mut text = "## Hunting\n\nThe empty car on roller side bearings (AAR-1B, tread of 1:20) on straight \
                    track: falling from 80 to 30 mph after all axles began 0.4 in to the left, and rising \
                    over dips of 0.02 in. A wheelset hunts from an amplitude of 0.05 in on; its flanges \
                    have a clearance of 0.41 in. The field tells 50 to 55 mph.\n\n"
        .to_owned();
    text += &head(&[
        "slope face",
        "ramp, s",
        "falling: flange to flange down to, mph",
        "falling: dies at, mph",
        "rising: begins at, mph",
        "largest amplitude, in",
    ]);
    let faces = [CORNERS, FLAT, CROWN_240, CROWN_120, CROWN_60];
    let items: Vec<_> = RAMPS
        .into_iter()
        .flat_map(|ramp| faces.map(|own| (ramp, own)))
        .collect();
    let found = each(&items, |(ramp, faces)| ramps(*ramp, faces, &[]))?;
    let mut panels: Vec<Panel> = RAMPS
        .map(|ramp| Panel {
            title: format!("falling within {ramp} s"),
            x_label: "speed (mph)".to_owned(),
            y_label: "largest lateral amplitude of a wheelset (in)".to_owned(),
            ..Panel::default()
        })
        .into();
    for (number, ((ramp, (name, _)), own)) in items.iter().zip(&found).enumerate() {
        let first = [(*name).to_owned(), format!("{ramp}")];
        text += &row(first.into_iter().chain(cells(own)));
        let (colour, line) = distinct(number % faces.len());
        panels[number / faces.len()].curves.push(PlotCurve {
            label: (*name).to_owned(),
            colour,
            line,
            points: own
                .falling
                .points
                .iter()
                .map(|own| (own.speed / MPH, own.amplitude() / INCH))
                .collect(),
        });
    }
    text += "\n![Amplitudes of the wheelsets over the falling speed](figures/wedge_faces_hunting.svg)\n\n\
             Whatever the face, the limit cycle dies at much the same speed, and nothing begins to hunt by \
             itself. A ramp of twice the time moves the speeds by 3 to 9 mph, as much as the faces differ: \
             no radius is found or confirmed by it.\n";
    let figure = Figure {
        title: "Hunting of the empty car with flat and crowned wedge faces".to_owned(),
        caption: "Largest lateral amplitude of a wheelset over the falling speed, by the radius of the \
                  slope face's crown, for two durations of the ramp."
            .to_owned(),
        panels,
        columns: 2,
        common_axes: true,
        ..Figure::default()
    };
    Ok(Section {
        text,
        figures: vec![("wedge_faces_hunting", figure)],
    })
}
