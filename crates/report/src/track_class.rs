//! Tables of `wedgelab track show`: limits of the class, the class that a track gets, waves by bands.

use quantity::SixDigits;
use study::track::bands::{BANDS, BandDeviation, deviation};
use wheelrail::track::class_limits::{ClassQuantity, HIGHEST_COVERED, SPEEDS};
use wheelrail::track::{ClassValue, TrackClass};

use crate::track_files::{MeasuredTrack, Survey};

const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;

/// A row of the table of the class: what, value, limit, place, the class it keeps.
pub struct ClassRow {
    /// The quantity with its paragraph.
    pub name: String,
    /// The value, in.
    pub value: String,
    /// The limit of the class that is compared, in.
    pub limit: String,
    /// The distance of the value, ft.
    pub at: String,
    /// The class by this row alone.
    pub class: String,
    /// Where the limit is from.
    pub mark: &'static str,
}

/// Returns the rows of a track's class beside the limits of a class (from 1).
#[must_use]
pub fn rows(found: &TrackClass, class: usize) -> Vec<ClassRow> {
    let row = |own: &ClassValue| ClassRow {
        name: format!("{} ({})", own.limit.name, own.limit.paragraph),
        value: format!("{:.3}", own.value / INCH),
        limit: match (
            own.limit.of_class(class),
            own.limit.limits.iter().flatten().next(),
        ) {
            (Some(limit), _) => format!("{}", SixDigits(limit / INCH)),
            // A row of classes beyond 5: the limit of the first of them.
            (None, Some(first)) if own.limit.limits[..HIGHEST_COVERED].iter().all(Option::is_none) => {
                format!("{} (class 6)", SixDigits(first / INCH))
            }
            (None, _) => "none".to_owned(),
        },
        at: format!("{:.0}", own.at / FOOT),
        class: match own.class {
            0 => "none".to_owned(),
            class => class.to_string(),
        },
        mark: own.limit.mark.words(),
    };
    found.values.iter().map(row).collect()
}

/// Returns the class that a track gets, in words: with the value that decides, and whether a stated class
/// (from 1) is kept.
#[must_use]
pub fn verdict(found: &TrackClass, stated: Option<usize>) -> String {
    let class = found.class();
    let speed = |class: usize| SPEEDS.get(class.wrapping_sub(1)).copied().unwrap_or(0.0);
    let gets = match class {
        0 => "The geometry keeps no class of 49 CFR 213".to_owned(),
        HIGHEST_COVERED => format!(
            "The geometry keeps class 5 of 49 CFR 213 (freight up to {:.0} mph), the highest one covered",
            speed(class)
        ),
        class => format!(
            "The geometry is that of class {class} of 49 CFR 213 (freight up to {:.0} mph)",
            speed(class)
        ),
    };
    let next = (class + 1).min(HIGHEST_COVERED);
    let decides = found.governing().and_then(|own| {
        let limit = own.limit.of_class(next)?;
        let beyond = match own.limit.quantity {
            ClassQuantity::NarrowestGauge => "below",
            _ => "above",
        };
        let than = match class {
            HIGHEST_COVERED => format!("nearest to its limit is {}", own.limit.name),
            _ => format!("{} is {beyond} the limit of class {next}", own.limit.name),
        };
        Some(format!(
            ": {than}, {:.3} in ({} in) at {:.0} ft",
            own.value / INCH,
            SixDigits(limit / INCH),
            own.at / FOOT
        ))
    });
    let kept = match stated {
        Some(stated) if class < stated => format!(
            " It is said to be class {stated} ({:.0} mph): its geometry is worse.",
            speed(stated)
        ),
        _ => String::new(),
    };
    format!("{gets}{}.{kept}", decides.unwrap_or_default())
}

/// The standard deviations of a rail's profile or alignment by bands.
pub type Deviations = [Option<BandDeviation>; BANDS.len()];

impl Survey<'_> {
    /// Returns the standard deviations (m) by bands of wavelengths; none where the rows are too far apart for
    /// a band.
    #[must_use]
    pub fn bands(&self) -> Vec<(MeasuredTrack, Deviations)> {
        let measured = MeasuredTrack::ALL.into_iter();
        measured
            .map(|measured| {
                let values = self.values(measured);
                (
                    measured,
                    BANDS.map(|band| deviation(&values, self.interval(), band)),
                )
            })
            .collect()
    }
}
