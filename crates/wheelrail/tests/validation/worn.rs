//! Worn measured profiles: ellipses and strips beside the program CONTACT.

use wheelrail::contact::{ContactLaw, CreepLaw, PatchForm, Side};
use wheelrail::creep::fastsim::StripGrid;
use wheelrail::friction::Friction;
use wheelrail::hertz::Material;
use wheelrail::loaded::{Attitude, LoadedPatch};
use wheelrail::profile::{Profile, ProfileKind, ReadOptions, WheelDatum};
use wheelrail::wheelset::{Layout, RigidWheelset};

use super::{POISSON, SHEAR, data, line, row, table};

/// Loads (kN); places (mm) from and to of the patches that make a row; normal force (N), longitudinal force
/// (N), greatest pressure (MPa) and width (mm) in CONTACT.
const REFERENCE: [(f64, &str, [f64; 2], [f64; 4]); 5] = [
    (3.7, "gauge corner", [720.0, 730.0], [4309.0, 848.9, 718.0, 2.0]),
    (
        32.5,
        "gauge corner",
        [720.0, 730.0],
        [16240.0, 3192.0, 1126.0, 3.6],
    ),
    (32.5, "tread", [740.0, 770.0], [18590.0, 6477.0, 460.1, 13.6]),
    (127.5, "flange", [710.0, 718.0], [4809.0, -511.3, 685.6, 2.0]),
    (
        127.5,
        "corner and tread",
        [720.0, 770.0],
        [127_100.0, 44170.0, 1702.0, 29.2],
    ),
];

/// Returns the patches of the right wheel under a load, N; none if a profile or the load is refused.
fn pressed(load: f64, form: PatchForm) -> Option<Vec<LoadedPatch>> {
    let options = ReadOptions {
        datum: Some(WheelDatum::FlangeBack),
        tape_from_back: Some(0.070),
        ..ReadOptions::default()
    };
    let folder = data("worn");
    let wheel = folder.join("worn_high_mileage.prw");
    let wheel = Profile::read_with(&wheel, ProfileKind::Wheel, &options).ok()?;
    let rail = Profile::read(&folder.join("site_b_hr.prr"), ProfileKind::Rail, 0.0);
    let rail = rail.ok()?;
    let layout = Layout {
        tape_distance: 1.3474 + 2.0 * 0.070,
        gauge: 1.4351,
        gauge_depth: 15.875e-3,
    };
    let material = Material {
        youngs_modulus: 2.0 * SHEAR * (1.0 + POISSON),
        poisson: POISSON,
    };
    let wheelset = RigidWheelset::new([&wheel; 2], [0.444; 2], [&rail; 2], layout, material);
    let wheelset = wheelset.ok()?.with_patches(form);
    let law = ContactLaw {
        friction: Friction::by_zone(0.35, 0.2),
        damping: 0.0,
        creep: CreepLaw::Fastsim(StripGrid {
            cells: 40,
            strips: 40,
        }),
        slowest: 0.0,
    };
    let attitude = Attitude {
        lateral: 14.74e-3,
        yaw: 0.0050,
        roll: -0.0013,
        speed: 15.0,
        pitch_rate: -32.10,
    };
    let found = wheelset.loaded(Side::Right, &attitude, load, &law);
    Some(found.ok()?.patches)
}

pub fn worn(out: &mut String) {
    line(out, "## Worn profiles\n");
    line(
        out,
        "A worn wheel on a worn high rail of a heavy-haul railway, CONTACT's case `force_site_b` (grid of \
         0.4 mm,\n\
         pressures at the middle of elements): right wheel, friction 0.35 on the tread and 0.2 on the gauge \
         face,\n\
         FASTSIM with 40 cells. CONTACT / ellipse / strips; widths of ellipses are 2 b. Pressures on strips \
         are to\n\
         lie within 10 %, normal forces within 3 % (32.5 kN and below: 2 %). At 127.5 kN CONTACT takes gauge \
         corner\n\
         and tread for one plane patch; here they are two with the friction of their own zones, whose\n\
         forces and widths are added.\n",
    );
    table(
        out,
        &[
            "load, kN",
            "patch",
            "N, N",
            "Fx, N",
            "greatest pressure, MPa",
            "",
            "width, mm",
        ],
    );
    for (load, name, [from, to], [normal, along, pressure, width]) in REFERENCE {
        let sums = [PatchForm::Ellipse, PatchForm::Strips].map(|form| {
            let mut patches = pressed(1e3 * load, form).unwrap_or_default();
            patches.retain(|own| (from..to).contains(&(1e3 * own.y)));
            let sum = |of: &dyn Fn(&LoadedPatch) -> f64| patches.iter().map(of).sum::<f64>();
            let wide = |own: &LoadedPatch| match &own.strips {
                None => 2.0 * own.axes[1],
                Some(strips) => strips.contact_width(),
            };
            let greatest = patches
                .iter()
                .fold(0.0_f64, |most, own| most.max(own.greatest_pressure));
            [
                sum(&|own| own.normal),
                sum(&|own| own.fx),
                1e-6 * greatest,
                1e3 * sum(&wide),
            ]
        });
        let three = |k: usize, own: f64, digits: usize| {
            format!(
                "{own:.digits$} / {:.digits$} / {:.digits$}",
                sums[0][k], sums[1][k]
            )
        };
        let off = |k: usize| 100.0 * (sums[k][2] / pressure - 1.0);
        row(
            out,
            &[
                load.to_string(),
                name.to_owned(),
                three(0, normal, 0),
                three(1, along, 0),
                three(2, pressure, 0),
                format!("{:+.0} %, {:+.0} %", off(0), off(1)),
                three(3, width, 1),
            ],
        );
    }
}
