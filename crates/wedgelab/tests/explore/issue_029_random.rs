//! Two thousand requests as nobody sensible sends them, to one server.
//!
//! The requests follow from a seed. What they are answered with is counted and printed: `cargo test --release
//! -p wedgelab --test explore issue_029_random -- --nocapture`.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::io::{Read, Write};
use std::net::{Shutdown, TcpStream};
use std::path::Path;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::common::{Server, temporary};
use super::issue_029_safety::SECRET;

/// Number of requests, unless the environment's `WEDGELAB_REQUESTS` asks for more.
const REQUESTS: u32 = 2000;
/// Time that a client waits for an answer before it goes.
const A_WHILE: Duration = Duration::from_millis(400);
/// No client that has gone is held so long.
const PATIENCE: Duration = Duration::from_secs(30);
/// The most memory that the server may have taken at any time, MB.
#[cfg(target_os = "linux")]
const MOST_MEMORY: u64 = 200;

/// Numbers that follow from a seed (SplitMix64).
struct Dice(u64);

impl Dice {
    fn throw(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        (self.throw() % count as u64) as usize
    }

    fn one<'v>(&mut self, of: &[&'v str]) -> &'v str {
        of[self.below(of.len())]
    }
}

const PATHS: &[&str] = &[
    "wedge.angle",
    "wedge.weight",
    "wedge.inertia",
    "wedge.damping",
    "wedge.free_coordinates",
    "control_coil.stiffness",
    "control_coil.table",
    "friction.column",
    "friction.law",
    "side_frame.toe",
    "bolster.vertical",
    "bolster.vertical.amplitude",
    "bolster.vertical.points",
    "bolster.yaw",
    "simulation.duration",
    "simulation.output_interval",
    "simulation.relative_tolerance",
    "simulation.method",
    "name",
    "title",
    "a.b.c",
    "",
    "=",
    "wedge",
    "\n",
];

const FILES: &[&str] = &[
    "own.csv",
    "secret.csv",
    "../outside.csv",
    "link.csv",
    "up/outside.csv",
    "deeper/../own.csv",
    "",
    ".",
    "..",
    "/",
    "/etc/passwd",
    "/dev/zero",
    "/proc/self/environ",
    "/proc/self/mem",
    "pipe",
    "nothing.csv",
    "my.toml",
    "C:/Windows/win.ini",
    "//server/share/table.csv",
    "file:///etc/passwd",
];

/// Returns a value that a reader may stumble over.
fn nasty(dice: &mut Dice) -> String {
    let many = [1, 60, 1000, 20_000, 65_000][dice.below(5)];
    let text = match dice.below(30) {
        0 => format!("\"32 {}deg{}\"", "(".repeat(many / 2), ")".repeat(many / 2)),
        1 => format!("\"32 {}deg\"", "(".repeat(many)),
        2 => format!("32 {}", "(".repeat(many)),
        3 => "[".repeat(many),
        4 => format!("{}{}", "[".repeat(many / 2), "]".repeat(many / 2)),
        5 => "{a=".repeat(many / 3),
        6 => format!("{}1{}", "{a=".repeat(many / 4), "}".repeat(many / 4)),
        7 => format!("{{{}a = 1}}", "a.".repeat(many / 2)),
        8 => format!("[{}]", "1,".repeat(many / 2)),
        9 => format!("[{}]", "{shape=\"sine\"},".repeat(many / 16)),
        10 => "\"".repeat(many),
        11 => "\u{1F41F}\u{0}\u{202E}".repeat(many / 8),
        12 => format!("1{} in", "0".repeat(many)),
        13 => format!("1e{} in", "9".repeat(many)),
        14 => format!("\"1 {}m\"", "m/".repeat(many / 2)),
        15 => format!("\"1 m^{}\"", "9".repeat(many)),
        16 => dice
            .one(&[
                "nan",
                "inf",
                "-inf",
                "\"nan in\"",
                "\"inf deg\"",
                "1e308",
                "\"1e308 in\"",
                "\"-1e308 in\"",
            ])
            .to_owned(),
        17 => dice
            .one(&[
                "\"1e-300 in\"",
                "\"4.9e-324 s\"",
                "-0",
                "\"0 in\"",
                "1e-308",
                "\"1e-8 s\"",
                "\"1e300 s\"",
            ])
            .to_owned(),
        18 => "1\n".repeat(many / 2),
        19 => format!("# {}", "x".repeat(many)),
        20 => "\\u0000\\".repeat(many / 8),
        21 => format!(
            "{{ shape = \"table\", points = [{}] }}",
            "[\"0 s\", \"0 in\"],".repeat(many / 20)
        ),
        22 => format!(
            "{{ shape = \"sine\", amplitude = \"1 in\", frequency = \"1e{} Hz\" }}",
            dice.below(310)
        ),
        23 => format!(
            "[{}]",
            "{shape=\"sine\",amplitude=\"1 mm\",frequency=\"2 Hz\"},".repeat(many / 1000)
        ),
        24..28 => {
            let file = dice.one(FILES);
            match dice.below(3) {
                0 => format!("\"{file}\""),
                1 => format!("{{ shape = \"table\", points = \"{file}\" }}"),
                _ => format!("{{ shape = \"table\", file = \"{file}\" }}"),
            }
        }
        _ => format!(
            "{} {}",
            dice.below(1000) as f64 / 7.0,
            dice.one(&["in", "deg", "lbf", "", "m/s"])
        ),
    };
    text.chars().take(65_000).collect()
}

/// Returns a run that is short.
fn sensible(dice: &mut Dice) -> Value {
    let mut wanted = json!({ "set": {
        "simulation.duration": "0.2 s",
        "simulation.output_interval": "0.01 s",
        "friction.column": format!("0.{}", 1 + dice.below(60)),
    } });
    let more = [
        ("wedge.angle", format!("{} deg", 20 + dice.below(40))),
        (
            "bolster.vertical",
            "{ shape = \"table\", file = \"own.csv\" }".to_owned(),
        ),
        ("bolster.vertical.amplitude", format!("{} in", dice.below(9))),
        ("side_frame.toe", "0.2 deg out".to_owned()),
        ("wedge.damping", "constant".to_owned()),
    ];
    if let Some((path, text)) = more.get(dice.below(12)) {
        wanted["set"][*path] = json!(text);
    }
    if dice.below(4) == 0 {
        wanted["preset"] = json!(dice.one(&["vdrun_toe_0_psi_0", "cdrun_toe_0_psi_0.012", "nothing", ""]));
    }
    wanted
}

/// Returns the bytes of a body, or what is left of them.
fn body(dice: &mut Dice) -> Vec<u8> {
    match dice.below(16) {
        12..16 | 0 | 1 => sensible(dice).to_string().into_bytes(),
        2..5 => {
            let mut wanted = sensible(dice);
            for _ in 0..=dice.below(4) {
                wanted["set"][dice.one(PATHS)] = json!(nasty(dice));
            }
            wanted.to_string().into_bytes()
        }
        5 | 6 => {
            let mut bytes = sensible(dice).to_string().into_bytes();
            for _ in 0..=dice.below(6) {
                let at = dice.below(bytes.len());
                match dice.below(4) {
                    0 => bytes[at] = dice.throw() as u8,
                    1 => bytes.truncate(at + 1),
                    2 => bytes.insert(at, b"{}[]\",:\\0"[dice.below(9)]),
                    _ => drop(bytes.remove(at)),
                }
                if bytes.is_empty() {
                    bytes.push(b'{');
                }
            }
            bytes
        }
        7 => {
            let many = [10, 200, 5000, 250_000][dice.below(4)];
            let open = dice.one(&["[", "{\"a\":", "{\"set\":", "{\"set\":{\"a\":[", "\"", "\\u00"]);
            open.repeat(many / open.len()).into_bytes()
        }
        8 => (0..dice.below(3000)).map(|_| dice.throw() as u8).collect(),
        9 => {
            let size = [0, 1, 2, 100_000, 262_144, 262_145, 1_000_000, 5_000_000][dice.below(8)];
            vec![b" 1{\""[dice.below(4)]; size]
        }
        10 => {
            let set: serde_json::Map<String, Value> = (0..dice.below(400))
                .map(|k| (format!("{}{k}", dice.one(PATHS)), json!(k)))
                .collect();
            json!({ "set": set, "preset": dice.one(PATHS) })
                .to_string()
                .into_bytes()
        }
        _ => json!(dice.one(PATHS)).to_string().into_bytes(),
    }
}

/// Returns a whole request.
fn request(dice: &mut Dice, server: &Server) -> Vec<u8> {
    let rarely = |dice: &mut Dice| dice.below(12) == 0;
    let mut method = "POST";
    let mut path = dice
        .one(&[
            "/api/run",
            "/api/run",
            "/api/run",
            "/api/export/case.toml",
            "/api/export/result.csv",
        ])
        .to_owned();
    if rarely(dice) {
        method = dice.one(&[
            "GET", "HEAD", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", "BREW", "post", "P\u{0}T", "",
        ]);
    }
    if rarely(dice) {
        path = match dice.below(4) {
            0 => format!("/?token={}", server.token),
            1 => format!("/{}", "a/../".repeat(dice.below(5000))),
            2 => format!("/api/export/{}", dice.one(FILES)),
            _ => dice
                .one(&[
                    "/",
                    "/api",
                    "/api/case",
                    "/explorer.js",
                    "/explorer.css",
                    "*",
                    "",
                    "//",
                    "/%00",
                    "/api/export/%2e%2e%2fsecret",
                    "/api/export/..%2f..%2fetc%2fpasswd",
                    "/?token=%ff",
                    "http://evil.example/api/run",
                    "/api/run?x#y",
                    "/\u{e9}",
                ])
                .to_owned(),
        };
    }
    let mut headers = vec![
        format!("Host: {}", server.host),
        format!("Authorization: {}", server.authorization()),
        "Content-Type: application/json".to_owned(),
    ];
    if rarely(dice) {
        headers.remove(dice.below(3));
    }
    if rarely(dice) {
        headers.push(match dice.below(12) {
            0 => format!("X-Long: {}", "a".repeat(dice.below(40_000))),
            1 => "Transfer-Encoding: chunked".to_owned(),
            2 => "Content-Length: 99999999999999999999".to_owned(),
            3 => "Expect: 100-continue".to_owned(),
            4 => "Origin: http://evil.example".to_owned(),
            5 => "Sec-Fetch-Site: cross-site".to_owned(),
            6 => "Host: evil.example".to_owned(),
            7 => "Content-Encoding: gzip".to_owned(),
            8 => "Connection: upgrade\r\nUpgrade: websocket".to_owned(),
            9 => "\u{1}\u{2}: \u{3}".to_owned(),
            10 => "Authorization: Bearer wrong".to_owned(),
            _ => "X: y\r\n".repeat(dice.below(300)),
        });
    }
    let body = body(dice);
    headers.push("Connection: close".to_owned());
    headers.push(format!(
        "Content-Length: {}",
        if rarely(dice) { body.len() / 2 } else { body.len() }
    ));
    let mut text = format!("{method} {path} HTTP/1.1\r\n");
    for header in headers {
        let _ = write!(text, "{header}\r\n");
    }
    text += "\r\n";
    let mut bytes = text.into_bytes();
    bytes.extend(body);
    if dice.below(30) == 0 {
        let at = dice.below(bytes.len());
        bytes[at] = dice.throw() as u8;
    }
    bytes
}

/// Sends it, perhaps not to the end; gives the answer as far as there is one.
fn send(dice: &mut Dice, server: &Server, bytes: &[u8]) -> (&'static str, Vec<u8>) {
    let mut stream = TcpStream::connect(&server.host).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream.set_write_timeout(Some(PATIENCE)).unwrap();
    match dice.below(20) {
        // Cut off while sending.
        0 => {
            let _ = stream.write_all(&bytes[..dice.below(bytes.len())]);
            return ("cut off", Vec::new());
        }
        // Gone before the answer.
        1 => {
            let _ = stream.write_all(bytes);
            std::thread::sleep(Duration::from_millis(dice.below(20) as u64));
            return ("not waited for", Vec::new());
        }
        _ => {}
    }
    // The server may end the connection before it has everything.
    let _ = stream.write_all(bytes);
    let mut answer = Vec::new();
    // Some requests have no end: after a while the client goes, and no answer is due.
    stream.set_read_timeout(Some(A_WHILE)).unwrap();
    if stream.read_to_end(&mut answer).is_err() {
        let _ = stream.shutdown(Shutdown::Write);
        stream.set_read_timeout(Some(PATIENCE)).unwrap();
        let started = Instant::now();
        let _ = stream.read_to_end(&mut answer);
        let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(1000)]);
        assert!(started.elapsed() < PATIENCE, "the server waits for ever: {shown}");
        if answer.is_empty() {
            return ("left after a while", answer);
        }
    }
    ("ended without an answer", answer)
}

fn fill(root: &Path) {
    let case = root.join("case");
    fs::create_dir_all(case.join("deeper")).unwrap();
    let table = "time [s], travel [in]\n0, 0\n3, 1\n6, 0\n100, 0\n";
    fs::write(case.join("own.csv"), table).unwrap();
    fs::write(case.join("secret.csv"), format!("{SECRET}\n")).unwrap();
    fs::write(root.join("outside.csv"), format!("{SECRET}, {SECRET} [s]\n")).unwrap();
    fs::write(case.join("my.toml"), "[simulation]\nduration = \"1 s\"\n").unwrap();
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("../outside.csv", case.join("link.csv")).unwrap();
        std::os::unix::fs::symlink("..", case.join("up")).unwrap();
        let pipe = std::process::Command::new("mkfifo")
            .arg(case.join("pipe"))
            .status();
        assert!(pipe.unwrap().success());
    }
}

/// Memory of a process, MB: the most so far, and now.
#[cfg(target_os = "linux")]
fn memory(pid: u32) -> [u64; 2] {
    let text = fs::read_to_string(format!("/proc/{pid}/status")).unwrap();
    ["VmHWM:", "VmRSS:"].map(|key| {
        let line = text.lines().find_map(|line| line.strip_prefix(key)).unwrap();
        line.trim().trim_end_matches(" kB").parse::<u64>().unwrap() / 1024
    })
}

#[test]
fn issue_029_random_requests_break_nothing() {
    let root = temporary();
    fill(root.path());
    let mut server = Server::start(&root.path().join("case"), &["my.toml"]);
    let motion = "{ shape = \"table\", file = \"own.csv\" }";
    let good = json!({ "set": { "friction.column": "0.3", "bolster.vertical": motion } });
    let energy = |server: &Server| {
        let answer = server.post("/api/run", &good);
        assert_eq!(answer.status, 200, "{}", answer.text());
        let table = server.post("/api/export/result.csv", &good);
        assert_eq!(table.status, 200);
        table.body
    };
    let before = energy(&server);
    let asked = std::env::var("WEDGELAB_REQUESTS").ok();
    let requests = asked.map_or(REQUESTS, |count| count.parse().unwrap());
    let mut dice = Dice(29);
    let mut counts: BTreeMap<String, u32> = BTreeMap::new();
    let mut slowest = Duration::ZERO;
    #[cfg(target_os = "linux")]
    let mut halfway = [0; 2];
    let started = Instant::now();
    for number in 0..requests {
        #[cfg(target_os = "linux")]
        if number == requests / 2 {
            halfway = memory(server.child.id());
        }
        let bytes = request(&mut dice, &server);
        let sent = Instant::now();
        let (how, answer) = send(&mut dice, &server, &bytes);
        slowest = slowest.max(sent.elapsed());
        let shown = || {
            format!(
                "request {number}: {}",
                String::from_utf8_lossy(&bytes[..bytes.len().min(2000)])
            )
        };
        assert_eq!(
            server.child.try_wait().unwrap(),
            None,
            "the server has ended: {}",
            shown()
        );
        let text = String::from_utf8_lossy(&answer);
        let text = text
            .strip_prefix("HTTP/1.1 100 Continue\r\n\r\n")
            .unwrap_or(&text);
        let status = text.strip_prefix("HTTP/1.1 ").and_then(|rest| rest.get(..3));
        if let Some(status) = status {
            assert!(!status.starts_with('5'), "{text} {}", shown());
        }
        assert!(!text.contains(SECRET), "{text} {}", shown());
        assert!(!text.contains(&server.token), "{text} {}", shown());
        *counts.entry(status.unwrap_or(how).to_owned()).or_default() += 1;
    }
    let took = started.elapsed();
    #[cfg(target_os = "linux")]
    let memories = [memory(server.child.id()), halfway];
    assert_eq!(energy(&server), before);
    println!(
        "{requests} requests in {:.1} s, the slowest {:.2} s: {counts:?}",
        took.as_secs_f64(),
        slowest.as_secs_f64()
    );
    assert!(
        counts["200"] > requests / 20 && counts["422"] > requests / 20 && counts["403"] > 20,
        "{counts:?}"
    );
    #[cfg(target_os = "linux")]
    {
        let [[most, now], [most_before, before]] = memories;
        println!("memory: {most} MB at most, {now} MB at the end; halfway {most_before} MB and {before} MB");
        assert!(most < MOST_MEMORY, "{most} MB");
        // Four threads whose stacks have been used once keep what they used.
        assert!(now < before + 70, "from {before} MB to {now} MB");
    }
}
