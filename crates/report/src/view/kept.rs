//! A run's view as its own page keeps it: with the corners of wedges and the motions of bodies that its table
//! has not.

use std::collections::BTreeMap;
use std::path::Path;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use input::file::{Expected, read_text};
use input::{FileType, limits};
use serde_json::Value;

use super::SCHEMA;
use crate::page::packed::unpack;

/// The expected file of a page.
const PAGE: Expected = Expected {
    what: "page",
    types: &[FileType::Page],
    most: limits::RECORD_FILE,
};

/// The element of a page with the data.
pub(crate) const DATA: &str = "wedgelab-view";
const AFTER: &str = "</script>";

/// Returns the data in a page: JSON, unpacked where it is packed.
#[must_use]
pub fn data_in(page: &str) -> Option<String> {
    let (_, rest) = page.split_once(&format!(" id=\"{DATA}\">"))?;
    let (data, _) = rest.split_once(AFTER)?;
    match data.starts_with('{') {
        true => Some(data.to_owned()),
        false => unpack(data).ok(),
    }
}

/// A run of another page's document, with the lists that it names.
#[derive(Clone, Debug, PartialEq)]
pub struct KeptView {
    run: Value,
    lists: Vec<Value>,
}

impl KeptView {
    /// Returns the view of the run `name` in a page; `None` where there is no such page or run, or it is of
    /// another version.
    #[must_use]
    pub fn read(page: &Path, name: &str) -> Option<Self> {
        Self::of_page(&read_text(page, &PAGE).ok()?, name)
    }

    fn of_page(text: &str, name: &str) -> Option<Self> {
        let mut document: Value = serde_json::from_str(&data_in(text)?).ok()?;
        if document["schema"] != SCHEMA {
            return None;
        }
        let runs = document["runs"].as_array_mut()?;
        let place = runs.iter().position(|run| run["name"] == name)?;
        let mut run = runs.swap_remove(place);
        let all = document["data"].as_array()?;
        let mut lists = Vec::new();
        let mut moved: BTreeMap<usize, usize> = BTreeMap::new();
        let mut whole = true;
        each_place(&mut run, |place| {
            *moved.entry(place).or_insert_with(|| {
                whole &= all.get(place).is_some();
                lists.push(all.get(place).cloned().unwrap_or(Value::Null));
                lists.len() - 1
            })
        })?;
        whole.then_some(Self { run, lists })
    }

    /// Returns the same under another name.
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        self.run["name"] = name.into();
        self
    }

    /// Returns its title.
    #[must_use]
    pub fn title(&self) -> &str {
        self.run["title"].as_str().unwrap_or_default()
    }

    /// Returns its name.
    #[must_use]
    pub fn name(&self) -> &str {
        self.run["name"].as_str().unwrap_or_default()
    }

    /// Returns whether it has a 3D view.
    #[must_use]
    pub fn has_scene(&self) -> bool {
        self.run["scene"].is_object()
    }

    /// Returns its output times, s; empty where they are damaged.
    #[must_use]
    pub fn times(&self) -> Vec<f32> {
        let place = self.run["time"]
            .as_u64()
            .and_then(|place| usize::try_from(place).ok());
        let list = place.and_then(|place| self.lists.get(place)?.as_str());
        let bytes = list
            .and_then(|text| STANDARD.decode(text).ok())
            .unwrap_or_default();
        let numbers = bytes.chunks_exact(4);
        numbers
            .map(|own| f32::from_le_bytes([own[0], own[1], own[2], own[3]]))
            .collect()
    }

    /// Puts it into a document.
    pub(super) fn add_to(mut self, document: &mut Value) {
        let Some(data) = document["data"].as_array_mut() else {
            return;
        };
        let first = data.len();
        data.extend(self.lists);
        let done = each_place(&mut self.run, |place| first + place);
        if let (Some(()), Some(runs)) = (done, document["runs"].as_array_mut()) {
            runs.push(self.run);
        }
    }
}

/// Replaces every place of a list that a run names; `None` where one is no number.
fn each_place(run: &mut Value, mut new: impl FnMut(usize) -> usize) -> Option<()> {
    let mut replace = |place: &mut Value| {
        let old = usize::try_from(place.as_u64()?).ok()?;
        *place = new(old).into();
        Some(())
    };
    replace(run.get_mut("time")?)?;
    for column in run.get_mut("columns")?.as_object_mut()?.values_mut() {
        if let Some(place) = column.get_mut("data") {
            replace(place)?;
        }
    }
    let samples = run.pointer_mut("/scene/track/samples");
    for place in samples
        .and_then(Value::as_object_mut)
        .into_iter()
        .flat_map(serde_json::Map::values_mut)
    {
        replace(place)?;
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE_TEXT: &str = "<html><script type=\"application/json\" id=\"wedgelab-view\">\
        {\"schema\":\"wedgelab.view/1\",\"data\":[\"eA==\",\"AAAAAAAAgD8=\",\"YQ==\",\"YQ==\"],\"runs\":[\
        {\"name\":\"a\",\"title\":\"\",\"time\":1,\"columns\":{\"u\":{\"data\":3},\"v\":{\"value\":2.0}},\
        \"scene\":{\"track\":{\"samples\":{\"x\":1}}}}]}</script></html>";

    #[test]
    fn a_run_of_a_page_keeps_its_lists_and_no_others() {
        let kept = KeptView::of_page(PAGE_TEXT, "a").map(|kept| kept.named("b"));
        let kept = kept.unwrap_or(KeptView {
            run: Value::Null,
            lists: Vec::new(),
        });
        assert_eq!(kept.times(), [0.0, 1.0]);
        assert!(kept.has_scene());
        let mut document = serde_json::json!({ "data": ["first"], "runs": [] });
        kept.add_to(&mut document);
        assert_eq!(document["data"].as_array().map(Vec::len), Some(3));
        let run = &document["runs"][0];
        assert_eq!(run["name"], "b");
        assert_eq!(
            run["time"], run["scene"]["track"]["samples"]["x"],
            "equal lists stay one"
        );
        let place = |value: &Value| value.as_u64().and_then(|place| usize::try_from(place).ok());
        let list = |value: &Value| document["data"][place(value).unwrap_or(9)].clone();
        assert_eq!(list(&run["time"]), "AAAAAAAAgD8=");
        assert_eq!(list(&run["columns"]["u"]["data"]), "YQ==");
    }

    #[test]
    fn input_pages_of_others_are_left_out() {
        assert_eq!(KeptView::of_page(PAGE_TEXT, "b"), None);
        for (from, to) in [
            ("view/1", "view/9"),
            ("\"time\":1", "\"time\":9"),
            ("\"time\":1", "\"time\":\"1\""),
            ("id=\"wedgelab-view\"", "id=\"other\""),
        ] {
            assert_eq!(KeptView::of_page(&PAGE_TEXT.replace(from, to), "a"), None, "{to}");
        }
    }
}
