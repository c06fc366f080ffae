//! The values of a face's section: grids, surfaces, maps of friction, pads.

use super::field::Written;
use super::friction::COEFFICIENT;
use super::problem::{Problem, Problems};
use super::section::{self, CaseSection, Names, Range, name_of};
use super::table::QuantityTable;
use super::table::{self, TableForm};
use super::tables::Tables;
use super::tree::{NodeValue, TableNode, TreeNode};
use super::units::in_system;
use crate::reader::in_customary_units;
use mechanics::spline::{Spline, SplineError};
use mechanics::surface::SurfaceProfile;
use quantity::{Kind, Quantity, System};
use wedge::face::{FaceDirection, FaceProfile, FrictionMap, Grid, LARGEST_GRID, Pad};

/// A surface as typed.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum Surface {
    /// Flat.
    #[default]
    Flat,
    /// An arc.
    Arc {
        /// True if it is hollow, not crowned.
        hollow: bool,
        /// Its radius.
        radius: Quantity,
        /// Its direction.
        direction: FaceDirection,
        /// The depth to which a crown is worn flat.
        worn_flat: Option<Quantity>,
    },
    /// Depths over places.
    Table {
        /// The table.
        table: QuantityTable,
        /// Its direction.
        direction: FaceDirection,
    },
}

/// A pad as typed.
#[derive(Clone, Debug, PartialEq)]
pub struct PadSection {
    /// Normal stiffness of the whole pad.
    pub stiffness: Quantity,
    /// Normal damping of the whole pad.
    pub damping: Quantity,
    /// Compression at which its force is twice that of a linear spring.
    pub hardening: Option<Quantity>,
    /// Coefficient of friction.
    pub friction: f64,
    /// Shear stiffness and damping of the whole pad.
    pub shear: Option<[Quantity; 2]>,
}

const DIRECTIONS: Names<FaceDirection> = &[("up", FaceDirection::Up), ("across", FaceDirection::Across)];
const SHAPES: Names<Shape> = &[
    ("flat", Shape::Flat),
    ("crown", Shape::Crown),
    ("hollow", Shape::Hollow),
    ("table", Shape::Table),
];

/// The key of the depth to which a crown is worn flat.
const WORN_FLAT: &str = "worn_flat";

/// Shapes of a surface.
#[derive(Clone, Copy, PartialEq)]
enum Shape {
    Flat,
    Crown,
    Hollow,
    Table,
}

/// Returns the table that stands in a node, as a section of its own.
fn section_of<'n>(node: &'n TreeNode, path: &str, table: &'n TableNode) -> CaseSection<'n> {
    CaseSection {
        path: path.to_owned(),
        table,
        place: Some(node.place.clone()),
    }
}

impl Surface {
    /// Returns a crown of a radius, m.
    pub(crate) fn crown(radius: f64, direction: FaceDirection) -> Self {
        match in_customary_units(radius, Kind::Length) {
            Some(radius) => Self::Arc {
                hollow: false,
                radius,
                direction,
                worn_flat: None,
            },
            None => Self::Flat,
        }
    }

    pub(super) fn read(
        node: &TreeNode,
        path: &str,
        tables: Tables<'_>,
        problems: &mut Problems,
    ) -> Option<Self> {
        // A counterface has a smooth surface; the wedge's is where its points are.
        let of_wedge = path.ends_with("wedge_surface");
        let NodeValue::Table(own) = &node.value else {
            const FLAT: Names<()> = &[("flat", ())];
            if matches!(&node.value, NodeValue::Text(text) if text == "flat") {
                return Some(Self::Flat);
            }
            section::choice(node, path, FLAT, problems);
            return None;
        };
        let s = section_of(node, path, own);
        let shape = s.choice("shape", SHAPES, problems)?;
        let keys: &[&str] = match shape {
            Shape::Flat => &["shape"],
            Shape::Crown if of_wedge => &["shape", "radius", "direction", WORN_FLAT],
            Shape::Crown | Shape::Hollow => &["shape", "radius", "direction"],
            Shape::Table => &["shape", "direction", "file", "points"],
        };
        s.allow(keys, &[], problems);
        if shape == Shape::Flat {
            return Some(Self::Flat);
        }
        let direction = s.choice("direction", DIRECTIONS, problems);
        if shape == Shape::Table {
            let table = table::read_either(&s, "file", "points", &TableForm::profile(), tables, problems)?;
            return Some(Self::Table {
                table,
                direction: direction?,
            });
        }
        let radius = s.quantity("radius", Kind::Length, Range::Positive, problems)?;
        let worn_flat = match s.table.get(WORN_FLAT) {
            Some(_) => Some(s.quantity(WORN_FLAT, Kind::Length, Range::NotNegative, problems)?),
            None => None,
        };
        Some(Self::Arc {
            hollow: shape == Shape::Hollow,
            radius,
            direction: direction?,
            worn_flat,
        })
    }

    fn to_toml(&self, system: Option<System>) -> String {
        let kinds = [Kind::Length; 2];
        match self {
            Self::Flat => "\"flat\"".to_owned(),
            Self::Arc {
                hollow,
                radius,
                direction,
                worn_flat,
            } => {
                let shape = name_of(SHAPES, if *hollow { &Shape::Hollow } else { &Shape::Crown });
                let direction = name_of(DIRECTIONS, direction);
                let radius = text(radius, Kind::Length, system);
                let worn = worn_flat.as_ref().map_or(String::new(), |own| {
                    format!(", {WORN_FLAT} = {}", text(own, Kind::Length, system))
                });
                format!("{{ shape = \"{shape}\", radius = {radius}, direction = \"{direction}\"{worn} }}")
            }
            Self::Table { table, direction } => {
                let direction = name_of(DIRECTIONS, direction);
                let own = match (&table.file, system) {
                    (Some(file), _) => format!("file = {}", super::field::quoted(file)),
                    (None, None) => format!("points = {}", table.points_to_toml()),
                    (None, Some(system)) => {
                        format!("points = {}", table.in_system(kinds, system).points_to_toml())
                    }
                };
                format!("{{ shape = \"table\", direction = \"{direction}\", {own} }}")
            }
        }
    }

    pub(super) fn written(&self) -> Written {
        Written::toml_in_units(|system| self.to_toml(system))
    }

    pub(super) fn resolve(&self) -> Result<FaceProfile, SplineError> {
        Ok(match self {
            Self::Flat => FaceProfile::default(),
            Self::Arc {
                hollow,
                radius,
                direction,
                worn_flat,
            } => {
                let sign = if *hollow { -1.0 } else { 1.0 };
                FaceProfile {
                    profile: SurfaceProfile::Arc {
                        curvature: sign / radius.to_si(),
                    },
                    direction: *direction,
                    worn_flat: worn_flat.as_ref().map_or(0.0, Quantity::to_si),
                }
            }
            Self::Table { table, direction } => {
                let (places, depths) = table.rows.iter().map(|[a, b]| (a.to_si(), b.to_si())).unzip();
                FaceProfile {
                    profile: SurfaceProfile::Table(Spline::new(places, depths)?),
                    direction: *direction,
                    worn_flat: 0.0,
                }
            }
        })
    }

    /// Returns its table, if it has one.
    pub(super) fn table_mut(&mut self) -> Option<&mut QuantityTable> {
        match self {
            Self::Table { table, .. } => Some(table),
            _ => None,
        }
    }

    /// Returns the rows of its table.
    pub(super) fn rows(&self) -> usize {
        match self {
            Self::Table { table, .. } => table.rows.len(),
            _ => 0,
        }
    }
}

impl PadSection {
    pub(super) const EXAMPLE: &str = "{ stiffness = \"2e5 lbf/in\", damping = \"100 lbf s/in\", hardening \
                                      = \"0.1 in\", friction = 0.5, shear_stiffness = \"1e5 lbf/in\", \
                                      shear_damping = \"100 lbf s/in\" }";

    pub(super) fn read(node: &TreeNode, path: &str, problems: &mut Problems) -> Option<Self> {
        let NodeValue::Table(own) = &node.value else {
            let message = format!("`{path}` is {}; a table is expected", node.value.describe());
            let help = format!("write for example pad = {}", Self::EXAMPLE);
            problems.push(Problem::new(message).at(&node.place).label("a pad").help(help));
            return None;
        };
        let s = section_of(node, path, own);
        let keys = [
            "stiffness",
            "damping",
            "hardening",
            "friction",
            "shear_stiffness",
            "shear_damping",
        ];
        s.allow(&keys, &[], problems);
        let stiffness = s.quantity("stiffness", Kind::Stiffness, Range::Positive, problems);
        let damping = s.quantity("damping", Kind::Damping, Range::NotNegative, problems);
        let friction = s.number("friction", COEFFICIENT, "0.5", problems);
        let mut given = |key: &str, kind: Kind| match s.table.get(key) {
            Some(_) => s.quantity(key, kind, Range::Positive, problems).map(Some),
            None => Some(None),
        };
        let hardening = given("hardening", Kind::Length);
        let shear = [
            given("shear_stiffness", Kind::Stiffness),
            given("shear_damping", Kind::Damping),
        ];
        let [stiff, damped] = shear;
        let shear = match (stiff?, damped?) {
            (Some(stiffness), Some(damping)) => Some([stiffness, damping]),
            (None, None) => None,
            (one, _) => {
                let (has, lacks) = match one {
                    Some(_) => ("shear_stiffness", "shear_damping"),
                    None => ("shear_damping", "shear_stiffness"),
                };
                let message = format!("`{path}` has {has} but no {lacks}");
                let help = "write both, and friction is by bristles of this stiffness; or none, and it is \
                            by friction.law";
                problems.push(
                    Problem::new(message)
                        .at(&node.place)
                        .label("one of two")
                        .help(help),
                );
                return None;
            }
        };
        Some(Self {
            stiffness: stiffness?,
            damping: damping?,
            hardening: hardening?,
            friction: friction?,
            shear,
        })
    }

    pub(super) fn written(&self) -> Written {
        Written::toml_in_units(|system| {
            let mut parts = vec![
                format!("stiffness = {}", text(&self.stiffness, Kind::Stiffness, system)),
                format!("damping = {}", text(&self.damping, Kind::Damping, system)),
            ];
            if let Some(hardening) = &self.hardening {
                parts.push(format!("hardening = {}", text(hardening, Kind::Length, system)));
            }
            parts.push(format!("friction = {:?}", self.friction));
            if let Some([stiffness, damping]) = &self.shear {
                parts.push(format!(
                    "shear_stiffness = {}",
                    text(stiffness, Kind::Stiffness, system)
                ));
                parts.push(format!(
                    "shear_damping = {}",
                    text(damping, Kind::Damping, system)
                ));
            }
            format!("{{ {} }}", parts.join(", "))
        })
    }

    pub(super) fn resolve(&self) -> Pad {
        Pad {
            stiffness: self.stiffness.to_si(),
            damping: self.damping.to_si(),
            hardening: self.hardening.as_ref().map(Quantity::to_si),
            friction: self.friction,
            shear: self
                .shear
                .as_ref()
                .map(|shear| shear.each_ref().map(Quantity::to_si)),
        }
    }
}

/// Returns a quantity as TOML, in the units of a system or as typed.
fn text(quantity: &Quantity, kind: Kind, system: Option<System>) -> String {
    match system {
        Some(system) => super::field::quoted(in_system(quantity, kind, system).text()),
        None => super::field::quoted(quantity.text()),
    }
}

pub(super) fn grid(node: &TreeNode, path: &str, problems: &mut Problems) -> Option<Grid> {
    let count = |node: &TreeNode| match node.value {
        NodeValue::Number(value) if value.fract() == 0.0 && (2.0..=LARGEST_GRID as f64).contains(&value) => {
            Some(value as usize)
        }
        _ => None,
    };
    if let NodeValue::List(items) = &node.value
        && let [up, across] = items.as_slice()
        && let (Some(up), Some(across)) = (count(up), count(across))
    {
        return Some(Grid { up, across });
    }
    let found = match &node.value {
        NodeValue::List(_) => node.place.text().to_owned(),
        other => other.describe().to_owned(),
    };
    let message = format!("`{path}` is {found}; two whole numbers from 2 to {LARGEST_GRID} are expected");
    problems.push(
        Problem::new(message)
            .at(&node.place)
            .label("points up the face and across it")
            .help("write for example grid = [5, 5]"),
    );
    None
}

/// Returns a map of friction: rows of factors.
pub(super) fn map(node: &TreeNode, path: &str, problems: &mut Problems) -> Option<FrictionMap> {
    let row = |node: &TreeNode| -> Option<Vec<f64>> {
        let NodeValue::List(items) = &node.value else {
            return None;
        };
        let factor = |item: &TreeNode| match item.value {
            NodeValue::Number(value) if (0.0..=10.0).contains(&value) => Some(value),
            _ => None,
        };
        items.iter().map(factor).collect()
    };
    if let NodeValue::List(rows) = &node.value {
        let rows: Option<Vec<Vec<f64>>> = rows.iter().map(row).collect();
        if let Some(rows) = rows {
            let width = rows.first().map_or(0, Vec::len);
            let small = rows.len() <= LARGEST_GRID && width <= LARGEST_GRID;
            if small && rows.iter().all(|row| row.len() == width && width > 0) {
                return Some(rows);
            }
        }
    }
    let message = format!("`{path}` is no map: rows of equally many factors from 0 to 10 are expected");
    problems.push(
        Problem::new(message)
            .at(&node.place)
            .label("factors of the coefficients of friction")
            .help(
                "write for example friction_map = [[1.0, 1.0], [0.5, 0.5]]: half of the friction at the \
                   upper edge",
            ),
    );
    None
}

/// Returns a map as it is written, if there is one.
pub(super) fn map_written(map: &FrictionMap) -> Option<Written> {
    let row = |row: &Vec<f64>| {
        let factors: Vec<String> = row.iter().map(|factor| format!("{factor:?}")).collect();
        format!("[{}]", factors.join(", "))
    };
    let rows: Vec<String> = map.iter().map(row).collect();
    (!map.is_empty()).then(|| Written::toml(format!("[{}]", rows.join(", "))))
}

/// Returns a map of depths as it is written.
pub(super) fn depths_written(table: &QuantityTable<3>) -> Written {
    let table = table.clone();
    Written::toml_in_units(|system| match (&table.file, system) {
        (Some(file), _) => super::field::quoted(file),
        (None, None) => table.points_to_toml(),
        (None, Some(system)) => table.in_system([Kind::Length; 3], system).points_to_toml(),
    })
}
