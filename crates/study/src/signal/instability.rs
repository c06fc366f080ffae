//! The root of the mean square about the dominant frequency: how much of a force is hunting.
//!
//! The dominant frequency f₀ is that with the greatest density of Welch's spectrum ([`Spectrum`]) above half
//! a hertz: slower changes are the track's. The values go through a band-pass filter ([`BandPass`]) from f₀ -
//! 2 Hz, or half a hertz if that is more, to f₀ + 2 Hz. The band is remembered of EN 14363:2005.
//!
//! A period of the lower end of the band is left out at both ends of the run, where a length remains: the
//! filter does not know how the values go on.
//!
//! Limits: the filter takes 4 % of a sine of f₀ = 2.7 Hz in the middle of its band, less at higher ones.

use thiserror::Error;

use super::{BandPass, LowPass, Spectrum, SpectrumError, TooCoarse, WindowValue, largest_rms};

/// Half of the width of the band, Hz.
pub const HALF_BAND: f64 = 2.0;
/// What is slower is not instability, Hz.
pub const SLOWEST: f64 = 0.5;

/// A motion about its dominant frequency.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Instability {
    /// The dominant frequency, Hz.
    pub frequency: f64,
    /// The largest root of the mean square in the band.
    pub rms: WindowValue,
}

/// Reasons why there is none.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum InstabilityError {
    /// There is no spectrum.
    #[error(transparent)]
    Spectrum(#[from] SpectrumError),
    /// The filter needs more rows.
    #[error(transparent)]
    Coarse(#[from] TooCoarse),
    /// Spectrum or rows are too short to have any value.
    #[error("there are no frequencies above {SLOWEST} Hz, or no rows")]
    Nothing,
}

impl Instability {
    /// Returns the largest root of the mean square of values (at times that are evenly apart, s) in the band
    /// about their dominant frequency, within stretches of a length of `places` (as [`largest_rms`]).
    ///
    /// # Errors
    /// The rows are too few, uneven, or too far apart.
    pub fn of(times: &[f64], places: &[f64], values: &[f64], length: f64) -> Result<Self, InstabilityError> {
        let spectrum = Spectrum::welch(times, values, None)?;
        let interval = (times[values.len() - 1] - times[0]) / (values.len() - 1) as f64;
        let fastest = 1.0 / interval.max(f64::MIN_POSITIVE);
        let within = [SLOWEST, fastest / LowPass::ROWS - HALF_BAND];
        let frequency = spectrum.peak_within(within).ok_or(InstabilityError::Nothing)?;
        let band = [(frequency - HALF_BAND).max(SLOWEST), frequency + HALF_BAND];
        let filtered = BandPass::new(interval, band)?.apply(values);
        let ends = (1.0 / (band[0] * interval)).ceil() as usize;
        let last = filtered.len() - 1;
        let inner = match ends < last / 2 && places[last - ends] - places[ends] >= length {
            true => ends..last - ends + 1,
            false => 0..last + 1,
        };
        let places = places.get(inner.clone()).ok_or(InstabilityError::Nothing)?;
        let rms = largest_rms(places, &filtered[inner], length).ok_or(InstabilityError::Nothing)?;
        Ok(Self { frequency, rms })
    }
}
