//! What damage leaves on a profile: sums over places of equal width across it.
//!
//! Places are counted by y, across the track. A patch spreads what it does over its width 2 b in y as `3/4b
//! (1 - (y/b)²)`, as Hertz's pressure does in strips along the rolling direction. Each place gets the
//! integral over it, so that the sum over all is the whole, and what lies beyond the ends goes to the
//! outermost places.

/// What a patch does to a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dose {
    /// Worn volume, m³.
    pub volume: f64,
    /// Worn volume times the cosine of the contact angle, m³: the depth along the normal comes of it, on
    /// places that are counted across the track.
    pub square: f64,
    /// Energy that creep took, J.
    pub energy: f64,
    /// Damage by rolling contact fatigue times the distance over which it was done, m.
    pub fatigue: f64,
}

impl Dose {
    /// Adds a share of another one.
    pub fn add(&mut self, other: &Self, share: f64) {
        self.volume += share * other.volume;
        self.square += share * other.square;
        self.energy += share * other.energy;
        self.fatigue += share * other.fatigue;
    }
}

/// Sums over the places of a profile.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Where the first place begins on the profile, m.
    start: f64,
    /// Width of a place, m.
    width: f64,
    /// The sum of each place.
    pub places: Vec<Dose>,
}

impl Surface {
    /// Returns a surface without damage between two places of a profile (m), in places of at most this width.
    #[must_use]
    pub fn new([from, to]: [f64; 2], width: f64) -> Self {
        let count = ((to - from) / width).ceil().max(1.0);
        Self {
            start: from,
            width: (to - from) / count,
            places: vec![Dose::default(); count as usize],
        }
    }

    /// Returns the middles of the places, m.
    pub fn middles(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.places.len()).map(|i| self.start + self.width * (i as f64 + 0.5))
    }

    /// Returns the width of a place, m.
    #[must_use]
    pub fn width(&self) -> f64 {
        self.width
    }

    /// Returns the sum over all places.
    #[must_use]
    pub fn sum(&self) -> Dose {
        let mut sum = Dose::default();
        self.places.iter().for_each(|own| sum.add(own, 1.0));
        sum
    }

    /// Adds what a patch does that lies around a place of the profile (m) with half its width (m).
    pub fn add(&mut self, middle: f64, half: f64, dose: &Dose) {
        let last = self.places.len() - 1;
        // The part of a patch up to a place on it, from -1 to 1.
        let part = |at: f64| {
            let u = at.clamp(-1.0, 1.0);
            0.5 + 0.25 * u * (3.0 - u * u)
        };
        let number = |at: f64| (((at - self.start) / self.width).floor().max(0.0) as usize).min(last);
        let [first, end] = [number(middle - half), number(middle + half)];
        let mut before = 0.0;
        for i in first..=end {
            let upper = self.start + self.width * (i + 1) as f64;
            let up_to = match i == end {
                true => 1.0,
                false => part((upper - middle) / half),
            };
            self.places[i].add(dose, up_to - before);
            before = up_to;
        }
    }

    /// Adds another one of the same places.
    pub fn merge(&mut self, other: &Self, share: f64) {
        for (own, other) in self.places.iter_mut().zip(&other.places) {
            own.add(other, share);
        }
    }
}
