//! The explorer's server, asked without a browser.

#![allow(clippy::unwrap_used)]

mod common;
mod issue_029_random;
mod issue_029_safety;
mod issue_036_open;

use std::fs;
use std::net::TcpStream;
use std::path::Path;
use std::process::Command;
use std::thread;

use common::{Server, endless, post, temporary};
use serde_json::{Value, json};

/// Returns the folder that `wedgelab run` writes.
fn run(folder: &Path, case: &str, set: &[(&str, &str)]) -> std::path::PathBuf {
    let out = folder.join("run");
    let mut command = Command::new(env!("CARGO_BIN_EXE_wedgelab"));
    command
        .current_dir(folder)
        .args(["run", case, "--quiet", "--force", "--out"])
        .arg(&out);
    for (path, text) in set {
        command.args(["--set", &format!("{path}={text}")]);
    }
    assert!(command.output().unwrap().status.success());
    out
}

fn summary(folder: &Path) -> Value {
    serde_json::from_slice(&fs::read(folder.join("summary.json")).unwrap()).unwrap()
}

fn fields(answer: &Value) -> Vec<Value> {
    let sections = answer["sections"].as_array().unwrap();
    sections
        .iter()
        .flat_map(|section| section["fields"].as_array().unwrap().clone())
        .collect()
}

#[test]
fn energies_are_those_of_the_command_line() {
    let folder = temporary();
    let server = Server::start(folder.path(), &["vdrun_toe_0_psi_0.012"]);
    let changes: [&[(&str, &str)]; 4] = [
        &[],
        &[("friction.column", "0.3")],
        &[("wedge.angle", "35 deg"), ("side_frame.toe", "0.1 deg in")],
        // A change of the damping changes what the case leaves out.
        &[
            ("wedge.damping", "constant"),
            ("bolster.vertical.amplitude", "0.75 in"),
        ],
    ];
    let mut seen = Vec::new();
    for set in changes {
        let wanted: serde_json::Map<String, Value> = set
            .iter()
            .map(|(path, text)| ((*path).to_owned(), json!(text)))
            .collect();
        let answer = server.post("/api/run", &json!({ "set": wanted }));
        assert_eq!(answer.status, 200, "{}", answer.text());
        let answer = answer.json();
        assert_eq!(answer["schema"], "wedgelab.explore/1");
        assert_eq!(answer["view"]["schema"], "wedgelab.view/1");
        let energy = &answer["summary"]["averages"]["energy_per_cycle"];
        let run_folder = run(folder.path(), "vdrun_toe_0_psi_0.012", set);
        assert_eq!(
            *energy,
            summary(&run_folder)["averages"]["energy_per_cycle"],
            "{set:?}"
        );
        assert!(energy["side_frame"]["value"].as_f64().unwrap() > 0.0);
        assert!(!seen.contains(energy), "{set:?} changes the energy");
        seen.push(energy.clone());
        for (path, text) in set {
            let field = fields(&answer)
                .into_iter()
                .find(|field| field["path"] == *path)
                .unwrap();
            assert_eq!(field["text"], *text);
        }
    }
}

#[test]
fn a_case_file_is_explored_and_kept() {
    let folder = temporary();
    let text = "name = \"mine\"\n[wedge]\ndamping = \"constant\"\n[simulation]\nduration = \"7 s\"\n";
    fs::write(folder.path().join("my.toml"), text).unwrap();
    let server = Server::start(folder.path(), &["my.toml"]);
    let opening = server.get("/api/case").json();
    assert_eq!(
        (&opening["preset"], &opening["name"]),
        (&Value::Null, &json!("mine"))
    );
    assert!(opening["presets"].as_array().unwrap().len() > 3);
    let set = [("friction.slope", "0.25")];
    let wanted = json!({ "set": { "friction.slope": "0.25" } });
    let run_folder = run(folder.path(), "my.toml", &set);
    for file in ["case.toml", "result.csv", "result.mat", "summary.json"] {
        let kept = server.post(&format!("/api/export/{file}"), &wanted);
        assert_eq!(kept.status, 200, "{file}");
        assert!(
            kept.head.contains(&format!("filename=\"mine_{file}\"")),
            "{}",
            kept.head
        );
        let written = fs::read(run_folder.join(file)).unwrap();
        assert_eq!(kept.body, written, "{file}");
    }
    let other = server.post("/api/export/passwords", &wanted);
    assert_eq!(other.status, 404);
    // Another case is a click away.
    let preset = server.post("/api/run", &json!({ "preset": "vdrun_toe_0_psi_0", "set": {} }));
    assert_eq!(preset.json()["summary"]["name"], "vdrun_toe_0_psi_0");
}

/// A car is explored as a wedge is: its curve over the distance, the energy of its wedges and its files are
/// those of the command line; a run that is too long is refused at the field that makes it so.
#[test]
fn a_car_is_explored_and_kept() {
    let folder = temporary();
    let name = "car_pitch_and_bounce_loaded";
    let server = Server::start(folder.path(), &[name]);
    assert_eq!(server.get("/api/case").json()["preset"], name);
    let set = [
        ("simulation.duration", "0.1 s"),
        ("speed.value", "40 mph"),
        ("start.settle", "0 s"),
        ("start.kind", "equilibrium"),
    ];
    let wanted: serde_json::Map<String, Value> = set
        .iter()
        .map(|(path, text)| ((*path).to_owned(), json!(text)))
        .collect();
    let answer = server.post("/api/run", &json!({ "set": wanted.clone() })).json();
    let shown = &answer["loop"];
    assert_eq!(
        (&shown["x"]["column"], &shown["y"]["column"], &shown["energy_per"]),
        (&json!("distance"), &json!("axle_1_left_vertical"), &json!("run"))
    );
    let run_view = &answer["view"]["runs"][0];
    assert!(
        run_view["scene"]["follow"] == "car_body" && run_view["columns"]["axle_1_left_vertical"].is_object()
    );
    let run_folder = run(folder.path(), name, &set);
    let losses = summary(&run_folder)["wedge_losses"].as_object().unwrap().clone();
    let sum: f64 = losses.values().map(|loss| loss["value"].as_f64().unwrap()).sum();
    // lbf·in, in J.
    let energy = shown["energy"].as_f64().unwrap() / 0.112_984_829_027_616_7;
    assert!(
        losses.len() == 8 && (energy - sum).abs() <= 1e-12 * sum.abs(),
        "{energy} {sum}"
    );
    for file in ["case.toml", "result.parquet", "summary.json"] {
        let kept = server.post(&format!("/api/export/{file}"), &json!({ "set": wanted.clone() }));
        assert_eq!(kept.status, 200, "{file}");
        assert_eq!(kept.body, fs::read(run_folder.join(file)).unwrap(), "{file}");
    }
    for (path, text, word) in [
        ("simulation.duration", "61 s", "the most here"),
        ("wheels.friction", "-0.1", "wheels.friction"),
        ("truck.wedge.angle", "95 deg", "between 0 deg and 90 deg"),
    ] {
        // So slow that it does not reach the end of its track.
        let set = json!({ path: text, "speed.value": "5 mph" });
        let answer = server.post("/api/run", &json!({ "set": set }));
        assert_eq!(answer.status, 422, "{path}");
        let errors = answer.json()["errors"].clone();
        assert_eq!(errors[0]["path"], path, "{errors}");
        assert!(errors[0]["message"].as_str().unwrap().contains(word), "{errors}");
    }
}

/// A truck is explored as a wedge is: its loop, its energy and its files are those of the command line; from
/// a wedge a truck is a click away, and back.
#[test]
fn a_truck_is_explored_and_kept() {
    let folder = temporary();
    let name = "truck_warp_nest_constant_rising";
    let server = Server::start(folder.path(), &[name]);
    let opening = server.get("/api/case").json();
    assert_eq!(opening["preset"], name);
    let set = [
        ("truck.condition", "mu_0.25"),
        ("wedge.leading_left.toe", "0.1 deg out"),
    ];
    let wanted: serde_json::Map<String, Value> = set
        .iter()
        .map(|(path, text)| ((*path).to_owned(), json!(text)))
        .collect();
    let answer = server.post("/api/run", &json!({ "set": wanted.clone() })).json();
    let shown = &answer["loop"];
    assert_eq!(
        (&shown["x"]["column"], &shown["y"]["column"], &shown["missing"]),
        (&json!("warp_angle"), &json!("warp_moment"), &json!(""))
    );
    let columns = answer["view"]["runs"][0]["columns"].as_object().unwrap();
    assert!(columns.contains_key("warp_angle") && columns.contains_key("warp_moment"));
    let run_folder = run(folder.path(), name, &set);
    let losses = summary(&run_folder)["cycles"]["losses"]
        .as_object()
        .unwrap()
        .clone();
    let of_wedges = losses.iter().filter(|(name, _)| {
        ["leading_", "trailing_"].iter().any(|end| name.starts_with(end)) && !name.contains("wheelset")
    });
    let sum: f64 = of_wedges.map(|(_, loss)| loss["value"].as_f64().unwrap()).sum();
    // lbf·in, in J.
    let energy = shown["energy"].as_f64().unwrap() / 0.112_984_829_027_616_7;
    assert!(sum > 1e3 && (energy / sum - 1.0).abs() < 1e-12, "{energy} {sum}");
    for (path, text) in set {
        let field = fields(&answer)
            .into_iter()
            .find(|field| field["path"] == *path)
            .unwrap();
        assert_eq!(field["text"], *text);
    }
    for file in ["case.toml", "result.csv", "result.mat", "summary.json"] {
        let kept = server.post(&format!("/api/export/{file}"), &json!({ "set": wanted.clone() }));
        assert_eq!(kept.status, 200, "{file}");
        assert_eq!(kept.body, fs::read(run_folder.join(file)).unwrap(), "{file}");
    }
    for (preset, y) in [
        ("vdrun_toe_0_psi_0", "vertical_wedge_force"),
        ("truck_vertical_constant", "left_nest_vertical_force"),
        ("truck_roll_variable", "bolster_roll_moment"),
    ] {
        let answer = server
            .post("/api/run", &json!({ "preset": preset, "set": {} }))
            .json();
        assert_eq!(answer["summary"]["name"], preset);
        assert_eq!(answer["loop"]["y"]["column"], y, "{preset}");
        let columns = answer["view"]["runs"][0]["columns"].as_object().unwrap();
        assert!(columns.contains_key(y), "{preset}");
    }
    for (path, text, word) in [
        ("wedge.angle", "95 deg", "between 0 deg and 90 deg"),
        ("wedge.leading_left.kind", "heavy", "massless"),
        ("gib.clearance", "3 lbf", "a length is expected"),
        ("simulation.output_interval", "1e-3 s", "20001 rows"),
    ] {
        let answer = server.post("/api/run", &json!({ "set": { path: text } }));
        assert_eq!(answer.status, 422, "{path}={text}");
        let answer = answer.json();
        assert!(answer.to_string().contains(word), "{word} is not in {answer}");
        assert_eq!(answer["errors"][0]["path"], path, "{answer}");
    }
}

#[test]
fn mistakes_are_reported_where_they_were_typed() {
    let folder = temporary();
    let server = Server::start(folder.path(), &[]);
    for (path, text, word) in [
        ("wedge.angle", "32 in", "deg"),
        ("wedge.angle", "95 deg", "between 0 deg and 90 deg"),
        ("wedge.weight", "50", "50 lbf"),
        ("friction.column", "-0.1", "between 0 and 10"),
        ("friction.law", "tahn", "tanh"),
        (
            "wedge.inertia",
            "[\"1 lb in^2\", \"2 in\", \"3 lb in^2\"]",
            "inertia",
        ),
        ("bolster.vertical", "{ shape = \"triangle\" }", "amplitude"),
        ("wedge.colour", "red", "colour"),
        ("wedge.height", "", "missing"),
        ("simulation.output_interval", "20 s", "longer"),
        ("simulation.duration", "0.001 s", "longer"),
    ] {
        let answer = server.post("/api/run", &json!({ "set": { path: text } }));
        assert_eq!(answer.status, 422, "{path}={text}");
        let answer = answer.json();
        let errors = answer["errors"].as_array().unwrap();
        let all = answer.to_string();
        assert!(all.contains(word), "{word} is not in {all}");
        let place = errors[0]["path"].as_str().unwrap();
        assert!(place == path || place == "simulation.output_interval", "{all}");
    }
    // Two at a time, each at its field.
    let answer = server.post(
        "/api/run",
        &json!({ "set": { "wedge.angle": "32", "friction.slope": "rough" } }),
    );
    let answer = answer.json();
    let mut places: Vec<&str> = answer["errors"]
        .as_array()
        .unwrap()
        .iter()
        .map(|error| error["path"].as_str().unwrap())
        .collect();
    places.sort_unstable();
    assert_eq!(places, ["friction.slope", "wedge.angle"]);
    // What is no request at all.
    assert_eq!(server.post("/api/run", &json!({ "sets": {} })).status, 422);
    assert_eq!(server.post("/api/run", &json!(3)).status, 422);
    let authorization = server.authorization();
    let text = [
        ("Host", server.host.as_str()),
        ("Content-Type", "text/plain"),
        ("Authorization", &authorization),
    ];
    assert_eq!(server.send("POST", "/api/run", &text, "{}").status, 415);
    let unknown = server.post("/api/run", &json!({ "preset": "nothing", "set": {} }));
    assert_eq!(unknown.status, 422);
}

#[test]
fn only_its_own_page_is_answered() {
    let folder = temporary();
    let server = Server::start(folder.path(), &[]);
    let host = server.host.as_str();
    let port = host.rsplit(':').next().unwrap();
    assert_eq!(host, format!("127.0.0.1:{port}"));
    let local = format!("localhost:{port}");
    let evil = format!("evil.example:{port}");
    let origin = format!("http://{host}");
    let authorization = server.authorization();
    let get = |headers: &[(&str, &str)]| {
        let all: Vec<_> = headers
            .iter()
            .copied()
            .chain([("Authorization", authorization.as_str())])
            .collect();
        server.send("GET", "/api/case", &all, "").status
    };
    assert_eq!(get(&[("Host", host)]), 200);
    assert_eq!(get(&[("Host", &local)]), 200);
    assert_eq!(get(&[("Host", host), ("Origin", &origin)]), 200);
    assert_eq!(get(&[("Host", &evil)]), 403);
    assert_eq!(get(&[("Host", "127.0.0.1")]), 403);
    assert_eq!(get(&[("Host", host), ("Origin", "http://evil.example")]), 403);
    assert_eq!(get(&[("Host", host), ("Origin", "null")]), 403);
    assert_eq!(get(&[("Host", host), ("Sec-Fetch-Site", "cross-site")]), 403);
    for path in [
        "/",
        "/explorer.js",
        "/api/run",
        "/api/export/case.toml",
        "/nothing",
    ] {
        let refused = server.send(
            "POST",
            path,
            &[("Host", &evil), ("Content-Type", "application/json")],
            "{}",
        );
        assert_eq!(refused.status, 403, "{path}");
        assert!(refused.text().contains("Refused"), "{}", refused.text());
    }
    let page = server.get("/");
    assert!(page.status == 200 && page.text().contains("/explorer.js"));
    assert_eq!(server.get("/explorer.js").status, 200);
    assert!(page.head.contains("content-security-policy"));
}

#[test]
fn a_second_run_replaces_the_first() {
    let folder = temporary();
    let server = Server::start(folder.path(), &[]);
    let (host, authorization) = (server.host.clone(), server.authorization());
    let first = thread::spawn(move || post(&host, &authorization, "/api/run", &endless().to_string()));
    server.computes();
    assert!(!first.is_finished());
    assert_eq!(server.post("/api/run", &json!({ "set": {} })).status, 200);
    let first = first.join().unwrap();
    assert_eq!((first.status, &first.json()["replaced"]), (409, &json!(true)));
}

#[cfg(unix)]
#[test]
fn it_stops_cleanly_even_while_it_runs() {
    let folder = temporary();
    for signal in ["-TERM", "-INT"] {
        let mut server = Server::start(folder.path(), &[]);
        let (host, authorization) = (server.host.clone(), server.authorization());
        let running = thread::spawn(move || post(&host, &authorization, "/api/run", &endless().to_string()));
        // A connection on which nothing is ever said must not hold it.
        let _idle = TcpStream::connect(&server.host).unwrap();
        server.computes();
        assert_eq!(server.end(signal), Some(0), "{signal}");
        assert_eq!(running.join().unwrap().status, 409);
        assert!(TcpStream::connect(&server.host).is_err());
    }
}

#[test]
fn what_cannot_be_served_is_refused() {
    let folder = temporary();
    let output = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
            .current_dir(folder.path())
            .arg("explore")
            .args(arguments)
            .output()
            .unwrap();
        (output.status.code(), String::from_utf8(output.stderr).unwrap())
    };
    let (code, message) = output(&["vdrun_toe_0_psi_1"]);
    assert_eq!(code, Some(2));
    assert!(message.contains("did you mean"), "{message}");
    let server = Server::start(folder.path(), &[]);
    let (code, message) = output(&["--port", server.host.rsplit(':').next().unwrap()]);
    assert_eq!(code, Some(1));
    assert!(
        message.contains("cannot listen") && message.contains("--port"),
        "{message}"
    );
}
