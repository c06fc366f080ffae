//! Limits of anyone who can reach the server: nothing without the token, and with it nothing that harms the
//! owner.

use std::fs;
use std::io::{Read, Write};
use std::net::TcpStream;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::common::{LONG, Server, endless, temporary, ticks};

/// A text that must not get out.
pub const SECRET: &str = "hunter2";

#[test]
fn issue_029_nobody_is_answered_without_the_token() {
    let folder = temporary();
    let server = Server::start(folder.path(), &[]);
    let host = server.host.as_str();
    assert!(server.token.len() >= 32 && server.token.bytes().all(|byte| byte.is_ascii_hexdigit()));
    let wrong = server.token.replace(|c| c != '0', "1");
    for authorization in [
        None,
        Some(String::new()),
        Some("Bearer".to_owned()),
        Some(format!("Bearer {wrong}")),
        Some(format!("Bearer {}", &server.token[1..])),
        Some(format!("Basic {}", server.token)),
    ] {
        for (method, path) in [
            ("GET", "/"),
            ("GET", "/?token="),
            ("GET", &format!("/?token={wrong}")),
            ("GET", "/api/case"),
            ("GET", &format!("/api/case?token={}", server.token)),
            ("POST", "/api/run"),
            ("POST", "/api/export/result.csv"),
            ("POST", "/api/export/case.toml"),
            ("GET", "/nothing"),
        ] {
            let mut headers = vec![("Host", host), ("Content-Type", "application/json")];
            headers.extend(authorization.as_deref().map(|value| ("Authorization", value)));
            let cookie = format!("token={}", server.token);
            headers.push(("Cookie", &cookie));
            let answer = server.send(method, path, &headers, "{}");
            assert_eq!(answer.status, 403, "{method} {path} {authorization:?}");
            let message = "open the address that `wedgelab explore` printed";
            assert!(answer.text().contains(message), "{}", answer.text());
        }
    }
    // The page is shown to those who have the address.
    let page = server.send("GET", &format!("/?token={}", server.token), &[("Host", host)], "");
    assert_eq!(page.status, 200);
    let script = server.send("GET", "/explorer.js", &[("Host", host)], "");
    assert_eq!(script.status, 200);
    assert_eq!(server.get("/api/case").status, 200);
    let head = page.head.to_ascii_lowercase();
    assert!(
        head.contains("referrer-policy: no-referrer") && head.contains("cache-control: no-store"),
        "{head}"
    );
    assert!(!head.contains("set-cookie"), "cookies are shared by all ports");
}

#[test]
fn issue_029_the_token_is_reported_once() {
    let folder = temporary();
    let mut server = Server::start_with(folder.path(), &[], Stdio::piped());
    let page = format!("/?token={}", server.token);
    let own = [("Host", server.host.as_str())];
    for answer in [
        server.send("GET", &page, &own, ""),
        server.send("GET", &page.replace('/', "/nothing"), &own, ""),
        server.send("POST", &page, &own, ""),
        server.get("/api/case"),
        server.get(&format!("/api/{}", server.token)),
        server.post("/api/run", &json!({ "set": { "simulation.duration": "2 s" } })),
        server.post("/api/run", &json!({ "set": { "wedge.angle": "32" } })),
        server.post("/api/export/summary.json", &json!({})),
    ] {
        let all = format!("{} {}", answer.head, answer.text());
        assert!(!all.contains(&server.token), "{}", answer.head);
    }
    server.child.kill().unwrap();
    let mut err = String::new();
    server
        .child
        .stderr
        .take()
        .unwrap()
        .read_to_string(&mut err)
        .unwrap();
    assert!(!err.contains(&server.token), "{err}");
}

#[test]
fn issue_029_tables_come_from_the_folder_of_the_case_only() {
    let root = temporary();
    let case = root.path().join("case");
    fs::create_dir(&case).unwrap();
    let table = "time [s], travel [in]\n0, 0\n3, 1\n6, 0\n100, 0\n";
    fs::write(case.join("own.csv"), table).unwrap();
    fs::write(root.path().join("other.csv"), table).unwrap();
    fs::write(
        case.join("secret.csv"),
        format!("{SECRET}, {SECRET} [s]\n{SECRET}\n"),
    )
    .unwrap();
    fs::write(case.join("my.toml"), "[simulation]\nduration = \"3 s\"\n").unwrap();
    let absolute = root
        .path()
        .join("other.csv")
        .display()
        .to_string()
        .replace('\\', "/");
    let with = |file: &str| {
        let motion = format!("{{ shape = \"table\", file = \"{file}\" }}");
        json!({ "set": { "bolster.vertical": motion } })
    };
    let message = |answer: &Value| answer["errors"][0]["message"].as_str().unwrap().to_owned();
    let server = Server::start(&case, &["my.toml"]);
    assert_eq!(server.post("/api/run", &with("own.csv")).status, 200);
    for outside in [
        "../other.csv",
        &absolute,
        "/etc/passwd",
        "/dev/zero",
        "../nothing",
    ] {
        for path in ["/api/run", "/api/export/case.toml"] {
            let answer = server.post(path, &with(outside));
            assert_eq!(answer.status, 422, "{outside}");
            let answer = answer.json();
            assert!(
                message(&answer).contains("does not lie in the folder of the case file"),
                "{answer}"
            );
            assert_eq!(answer["errors"][0]["path"], "bolster.vertical");
        }
    }
    let answer = server.post("/api/run", &with("secret.csv"));
    assert_eq!(answer.status, 422);
    assert!(!answer.text().contains(SECRET), "{}", answer.text());
    let refusal = message(&answer.json());
    assert!(
        refusal.contains("secret.csv, line 1, column 1: name [unit] is expected"),
        "{refusal}"
    );
    // A built-in case reads no file, whether it is chosen on the page or in the terminal.
    let mut preset = with("own.csv");
    preset["preset"] = json!("vdrun_toe_0_psi_0");
    let mut truck = with("own.csv");
    truck["preset"] = json!("truck_vertical_variable");
    let terminal = Server::start(&case, &["vdrun_toe_0_psi_0"]);
    for answer in [
        server.post("/api/run", &preset),
        server.post("/api/run", &truck),
        terminal.post("/api/run", &with("own.csv")),
    ] {
        assert_eq!(answer.status, 422);
        assert!(message(&answer.json()).contains("tables in files are not read here"));
    }
    // The case itself is held to the same.
    let text = "[bolster]\nvertical = { shape = \"table\", file = \"../other.csv\" }\n";
    fs::write(case.join("away.toml"), text).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
        .current_dir(&case)
        .args(["explore", "away.toml"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(
        message.contains("does not lie in the folder") && message.contains("copy the table"),
        "{refusal}"
    );
}

#[test]
fn issue_029_rows_bodies_and_changes_are_limited() {
    let folder = temporary();
    let server = Server::start(folder.path(), &[]);
    let set = |path: &str, text: &str| json!({ "set": { path: text } });
    for interval in ["1e-8 s", "1e-6 s", "4.9e-4 s"] {
        let answer = server.post("/api/run", &set("simulation.output_interval", interval));
        assert_eq!(answer.status, 422, "{interval}");
        let mistake = &answer.json()["errors"][0];
        assert_eq!(mistake["path"], "simulation.output_interval");
        let help = mistake["help"].as_str().unwrap();
        if interval == "4.9e-4 s" {
            assert!(
                mistake["message"].as_str().unwrap().contains("20001 rows"),
                "{mistake}"
            );
            assert!(help.contains("0.0005 s"), "{help}");
        }
    }
    let most = server.post("/api/run", &set("simulation.output_interval", "0.0005 s"));
    assert_eq!(
        (most.status, &most.json()["summary"]["rows"]),
        (200, &json!(20_001))
    );
    let long = server.post("/api/run", &set("simulation.duration", "1000 s"));
    assert_eq!(
        (long.status, &long.json()["errors"][0]["path"]),
        (422, &json!("simulation.duration"))
    );
    // Sizes.
    let answer = server.post("/api/run", &set("wedge.angle", &"3".repeat(70_000)));
    assert_eq!(
        (answer.status, answer.text().contains("is too long")),
        (422, true)
    );
    let answer = server.post("/api/run", &set(&"a".repeat(300), "1"));
    assert_eq!(
        (answer.status, answer.text().contains("is too long")),
        (422, true)
    );
    let answer = server.post("/api/run", &json!({ "preset": "a".repeat(300) }));
    assert_eq!(
        (answer.status, answer.text().contains("is too long")),
        (422, true)
    );
    let many: serde_json::Map<String, Value> = (0..300).map(|k| (format!("a{k}"), json!("1"))).collect();
    let answer = server.post("/api/run", &json!({ "set": many }));
    assert_eq!((answer.status, answer.text().contains("too many")), (422, true));
    assert_eq!(server.post("/api/run", &json!({})).status, 200);
    // A case that can never be shown is not begun with.
    fs::write(
        folder.path().join("long.toml"),
        "[simulation]\nduration = \"1000 s\"\n",
    )
    .unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
        .current_dir(folder.path())
        .args(["explore", "long.toml"])
        .output()
        .unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        message.contains("20001 rows") && message.contains("0.05 s"),
        "{message}"
    );
}

#[test]
fn issue_029_results_that_are_not_finite_are_reported() {
    let folder = temporary();
    let server = Server::start(folder.path(), &[]);
    for (path, text) in [
        ("bolster.vertical.amplitude", "1e308 in"),
        ("wedge.height", "1e308 in"),
        ("control_coil.free_length", "1e306 in"),
        ("wedge.weight", "1e308 lbf"),
    ] {
        let wanted = json!({ "set": { path: text, "simulation.duration": "2 s" } });
        let answer = server.post("/api/run", &wanted);
        let body = answer.json();
        // Nothing is shown, or what came before the run stopped.
        match answer.status {
            200 => assert!(body["summary"]["stopped"]["reason"].is_string(), "{path}={text}"),
            422 => assert!(!body["errors"][0]["help"].as_str().unwrap().is_empty(), "{body}"),
            other => panic!("{path}={text}: {other} {}", answer.text()),
        }
        let table = server.post("/api/export/result.csv", &wanted);
        let numbers = !table.text().contains("inf") && !table.text().contains("NaN");
        assert!(table.status != 200 || numbers, "{path}={text}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn issue_029_a_run_ends_when_its_client_goes() {
    let folder = temporary();
    let server = Server::start(folder.path(), &[]);
    let body = endless().to_string();
    let mut stream = TcpStream::connect(&server.host).unwrap();
    let request = format!(
        "POST /api/run HTTP/1.1\r\nHost: {}\r\nAuthorization: {}\r\nContent-Type: application/json\r\n\
         Content-Length: {}\r\n\r\n{body}",
        server.host,
        server.authorization(),
        body.len()
    );
    stream.write_all(request.as_bytes()).unwrap();
    server.computes();
    drop(stream);
    let (pid, started) = (server.child.id(), Instant::now());
    // It rests: no tick in half a second.
    loop {
        let before = ticks(pid);
        std::thread::sleep(Duration::from_millis(500));
        if ticks(pid) == before {
            return;
        }
        assert!(started.elapsed() < LONG, "it goes on without its client");
    }
}
