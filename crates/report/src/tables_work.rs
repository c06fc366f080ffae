//! The runs of tables, several at a time.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

use study::tables::rig::{self, Branches, Wanted};
use study::tables::{NestTables, TablesError, TablesRequest};

use crate::assessment_work::in_parallel;

/// Tables, and what the runs have warned of.
#[derive(Clone, Debug)]
pub struct TablesFindings {
    /// The tables.
    pub tables: NestTables,
    /// Warnings, each with the number of runs that have it, in the order in which runs were wanted.
    pub warnings: Vec<(String, usize)>,
    /// The number of runs.
    pub runs: usize,
}

/// Makes the runs of tables, `jobs` at a time; none if `go_on` stopped them. `done` hears of each run.
///
/// # Errors
/// A run that has no branches: no other begins after it.
pub fn run(
    request: &TablesRequest,
    jobs: usize,
    go_on: &(dyn Fn() -> ControlFlow<String> + Sync),
    done: &(dyn Fn() + Sync),
) -> Result<Option<TablesFindings>, TablesError> {
    // Results come in any order, and are put back into that of the runs.
    let wanted = request.wanted();
    let runs = wanted.len();
    let queue: Vec<(usize, Wanted)> = wanted.into_iter().enumerate().collect();
    let failed = AtomicBool::new(false);
    let mut found = in_parallel(queue.into(), jobs, |(number, wanted)| {
        let begins = go_on().is_continue() && !failed.load(Ordering::Relaxed);
        let own = begins.then(|| rig::run(&request.case, &wanted, go_on));
        if let Some(Err(_)) = own {
            failed.store(true, Ordering::Relaxed);
        }
        done();
        (number, own)
    });
    found.sort_by_key(|(number, _)| *number);
    if go_on().is_break() {
        return Ok(None);
    }
    let mut branches: Vec<Branches> = Vec::new();
    let mut warnings: Vec<(String, usize)> = Vec::new();
    for own in found.into_iter().filter_map(|(_, own)| own) {
        let (own, said) = own?;
        branches.push(own);
        for text in said {
            match warnings.iter_mut().find(|(known, _)| *known == text) {
                Some((_, count)) => *count += 1,
                None => warnings.push((text, 1)),
            }
        }
    }
    let tables = request.tables(&branches);
    Ok(tables.map(|tables| TablesFindings {
        tables,
        warnings,
        runs,
    }))
}
