//! The flow of energy through a cycle: what a power flow figure (Sankey diagram) shows.

use super::{EnergySummary, STATES};
use crate::summary_value::SummaryValue;

/// A loss smaller than this share of the inflow is added to others.
const SMALL: f64 = 0.01;
/// Endings of the names of friction's dissipation terms.
const FRICTION: [&str; 3] = ["friction_loss", "wedge_column_loss", "wedge_slope_loss"];

/// A flow: its name in words, and its energy each cycle, in the unit of the summary; never negative.
#[derive(Clone, Debug, PartialEq)]
pub struct Flow {
    /// Its name.
    pub name: String,
    /// Its energy each cycle.
    pub energy: f64,
    /// The part of it lost in friction by contact state ([`STATES`]).
    pub by_state: [f64; STATES.len()],
}

/// Energies each cycle: from where to where.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PowerFlow {
    /// Unit of the energies.
    pub unit: String,
    /// Inflows: work, and stored energy that is given back.
    pub inflows: Vec<Flow>,
    /// Outflows: losses, energy that is stored, work done on the surroundings.
    pub outflows: Vec<Flow>,
    /// Inflow less outflow: the ledger's residual over a cycle.
    pub residual: f64,
}

impl PowerFlow {
    /// Returns the flows of a cycle; `None` if there are no energies or nothing flows.
    #[must_use]
    pub fn of(summary: &EnergySummary) -> Option<Self> {
        let unit = summary.loss.as_ref()?.unit.clone();
        let mut flow = Self {
            unit,
            residual: summary.residual.as_ref()?.value,
            ..Self::default()
        };
        for (name, work) in &summary.supplied {
            flow.add(words(name), work.value, [0.0; STATES.len()]);
        }
        for (name, change) in &summary.stored_change {
            let verb = if change.value > 0.0 {
                "stored"
            } else {
                "given back"
            };
            flow.add(
                format!("{name} energy {verb}"),
                -change.value,
                [0.0; STATES.len()],
            );
        }
        for (name, loss) in &summary.losses {
            let value = |own: Option<&SummaryValue>| own.map_or(0.0, |own| own.value);
            let friction = FRICTION.contains(&loss.kind.as_str());
            let by_state = STATES.map(|state| {
                let own = value(loss.by_state.get(state));
                if friction { own.max(0.0) } else { 0.0 }
            });
            flow.add(words(name), -value(loss.total.as_ref()), by_state);
        }
        let inflow = flow.inflow();
        if inflow <= 0.0 {
            return None;
        }
        gather(&mut flow.inflows, inflow);
        gather(&mut flow.outflows, inflow);
        Some(flow)
    }

    /// Returns the sum of all that flows in.
    #[must_use]
    pub fn inflow(&self) -> f64 {
        self.inflows.iter().map(|flow| flow.energy).sum()
    }

    /// Returns the sum of all that flows out.
    #[must_use]
    pub fn outflow(&self) -> f64 {
        self.outflows.iter().map(|flow| flow.energy).sum()
    }

    /// Adds an energy that flows in, or out if it is negative.
    fn add(&mut self, name: String, energy: f64, by_state: [f64; STATES.len()]) {
        if energy == 0.0 {
            return;
        }
        let side = if energy > 0.0 {
            &mut self.inflows
        } else {
            &mut self.outflows
        };
        side.push(Flow {
            name,
            energy: energy.abs(),
            by_state,
        });
    }
}

/// Puts flows in the order of their sizes, the small ones together at the end.
fn gather(flows: &mut Vec<Flow>, whole: f64) {
    flows.sort_by(|a, b| b.energy.total_cmp(&a.energy));
    let large = flows.partition_point(|flow| flow.energy >= SMALL * whole);
    if flows.len() - large < 2 {
        return;
    }
    let small = flows.split_off(large);
    let by_state = std::array::from_fn(|state| small.iter().map(|flow| flow.by_state[state]).sum());
    flows.push(Flow {
        name: format!("{} others, each below 1 %", small.len()),
        energy: small.iter().map(|flow| flow.energy).sum(),
        by_state,
    });
}

/// Returns the name of an entry of the ledger in words.
#[must_use]
pub fn words(name: &str) -> String {
    let name = name.strip_suffix("_loss").unwrap_or(name);
    // The kind of a coil's term begins as the coil is called.
    let name = name
        .strip_prefix("coil_")
        .filter(|rest| rest.starts_with("coil_"))
        .unwrap_or(name);
    match name {
        "motion_work" => "work of motions and loads".to_owned(),
        _ => name.replace('_', " "),
    }
}
