//! From the tree of a case to the document: every section, key by key.

use super::bounds;
use super::document::*;
use super::duration::{check_cover, check_rows};
use super::face::{self, FaceSection};
use super::motion;
use super::problem::{Problem, Problems, TomlLocation};
use super::rise::RiseSection;
use super::section::{self, CaseSection, Range};
use super::table::{self, TableForm};
use super::tables::Tables;
use super::toe::{read_toe, read_toe_pivot};
use super::tree::{NodeValue, TableNode, TreeNode};
use super::{defaults, name};
use input::limits;
use mechanics::contact::FrictionDirections;
use quantity::{Kind, Quantity, System};
use wedge::parameters::Wear;

use crate::geometry;

/// The keys of every table.
const KEYS: &[(&str, &[&str])] = &[
    (
        "wedge",
        &[
            "damping",
            "angle",
            "height",
            "width",
            "weight",
            "inertia",
            "center_of_gravity",
            "column_wear",
            "slope_wear",
            RiseSection::KEYS[0],
            RiseSection::KEYS[1],
            "free_coordinates",
        ],
    ),
    (
        "control_coil",
        &[
            "stiffness",
            "table",
            "free_length",
            "nominal_length",
            "damping",
            "rotational_damping",
            "acts_at",
            "pulls",
        ],
    ),
    ("contact", &["stiffness", "damping"]),
    (
        "friction",
        &[
            "law",
            "column",
            "slope",
            "directions",
            "reference_speed",
            "bristle_stiffness",
            "bristle_damping",
        ],
    ),
    (face::SECTIONS[0], FaceSection::KEYS),
    (face::SECTIONS[1], FaceSection::KEYS),
    (
        "side_frame",
        &[
            "toe",
            "toe_pivot",
            "center",
            "longitudinal",
            "lateral",
            "vertical",
            "roll",
            "pitch",
            "yaw",
        ],
    ),
    (
        "bolster",
        &[
            "center",
            "longitudinal",
            "lateral",
            "vertical",
            "roll",
            "pitch",
            "yaw",
        ],
    ),
    ("environment", &["gravity"]),
    (
        "simulation",
        &[
            "duration",
            "output_interval",
            "relative_tolerance",
            "start",
            "output_units",
            "method",
        ],
    ),
];

/// Wedge angles that make sense, rad.
const RIGHT_ANGLE: f64 = std::f64::consts::FRAC_PI_2;
pub(crate) const ANGLE: Range = Range::Between(0.0, RIGHT_ANGLE, "between 0 deg and 90 deg, both excluded");
pub(crate) const COEFFICIENT: Range = Range::UpTo(bounds::FRICTION, "between 0 and 10");
/// Numbers have sixteen digits; a narrower tolerance is never met.
pub(crate) const TOLERANCE: Range = Range::Between(1e-15, 1.0, "between 1e-15 and 1, both excluded");

/// Keys that only trucks and cars have, of the tables that a single wedge has too, and why.
const OF_TRUCKS: [(&str, &str, &str); 2] = [
    (
        "wedge",
        "kind",
        "a single wedge is always one rigid body; `wedgelab quasi-static` tells of a massless one",
    ),
    (
        "wedge",
        "slope_across",
        "a slope across pushes the wedge against a side of its pocket, and a single wedge has none",
    ),
];

/// Completes the tree and reads it; notes what is wrong.
pub(super) fn document(
    tree: &mut TableNode,
    default_name: &str,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<CaseDocument> {
    complete(tree, problems);
    let top = CaseSection {
        path: String::new(),
        table: tree,
        place: None,
    };
    let sections: Vec<&str> = KEYS.iter().map(|(section, _)| *section).collect();
    let mut known: Vec<&str> = ["name", "title", "model"]
        .into_iter()
        .chain(sections.iter().copied())
        .collect();
    if let Some(entry) = tree.entry("split") {
        let problem = Problem::new("`split` is a table of trucks and cars: a single wedge is one rigid body");
        let help = "leave it out, or write model = \"truck\" in the first line";
        problems.push(problem.at(&entry.key_place).label("of another model").help(help));
        known.push("split");
    }
    top.allow(&known, KEYS, problems);
    for (section, keys) in KEYS {
        if let Some(section) = tree.table(section).map(|table| CaseSection {
            path: (*section).into(),
            table,
            place: None,
        }) {
            let others = OF_TRUCKS.iter().filter(|(table, ..)| *table == section.path);
            let mut keys = keys.to_vec();
            for (table, key, why) in others {
                keys.push(key);
                if let Some(entry) = section.table.entry(key) {
                    let problem = Problem::new(format!("`{table}.{key}` is a key of trucks and cars: {why}"));
                    let help = "leave it out, or write model = \"truck\" in the first line";
                    problems.push(problem.at(&entry.key_place).label("of another model").help(help));
                }
            }
            section.allow(&keys, KEYS, problems);
        }
    }
    let name = name::read(&top, default_name, problems);
    let title = top.text("title", problems).map(|(text, _)| text.to_string());
    let mut section = |key: &str| top.section(key, problems);
    let (wedge, coil, contact) = (section("wedge"), section("control_coil"), section("contact"));
    let (friction, side_frame) = (section("friction"), section("side_frame"));
    let faces = face::SECTIONS.map(&mut section);
    let (bolster, environment) = (section("bolster"), section("environment"));
    let simulation = section("simulation");

    let wedge = wedge.and_then(|s| read_wedge(&s, problems));
    let control_coil = coil.and_then(|s| read_coil(&s, tables, problems));
    let contact = contact.and_then(|s| {
        let stiffness = s.quantity("stiffness", Kind::Stiffness, Range::Positive, problems);
        let damping = s.quantity("damping", Kind::Damping, Range::NotNegative, problems);
        Some(ContactSection {
            stiffness: stiffness?,
            damping: damping?,
        })
    });
    let friction = friction.and_then(|s| read_friction(&s, problems));
    let [column_face, slope_face] = faces.map(|s| FaceSection::default().read_over(&s?, tables, problems));
    let toe = side_frame.as_ref().and_then(|s| read_toe(s, problems));
    let toe_pivot = side_frame.as_ref().and_then(|s| read_toe_pivot(s, problems));
    let side_frame = side_frame.and_then(|s| read_neighbour(&s, tables, problems));
    let bolster = bolster.and_then(|s| read_neighbour(&s, tables, problems));
    let environment = environment.and_then(|s| {
        Some(EnvironmentSection {
            gravity: s.quantity("gravity", Kind::Acceleration, Range::NotNegative, problems)?,
        })
    });
    let simulation = simulation.and_then(|s| read_simulation(&s, problems));
    if let Some(simulation) = &simulation {
        for (key, neighbour) in [("side_frame", &side_frame), ("bolster", &bolster)] {
            if let Some(neighbour) = neighbour {
                check_cover(key, neighbour, &simulation.duration, tree, tables, problems);
            }
        }
    }
    let document = CaseDocument {
        name: name?,
        title: title?,
        wedge: wedge?,
        control_coil: control_coil?,
        contact: contact?,
        friction: friction?,
        faces: [column_face?, slope_face?],
        toe: toe?,
        toe_pivot: toe_pivot?,
        side_frame: side_frame?,
        bolster: bolster?,
        environment: environment?,
        simulation: simulation?,
    };
    let rows = document.table_rows();
    if rows > limits::CASE_ROWS {
        let message = format!(
            "the tables of the case have {rows} rows together; at most {} are read",
            limits::CASE_ROWS
        );
        problems.push(Problem::new(message).help("leave out rows: motions are smooth between them"));
    }
    Some(document)
}

/// Takes over what is left out from the thesis's values of the damping.
fn complete(tree: &mut TableNode, problems: &mut Problems) {
    let damping = tree.table("wedge").and_then(|wedge| wedge.text("damping"));
    let damping = Damping::NAMES.iter().find(|(name, _)| Some(*name) == damping);
    // A damping that is wrong is noted when it is read.
    let damping = damping.map_or(Damping::Variable, |(_, damping)| *damping);
    match defaults::tree(damping) {
        Ok(defaults) => tree.complete_from(&defaults),
        Err(broken) => problems.append(broken),
    }
}

fn read_wedge(s: &CaseSection<'_>, problems: &mut Problems) -> Option<WedgeSection> {
    let damping = s.choice("damping", Damping::NAMES, problems);
    let angle = s.quantity("angle", Kind::Angle, ANGLE, problems);
    let height = s.quantity("height", Kind::Length, Range::Positive, problems);
    let width = s.quantity("width", Kind::Length, Range::Positive, problems);
    let weight = s.quantity("weight", Kind::Force, Range::Positive, problems);
    let inertia = s.triple("inertia", Kind::Inertia, Range::Positive, problems);
    let center_of_gravity = s.triple("center_of_gravity", Kind::Length, Range::Any, problems);
    let column_wear = s.quantity("column_wear", Kind::Length, Range::NotNegative, problems);
    let slope_wear = s.quantity("slope_wear", Kind::Length, Range::NotNegative, problems);
    let (column_wear, slope_wear) = (column_wear?, slope_wear?);
    let rise = RiseSection::of_wedge(s, [&column_wear, &slope_wear], problems);
    if let (Some(angle), Some(height), Some(rise)) = (&angle, &height, &rise) {
        let depths = Wear {
            column: column_wear.to_si(),
            slope: slope_wear.to_si(),
        };
        let wear = rise.wear([angle.to_si(), 0.0, 0.0]).unwrap_or(depths);
        if let Some(reason) = geometry::worn_away(height.to_si(), angle.to_si(), &wear) {
            let keys = ["rise", "column_wear", "slope_wear", "height"];
            let mut problem = Problem::new(reason).label("beyond the wedge");
            if let Some(node) = keys.into_iter().find_map(|key| s.table.get(key)) {
                problem = problem.at(&node.place);
            }
            problems.push(problem.help("look at the unit: wear is a fraction of an inch"));
        }
    }
    let free_coordinates = read_free_coordinates(s, problems);
    Some(WedgeSection {
        damping: damping?,
        angle: angle?,
        height: height?,
        width: width?,
        weight: weight?,
        inertia: inertia?,
        center_of_gravity: center_of_gravity?,
        column_wear,
        slope_wear,
        rise: rise?,
        free_coordinates: free_coordinates?,
    })
}

fn read_free_coordinates(s: &CaseSection<'_>, problems: &mut Problems) -> Option<Vec<Coordinate>> {
    let help = "list the free ones of \"x\", \"y\", \"z\", \"roll\", \"pitch\", \"yaw\", for example \
                free_coordinates = [\"x\", \"z\", \"pitch\", \"yaw\"]";
    let node = s.require("free_coordinates", help, problems)?;
    let path = s.path_of("free_coordinates");
    let mut bad = |message: String, place: &TomlLocation, label: &str| {
        problems.push(Problem::new(message).at(place).label(label).help(help));
        None
    };
    let NodeValue::List(items) = &node.value else {
        return bad(
            format!("`{path}` is {}; a list is expected", node.value.describe()),
            &node.place,
            "not a list",
        );
    };
    if items.is_empty() {
        return bad(
            format!("`{path}` is empty: the wedge could not move"),
            &node.place,
            "nothing is free",
        );
    }
    let mut coordinates = Vec::new();
    for item in items {
        let coordinate = section::choice(item, &path, Coordinate::NAMES, problems)?;
        if coordinates.contains(&coordinate) {
            let message = format!("`{path}` names \"{}\" twice", coordinate.name());
            problems.push(
                Problem::new(message)
                    .at(&item.place)
                    .label("named before")
                    .help("name it once"),
            );
            return None;
        }
        coordinates.push(coordinate);
    }
    Some(coordinates)
}

fn read_coil(s: &CaseSection<'_>, tables: Tables<'_>, problems: &mut Problems) -> Option<CoilSection> {
    let force = match (s.table.entry("stiffness"), s.table.entry("table")) {
        (Some(_), Some(table)) => {
            let problem =
                Problem::new("`control_coil` has both `stiffness` and `table`").at(&table.key_place);
            problems.push(
                problem
                    .label("one of them is expected")
                    .help("leave one of them out"),
            );
            None
        }
        (_, Some(table)) => table::read(
            &table.node,
            &s.path_of("table"),
            &TableForm::coil(),
            tables,
            problems,
        )
        .map(CoilForce::Table),
        _ => s
            .quantity("stiffness", Kind::Stiffness, Range::Positive, problems)
            .map(CoilForce::Stiffness),
    };
    let free_length = s.quantity("free_length", Kind::Length, Range::Positive, problems);
    let nominal_length = s.quantity("nominal_length", Kind::Length, Range::Positive, problems);
    let damping = s.quantity("damping", Kind::Damping, Range::NotNegative, problems);
    let rotational_damping = match s.table.get("rotational_damping") {
        Some(_) => s.quantity(
            "rotational_damping",
            Kind::RotationalDamping,
            Range::NotNegative,
            problems,
        ),
        None => damping.as_ref().and_then(rotational_damping),
    };
    let acts_at = s.choice("acts_at", ActsAt::NAMES, problems);
    let pulls = s.truth("pulls", problems);
    Some(CoilSection {
        force: force?,
        free_length: free_length?,
        nominal_length: nominal_length?,
        damping: damping?,
        rotational_damping: rotational_damping?,
        acts_at: acts_at?,
        pulls: pulls?,
    })
}

/// The thesis writes the same C in its moment equations (3-13, 3-18): numerically the damping in
/// lbf s/in, as lbf s in.
fn rotational_damping(damping: &Quantity) -> Option<Quantity> {
    let number = if damping.unit_text() == Kind::Damping.unit(System::Us) {
        damping.value()
    } else {
        damping.to_si() * Kind::Damping.from_si(System::Us)
    };
    Quantity::new(number, Kind::RotationalDamping.unit(System::Us)).ok()
}

fn read_friction(s: &CaseSection<'_>, problems: &mut Problems) -> Option<FrictionSection> {
    let laws = read_laws(s, problems);
    let column = s.number("column", COEFFICIENT, "0.4", problems);
    let slope = s.number("slope", COEFFICIENT, "0.4", problems);
    let directions = match s.table.get("directions") {
        Some(_) => s.choice("directions", DIRECTIONS, problems),
        None => Some(FrictionDirections::Two),
    };
    let reference_speed = s.quantity("reference_speed", Kind::Speed, Range::Positive, problems);
    let bristle_stiffness = s.quantity("bristle_stiffness", Kind::Stiffness, Range::Positive, problems);
    let bristle_damping = s.quantity("bristle_damping", Kind::Damping, Range::Positive, problems);
    let [column_law, slope_law] = laws?;
    Some(FrictionSection {
        column_law,
        slope_law,
        column: column?,
        slope: slope?,
        directions: directions?,
        reference_speed: reference_speed?,
        bristle_stiffness: bristle_stiffness?,
        bristle_damping: bristle_damping?,
    })
}

/// Reads the laws of friction at column and slope.
pub(crate) fn read_laws(s: &CaseSection<'_>, problems: &mut Problems) -> Option<[FrictionLaw; 2]> {
    match &s.table.get("law")?.value {
        NodeValue::Table(table) => {
            let place = s.table.entry("law").map(|entry| entry.key_place.clone());
            let faces = CaseSection {
                path: s.path_of("law"),
                table,
                place,
            };
            faces.allow(&["column", "slope"], &[], problems);
            let column = faces.choice("column", FrictionLaw::NAMES, problems);
            let slope = faces.choice("slope", FrictionLaw::NAMES, problems);
            Some([column?, slope?])
        }
        _ => s.choice("law", FrictionLaw::NAMES, problems).map(|law| [law; 2]),
    }
}

fn read_neighbour(
    s: &CaseSection<'_>,
    tables: Tables<'_>,
    problems: &mut Problems,
) -> Option<NeighbourSection> {
    let center = match s.table.get("center") {
        Some(_) => Some(s.triple("center", Kind::Length, Range::Any, problems)?),
        None => None,
    };
    let mut motions = Vec::with_capacity(6);
    for (at, key) in NeighbourSection::COORDINATES.into_iter().enumerate() {
        let kind = if at < 3 { Kind::Length } else { Kind::Angle };
        let node: Option<&TreeNode> = s.require(key, "write a motion", problems);
        motions.push(node.and_then(|node| motion::read(node, &s.path_of(key), kind, tables, problems)));
    }
    let motions: Vec<_> = motions.into_iter().collect::<Option<_>>()?;
    Some(NeighbourSection {
        center,
        coordinates: motions.try_into().ok()?,
    })
}

fn read_simulation(s: &CaseSection<'_>, problems: &mut Problems) -> Option<SimulationSection> {
    let duration = s.quantity("duration", Kind::Time, Range::Positive, problems);
    let output_interval = s.quantity("output_interval", Kind::Time, Range::Positive, problems);
    let relative_tolerance = s.number("relative_tolerance", TOLERANCE, "1e-6", problems);
    let start = s.choice("start", Start::NAMES, problems);
    let output_units = s.choice("output_units", SYSTEMS, problems);
    let method = s.choice("method", METHODS, problems);
    if let (Some(duration), Some(interval)) = (&duration, &output_interval) {
        check_rows(s, duration, interval, problems);
    }
    Some(SimulationSection {
        duration: duration?,
        output_interval: output_interval?,
        relative_tolerance: relative_tolerance?,
        start: start?,
        output_units: output_units?,
        method: method?,
    })
}
