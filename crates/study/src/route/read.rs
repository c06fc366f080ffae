//! From the text of a route file to the route, with every mistake shown where it was written.

use std::path::Path;

use input::FileType;
use quantity::Kind;

use super::{Route, RoutePart, WheelWear, car_of};
use crate::car::named;
use crate::case::CaseError;
use crate::case::name;
use crate::case::problem::{Problem, Problems, TomlSource};
use crate::case::section::{CaseSection, Names, Range};
use crate::case::tree::{self, NodeValue, TableNode};
use crate::damage::SERVICE;
use crate::design::{case_source, settings};

const KEYS: [&str; 11] = [
    "name",
    "title",
    "case",
    "miles",
    "kilometers",
    "steps",
    "wheels",
    "set",
    "wedges",
    "tracks",
    "seasons",
];
const WHEELS: Names<WheelWear> = &[
    ("mean", WheelWear::Mean),
    ("each", WheelWear::Each),
    ("none", WheelWear::Nothing),
];
/// Shares may miss 1 by this much, as rounded ones do.
const ROUNDED: f64 = 0.005;

pub(super) fn file(path: &Path) -> Result<Route, CaseError> {
    let types = &[FileType::Study, FileType::Case];
    let text = named::read(
        path,
        "route file",
        types,
        "docs/route.md has a route to begin with",
    )?;
    let folder = path.parent().unwrap_or(Path::new(""));
    self::text(&path.display().to_string(), &text, folder)
}

pub(super) fn text(file: &str, text: &str, folder: &Path) -> Result<Route, CaseError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let failed = |problems| CaseError::new(problems).of("route");
    let tree = tree::parse(&TomlSource::new(file, text)).map_err(failed)?;
    let mut problems = Problems::new();
    let top = CaseSection {
        path: String::new(),
        table: &tree,
        place: None,
    };
    top.allow_in(&KEYS, &[], "a route", &mut problems);
    let given = |key: &str| tree.get(key).is_some();
    let own_name = name::read(&top, name::of_source_or(file, "route"), &mut problems);
    let title = match given("title") {
        true => top.text("title", &mut problems).map_or("", |(text, _)| text),
        false => "",
    };
    let mut service = SERVICE;
    for (key, unit) in [("miles", 1_609.344), ("kilometers", 1e3)] {
        if given(key) {
            let range = Range::Between(1.0, 1e9, "between 1 and 1e9");
            let found = top.number(key, range, "100000", &mut problems);
            service = found.map_or(service, |own| own * unit);
        }
    }
    if given("miles") && given("kilometers") {
        let problem = Problem::new("the service is given twice, in `miles` and in `kilometers`");
        problems.push(problem.help("leave one of them out"));
    }
    let mut steps = 1;
    if given("steps") {
        let range = Range::Between(1.0, 1000.0, "between 1 and 1000");
        let found = top.number("steps", range, "4", &mut problems);
        if found.is_some_and(|own| own.fract() != 0.0) {
            let problem = Problem::new("`steps` is no whole number");
            problems.push(problem.help("write for example steps = 4"));
        }
        steps = found.map_or(steps, |own| own as u32);
    }
    let wheels = match given("wheels") {
        true => top
            .choice("wheels", WHEELS, &mut problems)
            .unwrap_or(WheelWear::Mean),
        false => WheelWear::Mean,
    };
    let wedges = match tree.entry("wedges") {
        Some(_) => top
            .section("wedges", &mut problems)
            .map(|own| wedge_law(&own, &mut problems)),
        None => None,
    };
    let set = match tree.entry("set") {
        Some(_) => top
            .section("set", &mut problems)
            .map_or(Vec::new(), |own| settings(own.table)),
        None => Vec::new(),
    };
    let tracks = parts(&top, "tracks", &mut problems);
    if !given("tracks") {
        let help = "write [tracks.NAME] with a share, and below [tracks.NAME.set] keys of a car's case";
        problems.push(Problem::new("the route has no tracks").help(help));
    }
    let mut seasons = parts(&top, "seasons", &mut problems);
    if seasons.is_empty() {
        seasons.push(RoutePart {
            name: String::new(),
            title: String::new(),
            share: 1.0,
            set: Vec::new(),
        });
    }
    let help = "write case = \"car_tangent_loaded\", or the name of a car's case file beside the route";
    let source = match top.require("case", help, &mut problems) {
        Some(_) => top
            .text("case", &mut problems)
            .and_then(|(case, node)| case_source(case, node, folder, &mut problems)),
        None => None,
    };
    let Some(source) = source.filter(|_| problems.is_empty()) else {
        return Err(failed(problems));
    };
    let route = Route {
        name: own_name.unwrap_or_default(),
        title: title.to_owned(),
        service,
        steps,
        wheels,
        wedges,
        set,
        tracks,
        seasons,
        source,
    };
    car_of(&route.source, &[])?;
    try_parts(&route, &tree)?;
    Ok(route)
}

/// Returns the settings of the law by which wedges wear; what is left out is that of the case.
fn wedge_law(section: &CaseSection<'_>, problems: &mut Problems) -> Vec<String> {
    section.allow(&["coefficient", "hardness", "counterface"], &[], problems);
    let given = |key: &str| section.table.get(key).is_some();
    let mut set = Vec::new();
    for (key, example) in [("coefficient", "1e-4"), ("counterface", "1.0")] {
        if given(key) {
            let found = section.number(key, Range::NotNegative, example, problems);
            set.extend(found.map(|own| format!("damage.wedge_{key}={own:e}")));
        }
    }
    if given("hardness") {
        let found = section.quantity("hardness", Kind::Pressure, Range::Positive, problems);
        set.extend(found.map(|own| format!("damage.wedge_hardness=\"{:e} Pa\"", own.to_si())));
    }
    set
}

/// Tries each track and each season on the car; mistakes are shown in the route.
fn try_parts(route: &Route, tree: &TableNode) -> Result<(), CaseError> {
    let mut problems = Problems::new();
    let mut try_one = |key: &str, set: &[String]| {
        let all = [route.set.as_slice(), set].concat();
        let Err(error) = car_of(&route.source, &all) else {
            return;
        };
        problems.append(error.into_problems().map(|problem| {
            let path = problem.set_path().map(|path| format!("{key}.{path}"));
            let place = path.and_then(|path| tree.place_of(&path)).or(tree.place_of(key));
            match place {
                Some(place) => problem.moved_to(place),
                None => problem,
            }
        }));
    };
    try_one("set", &[]);
    for (kind, all) in [("tracks", &route.tracks), ("seasons", &route.seasons)] {
        for own in all.iter().filter(|own| !own.set.is_empty()) {
            try_one(&format!("{kind}.{}.set", own.name), &own.set);
        }
    }
    match problems.is_empty() {
        true => Ok(()),
        false => Err(CaseError::new(problems).of("route")),
    }
}

/// Reads tracks or seasons; their shares must sum to 1.
fn parts(top: &CaseSection<'_>, key: &str, problems: &mut Problems) -> Vec<RoutePart> {
    if top.table.entry(key).is_none() {
        return Vec::new();
    }
    let Some(section) = top.section(key, problems) else {
        return Vec::new();
    };
    let before = problems.is_empty();
    let mut found = Vec::new();
    for entry in &section.table.entries {
        let path = format!("{key}.{}", entry.key);
        let NodeValue::Table(table) = &entry.node.value else {
            let message = format!("`{path}` is {}", entry.node.value.describe());
            let help = format!("write [{path}] with a share, and below [{path}.set] keys of a car's case");
            let problem = Problem::new(message).at(&entry.node.place);
            problems.push(problem.label("a table is expected").help(help));
            continue;
        };
        if let Some(problem) = name::problem(&entry.key) {
            problems.push(problem.at(&entry.key_place));
        }
        let own = CaseSection {
            path: path.clone(),
            table,
            place: Some(entry.key_place.clone()),
        };
        own.allow(&["title", "share", "set"], &[], problems);
        let title = match table.get("title") {
            Some(_) => own.text("title", problems).map_or("", |(text, _)| text),
            None => "",
        };
        let help = "write for example share = 0.25: of the distance";
        let share = match own.require("share", help, problems) {
            Some(_) => {
                let range = Range::Between(0.0, 1.0, "between 0 and 1");
                own.number("share", range, "0.25", problems)
            }
            None => None,
        };
        let set = match table.entry("set") {
            Some(_) => own
                .section("set", problems)
                .map_or(Vec::new(), |own| settings(own.table)),
            None => Vec::new(),
        };
        found.push(RoutePart {
            name: entry.key.clone(),
            title: title.to_owned(),
            share: share.unwrap_or_default(),
            set,
        });
    }
    let sum: f64 = found.iter().map(|own| own.share).sum();
    if before && problems.is_empty() && (sum - 1.0).abs() > ROUNDED {
        let message = format!("the shares of `{key}` sum to {sum:.4}, not to 1");
        let problem = Problem::new(message).help("they are shares of the distance: give all of it");
        problems.push(match section.place {
            Some(place) => problem.at(&place).label("these"),
            None => problem,
        });
    }
    for own in &mut found {
        own.share /= sum;
    }
    found
}
