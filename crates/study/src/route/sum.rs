//! Damage of a route: the mean of its runs by their shares, step by step.

use std::collections::BTreeMap;

use quantity::{Kind, System as Units};
use serde::{Deserialize, Serialize};

use super::worn::{WornProfile, WornWedge};
use super::{Route, RouteRun, WheelWear, Worn};
use wedge::parameters::Wear;

use crate::car::CarCase;
use crate::car::statistics::SIDES;
use crate::car::summary::CarSummary;
use crate::damage::{PlaceDamage, RailDamage, SERVICE, WheelDamage, of_service};
use crate::summary::{RunSummary, SummaryValue};
use crate::wear::mounted::{FaceGrowth, FaceMaps, FacePlan, WedgeLaw};

/// The schema's name and version.
const SCHEMA: &str = "wedgelab.route/1";
/// Places of summed profiles are at multiples of this, to both sides up to [`REACH`] of them, m.
const PLACE: f64 = 1e-3;
const REACH: i32 = 100;
/// A step that wears a wheel deeper than this, or a wedge's rise higher, is called long, m.
const LONG: [f64; 2] = [0.3e-3, 3e-3];
/// A route does not go on from a step that wears a wheel deeper than this, or lifts a wedge higher, m: its
/// profile would be none that a wheel ever has.
const TOO_LONG: [f64; 2] = [1e-3, 10e-3];

/// A run with its outcome.
#[derive(Clone, Debug)]
pub struct OfRun {
    /// The run.
    pub run: RouteRun,
    /// Its summary.
    pub summary: CarSummary,
}

/// The outcome of a route.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RouteSummary {
    /// Name and version of its schema: `wedgelab.route/1`.
    pub schema: String,
    /// Version of the program that wrote it.
    pub program: String,
    /// The route's name.
    pub name: String,
    /// Its title.
    pub title: String,
    /// Units of the numbers.
    pub units: Units,
    /// The distance of service.
    pub service: SummaryValue,
    /// What is doubtful.
    pub warnings: Vec<String>,
    /// Its steps.
    pub steps: Vec<RouteStep>,
    /// The assumptions.
    pub assumptions: Vec<String>,
}

/// A step of a route: damage at its pace at the step's start, depths at its end.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RouteStep {
    /// Service at its start and at its end.
    pub service: [SummaryValue; 2],
    /// What creep takes by the distance, all wheels: the mean.
    pub creep_resistance: SummaryValue,
    /// Wheels by their names, over 100,000 miles.
    pub wheels: BTreeMap<String, WheelDamage>,
    /// Rails, `left` and `right`, over 1,000,000 gross tons.
    pub rails: BTreeMap<String, RailDamage>,
    /// Depths of wedges at its end, by their names; empty where they do not wear.
    pub wedges: BTreeMap<String, WedgeDepth>,
    /// Its runs.
    pub runs: Vec<RouteTrack>,
}

/// Depths of a wedge's faces with their counterfaces.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WedgeDepth {
    /// At the column.
    pub column: SummaryValue,
    /// At the slope.
    pub slope: SummaryValue,
    /// By how much it stands higher: (column cos θ + slope) / sin θ.
    pub rise: SummaryValue,
}

/// A run of a step in numbers.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RouteTrack {
    /// Its name.
    pub name: String,
    /// Its share of the distance.
    pub share: f64,
    /// Its outcome in a word.
    pub outcome: String,
    /// What creep takes by the distance.
    pub creep_resistance: SummaryValue,
    /// The largest depth of a wheel over 100,000 miles of it, and the wheel.
    pub largest_depth: SummaryValue,
    /// That wheel.
    pub wheel: String,
}

/// The wear of a car along a route.
#[derive(Clone, Debug)]
pub struct RouteWear<'r> {
    route: &'r Route,
    base: CarCase,
    /// Depths of wheels over the places, m.
    wheels: BTreeMap<String, Vec<f64>>,
    /// Wear of wedges at column and slope.
    wedges: BTreeMap<String, [FaceMaps; 2]>,
    /// The outcome so far.
    pub summary: RouteSummary,
    /// Why it cannot go on, if the last step is too long.
    pub too_long: Option<String>,
}

fn places() -> impl Iterator<Item = f64> {
    (-REACH..=REACH).map(|k| PLACE * f64::from(k))
}

/// Adds damage over a profile times a share to that at the places; numbers in units of the summary. What is
/// between two places goes to both, so that the sum stays.
fn add(to: &mut [[f64; 2]], damaged: &[PlaceDamage], share: f64, length: f64) {
    for own in damaged {
        let at = own.y / (length * PLACE) + f64::from(REACH);
        let (before, part) = (at.floor(), at - at.floor());
        for (number, weight) in [(before, 1.0 - part), (before + 1.0, part)] {
            if let Some(sum) = (number >= 0.0).then(|| to.get_mut(number as usize)).flatten() {
                sum[0] += share * weight * own.depth;
                sum[1] += share * weight * own.fatigue;
            }
        }
    }
}

/// The mean of a surface over runs: of two numbers, and over the places; numbers in units of the summary.
struct Sum {
    numbers: [f64; 2],
    over: Vec<[f64; 2]>,
}

impl Sum {
    fn new() -> Self {
        Self {
            numbers: [0.0; 2],
            over: places().map(|_| [0.0; 2]).collect(),
        }
    }

    /// Adds a run's numbers and profile by its share.
    fn take(&mut self, share: f64, numbers: [f64; 2], profile: &[PlaceDamage], length: f64) {
        for (sum, own) in self.numbers.iter_mut().zip(numbers) {
            *sum += share * own;
        }
        add(&mut self.over, profile, share, length);
    }

    fn profile(&self, length: f64) -> Vec<PlaceDamage> {
        let each = places()
            .zip(&self.over)
            .filter(|(_, own)| own[0] > 0.0 || own[1] != 0.0);
        each.map(|(y, [depth, fatigue])| PlaceDamage {
            y: y * length,
            depth: *depth,
            fatigue: *fatigue,
        })
        .collect()
    }

    /// Returns the largest depth with its place, and the largest fatigue.
    fn largest(&self, length: f64) -> ([f64; 2], f64) {
        let each = places().zip(&self.over);
        let deepest = each.fold([0.0, 0.0], |most: [f64; 2], (y, own)| match own[0] > most[0] {
            true => [own[0], y * length],
            false => most,
        });
        (
            deepest,
            self.over.iter().fold(0.0, |most: f64, own| most.max(own[1])),
        )
    }
}

impl<'r> RouteWear<'r> {
    /// Returns the car of a route, not worn yet.
    #[must_use]
    pub fn new(route: &'r Route, base: CarCase) -> Self {
        let units = base.simulation.output_units;
        let summary = RouteSummary {
            schema: SCHEMA.to_owned(),
            program: env!("CARGO_PKG_VERSION").to_owned(),
            name: route.name.clone(),
            title: route.title.clone(),
            units,
            service: of_service(route.service, units),
            warnings: Vec::new(),
            steps: Vec::new(),
            assumptions: assumptions(route, &base.damage.wedges),
        };
        Self {
            route,
            base,
            wheels: BTreeMap::new(),
            wedges: BTreeMap::new(),
            summary,
            too_long: None,
        }
    }

    /// Returns the car as it is worn so far; nothing at the start.
    #[must_use]
    pub fn worn(&self) -> Worn {
        let mut worn = Worn::default();
        let car::Wheels::OnRails(own) = &self.base.parameters.wheels else {
            return worn;
        };
        let first = &own.wheels[0][0];
        let each = self.route.wheels == WheelWear::Each;
        // One profile for all where all are worn alike.
        let alike = !each && own.wheels.iter().flatten().all(|other| other == first);
        let mut wheels = Vec::new();
        if alike {
            wheels.push((String::new(), first));
        } else {
            for (axle, pair) in (1..).zip(&own.wheels) {
                let sides = SIDES.into_iter().zip(pair);
                wheels.extend(sides.map(|(side, profile)| (format!("axle_{axle}.{side}"), profile)));
            }
        }
        for (wheel, profile) in wheels {
            let name = if each {
                wheel.replace('.', "_")
            } else {
                String::new()
            };
            if let Some(depths) = self.wheels.get(&name) {
                let depths: Vec<[f64; 2]> = places().zip(depths).map(|(y, own)| [y, *own]).collect();
                worn.profiles.push(WornProfile::new(&wheel, profile, &depths));
            }
        }
        worn.wedges = self
            .wedges
            .iter()
            .filter_map(|(name, maps)| self.worn_wedge(name, maps))
            .collect();
        worn
    }

    fn worn_wedge(&self, name: &str, maps: &[FaceMaps; 2]) -> Option<WornWedge> {
        let plans = FacePlan::of(self.wedge(name)?);
        Some(WornWedge {
            name: name.to_owned(),
            depths: self.depths(name, maps)?,
            beyond: [0, 1].map(|face| maps[face].beyond(&plans[face])),
        })
    }

    /// Returns the mean depths (m) of a wedge at column and slope, with those that the case begins with.
    fn depths(&self, name: &str, maps: &[FaceMaps; 2]) -> Option<[f64; 2]> {
        let before = self.wedge(name)?.wear;
        let [column, slope] = maps.each_ref().map(FaceMaps::both);
        Some([before.column + column, before.slope + slope])
    }

    /// Takes the runs of the next step along.
    pub fn step(&mut self, runs: &[OfRun]) {
        let units = self.summary.units;
        let length = Kind::Length.from_si(units);
        let number = self.summary.steps.len() as f64;
        let part = self.route.service / f64::from(self.route.steps);
        let value = |own: f64, kind: Kind| SummaryValue::new(own, kind, units);
        let mut wheels: BTreeMap<String, Sum> = BTreeMap::new();
        let mut rails: BTreeMap<String, Sum> = BTreeMap::new();
        let (mut resistance, mut told) = (0.0, Vec::new());
        for OfRun { run, summary } in runs {
            let mut track = RouteTrack {
                name: run.name.clone(),
                share: run.share,
                outcome: summary.outcome().word().to_owned(),
                creep_resistance: value(0.0, Kind::Force),
                largest_depth: value(0.0, Kind::Length),
                wheel: String::new(),
            };
            if let Some(said) = summary.outcome().told() {
                self.warn(format!("{}: the run {said}", run.name));
            }
            let Some(damage) = &summary.damage else {
                self.warn(format!(
                    "{}: no damage: wheels are linear, or the run ends before it has settled",
                    run.name
                ));
                told.push(track);
                continue;
            };
            track.creep_resistance = damage.creep_resistance.clone();
            resistance += run.share * damage.creep_resistance.value;
            for (name, own) in &damage.wheels {
                if own.largest_depth.value > track.largest_depth.value {
                    (track.largest_depth, track.wheel) = (own.largest_depth.clone(), name.clone());
                }
                let numbers = [own.wear_number.value, own.worn_mass.value];
                let sum = wheels.entry(name.clone()).or_insert_with(Sum::new);
                sum.take(run.share, numbers, &own.profile, length);
            }
            for (name, own) in &damage.rails {
                let numbers = [own.wear_number.value, own.worn_over_an_inch.value];
                let sum = rails.entry(name.clone()).or_insert_with(Sum::new);
                sum.take(run.share, numbers, &own.profile, length);
            }
            told.push(track);
        }
        self.wear_wheels(&wheels, part);
        self.wear_wedges(runs, part);
        let shown = |own: f64, kind: Kind| SummaryValue {
            value: own,
            unit: kind.label(units).to_owned(),
        };
        let of_wheels = wheels.into_iter().map(|(name, sum)| {
            let ([depth, place], fatigue) = sum.largest(length);
            let damage = WheelDamage {
                wear_number: shown(sum.numbers[0], Kind::Force),
                worn_mass: shown(sum.numbers[1], Kind::Mass),
                largest_depth: shown(depth, Kind::Length),
                place: shown(place, Kind::Length),
                fatigue,
                profile: sum.profile(length),
            };
            (name, damage)
        });
        let of_rails = rails.into_iter().map(|(name, sum)| {
            let ([depth, place], fatigue) = sum.largest(length);
            let damage = RailDamage {
                wear_number: shown(sum.numbers[0], Kind::Force),
                worn_over_an_inch: shown(sum.numbers[1], Kind::Length),
                largest_depth: shown(depth, Kind::Length),
                place: shown(place, Kind::Length),
                fatigue,
                profile: sum.profile(length),
            };
            (name, damage)
        });
        let wedges = self.wedges.iter().filter_map(|(name, maps)| {
            let [column, slope] = self.depths(name, maps)?;
            let depth = WedgeDepth {
                column: value(column, Kind::Length),
                slope: value(slope, Kind::Length),
                rise: value(self.rise(name, [column, slope]), Kind::Length),
            };
            Some((name.clone(), depth))
        });
        let step = RouteStep {
            service: [number, number + 1.0].map(|own| of_service(own * part, units)),
            creep_resistance: shown(resistance, Kind::Force),
            wheels: of_wheels.collect(),
            rails: of_rails.collect(),
            wedges: wedges.collect(),
            runs: told,
        };
        self.summary.steps.push(step);
    }

    fn warn(&mut self, words: String) {
        if !self.summary.warnings.contains(&words) {
            self.summary.warnings.push(words);
        }
    }

    /// Says whether a step is too long to go on from.
    fn see_length(&mut self, of: usize, most: f64, does: &str) {
        if most > TOO_LONG[of] {
            self.too_long = Some(format!(
                "a step {does} {:.1} mm at once; at least {:.0} steps are needed, {:.0} would be short",
                1e3 * most,
                (f64::from(self.route.steps) * most / TOO_LONG[of]).ceil(),
                (f64::from(self.route.steps) * most / LONG[of]).ceil()
            ));
        }
    }

    /// Wears wheels over a way, m.
    fn wear_wheels(&mut self, sums: &BTreeMap<String, Sum>, way: f64) {
        let length = Kind::Length.from_si(self.summary.units);
        let by = way / (SERVICE * length);
        let (share, each) = match self.route.wheels {
            WheelWear::Nothing => return,
            WheelWear::Each => (by, true),
            WheelWear::Mean => (by / sums.len().max(1) as f64, false),
        };
        let mut grown: BTreeMap<String, Vec<f64>> = BTreeMap::new();
        for (name, sum) in sums {
            let key = if each { name.clone() } else { String::new() };
            let own = grown.entry(key).or_insert_with(|| vec![0.0; sum.over.len()]);
            for (own, [depth, _]) in own.iter_mut().zip(&sum.over) {
                *own += share * depth;
            }
        }
        let most = grown
            .values()
            .flatten()
            .fold(0.0, |most: f64, own| most.max(*own));
        if most > LONG[0] {
            self.warn(format!(
                "a step wears a wheel by up to {:.2} mm, and the contacts move with it: the next profile is \
                 that of one place worn on and on. Take more steps: some {:.0}",
                1e3 * most,
                (f64::from(self.route.steps) * most / LONG[0]).ceil()
            ));
        }
        self.see_length(0, most, "wears a wheel by");
        for (name, grown) in grown {
            let own = self.wheels.entry(name).or_insert_with(|| vec![0.0; grown.len()]);
            own.iter_mut().zip(grown).for_each(|(own, grown)| *own += grown);
        }
    }

    /// Wears wedges over a way, m.
    fn wear_wedges(&mut self, runs: &[OfRun], way: f64) {
        if self.route.wedges.is_none() {
            return;
        }
        let ratio = self.base.damage.wedges.counterface;
        let mut grown: BTreeMap<String, [(FacePlan, FaceGrowth); 2]> = BTreeMap::new();
        let mut others = Vec::new();
        for OfRun { run, summary } in runs {
            let share = run.share * way / SERVICE;
            for (name, worn) in summary.wedge_wear.iter().flat_map(|own| &own.wedges) {
                let Some(wedge) = self.wedge(name) else { continue };
                let own = grown.entry(name.clone()).or_insert_with(|| {
                    FacePlan::of(wedge).map(|plan| {
                        let growth = plan.growth();
                        (plan, growth)
                    })
                });
                for ((plan, growth), face) in own.iter_mut().zip([&worn.column, &worn.slope]) {
                    let fits = face.pace(share, summary.units, |pace| growth.add(plan, pace, ratio));
                    if !fits {
                        others.push(&run.name);
                    }
                }
            }
        }
        if let Some(name) = others.first() {
            self.warn(format!(
                "{name}: its wedges have other points than those of the first track, and do not wear in it"
            ));
        }
        let mut most: f64 = 0.0;
        let mut moves = false;
        for (name, faces) in &grown {
            let own = self
                .wedges
                .entry(name.clone())
                .or_insert_with(|| faces.each_ref().map(|(plan, _)| plan.unworn()));
            let before = own.each_ref().map(FaceMaps::both);
            for (maps, (plan, growth)) in own.iter_mut().zip(faces) {
                maps.grow(plan, growth);
            }
            let after = own.each_ref().map(FaceMaps::both);
            let grown = [after[0] - before[0], after[1] - before[1]];
            moves |= grown != [0.0; 2];
            most = most.max(self.rise(name, grown));
        }
        if !moves {
            self.warn(
                "wedges do not wear: their friction takes nothing, or they have no mass and no faces"
                    .to_owned(),
            );
        }
        self.see_length(1, most, "lets a wedge rise by");
        if most > LONG[1] {
            self.warn(format!(
                "a step lets a wedge rise by {:.1} mm: take more steps, some {:.0}",
                1e3 * most,
                (f64::from(self.route.steps) * most / LONG[1]).ceil()
            ));
        }
    }

    fn wedge(&self, name: &str) -> Option<&truck::Wedge> {
        let (truck, wedge) = match name.strip_prefix("truck_1_") {
            Some(wedge) => (0, wedge),
            None => (1, name.strip_prefix("truck_2_")?),
        };
        let place = truck::WEDGE_NAMES.iter().position(|own| *own == wedge)?;
        self.base.parameters.trucks[truck].wedges.get(place)
    }

    /// Returns the rise (m) of a wedge by depths at column and slope, m.
    fn rise(&self, name: &str, [column, slope]: [f64; 2]) -> f64 {
        let by = |own: &truck::Wedge| Wear { column, slope }.rise(own.rise_angles());
        self.wedge(name).map_or(0.0, by)
    }
}

fn assumptions(route: &Route, law: &WedgeLaw) -> Vec<String> {
    let mut all = vec![
        "Every track is passed as in its run again and again; depths of a step are those of its start's pace."
            .to_owned(),
        match route.wheels {
            WheelWear::Mean => "All wheels wear by the mean of all: cars run both ways round.".to_owned(),
            WheelWear::Each => "Each wheel wears by its own damage: the car runs one way.".to_owned(),
            WheelWear::Nothing => "Profiles of wheels stay as they are.".to_owned(),
        },
        "Rails keep their profiles. Wear by Archard's map of [damage] and fatigue by its function are \
         remembered from publications and measured dry: they rank, they do not give a life."
            .to_owned(),
    ];
    all.push(match &route.wedges {
        None => "Wedges do not wear: the route has no [wedges].".to_owned(),
        Some(_) => format!(
            "Wedges wear by the energy of their friction with K = {:e} on a hardness of {:.0} MPa; column \
             and pocket wear {} times what the wedge does. K is a guess, known to an order of magnitude. \
             Where on its faces a wedge wears is that of each step's start, evened out by the springs of \
             the faces as the step wears on.",
            law.archard.coefficient,
            1e-6 * law.archard.hardness,
            law.counterface
        ),
    });
    all
}
