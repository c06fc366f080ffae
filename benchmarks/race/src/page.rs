//! The page of the race, `docs/race.md`: text that stays, around the tables of the results that are stored
//! beside it (`docs/measured/race.json`). A whole race replaces these results; nobody edits the page.

use std::fmt::Write;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::contest::{COMMON_OPTIONS, SOLVERS};
use crate::runner::REFERENCE;
use crate::standings::Standing;
use crate::tables::{self, MarkdownTable};

/// Layout of the stored results.
const SCHEMA: &str = "wedgelab.race/1";
/// Errors up to which runs are of use in practice: the level of the table of cheapest runs.
const USEFUL: f64 = 1e-2;
/// The tolerance at which solvers are shown side by side, and which solvers.
const USUAL: (&str, [&str; 5]) = (
    "1e-6",
    [
        "wedgelab Rodas5P",
        "wedgelab ESDIRK3",
        "CVODE BDF",
        "diffsol BDF",
        "diffsol ESDIRK34",
    ],
);

/// All results that the page shows, the newest first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// [`SCHEMA`].
    schema: String,
    /// Races that were measured, each with solvers of its own.
    pub races: Vec<Race>,
}

/// A race that was measured.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Race {
    /// The solvers, in words.
    pub solvers: String,
    /// Date, machine and settings of the measurement.
    pub measured: MeasuredOn,
    /// Further remarks on these numbers; may be empty.
    pub remarks: Vec<String>,
    /// The ratios of the others' times to ours at equal error.
    pub ratios: MarkdownTable,
    /// Runs at one tolerance; empty where there are none.
    pub usual: MarkdownTable,
    /// Cheapest runs.
    pub cheapest: MarkdownTable,
    /// Failures.
    pub failures: MarkdownTable,
    /// Other tables, with their headings.
    pub others: Vec<(String, MarkdownTable)>,
}

/// Date, machine and settings of a measurement.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MeasuredOn {
    /// The date, such as 2026-11-23.
    pub date: String,
    /// The processor as it reports itself.
    pub machine: String,
    /// The number of processors.
    pub cores: String,
    /// The version of rustc.
    pub rustc: String,
    /// For which processors it was compiled.
    pub compiled_for: String,
    /// CPU time that a run was given, s.
    pub limit: String,
}

impl Results {
    /// Returns the results of one race over all cases and solvers.
    #[must_use]
    pub fn of(standings: &[Standing], measured: MeasuredOn) -> Self {
        let race = Race {
            solvers: "All solvers".to_owned(),
            measured,
            remarks: Vec::new(),
            ratios: tables::ratios(standings),
            usual: tables::at_tolerance(standings, USUAL.0, &USUAL.1),
            cheapest: tables::at_level(standings, USEFUL),
            failures: tables::failures(standings),
            others: Vec::new(),
        };
        Self {
            schema: SCHEMA.to_owned(),
            races: vec![race],
        }
    }

    /// Reads stored results.
    ///
    /// # Errors
    /// The file cannot be read, or holds something else.
    pub fn read(file: &Path) -> Result<Self, String> {
        let text = std::fs::read_to_string(file);
        let text = text.map_err(|error| format!("cannot read {}: {error}", file.display()))?;
        let found: Self = serde_json::from_str(&text)
            .map_err(|error| format!("{} holds no results of a race: {error}", file.display()))?;
        if found.schema != SCHEMA {
            return Err(format!(
                "{} has the schema {}; {SCHEMA} is expected",
                file.display(),
                found.schema
            ));
        }
        Ok(found)
    }

    /// Returns the results as stored.
    ///
    /// # Errors
    /// Never, with results that were made here.
    pub fn to_json(&self) -> Result<String, String> {
        let text = serde_json::to_string_pretty(self).map_err(|error| error.to_string())?;
        Ok(text + "\n")
    }

    /// Returns the page.
    #[must_use]
    pub fn page(&self) -> String {
        let mut text = format!("{ABOUT}\n## In short\n\n{}", summary(&self.races));
        text.push_str(FIGURES);
        for race in &self.races {
            let _ = write!(text, "\n## {}\n\n{}", race.solvers, race.heading());
            for (heading, table) in race.tables() {
                if !table.rows.is_empty() {
                    let _ = write!(text, "\n### {heading}\n\n{table}");
                }
            }
            let _ = write!(text, "\n{}", failed(&race.failures));
        }
        let _ = write!(text, "\n## Options\n\n{}", options());
        text
    }
}

impl Race {
    /// Returns date, machine and settings of the measurement, with the remarks.
    fn heading(&self) -> String {
        let MeasuredOn {
            date,
            machine,
            cores,
            rustc,
            compiled_for,
            limit,
        } = &self.measured;
        let mut text = format!(
            "Measured on {date}: {machine}, {cores} cores, rustc {rustc}, compiled for {compiled_for}; \
             {limit} s of CPU time a run at most.\n"
        );
        for remark in &self.remarks {
            let _ = write!(text, "\n{remark}\n");
        }
        text
    }

    fn tables(&self) -> impl Iterator<Item = (&str, &MarkdownTable)> {
        let own = [
            (
                "How many times longer the others take at equal error",
                &self.ratios,
            ),
            (
                "All at a tolerance of 1e-6, with yaw: time, error of force histories",
                &self.usual,
            ),
            (
                "Each solver's cheapest run with an error of at most 1 %",
                &self.cheapest,
            ),
        ];
        let others = self
            .others
            .iter()
            .map(|(heading, table)| (heading.as_str(), table));
        own.into_iter().chain(others)
    }
}

/// The text before all numbers.
const ABOUT: &str = "\
# The race

Our integrator and the solvers of others on the same equations: how much CPU time each takes for the same \
error.
`cargo xtask race` measures everything and writes this page; `cargo xtask race --page` writes it anew from \
the stored results
(`docs/measured/race.json`). Both take the text from `benchmarks/race/src/page.rs`: edit it there.

## What is measured

- **Cases**: the twelve runs of the thesis, a planar wedge with variable and with constant damping, and a \
stick test with bristles and with tanh. The equations
  are those of this project: nothing here says how a solver does on others.
- **Equations**: all solvers get the same compiled right-hand side and the same analytic Jacobian matrix. \
SciPy and Octave call them from their languages, which is where
  most of their time goes. On the yawed cases Octave's ode15s also runs with the right-hand side in Octave's \
own language (`wedge_rates.m`, vectorized over the eight contacts)
  and a Jacobian matrix by its own differences.
- **Times** are CPU times of the integration alone, the least of up to five repetitions, on a machine that \
may do other things: trust ratios of 1.5 and more
  within one race. Right-hand sides that our output times take (two in a hundred) are in the times, but not \
in the counts.
- **Errors** are those of force histories where a motion converges (with yaw, planar with constant damping), \
of positions in the stick test. The other cases ring and are chaotic
  in detail: there, branch means and the energy per cycle are compared, each run is made from several \
starts, a hundredth of a millimeter apart, and the error is the root mean square over them.
- **The floor** of a case is how well its reference is known: how far the reference's solver at 1e-9 and \
1e-10 is from itself at 1e-11. With several starts, the floor includes twice the
  scatter of a root mean square. Nearer to the floor, luck decides.
- **Octave's ode15s** gets one second of simulated time and is compared with ours over the same second, \
whose first part is the release from the start.
- **The drivers of the other solvers are ours** (`benchmarks/race/drivers`, \
`benchmarks/race/src/diffsol.rs`). Who knows a solver better may set it better.

## What is not the same for all

- Ours integrates all energies of the ledger; the others integrate one energy.
- Ours alone is told where contacts open and close and where slip reverses. Its Rosenbrock methods end their \
steps there; its TR-BDF2 and ESDIRK3 keep Jacobian matrices in between and look there for reversals in \
Newton's method.
- No solver records when contacts change, except ours where its name says so, as in users' runs.

## What a tolerance means

The absolute tolerance of each state is the tolerance times the state's scale; there is no relative \
tolerance. It means to each solver what it means to it:

| solver | what the tolerance bounds |
|---|---|
| our Rosenbrock methods | the error estimate of a step in all states, energies of the ledger too. From 1e-3 \
to 1e-5 they do more than they are asked to: speeds are held to the reference speed of friction (0.001 in/s) \
where a point sticks, and the wedge's positions to 1e-6 m |
| our TR-BDF2, ESDIRK3 | the error estimate of a step in displacements alone; steps end at the output times. \
They damp the vibrations of contacts: where these carry the force (variable damping without yaw), both are \
off until the tolerance resolves them |
| CVODE, diffsol, SciPy, ode15s | the error estimate of a step in all their states, in the norm of each \
solver |
| Exudyn | nothing: its steps are fixed |

Equal tolerances are therefore not equal errors: compare at equal error. The compiled solvers run at 3e-4, \
3e-5, ... 3e-8 besides the decades.

## How to read the tables

- A **ratio** is the CPU time of another solver over that of ours at equal error, each solver at its best \
tolerance. Levels of error are 3e-2 to 1e-7, as far as the floor allows: a cell gives the least ratio, the \
error at
  which it occurs, and the greatest ratio. Above 1, ours is faster.
- \"Never as exact\": no run of that solver reached an error that ours reached, within its CPU time.
- The table of cheapest runs shows what an error of 1 % costs: tolerance, error, time, steps, evaluations. \
\"Times ours\" is over our best.
";

/// The figures.
const FIGURES: &str = "
![Work-precision: CPU time over error of the six yawed cases](figures/race_yawed.svg)

![Work-precision: branch means and energy per cycle without yaw](figures/race_ringing.svg)

![Work-precision: the planar wedge and the stick test](figures/race_others.svg)

![Work-precision: the first second, ours and Octave's ode15s with compiled equations and with equations in \
Octave](figures/race_short.svg)
";

/// Returns a cell of the table of ratios, `219.4 (at 3e-2) to 219.4`, as its least and its greatest ratio.
fn ratio(cell: &str) -> Option<(f64, f64)> {
    let (least, rest) = cell.split_once(" (at ")?;
    let (_, most) = rest.split_once(") to ")?;
    Some((least.parse().ok()?, most.parse().ok()?))
}

/// For each of the others the ratios over all cases.
fn summary(races: &[Race]) -> String {
    let mut table = MarkdownTable {
        head: [
            "others",
            "cases compared",
            "least ratio",
            "on",
            "greatest ratio",
            "on",
        ]
        .map(str::to_owned)
        .to_vec(),
        rows: Vec::new(),
    };
    for race in races {
        // After case and floor.
        for (place, name) in race.ratios.head.iter().enumerate().skip(2) {
            let rows = race.ratios.rows.iter();
            let found: Vec<(&str, (f64, f64))> = rows
                .filter_map(|row| Some((row[0].as_str(), ratio(&row[place])?)))
                .collect();
            let least = found.iter().min_by(|a, b| a.1.0.total_cmp(&b.1.0));
            let most = found.iter().max_by(|a, b| a.1.1.total_cmp(&b.1.1));
            let (Some((on_least, (least, _))), Some((on_most, (_, most)))) = (least, most) else {
                continue;
            };
            let name = match name.as_str() {
                "the same, equations in Octave" => "Octave ode15s with equations in Octave",
                name => name,
            };
            table.rows.push(vec![
                name.to_owned(),
                found.len().to_string(),
                format!("{least:.1}"),
                (*on_least).to_owned(),
                format!("{most:.1}"),
                (*on_most).to_owned(),
            ]);
        }
    }
    format!("How many times longer the others take than ours at equal error:\n\n{table}")
}

/// Failures, a line for each solver.
fn failed(failures: &MarkdownTable) -> String {
    let mut solvers: Vec<(&str, Vec<String>)> = Vec::new();
    for row in &failures.rows {
        let [case, solver, tolerances, why] = row.as_slice() else {
            continue;
        };
        let spared = if why.starts_with("not tried") {
            " (not tried after these)"
        } else {
            ""
        };
        let text = format!("{case} at {tolerances}{spared}");
        match solvers.iter_mut().find(|(own, _)| *own == solver.as_str()) {
            Some((_, texts)) => texts.push(text),
            None => solvers.push((solver, vec![text])),
        }
    }
    if solvers.is_empty() {
        return "No run failed.\n".to_owned();
    }
    let table = MarkdownTable {
        head: vec!["solver".to_owned(), "out of time".to_owned()],
        rows: solvers
            .into_iter()
            .map(|(solver, texts)| vec![solver.to_owned(), texts.join("; ")])
            .collect(),
    };
    format!("### Runs that did not come to their end\n\nAll other runs did.\n\n{table}")
}

/// Returns the options of every solver.
fn options() -> String {
    let mut text = format!(
        "All: {COMMON_OPTIONS}; reference: {} at {}.\n\n| solver | options beyond its defaults |\n\
         |---|---|\n",
        REFERENCE.0, REFERENCE.1
    );
    for solver in SOLVERS {
        let _ = writeln!(text, "| {} | {} |", solver.name, solver.options);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_cells_of_ratios_are_read_back() {
        assert_eq!(ratio("219.4 (at 3e-2) to 220.1"), Some((219.4, 220.1)));
        assert_eq!(ratio("never as exact"), None);
        assert_eq!(ratio("-"), None);
    }
}
