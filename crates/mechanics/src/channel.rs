//! What is seen of a model: numbers with names, units and meanings, each a function of an observation.

use std::fmt;
use std::marker::PhantomData;
use std::sync::Arc;

use quantity::Kind;

use crate::output::Column;
use crate::system::Observation;

/// What channels read from.
pub trait Sight: 'static {
    /// A state of the model, as channels see it.
    type At<'s>;
}

/// The sight of models of which loads are computed from an observation first: [`Seen`].
#[derive(Debug)]
pub struct WithLoads<L>(PhantomData<L>);

impl<L: 'static> Sight for WithLoads<L> {
    type At<'s> = Seen<'s, L>;
}

/// An observation with the loads that a model computes from it.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'s, L> {
    /// The observation.
    pub observation: &'s Observation,
    /// The loads.
    pub loads: &'s L,
    /// Energy stored at the start, J.
    pub start_energy: f64,
}

/// Channels: their columns, and how their values are read, SI.
pub struct Channels<S: Sight> {
    /// Of each its name, kind, axes, meaning.
    pub columns: Vec<Column>,
    /// Each appends the values of some channels that are read together, in the order of the columns.
    readings: Vec<Arc<Reading<S>>>,
}

type Reading<S> = dyn Fn(&<S as Sight>::At<'_>, &mut Vec<f64>) + Send + Sync;

impl<S: Sight> Default for Channels<S> {
    fn default() -> Self {
        Self {
            columns: Vec::new(),
            readings: Vec::new(),
        }
    }
}

impl<S: Sight> Clone for Channels<S> {
    fn clone(&self) -> Self {
        Self {
            columns: self.columns.clone(),
            readings: self.readings.clone(),
        }
    }
}

impl<S: Sight> fmt::Debug for Channels<S> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Channels")
            .field("columns", &self.columns)
            .finish_non_exhaustive()
    }
}

impl<S: Sight> Channels<S> {
    /// Returns channels of which one reading appends the values, in the order of the columns.
    pub fn new(
        columns: Vec<Column>,
        read: impl Fn(&S::At<'_>, &mut Vec<f64>) + Send + Sync + 'static,
    ) -> Self {
        Self {
            columns,
            readings: vec![Arc::new(read)],
        }
    }

    /// Returns one channel by itself.
    pub fn single(column: Column, read: impl Fn(&S::At<'_>) -> f64 + Send + Sync + 'static) -> Self {
        Self::new(vec![column], move |seen, row| row.push(read(seen)))
    }

    /// Adds channels after these.
    pub fn extend(&mut self, others: Self) {
        self.columns.extend(others.columns);
        self.readings.extend(others.readings);
    }

    /// Adds a channel; `frame` names the axes of its components.
    pub fn add(
        &mut self,
        name: impl Into<String>,
        kind: Kind,
        frame: &'static str,
        text: impl Into<String>,
        read: impl Fn(&S::At<'_>) -> f64 + Send + Sync + 'static,
    ) {
        self.extend(Self::single(Column::new(name, kind, frame, text), read));
    }

    /// Appends the values, SI.
    pub fn read(&self, seen: &S::At<'_>, row: &mut Vec<f64>) {
        for read in &self.readings {
            read(seen, row);
        }
    }
}

impl<L: 'static> Channels<WithLoads<L>> {
    /// Adds the sum of entries of the energy ledger, by their places among the energy terms.
    pub fn add_energy(
        &mut self,
        name: impl Into<String>,
        frame: &'static str,
        text: impl Into<String>,
        places: Vec<usize>,
    ) {
        self.add(name, Kind::Energy, frame, text, move |seen: &Seen<'_, L>| {
            let terms = places.iter().map(|place| seen.observation.quadratures[*place]);
            terms.sum()
        });
    }

    /// Adds the change of the stored energy.
    pub fn add_stored(&mut self, frame: &'static str) {
        let text = "energy stored, less that at the start";
        self.add(
            "stored_energy_change",
            Kind::Energy,
            frame,
            text,
            |seen: &Seen<'_, L>| seen.observation.energies.total() - seen.start_energy,
        );
    }

    /// Adds what is left over in the energy ledger.
    pub fn add_residual(&mut self, frame: &'static str) {
        let text = "work less stored energy and losses";
        self.add(
            "ledger_residual",
            Kind::Energy,
            frame,
            text,
            |seen: &Seen<'_, L>| -seen.observation.residual(seen.start_energy),
        );
    }
}
