//! `wedgelab report`, as a user calls it: pages of runs that others have made.

use crate::common;
use std::fs;
use std::path::Path;

use serde_json::Value;

use common::{done, wedgelab};

const WEDGE: &str = "cdrun_toe_out_0.2_psi_0.012";
const TRUCK: &str = "truck_vertical_variable";
const CAR: &str = "car_twist_and_roll_loaded";

/// Runs a case for a short time.
fn run(folder: &Path, case: &str, seconds: &str, more: &[&str], out: &str) {
    let duration = format!("simulation.duration='{seconds} s'");
    let mut arguments = vec!["run", case, "--quiet", "--out", out, "--set", &duration];
    for value in more {
        arguments.extend(["--set", value]);
    }
    done(folder, &arguments);
}

fn page(folder: &Path) -> String {
    fs::read_to_string(folder.join("index.html")).unwrap()
}

fn json(file: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap()
}

/// Returns the data of a page's interactive part.
fn view(page: &str) -> Value {
    serde_json::from_str(&report::view::kept::data_in(page).unwrap()).unwrap()
}

/// Returns the numbers in the row of a page's table that begins with these words, without what stands in
/// brackets.
fn row(page: &str, words: &str) -> Vec<f64> {
    let start = page
        .find(&format!("<th scope=\"row\">{words}</th>"))
        .unwrap_or_else(|| panic!("{words}"));
    let line = &page[start..start + page[start..].find("</tr>").unwrap()];
    let cells = line.split("<td class=\"number\">").skip(1);
    let number = |cell: &str| {
        let text: String = cell
            .chars()
            .take_while(|sign| !matches!(sign, ' ' | '<'))
            .collect();
        match text.as_str() {
            "–" => f64::NAN,
            text => text.replace('\u{2212}', "-").parse().unwrap(),
        }
    };
    cells.map(number).collect()
}

/// Four digits of the same number.
#[track_caller]
fn near(found: f64, expected: f64) {
    let size = expected.abs().max(1e-12);
    assert!(
        (found - expected).abs() <= 6e-4 * size,
        "{found} is not {expected}"
    );
}

#[track_caller]
fn refused(folder: &Path, arguments: &[&str], texts: &[&str]) {
    let output = wedgelab(folder, &[&["report"], arguments].concat());
    assert_eq!(output.code, Some(2), "{arguments:?}: {}", output.err);
    for text in texts {
        assert!(output.err.contains(text), "{text:?} is not in: {}", output.err);
    }
    assert!(!folder.join("report").exists(), "nothing is written");
}

#[test]
fn wedges_stand_side_by_side_with_the_numbers_of_their_summaries() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run(at, WEDGE, "8", &[], "one");
    // The same in SI units, and softer.
    run(
        at,
        WEDGE,
        "8",
        &["friction.column=0.3", "simulation.output_units='si'"],
        "other run",
    );
    let answer = done(at, &["report", "one", "other run", "--json"]);
    let answer: Value = serde_json::from_str(&answer).unwrap();
    assert_eq!(answer["files"][0], "index.html");
    let page = page(&at.join("report"));
    let summaries = ["one", "other run"].map(|name| json(&at.join(name).join("summary.json")));
    let newton = 4.448_221_615_260_5;
    for (words, path, factor) in [
        (
            "mean vertical wedge force, bolster going up",
            "/averages/up/vertical_wedge_force/value",
            newton,
        ),
        (
            "mean vertical wedge force, bolster going down",
            "/averages/down/vertical_wedge_force/value",
            newton,
        ),
        (
            "friction energy at the side frame per cycle",
            "/averages/energy_per_cycle/side_frame/value",
            newton * 0.0254,
        ),
        (
            "equivalent damping of the side-frame friction",
            "/averages/equivalent_damping/value",
            newton / 0.0254,
        ),
    ] {
        let numbers = row(&page, words);
        let own = summaries
            .each_ref()
            .map(|summary| summary.pointer(path).unwrap().as_f64().unwrap());
        assert_eq!(numbers.len(), 2, "{words}");
        near(numbers[0], own[0]);
        near(numbers[1], own[1] / factor);
        let numbers = &answer["runs"][1]["numbers"];
        let numbers = numbers
            .as_array()
            .unwrap()
            .iter()
            .find(|number| number["what"] == words);
        assert_eq!(
            numbers.unwrap()["value"],
            *summaries[1].pointer(path).unwrap(),
            "as written"
        );
    }
    // Largest force: also what the table has.
    let table = fs::read_to_string(at.join("one/result.csv")).unwrap();
    let mut lines = table.lines();
    let place = lines
        .next()
        .unwrap()
        .split(',')
        .position(|name| name == "vertical_wedge_force_lbf");
    let forces = lines.map(|line| {
        line.split(',')
            .nth(place.unwrap())
            .unwrap()
            .parse::<f64>()
            .unwrap()
    });
    near(
        row(&page, "largest vertical wedge force")[0],
        forces.fold(f64::MIN, f64::max),
    );
    // Links lead to the files, over a blank in a name.
    for name in ["../one/result.csv", "../other%20run/summary.json"] {
        assert!(page.contains(&format!("href=\"{name}\"")), "{name}");
    }
    assert!(page.contains("Numbers of all runs are shown in the units of one."));
    // Two digits.
    let ledger = row(&page, "relative residual")[0];
    let own = summaries[0]["ledger"]["largest_relative_residual"]
        .as_f64()
        .unwrap();
    assert!((ledger - own).abs() <= 0.05 * own, "{ledger} is not {own}");
    let view = view(&page);
    let runs = view["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 2);
    assert!(
        runs.iter()
            .all(|run| run["scene"]["bodies"].is_array() && run["loops"].is_array())
    );
    // A page is not overwritten.
    assert_eq!(wedgelab(at, &["report", "one"]).code, Some(2));
    done(at, &["report", "one", "--force"]);
}

#[test]
fn issue_048_the_run_of_a_wedge_has_a_page() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run(at, WEDGE, "8", &[], "one");
    let page = page(&at.join("one"));
    let view = view(&page);
    assert!(view["runs"][0]["scene"]["bodies"].is_array() && view["runs"][0]["loops"].is_array());
    let summary = json(&at.join("one").join("summary.json"));
    let up = summary
        .pointer("/averages/up/vertical_wedge_force/value")
        .unwrap();
    near(
        row(&page, "mean vertical wedge force, bolster going up")[0],
        up.as_f64().unwrap(),
    );
}

#[test]
fn trucks_and_cars_are_read_with_what_their_pages_keep() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run(at, TRUCK, "1", &[], "a");
    // More rows than a page keeps, and an odd number of them.
    let fine = ["truck.condition='worn'", "simulation.output_interval='0.5 ms'"];
    run(at, TRUCK, "0.9995", &fine, "b");
    run(
        at,
        CAR,
        "3",
        &["start.settle='1 s'", "start.kind=equilibrium"],
        "car",
    );
    done(at, &["report", "a", "b", "car", "--out", "all"]);
    let page = page(&at.join("all"));
    for id in [
        "id=\"overlay_nest_loops\"",
        "id=\"overlay_l_over_v\"",
        "id=\"limits\"",
    ] {
        assert!(page.contains(id), "{id}");
    }
    let summary = json(&at.join("car/summary.json"));
    let limit = &summary["limits"][0];
    let words = limit["quantity"].as_str().unwrap();
    near(
        *row(&page, words).last().unwrap(),
        limit["value"].as_f64().unwrap(),
    );
    let truck = json(&at.join("b/summary.json"));
    let largest = ["leading_left", "leading_right", "trailing_left", "trailing_right"]
        .map(|wedge| format!("/extremes/{wedge}_column_normal_lbf/maximum"))
        .map(|path| truck.pointer(&path).unwrap().as_f64().unwrap());
    near(
        row(&page, "largest normal force of a column")[1],
        largest.into_iter().fold(f64::MIN, f64::max),
    );
    let view = view(&page);
    let runs = view["runs"].as_array().unwrap();
    let run = |name: &str| runs.iter().find(|run| run["name"] == name).unwrap();
    assert_eq!(
        run("a")["scene"]["contacts"].as_array().unwrap().len(),
        32,
        "corners"
    );
    assert_eq!(
        run("b")["scene"]["contacts"].as_array().unwrap().len(),
        32,
        "thinned"
    );
    assert!(run("car")["scene"]["track"].is_object(), "the track of the car");
    let lists = view["data"].as_array().unwrap();
    for run in runs {
        let place = |own: &Value| usize::try_from(own.as_u64().unwrap()).unwrap();
        assert!(lists[place(&run["time"])].is_string());
        for column in run["columns"].as_object().unwrap().values() {
            assert!(column.get("data").is_none_or(|own| place(own) < lists.len()));
        }
    }
    // Without its page a truck is made of its table, and a car is not seen.
    for name in ["a", "car"] {
        fs::remove_file(at.join(name).join("index.html")).unwrap();
    }
    done(at, &["report", "a", "car", "--out", "bare"]);
    let bare = self::view(&self::page(&at.join("bare")));
    let runs = bare["runs"].as_array().unwrap();
    let scene = |name: &str| &runs.iter().find(|run| run["name"] == name).unwrap()["scene"];
    assert_eq!(scene("a")["contacts"], serde_json::json!([]));
    assert!(scene("a")["bodies"].is_array());
    assert!(scene("car").is_null());
}

#[test]
fn input_what_is_no_run_is_reported_with_the_command_that_takes_it() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path();
    run(at, WEDGE, "1", &[], "one");
    fs::write(at.join("study.toml"), "case = \"x\"\n[vary]\nwedge.angle = []\n").unwrap();
    fs::write(at.join("table.csv"), "time_s,force_lbf\n0,1\n1,2\n").unwrap();
    fs::create_dir(at.join("empty")).unwrap();
    fs::create_dir(at.join("studied")).unwrap();
    fs::write(at.join("studied/study.json"), "{}").unwrap();
    for (arguments, texts) in [
        (
            vec!["one/case.toml"],
            ["is a case file", "wedgelab run one/case.toml"],
        ),
        (
            vec!["study.toml"],
            ["is a study file", "wedgelab study study.toml"],
        ),
        (
            vec!["table.csv"],
            ["is a table", "`wedgelab compare` and `wedgelab plot`"],
        ),
        (
            vec!["empty"],
            ["holds no result.parquet or result.csv", "name the folder"],
        ),
        (vec!["studied"], ["is the folder of a study", "index.html"]),
        (
            vec![TRUCK],
            ["built-in case", "wedgelab run truck_vertical_variable"],
        ),
        (vec!["on"], ["there is no result `on`", "did you mean one?"]),
        (vec!["one", "./one"], ["named twice", "name each run once"]),
    ] {
        refused(at, &arguments, &texts);
    }
    // The summary alone, damaged, of another version, of another program.
    let file = at.join("one/summary.json");
    let text = fs::read_to_string(&file).unwrap();
    for (from, to, texts) in [
        (
            "wedgelab.summary/2",
            "wedgelab.summary/1",
            [
                "`wedgelab.summary/1`; this version reads `wedgelab.summary/2`",
                "--force` runs the case again",
            ],
        ),
        (
            "wedgelab.summary/2",
            "wedgelab.fit/1",
            ["`wedgelab.fit/1`", "the folder of a run"],
        ),
        ("\"rows\"", "\"lines\"", ["missing field `rows`", "damaged"]),
        ("\"averages\": {", "\"averages\": [", ["line ", "damaged"]),
    ] {
        assert!(text.contains(from), "{from}");
        fs::write(&file, text.replacen(from, to, 1)).unwrap();
        refused(at, &["one"], &texts);
    }
    fs::remove_file(&file).unwrap();
    refused(at, &["one"], &["there is no summary.json", "tables alone"]);
    fs::write(&file, &text).unwrap();
    // What does not fit together is said, on the page too.
    let table = fs::read_to_string(at.join("one/result.csv")).unwrap();
    let shorter: Vec<&str> = table.lines().take(50).collect();
    fs::write(at.join("one/result.csv"), shorter.join("\n")).unwrap();
    let output = wedgelab(at, &["report", "one"]);
    assert_eq!(output.code, Some(0));
    assert!(output.err.contains("they are not of one run"), "{}", output.err);
    assert!(page(&at.join("report")).contains("they are not of one run"));
}
