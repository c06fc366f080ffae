//! The requests of a data file.

use nucars::tree::{DataFile, DataRequest, DofQuantity, ElementQuantity, Terms};
use nucars::truck::Truck;

/// A term of a sum: connection, component, factor.
pub type Term = (usize, usize, f64);

/// One column that is asked for. Bodies and connections by their places in the model.
#[derive(Clone, Debug, PartialEq)]
pub enum Request {
    /// A quantity of a body.
    Body {
        /// Displacement, velocity, acceleration, force.
        quantity: DofQuantity,
        /// The body.
        body: usize,
        /// The coordinate, 0 to 5.
        coordinate: usize,
    },
    /// A quantity of a connection.
    Connection {
        /// Force, stroke, velocity.
        quantity: ElementQuantity,
        /// The connection.
        connection: usize,
        /// The component, from 0.
        component: usize,
    },
    /// A weighted sum of forces of connections.
    Sum {
        /// Its name.
        name: String,
        /// The terms of the sum.
        terms: Vec<Term>,
    },
}

/// Returns the requests of a data file; with `all` also those of sections that are switched off. Gives too
/// what cannot be written, in words.
#[must_use]
pub fn of(data: &DataFile, truck: &Truck, all: bool) -> (Vec<Request>, Vec<String>) {
    let mut reader = Reader {
        truck,
        requests: Vec::new(),
        notes: Vec::new(),
    };
    for section in &data.sections {
        if section.off && !all {
            let keyword = section.request.keyword();
            reader.notes.push(format!(
                "{keyword} is switched off in the data file and not written"
            ));
            continue;
        }
        reader.section(&section.request, all);
    }
    (reader.requests, reader.notes)
}

struct Reader<'t> {
    truck: &'t Truck,
    requests: Vec<Request>,
    notes: Vec<String>,
}

impl Reader<'_> {
    fn section(&mut self, request: &DataRequest, all: bool) {
        match request {
            DataRequest::Dofs { quantity, bodies, .. } => {
                for own in bodies {
                    for dof in &own.dofs {
                        self.body(*quantity, *own.body, dof.kind as usize, dof.kind.is_flexible());
                    }
                }
            }
            DataRequest::Components {
                quantity, components, ..
            } => {
                for component in components {
                    match self.component(component.connection, component.position) {
                        Some((connection, component)) => self.requests.push(Request::Connection {
                            quantity: *quantity,
                            connection,
                            component,
                        }),
                        None => self.missing(&format!("{} {}", quantity.keyword(), component.value)),
                    }
                }
            }
            DataRequest::Sums { count, sums } => {
                let count = count.map_or(sums.len(), |count| *count as usize);
                let read = if all { sums.len() } else { count.min(sums.len()) };
                let mut done: Vec<Option<Vec<Term>>> = Vec::new();
                for sum in &sums[..read] {
                    let terms = self.terms(&sum.terms, &sum.coefficients, &done);
                    match &terms {
                        Some(terms) => self.requests.push(Request::Sum {
                            name: sum.name.trim().to_owned(),
                            terms: terms.clone(),
                        }),
                        None => self.missing(&format!("the sum '{}'", sum.name.trim())),
                    }
                    done.push(terms);
                }
            }
            DataRequest::Equilibrium | DataRequest::Track { .. } => {}
        }
    }

    fn body(&mut self, quantity: DofQuantity, number: u32, coordinate: usize, flexible: bool) {
        let Some(body) = self.truck.body(number).filter(|_| !flexible) else {
            self.missing(&format!(
                "{} of body {number}, freedom {}",
                quantity.keyword(),
                coordinate + 1
            ));
            return;
        };
        if quantity == DofQuantity::Acceleration && coordinate >= 3 {
            self.missing(&format!("the angular acceleration of body {number}"));
            return;
        }
        self.requests.push(Request::Body {
            quantity,
            body,
            coordinate,
        });
    }

    fn component(&self, connection: u32, position: u32) -> Option<(usize, usize)> {
        let place = self.truck.connection(connection)?;
        let count = self.truck.model.connections[place].law.coordinates().len();
        let component = (position as usize).checked_sub(1)?;
        (component < count).then_some((place, component))
    }

    fn terms(
        &self,
        terms: &Terms,
        factors: &[nucars::source::Spanned<f64>],
        done: &[Option<Vec<Term>>],
    ) -> Option<Vec<Term>> {
        match terms {
            Terms::Components(components) => components
                .iter()
                .zip(factors)
                .map(|(own, factor)| {
                    let (connection, component) = self.component(own.connection, own.position)?;
                    Some((connection, component, **factor))
                })
                .collect(),
            Terms::Sums(numbers) => {
                let mut all = Vec::new();
                for (number, factor) in numbers.iter().zip(factors) {
                    let earlier = done.get((**number as usize).checked_sub(1)?)?.as_ref()?;
                    all.extend(earlier.iter().map(|(c, k, own)| (*c, *k, own * **factor)));
                }
                Some(all)
            }
        }
    }

    fn missing(&mut self, what: &str) {
        self.notes
            .push(format!("{what} is asked for, but is not there and not written"));
    }
}
