//! The outcome of the points for each statement, and for the contact stiffness.

use std::collections::BTreeMap;
use std::io::{self, Write};

use report::summary::write_json;
use serde::Serialize;

use super::axes::AXES;
use super::pairs::{self, Pair, PairShown};
use super::point::PointOutcome;
use super::space::{FRICTIONS, OpenParameter, OtherFriction, PointPlace, Space};
use super::split::{Split, deciding};
use super::stiffness::{OfStiffness, of_stiffness};
use crate::claims::{ClaimGroup, ClaimVerdict, claims};

/// The file of the outcome.
pub const FILE_NAME: &str = "sensitivity.json";
/// Its schema's name and version.
pub const SCHEMA: &str = "wedgelab.sensitivity/1";

/// In which part of the points that decide a statement it holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Extent {
    /// At all of them.
    Always,
    /// At half of them, or more.
    Mostly,
    /// At fewer than half of them.
    Seldom,
    /// At none.
    Never,
    /// No point decides it.
    CannotBeDecided,
}

impl Extent {
    /// All, in order.
    pub const ALL: [Self; 5] = [
        Self::Always,
        Self::Mostly,
        Self::Seldom,
        Self::Never,
        Self::CannotBeDecided,
    ];

    /// Makes it of the number of points that decide, and of those at which a statement holds.
    #[must_use]
    pub fn of(holds: usize, decided: usize) -> Self {
        match (holds, decided) {
            (_, 0) => Self::CannotBeDecided,
            (0, _) => Self::Never,
            (holds, decided) if holds == decided => Self::Always,
            (holds, decided) if 2 * holds >= decided => Self::Mostly,
            _ => Self::Seldom,
        }
    }

    /// In words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Always => "always",
            Self::Mostly => "mostly",
            Self::Seldom => "seldom",
            Self::Never => "never",
            Self::CannotBeDecided => "cannot be decided",
        }
    }
}

/// The number of points at which a statement holds, among those that decide it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Tally {
    /// Points that decide it.
    pub decided: usize,
    /// Those of them where it holds.
    pub holds: usize,
}

impl Tally {
    fn of(verdicts: impl Iterator<Item = ClaimVerdict>) -> Self {
        verdicts.fold(Self::default(), |tally, verdict| Self {
            decided: tally.decided + usize::from(verdict != ClaimVerdict::CannotBeDecided),
            holds: tally.holds + usize::from(verdict == ClaimVerdict::Holds),
        })
    }

    /// Returns the share of those that decide; NaN without any.
    #[must_use]
    pub fn share(self) -> f64 {
        self.holds as f64 / self.decided as f64
    }
}

/// A statement under another friction, beside the same points with the cases' friction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct UnderFriction {
    /// The friction.
    pub friction: &'static str,
    /// With it.
    pub with: Tally,
    /// At the same points with the cases' friction.
    pub without: Tally,
}

/// The effect of another friction on all statements together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OfFriction {
    /// The friction.
    pub friction: &'static str,
    /// Points with it.
    pub points: usize,
    /// Mean number of statements that hold at a point: with it, and at the same points without it.
    pub mean: [f64; 2],
    /// Statements that hold at half of the points or more with it, and do not without it.
    pub only_with: usize,
    /// The other way round.
    pub only_without: usize,
}

/// The part of the space in which a statement holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Statement {
    /// [`Claim::id`](crate::claims::Claim::id).
    pub id: &'static str,
    /// The group to which it belongs.
    pub group: ClaimGroup,
    /// The part of the space in which it holds.
    pub extent: Extent,
    /// The points of the space.
    #[serde(flatten)]
    pub tally: Tally,
    /// The verdict with all as decided.
    pub as_decided: ClaimVerdict,
    /// The cut that decides, if one does.
    pub decides: Option<Split>,
    /// Under other frictions.
    pub frictions: Vec<UnderFriction>,
}

/// The part of the space in which the runs stay within an axis of the thesis's figures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WithinAxis {
    /// The axis.
    pub axis: &'static str,
    /// The part of the space in which they do.
    pub extent: Extent,
    /// The points of the space.
    #[serde(flatten)]
    pub tally: Tally,
    /// The cut that decides, if one does.
    pub decides: Option<Split>,
}

/// An open parameter, for readers.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ParameterShown {
    /// The description.
    pub name: &'static str,
    /// Its key in case files.
    pub key: String,
    /// Its values.
    pub range: String,
    /// The settings that the cases take.
    pub decided: &'static str,
    /// The reasons for leaving it open and for this range.
    pub reason: &'static str,
    /// Number of statements that it decides.
    pub statements: usize,
}

/// All that the points say.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sensitivity {
    /// [`SCHEMA`].
    pub schema: &'static str,
    /// Points of the space.
    pub points: usize,
    /// The open parameters.
    pub parameters: Vec<ParameterShown>,
    /// Number of statements of each extent, in the order of [`Extent::ALL`].
    pub extents: [usize; 5],
    /// The statements, in the order of the thesis.
    pub statements: Vec<Statement>,
    /// The axes of the thesis's figures.
    pub axes: Vec<WithinAxis>,
    /// The pairs of parameters that decide statements together.
    pub pairs: Vec<PairShown>,
    /// Number of statements that hold over the contact stiffness, and the stiffness that the rule chooses.
    pub stiffness: OfStiffness,
    /// Runs that failed or stopped, with the names of their points.
    pub unsound: BTreeMap<String, Vec<String>>,
}

impl Sensitivity {
    /// Returns the outcome of these points, of which the first `points` of the space count.
    #[must_use]
    pub fn of(space: &Space, points: u64, found: &BTreeMap<PointPlace, PointOutcome>) -> Self {
        let verdict = |place: PointPlace, statement: usize| {
            let found = found.get(&place)?;
            found.verdicts.get(statement).copied()
        };
        let points = 0..points;
        let mut together: Vec<(&'static str, Pair)> = Vec::new();
        let statements: Vec<Statement> = claims()
            .enumerate()
            .map(|(number, claim)| {
                let at = |place: PointPlace| verdict(place, number);
                let tally = Tally::of(points.clone().filter_map(|point| at(PointPlace::Space(point))));
                let decided: Vec<(u64, bool)> = points
                    .clone()
                    .filter_map(|point| Some((point, at(PointPlace::Space(point))?)))
                    .filter(|(_, verdict)| *verdict != ClaimVerdict::CannotBeDecided)
                    .map(|(point, verdict)| (point, verdict == ClaimVerdict::Holds))
                    .collect();
                let decides = deciding(space, &decided);
                let alone = decides.as_ref().map_or(0.0, |split| split.explains);
                together.extend(pairs::deciding(space, &decided, alone).map(|pair| (claim.id, pair)));
                let frictions = FRICTIONS.iter().enumerate().map(|(index, friction)| {
                    let both = points.clone().filter_map(|point| {
                        let with = at(PointPlace::OtherFriction(index, point))?;
                        Some((with, at(PointPlace::Space(point))?))
                    });
                    let (with, without): (Vec<ClaimVerdict>, Vec<ClaimVerdict>) = both.unzip();
                    UnderFriction {
                        friction: friction.name,
                        with: Tally::of(with.into_iter()),
                        without: Tally::of(without.into_iter()),
                    }
                });
                Statement {
                    id: claim.id,
                    group: claim.group,
                    extent: Extent::of(tally.holds, tally.decided),
                    tally,
                    as_decided: at(PointPlace::Decided).unwrap_or(ClaimVerdict::CannotBeDecided),
                    decides,
                    frictions: frictions.collect(),
                }
            })
            .collect();
        let axes = AXES.iter().enumerate().map(|(number, axis)| {
            let at = |point| Some((point, *found.get(&PointPlace::Space(point))?.axes.get(number)?));
            let within: Vec<(u64, bool)> = points.clone().filter_map(at).collect();
            let tally = Tally {
                decided: within.len(),
                holds: within.iter().filter(|(_, within)| *within).count(),
            };
            WithinAxis {
                axis: axis.name,
                extent: Extent::of(tally.holds, tally.decided),
                tally,
                decides: deciding(space, &within),
            }
        });
        let shown = |parameter: &OpenParameter| ParameterShown {
            name: parameter.name,
            key: parameter.factor.name().to_owned(),
            range: parameter.range(),
            decided: parameter.decided,
            reason: parameter.reason,
            statements: statements
                .iter()
                .filter_map(|statement| statement.decides.as_ref())
                .filter(|split| split.parameter == parameter.name)
                .count(),
        };
        let unsound = found.iter().filter(|(_, found)| !found.unsound.is_empty());
        Self {
            schema: SCHEMA,
            points: points.end as usize,
            parameters: space.parameters.iter().map(shown).collect(),
            extents: Extent::ALL.map(|extent| {
                let own = statements.iter().filter(|statement| statement.extent == extent);
                own.count()
            }),
            axes: axes.collect(),
            pairs: pairs::gathered(together),
            stiffness: of_stiffness(space, points, found),
            statements,
            unsound: unsound
                .map(|(place, found)| (place.key(), found.unsound.clone()))
                .collect(),
        }
    }

    /// Returns the outcome of a statement.
    #[must_use]
    pub fn statement(&self, id: &str) -> Option<&Statement> {
        self.statements.iter().find(|statement| statement.id == id)
    }

    /// Returns the effect of other frictions on all statements together; nothing without points of them.
    #[must_use]
    pub fn frictions(&self) -> Vec<OfFriction> {
        let of = |(index, friction): (usize, &OtherFriction)| {
            let under = || self.statements.iter().filter_map(|one| one.frictions.get(index));
            let points = under().map(|under| under.with.decided).max()?;
            let mean = |tally: fn(&UnderFriction) -> Tally| {
                let shares = under().map(tally).filter(|tally| tally.decided > 0);
                shares.map(Tally::share).sum::<f64>()
            };
            let usually = |tally: Tally| 2 * tally.holds >= tally.decided;
            let turned = |holds: bool| {
                let both = under().filter(|under| under.with.decided > 0 && under.without.decided > 0);
                let turned = both.filter(|under| usually(under.with) != usually(under.without));
                turned.filter(|under| usually(under.with) == holds).count()
            };
            (points > 0).then(|| OfFriction {
                friction: friction.name,
                points,
                mean: [mean(|under| under.with), mean(|under| under.without)],
                only_with: turned(true),
                only_without: turned(false),
            })
        };
        FRICTIONS.iter().enumerate().filter_map(of).collect()
    }

    /// Writes it as JSON.
    ///
    /// # Errors
    /// The writer's.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        write_json(self, out)
    }
}
