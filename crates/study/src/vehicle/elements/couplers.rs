//! Couplers with given forces, and draft gears between two bodies.

use ::car::CouplerForce;
use mechanics::curve::Curve;
use quantity::Kind;
use vehicle::catalog::{Coupler, DraftGear};

use crate::car::couplers;
use crate::case::field::Reach;
use crate::case::problem::Problem;
use crate::case::section::Range;
use crate::case::table::TableForm;
use crate::reader::{CLEARANCE, CaseReader, LENGTH, QuantityForm, STIFFNESS};

const INCH: f64 = 0.0254;
const POUND_FORCE: f64 = 4.448_221_615_260_5;
/// Travel (m) and reaction (N) of Miner's TF-880, M-901E: 45,520 ft lbf at 2.93 in and 566,000 lbf
/// (product page, read 2026-11-28). A curve of the power 2.04 has this capacity (derived).
const RATING: [f64; 2] = [2.93 * INCH, 566e3 * POUND_FORCE];
const POWER: f64 = 2.04;
/// Pieces of the usual loading curve.
const PIECES: u32 = 12;
const PLACES: QuantityForm = (Kind::Length, Range::Any, Reach::Signed(2.54));

/// The keys of a coupler.
pub(super) fn coupler(r: &mut CaseReader<'_>) -> Coupler {
    let mut own = Coupler {
        force: CouplerForce::default(),
        length: ::car::Couplers::default().length,
        truck_distance: 0.0,
        middle: 0.0,
        resting: false,
    };
    couplers::force(r, &mut own.force);
    let comment = "from the pivot to the pulling face: remembered of AAR type F";
    r.quantity("length", LENGTH, &mut own.length, comment);
    let comment = "from one truck center of its car to the other";
    r.needed("truck_distance", LENGTH, &mut own.truck_distance, comment);
    let comment = "between the truck centers, along the nominal layout";
    r.quantity("middle", PLACES, &mut own.middle, comment);
    own
}

/// The keys of a draft gear.
pub(super) fn draft_gear(r: &mut CaseReader<'_>) -> DraftGear {
    let mut slack = [0.0; 2];
    let comment = "how far it extends from the nominal layout before it pulls";
    r.quantity("slack_open", CLEARANCE, &mut slack[0], comment);
    let comment = "how far it is compressed before it pushes";
    r.quantity("slack_closed", CLEARANCE, &mut slack[1], comment);
    let mut points: Vec<[f64; 2]> = (0..=PIECES)
        .map(|k| {
            let share = f64::from(k) / f64::from(PIECES);
            [share * RATING[0], libm::pow(share, POWER) * RATING[1]]
        })
        .collect();
    if r.gives("table") {
        let comment = "compression of the gear and force on the way in, from zero to its travel";
        let read = r.table("table", &TableForm::coil(), Reach::Wide, comment);
        if let Some(read) = read {
            let rows = read.rows.iter();
            points = rows
                .map(|row| row.each_ref().map(quantity::Quantity::to_si))
                .collect();
            if points[0] != [0.0; 2] {
                let path = r.path("table");
                let problem =
                    Problem::new(format!("`{path}` does not begin with zero compression and force"));
                let help = "begin with [\"0 in\", \"0 lbf\"]; a preload is a steep first piece";
                r.problem_at(&path, problem.label("not from zero").help(help));
            }
        }
    } else {
        r.also_known("table");
    }
    let mut solid = 2e6 * POUND_FORCE / INCH;
    r.quantity(
        "solid_stiffness",
        STIFFNESS,
        &mut solid,
        "beyond its travel: a guess",
    );
    let mut returned = 0.2;
    let comment = "share of the force on the way in that is left on the way out: a guess";
    r.number(
        "returned",
        Range::UpTo(1.0, "between 0 and 1"),
        Reach::Between(0.0, 1.0),
        &mut returned,
        comment,
    );
    let mut reference_speed = 0.01;
    let form: QuantityForm = (Kind::Speed, Range::Positive, Reach::Positive);
    let comment = "over which the way in turns to the way out: a choice";
    r.quantity("reference_speed", form, &mut reference_speed, comment);
    if let Some(&[travel, force]) = points.last() {
        points.push([travel + 0.1, force + 0.1 * solid]);
    }
    let rises = points.windows(2).all(|pair| pair[1][1] >= pair[0][1]);
    if !rises {
        let path = r.path("table");
        let problem = Problem::new(format!("`{path}` falls: a gear that is pressed pushes ever more"));
        r.problem_at(&path, problem.label("falls").help("look at its forces"));
    }
    DraftGear {
        loading: Curve::new(points).unwrap_or_else(|_| Curve::linear(solid)),
        slack,
        returned,
        reference_speed,
    }
}
