//! Lists of numbers as text.

use std::collections::HashMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Lists of numbers, each kept once.
#[derive(Clone, Debug, Default)]
pub struct Data {
    texts: Vec<String>,
    places: HashMap<Vec<u8>, usize>,
}

impl Data {
    /// Keeps a list, rounded to 32 bits (seven digits), and gives its place.
    pub fn keep(&mut self, values: impl IntoIterator<Item = f64>) -> usize {
        let bytes: Vec<u8> = values
            .into_iter()
            .flat_map(|value| (value as f32).to_le_bytes())
            .collect();
        if let Some(place) = self.places.get(&bytes) {
            return *place;
        }
        let place = self.texts.len();
        self.texts.push(STANDARD.encode(&bytes));
        self.places.insert(bytes, place);
        place
    }

    /// The lists.
    #[must_use]
    pub fn into_texts(self) -> Vec<String> {
        self.texts
    }
}
