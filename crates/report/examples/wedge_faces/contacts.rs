//! How wide a crown bears on its springs, and by Hertz.

use std::f64::consts::PI;
use std::fmt::Write as _;

use crate::shared::{Failure, INCH};
use crate::{POUND_FORCE, Section, head, row};

/// Young's modulus of steel, Pa, and Poisson's ratio.
const STEEL: [f64; 2] = [207e9, 0.28];

pub(crate) fn section() -> Result<Section, Failure> {
    let wedge = &truck::Parameters::new(wedge::parameters::Damping::Constant).wedges[0];
    let (width, length) = (wedge.width, wedge.height / wedge.angle.cos());
    let stiffness = 4.0 * wedge.contact.stiffness;
    let load = 7e3 * POUND_FORCE;
    let modulus = STEEL[0] / (2.0 * (1.0 - STEEL[1] * STEEL[1]));
    let mut text = "## How wide a crown bears\n\nA crown of radius R across a slope face of width w under \
                    the normal force N is pressed over the half width a. The model's springs of stiffness K \
                    a face give `N = (2/3) (K/w) a³/R`; Hertz's line contact of two castings of the face's \
                    length L gives `b² = 4 N R/(π L E*)`, `E* = E/(2 (1 - ν²))`. At 7 kip, with the faces \
                    of constant damping and the default stiffness of 2.5e5 lbf/in a corner:\n\n"
        .to_owned();
    text += &head(&[
        "radius, in",
        "half width of the springs, in",
        "their largest pressure, ksi",
        "half width by Hertz, in",
        "largest pressure by Hertz, ksi",
    ]);
    for radius in [20.0, 60.0, 120.0, 240.0] {
        let r = radius * INCH;
        let springs = (1.5 * load * r * width / stiffness).cbrt();
        // The depth a²/2R of the middle, by K/(w L).
        let pressure = stiffness / (width * length) * springs * springs / (2.0 * r);
        let hertz = (4.0 * load * r / (PI * length * modulus)).sqrt();
        let greatest = 2.0 * load / (PI * hertz * length);
        let ksi = |pascal: f64| pascal / 6.894_757e6;
        text += &row([
            format!("{radius:.0}"),
            format!("{:.2}", springs / INCH),
            format!("{:.3}", ksi(pressure)),
            format!("{:.3}", hertz / INCH),
            format!("{:.1}", ksi(greatest)),
        ]);
    }
    writeln!(
        text,
        "\nThe springs stand for all that gives behind a face: a bed of rust and wear, the castings' own \
         bending. So the radius of the\nmodel is not that of a casting: **it makes, together with the \
         stiffness of the contacts, how wide a face bears**, and both are open."
    )?;
    Ok(Section {
        text,
        figures: Vec::new(),
    })
}
