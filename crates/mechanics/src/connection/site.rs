//! Geometry of connections: displacements of a point of a body, linear in its six coordinates.
//!
//! `u = x + θ lz - ψ ly`, `v = y - φ lz + ψ lx`, `w = z + φ ly - θ lx`; rotations pass through. The offset l
//! from the center of gravity is that of the drawn layout. Connections between markers: [`super::between`].

use super::between::Between;
use super::forces::CoordinatesAndRates;
use numerics::partitioned::Partitioned;

/// The row of one displacement in a body's coordinates: at most three entries.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CoordinateRow {
    at: [u8; 3],
    arm: [f64; 3],
    /// The same by free coordinates; arms of held ones are zero.
    slot: [u8; 3],
    free_arm: [f64; 3],
}

impl CoordinateRow {
    /// Returns the displacement `coordinate` (0..6) of the point at `offset` from the center of gravity;
    /// `slots` numbers the free coordinates.
    pub fn new(coordinate: usize, offset: [f64; 3], slots: &[Option<usize>; 6]) -> Self {
        let [x, y, z] = offset;
        let (at, arm) = match coordinate {
            0 => ([0, 4, 5], [1.0, z, -y]),
            1 => ([1, 3, 5], [1.0, -z, x]),
            2 => ([2, 3, 4], [1.0, y, -x]),
            k => ([k; 3], [1.0, 0.0, 0.0]),
        };
        let mut row = Self {
            at: at.map(|k| k as u8),
            arm,
            ..Self::default()
        };
        for i in 0..3 {
            if let Some(slot) = slots[at[i]] {
                row.slot[i] = slot as u8;
                row.free_arm[i] = arm[i];
            }
        }
        row
    }

    /// Returns the displacement at these coordinates.
    #[inline(always)]
    pub fn along(&self, coordinates: &[f64; 6]) -> f64 {
        let mut sum = 0.0;
        for i in 0..3 {
            sum += self.arm[i] * coordinates[usize::from(self.at[i]) % 6];
        }
        sum
    }

    /// Adds a force along the displacement to the generalized forces.
    #[inline(always)]
    pub fn push(&self, force: f64, target: &mut [f64; 6]) {
        for i in 0..3 {
            target[usize::from(self.at[i]) % 6] += self.arm[i] * force;
        }
    }

    /// Adds `factor ·` this row to a vector by free coordinates.
    #[inline(always)]
    pub fn add(&self, factor: f64, target: &mut [f64]) {
        for i in 0..3 {
            if let Some(value) = target.get_mut(usize::from(self.slot[i])) {
                *value += factor * self.free_arm[i];
            }
        }
    }

    /// Adds `factor · selfᵀ other` to a block by free coordinates whose rows have `width` entries.
    #[inline(always)]
    pub fn add_product(&self, other: &Self, factor: f64, width: usize, block: &mut [f64]) {
        for i in 0..3 {
            let scaled = factor * self.free_arm[i];
            let start = usize::from(self.slot[i]) * width;
            if let Some(line) = block.get_mut(start..start + width) {
                other.add(scaled, line);
            }
        }
    }
}

/// One end of a connection.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConnectionEnd {
    /// The body.
    pub body: usize,
    /// Its number among the free bodies.
    pub free: Option<usize>,
    /// Number of its free coordinates.
    pub size: usize,
    /// True if it is prescribed and moves.
    pub prescribed: bool,
    /// +1 for body A, -1 for body B: its share in the extension.
    pub sign: f64,
}

/// The place of an element with `D` coordinates and `P` powers in a system.
#[derive(Clone, Debug)]
pub(crate) struct Site<const D: usize, const P: usize> {
    /// Number of its connection, and of its first component there.
    pub connection: usize,
    /// First component there.
    pub component: usize,
    /// Body A and body B.
    pub ends: [ConnectionEnd; 2],
    /// The rows of its displacements at both ends.
    pub rows: [[CoordinateRow; D]; 2],
    /// Coupling blocks by end and end.
    pub pairs: [[usize; 2]; 2],
    /// Its powers' quadratures.
    pub energy_terms: [Option<usize>; P],
    /// Their rows in the Jacobian, by end; the last is that of the work of the inputs.
    pub quadratures: [[Option<usize>; P]; 2],
    /// The same for the work of the inputs.
    pub works: [Option<usize>; 2],
    /// True if one end is prescribed and moves.
    pub prescribed: bool,
    /// Its markers and coordinates if it acts between markers; else its rows hold them.
    pub between: Option<Box<Between<D>>>,
    /// The numbers of the free coordinates at both ends.
    pub slots: [[Option<usize>; 6]; 2],
}

/// Extensions and their rates at a state, and, between markers, the derivatives of the extensions by the
/// coordinates of both bodies.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ExtensionMotion<const D: usize> {
    /// Extensions.
    pub extensions: [f64; D],
    /// Their rates.
    pub rates: [f64; D],
    levers: Option<[[f64; 12]; D]>,
}

impl<const D: usize, const P: usize> Site<D, P> {
    /// Looks up the coupling blocks.
    pub fn find_pairs(&mut self, jacobian: &Partitioned) {
        let free = self.ends.map(|end| end.free);
        for (row, pairs) in free.iter().zip(&mut self.pairs) {
            for (column, pair) in free.iter().zip(pairs) {
                if let (Some(row), Some(column)) = (row, column) {
                    *pair = jacobian.pair(*row, *column);
                }
            }
        }
    }

    /// Returns the extensions and their rates.
    #[inline(always)]
    pub fn motion(&self, (positions, rates): CoordinatesAndRates<'_>) -> ExtensionMotion<D> {
        let Some(between) = &self.between else {
            return ExtensionMotion {
                extensions: self.differences(positions),
                rates: self.differences(rates),
                levers: None,
            };
        };
        let levers = between.levers_at(positions);
        let speeds = between.both(rates);
        let rate = |row: &[f64; 12]| row.iter().zip(&speeds).map(|(lever, speed)| lever * speed).sum();
        ExtensionMotion {
            extensions: levers.extensions,
            rates: levers.by_coordinates.each_ref().map(rate),
            levers: Some(levers.by_coordinates),
        }
    }

    /// Returns the differences of both ends' displacements.
    #[inline(always)]
    fn differences(&self, coordinates: &[[f64; 6]]) -> [f64; D] {
        let (a, b) = (&coordinates[self.ends[0].body], &coordinates[self.ends[1].body]);
        let mut extensions = [0.0; D];
        for k in 0..D {
            extensions[k] = self.rows[0][k].along(a) - self.rows[1][k].along(b);
        }
        extensions
    }

    /// Returns the part of the extensions' rates that prescribed ends make (from their coordinates' rates).
    #[inline(always)]
    pub fn prescribed_rates(&self, rates: &[[f64; 6]]) -> [f64; D] {
        let mut prescribed_rate = [0.0; D];
        for (end, rows) in self.ends.iter().zip(&self.rows) {
            if end.prescribed {
                for k in 0..D {
                    prescribed_rate[k] += end.sign * rows[k].along(&rates[end.body]);
                }
            }
        }
        prescribed_rate
    }

    /// Adds the forces on both bodies.
    #[inline(always)]
    pub fn push(&self, force: [f64; D], motion: &ExtensionMotion<D>, loads: &mut [[f64; 6]]) {
        let Some(levers) = &motion.levers else {
            self.push_along_axes(force, loads);
            return;
        };
        for (i, end) in self.ends.iter().enumerate().filter(|(_, end)| end.free.is_some()) {
            let load = &mut loads[end.body];
            for (force, levers) in force.iter().zip(levers) {
                for (load, lever) in load.iter_mut().zip(&levers[6 * i..]) {
                    *load -= force * lever;
                }
            }
        }
    }

    /// Adds the forces on both bodies of a connection that acts on differences of coordinates.
    #[inline(always)]
    pub fn push_along_axes(&self, force: [f64; D], loads: &mut [[f64; 6]]) {
        for (end, rows) in self.ends.iter().zip(&self.rows) {
            if end.free.is_some() {
                let load = &mut loads[end.body];
                for k in 0..D {
                    rows[k].push(-end.sign * force[k], load);
                }
            }
        }
    }
}
