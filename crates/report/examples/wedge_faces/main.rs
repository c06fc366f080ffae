//! Writes docs/wedge-faces.md and its figures: what the faces of the wedges decide.
//!
//! `cargo run --release -p report --example wedge_faces`: ten minutes on two cores.

mod cars;
mod contacts;
mod hunts;
#[path = "../../../study/examples/car_validation/shared.rs"]
mod shared;
mod warps;

use std::{fs, path::Path};

use drawing::Figure;
use shared::Failure;

pub(crate) const POUND_FORCE: f64 = 4.448_221_615_260_5;

/// A section of the page: its text, and its figures with the names of their files.
pub(crate) struct Section {
    pub text: String,
    pub figures: Vec<(&'static str, Figure)>,
}

/// What computes a section.
type Write = fn() -> Result<Section, Failure>;

/// Faces by name, with what they set in a truck's case.
pub(crate) type Faces = (&'static str, &'static [&'static str]);

pub(crate) const CORNERS: Faces = (
    "flat, corners alone",
    &[
        "slope_face.wedge_surface=flat",
        "slope_face.grid=[2, 2]",
        "column_face.grid=[2, 2]",
    ],
);
pub(crate) const FLAT: Faces = ("flat", &["slope_face.wedge_surface=flat"]);
pub(crate) const CROWN_240: Faces = ("240 in", &[]);
pub(crate) const CROWN_120: Faces = (
    "120 in",
    &[
        "slope_face.wedge_surface={shape='crown',radius='120 in',direction='across'}",
        "slope_face.grid=[2, 41]",
    ],
);
pub(crate) const CROWN_60: Faces = (
    "60 in",
    &[
        "slope_face.wedge_surface={shape='crown',radius='60 in',direction='across'}",
        "slope_face.grid=[2, 41]",
    ],
);

const HEAD: &str = "\
# What the wedge's faces decide

Wedges of cars, and of trucks without other faces, have slope faces that are **crowned across by 240 in** \
and 2 × 9 points on both
faces. Flat faces, with which the thesis and NUCARS's element are compared, bear on their whole width or on \
their corners alone.
This page lays both beside other radii. It is written by `cargo run --release -p report --example \
wedge_faces` in ten
minutes on two cores, with its figures.

**The radius is in no source.** 240 in is a choice; 60 in, 120 in and flat are conditions (`crown_60`, \
`crown_120`, `flat`) beside it. Real wedge faces are
crowned or arcuate (patents speak of arcuate friction shoes on flat pocket plates), and the thesis names the \
curved slope as its
first future work. No figure here has found or confirmed a radius: warp goes down with it throughout, \
the empty car's hunting follows
the clearance of its flanges more than any radius, and a loaded car's verdicts hardly notice it.
";

fn main() -> Result<(), Failure> {
    let sections: [(&str, Write); 5] = [
        ("contacts", contacts::section),
        ("warps", warps::section),
        ("hunts", hunts::section),
        ("clearance", hunts::clearance),
        ("cars", cars::section),
    ];
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs");
    let write = |section: &Section| -> Result<(), Failure> {
        for (name, figure) in &section.figures {
            fs::write(docs.join("figures").join(format!("{name}.svg")), figure.to_svg())?;
        }
        Ok(())
    };
    if let Some(chosen) = std::env::args().nth(1) {
        // One section, to look at.
        let found = sections.iter().find(|(name, _)| *name == chosen);
        let (_, section) = found.ok_or("there are contacts, warps, hunts, clearance, cars")?;
        let section = section()?;
        println!("{}", section.text);
        return write(&section);
    }
    let mut page = HEAD.to_owned();
    for (_, section) in sections {
        let section = section()?;
        write(&section)?;
        page += "\n";
        page += &section.text;
    }
    fs::write(docs.join("wedge-faces.md"), page)?;
    Ok(())
}

/// Returns a row of a table.
pub(crate) fn row(cells: impl IntoIterator<Item = String>) -> String {
    let cells: Vec<String> = cells.into_iter().collect();
    format!("| {} |\n", cells.join(" | "))
}

/// Returns the head of a table.
pub(crate) fn head(cells: &[&str]) -> String {
    format!("| {} |\n|{}\n", cells.join(" | "), "---|".repeat(cells.len()))
}
