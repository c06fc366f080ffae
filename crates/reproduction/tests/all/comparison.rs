//! The comparison with types 6.8 and 6.9: figures complete and drawn from the tables, numbers found again
//! from the columns, claims decided from the half-truck's runs and undecided without them.

use std::f64::consts::PI;
use std::sync::OnceLock;

use nucars::truck::Choices;
use report::figures::{CaseOutcome, Exhibit};
use reproduction::agreement::{AgreementGroup as Agreement, ComparedModel, Numbers, TruckOutcome, groups};
use reproduction::claims::{ClaimGroup, ClaimRow, ClaimVerdict, Claims, Evidence, evaluate};
use reproduction::figures::comparison;
use reproduction::page::{self, Comparison, Contents};
use study::case::builtin;
use study::half_truck::catalog::{self, ToeCase, WedgeType, YawCase};
use study::half_truck::{HalfTruckResult, run};
use study::run::Run;
use wedge::parameters::Damping;

const POUND: f64 = 4.448_221_615_260_5;
const INCH: f64 = 0.0254;

/// Returns the four stand-alone runs with toe out, and the half-truck's that go with them.
fn runs() -> &'static (Vec<CaseOutcome>, Vec<TruckOutcome>) {
    static RUNS: OnceLock<(Vec<CaseOutcome>, Vec<TruckOutcome>)> = OnceLock::new();
    RUNS.get_or_init(|| {
        let alone = builtin::thesis_names()
            .filter(|name| name.contains("toe_out_0.2"))
            .map(|name| {
                let case = builtin::case(name).unwrap();
                let result = Run::new(&case).unwrap().finish(|_| ());
                (case, result)
            })
            .collect();
        let trucks = catalog::entries()
            .into_iter()
            .filter(|entry| entry.toe == ToeCase::Out && entry.yaw != YawCase::Printed)
            .map(|entry| {
                let case = entry.case(&Choices::default(), 10.0).unwrap();
                (entry, run::run(&case, |_| ()).unwrap())
            })
            .collect();
        (alone, trucks)
    })
}

fn agreements() -> &'static [Agreement] {
    static FOUND: OnceLock<Vec<Agreement>> = OnceLock::new();
    FOUND.get_or_init(|| groups(&runs().0, &runs().1))
}

fn agreement(damping: Damping, yawed: bool) -> &'static Agreement {
    agreements()
        .iter()
        .find(|group| group.damping == damping && group.yawed == yawed)
        .unwrap()
}

fn numbers(group: &Agreement, model: ComparedModel) -> Numbers {
    *group.models.iter().find(|own| own.model == model).unwrap()
}

fn truck(wedges: WedgeType, damping: Damping, yaw: YawCase) -> &'static HalfTruckResult {
    let found = runs().1.iter().find(|(entry, _)| {
        entry.wedges == wedges && entry.damping == damping && entry.yaw == yaw && entry.toe == ToeCase::Out
    });
    &found.unwrap().1
}

fn alone(name: &str) -> &'static CaseOutcome {
    runs().0.iter().find(|(case, _)| case.name == name).unwrap()
}

fn exhibits() -> Vec<Exhibit> {
    comparison::exhibits(&runs().0, &runs().1)
}

fn close(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance * expected.abs(),
        "{found} instead of {expected}"
    );
}

#[test]
fn every_figure_of_the_comparison_is_there() {
    let exhibits = exhibits();
    for number in [
        "5-1", "5-2", "5-5", "5-7", "5-9", "5-10", "5-13", "5-15", "6-1", "6-2", "6-5", "6-7", "6-10",
        "6-11", "6-16",
    ] {
        let wanted = format!("figure {number}");
        let found = exhibits.iter().filter(|exhibit| exhibit.thesis == wanted).count();
        assert_eq!(found, 1, "{wanted}");
    }
    for Exhibit { name, figure, .. } in &exhibits {
        assert!(figure.caption.contains("our reading"), "{name}");
        for panel in &figure.panels {
            assert!(panel.curves.iter().all(|curve| curve.points.len() > 50), "{name}");
            // Type 6.8 has no longitudinal force.
            let plain = panel.curves.iter().any(|curve| curve.label.contains("6.8"));
            assert_eq!(plain, !name.contains("longitudinal"), "{name}");
            assert!(
                panel.curves.iter().any(|curve| curve.label.contains("6.9")),
                "{name}"
            );
        }
    }
    assert!(comparison::exhibits(&runs().0, &[]).is_empty());
}

#[test]
fn windows_are_those_of_the_scripts() {
    for exhibit in exhibits().iter().filter(|own| !own.name.ends_with("_loop")) {
        let windows: Vec<(f64, f64)> = exhibit
            .figure
            .panels
            .iter()
            .map(|panel| panel.x_window.unwrap())
            .collect();
        if exhibit.name.starts_with("variable") {
            assert_eq!(windows, [(0.0, 10.0), (4.0, 7.0)], "{}", exhibit.name);
        } else {
            assert_eq!(windows, [(0.5, 10.0), (4.0, 7.0), (3.5, 7.5)], "{}", exhibit.name);
            assert!(
                exhibit.figure.caption.contains("The first 0.5 s are cut"),
                "{}",
                exhibit.name
            );
        }
    }
}

#[test]
fn curves_are_the_columns_of_the_tables() {
    let exhibits = exhibits();
    for (name, wedges, damping, yaw, column, scale) in [
        (
            "constant_compared_vertical_wedge_force",
            WedgeType::Spatial,
            Damping::Constant,
            YawCase::Straight,
            "wedge_127_column_friction",
            POUND,
        ),
        (
            "variable_compared_vertical_force_on_side_frame",
            WedgeType::Plain,
            Damping::Variable,
            YawCase::Straight,
            "wedge_127_vertical_force",
            POUND,
        ),
        (
            "variable_yawed_compared_longitudinal_wedge_force",
            WedgeType::Spatial,
            Damping::Variable,
            YawCase::Intended,
            "wedge_127_longitudinal_force",
            POUND,
        ),
        (
            "constant_yawed_compared_side_frame_friction_power",
            WedgeType::Plain,
            Damping::Constant,
            YawCase::Intended,
            "wedge_127_friction_power",
            POUND * INCH,
        ),
    ] {
        let figure = &exhibits
            .iter()
            .find(|exhibit| exhibit.name == name)
            .unwrap()
            .figure;
        let result = truck(wedges, damping, yaw);
        let label = format!("our reading of type {}", wedges.code());
        let curve = figure.panels[0]
            .curves
            .iter()
            .find(|curve| curve.label == label)
            .unwrap();
        let (times, values) = (result.column("time").unwrap(), result.column(column).unwrap());
        assert_eq!(curve.points.len(), 1001);
        for (row, (time, value)) in curve.points.iter().enumerate() {
            assert_eq!(*time, times[row]);
            assert!(
                (value * scale - values[row]).abs() <= 1e-12 * values[row].abs(),
                "{name} {row}"
            );
        }
    }
    // Loops: the rows from 3.5 to 7.5 s, over the stroke.
    let name = "constant_compared_vertical_wedge_force_loop";
    let figure = &exhibits
        .iter()
        .find(|exhibit| exhibit.name == name)
        .unwrap()
        .figure;
    let result = truck(WedgeType::Spatial, Damping::Constant, YawCase::Straight);
    let stroke = result.column("wedge_127_stroke").unwrap();
    for panel in &figure.panels {
        let points = &panel.curves[1].points;
        assert_eq!(points.len(), 401);
        close(points[0].0 * INCH, stroke[350], 1e-12);
        close(points[400].0 * INCH, stroke[750], 1e-12);
    }
}

/// Means, energies and loops, from the columns by another way: time integrals of the power, and of F over
/// time by steps.
#[test]
fn numbers_are_found_again_from_the_columns() {
    for (damping, name) in [
        (Damping::Constant, "cdrun_toe_out_0.2_psi_0"),
        (Damping::Variable, "vdrun_toe_out_0.2_psi_0"),
    ] {
        let group = agreement(damping, false);
        let branch = |z: f64, speed: f64| match damping {
            // Peak speed 2 in/s, amplitude 1 in.
            Damping::Constant => speed.abs() > 1.8 * INCH,
            Damping::Variable => speed.abs() > 0.5 * INCH && z < -0.3 * INCH,
        };
        let means = |times: &[f64], z: &[f64], speed: &[f64], force: &[f64]| {
            [-1.0, 1.0].map(|sign| {
                let rows: Vec<usize> = (0..times.len())
                    .filter(|i| times[*i] > 0.5 * PI && branch(z[*i], speed[*i]) && sign * speed[*i] > 0.0)
                    .collect();
                rows.iter().map(|i| force[*i]).sum::<f64>() / rows.len() as f64
            })
        };
        let own = &alone(name).1;
        let column = |what: &str| own.column(what).unwrap();
        let found = numbers(group, ComparedModel::StandAlone);
        let [down, up] = means(
            column("time"),
            column("bolster_vertical"),
            column("bolster_vertical_rate"),
            column("vertical_wedge_force"),
        );
        close(found.up, up, 1e-12);
        close(found.down, down, 1e-12);
        // The friction that the wedge's vertical slip loses is all but what its toe makes it lose sideways.
        close(found.area, found.energy, 5e-3);
        for wedges in [WedgeType::Plain, WedgeType::Spatial] {
            let own = truck(wedges, damping, YawCase::Straight);
            let column = |what: &str| own.column(what).unwrap();
            let times = column("time");
            let found = numbers(group, ComparedModel::Type(wedges));
            let [down, up] = means(
                times,
                column("input_vertical"),
                column("input_vertical_rate"),
                column("wedge_127_column_friction"),
            );
            close(found.up, up, 1e-12);
            close(found.down, down, 1e-12);
            // Power over time against force over stroke.
            let lost: f64 = (0..times.len())
                .filter(|i| times[*i] > 0.5 * PI && times[*i] <= 2.5 * PI)
                .map(|i| -0.01 * column("wedge_127_friction_power")[i])
                .sum();
            // Rows of 0.01 s miss some of the first cycle's rattling with variable damping.
            let tolerance = if damping == Damping::Constant { 2e-3 } else { 0.03 };
            close(found.area, 0.5 * lost, tolerance);
            // The ledger's loss at the four columns, alike without yaw, is exact in time.
            // Two cycles from the half period on, between rows straight.
            let loss = column("wedge_column_loss");
            let at = |time: f64| {
                let row = (100.0 * time).floor();
                let (row, share) = (row as usize, 100.0 * time - row);
                loss[row] + share * (loss[row + 1] - loss[row])
            };
            let ledger = (at(2.5 * PI) - at(0.5 * PI)) / 8.0;
            close(found.energy, ledger, 2e-3);
        }
    }
}

/// The closed form against the formulas of its loops: without weight, type 6.8 has no angle.
#[test]
fn loops_of_the_elements_alone_are_the_known_ones() {
    let per_cent = |group: &Agreement, wedges, found: fn(&reproduction::agreement::Stroke) -> f64| {
        found(group.strokes.iter().find(|own| own.wedges == wedges).unwrap())
    };
    let slope = |angle: f64, toe: f64| {
        let (t, p) = (angle.to_radians(), toe.to_radians());
        0.4 * 2.0 * t.cos() / (1.16 * (t + p).sin())
    };
    let inch_pounds = |value: f64| value / (POUND * INCH);
    let variable = agreement(Damping::Variable, false);
    let constant = agreement(Damping::Constant, false);
    let alone = |group, wedges| inch_pounds(per_cent(group, wedges, |stroke| stroke.alone));
    close(
        alone(variable, WedgeType::Plain),
        0.5 * 3000.0 * slope(32.0, 0.0),
        1e-4,
    );
    let (t, p) = (32.0_f64.to_radians(), 0.2_f64.to_radians());
    let rise = t.sin() / (t + p).sin();
    close(
        alone(variable, WedgeType::Spatial),
        0.5 * 3000.0 * slope(32.0, 0.2) * rise,
        1e-4,
    );
    close(
        alone(constant, WedgeType::Plain),
        2.0 * 3702.2 * slope(37.5, 0.0),
        1e-3,
    );
    close(
        alone(constant, WedgeType::Spatial),
        2.0 * 3702.2 * slope(37.5, 0.2),
        1e-3,
    );
    // In the half-truck: deeper with variable damping, shorter with constant damping, and that is most of the
    // difference. The rest is the ringing of the input springs after the start, which crosses the loop again
    // and again with variable damping, and with constant damping the accumulators, which narrow the loop.
    let groups = [
        (variable, 1.09..1.12, 1.02..1.06),
        (constant, 0.96..0.975, 0.99..1.0),
    ];
    for (group, of_stroke, of_rest) in groups {
        for wedges in [WedgeType::Plain, WedgeType::Spatial] {
            let share = per_cent(group, wedges, |stroke| stroke.shortened / stroke.alone);
            assert!(of_stroke.contains(&share), "{share}");
            let rest = per_cent(group, wedges, |stroke| stroke.found / stroke.shortened);
            assert!(of_rest.contains(&rest), "{rest}");
        }
    }
}

fn rows(trucks: &[TruckOutcome]) -> Vec<ClaimRow> {
    let evidence = Evidence::new(runs().0.iter().map(|(case, result)| (case, result)))
        .with_trucks(trucks.iter().map(|(entry, result)| (entry, result)));
    let rows = evaluate(&evidence);
    rows.into_iter()
        .filter(|row| row.group == ClaimGroup::Comparison)
        .collect()
}

#[test]
fn claims_are_decided_from_the_half_truck() {
    let rows = rows(&runs().1);
    assert!(rows.len() > 30);
    for row in &rows {
        assert_eq!(
            row.verdict == ClaimVerdict::CannotBeDecided,
            row.code.is_empty(),
            "{} {}",
            row.id,
            row.note
        );
        assert_eq!(
            row.verdict == ClaimVerdict::Holds,
            row.note.is_empty(),
            "{}",
            row.id
        );
        assert!(!row.note.contains("Why is not known"), "{}", row.id);
    }
    // Values are those of the types' columns.
    let row = rows
        .iter()
        .find(|row| row.id == "5.1-types-magnitudes-up")
        .unwrap();
    let value = row
        .values
        .iter()
        .find(|value| value.label.contains("type 6.9"))
        .unwrap();
    let group = agreement(Damping::Variable, false);
    close(
        value.measure.value * POUND,
        numbers(group, ComparedModel::Type(WedgeType::Spatial)).up,
        1e-9,
    );
    assert_eq!(row.verdict, ClaimVerdict::DoesNot);
}

#[test]
fn without_the_half_truck_they_are_not() {
    for row in rows(&[]) {
        assert_eq!(row.verdict, ClaimVerdict::CannotBeDecided, "{}", row.id);
        assert!(
            row.code.is_empty() || row.note.contains("was not made"),
            "{}",
            row.note
        );
    }
    // Runs with the yaw as printed stand for none with yaw.
    let mut trucks = runs().1.clone();
    for (entry, _) in &mut trucks {
        if entry.yaw == YawCase::Intended {
            entry.yaw = YawCase::Printed;
        }
    }
    for row in rows(&trucks) {
        let yawed = row.code.contains("_yaw_6");
        if yawed {
            assert_eq!(row.verdict, ClaimVerdict::CannotBeDecided, "{}", row.id);
        }
    }
    // A stopped run decides nothing.
    let mut trucks = runs().1.clone();
    for (_, result) in &mut trucks {
        result.summary.complete = false;
    }
    assert!(
        rows(&trucks)
            .iter()
            .all(|row| row.verdict == ClaimVerdict::CannotBeDecided)
    );
    assert!(groups(&runs().0, &trucks).is_empty());
}

/// Results of one type taken for those of the other change what is found.
#[test]
fn types_are_told_apart() {
    let mut trucks = runs().1.clone();
    for (entry, _) in &mut trucks {
        entry.wedges = match entry.wedges {
            WedgeType::Plain => WedgeType::Spatial,
            WedgeType::Spatial => WedgeType::Plain,
        };
    }
    let changed = rows(&trucks);
    let row = |id: &str| changed.iter().find(|row| row.id == id).unwrap();
    assert_eq!(row("5.1-type-6.8-plane").verdict, ClaimVerdict::DoesNot);
    assert_eq!(row("5.2-dissipation-closer-to-6.9").verdict, ClaimVerdict::Holds);
    assert_eq!(
        row("6.2-longitudinal-same-magnitude").verdict,
        ClaimVerdict::CannotBeDecided
    );
}

#[test]
fn the_page_tells_how_far_they_agree() {
    let (outcomes, trucks) = runs();
    let claims = Claims::of(Vec::new());
    let comparison = Comparison {
        groups: agreements(),
        trucks,
        units: quantity::System::Us,
    };
    let mut contents = Contents {
        beyond: &[],
        view: "{}",
        outcomes,
        claims: &claims,
        sensitivity: None,
        sections: &[],
        comparison: Some(comparison),
        truck: false,
    };
    let text = page::render(&contents);
    let straight = numbers(
        agreement(Damping::Constant, false),
        ComparedModel::Type(WedgeType::Spatial),
    );
    let energy = format!("{:.0} (", straight.energy / (POUND * INCH));
    assert!(
        text.contains("id=\"agreement\"") && text.contains(&energy),
        "{energy}"
    );
    assert!(text.contains("nucars_69_variable_toe_out_yaw"));
    contents.comparison = None;
    assert!(!page::render(&contents).contains("agreement"));
}

/// What scripts D.1 draw as dissipation is the whole vertical force times the size of the speed, of which
/// friction is a part: the numbers that the pages give, of the leading left wedge of type 6.9 (variable
/// damping, toe out) in 10 s and in its second cycle.
#[test]
fn reproduction_the_dissipation_of_her_figures_is_no_loss() {
    let result = truck(WedgeType::Spatial, Damping::Variable, YawCase::Straight);
    let column = |name: &str| result.column(&format!("wedge_127_{name}")).unwrap();
    let time = result.column("time").unwrap();
    let integral = |force: &str, from: f64, to: f64| {
        let power: Vec<f64> = column(force)
            .iter()
            .zip(column("stroke_rate"))
            .map(|(force, speed)| (force * speed).abs() / (POUND * INCH))
            .collect();
        let steps = time.windows(2).zip(power.windows(2));
        let steps = steps.filter(|(time, _)| time[0] >= from && time[1] <= to);
        steps
            .map(|(time, power)| 0.5 * (time[1] - time[0]) * (power[0] + power[1]))
            .sum::<f64>()
    };
    let [whole, friction, cycle] = [
        integral("vertical_force", 0.0, 10.0),
        integral("column_friction", 0.0, 10.0),
        integral("column_friction", PI, 2.0 * PI),
    ];
    for (found, said) in [(whole, 9060.0), (friction, 5740.0), (cycle, 1800.0)] {
        assert!((found / said - 1.0).abs() < 0.01, "{found} {said}");
    }
}
