//! A system as tables: bodies, connections, characteristics, functions, in the file's units.

use std::collections::{BTreeMap, BTreeSet};

use crate::check::{GRAVITY, shown};
use crate::source::Spanned;
use crate::tree::{Law, SystemFile, Toe, UnknownValue};

/// A table of texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SystemTable {
    /// A short name for programs, which stays: `bodies`, `connections`, `wedges`.
    pub key: &'static str,
    /// Its title.
    pub title: String,
    /// Names and units of the columns; no unit is an empty text.
    pub columns: Vec<(&'static str, &'static str)>,
    /// Number of columns from the left that hold words.
    pub words: usize,
    /// The cells.
    pub rows: Vec<Vec<String>>,
}

impl SystemTable {
    fn new(
        key: &'static str,
        title: impl Into<String>,
        words: usize,
        columns: &[(&'static str, &'static str)],
    ) -> Self {
        SystemTable {
            key,
            title: title.into(),
            columns: columns.to_vec(),
            words,
            rows: Vec::new(),
        }
    }
}

/// Returns all tables of a system; those without rows are left out.
pub fn system(file: &SystemFile) -> Vec<SystemTable> {
    let mut tables = vec![bodies(file), input_bodies(file), connections(file)];
    tables.extend(characteristics(file));
    tables.push(functions(file));
    tables.retain(|table| !table.rows.is_empty());
    tables
}

fn bodies(file: &SystemFile) -> SystemTable {
    let mut table = SystemTable::new(
        "bodies",
        "Bodies",
        3,
        &[
            ("body", ""),
            ("name", ""),
            ("free in", ""),
            ("x", "in"),
            ("y", "in"),
            ("z", "in"),
            ("mass", "lb·s²/in"),
            ("weight", "lb"),
            ("roll inertia", "lb·in·s²"),
            ("pitch inertia", "lb·in·s²"),
            ("yaw inertia", "lb·in·s²"),
        ],
    );
    for body in &file.bodies {
        let mut row = vec![
            body.id.to_string(),
            body.name.trim().to_owned(),
            names(&body.dofs),
        ];
        row.extend(body.position.iter().map(|value| shown(**value)));
        row.extend([shown(*body.mass), shown(*body.mass * GRAVITY)]);
        row.extend(body.inertia.iter().map(|value| shown(**value)));
        table.rows.push(row);
    }
    table
}

fn input_bodies(file: &SystemFile) -> SystemTable {
    let mut table = SystemTable::new(
        "input_bodies",
        "Input bodies",
        4,
        &[
            ("body", ""),
            ("name", ""),
            ("driven by history", ""),
            ("lag", ""),
            ("x", "in"),
            ("y", "in"),
            ("z", "in"),
        ],
    );
    for body in &file.input_bodies {
        let pairs = body.dofs.iter().zip(&body.histories);
        let driven: Vec<String> = pairs
            .map(|(dof, history)| format!("{} {history}", dof.kind.name()))
            .collect();
        let lag = if *body.lag { "yes" } else { "no" };
        let mut row = vec![
            body.id.to_string(),
            body.name.trim().to_owned(),
            driven.join(", "),
            lag.to_owned(),
        ];
        row.extend(body.position.iter().map(|value| shown(**value)));
        table.rows.push(row);
    }
    table
}

fn connections(file: &SystemFile) -> SystemTable {
    let mut table = SystemTable::new(
        "connections",
        "Connections (body 0 is the ground; forces act on A against the stroke A - B)",
        7,
        &[
            ("connection", ""),
            ("name", ""),
            ("type", ""),
            ("", ""),
            ("A - B", ""),
            ("directions", ""),
            ("characteristics", ""),
            ("x", "in"),
            ("y", "in"),
            ("z", "in"),
        ],
    );
    for connection in &file.connections {
        let element = &connection.element;
        let characteristics: Vec<String> = element
            .characteristics()
            .iter()
            .map(ToString::to_string)
            .collect();
        let mut row = vec![
            connection.id.to_string(),
            connection.name.trim().to_owned(),
            element.code().to_owned(),
            element.name().to_owned(),
            format!("{} - {}", connection.body_a, connection.body_b),
            names(element.dofs()),
            characteristics.join(", "),
        ];
        row.extend(connection.position.iter().map(|value| shown(**value)));
        table.rows.push(row);
    }
    table
}

fn names(dofs: &[Spanned<crate::tree::Dof>]) -> String {
    let name = |dof: &Spanned<crate::tree::Dof>| match dof.mode {
        0 => dof.kind.name().to_owned(),
        mode => format!("{} mode {mode}", dof.kind.name()),
    };
    dofs.iter().map(name).collect::<Vec<_>>().join(", ")
}

/// Returns a number of a function, or a dash for none.
fn function(number: Spanned<u32>) -> String {
    match *number {
        0 => "-".to_owned(),
        number => number.to_string(),
    }
}

fn toe(toe: Spanned<Toe>) -> String {
    match *toe {
        Toe::Out => "out",
        Toe::In => "in",
    }
    .to_owned()
}

fn characteristics(file: &SystemFile) -> Vec<SystemTable> {
    const NUMBER: (&str, &str) = ("characteristic", "");
    const ANGLE: (&str, &str) = ("wedge angle", "deg");
    const KA: (&str, &str) = ("Ka", "lb/in");
    const CA: (&str, &str) = ("Ca", "lb·s/in");
    let mut limits = SystemTable::new(
        "springs",
        "Characteristics of types 1, 1.1, 1.3: springs and dampers",
        3,
        &[
            NUMBER,
            ("stiffness", ""),
            ("damping", ""),
            ("limit in extension", "lb, in·lb"),
            ("in compression", "lb, in·lb"),
        ],
    );
    let mut gaps = SystemTable::new(
        "gaps",
        "Characteristics of type 1.2: no force between two strokes",
        3,
        &[
            NUMBER,
            ("stiffness", ""),
            ("damping", ""),
            ("gap from", "in"),
            ("to", "in"),
        ],
    );
    let mut viscous = SystemTable::new(
        "viscous_wedges",
        "Characteristics of types 6.3 and 6.7: viscous wedges",
        4,
        &[
            NUMBER,
            ("coil", ""),
            ("damping", ""),
            ("toe", ""),
            ANGLE,
            ("coil force", "lb"),
            ("LVB", "lb·s/in"),
            ("Mu1 (slope)", ""),
            ("Mu2 (column)", ""),
        ],
    );
    let mut surfaces = SystemTable::new(
        "surfaces",
        "Characteristics of type 6.5: surface friction",
        3,
        &[NUMBER, ("normal force", ""), ("damping", ""), KA, CA, ("Mu", "")],
    );
    let mut wedges = SystemTable::new(
        "wedges",
        "Characteristics of type 6.8: stick-slip wedges",
        4,
        &[
            NUMBER,
            ("coil", ""),
            ("damping", ""),
            ("toe", ""),
            ANGLE,
            ("coil force", "lb"),
            KA,
            CA,
            ("Mu1 (slope)", ""),
            ("Mu2 (column)", ""),
            ("FWNMAX", "lb"),
        ],
    );
    let mut wedges_3d = SystemTable::new(
        "wedges_3d",
        "Characteristics of type 6.9: stick-slip wedges in three directions",
        5,
        &[
            NUMBER,
            ("coil", ""),
            ("face", ""),
            ("control force", ""),
            ("wedge", ""),
            ANGLE,
            KA,
            CA,
            ("Mu1 (slope)", ""),
            ("Mu2 (column)", ""),
            ("FWNMAX", "lb"),
        ],
    );
    let mut unused = SystemTable::new(
        "unused_characteristics",
        "Characteristics without connection",
        2,
        &[NUMBER, ("values", "")],
    );
    for characteristic in &file.characteristics {
        let numbers = |values: &[Spanned<f64>]| values.iter().map(|value| shown(**value)).collect::<Vec<_>>();
        let row = |words: &[String], values: &[Spanned<f64>]| {
            let mut row = vec![characteristic.id.to_string()];
            row.extend_from_slice(words);
            row.extend(numbers(values));
            row
        };
        match &characteristic.law {
            Law::Limits {
                stiffness,
                damping,
                extension,
                compression,
            } => limits.rows.push(row(
                &[function(*stiffness), function(*damping)],
                &[*extension, *compression],
            )),
            Law::Gap {
                stiffness,
                damping,
                high,
                low,
            } => gaps
                .rows
                .push(row(&[function(*stiffness), function(*damping)], &[*low, *high])),
            Law::ViscousWedge {
                coil,
                damping,
                angle,
                force,
                viscosity,
                friction,
            } => viscous.rows.push(row(
                &[function(*coil), function(*damping), "-".to_owned()],
                &[*angle, *force, *viscosity, *friction, *friction],
            )),
            Law::ViscousToeWedge {
                coil,
                damping,
                angle,
                force,
                viscosity,
                slope_friction,
                column_friction,
                toe: leans,
            } => viscous.rows.push(row(
                &[function(*coil), function(*damping), toe(*leans)],
                &[*angle, *force, *viscosity, *slope_friction, *column_friction],
            )),
            Law::SurfaceFriction {
                normal,
                damping,
                stiffness,
                bristle_damping,
                friction,
            } => surfaces.rows.push(row(
                &[function(*normal), function(*damping)],
                &[*stiffness, *bristle_damping, *friction],
            )),
            Law::StickSlipWedge {
                coil,
                damping,
                angle,
                force,
                stiffness,
                bristle_damping,
                slope_friction,
                column_friction,
                toe: leans,
                normal_limit,
            } => wedges.rows.push(row(
                &[function(*coil), function(*damping), toe(*leans)],
                &[
                    *angle,
                    *force,
                    *stiffness,
                    *bristle_damping,
                    *slope_friction,
                    *column_friction,
                    *normal_limit,
                ],
            )),
            Law::StickSlipWedge3d {
                coil,
                face,
                angle,
                variable,
                stiffness,
                bristle_damping,
                slope_friction,
                column_friction,
                direction,
                normal_limit,
            } => wedges_3d.rows.push(row(
                &[
                    function(*coil),
                    function(*face),
                    if **variable { "variable" } else { "constant" }.to_owned(),
                    if **direction > 0.0 { "leading" } else { "trailing" }.to_owned(),
                ],
                &[
                    *angle,
                    *stiffness,
                    *bristle_damping,
                    *slope_friction,
                    *column_friction,
                    *normal_limit,
                ],
            )),
            Law::Unused { values } => {
                let shown = |value: &Spanned<UnknownValue>| match value.value {
                    UnknownValue::Number(number) => shown(number),
                    UnknownValue::Logical(truth) => if truth { ".T." } else { ".F." }.to_owned(),
                };
                let values: Vec<String> = values.iter().map(shown).collect();
                unused.rows.push(row(&[values.join(" ")], &[]));
            }
        }
    }
    vec![limits, gaps, viscous, surfaces, wedges, wedges_3d, unused]
}

/// Returns the units of the values of each function, by the elements that use it.
fn units(file: &SystemFile) -> BTreeMap<u32, BTreeSet<&'static str>> {
    let mut rotational: BTreeMap<u32, BTreeSet<bool>> = BTreeMap::new();
    for connection in &file.connections {
        let element = &connection.element;
        let several = element.characteristics().len() > 1;
        for (index, dof) in element.dofs().iter().enumerate() {
            let index = if several { index } else { 0 };
            if let Some(characteristic) = element.characteristics().get(index) {
                rotational
                    .entry(**characteristic)
                    .or_default()
                    .insert(!dof.kind.is_translation());
            }
        }
    }
    let mut units: BTreeMap<u32, BTreeSet<&'static str>> = BTreeMap::new();
    let mut add = |function: Spanned<u32>, unit: &'static str| {
        if *function != 0 {
            units.entry(*function).or_default().insert(unit);
        }
    };
    for characteristic in &file.characteristics {
        let turns = rotational.get(&*characteristic.id).cloned().unwrap_or_default();
        for turns in turns {
            let (force, damping) = if turns {
                ("in·lb over rad", "in·lb over rad/s")
            } else {
                ("lb over in", "lb over in/s")
            };
            match &characteristic.law {
                Law::Limits {
                    stiffness,
                    damping: damper,
                    ..
                }
                | Law::Gap {
                    stiffness,
                    damping: damper,
                    ..
                } => {
                    add(*stiffness, force);
                    add(*damper, damping);
                }
                Law::ViscousWedge {
                    coil,
                    damping: damper,
                    ..
                }
                | Law::ViscousToeWedge {
                    coil,
                    damping: damper,
                    ..
                }
                | Law::StickSlipWedge {
                    coil,
                    damping: damper,
                    ..
                }
                | Law::SurfaceFriction {
                    normal: coil,
                    damping: damper,
                    ..
                } => {
                    add(*coil, "lb over in");
                    add(*damper, "lb over in/s");
                }
                Law::StickSlipWedge3d { coil, face, .. } => {
                    add(*coil, "lb over in");
                    add(*face, "in over in");
                }
                Law::Unused { .. } => {}
            }
        }
    }
    units
}

fn functions(file: &SystemFile) -> SystemTable {
    let mut table = SystemTable::new(
        "functions",
        "Functions (linear between the points and on beyond them)",
        3,
        &[
            ("function", ""),
            ("", ""),
            ("units", ""),
            ("abscissa", ""),
            ("ordinate", ""),
            ("slope to the next", ""),
        ],
    );
    let units = units(file);
    for function in &file.piecewise_linear {
        let unit = units
            .get(&*function.id)
            .map(|units| units.iter().copied().collect::<Vec<_>>().join("; "));
        let points: Vec<(f64, f64)> = function.points().collect();
        for (index, (abscissa, ordinate)) in points.iter().enumerate() {
            let first = index == 0;
            let only_first = |text: String| if first { text } else { String::new() };
            let slope = points
                .get(index + 1)
                .map(|(next, high)| (high - ordinate) / (next - abscissa));
            table.rows.push(vec![
                only_first(function.id.to_string()),
                only_first(if function.is_mirrored() { "mirrored" } else { "" }.to_owned()),
                only_first(unit.clone().unwrap_or_default()),
                shown(*abscissa),
                shown(*ordinate),
                slope
                    .filter(|slope| slope.is_finite())
                    .map(shown)
                    .unwrap_or_default(),
            ]);
        }
    }
    table
}
