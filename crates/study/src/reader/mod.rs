//! Reading a case key by key: what is left out has a default, and everything is written down as it is read.
//!
//! One line for each key says its name, what it measures, its range, its default and what it means. From
//! these lines come the values, the complete, commented case file and the fields of the explorer.

use mechanics::motion::Motion;
use quantity::{Kind, Quantity, STANDARD_GRAVITY, System};
use wedge::parameters::NeighbourMotion;

use crate::case::document::{Coordinate, NeighbourSection};
use crate::case::face::FaceSection;
use crate::case::field::{FieldSection, Reach, Written};
use crate::case::problem::{Problem, Problems};
use crate::case::section::{self, Names, Range, Section};
use crate::case::tree::{Node, Table, Value};
use crate::case::write::{Page, TURN, write_motion};
use crate::case::{self, Tables, motion, resolve};

/// Kind, range and suggested reach of a quantity.
pub(crate) type Form = (Kind, Range, Reach);

/// A length that is not negative.
pub(crate) const CLEARANCE: Form = (Kind::Length, Range::NotNegative, Reach::FromZero(0.025));
/// A length.
pub(crate) const LENGTH: Form = (Kind::Length, Range::Positive, Reach::Positive);
/// A stiffness.
pub(crate) const STIFFNESS: Form = (Kind::Stiffness, Range::Positive, Reach::Wide);
/// A damping.
pub(crate) const DAMPING: Form = (Kind::Damping, Range::NotNegative, Reach::FromZero(5000.0));
/// A static load.
pub(crate) const PRELOAD: Form = (Kind::Force, Range::NotNegative, Reach::Positive);
/// A force that a mass weighs.
const WEIGHT: Form = (Kind::Force, Range::Positive, Reach::Positive);

/// Reads sections and writes them down.
pub(crate) struct Reader<'r> {
    tree: &'r Table,
    tables: Tables<'r>,
    pub problems: &'r mut Problems,
    /// As typed, and with the points of tables in files.
    pages: [Page; 2],
    /// The table that sections are in: empty, or a truck of a car.
    within: &'static str,
    /// The full path of the current section.
    section: String,
    /// Whether only what is given is written down, and no default.
    overlay: bool,
    /// Sections with their keys.
    known: Vec<(String, Vec<&'static str>)>,
    /// Sections whose keys others read.
    elsewhere: Vec<String>,
    /// The motions that were given, with their paths.
    pub motions: Vec<(String, motion::Motion)>,
}

impl<'r> Reader<'r> {
    pub fn new(tree: &'r Table, tables: Tables<'r>, problems: &'r mut Problems) -> Self {
        Self {
            tree,
            tables,
            problems,
            pages: [Page::default(), Page::default()],
            within: "",
            section: String::new(),
            overlay: false,
            known: vec![(String::new(), Vec::new())],
            elsewhere: Vec::new(),
            motions: Vec::new(),
        }
    }

    /// Takes the sections that follow from a table of the case; from the case itself where that is empty.
    /// Paths of sections are relative to it.
    pub fn within(&mut self, table: &'static str) {
        self.within = table;
    }

    /// The full path of what stands at a path within the table that sections are taken from.
    fn full(&self, path: &str) -> String {
        match (self.within, path) {
            ("", path) => path.to_owned(),
            (within, "") => within.to_owned(),
            (within, path) => format!("{within}.{path}"),
        }
    }

    /// Begins a section.
    pub fn section(&mut self, path: &str, about: &str) {
        self.section = self.full(path);
        self.overlay = false;
        self.known.push((self.section.clone(), Vec::new()));
        for page in &mut self.pages {
            page.section(&self.section, about);
        }
    }

    /// Begins a section that holds for one of several bodies, and of which nothing is written that is not
    /// given. Returns whether anything is.
    pub fn overlay(&mut self, path: &str, about: &str) -> bool {
        self.section = self.full(path);
        self.overlay = true;
        self.known.push((self.section.clone(), Vec::new()));
        let given = self.table_at(&self.section).is_some();
        if given {
            for page in &mut self.pages {
                page.section(&self.section, about);
            }
        }
        given
    }

    /// Says that a section holds keys that are read elsewhere.
    pub fn expect(&mut self, section: &str, keys: &[&'static str]) {
        let section = self.full(section);
        match self.known.iter_mut().find(|(known, _)| *known == section) {
            Some((_, known)) => known.extend(keys),
            None => self.known.push((section, keys.to_vec())),
        }
    }

    /// Returns whether the case has a section or a key at a path.
    pub fn has(&self, path: &str) -> bool {
        self.at(path).is_some()
    }

    /// What stands at a path.
    pub fn at(&self, path: &str) -> Option<&'r Node> {
        let path = &self.full(path);
        let (section, key) = path.rsplit_once('.').unwrap_or(("", path));
        self.table_at(section)?.get(key)
    }

    /// Notes a mistake at a path.
    pub fn problem(&mut self, path: &str, problem: Problem) {
        self.problem_at(&self.full(path), problem);
    }

    /// The same at a full path.
    fn problem_at(&mut self, path: &str, problem: Problem) {
        self.problems.push(match self.tree.place_of(path) {
            Some(place) => problem.at(place),
            None => problem,
        });
    }

    fn table_at(&self, path: &str) -> Option<&'r Table> {
        let mut table = self.tree;
        for key in path.split('.').filter(|key| !key.is_empty()) {
            table = table.table(key)?;
        }
        Some(table)
    }

    /// The current section, if the case has it.
    pub fn given(&self) -> Option<Section<'r>> {
        let (outer, key) = self.section.rsplit_once('.').unwrap_or(("", &self.section));
        let place = self.table_at(outer).and_then(|table| table.entry(key));
        Some(Section {
            path: self.section.clone(),
            table: self.table_at(&self.section)?,
            place: place.map(|entry| entry.key_place.clone()),
        })
    }

    /// Takes note of a key. Returns what stands there.
    fn node(&mut self, key: &'static str) -> Option<&'r Node> {
        if let Some((_, keys)) = self.known.last_mut() {
            keys.push(key);
        }
        self.table_at(&self.section)?.get(key)
    }

    fn path(&self, key: &str) -> String {
        format!("{}.{key}", self.section)
    }

    fn line(&mut self, key: &str, given: bool, written: Written, comment: &str) {
        if given || !self.overlay {
            let [typed, embedded] = &mut self.pages;
            typed.line(key, written.clone(), comment);
            embedded.line(key, written, comment);
        }
    }

    pub fn quantity(
        &mut self,
        key: &'static str,
        form: Form,
        value: &mut f64,
        comment: &str,
    ) -> Option<Quantity> {
        let (kind, range, reach) = form;
        let node = self.node(key);
        let quantity = match node {
            Some(node) => section::quantity(node, &self.path(key), kind, range, self.problems)?,
            None => in_customary_units(*value, kind)?,
        };
        *value = quantity.to_si();
        self.line(
            key,
            node.is_some(),
            Written::quantity(&quantity, kind, reach),
            comment,
        );
        Some(quantity)
    }

    /// A quantity that may be left out.
    pub fn optional(
        &mut self,
        key: &'static str,
        form: Form,
        value: &mut Option<f64>,
        example: &str,
        comment: &str,
    ) {
        let given = self
            .table_at(&self.section)
            .is_some_and(|table| table.get(key).is_some());
        if let (false, None) = (given, &value) {
            self.node(key);
            if !self.overlay {
                for page in &mut self.pages {
                    page.absent(key, example, comment);
                }
            }
            return;
        }
        let mut own = value.unwrap_or_default();
        self.quantity(key, form, &mut own, comment);
        *value = Some(own);
    }

    /// A mass, typed as the force that it weighs under standard gravity.
    pub fn weight(&mut self, mass: &mut f64, comment: &str) {
        let mut weight = *mass * STANDARD_GRAVITY;
        self.quantity("weight", WEIGHT, &mut weight, comment);
        *mass = weight / STANDARD_GRAVITY;
    }

    pub fn triple(&mut self, key: &'static str, form: Form, values: &mut [f64; 3], comment: &str) {
        let (kind, range, reach) = form;
        let given = self.node(key).is_some();
        let triple = match self.given().filter(|_| given) {
            Some(section) => section.triple(key, kind, range, self.problems),
            None => {
                let [a, b, c] = values.map(|value| in_customary_units(value, kind));
                a.zip(b).zip(c).map(|((a, b), c)| [a, b, c])
            }
        };
        let Some(triple) = triple else { return };
        *values = triple.each_ref().map(Quantity::to_si);
        self.line(key, given, Written::triple(&triple, kind, reach), comment);
    }

    pub fn number(&mut self, key: &'static str, range: Range, reach: Reach, value: &mut f64, comment: &str) {
        let given = self.node(key).is_some();
        if let Some(section) = self.given().filter(|_| given) {
            let example = format!("{value:?}");
            let Some(number) = section.number(key, range, &example, self.problems) else {
                return;
            };
            *value = number;
        }
        self.line(key, given, Written::number(*value, reach), comment);
    }

    pub fn truth(&mut self, key: &'static str, value: &mut bool, comment: &str) {
        let given = self.node(key).is_some();
        if let Some(section) = self.given().filter(|_| given) {
            let Some(truth) = section.truth(key, self.problems) else {
                return;
            };
            *value = truth;
        }
        self.line(key, given, Written::truth(*value), comment);
    }

    pub fn choice<T: Copy + PartialEq>(
        &mut self,
        key: &'static str,
        names: Names<T>,
        value: &mut T,
        comment: &str,
    ) {
        let node = self.node(key);
        if let Some(node) = node {
            let Some(choice) = section::choice(node, &self.path(key), names, self.problems) else {
                return;
            };
            *value = choice;
        }
        self.line(key, node.is_some(), Written::choice(names, value), comment);
    }

    /// A list of names of choices.
    pub fn several<T: Copy + PartialEq>(
        &mut self,
        key: &'static str,
        names: Names<T>,
        values: &mut Vec<T>,
        comment: &str,
    ) {
        let node = self.node(key);
        if let Some(node) = node {
            let path = self.path(key);
            let Value::List(items) = &node.value else {
                let found = node.value.describe();
                let problem = Problem::new(format!("`{path}` is {found}; a list is expected"));
                let known: Vec<&str> = names.iter().map(|(name, _)| *name).collect();
                let help = format!("list some of \"{}\"; [] for none", known.join("\", \""));
                self.problems
                    .push(problem.at(&node.place).label("not a list").help(help));
                return;
            };
            let mut list = Vec::new();
            for item in items {
                let Some(choice) = section::choice(item, &path, names, self.problems) else {
                    return;
                };
                if list.contains(&choice) {
                    let name = section::name_of(names, &choice);
                    let problem = Problem::new(format!("`{path}` names \"{name}\" twice"));
                    let problem = problem.at(&item.place).label("named before").help("name it once");
                    self.problems.push(problem);
                    return;
                }
                list.push(choice);
            }
            *values = list;
        }
        self.line(key, node.is_some(), Written::several(names, values), comment);
    }

    /// The coordinates that are free; `none` says what is wrong if there are none, if that is wrong.
    pub fn free_coordinates(&mut self, free: &mut [bool; 6], none: Option<&str>, comment: &str) {
        let mut list: Vec<Coordinate> = Coordinate::NAMES
            .iter()
            .filter(|(_, coordinate)| free[*coordinate as usize])
            .map(|(_, coordinate)| *coordinate)
            .collect();
        self.several("free_coordinates", Coordinate::NAMES, &mut list, comment);
        if let Some(none) = none.filter(|_| list.is_empty()) {
            let path = self.path("free_coordinates");
            let problem = Problem::new(format!("`{path}` is empty: {none}"));
            let help = "list the free ones of \"x\", \"y\", \"z\", \"roll\", \"pitch\", \"yaw\"";
            self.problem_at(&path, problem.label("nothing is free").help(help));
        }
        *free = [false; 6];
        for coordinate in list {
            free[coordinate as usize] = true;
        }
    }

    /// The motions of a body; `free` says that it has free coordinates and must not be moved.
    pub fn motions(&mut self, own: &mut NeighbourMotion, free: bool) {
        let given = self.node("center").is_some();
        if let Some(section) = self.given().filter(|_| given) {
            if let Some(typed) = section.triple("center", Kind::Length, Range::Any, self.problems) {
                own.center = Some(typed.each_ref().map(Quantity::to_si));
                let written = Written::triple(&typed, Kind::Length, Reach::Signed(0.0254));
                self.line("center", true, written, "the point it turns about, in truck axes");
            }
        } else if !self.overlay {
            for page in &mut self.pages {
                let comment = "the point it turns about, in truck axes; left out, its center of gravity";
                page.absent("center", r#"["0 in", "0 in", "0 in"]"#, comment);
            }
        }
        for (at, key) in NeighbourSection::COORDINATES.into_iter().enumerate() {
            let (kind, most) = if at < 3 {
                (Kind::Length, 0.0254)
            } else {
                (Kind::Angle, TURN)
            };
            self.motion(key, kind, most, &mut own.coordinates[at], free);
        }
    }

    /// The loads on the free coordinates of a body, in a section within its own.
    pub fn loads(&mut self, body: &str, applied: &mut [Motion; 6], free: [bool; 6]) {
        let path = format!("{body}.load");
        let about = "Loads on its free coordinates over time: forces at its center of gravity, moments \
                     about its axes.\n\
                     # Written as motions are, in units of forces and moments.";
        if !self.overlay(&path, about) {
            return;
        }
        for (at, key) in NeighbourSection::COORDINATES.into_iter().enumerate() {
            let (kind, most) = if at < 3 {
                (Kind::Force, 1e5)
            } else {
                (Kind::Moment, 1e5)
            };
            self.motion(key, kind, most, &mut applied[at], false);
            if !free[at] && applied[at] != Motion::Constant(0.0) {
                let path = self.path(key);
                let problem = Problem::new(format!("`{path}` loads a coordinate that is not free"));
                let help = format!(
                    "add \"{}\" to {body}.free_coordinates, or prescribe {body}.{key} instead",
                    Coordinate::NAMES[at].0
                );
                self.problem_at(&path, problem.label("this would have no effect").help(help));
            }
        }
    }

    fn motion(&mut self, key: &'static str, kind: Kind, most: f64, value: &mut Motion, free: bool) {
        let path = self.path(key);
        let Some(node) = self.node(key) else {
            if let (false, Motion::Constant(held)) = (self.overlay, &*value)
                && let Some(held) = in_customary_units(*held, kind)
            {
                self.line(
                    key,
                    false,
                    Written::quantity(&held, kind, Reach::Signed(most)),
                    "",
                );
            }
            return;
        };
        let Some(typed) = motion::read(node, &path, kind, self.tables, self.problems) else {
            return;
        };
        match resolve::motion(&typed) {
            Ok(motion) => *value = motion,
            Err(reason) => {
                let problem = Problem::new(format!("`{path}`: {reason}")).at(&node.place);
                self.problems.push(problem);
                return;
            }
        }
        if free && *value != Motion::Constant(0.0) {
            let problem =
                Problem::new(format!("`{path}` moves a body that has free coordinates")).at(&node.place);
            let help = format!(
                "write {}.free_coordinates = [] to prescribe its motion, or leave the motion out",
                self.section
            );
            self.problems
                .push(problem.label("this would have no effect").help(help));
        }
        if let motion::Motion::Constant(held) = &typed {
            self.line(key, true, Written::quantity(held, kind, Reach::Signed(most)), "");
        } else {
            let mut embedded = typed.clone();
            for table in embedded.tables_mut() {
                table.file = None;
            }
            for (page, motion) in self.pages.iter_mut().zip([&typed, &embedded]) {
                page.line(
                    key,
                    Written::toml_in_units(|system| motion.to_toml_in(kind, system)),
                    "",
                );
                write_motion(page, key, motion, kind, most);
            }
        }
        self.motions.push((path, typed));
    }

    /// Anything that another function reads from the current section, if it is given, and writes.
    pub fn other<T>(
        &mut self,
        key: &'static str,
        comment: &str,
        default: T,
        read: impl FnOnce(&Section<'_>, &mut Problems) -> Option<T>,
        write: impl FnOnce(&T) -> Written,
    ) -> T {
        let given = self.node(key).is_some();
        let value = match self.given().filter(|_| given) {
            Some(section) => read(&section, self.problems).unwrap_or(default),
            None => default,
        };
        self.line(key, given, write(&value), comment);
        value
    }

    /// The keys of a face of a wedge.
    pub fn face(&mut self, face: &mut FaceSection) {
        let given = |key: &str| {
            self.table_at(&self.section)
                .is_some_and(|table| table.get(key).is_some())
        };
        let given: Vec<bool> = FaceSection::KEYS.iter().map(|key| given(key)).collect();
        for key in FaceSection::KEYS {
            self.node(key);
        }
        if let Some(section) = self.given()
            && let Some(read) = face.read_over(&section, self.tables, self.problems)
        {
            *face = read;
        }
        let mut embedded = face.clone();
        embedded.tables_mut().for_each(|table| table.file = None);
        let overlay = self.overlay;
        for (page, face) in self.pages.iter_mut().zip([&*face, &embedded]) {
            for (line, given) in face.lines().into_iter().zip(&given) {
                match line.value {
                    Some(value) if *given || !overlay => page.line(line.key, value, line.comment),
                    None if !overlay => page.absent(line.key, line.example, line.comment),
                    _ => {}
                }
            }
        }
    }

    /// A line at the top of the file.
    pub fn top(&mut self, key: &str, written: Written, comment: &str) {
        for page in &mut self.pages {
            page.line(key, written.clone(), comment);
        }
    }

    /// Where files that the case names are looked for.
    pub fn tables(&self) -> Tables<'r> {
        self.tables
    }

    /// Says that the keys of the current section are read by another reader.
    pub fn known_elsewhere(&mut self) {
        self.known.retain(|(path, _)| *path != self.section);
        self.elsewhere.push(self.section.clone());
    }

    /// A line of the current section that another reader has read: as typed, and with files written into it.
    pub fn write(&mut self, key: &str, texts: [String; 2], comment: &str) {
        for (page, text) in self.pages.iter_mut().zip(texts) {
            page.line(key, Written::toml(text), comment);
        }
    }

    /// The same of the case as typed alone.
    pub fn write_typed(&mut self, key: &str, text: String, comment: &str) {
        self.pages[0].line(key, Written::toml(text), comment);
    }

    /// The same of the case with files written into it alone.
    pub fn write_embedded(&mut self, key: &str, text: String) {
        self.pages[1].line(key, Written::toml(text), "");
    }

    /// Notes keys that nobody asked for; `what` is read: a truck's case. Returns the completed case, as typed
    /// and with the points of tables in files, and its fields.
    pub fn finish(self, what: &str) -> (String, String, Vec<FieldSection>) {
        let owners: Vec<(&str, &[&str])> = self
            .known
            .iter()
            .filter(|(path, _)| !path.is_empty() && !path.contains('.'))
            .map(|(path, keys)| (path.as_str(), keys.as_slice()))
            .collect();
        for (path, keys) in &self.known {
            let mut keys: Vec<&str> = keys.clone();
            // Sections within it.
            let prefix = if path.is_empty() {
                String::new()
            } else {
                format!("{path}.")
            };
            for (other, _) in &self.known {
                if let Some(rest) = other.strip_prefix(&prefix).filter(|rest| !rest.is_empty()) {
                    keys.push(rest.split('.').next().unwrap_or(rest));
                }
            }
            if path.is_empty() {
                keys.extend(self.elsewhere.iter().map(String::as_str));
            }
            let (outer, key) = path.rsplit_once('.').unwrap_or(("", path));
            let outer = self.table_at(outer);
            let entry = outer.and_then(|table| table.entry(key));
            if let Some(entry) = entry
                && !matches!(entry.node.value, Value::Table(_))
            {
                let message = format!("`{path}` is {}; a table is expected", entry.node.value.describe());
                let problem = Problem::new(message).at(&entry.node.place).label("not a table");
                let help = format!("write [{path}] on a line of its own and the keys below it");
                self.problems.push(problem.help(help));
            }
            if let Some(table) = self.table_at(path) {
                let section = Section {
                    path: path.clone(),
                    table,
                    place: None,
                };
                section.allow_in(&keys, &owners, what, self.problems);
            }
        }
        let [typed, embedded] = self.pages;
        (typed.text, embedded.text, typed.sections)
    }
}

/// An SI value in the customary unit of its kind, with the fewest digits that differ from it by rounding
/// only.
fn in_customary_units(value: f64, kind: Kind) -> Option<Quantity> {
    let unit = match kind {
        Kind::Inertia => "lbf in s^2",
        Kind::Acceleration => "m/s^2",
        other => other.unit(System::Us),
    };
    let one = Quantity::new(1.0, unit).ok()?.to_si();
    let number = value / one;
    let rounded = (0..17).filter_map(|decimals| format!("{number:.decimals$e}").parse::<f64>().ok());
    let near = |rounded: &f64| (rounded - number).abs() <= 1e-14 * number.abs();
    Quantity::new(rounded.into_iter().find(near).unwrap_or(number), unit).ok()
}

/// The check of tables in motions against the duration.
pub(crate) fn check_motions(reader: &mut Reader<'_>, duration: &Quantity) {
    let (tree, tables) = (reader.tree, reader.tables);
    let mut rows = 0;
    for (path, motion) in &reader.motions {
        case::read::check_motion_covers(path, motion, duration, tree, tables, reader.problems);
        rows += motion
            .tables()
            .iter()
            .map(|table| table.rows.len())
            .sum::<usize>();
    }
    if rows > input::limits::CASE_ROWS {
        let most = input::limits::CASE_ROWS;
        let message = format!("the tables of the case have {rows} rows together; at most {most} are read");
        let problem = Problem::new(message).help("leave out rows: motions are smooth between them");
        reader.problems.push(problem);
    }
}
