//! Positions of the corners at the start, and the forces of the position of rest: closed forms.

use crate::common;
use common::{INCH, LBF, Random, TOE, YAW};
use integrate::Problem;
use mechanics::coil::CoilLine;
use mechanics::motion::Motion;
use wedge::parameters::{Damping, NeighbourMotion, Parameters, Start};
use wedge::{COLUMN, SLOPE, WEDGE, Wedge, thesis};

const BOTH: [Damping; 2] = [Damping::Variable, Damping::Constant];

/// Gaps of column and slope at the start, in: lower right (-y), lower left, upper right, upper left.
fn start_gaps(parameters: Parameters) -> [[f64; 4]; 2] {
    let mut wedge = Wedge::new(parameters).unwrap();
    let start = wedge.initial_state.clone();
    let observation = wedge.system.observe(0.0, &start);
    [COLUMN, SLOPE].map(|face| std::array::from_fn(|i| observation.faces[face].points[i].gap / INCH))
}

fn assert_gaps(gaps: [f64; 4], expected: [f64; 4]) {
    for (gap, expected) in gaps.iter().zip(expected) {
        assert!((gap - expected).abs() < 1e-13, "{gaps:?}, expected {expected:?}");
    }
}

#[test]
fn faces_just_touch_in_the_nominal_position() {
    for damping in BOTH {
        for gaps in start_gaps(thesis::parameters(damping, 0.0, 0.0)) {
            assert_gaps(gaps, [0.0; 4]);
        }
    }
}

#[test]
fn toe_and_yaw_make_the_right_corners_penetrate() {
    for damping in BOTH {
        let cos = thesis::parameters(damping, 0.0, 0.0).wedge.angle.cos();
        for yaw in [-YAW, 0.0, YAW] {
            for toe in [-TOE, 0.0, TOE] {
                let [column, slope] = start_gaps(thesis::parameters(damping, toe, yaw));
                // Toe out opens the gap downwards: the upper corners are inside.
                let depth = 0.5 * 6.125 * toe.sin();
                assert_gaps(column, [depth, depth, -depth, -depth]);
                // Yaw to the left brings the slope's +y half (n has -y) onto the wedge, by its width; the
                // height of the corner also counts, as the slope leans: its trace turns about the pocket's
                // center.
                let side = 0.5 * 10.5 * cos * yaw.sin();
                let tilt = 0.5
                    * 6.125
                    * cos
                    * thesis::parameters(damping, 0.0, 0.0).wedge.angle.tan()
                    * (1.0 - yaw.cos());
                assert_gaps(slope, [side + tilt, -side + tilt, side - tilt, -side - tilt]);
            }
        }
    }
    // The specification's digits.
    assert!((0.5 * 6.125 * TOE.sin() - 0.0107).abs() < 5e-5);
    assert!((0.5 * 10.5 * 32_f64.to_radians().cos() * YAW.sin() - 0.053).abs() < 5e-4);
}

#[test]
fn a_touching_start_touches_and_does_not_penetrate() {
    for damping in BOTH {
        for (toe, yaw) in [(TOE, 0.0), (-TOE, 0.0), (0.0, YAW), (TOE, -YAW), (-TOE, YAW)] {
            let mut parameters = thesis::parameters(damping, toe, yaw);
            parameters.start = Start::Touching;
            for (gaps, apart) in start_gaps(parameters).iter().zip([toe, yaw]) {
                let least = gaps.iter().copied().fold(f64::INFINITY, f64::min);
                assert!(least.abs() < 1e-12, "least gap {least:e} in");
                if apart != 0.0 {
                    assert!(gaps.iter().any(|gap| *gap > 1e-3), "{gaps:?}");
                }
            }
        }
    }
}

#[test]
fn equilibrium_is_at_rest_with_the_closed_forms_of_statics() {
    for toe in [-TOE, 0.0, TOE] {
        let mut parameters = thesis::parameters(Damping::Constant, toe, 0.0);
        parameters.start = Start::Equilibrium;
        let angle = parameters.wedge.angle;
        let mut wedge = Wedge::new(parameters).unwrap();
        // The bolster moves at time zero, and friction with it: look at the frictionless forces only.
        let start = wedge.initial_state.clone();
        let observation = wedge.system.observe(0.0, &start);
        let sum = |face: usize| -> f64 {
            observation.faces[face]
                .points
                .iter()
                .map(|p| p.normal)
                .sum::<f64>()
                / LBF
        };
        let coil = observation.coils[0].spring_force.0.map(|f| f / LBF);
        // Two unknown normal forces: n_c = (cos φ, -sin φ), n_s = (-cos θ, -sin θ); coil (0, F) and weight
        // (0, -W).
        let (column, slope) = (sum(COLUMN), sum(SLOPE));
        let x = column * toe.cos() - slope * angle.cos() + coil[0];
        let z = -column * toe.sin() - slope * angle.sin() + coil[2] - 50.0;
        assert!(x.abs() < 1e-6 && z.abs() < 1e-6, "{x:e} {z:e} lbf");
        let lift = coil[2] - 50.0 + coil[0] * toe.tan();
        let expected = lift / (angle.sin() + angle.cos() * toe.tan());
        assert!((slope / expected - 1.0).abs() < 1e-9, "{slope} {expected}");
        if toe == 0.0 {
            assert!((slope / (lift / angle.sin()) - 1.0).abs() < 1e-9);
            // The coil leans with the wedge, a hundredth of an inch.
            assert!(((column + coil[0]) / (lift / angle.tan()) - 1.0).abs() < 1e-9);
            assert!(coil[0].abs() < 10.0);
        }
        assert!(
            (coil[2] - 3702.2).abs() < 60.0,
            "the coil keeps its preload: {}",
            coil[2]
        );
        // Still without friction and motion: accelerations vanish.
        let mut still = thesis::parameters(Damping::Constant, toe, 0.0);
        still.bolster = NeighbourMotion::fixed();
        still.start = Start::Equilibrium;
        let mut wedge = Wedge::new(still).unwrap();
        let start = wedge.initial_state.clone();
        let mut dx = vec![0.0; start.len()];
        wedge.system.derivative(0.0, &start, &mut dx);
        let largest = dx[4..8].iter().fold(0.0_f64, |m, a| m.max(a.abs()));
        assert!(largest < 1e-6, "{largest:e}");
    }
}

#[test]
fn a_free_wedge_sags_by_its_weight_over_the_coil() {
    for acts_at in [CoilLine::CenterOfGravity, CoilLine::Seat] {
        let mut parameters = thesis::parameters(Damping::Variable, 0.0, 0.0);
        parameters.start = Start::Equilibrium;
        parameters.coil.acts_at = acts_at;
        // The bolster is lifted away; the column just touches.
        parameters.bolster.coordinates[2] = Motion::Constant(INCH);
        // Free in x the wedge would topple off its coil (a negative stiffness of weight over length); with
        // the coil at its seat, beside the center of gravity, it would lean.
        parameters.wedge.free = match acts_at {
            CoilLine::CenterOfGravity => common::free(&["z", "pitch", "yaw"]),
            CoilLine::Seat => common::free(&["z"]),
        };
        let mut wedge = Wedge::new(parameters).unwrap();
        let start = wedge.initial_state.clone();
        let observation = wedge.system.observe(0.0, &start);
        let z = observation.bodies[WEDGE].coordinates[2] / INCH;
        assert!((z + 50.0 / 3000.0).abs() < 1e-9, "{z}");
        assert!((observation.coils[0].coil.spring / LBF - 50.0).abs() < 1e-5);
    }
}

/// All eight gaps at random poses of wedge, bolster and side frame, against planes computed here.
#[test]
fn gaps_at_random_poses() {
    let turn = |[roll, pitch, yaw]: [f64; 3]| {
        let (sr, cr) = roll.sin_cos();
        let (sp, cp) = pitch.sin_cos();
        let (sy, cy) = yaw.sin_cos();
        // Ry Rz Rx, multiplied out by hand.
        [
            [cp * cy, -cp * sy * cr + sp * sr, cp * sy * sr + sp * cr],
            [sy, cy * cr, -cy * sr],
            [-sp * cy, sp * sy * cr + cp * sr, -sp * sy * sr + cp * cr],
        ]
    };
    let apply = |m: &[[f64; 3]; 3], v: [f64; 3]| -> [f64; 3] {
        std::array::from_fn(|i| m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2])
    };
    let mut random = Random(3);
    for k in 0..200 {
        let damping = BOTH[k % 2];
        let toe = random.between(-0.02, 0.02);
        let mut parameters = thesis::parameters(damping, toe, 0.0);
        parameters.wedge.free = [true; 6];
        let mut poses = [[0.0; 6]; 2];
        for (pose, neighbour) in poses
            .iter_mut()
            .zip([&mut parameters.side_frame, &mut parameters.bolster])
        {
            for (i, value) in pose.iter_mut().enumerate() {
                *value = random.between(-0.1, 0.1) * if i < 3 { INCH } else { 1.0 };
                // At time 1; the motion itself does not matter here.
                neighbour.coordinates[i] = if k % 3 == 0 {
                    Motion::Constant(*value)
                } else {
                    Motion::Sine {
                        amplitude: *value,
                        angular_frequency: std::f64::consts::FRAC_PI_2,
                        phase: 0.0,
                    }
                };
            }
        }
        let theta = parameters.wedge.angle;
        let length = parameters.coil.nominal_length / INCH;
        let mut wedge = Wedge::new(parameters).unwrap();
        let mut x = wedge.initial_state.clone();
        let q: [f64; 6] = std::array::from_fn(|i| random.between(-0.1, 0.1) * if i < 3 { INCH } else { 1.0 });
        x[..6].copy_from_slice(&q);
        let observation = wedge.system.observe(1.0, &x);

        let bottom = 6.125 * theta.tan();
        let face_x = -1.0734 - bottom / 3.0;
        let middle = length + 3.0625;
        let body = turn([q[3], q[4], q[5]]);
        for face in [COLUMN, SLOPE] {
            let (lower_x, center_x, normal) = if face == COLUMN {
                (face_x, face_x, [toe.cos(), 0.0, -toe.sin()])
            } else {
                (
                    face_x + bottom,
                    face_x + 0.5 * bottom,
                    [-theta.cos(), 0.0, -theta.sin()],
                )
            };
            let pose = &poses[face];
            let n = apply(&turn([pose[3], pose[4], pose[5]]), normal);
            let plane = [center_x + pose[0] / INCH, pose[1] / INCH, middle + pose[2] / INCH];
            let corners = [
                [lower_x, -5.25, 0.0],
                [lower_x, 5.25, 0.0],
                [face_x, -5.25, 6.125],
                [face_x, 5.25, 6.125],
            ];
            for (point, corner) in observation.faces[face].points.iter().zip(corners) {
                let r = apply(&body, corner);
                let place = [
                    r[0] + q[0] / INCH,
                    r[1] + q[1] / INCH,
                    r[2] + q[2] / INCH + length,
                ];
                let gap: f64 = (0..3).map(|i| (place[i] - plane[i]) * n[i]).sum();
                assert!(
                    (point.gap / INCH - gap).abs() < 1e-13,
                    "{} {gap}",
                    point.gap / INCH
                );
            }
        }
    }
}
