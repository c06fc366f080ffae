//! Lock-up maps: the closed form and the rigs check each other.

use std::ops::ControlFlow;

use study::case::builtin;
use study::lock_up::{LockUpMap, MapAxis, MapError, MapRange, RigOutcome, map};

fn spans(texts: [&str; 2]) -> [MapRange; 2] {
    texts.map(|text| MapRange::parse(text).unwrap())
}

fn map_of(texts: [&str; 2], points: usize) -> LockUpMap {
    let case = builtin::case("lock_up_friction_0.4").unwrap();
    map(&case, spans(texts), points, 2, |_| ControlFlow::Continue(())).unwrap()
}

/// Away from the boundary every rig finds what the margin says; where it slides, its force is the
/// quasi-static one.
#[test]
fn rigs_agree_with_the_lock_up_margin_away_from_its_boundary() {
    for (texts, near) in [
        (["angle=20 deg..50 deg", "friction=0.1..0.6"], 2.0),
        (["toe=4 deg in..4 deg out", "friction=0.1..0.6"], 3.5),
        (["angle=25 deg..50 deg", "yaw=0 mrad..20 mrad"], 3.0),
        (["friction=0.1..0.6", "crown=30 in..500 in"], 3.0),
    ] {
        let found = map_of(texts, 7);
        let [locks, slides, _] = found.counts();
        assert_eq!(locks + slides, 49, "{texts:?}: {found:?}");
        assert!(locks > 5 && slides > 5, "{texts:?}: {locks}, {slides}");
        assert!(
            found.disagreement().to_degrees() < near,
            "{texts:?}: {}",
            found.disagreement().to_degrees()
        );
        for cell in found.cells.iter().filter(|cell| cell.margin.to_degrees() > 5.0) {
            let expected = cell.expected_ratio.unwrap();
            assert!((cell.ratio / expected - 1.0).abs() < 0.1, "{texts:?}: {cell:?}");
        }
    }
}

/// The same map on one thread and on three; faces that do not close are not run.
#[test]
fn issue_036_an_axis_may_be_given_from_its_greater_end() {
    let [down, up] = spans(["angle=50 deg..20 deg", "angle=20 deg..50 deg"]);
    assert_eq!(down, up);
    let [toe, _] = spans(["toe=5 deg out..5 deg in", "friction=0.6..0.1"]);
    assert!(toe.ends[0] < 0.0 && toe.ends[0] == -toe.ends[1], "{:?}", toe.ends);
}

#[test]
fn limits_maps_do_not_depend_on_threads_and_leave_out_faces_that_open() {
    let case = builtin::case("lock_up_friction_0.4").unwrap();
    let axes = spans(["angle=10 deg..40 deg", "toe=22 deg in..0 deg"]);
    let [one, three] =
        [1, 3].map(|threads| map(&case, axes, 4, threads, |_| ControlFlow::Continue(())).unwrap());
    assert_eq!(format!("{one:?}"), format!("{three:?}"));
    assert_eq!(one.cells[0].found, RigOutcome::PushedOut);
    assert!(one.cells[0].closing_angle < 0.0);
    let stopped = map(&case, axes, 4, 2, |_| ControlFlow::Break("enough".to_owned()));
    assert_eq!(stopped.unwrap_err().to_string(), "enough");
    // What was computed is kept, to the last bit; the rest has the closed form.
    let early = map(&case, axes, 4, 1, |number| match number {
        0..6 => ControlFlow::Continue(()),
        _ => ControlFlow::Break("enough".to_owned()),
    });
    let early = early.unwrap();
    assert_eq!(early.interrupted.as_deref(), Some("enough"));
    assert_eq!(
        format!("{:?}", &early.cells[..6]),
        format!("{:?}", &one.cells[..6])
    );
    for (cell, whole) in early.cells[6..].iter().zip(&one.cells[6..]) {
        assert!(
            matches!(cell.found, RigOutcome::Unknown(_) | RigOutcome::PushedOut),
            "{cell:?}"
        );
        assert_eq!(
            cell.found == RigOutcome::PushedOut,
            whole.found == RigOutcome::PushedOut
        );
        assert!(
            (cell.margin - whole.margin).abs() < 1e-12 && cell.ratio.is_nan(),
            "{cell:?}"
        );
    }
}

#[test]
fn input_axes_that_make_no_map_are_refused() {
    for (text, part) in [
        ("angle", "an axis has a name and a range"),
        (
            "speed=1..2",
            "there is no axis `speed`; choose two of angle, friction, toe, crown, yaw",
        ),
        ("angle=32 deg", "angle needs a range"),
        (
            "angle=0 deg..50 deg",
            "angle is 0 deg; it must be between 0 deg and 90 deg, both excluded",
        ),
        ("angle=20 deg..90 deg", "angle is 90 deg"),
        ("angle=20 in..50 in", "angle: "),
        ("angle=32 deg..32 deg", "one point only"),
        (
            "friction=-0.1..0.4",
            "friction is -0.1; it must be between 0 and 10",
        ),
        ("friction=0.1..0.4 deg", "a number without unit"),
        ("toe=1 deg..2 deg out", "given with its direction"),
        ("toe=30 deg in..0 deg", "below 22.5 deg"),
        ("crown=0 in..10 in", "crown is 0 in; it must be positive"),
        ("yaw=0 rad..1 rad", "yaw is 1 rad; it must be below 22.5 deg"),
    ] {
        let error = MapRange::parse(text).unwrap_err();
        assert!(error.contains(part), "{text}: {error}");
    }
    let case = builtin::case("lock_up_friction_0.4").unwrap();
    let error = |axes, points| map(&case, axes, points, 1, |_| ControlFlow::Continue(())).unwrap_err();
    let same = spans(["angle=20 deg..30 deg", "angle=30 deg..40 deg"]);
    assert!(matches!(error(same, 3), MapError::SameAxis(MapAxis::Angle)));
    let axes = spans(["angle=20 deg..30 deg", "friction=0.1..0.2"]);
    assert!(matches!(error(axes, 1), MapError::OnePoint(1)));
    // A value that only the case can refuse: this crown is no surface of a wedge of 6 in.
    let crown = spans(["crown=0.5 in..60 in", "friction=0.1..0.2"]);
    let refused = error(crown, 2).to_string();
    assert!(
        refused.contains("crown") || refused.contains("radius"),
        "{refused}"
    );
}
