//! Regimes: tracks and speeds on which freight cars are assessed, as data.
//!
//! ```toml
//! name = "twist_and_roll"
//! title = "ten staggered low joints 39 ft apart"
//! source = "remembered of AAR M-1001, chapter XI: check against your edition"
//! lading = "loaded"                   # what it is meant for: loaded or empty; left out: either
//! looks_at = "roll of the body over the speed"
//! speeds = ["12 mph", "16 mph", "20 mph", "30 mph", "50 mph", "70 mph"]
//! range = ["10 mph", "70 mph"]        # speeds that the track bears
//! reason = "the test is run from 10 to 70 mph"
//! distance = "640 ft"                 # how far the car runs, at every speed
//! settle = "120 ft"                   # statistics leave out what is before it
//! [set]                               # keys of the case
//! simulation.method = "rodas5p"
//! [track]                             # whole, as in a case
//! segments = [{ tangent = "1000 ft" }]
//! ```
//!
//! A regime replaces a car's track and speed; the other keys of the car stay. Amplitudes and curves of the
//! built-in ones are remembered of AAR M-1001, chapter XI: check them against your edition.

use std::path::{Path, absolute};
use std::sync::LazyLock;

use input::FileType;
use quantity::{Kind, Quantity};
use wheelrail::track::CenterLine;

use super::named::{self, BuiltInOrFile, built_in, find, try_on_car};
use super::run::in_curve;
use crate::case::field::quoted;
use crate::case::problem::{Problem, Problems, TomlLocation, TomlSource};
use crate::case::section::{CaseSection, Names, Range, quantity};
use crate::case::tree::{self, NodeValue, TableEntry, TableNode, TreeNode};
use crate::case::{CaseError, Tables, name};
use crate::track::{TrackFile, of_section};

const KEYS: [&str; 12] = [
    "name", "title", "source", "lading", "looks_at", "speeds", "range", "reason", "distance", "settle",
    "set", "track",
];
/// Keys of a case that follow from the speed, and what a regime has instead of them.
const OWN: [(&str, &str); 4] = [
    ("track", "write [track]"),
    ("speed", "write the speeds as speeds = [...]"),
    ("simulation.duration", "write distance = \"600 ft\""),
    ("start.settle", "write settle = \"120 ft\""),
];
const LADINGS: Names<&str> = &[("loaded", "loaded"), ("empty", "empty")];
/// Most speeds in a file.
const MOST_SPEEDS: usize = 100;
/// Durations are whole multiples of it, s.
const DURATION_STEP: f64 = 0.05;
/// Distance of the places at which a track is looked at for curves, m.
const LOOK: f64 = 5.0;
/// Parts of a range by which a speed may lie outside: digits of units.
const SLACK: f64 = 1e-9;

/// The key of the start. Where nothing sets it, cars in regimes start shaken: with what friction holds in
/// service.
pub(crate) const START: &str = "start.kind";

/// Returns whether settings, as `--set` takes them, say how a car starts.
pub(crate) fn says_start(set: &[String]) -> bool {
    set.iter().any(|own| own.split('=').next() == Some(START))
}

/// The built-in regimes, in order.
const BUILT_IN: [(&str, &str); 22] = built_in![
    "",
    "hunting",
    "twist_and_roll",
    "pitch_and_bounce",
    "yaw_and_sway",
    "dynamic_curving",
    "constant_curve",
    "spiral",
    "bunched_spiral",
    "constant_curve_10",
    "constant_curve_12",
    "single_bump",
    "curve_with_bump",
    "curve_with_dip",
    "lean",
    "static_curve",
    "buff_curve",
    "draft_curve",
    "fra_class_1",
    "fra_class_2",
    "fra_class_3",
    "fra_class_4",
    "fra_class_5",
];

static ALL: LazyLock<Vec<Regime>> = LazyLock::new(|| {
    let regimes = BUILT_IN.iter();
    // That all of them can be read, a test holds.
    regimes
        .filter_map(|(name, text)| Regime::parse(&format!("{name}.toml"), text).ok())
        .collect()
});

/// A track and speeds on which cars are assessed.
#[derive(Clone, Debug, PartialEq)]
pub struct Regime {
    /// A name that can be the name of a folder.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// The source of track and speeds.
    pub source: String,
    /// The cars that it is meant for: `loaded` or `empty` cars; `None`: either.
    pub lading: Option<String>,
    /// The features to look at in its results; may be empty.
    pub looks_at: String,
    /// The speeds at which it is run if none are given, at least one, in rising order.
    pub speeds: Vec<Quantity>,
    /// The least and the greatest speed that the track bears.
    pub range: [Quantity; 2],
    /// The reason for this range.
    pub reason: String,
    /// The distance that the car runs.
    pub distance: Quantity,
    /// Statistics leave out what is before this distance from the start; `None`: what is before the car's
    /// own `start.settle`.
    pub settle: Option<Quantity>,
    /// Keys of the case that it sets, as `--set` takes them.
    pub set: Vec<String>,
    /// The track, as TOML in one value.
    pub track: String,
    /// True if the car comes into a full curve.
    pub curved: bool,
    /// The file.
    pub text: String,
}

impl Regime {
    /// Returns the built-in regimes, in the order in which they are run.
    #[must_use]
    pub fn all() -> &'static [Regime] {
        &ALL
    }

    /// Returns the built-in regime of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Regime> {
        Self::all().iter().find(|own| own.name == name)
    }

    /// Reads a user's regime: a built-in one by its name, or a file.
    ///
    /// # Errors
    /// There is neither; or something in the file is wrong: all mistakes are reported together.
    pub fn named_or_read(text: &str) -> Result<Regime, CaseError> {
        match find("there is no regime", text, Self::all(), |own| &own.name)? {
            BuiltInOrFile::BuiltIn(own) => Ok(own.clone()),
            BuiltInOrFile::File(path) => Self::read(path),
        }
    }

    /// Reads a regime's file. Files that its track names are looked for from its folder.
    ///
    /// # Errors
    /// The file cannot be read, or something in it is wrong; all mistakes are reported together.
    pub fn read(path: &Path) -> Result<Regime, CaseError> {
        let help = "docs/regimes.md says how to write one, and has a regime to begin with";
        let text = named::read(path, "regime's file", &[FileType::Regime], help)?;
        let regime = Self::parse(&path.display().to_string(), &text)?;
        regime.try_out(path)?;
        Ok(regime)
    }

    /// As [`Regime::read`], from a text that `source` names in messages. Whether the car runs on it is not
    /// tried.
    ///
    /// # Errors
    /// As [`Regime::read`].
    pub fn parse(source: &str, text: &str) -> Result<Regime, CaseError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let failed = |problems| CaseError::new(problems).of("regime");
        let tree = tree::parse(&TomlSource::new(source, text)).map_err(failed)?;
        let mut problems = Problems::new();
        let regime = read(&tree, source, text, &mut problems);
        let regime = regime.filter(|_| problems.is_empty());
        regime.ok_or_else(|| failed(problems))
    }

    /// Returns the settings over a car's case at a speed, as `--set` takes them.
    ///
    /// # Errors
    /// The speed lies outside the range that the track bears.
    pub fn settings(&self, speed: &Quantity) -> Result<Vec<String>, CaseError> {
        // Lines of a case file, in which a table stands once.
        let speed_alone = format!("speed={{ kind = \"held\", value = {} }}", quoted(speed.text()));
        let mut settings = vec![format!("track={}", self.track), speed_alone];
        settings.extend(self.at(speed)?.into_iter().skip(1));
        settings.extend(self.set.iter().cloned());
        if !says_start(&self.set) {
            settings.push(format!("{START}=\"shaken\""));
        }
        Ok(settings)
    }

    /// Returns the settings over a car's case at every speed.
    #[must_use]
    pub fn everywhere(&self) -> Vec<String> {
        let mut settings = vec![
            format!("track={}", self.track),
            "speed={ kind = \"held\" }".to_owned(),
        ];
        settings.extend(self.set.iter().cloned());
        settings
    }

    /// Returns the settings that depend on the speed: first the speed, then the duration, and how much of it
    /// is settling.
    ///
    /// # Errors
    /// The speed lies outside the range that the track bears.
    pub fn at(&self, speed: &Quantity) -> Result<Vec<String>, CaseError> {
        let si = speed.to_si();
        let [least, greatest] = self.range.each_ref().map(Quantity::to_si);
        if !(least * (1.0 - SLACK)..=greatest * (1.0 + SLACK)).contains(&si) {
            let [from, to] = &self.range;
            let message = format!("the regime {} is for {from} to {to}, not for {speed}", self.name);
            return Err(Problem::new(message).help(self.reason.clone()).into());
        }
        let duration = (self.distance.to_si() / si / DURATION_STEP).ceil() * DURATION_STEP;
        let mut settings = vec![
            format!("speed.value={}", quoted(speed.text())),
            format!("simulation.duration=\"{duration:.2} s\""),
        ];
        if let Some(settle) = &self.settle {
            settings.push(format!("start.settle=\"{:.3} s\"", settle.to_si() / si));
        }
        Ok(settings)
    }

    /// Lays it over the car of which nothing is given, at both ends of its range; mistakes are shown in its
    /// file.
    fn try_out(&self, path: &Path) -> Result<(), CaseError> {
        let source = TomlSource::new(path.display().to_string(), self.text.as_str());
        let tree = tree::parse(&source).map_err(CaseError::new)?;
        for speed in &self.range {
            let tried = try_on_car(&self.settings(speed)?, |path| {
                let own = match path {
                    Some("simulation.duration") => "distance".to_owned(),
                    Some("start.settle") => "settle".to_owned(),
                    Some("speed") => "range".to_owned(),
                    Some("track") | None => "track".to_owned(),
                    Some(path) => format!("set.{path}"),
                };
                tree.place_of(&own)
            });
            tried.map_err(|error| error.of("regime"))?;
        }
        Ok(())
    }
}

fn read(tree: &TableNode, source: &str, text: &str, problems: &mut Problems) -> Option<Regime> {
    let top = CaseSection {
        path: String::new(),
        table: tree,
        place: None,
    };
    top.allow_in(&KEYS, &[], "a regime", problems);
    let name = name::read(&top, name::of_source(source), problems);
    let title = top.optional_text("title", problems);
    let looks_at = top.optional_text("looks_at", problems);
    let reason = top.optional_text("reason", problems);
    // A table of numbers without a source is one that nobody can check.
    let source_text = top.text("source", problems).map(|(text, _)| text.to_owned());
    let lading = match tree.get("lading") {
        Some(_) => top
            .choice("lading", LADINGS, problems)
            .map(|own| Some(own.to_owned())),
        None => Some(None),
    };
    let range = speeds(&top, "range", problems).and_then(|own| ends(&top, own, problems));
    let speeds = speeds(&top, "speeds", problems);
    if let (Some(speeds), Some([least, greatest])) = (&speeds, &range) {
        let inside = least.to_si() * (1.0 - SLACK)..=greatest.to_si() * (1.0 + SLACK);
        for (own, node) in speeds.iter().filter(|(own, _)| !inside.contains(&own.to_si())) {
            let message = format!("`speeds` has {own}, outside of the range, {least} to {greatest}");
            let problem = Problem::new(message).at(&node.place).label("outside of `range`");
            problems.push(problem.help("widen `range`, or leave this speed out"));
        }
    }
    let distance = top.quantity("distance", Kind::Distance, Range::Positive, problems);
    let settle = match tree.get("settle") {
        Some(_) => top
            .quantity("settle", Kind::Distance, Range::NotNegative, problems)
            .map(Some),
        None => Some(None),
    };
    if let (Some(distance), Some(Some(settle)), Some(place)) = (&distance, &settle, tree.place_of("settle"))
        && settle.to_si() >= distance.to_si()
    {
        let message = format!("`settle` is {settle}, but the car runs {distance}: no statistics are left");
        let problem = Problem::new(message).at(place).label("not below `distance`");
        problems.push(problem.help("make `distance` longer"));
    }
    let set = set(&top, problems);
    let track = track(&top, source, problems);
    let (track, line) = (track.as_ref().map(|own| own.0.clone()), track.map(|own| own.1));
    let curved = line.zip(distance.as_ref()).map(|(line, distance)| {
        let steps = (distance.to_si() / LOOK) as usize;
        (0..=steps).any(|step| in_curve(&line, step as f64 * LOOK))
    });
    Some(Regime {
        name: name?,
        title: title?,
        source: source_text?,
        lading: lading?,
        looks_at: looks_at?,
        speeds: speeds?.into_iter().map(|(speed, _)| speed).collect(),
        range: range?,
        reason: reason?,
        distance: distance?,
        settle: settle?,
        set: set?,
        track: track?,
        curved: curved?,
        text: text.to_owned(),
    })
}

/// A speed as typed, and where it stands.
type Speed<'t> = (Quantity, &'t TreeNode);

/// Returns a list of speeds in rising order, at least one.
fn speeds<'t>(top: &CaseSection<'t>, key: &str, problems: &mut Problems) -> Option<Vec<Speed<'t>>> {
    let help = format!("write for example {key} = [\"10 mph\", \"70 mph\"]");
    let node = top.require(key, &help, problems)?;
    let mut wrong = |node: &TreeNode, message: String| {
        let problem = Problem::new(message)
            .at(&node.place)
            .label("speeds in rising order");
        problems.push(problem.help(help.clone()));
    };
    let items = match &node.value {
        NodeValue::List(items) if (1..=MOST_SPEEDS).contains(&items.len()) => items,
        NodeValue::List(items) => {
            let message = format!(
                "`{key}` has {} entries; 1 to {MOST_SPEEDS} are expected",
                items.len()
            );
            wrong(node, message);
            return None;
        }
        other => {
            wrong(
                node,
                format!("`{key}` is {}; a list is expected", other.describe()),
            );
            return None;
        }
    };
    let mut read: Vec<Speed<'t>> = Vec::new();
    for (number, item) in items.iter().enumerate() {
        let path = format!("{key}[{number}]");
        let speed = quantity(item, &path, Kind::TravelSpeed, Range::Positive, problems)?;
        if let Some((before, _)) = read.last()
            && before.to_si() >= speed.to_si()
        {
            let message = format!("`{key}` has {speed} after {before}");
            let problem = Problem::new(message)
                .at(&item.place)
                .label("not faster than the one before");
            problems.push(problem.help(help));
            return None;
        }
        read.push((speed, item));
    }
    Some(read)
}

/// Returns the least and the greatest speed.
fn ends(top: &CaseSection<'_>, speeds: Vec<Speed<'_>>, problems: &mut Problems) -> Option<[Quantity; 2]> {
    let count = speeds.len();
    let ends: Result<[Speed<'_>; 2], _> = speeds.try_into();
    match ends {
        Ok(ends) => Some(ends.map(|(speed, _)| speed)),
        Err(_) => {
            let problem = Problem::new(format!("`range` has {count} speeds; two are expected"));
            let problem = problem.label("the least and the greatest");
            let problem = problem.help("write for example range = [\"10 mph\", \"70 mph\"]");
            problems.push(match top.table.place_of("range") {
                Some(place) => problem.at(place),
                None => problem,
            });
            None
        }
    }
}

/// Returns the keys of the case below `[set]`.
fn set(top: &CaseSection<'_>, problems: &mut Problems) -> Option<Vec<String>> {
    if top.table.entry("set").is_none() {
        return Some(Vec::new());
    }
    let section = top.section("set", problems)?;
    for (path, help) in OWN {
        if let Some(place) = place_at(section.table, path) {
            let problem = Problem::new(format!("`set.{path}` cannot be set: it is the regime's own"));
            problems.push(problem.at(place).label("not below [set]").help(help));
        }
    }
    let mut settings = Vec::new();
    assignments(section.table, "", &mut settings);
    Some(settings)
}

/// Returns the place of the key at exactly this path.
fn place_at<'t>(table: &'t TableNode, path: &str) -> Option<&'t TomlLocation> {
    match path.split_once('.') {
        Some((first, rest)) => place_at(table.table(first)?, rest),
        None => table.entry(path).map(|entry| &entry.key_place),
    }
}

/// Every value below a table, as `--set` takes it.
fn assignments(table: &TableNode, before: &str, out: &mut Vec<String>) {
    for TableEntry { key, node, .. } in &table.entries {
        match &node.value {
            NodeValue::Table(inner) if !inner.entries.is_empty() => {
                assignments(inner, &format!("{before}{key}."), out);
            }
            value => out.push(format!("{before}{key}={}", value.to_toml())),
        }
    }
}

/// Returns the track, as TOML in one value; files are named by their whole paths. And its center line.
fn track(top: &CaseSection<'_>, source: &str, problems: &mut Problems) -> Option<(String, CenterLine)> {
    let help = "write [track] on a line of its own, and below it the keys of a track file";
    top.require("track", help, problems)?;
    let section = top.section("track", problems)?;
    let folder = Path::new(source).parent().unwrap_or(Path::new(""));
    let line = match section.table.entry("file") {
        Some(entry) => {
            section.allow_in(&["file"], &[], "a track that is a file", problems);
            let (file, _) = section.text("file", problems)?;
            match TrackFile::read(&folder.join(file)) {
                Ok(own) => own.track.center_line,
                Err(error) => {
                    let own = error.into_problems();
                    problems.append(own.map(|problem| match problem.line_and_column() {
                        Some(_) => problem,
                        None => problem.at(&entry.node.place).label("this file"),
                    }));
                    return None;
                }
            }
        }
        None => {
            of_section(&section, Tables::anywhere(folder), problems)?
                .track
                .center_line
        }
    };
    let mut track = section.table.clone();
    for entry in &mut track.entries {
        name_whole(entry, folder);
    }
    Some((NodeValue::Table(track).to_toml(), line))
}

/// Names a file by its whole path: a case looks for files from its own folder.
fn name_whole(entry: &mut TableEntry, folder: &Path) {
    match &mut entry.node.value {
        NodeValue::Text(file) if matches!(entry.key.as_str(), "file" | "table") => {
            if let Ok(whole) = absolute(folder.join(&*file)) {
                *file = whole.display().to_string();
            }
        }
        NodeValue::Table(inner) => inner.entries.iter_mut().for_each(|own| name_whole(own, folder)),
        NodeValue::List(items) => {
            for item in items {
                if let NodeValue::Table(inner) = &mut item.value {
                    inner.entries.iter_mut().for_each(|own| name_whole(own, folder));
                }
            }
        }
        _ => {}
    }
}
