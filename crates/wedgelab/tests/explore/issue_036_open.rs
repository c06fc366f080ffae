//! `--open`: a browser is called with a file that leads to the page and that nobody else may read.
#![cfg(unix)]

use std::fs;
use std::io::{BufRead, BufReader};
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

fn start(folder: &Path, browser: &Path) -> (Child, String) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_wedgelab"))
        .current_dir(folder)
        .args(["explore", "--open"])
        .env("BROWSER", browser)
        .env("TMPDIR", folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap())
        .read_line(&mut line)
        .unwrap();
    (child, line)
}

fn end(mut child: Child) -> String {
    let killed = Command::new("kill")
        .arg("-TERM")
        .arg(child.id().to_string())
        .status();
    assert!(killed.unwrap().success());
    let err = std::io::read_to_string(child.stderr.take().unwrap()).unwrap();
    child.wait().unwrap();
    err
}

#[test]
fn issue_036_a_browser_is_called_with_a_file_that_leads_to_the_page() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let (browser, called) = (path.join("browser"), path.join("called"));
    // Notes with what it was called, with which rights of the file, and what stands in it.
    let script = format!(
        "#!/bin/sh\n{{ echo \"$1\"; stat -c %a \"$1\" 2>/dev/null || stat -f %Lp \"$1\"; cat \"$1\"; }} > \
         {0}.part\nmv {0}.part {0}\n",
        called.display()
    );
    fs::write(&browser, script).unwrap();
    fs::set_permissions(&browser, fs::Permissions::from_mode(0o755)).unwrap();
    let (child, line) = start(path, &browser);
    let started = Instant::now();
    while !called.exists() {
        assert!(
            started.elapsed() < Duration::from_secs(60),
            "no browser was called"
        );
        std::thread::sleep(Duration::from_millis(20));
    }
    let said = fs::read_to_string(&called).unwrap();
    let mut lines = said.lines();
    let file = lines.next().unwrap().to_owned();
    let address = line.split_whitespace().nth(1).unwrap();
    let token = address.split("token=").nth(1).unwrap();
    assert!(
        !file.contains(token),
        "the secret is in what the browser is called with: {file}"
    );
    assert_eq!(lines.next(), Some("600"));
    assert!(said.contains(&format!("url={address}")), "{said}");
    end(child);
    assert!(!Path::new(&file).exists(), "the file is left behind");
}

#[test]
fn input_issue_036_without_a_browser_the_address_is_what_there_is() {
    let folder = tempfile::tempdir().unwrap();
    let (mut child, line) = start(folder.path(), Path::new("/there/is/none"));
    assert!(line.contains("http://127.0.0.1:"), "{line}");
    let mut err = String::new();
    let mut shown = BufReader::new(child.stderr.take().unwrap());
    while !err.contains("open the address yourself") {
        assert!(shown.read_line(&mut err).unwrap() > 0, "{err}");
    }
    assert!(err.contains("no browser can be called"), "{err}");
    child.kill().unwrap();
    child.wait().unwrap();
}
