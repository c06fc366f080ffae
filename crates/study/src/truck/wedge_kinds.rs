//! Keys of spatial and split wedges, and what their sizes allow.

use quantity::Kind;
use truck::WedgeKind;

use super::control_coils::CoilKind;
use super::wedges::Draft;
use crate::case::field::Reach;
use crate::case::friction::COEFFICIENT;
use crate::case::page::FRICTION;
use crate::case::problem::Problem;
use crate::case::section::Range;
use crate::reader::{CLEARANCE, CaseReader};

/// Keys that only a split wedge has, in a section of their own.
const OF_SPLIT: [&str; 5] = ["angle", "gap", "friction", "outboard_share", "coil_distance"];
/// Angles across; what a wedge's size allows is checked where that is known.
pub(super) const ACROSS: Range = Range::Between(
    -std::f64::consts::FRAC_PI_2,
    std::f64::consts::FRAC_PI_2,
    "between -90 deg and 90 deg, both excluded",
);

impl Draft {
    /// Checks the angle across, whose key stands below this path.
    pub(super) fn check_across(&self, r: &mut CaseReader<'_>, path: &str) {
        let (wedge, key) = (&self.wedge, format!("{path}slope_across"));
        let most = wedge.greatest_slope_across();
        if wedge.slope_across.abs() >= most {
            let [found, most] = [wedge.slope_across, most].map(f64::to_degrees);
            let message = format!(
                "`{key}` is {found:.4} deg; a wedge of this height, width and angle runs out to an edge at \
                 {most:.1} deg"
            );
            let help = format!(
                "write an angle between -{most:.1} deg and {most:.1} deg, or make the wedge narrower"
            );
            r.problem(&key, Problem::new(message).label("out of range").help(help));
        }
        if wedge.kind == WedgeKind::Massless && wedge.slope_across != 0.0 {
            let message = format!(
                "`{key}` is of no effect: a massless wedge has neither slopes across nor sides of a pocket"
            );
            let help = "leave it out, or write wedge.kind = \"body\"";
            r.problem(&key, Problem::new(message).label("no effect").help(help));
        }
    }

    /// Reads the parameters between the halves; `path` is that of the section.
    pub(super) fn split(&mut self, r: &mut CaseReader<'_>, path: &str) {
        if self.wedge.kind != WedgeKind::Split {
            let message = format!("`{path}` is of no effect: this wedge has no halves");
            let owner = path.rsplit_once('.').map_or("wedge", |(owner, _)| owner);
            let help = format!("leave it out, or write {owner}.kind = \"split\"");
            r.problem(path, Problem::new(message).label("no effect").help(help));
            r.expect(path, &OF_SPLIT);
            return;
        }
        let split = &mut self.wedge.split;
        let angle = (Kind::Angle, ACROSS, Reach::Signed(0.2));
        let comment = "of the plane between the halves with the vertical; positive: the outboard half leans \
                       over the inboard one";
        r.quantity("angle", angle, &mut split.angle, comment);
        r.quantity(
            "gap",
            CLEARANCE,
            &mut split.gap,
            "between the halves in the nominal layout",
        );
        let comment = "between the halves; its law is that of the slope";
        r.number(
            "friction",
            COEFFICIENT,
            FRICTION,
            &mut split.friction.coefficient,
            comment,
        );
        let share = Range::Between(0.0, 1.0, "between 0 and 1, both excluded");
        let comment = "the outboard half's share of the weight";
        r.number(
            "outboard_share",
            share,
            Reach::Between(0.1, 0.9),
            &mut split.outboard_share,
            comment,
        );
        let comment = "from the wedge's middle to where each half of the control coil presses; a quarter of \
                       the width: a coil under each half; 2/pi of its mean radius: one coil under both";
        r.quantity("coil_distance", CLEARANCE, &mut split.coil_distance, comment);
    }

    /// Checks what the size of a split wedge allows; its keys stand below this path.
    pub(super) fn check_split(&self, r: &mut CaseReader<'_>, path: &str) {
        let wedge = &self.wedge;
        if wedge.kind != WedgeKind::Split {
            return;
        }
        let section = if path == "wedge." {
            "split".to_owned()
        } else {
            format!("{path}split")
        };
        let (angle, most) = (
            wedge.split.angle.to_degrees(),
            libm::atan(wedge.width / wedge.height).to_degrees(),
        );
        if angle.abs() >= most {
            let message = format!(
                "`{section}.angle` is {angle:.4} deg; halves of this height and width run out to an edge at \
                 {most:.1} deg"
            );
            let help = format!("write an angle between -{most:.1} deg and {most:.1} deg");
            r.problem(
                &format!("{section}.angle"),
                Problem::new(message).label("out of range").help(help),
            );
        }
        // What leans on an inclined plane that is steeper than its slope climbs without end.
        let (sine, cosine) = libm::sincos(wedge.slope_across);
        let lifted = sine * libm::tan(wedge.split.angle).abs();
        if sine < 0.0 && angle.abs() < most && libm::sin(wedge.angle) * cosine + lifted <= 0.0 {
            let message = format!(
                "`{section}.angle` is {angle:.4} deg: halves that a slope_across of {:.4} deg presses \
                 together climb on such a plane, whatever the coil's load",
                wedge.slope_across.to_degrees()
            );
            let help = "write a smaller angle of one of the two";
            r.problem(
                &format!("{section}.angle"),
                Problem::new(message).label("out of range").help(help),
            );
        }
        if wedge.split.coil_distance > 0.5 * wedge.width {
            let message = format!("`{section}.coil_distance` is more than half of the wedge's width");
            let help = "the coil would press beside the wedge; a quarter of the width is under each half";
            let key = format!("{section}.coil_distance");
            r.problem(&key, Problem::new(message).label("out of range").help(help));
        }
        let halves = wedge.halves();
        if halves
            .iter()
            .flat_map(|half| half.inertia)
            .any(|inertia| inertia <= 0.0)
        {
            let message = format!(
                "`{path}inertia` is too small for two halves of this weight a quarter of the width from its \
                 middle"
            );
            let help = "roll and yaw must be more than what the halves have by their distance, weight times \
                        width squared over 16; a prism's has its width squared over 12";
            let problem = Problem::new(message).label("too small").help(help);
            r.problem(&format!("{path}inertia"), problem);
        }
        if self.kind == CoilKind::Thesis {
            let message =
                "a split wedge cannot stand on the thesis's coil, which ends at one point of one wedge";
            let help = "write control_coil.kind = \"shear\", or wedge.kind = \"body\"";
            let problem = Problem::new(message).label("needs two ends").help(help);
            r.problem(&format!("{path}kind"), problem);
        }
    }
}
