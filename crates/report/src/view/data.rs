//! Lists of numbers as text.

use std::collections::HashMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde::Serialize;

/// A list of numbers as text.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum List {
    /// Little-endian 32-bit floating point as base64.
    Exact(String),
    /// Multiples of a step.
    Rounded {
        /// The step, SI.
        step: f64,
        /// The second differences of the multiples, each with its sign in the lowest bit, seven bits a byte,
        /// the lowest ones first, the highest bit set where another byte follows; as base64.
        differences: String,
    },
}

/// The precision of lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// To 32-bit floating point, seven digits.
    Exact,
    /// To half a step of 1/2¹⁴ to 1/2¹⁵ of the largest number: a quarter of the room.
    Rounded,
}

/// The largest number is at most this many steps.
const STEPS: f64 = 32_768.0;

/// Lists of numbers, each kept once.
#[derive(Clone, Debug, Default)]
pub struct Data {
    lists: Vec<List>,
    places: HashMap<(u64, Vec<u8>), usize>,
}

impl Data {
    /// Keeps a list and gives its place. A list with numbers that are not finite is always kept exactly.
    pub fn keep(&mut self, values: &[f64], precision: Precision) -> usize {
        if precision == Precision::Rounded && values.iter().all(|value| value.is_finite()) {
            let (step, bytes) = rounded(values);
            let list = |bytes: &[u8]| List::Rounded {
                step,
                differences: STANDARD.encode(bytes),
            };
            return self.place((step.to_bits(), bytes), list);
        }
        let bytes = values.iter().flat_map(|value| (*value as f32).to_le_bytes());
        self.place((0, bytes.collect()), |bytes| List::Exact(STANDARD.encode(bytes)))
    }

    /// Keeps all lists of other data; gives the place of each.
    pub fn absorb(&mut self, other: Self) -> Vec<usize> {
        let mut lists: Vec<Option<List>> = other.lists.into_iter().map(Some).collect();
        let mut own = vec![0; lists.len()];
        let mut keys: Vec<_> = other.places.into_iter().collect();
        keys.sort_by_key(|(_, place)| *place);
        for (key, place) in keys {
            if let Some(list) = lists[place].take() {
                own[place] = self.place(key, |_| list);
            }
        }
        own
    }

    fn place(&mut self, key: (u64, Vec<u8>), list: impl FnOnce(&[u8]) -> List) -> usize {
        if let Some(place) = self.places.get(&key) {
            return *place;
        }
        let place = self.lists.len();
        self.lists.push(list(&key.1));
        self.places.insert(key, place);
        place
    }

    /// Returns the lists.
    #[must_use]
    pub fn into_lists(self) -> Vec<List> {
        self.lists
    }
}

/// Returns a step, a power of two so that numbers that hardly differ give the same bytes, and the second
/// differences. Whole numbers keep their values.
fn rounded(values: &[f64]) -> (f64, Vec<u8>) {
    let most = values.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
    let whole = most <= STEPS && values.iter().all(|value| value.fract() == 0.0);
    let step = match whole || most < f64::MIN_POSITIVE * STEPS {
        true => 1.0,
        false => libm::exp2(libm::ceil(libm::log2(most / STEPS))),
    };
    let mut bytes = Vec::with_capacity(2 * values.len());
    let (mut last, mut slope) = (0_i64, 0_i64);
    for value in values {
        let multiple = (value / step).round() as i64;
        let difference = multiple - last - slope;
        (last, slope) = (multiple, multiple - last);
        let mut rest = ((difference << 1) ^ (difference >> 63)) as u64;
        while rest > 127 {
            bytes.push(rest as u8 | 128);
            rest >>= 7;
        }
        bytes.push(rest as u8);
    }
    (step, bytes)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// Reads it as a reader does.
    fn read(step: f64, bytes: &[u8]) -> Vec<f64> {
        let (mut values, mut last, mut slope) = (Vec::new(), 0_i64, 0_i64);
        let mut rest = bytes.iter();
        while let Some(first) = rest.next() {
            let (mut number, mut shift, mut byte) = (i64::from(first & 127), 7, *first);
            while byte > 127 {
                byte = *rest.next().unwrap();
                number |= i64::from(byte & 127) << shift;
                shift += 7;
            }
            slope += (number >> 1) ^ -(number & 1);
            last += slope;
            values.push(last as f64 * step);
        }
        values
    }

    #[test]
    fn rounded_lists_read_back_to_half_a_step() {
        let wave: Vec<f64> = (0..500)
            .map(|k| 3e4 * libm::sin(0.02 * f64::from(k)) + 7.0 * f64::from(k % 13))
            .collect();
        let (step, bytes) = rounded(&wave);
        assert!(step <= 3.1e4 / 16384.0, "{step}");
        let back = read(step, &bytes);
        assert_eq!(back.len(), wave.len());
        for (back, value) in back.iter().zip(&wave) {
            assert!((back - value).abs() <= 0.5 * step, "{back} is not {value}");
        }
    }

    #[test]
    fn whole_numbers_and_zero_are_exact() {
        for list in [vec![0.0, 0.0], vec![2.0, 1.0, 0.0, 2.0, -3.0], vec![1e-320, 0.0]] {
            let (step, bytes) = rounded(&list);
            let back = read(step, &bytes);
            for (back, value) in back.iter().zip(&list) {
                assert!((back - value).abs() < 1e-300, "{back} is not {value}");
            }
        }
    }

    #[test]
    fn equal_lists_are_kept_once_also_of_other_data() {
        let mut data = Data::default();
        let first = data.keep(&[1.5, 2.5], Precision::Exact);
        assert_eq!(data.keep(&[1.5, 2.5], Precision::Exact), first);
        let mut other = Data::default();
        let (new, same) = (
            other.keep(&[0.25], Precision::Rounded),
            other.keep(&[1.5, 2.5], Precision::Exact),
        );
        let places = data.absorb(other);
        assert_eq!(places[same], first);
        assert_ne!(places[new], first);
        assert_eq!(data.into_lists().len(), 2);
    }
}
