//! The values of a variant.

use super::{LatinHypercube, Sampling, Sobol, Study, Value};

/// Returns the values of a variant, one a factor.
pub(super) fn of(study: &Study, number: u64) -> Vec<Option<Value>> {
    let factors = &study.factors;
    match &study.sampling {
        Sampling::FullFactorial => {
            let mut rest = number;
            let mut values: Vec<Option<Value>> = factors
                .iter()
                .rev()
                .map(|factor| {
                    let count = factor.count().max(1);
                    let value = factor.level(rest % count);
                    rest /= count;
                    Some(value)
                })
                .collect();
            values.reverse();
            values
        }
        Sampling::LatinHypercube { runs, seed } => {
            let hypercube = LatinHypercube::new(*runs, *seed);
            let all = factors.iter().enumerate();
            all.map(|(dimension, factor)| Some(factor.at(hypercube.coordinate(number, dimension))))
                .collect()
        }
        Sampling::Sobol { seed, .. } => {
            let sobol = Sobol::new(factors.len(), *seed);
            let all = factors.iter().enumerate();
            all.map(|(dimension, factor)| Some(factor.at(sobol.coordinate(number, dimension))))
                .collect()
        }
        Sampling::List => {
            let row = usize::try_from(number)
                .ok()
                .and_then(|number| study.list.get(number));
            row.cloned().unwrap_or_else(|| vec![None; factors.len()])
        }
    }
}
