//! The sections of the trucks: `[truck]` for both, `[front_truck]` and `[rear_truck]` over it.
//!
//! The keys are those of a truck's case, in tables of the truck: `[truck.wedge]`, `[front_truck.friction]`.
//! Where both trucks have the same values the complete case has `[truck]` alone, else both in full.

use truck::coils::CoilKind;
use truck::{CarBody, Lading, Parameters, SideBearings};

use crate::case::problem::{Problem, Problems};
use crate::case::tree::{NodeValue, TableEntry, TableNode, TreeNode};
use crate::reader::CaseReader;
use crate::truck::sections;
use crate::truck::wedges;

const BOTH: &str = "truck";
const EACH: [&str; 2] = ["front_truck", "rear_truck"];

/// Lays `[truck]` below `[front_truck]` and `[rear_truck]` where one of them is given: then both stand for
/// themselves. Notes values for both trucks that each truck has its own of.
pub(super) fn complete(tree: &mut TableNode, problems: &mut Problems) {
    if EACH.iter().all(|name| tree.table(name).is_none()) {
        return;
    }
    let own: Vec<Option<TableNode>> = EACH.iter().map(|name| tree.table(name).cloned()).collect();
    let shared = match tree.entry(BOTH).map(|entry| &entry.node.value) {
        Some(NodeValue::Table(shared)) => shared.clone(),
        // The reader reports what is no table.
        Some(_) => return,
        None => TableNode::default(),
    };
    if let [Some(front), Some(rear)] = own.as_slice() {
        unused(&shared, BOTH, [front, rear], problems);
    }
    let model = tree.entry(EACH[0]).or(tree.entry(EACH[1])).cloned();
    for name in EACH {
        match tree.entries.iter_mut().find(|entry| entry.key == name) {
            Some(TableEntry {
                node:
                    TreeNode {
                        value: NodeValue::Table(own),
                        ..
                    },
                ..
            }) => own.complete_from(&shared),
            Some(_) => {}
            None => {
                if let Some(mut entry) = model.clone() {
                    name.clone_into(&mut entry.key);
                    entry.node.value = NodeValue::Table(shared.clone());
                    tree.entries.push(entry);
                }
            }
        }
    }
    tree.entries.retain(|entry| entry.key != BOTH);
}

/// Notes the values of a table that both others have too.
fn unused(shared: &TableNode, path: &str, [front, rear]: [&TableNode; 2], problems: &mut Problems) {
    for entry in &shared.entries {
        let (Some(front), Some(rear)) = (front.get(&entry.key), rear.get(&entry.key)) else {
            continue;
        };
        let path = format!("{path}.{}", entry.key);
        match (&entry.node.value, &front.value, &rear.value) {
            (NodeValue::Table(shared), NodeValue::Table(front), NodeValue::Table(rear)) => {
                unused(shared, &path, [front, rear], problems);
            }
            _ => {
                let problem = Problem::new(format!("`{path}` has no effect: both trucks have their own"));
                let problem = problem.at(&entry.node.place).label("not used");
                let help = format!(
                    "set {0}.{2} and {1}.{2}",
                    EACH[0],
                    EACH[1],
                    &path[BOTH.len() + 1..]
                );
                problems.push(problem.help(help));
            }
        }
    }
}

/// Reads both trucks, front and rear.
pub(super) fn trucks(r: &mut CaseReader<'_>, lading: Lading) -> [Parameters; 2] {
    let coils = sections::coils(r);
    if EACH.iter().all(|name| !r.has(name)) {
        let about = "Both trucks; [front_truck] and [rear_truck] take the same keys.";
        let own = truck(r, BOTH, about, (lading, &coils), |_| {});
        return [own.clone(), own];
    }
    [
        truck(r, EACH[0], "The front truck.", (lading, &coils), |_| {}),
        truck(r, EACH[1], "The rear truck.", (lading, &coils), |_| {}),
    ]
}

/// Reads one truck, or both; `first` reads keys of its table before the truck's own.
pub(crate) fn truck(
    r: &mut CaseReader<'_>,
    name: &str,
    about: &str,
    (lading, coils): (Lading, &[CoilKind]),
    first: impl FnOnce(&mut CaseReader<'_>),
) -> Parameters {
    r.within(name);
    r.section("", about);
    first(r);
    let (condition, damping) = sections::condition_and_damping(r, "Its [friction]");
    let mut own = Parameters::new(damping);
    own.bolster.free = [true; 6];
    sections::truck_places(r, &mut own.geometry);
    let bearings = match lading {
        Lading::Loaded => SideBearings::rollers(),
        Lading::Empty => SideBearings::constant_contact(),
    };
    own.car_body = Some(CarBody::new(lading, bearings));
    r.section("bolster", "The bolster.");
    sections::rigid_body(r, &mut own.bolster.body);
    let mut draft = wedges::all(r, &mut own, condition.friction(), coils);
    r.section("side_frame", "Both side frames.");
    wedges::columns_of_all(r, &mut own.geometry, &mut draft);
    let mut body = own.side_frames[0].body;
    sections::rigid_body(r, &mut body);
    for frame in &mut own.side_frames {
        frame.body = body;
    }
    wedges::single(r, &mut own, &draft);
    sections::load_springs(r, &mut own, coils);
    sections::stops(r, &mut own);
    sections::warp_spring(r, &mut own);
    if let Some(wheelsets) = &mut own.wheelsets {
        sections::adapter(r, &mut wheelsets.adapter, &mut own.geometry);
    }
    if let Some(car) = &mut own.car_body {
        sections::center_plate(r, &mut car.center_plate);
        sections::side_bearings(r, &mut car.side_bearings);
    }
    r.within("");
    own
}
