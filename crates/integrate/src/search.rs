//! The first zero of several functions along a dense output, where an evaluation costs much: a bracket that closes around it.

/// Places that are remembered: the ends of the bracket and two that were left behind.
const REMEMBERED: usize = 4;
const LOW: usize = 0;
const HIGH: usize = 1;
/// A new place lies so far behind or before the zero that is expected, in units of the resolution, that the bracket closes.
const NUDGE: f64 = 0.4;
/// A zero is certain where the doubt is less than this part of the resolution.
const CERTAIN: f64 = 0.1;
/// The bracket is halved where this many rounds do not shorten it to an eighth,
const CHECKED: u32 = 3;
/// and always after this many rounds: there is no smooth function.
const MOST: u32 = 24;

/// A bracket and what is known of the functions there.
#[derive(Clone, Debug)]
pub(crate) struct Search {
    /// Number of functions.
    count: usize,
    /// Low end, high end, places left behind, the last one first; not a number: nothing is known.
    places: [f64; REMEMBERED],
    /// Where the values there stand; at last where those of the next place are written.
    rows: [usize; REMEMBERED + 1],
    values: Vec<f64>,
    /// Rounds so far, and the bracket's width at the last check.
    round: u32,
    width: f64,
    /// Whether the last place was the middle, because the bracket closed too slowly.
    halved: bool,
    /// The end that the last place was chosen to move, and how often in a row the other one moved instead, by less than the resolution.
    meant: Option<usize>,
    crawl: i32,
}

impl Search {
    pub fn new(count: usize) -> Self {
        Self {
            count,
            places: [f64::NAN; REMEMBERED],
            rows: std::array::from_fn(|k| k),
            values: vec![0.0; count * (REMEMBERED + 1)],
            round: 0,
            width: f64::INFINITY,
            halved: false,
            meant: None,
            crawl: 0,
        }
    }

    /// Forgets everything.
    pub fn clear(&mut self) {
        self.places = [f64::NAN; REMEMBERED];
        (self.round, self.width) = (0, f64::INFINITY);
        (self.halved, self.meant, self.crawl) = (false, None, 0);
    }

    /// Where the values at the next place are to be written.
    #[inline]
    pub fn next(&mut self) -> &mut [f64] {
        &mut self.values[self.rows[REMEMBERED] * self.count..][..self.count]
    }

    /// What was written to [`Search::next`] are the values at the low end.
    #[inline]
    pub fn put_low(&mut self, place: f64) {
        self.put(LOW, place);
    }

    /// The same of the high end.
    #[inline]
    pub fn put_high(&mut self, place: f64) {
        self.put(HIGH, place);
    }

    /// The same of a place outside the bracket.
    #[inline]
    pub fn put_aside(&mut self, place: f64) {
        self.put(HIGH + 1, place);
    }

    fn put(&mut self, end: usize, place: f64) {
        let row = self.rows[REMEMBERED];
        if self.places[end].is_nan() {
            self.rows[REMEMBERED] = self.rows[end];
        } else {
            self.rows.copy_within(HIGH + 1..REMEMBERED, HIGH + 2);
            self.places.copy_within(HIGH + 1..REMEMBERED - 1, HIGH + 2);
            self.rows[HIGH + 1] = self.rows[end];
            self.places[HIGH + 1] = self.places[end];
        }
        self.rows[end] = row;
        self.places[end] = place;
        self.crawl = if self.meant.is_some_and(|meant| meant != end) {
            self.crawl + 1
        } else {
            0
        };
    }

    /// The ends of the bracket.
    #[inline]
    pub fn ends(&self) -> (f64, f64) {
        (self.places[LOW], self.places[HIGH])
    }

    /// The values at the low end.
    #[inline]
    pub fn low(&self) -> &[f64] {
        self.row(LOW)
    }

    /// The values at the high end.
    #[inline]
    pub fn high(&self) -> &[f64] {
        self.row(HIGH)
    }

    #[inline]
    fn row(&self, place: usize) -> &[f64] {
        &self.values[self.rows[place] * self.count..][..self.count]
    }

    /// Where the next evaluation should be, if a zero is expected at a place and the bracket is wider than the resolution.
    pub fn place(&mut self, expected: f64, resolution: f64) -> f64 {
        let (low, high) = self.ends();
        let width = high - low;
        self.round += 1;
        self.halved = false;
        if self.round.is_multiple_of(CHECKED) || self.round > MOST {
            self.halved = width > 0.125 * self.width || self.round > MOST;
            self.width = width;
            if self.halved {
                self.meant = None;
                return 0.5 * (low + high);
            }
        }
        // Beyond the zero as seen from the nearer end, so that the farther one comes near, too; ever farther where values are so small that
        // their rounding errors decide.
        let (to_low, to_high) = (expected - low, high - expected);
        if to_low.min(to_high) > resolution {
            self.crawl = 0;
        }
        let nudge = NUDGE * resolution * f64::from(1 << (2 * self.crawl.min(10)));
        let (meant, place) = if to_low < to_high {
            (HIGH, expected + nudge)
        } else {
            (LOW, expected - nudge)
        };
        self.meant = Some(meant);
        let least = 0.25 * resolution.min(width);
        if place.is_finite() {
            place.max(low + least).min(high - least)
        } else {
            0.5 * (low + high)
        }
    }

    /// Where a zero is expected with hardly a doubt: the place right behind it. If it becomes the high end and is
    /// confirmed, the search may stop there, without a look right before the zero.
    pub fn settle(&mut self, expected: f64, doubt: f64, resolution: f64) -> Option<f64> {
        if self.round > MOST || doubt > CERTAIN * resolution || expected + resolution > self.places[HIGH] {
            return None;
        }
        self.round += 1;
        self.meant = Some(HIGH);
        Some(expected + NUDGE * resolution)
    }

    /// Whether a function came down to the high end, a place that [`Search::settle`] told, by about as much as it was to: one that stays near
    /// zero may have come there long before.
    pub fn confirms(&self, index: usize, resolution: f64) -> bool {
        let (low, high) = self.ends();
        let (first, last) = (self.low()[index], self.high()[index]);
        -last * (high - low) > 0.1 * NUDGE * resolution * (first - last)
    }

    /// Where a function that changes its sign in the bracket comes to zero: by the polynomial through all that is known.
    pub fn zero(&self, index: usize) -> f64 {
        self.zero_and_doubt(index).0
    }

    /// The same, and by how much the polynomial of a degree less is apart (infinite where there is none).
    pub fn zero_and_doubt(&self, index: usize) -> (f64, f64) {
        let at = |place: usize| (self.places[place], self.row(place)[index]);
        let ((low, first), (high, last)) = (at(LOW), at(HIGH));
        let width = high - low;
        let line = width * (first / (first - last));
        // from the low end on: first + t (slope + (t - width) bend)
        let (behind, value) = at(HIGH + 1);
        let slope = (last - first) / width;
        let outer = (value - last) / (behind - high);
        let bend = (outer - slope) / (behind - low);
        let start = slope - width * bend;
        let root = (start * start - 4.0 * first * bend).sqrt();
        let parabola = 2.0 * first / (if first > last { root } else { -root } - start);
        let inside = |t: f64| t >= 0.0 && t <= width;
        let beyond = if behind > high {
            width - last / outer
        } else {
            -first * (behind - low) / (value - first)
        };
        if self.halved && inside(beyond) {
            // smooth on one side only
            return (low + beyond, f64::INFINITY);
        }
        if !inside(parabola) {
            return (low + line, f64::INFINITY);
        }
        let (farther, value_there) = at(HIGH + 2);
        let outermost = ((value_there - value) / (farther - behind) - outer) / (farther - high);
        let twist = (outermost - bend) / (farther - low);
        let mut cubic = parabola;
        for _ in 0..2 {
            let (back, bent) = (cubic - width, bend + (cubic - (behind - low)) * twist);
            let value = first + cubic * (slope + back * bent);
            cubic -= value / (slope + back * bent + cubic * (bent + back * twist));
        }
        if inside(cubic) {
            (low + cubic, (cubic - parabola).abs())
        } else {
            (low + parabola, f64::INFINITY)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    type Function<'a> = &'a dyn Fn(f64) -> f64;

    /// The zero, and how many evaluations it took, of the first of two functions to become negative; enclosed, or behind what is hardly in
    /// doubt.
    fn find(functions: [Function<'_>; 2], resolution: f64, settles: bool) -> (f64, usize) {
        let mut search = Search::new(2);
        let write = |search: &mut Search, at: f64| {
            let row = search.next();
            row.copy_from_slice(&functions.map(|function| function(at)));
            row.iter().all(|value| *value > 0.0)
        };
        assert!(write(&mut search, 0.0));
        search.put_low(0.0);
        assert!(!write(&mut search, 1.0));
        search.put_high(1.0);
        let mut count = 0;
        while search.ends().1 - search.ends().0 > resolution {
            let crossing = (0..2).filter(|i| search.high()[*i] <= 0.0);
            let (expected, doubt) =
                crossing
                    .map(|i| search.zero_and_doubt(i))
                    .fold(
                        (f64::INFINITY, f64::INFINITY),
                        |a, b| if b.0 < a.0 { b } else { a },
                    );
            let settled = settles
                .then(|| search.settle(expected, doubt, resolution))
                .flatten();
            let at = settled.unwrap_or_else(|| search.place(expected, resolution));
            count += 1;
            if write(&mut search, at) {
                search.put_low(at);
            } else {
                search.put_high(at);
                let crossing = (0..2).filter(|i| search.high()[*i] <= 0.0);
                if settled.is_some() && crossing.into_iter().any(|i| search.confirms(i, resolution)) {
                    break;
                }
            }
            assert!(count < 200);
        }
        (search.ends().1, count)
    }

    #[test]
    fn the_first_zero_is_found_to_the_resolution() {
        let never = |_: f64| 1.0;
        let line = |t: f64| 0.3 - t;
        let curve = |t: f64| libm::exp(1.7 * t) * (0.8 - t) + 0.1 * libm::sin(10.0 * (t - 0.8));
        let cliff = |t: f64| (0.7f64 - t).min(1e-6) * 1e6;
        let steep = |t: f64| 1e-3 - t.powi(9);
        let gentle = |t: f64| libm::cos(t) - 0.8 + 0.1 * t;
        // a step has no value near zero, a step down to zero stays there
        let jump = |t: f64| if t < 0.123 { 1.0 } else { -1e3 };
        let floor = |t: f64| (0.4 - t).max(0.0);
        let cases: [(Function<'_>, f64, usize); 7] = [
            (&line, 0.3, 3),
            (&curve, 0.8, 9),
            (&cliff, 0.7, 12),
            (&steep, 1e-3_f64.powf(1.0 / 9.0), 20),
            (&jump, 0.123, 60),
            (&floor, 0.4, 60),
            (&gentle, 0.761_418_325_005_647_8, 6),
        ];
        let mut saved = 0;
        for resolution in [1e-3, 1e-7, 1e-12] {
            for (number, (function, zero, most)) in cases.iter().enumerate() {
                for functions in [[*function, &never as Function<'_>], [&never, *function]] {
                    let (found, count) = find(functions, resolution, false);
                    let (settled, fewer) = find(functions, resolution, true);
                    println!("case {number}, {resolution}: {count}, {fewer}");
                    for found in [found, settled] {
                        assert!(
                            (found - zero).abs() <= 1.01 * resolution,
                            "case {number}: {found}"
                        );
                    }
                    assert!(count <= *most, "case {number}: {count} evaluations");
                    assert!(fewer <= *most, "case {number}: {fewer} evaluations");
                    saved += i32::from(fewer < count) - i32::from(fewer > count);
                }
            }
        }
        assert!(saved >= 6, "evaluations saved in {saved} more cases than spent");
        for settles in [false, true] {
            let (found, _) = find([&line, &curve], 1e-12, settles);
            assert!((found - 0.3).abs() < 1.1e-12, "{found}");
        }
    }
}
