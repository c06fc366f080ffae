//! Many runs at a time: any number of workers gives the same results in the same order.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;
use std::time::Duration;

use pyo3::prelude::*;
use study::models::{AnyCase, AnySummary};
use study::result::RunResult;

use crate::model_case::of_python;
use crate::outcome::NativeResult;
use crate::run::{Failure, table};

/// The interval of asking Python for signals.
const INTERVAL: Duration = Duration::from_millis(50);

/// A result or the exception that stands for it.
type Slot = Result<RunResult<AnySummary>, Failure>;

/// Runs cases on `workers` threads; the list has a result or an exception for each, in their order.
/// `progress` is called with how many are done.
#[pyfunction]
#[pyo3(signature = (cases, workers, columns, progress))]
pub fn run_many(
    py: Python<'_>,
    cases: Vec<Bound<'_, PyAny>>,
    workers: usize,
    columns: Option<Vec<String>>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Vec<Py<PyAny>>> {
    let work: Vec<AnyCase> = cases.iter().map(of_python).collect::<PyResult<_>>()?;
    let slots = py.detach(|| all(&work, workers, columns.as_deref(), progress.as_ref()))?;
    let results = work.iter().zip(slots).map(|(work, slot)| match slot {
        Some(Ok(table)) => Ok(Py::new(py, NativeResult::new(work.clone(), table))?.into_any()),
        Some(Err(failure)) => Ok(failure.error(py, work.name()).into_value(py).into_any()),
        None => {
            let lost = Failure::Panic("a worker was lost".to_owned());
            Ok(lost.error(py, work.name()).into_value(py).into_any())
        }
    });
    results.collect()
}

/// Runs all, telling Python of it; an exception there (Ctrl-C) ends all runs within a step each.
fn all(
    work: &[AnyCase],
    workers: usize,
    columns: Option<&[String]>,
    progress: Option<&Py<PyAny>>,
) -> PyResult<Vec<Option<Slot>>> {
    let (next, cancelled) = (AtomicUsize::new(0), AtomicBool::new(false));
    let slots: Vec<Mutex<Option<Slot>>> = work.iter().map(|_| Mutex::new(None)).collect();
    let (done, finished) = mpsc::channel::<()>();
    let said = thread::scope(|scope| {
        for _ in 0..workers.clamp(1, work.len().max(1)) {
            let done = done.clone();
            let (next, cancelled, slots) = (&next, &cancelled, &slots);
            scope.spawn(move || {
                while !cancelled.load(Ordering::Relaxed) {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let (Some(work), Some(slot)) = (work.get(index), slots.get(index)) else {
                        return;
                    };
                    let go_on = |_: f64| match cancelled.load(Ordering::Relaxed) {
                        true => ControlFlow::Break(()),
                        false => ControlFlow::Continue(()),
                    };
                    let result = table(work, columns, go_on);
                    *slot.lock().unwrap_or_else(PoisonError::into_inner) = Some(result);
                    // Nobody listens only when all is cancelled.
                    let _ = done.send(());
                }
            });
        }
        drop(done);
        let said = listen(&finished, progress);
        if said.is_err() {
            cancelled.store(true, Ordering::Relaxed);
        }
        said
    });
    said?;
    let slots = slots.into_iter();
    Ok(slots
        .map(|slot| slot.into_inner().unwrap_or_else(PoisonError::into_inner))
        .collect())
}

/// Until all workers have ended: passes on how many runs are done, and hears signals.
fn listen(finished: &mpsc::Receiver<()>, progress: Option<&Py<PyAny>>) -> PyResult<()> {
    let (mut count, mut reported) = (0_usize, 0_usize);
    loop {
        let ended = match finished.recv_timeout(INTERVAL) {
            Ok(()) => {
                count += 1;
                // Many short runs: take all that have ended.
                count += finished.try_iter().count();
                // So that they are not reported one by one.
                thread::sleep(Duration::from_millis(2));
                false
            }
            Err(mpsc::RecvTimeoutError::Timeout) => false,
            Err(mpsc::RecvTimeoutError::Disconnected) => true,
        };
        Python::attach(|py| {
            py.check_signals()?;
            if let Some(progress) = progress.filter(|_| count > reported || ended) {
                reported = count;
                progress.call1(py, (count,))?;
            }
            PyResult::Ok(())
        })?;
        if ended {
            return Ok(());
        }
    }
}
