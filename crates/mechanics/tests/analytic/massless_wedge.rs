//! The quasi-static massless wedge.

use super::*;

// The massless wedge

const LEGS: [(f64, f64); 2] = [(32.0, 3000.0), (37.5, 3702.2)];

fn wedge(angle: f64, toe: f64, column: f64, slope: f64) -> QuasiStaticWedge {
    QuasiStaticWedge {
        angle: angle * PI / 180.0,
        toe: toe * PI / 180.0,
        column_friction: column,
        slope_friction: slope,
    }
}

#[test]
fn massless_wedge_with_toe_out() {
    // Down: N_c, μN_c; up: N_c, μN_c; lbf (the formulas have no units).
    let numbers = [
        [
            (0.2, [3087.1, 1234.8, 5144.6, 2057.8]),
            (0.0, [3104.3, 1241.7, 5173.3, 2069.3]),
            (-0.2, [3121.8, 1248.7, 5202.4, 2080.9]),
        ],
        [
            (0.2, [2869.7, 1147.9, 5411.3, 2164.5]),
            (0.0, [2882.7, 1153.1, 5435.9, 2174.4]),
            (-0.2, [2895.9, 1158.4, 5460.8, 2184.3]),
        ],
    ];
    for ((angle, force), rows) in LEGS.into_iter().zip(numbers) {
        for (toe, [down, down_friction, up, up_friction]) in rows {
            let one = wedge(angle, toe, 0.4, 0.4);
            let down_found = one
                .slide(SlidingDirection::Down, SlopeFriction::DownSlope, force)
                .unwrap();
            let up_found = one
                .slide(SlidingDirection::Up, SlopeFriction::UpSlope, force)
                .unwrap();
            close(down_found.column_normal, down, 0.05);
            close(down_found.column_friction, down_friction, 0.05);
            close(up_found.column_normal, up, 0.05);
            close(up_found.column_friction, up_friction, 0.05);
        }
    }
}

#[test]
fn massless_wedge_with_toe_in() {
    for ((angle, force), (normal, friction)) in LEGS.into_iter().zip([(1699.9, 680.0), (1777.2, 710.9)]) {
        let one = wedge(angle, -0.2, 0.4, 0.4);
        let up = one
            .slide(SlidingDirection::Up, SlopeFriction::DownSlope, force)
            .unwrap();
        close(up.column_normal, normal, 0.05);
        close(up.column_friction, friction, 0.05);
        assert_eq!(
            one.slide(SlidingDirection::Down, SlopeFriction::UpSlope, force),
            None,
            "it jams"
        );
    }
}

#[test]
fn massless_wedge_on_a_frictionless_slope() {
    for ((angle, force), (down, up)) in LEGS.into_iter().zip([(13341.0, 2927.0), (10079.0, 3171.5)]) {
        let one = wedge(angle, 0.0, 0.4, 0.0);
        for slope in [SlopeFriction::UpSlope, SlopeFriction::DownSlope] {
            let found = |direction| one.slide(direction, slope, force).unwrap().column_normal;
            close(found(SlidingDirection::Down), down, 0.5);
            close(
                found(SlidingDirection::Up),
                up,
                if angle == 32.0 { 0.5 } else { 0.05 },
            );
            // N = F / (tan θ - a μ)
            let t = one.angle.tan();
            close(found(SlidingDirection::Down), force / (t - 0.4), 1e-6);
            close(found(SlidingDirection::Up), force / (t + 0.4), 1e-6);
        }
    }
}

#[test]
fn branches_and_jam() {
    use SlidingDirection::{Down, Up};
    use SlopeFriction::{DownSlope, UpSlope};
    for (toe, down, up) in [
        (0.2, DownSlope, UpSlope),
        (0.0, DownSlope, UpSlope),
        (-0.2, UpSlope, DownSlope),
    ] {
        let one = wedge(32.0, toe, 0.4, 0.4);
        assert_eq!((one.branch(Down), one.branch(Up)), (down, up));
    }
    for (angle, critical) in [(32.0, 0.287), (37.5, 0.339)] {
        let value = wedge(angle, 0.0, 0.4, 0.4).critical_friction();
        close(value, critical, 0.0005);
        let jams = |mu: f64| wedge(angle, 0.0, mu, mu).slide(Down, UpSlope, 1.0).is_none();
        assert!(!jams(value * (1.0 - 1e-9)) && jams(value * (1.0 + 1e-9)));
        let margin = |mu: f64| wedge(angle, 0.0, mu, mu).jam_margin(Down, UpSlope);
        close(margin(value), 0.0, 1e-15);
        assert!(margin(0.9 * value) > 0.0 && margin(1.1 * value) < 0.0);
    }
}

/// Force balance of the wedge, with the contact forces along normals and tangents, solved as two linear
/// equations.
#[test]
fn massless_wedge_in_force_balance() {
    let mut random = Random(10);
    let (mut sliding, mut jammed) = (0, 0);
    for _ in 0..5000 {
        let one = QuasiStaticWedge {
            angle: random.between(0.2, 1.2),
            toe: random.between(-0.02, 0.02),
            column_friction: random.between(0.0, 0.8),
            slope_friction: random.between(0.0, 0.8),
        };
        let force = random.between(100.0, 5000.0);
        for direction in [SlidingDirection::Down, SlidingDirection::Up] {
            for slope in [SlopeFriction::UpSlope, SlopeFriction::DownSlope] {
                let (st, ct) = one.angle.sin_cos();
                let (sp, cp) = one.toe.sin_cos();
                // The bolster takes the wedge along: friction of the column acts up while it moves down.
                let up = if direction == SlidingDirection::Down {
                    1.0
                } else {
                    -1.0
                };
                let along = if slope == SlopeFriction::UpSlope {
                    1.0
                } else {
                    -1.0
                };
                // Columns: force per normal force on the column (normal (cos φ, -sin φ), upwards (sin φ, cos
                // φ)) and on the slope (normal (-cos θ, -sin θ), upwards (-sin θ, cos θ)).
                let (mc, ms) = (up * one.column_friction, along * one.slope_friction);
                let column = [cp + mc * sp, -sp + mc * cp];
                let incline = [-ct - ms * st, -st + ms * ct];
                let determinant = column[0] * incline[1] - column[1] * incline[0];
                let normal = incline[0] * force / determinant;
                let slope_normal = -column[0] * force / determinant;
                match one.slide(direction, slope, force) {
                    Some(found) => {
                        sliding += 1;
                        let size = normal.abs() + slope_normal.abs();
                        close(found.column_normal, normal, 1e-9 * size);
                        close(found.slope_normal, slope_normal, 1e-9 * size);
                        close(found.column_friction, one.column_friction * normal, 1e-9 * size);
                        assert!(found.column_normal >= 0.0 && found.slope_normal >= 0.0);
                    }
                    None => {
                        jammed += 1;
                        assert!(
                            normal < 0.0 || slope_normal < 0.0,
                            "{one:?} {direction:?} {slope:?}"
                        );
                    }
                }
            }
        }
    }
    assert!(sliding > 1000 && jammed > 100);
}

#[test]
fn partly_mobilized_friction_ends_in_steady_sliding() {
    for toe in [-0.2_f64, 0.0, 0.2, 5.0] {
        let wedge = QuasiStaticWedge {
            angle: 32.0_f64.to_radians(),
            toe: toe.to_radians(),
            column_friction: 0.35,
            slope_friction: 0.2,
        };
        for (mobilized, direction) in [(1.0, SlidingDirection::Down), (-1.0, SlidingDirection::Up)] {
            let steady = wedge.slide(direction, wedge.branch(direction), 3000.0).unwrap();
            let [column, slope] = wedge.normal_forces(mobilized, 3000.0).unwrap();
            assert!((column / steady.column_normal - 1.0).abs() < 1e-12);
            assert!((slope / steady.slope_normal - 1.0).abs() < 1e-12);
        }
        // Without friction: the balance of three forces.
        let [column, slope] = wedge.normal_forces(0.0, 3000.0).unwrap();
        let sum = wedge.angle + wedge.toe;
        assert!((column - 3000.0 * wedge.angle.cos() / sum.sin()).abs() < 1e-9);
        assert!((slope - 3000.0 * wedge.toe.cos() / sum.sin()).abs() < 1e-9);
    }
    let jams = QuasiStaticWedge {
        angle: 0.3,
        toe: -0.1,
        column_friction: 0.4,
        slope_friction: 0.4,
    };
    assert!(jams.normal_forces(1.0, 1.0).is_none());
}

/// The lock-up margin has the sign of a search over all directions in space: is there a line along which the
/// reaction of the column and that of the slope, each within its friction cone, are opposite?
#[test]
fn lock_up_margin_is_where_the_friction_cones_hold_a_line_in_common() {
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let mut random = Random(63);
    let mut found = [0, 0];
    while found[0] < 20 || found[1] < 20 {
        let one = QuasiStaticWedge {
            angle: random.between(0.2, 1.2),
            toe: random.between(-0.15, 0.3),
            column_friction: random.between(0.0, 0.8),
            slope_friction: random.between(0.0, 0.8),
        };
        let yaw = random.between(-0.6, 0.6);
        let ((st, ct), (sp, cp), (sy, cy)) = (one.angle.sin_cos(), one.toe.sin_cos(), yaw.sin_cos());
        let column = [cp, 0.0, -sp];
        let slope = [-ct * cy, -ct * sy, -st];
        close(one.closing_angle(yaw).cos(), -dot(column, slope), 1e-12);
        let margin = one.lock_up_margin(yaw);
        if margin.abs() < 0.03 {
            continue;
        }
        let [cone_c, cone_s] = [one.column_friction, one.slope_friction].map(|mu| mu.atan().cos());
        let steps = 240;
        let mut held = false;
        for i in 0..steps {
            for j in 0..steps {
                let [up, across] = [i, j].map(|k| PI * (f64::from(k) / f64::from(steps) - 0.5));
                let line = [up.cos() * across.cos(), up.cos() * across.sin(), up.sin()];
                held |= dot(line, column) >= cone_c && -dot(line, slope) >= cone_s;
            }
        }
        assert_eq!(held, margin < 0.0, "{one:?} yaw {yaw}: {margin}");
        found[usize::from(held)] += 1;
    }
}

/// Without yaw it is the margin of steady sliding with both frictions against the wedge.
#[test]
fn lock_up_margin_tells_where_steady_sliding_ends() {
    use SlidingDirection::Down;
    use SlopeFriction::UpSlope;
    for angle in [20.0, 32.0, 37.5, 50.0] {
        for toe in [-5.0, 0.0, 0.2, 5.0] {
            for friction in [0.05, 0.2, 0.3, 0.4, 0.6] {
                let one = wedge(angle, toe, friction, 0.8 * friction);
                let margin = one.lock_up_margin(0.0);
                close(margin, one.jam_margin(Down, UpSlope), 1e-15);
                assert_eq!(one.slide(Down, UpSlope, 1.0).is_none(), margin <= 0.0, "{one:?}");
            }
        }
    }
    let turned_over = wedge(18.0, -20.0, 0.4, 0.4);
    close(turned_over.closing_angle(0.0).to_degrees(), -2.0, 1e-12);
    assert!(turned_over.closing_angle(0.01) < 0.0 && turned_over.lock_up_margin(0.0) < 0.0);
}
