//! Checks of data files.

use std::collections::{HashMap, HashSet};

use super::{repeated, shown, some_of};
use crate::finding::Findings;
use crate::read::Read;
use crate::source::Spanned;
use crate::tree::{BodyDofs, Component, DataFile, DataRequest, Dof, Element, Sum, SystemFile, Terms};

/// Checks a data file alone.
pub fn data(read: &Read<DataFile>) -> Findings {
    let mut findings = Findings::new(&read.source);
    for section in read.tree.active() {
        match &section.request {
            DataRequest::Components { components, .. } => {
                repeated(components.iter().copied(), "component", &mut findings);
            }
            DataRequest::Sums { sums, .. } => {
                for (index, sum) in sums.iter().enumerate() {
                    if sum.coefficients.is_empty() {
                        let message = format!("the sum '{}' has no terms", sum.name.trim());
                        findings.error("points", sum.name.span, message, "it has one term at least");
                    }
                    if let Terms::Sums(terms) = &sum.terms {
                        earlier(terms, index, &mut findings);
                    }
                }
            }
            _ => {}
        }
    }
    findings
}

fn earlier(terms: &[Spanned<u32>], index: usize, findings: &mut Findings) {
    for term in terms
        .iter()
        .filter(|term| ***term == 0 || ***term as usize > index)
    {
        let message = format!("this is sum {}, it cannot add up sum {term}", index + 1);
        findings.error(
            "unresolved",
            term.span,
            message,
            "a sum of kind 2 takes earlier sums, counted from 1",
        );
    }
}

/// Checks a data file with its system: whether there is what it asks for.
pub fn data_of_system(read: &Read<DataFile>, system: &SystemFile) -> Findings {
    let mut findings = Findings::new(&read.source);
    let known = Known::new(system);
    for section in &read.tree.sections {
        match &section.request {
            DataRequest::Dofs { bodies, .. } if section.off => {
                let missing = bodies.iter().map(|line| known.missing(line).len()).sum::<usize>();
                if missing > 0 && !system.lost.bodies {
                    findings.note(
                        "switched-off",
                        section.keyword.0,
                        format!(
                            "this section, which is switched off, asks for {missing} things the system \
                                 does not have"
                        ),
                        "correct it before taking the `$` away",
                    );
                }
            }
            _ if section.off => {}
            DataRequest::Dofs { bodies, .. } => {
                for line in bodies {
                    known.dofs(line, &mut findings);
                }
            }
            DataRequest::Components { components, .. } => {
                for component in components {
                    known.component(*component, &mut findings);
                }
            }
            DataRequest::Sums { sums, .. } => {
                for sum in sums {
                    known.sum(sum, &mut findings);
                }
            }
            DataRequest::Equilibrium | DataRequest::Track { .. } => {}
        }
    }
    findings
}

/// The objects that the system has.
struct Known<'a> {
    system: &'a SystemFile,
    bodies: HashMap<u32, HashSet<Dof>>,
    connections: HashMap<u32, &'a Element>,
}

impl<'a> Known<'a> {
    fn new(system: &'a SystemFile) -> Self {
        let set = |dofs: &[Spanned<Dof>]| dofs.iter().map(|dof| dof.value).collect();
        let bodies = system.bodies.iter().map(|body| (*body.id, set(&body.dofs)));
        let inputs = system.input_bodies.iter().map(|body| (*body.id, set(&body.dofs)));
        Known {
            system,
            bodies: bodies.chain(inputs).collect(),
            connections: system
                .connections
                .iter()
                .rev()
                .map(|one| (*one.id, &one.element))
                .collect(),
        }
    }

    /// Returns the degrees of freedom of this line that are not there.
    fn missing<'b>(&self, line: &'b BodyDofs) -> Vec<&'b Spanned<Dof>> {
        let coordinates = self.bodies.get(&*line.body);
        line.dofs
            .iter()
            .filter(|dof| coordinates.is_none_or(|coordinates| !coordinates.contains(&dof.value)))
            .collect()
    }

    fn dofs(&self, line: &BodyDofs, findings: &mut Findings) {
        if self.system.lost.bodies || findings.is_full() {
            return;
        }
        if !self.bodies.contains_key(&*line.body) {
            let message = format!("the system has no body {}", line.body);
            let help = format!("its bodies are {}", some_of(self.bodies.keys().copied()));
            findings.error("unresolved", line.body.span, message, help);
            return;
        }
        for dof in self.missing(line) {
            let message = format!(
                "body {} has no degree of freedom {dof} ({})",
                line.body,
                dof.kind.name()
            );
            findings.error(
                "lacking-dof",
                dof.span,
                message,
                "leave it out, and correct the counts",
            );
        }
    }

    /// Returns the direction of a component, if it is there.
    fn component(&self, component: Spanned<Component>, findings: &mut Findings) -> Option<Dof> {
        if self.system.lost.connections || findings.is_full() {
            return None;
        }
        let Some(element) = self.connections.get(&component.connection) else {
            let message = format!("the system has no connection {}", component.connection);
            let help = format!(
                "its connections are {}",
                some_of(self.connections.keys().copied())
            );
            findings.error("unresolved", component.span, message, help);
            return None;
        };
        let dof = element.dofs().get(component.position as usize - 1);
        if dof.is_none() {
            let message = format!(
                "connection {} has {} components, not {}",
                component.connection,
                element.dofs().len(),
                component.position
            );
            let names: Vec<String> = (1..)
                .zip(element.dofs())
                .map(|(k, dof)| format!(".{k} {}", dof.kind.name()))
                .collect();
            findings.error(
                "unresolved",
                component.span,
                message,
                format!("they are {}", names.join(", ")),
            );
        }
        dof.map(|dof| dof.value)
    }

    fn sum(&self, sum: &Sum, findings: &mut Findings) {
        let Terms::Components(components) = &sum.terms else {
            return;
        };
        let mut first: Option<(Spanned<Component>, Dof)> = None;
        let mut warned = false;
        for component in components {
            let Some(dof) = self.component(*component, findings) else {
                continue;
            };
            let (other, direction) = *first.get_or_insert((*component, dof));
            if dof != direction && !warned {
                warned = true;
                let element = self.connections.get(&component.connection);
                let right =
                    element.and_then(|element| element.dofs().iter().position(|dof| dof.value == direction));
                let help = match right {
                    Some(index) => format!(
                        "the {} of this connection is .{}",
                        direction.kind.name(),
                        index + 1
                    ),
                    None => "terms of one sum have one direction".to_owned(),
                };
                findings.warning(
                    "mixed-sum",
                    component.span,
                    format!(
                        "the sum '{}' adds {component} in {} to {other} in {}",
                        sum.name.trim(),
                        dof.kind.name(),
                        direction.kind.name()
                    ),
                    help,
                );
            }
        }
        if sum.coefficients.iter().all(|coefficient| **coefficient == 0.0) {
            let message = format!(
                "all coefficients of the sum '{}' are {}",
                sum.name.trim(),
                shown(0.0)
            );
            findings.warning("no-effect", sum.name.span, message, "it is always 0");
        }
    }
}
