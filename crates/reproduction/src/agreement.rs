//! Agreement of the stand-alone wedge, the comparison program's types 6.8 and 6.9, and the quasi-static
//! wedge, in numbers.
//!
//! The types are *our reading* of them, in a half-truck made from the printed files: no output of that
//! program is known. Looked at is the leading left wedge, connection 127. All with toe out, as in the
//! thesis's comparison.
//!
//! - Means: the vertical wedge force (friction of the column on the side frame, positive up) over the
//!   branches of [`study::metrics`].
//! - Energy per cycle: of the stand-alone wedge, what the ledger lost in friction at the column; of the
//!   types, the column's friction over the stroke; of the closed form, the same over the input's full stroke.
//! - Loop area: the vertical wedge force over the vertical displacement that the loops are drawn over, which
//!   is the wedge's for the stand-alone model, the stroke (bolster against side frame) for the types; mean
//!   over the whole cycles after the first half period, by the trapezoidal rule on the rows.
//!
//! Defect: loops are taken from the rows, 0.01 s apart; in the first cycle with variable damping the types
//! rattle faster than that, and their loop area, a mean over both cycles, comes out some 2 % below the
//! energy, which is integrated along the steps.
//!
//! Units: SI, unless a text says otherwise.

mod remarks;

use mechanics::quasi_static::{QuasiStaticWedge, SlidingDirection};
use quantity::Kind;
use report::figures::{CaseOutcome, yaw};
use study::case::Case;
use study::closed_form;
use study::half_truck::HalfTruckResult;
use study::half_truck::catalog::{CatalogEntry, ToeCase, WedgeType, YawCase};
use study::metrics::{Cycle, mean};
use study::result::RunResult;
use wedge::parameters::{Damping, Parameters};

pub(crate) use remarks::percent;

/// The leading left wedge's connection.
pub const COMPONENT: &str = "127";

/// A run of the half-truck.
pub type TruckOutcome = (CatalogEntry, HalfTruckResult);

/// Returns whether statements and figures use a column of a half-truck: none of other wedges than the one
/// that is compared.
#[must_use]
pub fn needs(column: &str) -> bool {
    let mut parts = column.split('_');
    let of_wedge = matches!(parts.next(), Some("wedge" | "force" | "stroke" | "velocity"));
    let number = parts.next().filter(|part| part.parse::<u32>().is_ok());
    !of_wedge || number.is_none_or(|own| own == COMPONENT)
}

/// Returns a column of the half-truck's table under the name of the stand-alone wedge's column that stands
/// for the same; any other name is the half-truck's own.
#[must_use]
pub fn truck_column<'r>(result: &'r HalfTruckResult, name: &str) -> Option<&'r [f64]> {
    let wedge = |what: &str| result.column(&format!("wedge_{COMPONENT}_{what}"));
    match name {
        "bolster_vertical" => result.column("input_vertical"),
        "bolster_vertical_rate" => result.column("input_vertical_rate"),
        "wedge_z" => wedge("stroke"),
        "vertical_wedge_force" => wedge("column_friction"),
        "vertical_force_on_side_frame" => wedge("vertical_force"),
        "longitudinal_wedge_force" => wedge("longitudinal_force"),
        "side_frame_friction_power" => wedge("friction_power"),
        "coil_force" => wedge("coil_force"),
        "net_force_on_bolster_y" => {
            // Components: vertical, longitudinal where there is one, lateral.
            let number = if wedge("longitudinal_force").is_some() {
                3
            } else {
                2
            };
            result.column(&format!("force_{COMPONENT}_{number}"))
        }
        // The one friction of the type stands for all four corners.
        _ if name.starts_with("column_") && name.ends_with("_state") => wedge("state"),
        _ => result.column(name),
    }
}

/// The compared model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ComparedModel {
    /// The stand-alone wedge.
    StandAlone,
    /// Our reading of a type, in the half-truck.
    Type(WedgeType),
    /// The quasi-static wedge under the input's full stroke (eq. 5-1 for its upward branch, times μ).
    ClosedForm,
}

impl ComparedModel {
    /// In tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::StandAlone => "stand-alone model",
            Self::Type(WedgeType::Plain) => "our reading of type 6.8",
            Self::Type(WedgeType::Spatial) => "our reading of type 6.9",
            Self::ClosedForm => "closed form (eq. 5-1)",
        }
    }
}

/// The numbers of a model: SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Numbers {
    /// Whose.
    pub model: ComparedModel,
    /// Mean vertical wedge force while the bolster goes up, N.
    pub up: f64,
    /// While it goes down, N.
    pub down: f64,
    /// Energy per cycle, J.
    pub energy: f64,
    /// Loop area per cycle, J.
    pub area: f64,
}

impl Numbers {
    /// Returns the four numbers in order: up, down, energy, area.
    #[must_use]
    pub fn values(&self) -> [f64; 4] {
        [self.up, self.down, self.energy, self.area]
    }

    /// Returns their relative differences from another model's: 0.01 is one per cent more.
    #[must_use]
    pub fn over(&self, other: &Self) -> [f64; 4] {
        let (own, other) = (self.values(), other.values());
        std::array::from_fn(|k| own[k] / other[k] - 1.0)
    }
}

/// The change of a type's loop in the half-truck: SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// The type.
    pub wedges: WedgeType,
    /// Energy per cycle of the element alone under the input's full stroke, J; type 6.9 with the wedge's rise
    /// in its pocket.
    pub alone: f64,
    /// The same under the stroke that it has, J: from the mean lowest to the mean highest stroke of the
    /// cycles.
    pub shortened: f64,
    /// The loop's energy in the half-truck, J.
    pub found: f64,
    /// Mean lowest and highest stroke of the cycles, m.
    pub ends: [f64; 2],
    /// Largest vertical displacement of the left side frame, m.
    pub side_frame: f64,
    /// Largest difference between the input's vertical displacement and the bolster's, m.
    pub input_springs: f64,
}

/// A comparison: one damping, without or with yaw.
#[derive(Clone, Debug, PartialEq)]
pub struct AgreementGroup {
    /// Its damping.
    pub damping: Damping,
    /// True if the bolster is yawed.
    pub yawed: bool,
    /// The models, the stand-alone one first.
    pub models: Vec<Numbers>,
    /// The changes of the types' loops.
    pub strokes: Vec<Stroke>,
    /// The differences, with their reasons.
    pub remarks: Vec<String>,
}

/// The stand-alone run with toe out of a damping, without or with yaw, and the half-truck's runs that go with
/// it.
pub(crate) struct Set<'o> {
    pub damping: Damping,
    pub yawed: bool,
    pub alone: &'o CaseOutcome,
    pub trucks: Vec<&'o TruckOutcome>,
}

/// Returns the sets that these runs allow: those with a stand-alone run and at least one of the half-truck,
/// all complete.
pub(crate) fn sets<'o>(outcomes: &'o [CaseOutcome], trucks: &'o [TruckOutcome]) -> Vec<Set<'o>> {
    let mut sets = Vec::new();
    for damping in [Damping::Variable, Damping::Constant] {
        for yawed in [false, true] {
            let alone = outcomes.iter().find(|(case, result)| {
                let parameters = &case.parameters;
                parameters.damping == damping
                    && parameters.toe > 0.0
                    && (yaw(case) != 0.0) == yawed
                    && result.summary.complete
            });
            let wanted = if yawed {
                YawCase::Intended
            } else {
                YawCase::Straight
            };
            let mut trucks: Vec<&TruckOutcome> = trucks
                .iter()
                .filter(|(entry, result)| {
                    entry.damping == damping
                        && entry.toe == ToeCase::Out
                        && entry.yaw == wanted
                        && result.summary.complete
                })
                .collect();
            // Type 6.9 first, as in the thesis's legends.
            trucks.sort_by_key(|(entry, _)| std::cmp::Reverse(entry.wedges));
            if let (Some(alone), false) = (alone, trucks.is_empty()) {
                sets.push(Set {
                    damping,
                    yawed,
                    alone,
                    trucks,
                });
            }
        }
    }
    sets
}

/// Returns all comparisons that these runs allow.
#[must_use]
pub fn groups(outcomes: &[CaseOutcome], trucks: &[TruckOutcome]) -> Vec<AgreementGroup> {
    sets(outcomes, trucks).iter().filter_map(group).collect()
}

fn group(set: &Set<'_>) -> Option<AgreementGroup> {
    let (case, result) = set.alone;
    let cycle = Cycle::of(&case.parameters)?;
    let mut models = vec![stand_alone(case, result, &cycle)?];
    let mut strokes = Vec::new();
    for (entry, result) in set.trucks.iter().copied() {
        let numbers = truck(case, entry, result, &cycle)?;
        strokes.extend(stroke(case, entry, result, &cycle, numbers.energy));
        models.push(numbers);
    }
    models.push(closed(case, result.column("time")?, &cycle)?);
    let mut group = AgreementGroup {
        damping: set.damping,
        yawed: set.yawed,
        models,
        strokes,
        remarks: Vec::new(),
    };
    group.remarks = remarks::of(&group, result.summary.units);
    Some(group)
}

fn stand_alone(case: &Case, result: &RunResult, cycle: &Cycle) -> Option<Numbers> {
    let times = result.column("time")?;
    let [down, up] = branches(
        case,
        cycle,
        [
            times,
            result.column("bolster_vertical")?,
            result.column("bolster_vertical_rate")?,
        ],
        result.column("vertical_wedge_force")?,
    )?;
    let summary = &result.summary;
    let energy = summary.averages.energy_per_cycle.get("side_frame")?;
    Some(Numbers {
        model: ComparedModel::StandAlone,
        up,
        down,
        energy: energy.value / Kind::Energy.from_si(summary.units),
        area: loop_area(
            cycle,
            times,
            result.column("wedge_z")?,
            result.column("vertical_wedge_force")?,
        )?,
    })
}

fn truck(case: &Case, entry: &CatalogEntry, result: &HalfTruckResult, cycle: &Cycle) -> Option<Numbers> {
    let column = |name| truck_column(result, name);
    let times = column("time")?;
    let friction = column("vertical_wedge_force")?;
    let [down, up] = branches(
        case,
        cycle,
        [
            times,
            column("bolster_vertical")?,
            column("bolster_vertical_rate")?,
        ],
        friction,
    )?;
    let energy = result.summary.wedges.get(COMPONENT)?.energy_per_cycle.as_ref()?;
    Some(Numbers {
        model: ComparedModel::Type(entry.wedges),
        up,
        down,
        energy: energy.value / Kind::Energy.from_si(result.summary.units),
        area: loop_area(cycle, times, column("wedge_z")?, friction)?,
    })
}

/// Returns the closed form, at the times of a run.
fn closed(case: &Case, times: &[f64], cycle: &Cycle) -> Option<Numbers> {
    let parameters = &case.parameters;
    let (mut sums, mut counts) = ([0.0; 2], [0_usize; 2]);
    for time in times {
        let [z, speed, _] = parameters.bolster.coordinates[2].evaluate(*time, 0.0);
        if let Some(up) = cycle.branch(parameters.damping, *time, z, speed) {
            let direction = if up {
                SlidingDirection::Up
            } else {
                SlidingDirection::Down
            };
            sums[usize::from(up)] += closed_form::vertical_wedge_force(parameters, z, direction)?;
            counts[usize::from(up)] += 1;
        }
    }
    let energy = element_energy(
        parameters,
        cycle.middle - cycle.amplitude,
        cycle.middle + cycle.amplitude,
    )?;
    let mean = |branch: usize| (counts[branch] > 0).then(|| sums[branch] / counts[branch] as f64);
    Some(Numbers {
        model: ComparedModel::ClosedForm,
        up: mean(1)?,
        down: mean(0)?,
        energy,
        area: energy,
    })
}

/// Returns the energy that the quasi-static wedge loses at the column while the bolster goes from one height
/// to another and back, J.
fn element_energy(parameters: &Parameters, low: f64, high: f64) -> Option<f64> {
    // The forces are straight lines with at most one change of slope: the midpoint rule is good to 1e-6.
    const PIECES: u32 = 4000;
    let step = (high - low) / f64::from(PIECES);
    let mut energy = 0.0;
    for piece in 0..PIECES {
        let z = low + (f64::from(piece) + 0.5) * step;
        let force = |direction| closed_form::vertical_wedge_force(parameters, z, direction);
        energy += (force(SlidingDirection::Up)? - force(SlidingDirection::Down)?) * step;
    }
    Some(energy)
}

/// Returns a type's wedge as closed-form parameters: without weight, and without an angle for type 6.8.
fn element(case: &Case, wedges: WedgeType) -> Parameters {
    let mut parameters = case.parameters.clone();
    parameters.gravity = 0.0;
    if wedges == WedgeType::Plain {
        parameters.toe = 0.0;
    }
    parameters
}

fn stroke(
    case: &Case,
    entry: &CatalogEntry,
    result: &HalfTruckResult,
    cycle: &Cycle,
    found: f64,
) -> Option<Stroke> {
    let column = |name| truck_column(result, name);
    let (times, strokes) = (column("time")?, column("wedge_z")?);
    let (start, _, cycles) = cycle.window(*times.last()?)?;
    let mut ends = [0.0; 2];
    for number in 0..cycles {
        let from = start + f64::from(number) * cycle.period();
        let rows = rows(times, from, from + cycle.period());
        let (low, high) = strokes[rows]
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| {
                (low.min(*s), high.max(*s))
            });
        ends[0] += low / f64::from(cycles);
        ends[1] += high / f64::from(cycles);
    }
    let settled = rows(times, start, f64::INFINITY);
    let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most: f64, v| most.max(v.abs()));
    let (input, bolster) = (column("input_vertical")?, column("body_1_z")?);
    let frame = column("body_3_z")?;
    let parameters = element(case, entry.wedges);
    Some(Stroke {
        wedges: entry.wedges,
        alone: element_energy(
            &parameters,
            cycle.middle - cycle.amplitude,
            cycle.middle + cycle.amplitude,
        )?,
        shortened: element_energy(&parameters, ends[0], ends[1])?,
        found,
        ends,
        side_frame: most(&mut frame[settled.clone()].iter().copied()),
        input_springs: most(&mut settled.clone().map(|row| input[row] - bolster[row])),
    })
}

/// Rows of a time from `start` to `end`, both included.
fn rows(times: &[f64], start: f64, end: f64) -> std::ops::Range<usize> {
    times.partition_point(|time| *time < start)..times.partition_point(|time| *time <= end)
}

/// Means of a force going down and up.
fn branches(
    case: &Case,
    cycle: &Cycle,
    [times, positions, speeds]: [&[f64]; 3],
    force: &[f64],
) -> Option<[f64; 2]> {
    let mut branches = [Vec::new(), Vec::new()];
    for (row, time) in times.iter().enumerate() {
        if let Some(up) = cycle.branch(case.parameters.damping, *time, positions[row], speeds[row]) {
            branches[usize::from(up)].push(row);
        }
    }
    Some([mean(force, &branches[0])?, mean(force, &branches[1])?])
}

/// Mean area of a loop, a cycle.
fn loop_area(cycle: &Cycle, times: &[f64], displacement: &[f64], force: &[f64]) -> Option<f64> {
    let (start, end, cycles) = cycle.window(*times.last()?)?;
    let area: f64 = rows(times, start, end)
        .skip(1)
        .map(|row| 0.5 * (force[row] + force[row - 1]) * (displacement[row] - displacement[row - 1]))
        .sum();
    Some(area / f64::from(cycles))
}

/// Mean yaw of the bolster after the first half period of its input (s: the input's files have π), rad.
#[must_use]
pub fn mean_yaw(result: &HalfTruckResult) -> Option<f64> {
    let settled = rows(result.column("time")?, 0.5 * std::f64::consts::PI, f64::INFINITY);
    let yaw = result.column("body_1_yaw")?.get(settled)?;
    (!yaw.is_empty()).then(|| yaw.iter().sum::<f64>() / yaw.len() as f64)
}

/// Eq. 5-1 along a type's run: the coil force of the run in the quasi-static wedge of the case, in the
/// direction of the input (the stroke's own rings, and would change branch with each swing). Gives at each
/// row the column's friction on the side frame (N, positive up) and its force along the track (N).
#[must_use]
pub fn equation_5_1(case: &Case, result: &HalfTruckResult) -> Option<Vec<[f64; 2]>> {
    let wedge: QuasiStaticWedge = closed_form::wedge(&case.parameters);
    let coil = truck_column(result, "coil_force")?;
    let rates = truck_column(result, "bolster_vertical_rate")?;
    coil.iter()
        .zip(rates)
        .map(|(coil, rate)| {
            let direction = if *rate > 0.0 {
                SlidingDirection::Up
            } else {
                SlidingDirection::Down
            };
            let slide = wedge.slide(direction, wedge.branch(direction), coil.max(0.0))?;
            let (sin, cos) = libm::sincos(wedge.toe);
            let friction = direction.sign() * slide.column_friction;
            Some([-friction * cos, slide.column_normal * cos + friction * sin])
        })
        .collect()
}
