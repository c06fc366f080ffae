//! Issue 29: hidden folders of killed programs are removed, those of living ones are not; a program that is
//! told to end leaves none.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError, mpsc};
use std::time::{Duration, SystemTime};

use staging::{FileError, Folder, abandon, remove_left_over};

/// Files are given up for the whole program: one test at a time.
static ALONE: Mutex<()> = Mutex::new(());

fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

/// Returns a hidden folder with half a file in it, and with a lock if wanted.
fn hidden(folder: &Path, name: &str, with_lock: bool) -> Option<File> {
    let hidden = folder.join(name);
    fs::create_dir_all(hidden.join("result")).unwrap();
    fs::write(hidden.join("result/result.csv"), "half").unwrap();
    with_lock.then(|| File::create(hidden.join("lock")).unwrap())
}

#[test]
fn issue_029_leftovers_that_are_nobodys_are_removed() {
    let _alone = alone();
    let temporary = tempfile::tempdir().unwrap();
    let path = temporary.path();
    fs::create_dir(path.join("out")).unwrap();
    // In the destination and beside it.
    for folder in [path.to_owned(), path.join("out")] {
        // Held by a living program.
        let living = hidden(&folder, ".wedgelab-living", true);
        let held = hidden(&folder, ".wedgelab-Living", true).unwrap();
        held.lock().unwrap();
        drop(living);
        hidden(&folder, ".wedgelab-killed", true);
        // Of an earlier version, or made by a living program at this moment.
        hidden(&folder, ".wedgelab-noLock", false);
        fs::create_dir(folder.join(".wedgelab-empty1")).unwrap();
        // None of ours.
        hidden(&folder, ".wedgelab-cache", false);
        hidden(&folder, ".wedgelab-settings", true);
        fs::write(folder.join(".wedgelab-a_file"), "").unwrap();
        fs::write(folder.join(".wedgelab-young1.tmp"), "").unwrap();
        let check = || Folder::check(path.join("out"), &["result.csv"], false).unwrap();
        let removed = remove_left_over([&check()]);
        let gone = [".wedgelab-empty1", ".wedgelab-killed", ".wedgelab-living"];
        assert_eq!(sorted(removed), gone.map(|name| folder.join(name)));
        let kept = [
            ".wedgelab-Living",
            ".wedgelab-a_file",
            ".wedgelab-cache",
            ".wedgelab-noLock",
            ".wedgelab-settings",
            ".wedgelab-young1.tmp",
        ];
        let found = || -> Vec<String> {
            let hidden = names(&folder).into_iter();
            hidden.filter(|name| name.starts_with('.')).collect()
        };
        assert_eq!(found(), kept);
        // Without a lock only what is old.
        for name in [".wedgelab-Living", ".wedgelab-noLock", ".wedgelab-young1.tmp"] {
            age(&folder.join(name));
        }
        let removed = remove_left_over([&check()]);
        let gone = [".wedgelab-noLock", ".wedgelab-young1.tmp"];
        assert_eq!(sorted(removed), gone.map(|name| folder.join(name)));
        drop(held);
        assert_eq!(remove_left_over([&check()]), [folder.join(".wedgelab-Living")]);
        assert_eq!(
            found(),
            [".wedgelab-a_file", ".wedgelab-cache", ".wedgelab-settings"]
        );
        for name in found() {
            let path = folder.join(name);
            let _ = fs::remove_dir_all(&path).or_else(|_| fs::remove_file(&path));
        }
    }
}

fn sorted(mut paths: Vec<PathBuf>) -> Vec<PathBuf> {
    paths.sort();
    paths
}

/// Makes it two days old.
fn age(path: &Path) {
    let time = SystemTime::now() - Duration::from_secs(2 * 24 * 3600);
    File::open(path).unwrap().set_modified(time).unwrap();
}

/// A link with such a name is not followed, and stays.
#[test]
#[cfg(unix)]
fn issue_029_links_are_no_leftovers() {
    let _alone = alone();
    let temporary = tempfile::tempdir().unwrap();
    let path = temporary.path();
    hidden(path, "elsewhere", true);
    std::os::unix::fs::symlink(path.join("elsewhere"), path.join(".wedgelab-linked")).unwrap();
    let folder = Folder::check(path.join("out"), &["a"], false).unwrap();
    assert!(remove_left_over([&folder]).is_empty());
    assert!(path.join("elsewhere/result/result.csv").exists());
}

#[test]
fn issue_029_what_is_given_up_leaves_nothing() {
    let _alone = alone();
    let temporary = tempfile::tempdir().unwrap();
    let path = temporary.path();
    let place = path.join("new/deep/out");
    let folder = Folder::check(&place, &["a", "b"], false).unwrap();
    let (started, is_started) = mpsc::channel();
    let (go_on, goes_on) = mpsc::channel();
    let writer = std::thread::spawn(move || {
        folder.write(|files| {
            files.add("a", |out| out.write_all(b"whole"))?;
            files.add("b", |out| {
                started.send(()).unwrap();
                goes_on.recv().unwrap();
                out.write_all(b"whole")
            })?;
            files.add("c", |out| out.write_all(b"whole"))
        })
    });
    is_started.recv().unwrap();
    let hidden = names(&path.join("new/deep"));
    assert!(
        hidden.len() == 1 && hidden[0].starts_with(".wedgelab-"),
        "{hidden:?}"
    );
    // Not a leftover: this program lives, as another one would see it.
    let other = Folder::check(path.join("new/deep/other"), &["a"], false).unwrap();
    assert!(remove_left_over([&other]).is_empty());
    let abandoned = abandon();
    assert!(names(path).is_empty(), "folders that were made are gone too");
    go_on.send(()).unwrap();
    assert!(names(path).is_empty());
    // The writer waits, as it does until the program has ended.
    std::thread::sleep(Duration::from_millis(50));
    assert!(!writer.is_finished());
    drop(abandoned);
    let error = writer.join().unwrap().unwrap_err();
    assert!(matches!(error, FileError::Write { .. }), "{error}");
    assert!(names(path).is_empty());
    // What is in its place stays.
    let folder = Folder::check(&place, &["a"], false).unwrap();
    folder
        .write(|files| files.add("a", |out| out.write_all(b"whole")))
        .unwrap();
    assert_eq!(abandon().placed(), Some(place.as_path()));
    assert_eq!(names(&place), ["a"]);
}
