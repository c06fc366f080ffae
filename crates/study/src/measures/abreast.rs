//! Runs measured side by side, so that their right-hand sides are evaluated at once. What comes out of a run is what comes out
//! of it alone.

use std::panic::{AssertUnwindSafe, catch_unwind};

use integrate::{Team, Together};
use mechanics::system::{Abreast, System};

use super::measuring::{Begun, Measuring};
use super::{Measures, Unmeasured, measure};
use crate::case::Case;

/// Teams that wait for runs of their kind. When there are more kinds, the oldest team makes its runs and goes.
const MOST_TEAMS: usize = 8;

/// What became of a run; none: it was lost by a mistake of ours, its own or that of a run beside it.
pub(crate) type Over = Option<Result<Measures, Unmeasured>>;

/// Measures cases side by side.
#[must_use]
pub fn measure_all(cases: &[Case]) -> Vec<Result<Measures, Unmeasured>> {
    let mut found: Vec<Over> = vec![None; cases.len()];
    let mut keys = 0..cases.len();
    abreast(
        &mut || keys.next(),
        &|key| Begun::new(&cases[key]),
        &mut |key, over| {
            found[key] = over;
        },
    );
    let found = found.into_iter().zip(cases);
    found
        .map(|(over, case)| over.unwrap_or_else(|| measure(case)))
        .collect()
}

/// Measures the runs of all keys that come, side by side with others of their kind, and gives each one as soon as it is over.
///
/// A run goes to the first team that admits it; while that one is full, it makes its steps until it has room. When no keys come
/// any more, the runs under way are finished.
pub(crate) fn abreast<K: Copy>(
    next: &mut dyn FnMut() -> Option<K>,
    begin: &dyn Fn(K) -> Result<Begun, Unmeasured>,
    over: &mut dyn FnMut(K, Over),
) {
    let mut groups: Vec<Group<K>> = Vec::new();
    while let Some(key) = next() {
        match careful(|| begin(key)) {
            Some(Ok(begun)) => enter(&mut groups, key, begun, over),
            failed => over(key, failed.map(|begun| begun.and_then(Begun::finish))),
        }
    }
    for group in groups {
        group.finish(over);
    }
}

/// What a function gives, or none if it panics.
fn careful<T>(function: impl FnOnce() -> T) -> Option<T> {
    catch_unwind(AssertUnwindSafe(function)).ok()
}

/// Brings a run into a group of its kind.
fn enter<K: Copy>(groups: &mut Vec<Group<K>>, key: K, begun: Begun, over: &mut dyn FnMut(K, Over)) {
    loop {
        let system = begun.integrator.problem();
        let number = match careful(|| groups.iter().position(|group| group.admits(system))) {
            Some(Some(number)) => number,
            Some(None) => {
                let Some(Some(group)) = careful(|| Group::of(system)) else {
                    // Nobody can be beside it.
                    return over(key, careful(|| begun.finish()));
                };
                if groups.len() >= MOST_TEAMS {
                    groups.remove(0).finish(over);
                }
                groups.push(group);
                groups.len() - 1
            }
            None => return over(key, None),
        };
        let group = &mut groups[number];
        if let Some(place) = group.team.free_place() {
            if !group.put(place, key, begun) {
                groups.remove(number).lose(over);
            }
            return;
        }
        if !group.advance(over) {
            groups.remove(number).lose(over);
        }
    }
}

/// A team and what its runs measure.
struct Group<K> {
    team: Team<Abreast>,
    members: Vec<Option<(K, Measuring)>>,
}

impl<K: Copy> Group<K> {
    fn of(system: &System) -> Option<Self> {
        let together = Abreast::of(system)?;
        let members = (0..together.places()).map(|_| None).collect();
        let team = Team::new(together);
        team.free_place()?;
        Some(Self { team, members })
    }

    fn admits(&self, system: &System) -> bool {
        self.team.together().admits(system)
    }

    /// Puts a run into a place; false: something is wrong with us, and the group is to be given up.
    #[must_use]
    fn put(&mut self, place: usize, key: K, begun: Begun) -> bool {
        let Begun {
            measuring,
            integrator,
        } = begun;
        let limit = measuring.limit(&integrator);
        self.members[place] = Some((key, measuring));
        careful(|| self.team.put(place, integrator, limit)).is_some()
    }

    /// Makes steps until a run is over; false as for [`Group::put`].
    #[must_use]
    fn advance(&mut self, over: &mut dyn FnMut(K, Over)) -> bool {
        match careful(|| self.next_over()) {
            Some(Some((place, outcome))) => {
                if let Some((key, _)) = self.members[place].take() {
                    over(key, Some(outcome));
                }
                self.team.take(place);
                true
            }
            // With all places taken somebody must have got there.
            Some(None) => self.members.iter().all(Option::is_none),
            None => false,
        }
    }

    /// The next run that is over.
    fn next_over(&mut self) -> Option<(usize, Result<Measures, Unmeasured>)> {
        loop {
            let (place, outcome) = self.team.step()?;
            let ((_, measuring), integrator) = (self.members[place].as_mut()?, self.team.run(place)?);
            if let Err(error) = outcome {
                return Some((place, Err(Unmeasured::Stopped(error.to_string()))));
            }
            measuring.after_step(integrator);
            if integrator.time() >= measuring.end() {
                return Some((place, Ok(measuring.finish(integrator))));
            }
            let limit = measuring.limit(integrator);
            self.team.begin(place, limit);
        }
    }

    /// Finishes all runs.
    fn finish(mut self, over: &mut dyn FnMut(K, Over)) {
        while self.members.iter().any(Option::is_some) {
            if !self.advance(over) {
                return self.lose(over);
            }
        }
    }

    /// Gives up all runs.
    fn lose(self, over: &mut dyn FnMut(K, Over)) {
        for (key, _) in self.members.into_iter().flatten() {
            over(key, None);
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic)]
mod tests {
    use super::{Begun, Over, abreast, measure_all};
    use crate::case::Case;
    use crate::case::builtin::case_with;
    use crate::measures::measure;

    fn case(set: &[&str]) -> Case {
        let mut all = vec!["simulation.duration=0.05 s".to_owned()];
        all.extend(set.iter().map(|set| (*set).to_owned()));
        case_with("cdrun_toe_-0.2_psi_0.012", &all).unwrap()
    }

    /// A variant's case; by number.
    fn variant(number: usize) -> Case {
        case(&[&format!("friction.column={}", 0.3 + 0.01 * number as f64)])
    }

    #[test]
    fn limits_cases_side_by_side_have_the_measures_of_each_alone() {
        let mut cases: Vec<Case> = (0..7).map(variant).collect();
        cases.push(case(&[
            r#"wedge.inertia=["1e-300 lb in^2", "1e-300 lb in^2", "1e-300 lb in^2"]"#,
        ]));
        cases.push(case(&["friction.law=bristle"]));
        let found = measure_all(&cases);
        assert_eq!(found.len(), cases.len());
        for (found, case) in found.iter().zip(&cases) {
            assert_eq!(format!("{found:?}"), format!("{:?}", measure(case)));
        }
        assert!(found[7].is_err() && measure_all(&[]).is_empty());
    }

    /// One that begins with a panic costs itself; one that panics on its way costs those beside it, which are told apart.
    #[test]
    fn limits_a_mistake_of_ours_is_told_of_all_that_it_costs() {
        let begin = |number: usize| match number {
            1 => panic!("on purpose"),
            4 => Ok(Begun {
                // They do not belong together.
                measuring: Begun::new(&variant(4))?.measuring,
                integrator: Begun::new(&case(&["friction.law=bristle"]))?.integrator,
            }),
            number => Begun::new(&variant(number)),
        };
        let mut found: Vec<Vec<Over>> = vec![Vec::new(); 20];
        let mut keys = 0..20;
        abreast(&mut || keys.next(), &begin, &mut |number, over| {
            found[number].push(over);
        });
        for (number, found) in found.iter().enumerate() {
            let [over] = found.as_slice() else {
                panic!("run {number} is told {} times", found.len());
            };
            match over {
                Some(outcome) => {
                    let alone = measure(&variant(number));
                    assert_eq!(format!("{outcome:?}"), format!("{alone:?}"), "run {number}");
                }
                None => assert!(number < 9, "run {number}"),
            }
        }
        assert!(found[1][0].is_none() && found[4][0].is_none());
    }
}
