//! A server under test, and what it answers.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::Path;
use std::process::{Child, Command, Stdio};
#[cfg(unix)]
use std::thread;
use std::time::Duration;
#[cfg(unix)]
use std::time::Instant;

use serde_json::{Value, json};
use tempfile::TempDir;

/// No answer takes so long.
pub const LONG: Duration = Duration::from_secs(60);

/// A server, ended with the test.
pub struct Server {
    pub child: Child,
    pub host: String,
    /// The secret of its address.
    pub token: String,
}

pub struct Answer {
    pub status: u16,
    pub head: String,
    pub body: Vec<u8>,
}

impl Answer {
    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap()
    }

    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }
}

impl Server {
    pub fn start(folder: &Path, arguments: &[&str]) -> Self {
        Self::start_with(folder, arguments, Stdio::null())
    }

    pub fn start_with(folder: &Path, arguments: &[&str], err: Stdio) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
            .current_dir(folder)
            .arg("explore")
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(err)
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap())
            .read_line(&mut line)
            .unwrap();
        let address = line.split("http://").nth(1).unwrap().split(' ').next().unwrap();
        let (host, token) = address.split_once("/?token=").unwrap();
        Self {
            child,
            host: host.to_owned(),
            token: token.to_owned(),
        }
    }

    /// Returns a request with these headers only.
    pub fn send(&self, method: &str, path: &str, headers: &[(&str, &str)], body: &str) -> Answer {
        ask(&self.host, method, path, headers, body)
    }

    /// Returns the authorization that the page sends.
    pub fn authorization(&self) -> String {
        format!("Bearer {}", self.token)
    }

    /// Asks as the page does.
    pub fn get(&self, path: &str) -> Answer {
        let authorization = self.authorization();
        self.send(
            "GET",
            path,
            &[("Host", &self.host), ("Authorization", &authorization)],
            "",
        )
    }

    /// Asks as the page does.
    pub fn post(&self, path: &str, body: &Value) -> Answer {
        self.post_text(path, &body.to_string())
    }

    /// As [`Server::post`], with any text as body.
    pub fn post_text(&self, path: &str, body: &str) -> Answer {
        post(&self.host, &self.authorization(), path, body)
    }

    /// Waits until it computes: until it has taken a quarter of a second of processor time from now on.
    #[cfg(target_os = "linux")]
    pub fn computes(&self) {
        let (started, start) = (Instant::now(), ticks(self.child.id()));
        while ticks(self.child.id()) < start + 25 {
            assert!(started.elapsed() < LONG, "it does not begin");
            thread::sleep(Duration::from_millis(20));
        }
    }

    /// Waits until it computes, on a machine that is not too slow.
    #[cfg(not(target_os = "linux"))]
    pub fn computes(&self) {
        std::thread::sleep(Duration::from_secs(2));
    }

    /// Ends it with a signal; gives the exit code.
    #[cfg(unix)]
    pub fn end(&mut self, signal: &str) -> Option<i32> {
        let pid = self.child.id().to_string();
        assert!(
            Command::new("kill")
                .args([signal, &pid])
                .status()
                .unwrap()
                .success()
        );
        let started = Instant::now();
        while started.elapsed() < Duration::from_secs(20) {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status.code();
            }
            thread::sleep(Duration::from_millis(20));
        }
        None
    }
}

/// Ticks of processor time that a process has taken.
#[cfg(target_os = "linux")]
pub fn ticks(pid: u32) -> u64 {
    let text = std::fs::read_to_string(format!("/proc/{pid}/stat")).unwrap();
    let fields: Vec<&str> = text.rsplit_once(')').unwrap().1.split_whitespace().collect();
    fields[11].parse::<u64>().unwrap() + fields[12].parse::<u64>().unwrap()
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub fn post(host: &str, authorization: &str, path: &str, body: &str) -> Answer {
    let headers = [
        ("Host", host),
        ("Content-Type", "application/json"),
        ("Authorization", authorization),
    ];
    ask(host, "POST", path, &headers, body)
}

pub fn ask(host: &str, method: &str, path: &str, headers: &[(&str, &str)], body: &str) -> Answer {
    let mut stream = TcpStream::connect(host).unwrap();
    stream.set_read_timeout(Some(LONG)).unwrap();
    let lines: String = headers
        .iter()
        .map(|(name, value)| format!("{name}: {value}\r\n"))
        .collect();
    let length = body.len();
    let request = format!(
        "{method} {path} HTTP/1.1\r\n{lines}Content-Length: {length}\r\nConnection: close\r\n\r\n{body}"
    );
    stream.write_all(request.as_bytes()).unwrap();
    let mut bytes = Vec::new();
    stream.read_to_end(&mut bytes).unwrap();
    let end = bytes.windows(4).position(|four| four == b"\r\n\r\n").unwrap();
    let head = String::from_utf8(bytes[..end].to_vec()).unwrap();
    Answer {
        status: head.split(' ').nth(1).unwrap().parse().unwrap(),
        head,
        body: bytes[end + 4..].to_vec(),
    }
}

pub fn temporary() -> TempDir {
    tempfile::tempdir().unwrap()
}

/// Returns a run that would take minutes.
pub fn endless() -> Value {
    json!({ "set": { "simulation.duration": "20000 s", "simulation.output_interval": "1 s" } })
}
