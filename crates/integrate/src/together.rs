//! Several runs whose right-hand sides are evaluated at once.
//!
//! A run alone waits for each of its evaluations. In a [`Team`] every run goes on until it wants one, and then all that are wanted
//! are evaluated [`Together`]: they are alike, `(t, x)` to `f(t, x)`, wherever in its step and by whatever method each run is. What
//! comes out of a run has the same bits, whoever is beside it.

use std::marker::PhantomData;

use crate::error::StepError;
use crate::problem::Problem;
use crate::rosenbrock::{Call, Integrator, Progress};

/// The largest number of places in a team.
pub const MOST_PLACES: usize = 4;

/// Evaluates the right-hand sides of several problems of one kind at once, each with the bits of its [`Problem::derivative`].
pub trait Together {
    /// The kind of problem.
    type Problem: Problem;

    /// How many problems there is place for; no more than [`MOST_PLACES`] are used.
    fn places(&self) -> usize;

    /// Takes a problem's parameters into a place, before any call from there. What changes while it is integrated, as its
    /// [`Problem::segment`] does, is to be read from the problem of each call.
    fn put(&mut self, place: usize, problem: &Self::Problem);

    /// Evaluates all calls, one a place; none: nothing is wanted there.
    fn derivatives(&mut self, calls: &mut [Option<Call<'_, Self::Problem>>]);
}

/// Evaluates one after the other: for problems that bring nothing better.
pub struct OneByOne<P> {
    places: usize,
    problem: PhantomData<fn(P)>,
}

impl<P> OneByOne<P> {
    /// With so many places.
    #[must_use]
    pub fn new(places: usize) -> Self {
        Self {
            places,
            problem: PhantomData,
        }
    }
}

impl<P: Problem> Together for OneByOne<P> {
    type Problem = P;

    fn places(&self) -> usize {
        self.places
    }

    fn put(&mut self, _: usize, _: &P) {}

    fn derivatives(&mut self, calls: &mut [Option<Call<'_, P>>]) {
        for call in calls.iter_mut().flatten() {
            call.evaluate();
        }
    }
}

/// What a run in a team does.
enum Stand {
    /// It has no step to make.
    Rests,
    /// It can go on.
    Goes,
    /// It waits for its right-hand side.
    Waits,
    /// Its step could not begin.
    Failed(StepError),
}

struct Member<P: Problem> {
    integrator: Integrator<P>,
    stand: Stand,
}

impl<P: Problem> Member<P> {
    fn begin(&mut self, limit: f64) {
        self.stand = match self.integrator.begin_step(limit) {
            Ok(()) => Stand::Goes,
            Err(error) => Stand::Failed(error),
        };
    }

    /// Goes on with the step; what became of it, if it is over.
    #[inline]
    fn go_on(&mut self) -> Option<Result<(), StepError>> {
        let over = match std::mem::replace(&mut self.stand, Stand::Rests) {
            Stand::Goes => match self.integrator.go_on() {
                Ok(Progress::Wants) => {
                    self.stand = Stand::Waits;
                    return None;
                }
                Ok(Progress::Accepted) => Ok(()),
                Err(error) => Err(error),
            },
            Stand::Failed(error) => Err(error),
            stand @ (Stand::Rests | Stand::Waits) => {
                self.stand = stand;
                return None;
            }
        };
        Some(over)
    }
}

/// Runs side by side.
///
/// ```
/// use integrate::{Integrator, OneByOne, Options, Ordinary, Team};
/// let decay = |rate: f64| {
///     let problem = Ordinary::new(vec![1.0], move |_, x, dx| dx[0] = -rate * x[0], move |_, _, j| j[0] = -rate);
///     Integrator::new(problem, Options::default(), 0.0, &[1.0])
/// };
/// let mut team = Team::new(OneByOne::new(2));
/// for place in 0..2 {
///     team.put(place, decay(1.0 + place as f64)?, 1.0);
/// }
/// let mut ends = [0.0; 2];
/// while let Some((place, outcome)) = team.step() {
///     outcome?;
///     let run = team.run(place).ok_or("nobody there")?;
///     ends[place] = run.x()[0];
///     if run.time() < 1.0 {
///         team.begin(place, 1.0);
///     }
/// }
/// assert!((ends[0] - libm::exp(-1.0)).abs() < 1e-5 && (ends[1] - libm::exp(-2.0)).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Team<T: Together> {
    together: T,
    members: Vec<Option<Member<T::Problem>>>,
}

impl<T: Together> Team<T> {
    /// A team without runs.
    #[must_use]
    pub fn new(together: T) -> Self {
        let places = together.places().min(MOST_PLACES);
        Self {
            together,
            members: (0..places).map(|_| None).collect(),
        }
    }

    /// What evaluates the right-hand sides.
    #[must_use]
    pub fn together(&self) -> &T {
        &self.together
    }

    /// The first place without a run.
    #[must_use]
    pub fn free_place(&self) -> Option<usize> {
        self.members.iter().position(Option::is_none)
    }

    /// Puts a run into a place, instead of the one that is there, and begins a step to `limit`. If it cannot begin,
    /// [`Team::step`] says so.
    ///
    /// # Panics
    /// If there is no such place.
    pub fn put(&mut self, place: usize, integrator: Integrator<T::Problem>, limit: f64) {
        self.together.put(place, integrator.problem());
        let stand = Stand::Rests;
        self.members[place]
            .insert(Member { integrator, stand })
            .begin(limit);
    }

    /// Begins the next step of a run; see [`Team::put`]. Without one it rests. Nothing happens where there is no run.
    pub fn begin(&mut self, place: usize, limit: f64) {
        if let Some(Some(member)) = self.members.get_mut(place) {
            member.begin(limit);
        }
    }

    /// The run in a place.
    #[must_use]
    pub fn run(&mut self, place: usize) -> Option<&mut Integrator<T::Problem>> {
        let member = self.members.get_mut(place)?.as_mut()?;
        Some(&mut member.integrator)
    }

    /// Takes a run out.
    pub fn take(&mut self, place: usize) -> Option<Integrator<T::Problem>> {
        let member = self.members.get_mut(place)?.take()?;
        Some(member.integrator)
    }

    /// Goes on until a run has made its step, or cannot make it; none if no run has a step to make. The runs whose step is over
    /// rest, and the others go on without them, until [`Team::begin`].
    pub fn step(&mut self) -> Option<(usize, Result<(), StepError>)> {
        loop {
            for (place, member) in self.members.iter_mut().enumerate() {
                let Some(member) = member else { continue };
                if let Some(over) = member.go_on() {
                    return Some((place, over));
                }
            }
            // Whoever has a step to make waits now.
            let mut calls: [Option<Call<'_, T::Problem>>; MOST_PLACES] = [const { None }; MOST_PLACES];
            let calls = &mut calls[..self.members.len()];
            let mut waiting = false;
            for (call, member) in calls.iter_mut().zip(&mut self.members) {
                if let Some(Member { integrator, stand }) = member
                    && matches!(stand, Stand::Waits)
                {
                    *stand = Stand::Goes;
                    *call = Some(integrator.wanted());
                    waiting = true;
                }
            }
            if !waiting {
                return None;
            }
            self.together.derivatives(calls);
        }
    }
}
