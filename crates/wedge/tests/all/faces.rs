//! Crowned and worn faces, friction over a face, pads.

use crate::common;
use common::{INCH, LBF, LBF_PER_IN};
use integrate::Problem;
use mechanics::spline::Spline;
use mechanics::surface::SurfaceProfile;
use wedge::face::{DepthMap, FaceDirection, FaceProfile, FaceProperties, Grid, Pad};
use wedge::parameters::Damping;
use wedge::{Parameters, Start, Wedge, thesis};

fn arc(radius: f64, direction: FaceDirection) -> FaceProfile {
    FaceProfile {
        profile: SurfaceProfile::Arc {
            curvature: 1.0 / radius,
        },
        direction,
        ..FaceProfile::default()
    }
}

fn table(direction: FaceDirection) -> FaceProfile {
    let places = [-6.0, -3.0, -1.0, 2.0, 6.0].map(|place| place * INCH);
    let depths = [0.04, 0.008, 0.0, 0.003, 0.03].map(|depth| depth * INCH);
    FaceProfile {
        profile: SurfaceProfile::Table(Spline::new(places.to_vec(), depths.to_vec()).unwrap()),
        direction,
        ..FaceProfile::default()
    }
}

fn base(start: Start) -> Parameters {
    let mut parameters = thesis::parameters(Damping::Constant, 0.0, 0.0);
    parameters.start = start;
    parameters
}

#[test]
fn limits_crowns_of_infinite_radius_are_flat() {
    for up in [2, 5] {
        let grid = Grid { up, across: up };
        let built = |radius: Option<f64>| {
            let mut parameters = thesis::parameters(Damping::Variable, 0.003, 0.012);
            for face in [&mut parameters.column_face, &mut parameters.slope_face] {
                face.grid = grid;
                if let Some(radius) = radius {
                    face.wedge_surface = arc(radius, FaceDirection::Up);
                    face.counterface = arc(radius, FaceDirection::Across);
                }
            }
            Wedge::new(parameters).unwrap()
        };
        let rates = |wedge: &mut Wedge| {
            let x = wedge.initial_state.clone();
            let mut dx = vec![0.0; x.len()];
            wedge.system.derivative(0.0, &x, &mut dx);
            dx
        };
        let flat = rates(&mut built(None));
        let far = rates(&mut built(Some(1e13)));
        let size = flat.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
        for (flat, far) in flat.iter().zip(&far) {
            assert!((flat - far).abs() < 1e-11 * size, "{flat} {far}");
        }
    }
}

#[test]
fn analytic_points_of_a_crown_lie_on_its_arc() {
    let radius = 60.0 * INCH;
    for (number, direction) in [
        (0, FaceDirection::Up),
        (1, FaceDirection::Up),
        (1, FaceDirection::Across),
    ] {
        let parameters = base(Start::Rest);
        let rectangle = parameters.rectangles()[number];
        let mut face = FaceProperties {
            grid: Grid { up: 5, across: 5 },
            ..FaceProperties::default()
        };
        let flat = face.points(&rectangle, &parameters.contact);
        face.wedge_surface = arc(radius, direction);
        let crowned = face.points(&rectangle, &parameters.contact);
        // Into the wedge, from the counterface.
        let angle = parameters.wedge.angle;
        let inward = match number {
            0 => [1.0, 0.0, 0.0],
            _ => [-libm::cos(angle), 0.0, -libm::sin(angle)],
        };
        let middle = flat.iter().fold([0.0; 3], |sum: [f64; 3], point| {
            std::array::from_fn(|k| sum[k] + point.position.0[k] / flat.len() as f64)
        });
        let mut most: f64 = 0.0;
        for (flat, crowned) in flat.iter().zip(&crowned) {
            let moved: [f64; 3] = std::array::from_fn(|k| crowned.position.0[k] - flat.position.0[k]);
            let depth: f64 = (0..3).map(|k| moved[k] * inward[k]).sum();
            let rest: f64 = (0..3).map(|k| (moved[k] - depth * inward[k]).abs()).sum();
            assert!(rest < 1e-15);
            most = most.max(depth);
            let along = match direction {
                FaceDirection::Across => flat.position.0[1],
                FaceDirection::Up => {
                    libm::hypot(flat.position.0[0] - middle[0], flat.position.0[2] - middle[2])
                }
            };
            // The center of the arc lies inward by the radius.
            assert!((libm::hypot(along, radius - depth) - radius).abs() < 1e-13);
        }
        assert!(most > 0.05 * INCH);
    }
}

/// Returns a map over the whole face of a thesis wedge, of depths by the shares up and across (both from 0 to
/// 1).
fn map(parameters: &Parameters, number: usize, depth: impl Fn(f64, f64) -> f64) -> DepthMap {
    let rectangle = parameters.rectangles()[number];
    let shares = [0.0, 0.3, 0.5, 1.0];
    let points: Vec<[f64; 3]> = shares
        .iter()
        .flat_map(|u| shares.map(|a| (*u, a)))
        .map(|(u, a)| {
            let place = [rectangle.length() * (u - 0.5), rectangle.width * (a - 0.5)];
            [place[0], place[1], depth(u, a)]
        })
        .collect();
    DepthMap::new(&points).unwrap()
}

#[test]
fn limits_a_map_of_no_depth_changes_no_bit() {
    let run = |worn: bool| {
        let mut parameters = thesis::parameters(Damping::Variable, 0.003, 0.012);
        for number in [0, 1] {
            let own = worn.then(|| map(&parameters, number, |_, _| 0.0));
            let face = match number {
                0 => &mut parameters.column_face,
                _ => &mut parameters.slope_face,
            };
            (face.grid, face.wedge_wear) = (Grid { up: 5, across: 3 }, own);
        }
        let mut wedge = Wedge::new(parameters).unwrap();
        let x = wedge.initial_state.clone();
        let mut dx = vec![0.0; x.len()];
        wedge.system.derivative(0.0, &x, &mut dx);
        (x, dx)
    };
    assert_eq!(run(true), run(false));
}

/// A wedge worn evenly by a map stands where one stands whose counterfaces are worn as deep.
#[test]
fn analytic_even_maps_raise_the_wedge_as_even_wear_does() {
    let [column, slope] = [0.05 * INCH, 0.08 * INCH];
    let height = |parameters: Parameters| {
        let mut wedge = Wedge::new(parameters).unwrap();
        let observation = wedge.system.observe(0.0, &wedge.initial_state);
        observation.bodies[wedge::WEDGE].coordinates[2]
    };
    let start = base(Start::Equilibrium);
    let [mut even, mut worn] = [start.clone(), start.clone()];
    (even.wear.column, even.wear.slope) = (column, slope);
    worn.column_face.wedge_wear = Some(map(&worn, 0, |_, _| column));
    worn.slope_face.wedge_wear = Some(map(&worn, 1, |_, _| slope));
    let rise = even.wedge_rise();
    let unworn = height(start);
    let [even, worn] = [even, worn].map(|parameters| height(parameters) - unworn);
    assert!((worn - even).abs() < 2e-3 * rise, "{worn} {even}");
    assert!((worn - rise).abs() < 0.05 * rise, "{worn} {rise}");
}

/// A counterface worn by a cubic map along either coordinate is the counterface with that cubic as its table,
/// at both faces: places and senses are right.
#[test]
fn analytic_a_cubic_map_of_a_counterface_is_its_table() {
    let cubic = |s: f64| 2.0 * s * s - 20.0 * s * s * s + 0.01 * s;
    let rates = |parameters: Parameters| {
        let mut wedge = Wedge::new(parameters).unwrap();
        let x = wedge.initial_state.clone();
        let mut dx = vec![0.0; x.len()];
        wedge.system.derivative(0.0, &x, &mut dx);
        let observation = wedge.system.observe(0.0, &x);
        let points = observation.faces.iter().flat_map(|face| &face.points);
        let gaps: Vec<f64> = points.map(|point| point.gap).collect();
        (gaps, dx)
    };
    for number in [0, 1] {
        for direction in [FaceDirection::Up, FaceDirection::Across] {
            let built = |by_map: bool| {
                let mut parameters = thesis::parameters(Damping::Variable, 0.003, 0.012);
                let places = [-6.0, -2.0, 2.5, 6.0].map(|place| place * INCH);
                let along = |up: f64, across: f64| match direction {
                    FaceDirection::Up => up,
                    FaceDirection::Across => across,
                };
                let points: Vec<[f64; 3]> = places
                    .iter()
                    .flat_map(|up| places.map(|across| [*up, across, cubic(along(*up, across))]))
                    .collect();
                let face = match number {
                    0 => &mut parameters.column_face,
                    _ => &mut parameters.slope_face,
                };
                face.grid = Grid { up: 4, across: 3 };
                if by_map {
                    face.counterface_wear = Some(DepthMap::new(&points).unwrap());
                } else {
                    let depths = places.map(cubic).to_vec();
                    face.counterface = FaceProfile {
                        profile: SurfaceProfile::Table(Spline::new(places.to_vec(), depths).unwrap()),
                        direction,
                        ..FaceProfile::default()
                    };
                }
                rates(parameters)
            };
            let ((gaps, mapped), (wanted, table)) = (built(true), built(false));
            for (gap, wanted) in gaps.iter().zip(&wanted) {
                assert!(
                    (gap - wanted).abs() < 1e-13,
                    "{number} {direction:?}: {gap} {wanted}"
                );
            }
            let size = table.iter().fold(0.0, |most: f64, rate| most.max(rate.abs()));
            for (own, table) in mapped.iter().zip(&table) {
                assert!(
                    (own - table).abs() < 1e-7 * size,
                    "{number} {direction:?}: {own} {table}"
                );
            }
        }
    }
}

/// The energy ledger closes on a counterface that is worn unevenly over both coordinates.
#[test]
fn energy_closes_on_worn_counterfaces() {
    let mut parameters = thesis::parameters(Damping::Constant, 0.003, 0.012);
    parameters.start = Start::Equilibrium;
    let hollow = |u: f64, a: f64| 0.02 * INCH * (1.0 - (2.0 * u - 1.0).powi(2)) * (0.3 + a);
    for number in [0, 1] {
        let worn = map(&parameters, number, hollow);
        let face = match number {
            0 => &mut parameters.column_face,
            _ => &mut parameters.slope_face,
        };
        (face.grid, face.counterface_wear) = (Grid { up: 5, across: 3 }, Some(worn));
    }
    let wedge = Wedge::new(parameters).unwrap();
    let ledger = common::run(&wedge, 1e-6, (2.0, 0.1), |_, _| {}).ledger;
    let losses = ledger.side_frame_friction_loss + ledger.bolster_friction_loss;
    assert!(losses > 10.0, "{losses}");
    assert!(
        ledger.residual.abs() < 1e-5 * ledger.motion_work.abs().max(losses),
        "{ledger:?}"
    );
    assert!((ledger.residual + ledger.side_frame_friction_loss).abs() > 1e-4 * losses);
}

#[test]
fn analytic_a_map_of_a_crown_is_the_crown() {
    let parameters = base(Start::Rest);
    let radius = 60.0 * INCH;
    for (number, rectangle) in parameters.rectangles().into_iter().enumerate() {
        let mut face = FaceProperties {
            grid: Grid { up: 5, across: 5 },
            wedge_surface: arc(radius, FaceDirection::Up),
            ..FaceProperties::default()
        };
        let crowned = face.points(&rectangle, &parameters.contact);
        let crown = std::mem::take(&mut face.wedge_surface);
        let depths: Vec<[f64; 3]> = face
            .grid
            .points()
            .iter()
            .map(|point| {
                let (up, across) = rectangle.distances(point);
                [up, across, crown.profile.depth(up)[0]]
            })
            .collect();
        face.wedge_wear = Some(DepthMap::new(&depths).unwrap());
        let mapped = face.points(&rectangle, &parameters.contact);
        for (one, other) in crowned.iter().zip(&mapped) {
            for k in 0..3 {
                assert!(
                    (one.position.0[k] - other.position.0[k]).abs() < 1e-16,
                    "face {number}: {one:?} {other:?}"
                );
            }
        }
    }
}

/// The penetration depends on the sum of both curvatures, whichever partner has them.
#[test]
fn analytic_a_crown_on_either_partner_sinks_in_alike() {
    let settle = |wedge_surface: FaceProfile, counterface: FaceProfile| {
        let mut parameters = base(Start::Equilibrium);
        parameters.slope_face = FaceProperties {
            grid: Grid { up: 81, across: 2 },
            wedge_surface,
            counterface,
            ..FaceProperties::default()
        };
        let mut wedge = Wedge::new(parameters).unwrap();
        let observation = wedge.system.observe(0.0, &wedge.initial_state);
        let deepest = observation.faces[1]
            .points
            .iter()
            .map(|point| point.gap)
            .fold(0.0, f64::min);
        let force: f64 = observation.faces[1].points.iter().map(|point| point.normal).sum();
        (deepest, force)
    };
    let radius = 300.0 * INCH;
    let flat = FaceProfile::default();
    let up = FaceDirection::Up;
    let (on_wedge, force) = settle(arc(radius, up), flat.clone());
    let (on_pocket, other) = settle(flat, arc(radius, up));
    let (on_both, _) = settle(arc(2.0 * radius, up), arc(2.0 * radius, up));
    assert!(on_wedge < -1e-3 * INCH);
    assert!((force / other - 1.0).abs() < 2e-3, "{force} {other}");
    assert!(
        (on_wedge / on_pocket - 1.0).abs() < 1e-2,
        "{on_wedge} {on_pocket}"
    );
    assert!((on_wedge / on_both - 1.0).abs() < 1e-2, "{on_wedge} {on_both}");
    // Distributed springs of k a length over 2a: N = k δ a 4/3, a² = 2Rδ.
    let parameters = base(Start::Equilibrium);
    let density = 4.0 * parameters.contact.stiffness / parameters.rectangles()[1].length();
    let depth = -on_wedge;
    let closed = density * depth * (2.0 * radius * depth).sqrt() * 4.0 / 3.0;
    assert!((force / closed - 1.0).abs() < 1e-2, "{force} {closed}");
}

#[test]
fn limits_a_touching_start_over_crowns_touches() {
    let mut parameters = thesis::parameters(Damping::Constant, 0.0035, 0.012);
    parameters.start = Start::Touching;
    for face in [&mut parameters.column_face, &mut parameters.slope_face] {
        face.grid = Grid { up: 5, across: 5 };
        face.wedge_surface = arc(80.0 * INCH, FaceDirection::Across);
        face.counterface = arc(60.0 * INCH, FaceDirection::Up);
    }
    let mut wedge = Wedge::new(parameters).unwrap();
    let observation = wedge.system.observe(0.0, &wedge.initial_state);
    for face in &observation.faces {
        let least = face
            .points
            .iter()
            .map(|point| point.gap)
            .fold(f64::INFINITY, f64::min);
        assert!((-1e-12..1e-9).contains(&least), "{least}");
    }
}

#[test]
fn analytic_a_pad_has_a_force_and_friction_of_its_own() {
    let mut parameters = base(Start::Equilibrium);
    let at = 0.05 * INCH;
    parameters.slope_face.pad = Some(Pad {
        stiffness: 1e5 * LBF_PER_IN,
        damping: 0.0,
        hardening: Some(at),
        friction: 0.7,
        shear: Some([2e4 * LBF_PER_IN, 50.0 * LBF_PER_IN]),
    });
    let mut wedge = Wedge::new(parameters.clone()).unwrap();
    let face = &wedge.system.faces()[1].element;
    assert_eq!((face.coefficient, face.state_count()), (0.7, 8));
    assert_eq!(wedge.system.faces()[0].element.state_count(), 0);
    let observation = wedge.system.observe(0.0, &wedge.initial_state);
    let mut total = 0.0;
    for point in &observation.faces[1].points {
        let compression = -point.gap;
        let linear = 0.25 * 1e5 * LBF_PER_IN * compression;
        let expected = linear * (1.0 + (compression / at).powi(2));
        assert!((point.normal / expected - 1.0).abs() < 1e-12);
        total += point.normal;
    }
    assert!(total > 2000.0 * LBF);
}

#[test]
fn analytic_a_map_of_friction_is_bilinear() {
    let face = FaceProperties {
        grid: Grid { up: 3, across: 5 },
        friction_map: vec![vec![1.0, 0.5], vec![0.2, 0.8]],
        ..FaceProperties::default()
    };
    let friction = base(Start::Rest).slope_friction;
    let interface = face.interface(&friction, [true, false]);
    for (point, factor) in face.grid.points().iter().zip(&interface.friction_factors) {
        let (u, v) = (point.up, 0.5 * (point.across + 1.0));
        let expected = (1.0 - u) * ((1.0 - v) + 0.5 * v) + u * (0.2 * (1.0 - v) + 0.8 * v);
        assert!((factor - expected).abs() < 1e-15);
    }
}

#[test]
fn energy_closes_with_crowns_maps_and_pads() {
    let sliding = |face: &mut FaceProperties| {
        face.sliding_friction = Some(0.25);
        face.stribeck_speed = 0.2 * INCH;
        face.friction_half_load = Some(20_000.0 * LBF);
        face.friction_map = vec![vec![1.0, 0.9], vec![1.2, 0.8]];
    };
    for damping in [Damping::Constant, Damping::Variable] {
        let mut parameters = thesis::parameters(damping, 0.0, 0.006);
        parameters.start = Start::Equilibrium;
        for face in [&mut parameters.column_face, &mut parameters.slope_face] {
            face.grid = Grid { up: 9, across: 3 };
            sliding(face);
        }
        parameters.column_face.counterface = table(FaceDirection::Up);
        parameters.slope_face.wedge_surface = arc(100.0 * INCH, FaceDirection::Up);
        parameters.slope_face.pad = Some(Pad {
            stiffness: 4e5 * LBF_PER_IN,
            damping: 20.0 * LBF_PER_IN,
            hardening: Some(0.02 * INCH),
            friction: 0.5,
            shear: Some([1e5 * LBF_PER_IN, 100.0 * LBF_PER_IN]),
        });
        let wedge = Wedge::new(parameters.clone()).unwrap();
        let end = common::run(&wedge, 1e-6, (2.0, 0.1), |_, _| {});
        let ledger = end.ledger;
        let losses = ledger.side_frame_friction_loss + ledger.bolster_friction_loss;
        assert!(losses > 10.0, "{losses}");
        assert!(
            ledger.residual.abs() < 1e-5 * ledger.motion_work.abs().max(losses),
            "{ledger:?}"
        );
        // Each loss of each face is noticed where it is left out.
        for loss in [
            ledger.side_frame_friction_loss,
            ledger.bolster_friction_loss,
            ledger.contact_damping_loss,
        ] {
            assert!((ledger.residual + loss).abs() > 1e-4 * losses, "{ledger:?}");
        }
    }
}

#[test]
fn input_faces_out_of_range_are_refused() {
    type Change = fn(&mut Parameters);
    let changes: [(&str, Change); 8] = [
        ("column_face.grid", |p| p.column_face.grid.up = 1),
        ("slope_face.wedge_surface", |p| {
            p.slope_face.wedge_surface = arc(3.0 * INCH, FaceDirection::Across);
        }),
        ("column_face.counterface", |p| {
            p.column_face.counterface = table(FaceDirection::Up);
            p.wedge.height = 13.0 * INCH;
        }),
        ("slope_face.wedge_wear", |p| {
            p.slope_face.wedge_wear = Some(map(p, 1, |_, _| 0.0));
            p.wedge.width *= 1.001;
        }),
        ("column_face.counterface_wear", |p| {
            let corners = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];
            let points = corners.map(|[up, across]| [up, across, 0.0]);
            p.column_face.counterface_wear = Some(DepthMap::new(&points).unwrap());
        }),
        ("slope_face.friction_map", |p| {
            p.slope_face.friction_map = vec![vec![1.0], vec![1.0, 2.0]]
        }),
        ("column_face.sliding_friction", |p| {
            p.column_face.sliding_friction = Some(-0.1)
        }),
        ("slope_face.friction_half_load", |p| {
            p.slope_face.friction_half_load = Some(0.0)
        }),
    ];
    for (path, change) in changes {
        let mut parameters = base(Start::Rest);
        change(&mut parameters);
        assert_eq!(parameters.validate().unwrap_err().path, path);
    }
}
