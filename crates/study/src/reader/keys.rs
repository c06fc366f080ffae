//! Keys of all kinds but motions.

use quantity::{Kind, Quantity, STANDARD_GRAVITY, System};

use super::schema::Form;
use super::{CaseReader, QuantityForm, WEIGHT};
use crate::case::face::FaceSection;
use crate::case::field::{Reach, Written, quoted};
use crate::case::names::COORDINATES;
use crate::case::page::write_points;
use crate::case::problem::{Problem, Problems};
use crate::case::section::{self, CaseSection, Names, Range};
use crate::case::table::{self, QuantityTable, TableForm};
use crate::case::tree::NodeValue;

impl CaseReader<'_> {
    pub fn quantity(
        &mut self,
        key: &'static str,
        form: QuantityForm,
        value: &mut f64,
        comment: &str,
    ) -> Option<Quantity> {
        self.quantity_or(key, form, None, value, comment)
    }

    /// A quantity with a default as it would be typed, or with its value as the default.
    pub fn quantity_or(
        &mut self,
        key: &'static str,
        form: QuantityForm,
        default: Option<Quantity>,
        value: &mut f64,
        comment: &str,
    ) -> Option<Quantity> {
        let (kind, range, reach) = form;
        let node = self.node(key, Form::Quantity(kind));
        let quantity = match (node, default) {
            (Some(node), _) => section::quantity(node, &self.path(key), kind, range, self.problems)?,
            (None, Some(default)) => default,
            (None, None) => in_customary_units(*value, kind)?,
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
        form: QuantityForm,
        value: &mut Option<f64>,
        example: &str,
        comment: &str,
    ) -> Option<Quantity> {
        if let (false, None) = (self.gives(key), &value) {
            self.node(key, Form::Quantity(form.0));
            self.absent(key, example, comment);
            return None;
        }
        let mut own = value.unwrap_or_default();
        let typed = self.quantity(key, form, &mut own, comment);
        *value = Some(own);
        typed
    }

    /// A mass, typed as the force that it weighs under standard gravity.
    pub fn weight(&mut self, mass: &mut f64, comment: &str) {
        let mut weight = *mass * STANDARD_GRAVITY;
        self.quantity("weight", WEIGHT, &mut weight, comment);
        *mass = weight / STANDARD_GRAVITY;
    }

    pub fn triple(&mut self, key: &'static str, form: QuantityForm, values: &mut [f64; 3], comment: &str) {
        self.triple_in(customary(form.0), key, form, values, comment);
    }

    /// Three quantities; a unit for their defaults.
    pub fn triple_in(
        &mut self,
        unit: &str,
        key: &'static str,
        form: QuantityForm,
        values: &mut [f64; 3],
        comment: &str,
    ) {
        let (kind, range, reach) = form;
        let given = self.node(key, Form::Triple(kind)).is_some();
        let triple = match self.given().filter(|_| given) {
            Some(section) => section.triple(key, kind, range, self.problems),
            None => {
                let [a, b, c] = values.map(|value| in_unit(value, unit));
                a.zip(b).zip(c).map(|((a, b), c)| [a, b, c])
            }
        };
        let Some(triple) = triple else { return };
        *values = triple.each_ref().map(Quantity::to_si);
        self.line(key, given, Written::triple(&triple, kind, reach), comment);
    }

    pub fn number(&mut self, key: &'static str, range: Range, reach: Reach, value: &mut f64, comment: &str) {
        let given = self.node(key, Form::number(range)).is_some();
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
        let given = self.node(key, Form::Truth).is_some();
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
        let node = self.node(key, Form::choice(names));
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
        let node = self.node(key, Form::several(names));
        if let Some(node) = node {
            let path = self.path(key);
            let NodeValue::List(items) = &node.value else {
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
        let chosen = COORDINATES.iter().map(|(_, number)| *number);
        let mut list: Vec<usize> = chosen.filter(|number| free[*number]).collect();
        self.several("free_coordinates", COORDINATES, &mut list, comment);
        if let Some(none) = none.filter(|_| list.is_empty()) {
            let path = self.path("free_coordinates");
            let problem = Problem::new(format!("`{path}` is empty: {none}"));
            let help = "list the free ones of \"x\", \"y\", \"z\", \"roll\", \"pitch\", \"yaw\"";
            self.problem_at(&path, problem.label("nothing is free").help(help));
        }
        *free = [false; 6];
        for coordinate in list {
            free[coordinate] = true;
        }
    }

    /// Anything that another function reads from the current section, if it is given, and writes.
    pub fn other<T>(
        &mut self,
        key: &'static str,
        form: Form,
        comment: &str,
        default: T,
        read: impl FnOnce(&CaseSection<'_>, &mut Problems) -> Option<T>,
        write: impl FnOnce(&T) -> Written,
    ) -> T {
        let given = self.node(key, form).is_some();
        let value = match self.given().filter(|_| given) {
            Some(section) => read(&section, self.problems).unwrap_or(default),
            None => default,
        };
        self.line(key, given, write(&value), comment);
        value
    }

    /// A table that is given, of points or in a file.
    pub fn table(
        &mut self,
        key: &'static str,
        form: &TableForm,
        reach: Reach,
        comment: &str,
    ) -> Option<QuantityTable> {
        let node = self.node(key, Form::Rows)?;
        let table = table::read(node, &self.path(key), form, self.tables, self.problems)?;
        self.rows += table.rows.len();
        let kinds = form.kinds;
        let embedded = QuantityTable {
            file: None,
            ..table.clone()
        };
        for (page, table) in self.pages.iter_mut().zip([&table, &embedded]) {
            let written = |system: Option<System>| match (&table.file, system) {
                (Some(file), _) => quoted(file),
                (None, None) => table.points_to_toml(),
                (None, Some(system)) => table.in_system(kinds, system).points_to_toml(),
            };
            page.line(key, Written::toml_in_units(written), comment);
            write_points(page, key, table, kinds[1], reach);
        }
        Some(table)
    }

    /// The keys of a face of a wedge.
    pub fn face(&mut self, face: &mut FaceSection) {
        let given: Vec<bool> = FaceSection::KEYS.iter().map(|key| self.gives(key)).collect();
        for (key, form) in FaceSection::KEYS.iter().zip(FaceSection::forms()) {
            self.node(key, form);
        }
        if let Some(section) = self.given()
            && let Some(read) = face.read_over(&section, self.tables, self.problems)
        {
            self.rows += read.rows();
            *face = read;
        }
        let mut embedded = face.clone();
        embedded.files_mut().for_each(|file| *file = None);
        let overlay = self.overlay;
        for line in face.lines() {
            let value = line.value.map(|value| value.toml).unwrap_or_default();
            self.explain(line.key, line.comment, &value);
        }
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
}

/// Returns the unit in which a default of this kind is written.
fn customary(kind: Kind) -> &'static str {
    match kind {
        Kind::Inertia => "lbf in s^2",
        Kind::Acceleration => "m/s^2",
        other => other.unit(System::Us),
    }
}

/// Returns an SI value in the customary unit of its kind, as [`in_unit`].
pub(crate) fn in_customary_units(value: f64, kind: Kind) -> Option<Quantity> {
    in_unit(value, customary(kind))
}

/// Returns an SI value in a unit, with the fewest digits that differ from it by rounding only.
fn in_unit(value: f64, unit: &str) -> Option<Quantity> {
    let one = Quantity::new(1.0, unit).ok()?.to_si();
    let number = value / one;
    let rounded = (0..17).filter_map(|decimals| format!("{number:.decimals$e}").parse::<f64>().ok());
    let near = |rounded: &f64| (rounded - number).abs() <= 1e-14 * number.abs();
    Quantity::new(rounded.into_iter().find(near).unwrap_or(number), unit).ok()
}
