//! Spectra in track files: the published ones, and users' own by their coefficients and units.

use wheelrail::track::rational::{COEFFICIENTS, DensityUnit, Rational, WavenumberUnit};
use wheelrail::track::spectrum::{MOST_TERMS, Realization, Spectrum};

use super::irregularity::{named, whole};
use super::optional_length;
use crate::case::problem::{Problem, Problems};
use crate::case::section::CaseSection;
use crate::case::tree::NodeValue;

/// The names of spectra.
pub(super) const SPECTRA: [&str; 6] = [
    "fra_vertical",
    "fra_lateral",
    "fra_cross_level",
    "erri_vertical_low",
    "erri_vertical_high",
    "rational",
];
/// Keys of all spectra.
const KEYS: [&str; 8] = [
    "spectrum",
    "rails",
    "direction",
    "shortest",
    "longest",
    "terms",
    "taper",
    "seed",
];
/// Keys of users' own.
const RATIONAL: [&str; 4] = ["numerator", "denominator", "wavenumber", "density"];

/// Coefficients by rising powers of the wavenumber.
fn coefficients(section: &CaseSection<'_>, key: &str, problems: &mut Problems) -> Option<Vec<f64>> {
    let help = format!(
        "write for example {key} = [0.68, 0, 1]: the coefficients by rising powers of the wavenumber"
    );
    let node = section.require(key, &help, problems)?;
    let numbers = match &node.value {
        NodeValue::List(items) => items
            .iter()
            .map(|item| match item.value {
                NodeValue::Number(number) if number.is_finite() => Some(number),
                _ => None,
            })
            .collect::<Option<Vec<f64>>>(),
        _ => None,
    };
    match numbers {
        Some(numbers) if (1..=COEFFICIENTS).contains(&numbers.len()) => Some(numbers),
        _ => {
            let message = format!(
                "`{}` must be a list of 1 to {COEFFICIENTS} plain numbers",
                section.path_of(key)
            );
            problems.push(
                Problem::new(message)
                    .at(&node.place)
                    .label("not such a list")
                    .help(help),
            );
            None
        }
    }
}

/// Returns a density of the user's own, with both of its units.
fn rational(section: &CaseSection<'_>, problems: &mut Problems) -> Option<Rational> {
    let names = WavenumberUnit::ALL.map(|(name, _)| name);
    let help = format!(
        "write the unit in which the coefficients take the wavenumber, one of \"{}\": a density over rad/m \
         read as one over cycle/m is another track",
        names.join("\", \"")
    );
    let wavenumber = section.require("wavenumber", &help, problems).and_then(|_| {
        let name = named(section, "wavenumber", &names, problems)?;
        WavenumberUnit::ALL.iter().find(|(own, _)| *own == name)
    });
    let help = "write the unit of the density, such as density = \"cm^2/(rad/m)\": the square of m, cm, mm \
                or in, by rad/m, cycle/m, rad/ft or cycle/ft";
    let density = section.require("density", help, problems).and_then(|node| {
        let (text, _) = section.text("density", problems)?;
        let unit = DensityUnit::parse(text);
        if unit.is_none() {
            let message = format!("`{}` cannot be \"{text}\"", section.path_of("density"));
            problems.push(
                Problem::new(message)
                    .at(&node.place)
                    .label("no unit of a density")
                    .help(help),
            );
        }
        unit
    });
    let numerator = coefficients(section, "numerator", problems);
    let denominator = coefficients(section, "denominator", problems);
    Rational::new(&numerator?, &denominator?, wavenumber?.1, density?)
}

/// Returns a realization; `end` is the length of the track, m.
pub(super) fn realized(
    section: &CaseSection<'_>,
    end: Option<f64>,
    problems: &mut Problems,
) -> Option<Realization> {
    let (text, node) = section.text("spectrum", problems)?;
    if text.contains(['.', '/', '\\']) {
        let problem = Problem::new(format!("`{}` is \"{text}\"", section.path_of("spectrum")));
        problems.push(problem.at(&node.place).label("a file?").help(format!(
            "spectra from files are not read, since their densities say no unit (m²/(rad/m) and \
             m²/(cycle/m) differ by 2π); write one of {}, of which rational takes your coefficients with \
             their units, or give a realization as table = \"file.csv\"",
            SPECTRA.join(", ")
        )));
        return None;
    }
    let spectrum = named(section, "spectrum", &SPECTRA, problems)?;
    let own: &[&str] = match spectrum {
        "rational" => &RATIONAL,
        "erri_vertical_low" | "erri_vertical_high" => &[],
        _ => &["class"],
    };
    section.allow_in(&[&KEYS, own].concat(), &[], "a track", problems);
    let class = whole(section, "class", 4, problems)?.min(255) as u8;
    let spectrum = match spectrum {
        "fra_vertical" => Spectrum::FraVertical(class),
        "fra_lateral" => Spectrum::FraLateral(class),
        "fra_cross_level" => Spectrum::FraCrossLevel(class),
        "rational" => Spectrum::Rational(rational(section, problems)?),
        "erri_vertical_low" => Spectrum::ErriVerticalLow,
        _ => Spectrum::ErriVerticalHigh,
    };
    let shortest = optional_length(section, "shortest", 1.5, problems);
    let longest = optional_length(section, "longest", 91.44, problems);
    let taper = optional_length(section, "taper", 30.0, problems);
    let terms = whole(section, "terms", 1000, problems);
    let seed = whole(section, "seed", 1, problems);
    let (shortest, longest, terms) = (shortest?, longest?, terms?);
    // Waves at equal steps of the wavenumber repeat themselves.
    let step = (1.0 / shortest - 1.0 / longest) / terms as f64;
    if let Some(end) = end
        && step > 0.0
        && end * step > 1.0
    {
        let problem = Problem::new(format!(
            "`{}` repeats itself after {:.0} ft, but the track is {:.0} ft long",
            section.path,
            1.0 / step / 0.3048,
            end / 0.3048
        ))
        .help(match (end * step * terms as f64).ceil() {
            needed if needed <= MOST_TERMS as f64 => format!("write terms = {needed:.0} or more"),
            needed => format!(
                "{needed:.0} terms would be needed, and {MOST_TERMS} are the most: shorten the track, or \
                 write a larger shortest"
            ),
        });
        problems.push(match &section.place {
            Some(place) => problem.at(place).label("shorter than the track"),
            None => problem,
        });
        return None;
    }
    let made = Realization::new(spectrum, [shortest, longest], terms as usize, taper?, seed?);
    made.map_err(|error| {
        let problem = Problem::new(format!("`{}`: {error}", section.path));
        problems.push(match &section.place {
            Some(place) => problem.at(place).label("this spectrum"),
            None => problem,
        });
    })
    .ok()
}
