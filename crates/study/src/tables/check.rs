//! How far a table is from runs that are not in it: between two nodes in each direction, in the middle of a
//! cell, at half of its amplitude.

use serde::{Deserialize, Serialize};

use super::Table;
use super::grid::{Direction, Grid, Point};
use super::rig::{Branches, Test, Wanted, positions};

/// Where a run is compared.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CheckPlace {
    /// The direction in which it lies between two nodes; none in the middle of a cell or at a node.
    pub between: Option<Direction>,
    /// Load, rise, friction and rate.
    pub at: Point,
    /// Its amplitude over that of the table.
    pub amplitude_share: f64,
}

/// What the comparison says.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Check {
    /// Where.
    pub place: CheckPlace,
    /// Largest difference of a branch, N or N·m.
    pub largest: f64,
    /// Root mean square of all differences of both branches.
    pub rms: f64,
    /// Largest force or moment of the run, to which per cents refer.
    pub reference: f64,
    /// Largest half of the difference of the run's branches: what friction holds.
    pub half_width: f64,
    /// Energy that a cycle takes by the table and in the run, J: the area between the branches, by straight
    /// lines.
    pub energies: [f64; 2],
}

/// Returns the places: the middles between the nodes of each direction, with the middle values of the
/// others; the middle of the first cell in all directions, if there are several; half the amplitude.
#[must_use]
pub fn places(grid: &Grid) -> Vec<CheckPlace> {
    let middle = grid.middle();
    let mut all = Vec::new();
    let mut cell = middle;
    for (k, (direction, values)) in Direction::ALL.into_iter().zip(&grid.values).enumerate() {
        for (number, ends) in values.windows(2).enumerate() {
            let value = 0.5 * (ends[0] + ends[1]);
            let mut at = middle;
            at[k] = value;
            if number == 0 {
                cell[k] = value;
            }
            all.push(CheckPlace {
                between: Some(direction),
                at,
                amplitude_share: 1.0,
            });
        }
    }
    let place = |at, amplitude_share| CheckPlace {
        between: None,
        at,
        amplitude_share,
    };
    if grid.varied().count() > 1 {
        all.push(place(cell, 1.0));
    }
    all.push(place(middle, 0.5));
    all
}

impl CheckPlace {
    /// Returns the run.
    #[must_use]
    pub fn wanted(&self, test: Test, amplitude: f64) -> Wanted {
        Wanted {
            test,
            at: self.at,
            amplitude: amplitude * self.amplitude_share,
        }
    }

    /// Returns where it is, in words.
    #[must_use]
    pub fn words(&self) -> String {
        match self.between {
            Some(direction) => format!("{} between two nodes", direction.name()),
            None if self.amplitude_share < 1.0 => "half the amplitude, at a node".to_owned(),
            None => "middle of a cell, all directions".to_owned(),
        }
    }
}

impl Check {
    /// Compares a table with the branches of a run.
    #[must_use]
    pub fn of(grid: &Grid, table: &Table, place: &CheckPlace, found: &Branches) -> Self {
        let mut own = Self {
            place: *place,
            largest: 0.0,
            rms: 0.0,
            reference: 0.0,
            half_width: 0.0,
            energies: [0.0; 2],
        };
        let all = positions(table.amplitude * place.amplitude_share);
        for (number, position) in all.iter().enumerate() {
            let ran = [found.rising[number], found.falling[number]];
            // All places lie inside.
            let Ok(said) = table.at(grid, place.at, *position) else {
                continue;
            };
            for (said, ran) in said.iter().zip(&ran) {
                own.largest = own.largest.max((said - ran).abs());
                own.rms += (said - ran) * (said - ran);
                own.reference = own.reference.max(ran.abs());
            }
            let neighbor = |other: Option<&f64>| other.map_or(0.0, |other| (other - position).abs());
            let width =
                neighbor(number.checked_sub(1).and_then(|k| all.get(k))) + neighbor(all.get(number + 1));
            for (energy, [rising, falling]) in own.energies.iter_mut().zip([said, ran]) {
                *energy += 0.5 * width * (rising - falling);
            }
            own.half_width = own.half_width.max(0.5 * (ran[0] - ran[1]).abs());
        }
        own.rms = libm::sqrt(own.rms / (2 * all.len()) as f64);
        own
    }

    /// Returns by how much the table's energy of a cycle exceeds that of the run, in per cent of the latter.
    #[must_use]
    pub fn energy_per_cent(&self) -> f64 {
        let [said, ran] = self.energies;
        100.0 * (said - ran) / ran
    }

    /// Returns largest and root mean square difference, and the half width, in per cent of the largest force
    /// or moment of the run.
    #[must_use]
    pub fn per_cent(&self) -> [f64; 3] {
        [self.largest, self.rms, self.half_width].map(|own| 100.0 * own / self.reference)
    }
}
