//! Subset simulation: a small probability as a product of larger ones.
//!
//! S. K. Au and J. L. Beck, *Estimation of small failure probabilities in high dimensions by subset
//! simulation*, Probabilistic Engineering Mechanics 16 (2001). The samples of a level are those beyond
//! the threshold of the level before it: the value of the best sample outside of that level's best share.
//! They are walked from this share by Markov chains: with conditional sampling in the standard normal
//! space, whose steps adapt towards an acceptance of 44 % (I. Papaioannou et al., *MCMC algorithms for
//! subset simulation*, same journal 41 (2015)).
//!
//! The chains' samples depend on each other, so that the scatter within one simulation tells its error
//! poorly. It is repeated independently, and the bounds come from the repeats
//! ([`bounds::mean_of_lognormal`](super::bounds::mean_of_lognormal)).
//!
//! Limits: the value must change gradually (a count of 0 or 1 leads nowhere); failure regions that the first
//! levels do not hint at are missed. A derailment, or a run
//! without a value, counts as beyond every threshold: the walk includes it, and the least probability takes
//! the share of runs without a value out again.

use serde::Serialize;

use super::sample::normal_value;
use super::{Answer, Evaluate, Goal};

/// The acceptance of steps that is aimed at (Papaioannou et al., 2015).
const ACCEPTANCE: f64 = 0.44;
/// The first size of steps, of the standard deviation (the same).
const FIRST_STEP: f64 = 0.6;

/// Settings of subset simulation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Subset {
    /// Samples of a level: a multiple of `parts`.
    pub samples: usize,
    /// One sample of so many begins a chain of the next level: the inverse of the level's probability.
    pub parts: usize,
    /// Independent repeats.
    pub repeats: usize,
    /// Greatest number of levels.
    pub levels: usize,
    /// The seed.
    pub seed: u64,
    /// Greatest number of runs, all repeats together.
    pub most_runs: u64,
}

/// A level of a repeat.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Level {
    /// The value that the samples of the next level reach, in the measure's sense; missing where runs
    /// without a value set it.
    pub threshold: Option<f64>,
    /// The probability to reach it.
    pub probability: f64,
    /// The share of steps accepted on the way to these samples; missing in the first level.
    pub accepted: Option<f64>,
}

/// The end of a repeat.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RepeatEnd {
    /// It reached the limit.
    Reached,
    /// The greatest number of levels was used up before.
    Levels,
    /// The greatest number of runs was used up before.
    Runs,
    /// The best samples of a level have one value: there is no threshold among them.
    Stalled,
}

/// What one simulation comes to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Repeat {
    /// Its levels; the last one ends at the limit if that was reached.
    pub levels: Vec<Level>,
    /// Its end.
    pub end: RepeatEnd,
    /// The probability: runs without a value as beyond the limit. Where the limit was not reached, that of
    /// the last threshold.
    pub probability: f64,
    /// The same, runs without a value as within the limit; zero where the limit was not reached.
    pub least: f64,
}

#[derive(Clone)]
struct Sample {
    point: Vec<f64>,
    score: f64,
    known: bool,
}

/// A simulation under way.
struct Walk {
    number: u64,
    samples: Vec<Sample>,
    levels: Vec<Level>,
    probability: f64,
    /// The score that samples of this level exceed.
    threshold: f64,
    step: f64,
    accepted: Option<f64>,
    end: Option<Repeat>,
}

/// Runs all repeats, whose points of one step are evaluated at a time.
///
/// # Errors
/// The evaluator's.
pub fn simulate<E>(
    settings: &Subset,
    goal: Goal,
    dimensions: usize,
    evaluate: &mut Evaluate<'_, E>,
) -> Result<Vec<Repeat>, E> {
    let mut runs = 0;
    let mut walks: Vec<Walk> = (0..settings.repeats as u64).map(Walk::new).collect();
    let first: Vec<Vec<f64>> = walks
        .iter()
        .flat_map(|walk| (0..settings.samples as u64).map(move |number| (walk.number, number)))
        .map(|(repeat, number)| random(settings.seed, &[repeat, 0, 0, number], dimensions))
        .collect();
    runs += first.len() as u64;
    let answers = evaluate(&first)?;
    let mut all = first
        .into_iter()
        .zip(answers)
        .map(|(point, answer)| Sample::new(point, answer, goal));
    for walk in &mut walks {
        walk.samples.extend(all.by_ref().take(settings.samples));
    }
    let seeds = settings.samples / settings.parts;
    loop {
        for walk in walks.iter_mut().filter(|walk| walk.end.is_none()) {
            walk.close_level(settings, goal);
        }
        let mut active: Vec<&mut Walk> = walks.iter_mut().filter(|walk| walk.end.is_none()).collect();
        if active.is_empty() {
            break;
        }
        let needed = (active.len() * (settings.samples - seeds)) as u64;
        if runs + needed > settings.most_runs {
            for walk in active {
                walk.finish(RepeatEnd::Runs);
            }
            break;
        }
        runs += needed;
        for walk in &mut active {
            walk.begin_chains(seeds);
        }
        let mut accepted = vec![0_usize; active.len()];
        for step in 1..settings.parts {
            let mut points = Vec::with_capacity(active.len() * seeds);
            for walk in &active {
                let level = walk.levels.len() as u64;
                // The chains' last samples are the last ones.
                let heads = &walk.samples[walk.samples.len() - seeds..];
                for (chain, head) in heads.iter().enumerate() {
                    let noise = [walk.number, level, step as u64, chain as u64];
                    let noise = random(settings.seed, &noise, dimensions);
                    points.push(walk.candidate(&head.point, &noise));
                }
            }
            let answers = evaluate(&points)?;
            let mut all = points
                .into_iter()
                .zip(answers)
                .map(|(point, answer)| Sample::new(point, answer, goal));
            for (walk, accepted) in active.iter_mut().zip(&mut accepted) {
                let now = walk.take_step(all.by_ref().take(seeds).collect());
                *accepted += now;
                let share = now as f64 / seeds as f64;
                walk.step *= libm::exp((share - ACCEPTANCE) / (step as f64).sqrt());
                walk.step = walk.step.min(1.0);
            }
        }
        for (walk, accepted) in active.iter_mut().zip(accepted) {
            walk.accepted = Some(accepted as f64 / (settings.samples - seeds) as f64);
        }
    }
    Ok(walks.into_iter().filter_map(|walk| walk.end).collect())
}

fn random(seed: u64, numbers: &[u64; 4], dimensions: usize) -> Vec<f64> {
    let [a, b, c, d] = *numbers;
    (0..dimensions as u64)
        .map(|dimension| normal_value(seed, &[a, b, c, d, dimension]))
        .collect()
}

impl Sample {
    fn new(point: Vec<f64>, answer: Answer, goal: Goal) -> Self {
        Self {
            point,
            score: goal.score(answer),
            known: answer != Answer::Unknown,
        }
    }
}

impl Walk {
    fn new(number: u64) -> Self {
        Self {
            number,
            samples: Vec::new(),
            levels: Vec::new(),
            probability: 1.0,
            threshold: f64::NEG_INFINITY,
            step: FIRST_STEP,
            accepted: None,
            end: None,
        }
    }

    /// Ends the level: at the limit if more samples than its best share are beyond it, else at the threshold,
    /// beyond which the best share is. The sample that sets the threshold is not among those beyond it: if it
    /// were, the probability would be too large by several percent (C.-E. Bréhier et al., *Unbiasedness of
    /// some generalized adaptive multilevel splitting algorithms*, Annals of Applied Probability 26 (2016)).
    fn close_level(&mut self, settings: &Subset, goal: Goal) {
        let count = self.samples.len();
        let seeds = count / settings.parts;
        let beyond = self.samples.iter().filter(|own| own.score > goal.score_limit());
        let (beyond, known) = beyond.fold((0, 0), |(all, known), own| {
            (all + 1, known + usize::from(own.known))
        });
        if beyond > seeds {
            let before = self.probability;
            self.push(goal, goal.score_limit(), beyond as f64 / count as f64);
            let least = before * known as f64 / count as f64;
            self.end = Some(self.repeat(RepeatEnd::Reached, least));
            return;
        }
        // Stable: equal values stay in the order in which they were computed.
        self.samples.sort_by(|a, b| b.score.total_cmp(&a.score));
        let threshold = self.samples[seeds].score;
        let better = self
            .samples
            .iter()
            .take_while(|own| own.score > threshold)
            .count();
        self.samples.truncate(better);
        if better == 0 {
            self.finish(RepeatEnd::Stalled);
            return;
        }
        self.threshold = threshold;
        self.push(goal, threshold, better as f64 / count as f64);
        if self.levels.len() >= settings.levels {
            self.finish(RepeatEnd::Levels);
        }
    }

    fn push(&mut self, goal: Goal, threshold: f64, share: f64) {
        self.probability *= share;
        self.levels.push(Level {
            threshold: Some(goal.value(threshold)).filter(|own| own.is_finite()),
            probability: self.probability,
            accepted: self.accepted,
        });
    }

    fn finish(&mut self, end: RepeatEnd) {
        self.end = Some(self.repeat(end, 0.0));
    }

    fn repeat(&self, end: RepeatEnd, least: f64) -> Repeat {
        Repeat {
            levels: self.levels.clone(),
            end,
            probability: self.probability,
            least,
        }
    }

    /// Makes as many beginnings of chains from the samples beyond the threshold, which are fewer where values
    /// are equal.
    fn begin_chains(&mut self, seeds: usize) {
        let better = self.samples.len();
        for number in better..seeds {
            let again = self.samples[number % better].clone();
            self.samples.push(again);
        }
    }

    fn candidate(&self, from: &[f64], noise: &[f64]) -> Vec<f64> {
        let keep = (1.0 - self.step * self.step).sqrt();
        from.iter()
            .zip(noise)
            .map(|(from, noise)| keep * from + self.step * noise)
            .collect()
    }

    /// Appends the next sample of each chain: the candidate where it lies beyond the threshold, else the
    /// last one again. Returns the number of those accepted.
    fn take_step(&mut self, candidates: Vec<Sample>) -> usize {
        let start = self.samples.len() - candidates.len();
        let mut accepted = 0;
        for (chain, candidate) in candidates.into_iter().enumerate() {
            let next = if candidate.score > self.threshold {
                accepted += 1;
                candidate
            } else {
                self.samples[start + chain].clone()
            };
            self.samples.push(next);
        }
        accepted
    }
}
