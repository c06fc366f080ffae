//! Results at the usual tolerance against those at tighter ones.
#![allow(clippy::unwrap_used)]

use study::half_truck::run::run;

use crate::common::{INCH, POUND, case};

#[test]
fn motion_and_friction_converge_with_the_tolerance() {
    for name in [
        "nucars_69_constant_toe_out",
        "nucars_69_constant_toe_out_yaw",
        "nucars_68_variable_toe_out",
    ] {
        let at = |tolerance: f64| {
            let mut case = case(name, 6.0);
            case.relative_tolerance = tolerance;
            run(&case, |_| ()).unwrap()
        };
        let exact = at(1e-9);
        let difference = |tolerance: f64| {
            let own = at(tolerance);
            let most = |column: &str| {
                let pairs = own
                    .column(column)
                    .unwrap()
                    .iter()
                    .zip(exact.column(column).unwrap());
                pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
            };
            [most("body_1_z") / INCH, most("wedge_127_column_friction") / POUND]
        };
        let (usual, tight) = (difference(1e-5), difference(1e-7));
        println!("{name}: {usual:?} in, lb at 1e-5; {tight:?} at 1e-7");
        assert!(usual[0] < 1e-3, "{name}: {usual:?}");
        assert!(tight[0] < 0.2 * usual[0], "{name}: {usual:?} {tight:?}");
        assert!(tight[1] < usual[1], "{name}: {usual:?} {tight:?}");
    }
}
