//! Warp: stiffness over the angle with other faces, friction and contacts.

use drawing::{Colour, Figure, Line, Panel, PlotCurve, distinct};
use report::warp_files::{KIP_INCH, growth_in_words};
use study::run::Run;
use study::truck::builtin;
use study::truck::summary::WARP_ANGLES;
use study::truck::warp::{NUCARS_STIFFNESS, WarpCurve};

use crate::shared::{Failure, each};
use crate::{CORNERS, CROWN_60, CROWN_120, CROWN_240, FLAT, Faces, Section, head, row};

/// The label of a test, and what it sets.
type Test = (String, Vec<String>);

/// Its curve: stiffness at the angles, N·m/rad, and what the moment does.
struct Curve {
    label: String,
    stiffness: Vec<(f64, f64)>,
    growth: String,
}

fn curves(name: &str, tests: &[Test]) -> Result<Vec<Curve>, Failure> {
    each(tests, |(label, set)| {
        let case = builtin::case_with(name, set)?;
        let result = Run::new(&case)?.finish(|_| ());
        if let Some(stopped) = &result.summary.stopped {
            return Err(format!("{name} {set:?} stopped: {}", stopped.reason).into());
        }
        let curve = WarpCurve::of(&case, &result).ok_or("the warp angle stays small")?;
        Ok(Curve {
            label: label.clone(),
            stiffness: curve.stiffness,
            growth: growth_in_words(curve.growth),
        })
    })
}

fn of_faces(faces: &[Faces]) -> Vec<Test> {
    let own = |(name, set): &Faces| {
        (
            (*name).to_owned(),
            set.iter().map(|own| (*own).to_owned()).collect(),
        )
    };
    faces.iter().map(own).collect()
}

fn table(first: &str, curves: &[Curve]) -> String {
    let mut text = head(&[first, "0.5", "1", "2", "5", "10", "20 mrad", "from 10 to 20 mrad"]);
    for curve in curves {
        let cell = |angle: &f64| {
            let found = curve.stiffness.iter().find(|(own, _)| *own == 1e-3 * angle);
            found.map_or("-".to_owned(), |(_, stiffness)| {
                format!("{:.1}", 1e-3 * stiffness / KIP_INCH)
            })
        };
        let cells = [curve.label.clone()].into_iter();
        let cells = cells.chain(WARP_ANGLES.iter().map(cell));
        text += &row(cells.chain([curve.growth.clone()]));
    }
    text
}

fn panel(title: &str, curves: &[Curve]) -> Panel {
    let lines = [Line::Dotted, Line::Dashed];
    let empirical = NUCARS_STIFFNESS
        .iter()
        .zip(lines)
        .map(|((name, stiffness), line)| PlotCurve {
            label: (*name).to_owned(),
            colour: Colour::Grey,
            line,
            points: [0.5, 20.0]
                .map(|angle| (angle, 1e-3 * stiffness / KIP_INCH))
                .to_vec(),
        });
    let own = curves.iter().enumerate().map(|(number, curve)| {
        let (colour, line) = distinct(number);
        PlotCurve {
            label: curve.label.clone(),
            colour,
            line,
            points: curve
                .stiffness
                .iter()
                .map(|(angle, stiffness)| (1e3 * angle, 1e-3 * stiffness / KIP_INCH))
                .collect(),
        }
    });
    Panel {
        title: title.to_owned(),
        x_label: "warp angle (mrad)".to_owned(),
        y_label: "secant warp stiffness (kip·in/mrad)".to_owned(),
        curves: empirical.chain(own).collect(),
        ..Panel::default()
    }
}

/// The case whose table is that of the one before.
const SAME: &str = "constant damping, empty";
const CASES: [(&str, &str); 4] = [
    ("constant damping, loaded", "truck_crowned_warp_nest_constant"),
    (
        "constant damping, empty",
        "truck_crowned_warp_nest_constant_empty",
    ),
    ("variable damping, loaded", "truck_crowned_warp_nest_variable"),
    (
        "variable damping, empty",
        "truck_crowned_warp_nest_variable_empty",
    ),
];

pub(crate) fn section() -> Result<Section, Failure> {
    let mut text =
        "## Warp\n\nThe whole truck, side frames yawed against the bolster after it has risen to its height \
                    (`truck_crowned_warp_nest_...`, friction of 0.4), each test from the equilibrium without \
                    friction. Secant stiffness of the truck where an angle is reached first, kip·in/mrad; \
                    NUCARS's empirical lines are 17 for new and 3.5 for worn trucks.\n"
            .to_owned();
    let faces = of_faces(&[CORNERS, FLAT, CROWN_240, CROWN_120, CROWN_60]);
    let mut panels = Vec::new();
    for (title, case) in CASES {
        let own = curves(case, &faces)?;
        text += &format!("\n### {}\n\n", capital(title));
        text += &match title == SAME {
            true => "The same: control coils that stand on the bolster do not know the load.\n".to_owned(),
            false => table("slope face", &own),
        };
        panels.push(panel(title, &own));
    }
    text += "\n![Warp stiffness over the warp angle with flat and crowned \
             faces](figures/wedge_faces_warp.svg)\n\n\
             With constant damping a crown of 240 in is below the empirical line of new trucks from 6 mrad \
             on, with variable damping of the empty truck from 5 mrad on; loaded it stays above it. Below \
             that warp is stiffer than any line: there bristles and springs of the faces stick, and the \
             empirical lines are chords over 30 mrad.\n";
    text += "\n### Which face, which way, how many points\n\nConstant damping, loaded. A crown on either \
             face does it, if it is across; up the face it does little. Points: 2 × 9 carry 240 in, smaller \
             radii need more, which a run says by itself.\n\n";
    let others: [(&str, &[&str]); 8] = [
        ("240 in across the slope (default)", &[]),
        (
            "240 in across the column, slope flat",
            &[
                "slope_face.wedge_surface=flat",
                "column_face.wedge_surface={shape='crown',radius='240 in',direction='across'}",
            ],
        ),
        (
            "240 in up the slope",
            &[
                "slope_face.wedge_surface={shape='crown',radius='240 in',direction='up'}",
                "slope_face.grid=[9, 2]",
            ],
        ),
        (
            "240 in across the slope, 2 × 41 points",
            &["slope_face.grid=[2, 41]"],
        ),
        (
            "60 in across the slope, 2 × 9 points",
            &[
                "slope_face.wedge_surface={shape='crown',radius='60 in',direction='across'}",
                "slope_face.grid=[2, 9]",
            ],
        ),
        ("60 in across the slope, 2 × 41 points", CROWN_60.1),
        (
            "240 in, worn flat by 0.02 in",
            &[
                "slope_face.wedge_surface={shape='crown',radius='240 in',direction='across',worn_flat='0.02 \
                 in'}",
            ],
        ),
        (
            "240 in on a column worn hollow by 0.03 in",
            &[
                "column_face.counterface={shape='table',direction='across',points=[['-5.5 in','0 in'],\
                 ['-2.75 in','0.0225 in'],['0 in','0.03 in'],['2.75 in','0.0225 in'],['5.5 in','0 in']]}",
            ],
        ),
    ];
    text += &table("faces", &curves(CASES[0].1, &of_faces(&others))?);
    for (title, case) in [
        ("### Friction\n\nConstant damping, loaded.\n\n", CASES[0].1),
        ("Variable damping, loaded.\n\n", CASES[2].1),
    ] {
        text += "\n";
        text += title;
        let mut rows = Vec::new();
        for (name, set) in [FLAT, CROWN_240] {
            for friction in [0.1, 0.2, 0.3, 0.4, 0.5] {
                let own = ["column", "slope"].map(|face| format!("friction.{face}={friction}"));
                let set = set.iter().map(|own| (*own).to_owned()).chain(own);
                rows.push((format!("{name}, friction {friction}"), set.collect()));
            }
        }
        text += &table("slope face, friction", &curves(case, &rows)?);
    }
    text += "\nWith a friction of 0.3 and less the nest does not lock: from 10 to 20 mrad the moment grows \
             by less than half. There flat and crowned faces are within a quarter of each other at 20 \
             mrad.\n";
    text += "\n### Contact stiffness\n\nNo source gives it. Constant damping, loaded; lbf/in a corner.\n\n";
    let mut rows = Vec::new();
    for (name, set) in [CORNERS, FLAT, CROWN_240] {
        for stiffness in ["2.5e5", "1e6", "2.5e6"] {
            let own = [format!("contact.stiffness={stiffness} lbf/in")];
            // What is pressed less wide needs more points.
            let fine = [CROWN_240.0, FLAT.0]
                .contains(&name)
                .then(|| ["column", "slope"].map(|face| format!("{face}_face.grid=[2, 17]")));
            let set = set.iter().map(|own| (*own).to_owned()).chain(own);
            rows.push((
                format!("{name}, {stiffness}"),
                set.chain(fine.into_iter().flatten()).collect(),
            ));
        }
    }
    let own = curves(CASES[0].1, &rows)?;
    text += &table("slope face, stiffness", &own);
    let at_20 = |number: usize| own[number].stiffness.last().map_or(f64::NAN, |own| own.1);
    text += &format!(
        "\nAt 20 mrad ten times the stiffness makes {:.1} times the warp stiffness of corners, {:.1} of an \
         evenly bedded flat face, {:.1} of the crown (2 × 17 points on both faces).\n",
        at_20(2) / at_20(0),
        at_20(5) / at_20(3),
        at_20(8) / at_20(6)
    );
    let figure = Figure {
        title: "Warp stiffness with flat and crowned wedge faces".to_owned(),
        caption: "Secant warp stiffness of a truck over the warp angle where it is reached first, by the \
                  radius of the slope face's crown, for both dampings, loaded and empty; grey: NUCARS's \
                  empirical stiffnesses."
            .to_owned(),
        panels,
        columns: 2,
        common_axes: true,
        ..Figure::default()
    };
    Ok(Section {
        text,
        figures: vec![("wedge_faces_warp", figure)],
    })
}

fn capital(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|own| own.to_ascii_uppercase());
    first.into_iter().chain(letters).collect()
}
