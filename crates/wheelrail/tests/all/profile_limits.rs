//! limits: broken files and points never do harm.

use std::path::Path;

use wheelrail::contact::{ContactPair, Side, WheelPose};
use wheelrail::hertz::Material;
use wheelrail::profile::{Points, Profile, ProfileKind, nominal};

/// A generator of numbers without meaning (Knuth's linear congruence).
struct Random(u64);

impl Random {
    fn next(&mut self, below: usize) -> usize {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % below
    }
}

/// Files with bytes changed, taken out and doubled are read or refused with a place; what is read can be
/// used.
#[test]
fn limits_broken_files_are_read_or_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let simpack = std::fs::read_to_string(folder.join("manchester/MBench_S1002_v3.prw")).unwrap();
    let csv = std::fs::read_to_string(folder.join("en15302/wheel_a.csv")).unwrap();
    let rail = nominal::rail_136re().unwrap();
    let steel = Material {
        youngs_modulus: 207e9,
        poisson: 0.28,
    };
    let mut random = Random(1);
    let (mut read, mut refused) = (0, 0);
    for round in 0..300 {
        let (text, simpack) = if round % 2 == 0 {
            (&simpack, true)
        } else {
            (&csv, false)
        };
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        for _ in 0..1 + random.next(3) {
            let line = random.next(lines.len());
            match random.next(5) {
                0 => {
                    lines.remove(line);
                }
                1 => lines.insert(line, lines[line].clone()),
                2 => {
                    let other = random.next(lines.len());
                    lines.swap(line, other);
                }
                3 => {
                    let keep = lines[line].len() * random.next(10) / 10;
                    lines[line] = lines[line].chars().take(keep).collect();
                }
                _ => {
                    let byte = b"0123456789eE+-.,;=!# \t\"a"[random.next(24)];
                    let at = random.next(lines[line].len() + 1);
                    if lines[line].is_char_boundary(at) {
                        lines[line].insert(at, char::from(byte));
                    }
                }
            }
        }
        let text = lines.join("\n");
        let points = match simpack {
            true => Points::from_simpack("broken", &text),
            false => Points::from_csv("broken", &text),
        };
        let profile = points.and_then(|points| Profile::of_points(&points, ProfileKind::Wheel, 1e-5));
        match profile.and_then(|profile| ContactPair::new(&profile, 0.46, &rail, steel)) {
            Ok(pair) => {
                let pose = WheelPose::of(Side::Left, [0.0, 0.4599], 1e-3, 0.0);
                let found = pair.patches_at(&pose);
                assert!(found.iter().all(|patch| patch.approach.is_finite()), "{round}");
                read += 1;
            }
            Err(error) => {
                assert!(error.to_string().contains("broken"), "{error}");
                assert!(!error.remedy().is_empty());
                refused += 1;
            }
        }
    }
    assert!(read > 50 && refused > 10, "{read} read, {refused} refused");
}

/// A file with many points is fitted and checked, and keeps an eighth of them.
#[test]
fn limits_the_largest_file_is_fitted() {
    let points: Vec<[f64; 2]> = (0..100_000)
        .map(|i| {
            let y = 0.07 * (f64::from(i) / 50_000.0 - 1.0);
            [y, 0.3 - (0.09 - y * y).sqrt()].map(|x| -x)
        })
        .collect();
    let profile = Profile::of_points(&Points::new("large", &points), ProfileKind::Rail, 1e-6).unwrap();
    // Points are 1.4 μm apart, and one of eight is kept.
    assert!(profile.deviation().points > 10_000 && profile.deviation().largest <= 1e-6);
}
