//! Motions of bodies, and loads on them.

use std::mem;

use input::limits;
use mechanics::motion::Motion;
use quantity::{Kind, Quantity};
use wedge::parameters::NeighbourMotion;

use super::CaseReader;
use super::keys::in_customary_units;
use super::schema::Form;
use crate::case::field::{Reach, Written};
use crate::case::motion;
use crate::case::names::{COORDINATES, MOTIONS};
use crate::case::page::{TURN, write_motion};
use crate::case::problem::Problem;
use crate::case::section::Range;

impl CaseReader<'_> {
    /// The motions of a body; `free` says that it has free coordinates and must not be moved, `center` what
    /// the point means about which it turns.
    pub fn motions(&mut self, own: &mut NeighbourMotion, free: bool, center: &str) {
        let given = self.node("center", Form::Triple(Kind::Length)).is_some();
        if let Some(section) = self.given().filter(|_| given) {
            if let Some(typed) = section.triple("center", Kind::Length, Range::Any, self.problems) {
                own.center = Some(typed.each_ref().map(Quantity::to_si));
                let written = Written::triple(&typed, Kind::Length, Reach::Signed(0.0254));
                self.line("center", true, written, center);
            }
        } else {
            self.absent("center", r#"["0 in", "0 in", "0 in"]"#, center);
        }
        for (at, key) in MOTIONS.into_iter().enumerate() {
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
        for (at, key) in MOTIONS.into_iter().enumerate() {
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
                    COORDINATES[at].0
                );
                self.problem_at(&path, problem.label("this would have no effect").help(help));
            }
        }
    }

    /// A motion along a coordinate or a load, whose name says all, suggested up to `most`; `free` says that
    /// its body must not be moved.
    fn motion(&mut self, key: &'static str, kind: Kind, most: f64, value: &mut Motion, free: bool) {
        self.course(key, (kind, most), value, free, "");
    }

    /// A course over time with its meaning, as [`CaseReader::motion`].
    pub fn course(
        &mut self,
        key: &'static str,
        (kind, most): (Kind, f64),
        value: &mut Motion,
        free: bool,
        comment: &str,
    ) {
        let path = self.path(key);
        let Some(node) = self.node(key, Form::Motion(kind)) else {
            if let (false, Motion::Constant(held)) = (self.overlay, &*value)
                && let Some(held) = in_customary_units(*held, kind)
            {
                self.line(
                    key,
                    false,
                    Written::quantity(&held, kind, Reach::Signed(most)),
                    comment,
                );
            }
            return;
        };
        let Some(typed) = motion::read(node, &path, kind, self.tables, self.problems) else {
            return;
        };
        match motion::to_si(&typed) {
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
        if let motion::CaseMotion::Constant(held) = &typed {
            self.line(
                key,
                true,
                Written::quantity(held, kind, Reach::Signed(most)),
                comment,
            );
        } else {
            let mut embedded = typed.clone();
            for table in embedded.tables_mut() {
                table.file = None;
            }
            for (page, motion) in self.pages.iter_mut().zip([&typed, &embedded]) {
                page.line(
                    key,
                    Written::toml_in_units(|system| motion.to_toml_in(kind, system)),
                    comment,
                );
                write_motion(page, key, motion, kind, most);
            }
        }
        self.motions.push((path, typed));
    }
}

/// Notes tables in motions that do not last as long as the run, and too many rows in all tables together.
pub(crate) fn check_motions(reader: &mut CaseReader<'_>, duration: &Quantity) {
    let mut rows = reader.rows;
    for (path, motion) in mem::take(&mut reader.motions) {
        let covers =
            |first: &Quantity, last: &Quantity| first.to_si() <= 0.0 && last.to_si() >= duration.to_si();
        for table in motion.tables() {
            rows += table.rows.len();
            let (Some([first, _]), Some([last, _])) = (table.rows.first(), table.rows.last()) else {
                continue;
            };
            if covers(first, last) {
                continue;
            }
            let message = match &table.file {
                Some(file) if !reader.tables.may_quote() => {
                    format!("`{path}`: {file} does not last from 0 to {duration}, as the run does")
                }
                _ => {
                    format!(
                        "`{path}` is given from {first} to {last}, but the run lasts from 0 to {duration}"
                    )
                }
            };
            let help = "add rows to the table, or shorten simulation.duration";
            let problem = Problem::new(message).label("does not cover the run").help(help);
            reader.problem_at(&path, problem);
        }
    }
    if rows > limits::CASE_ROWS {
        let most = limits::CASE_ROWS;
        let message = format!("the tables of the case have {rows} rows together; at most {most} are read");
        let problem = Problem::new(message).help("leave out rows: values between them are interpolated");
        reader.problems.push(problem);
    }
}
