//! Full disks, damaged and foreign files: explained, and nothing that was computed is lost.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::Command;
use std::sync::Barrier;

use report::study_folder::{StudyFolder, StudyFolderError};
use study::design::Study;
use tempfile::tempdir;

use crate::common::{Output, SMALL, WHOLE, done, kept, names, output, refused, table, wedgelab};

/// Returns the study in `a`, where no file may grow beyond this many blocks of 512 bytes: as on a full disk
/// they refuse to be written to.
#[cfg(unix)]
fn on_a_full_disk(folder: &Path, blocks: u32) -> Output {
    let limited = format!(
        "trap '' XFSZ; ulimit -f {blocks}; exec '{}' study small.toml --out a --quiet",
        env!("CARGO_BIN_EXE_wedgelab")
    );
    output(Command::new("sh").arg("-c").arg(limited).current_dir(folder))
}

#[test]
#[cfg(unix)]
fn input_a_full_disk_loses_nothing() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    // Begun, without a run.
    done(path, &["study", "small.toml", "--out", "a", "--quiet"]);
    fs::remove_dir_all(path.join("a/parts")).unwrap();
    fs::remove_file(path.join("a/table.parquet")).unwrap();
    let full = on_a_full_disk(path, 8);
    assert_eq!(full.code, Some(1), "{}", full.err);
    for text in [
        "cannot write into",
        "all runs that were written before are kept",
        "goes on",
    ] {
        assert!(full.err.contains(text), "{text:?}: {}", full.err);
    }
    assert!(kept(&path.join("a")) > 2000 && !path.join("a/table.parquet").exists());
    let again = done(path, &["study", "small.toml", "--out", "a"]);
    assert!(again.out.contains("were there before"), "{}", again.out);
    done(path, &["study", "small.toml", "--out", "b", "--quiet"]);
    assert!(table(&path.join("a")) == table(&path.join("b")));
}

/// All runs are there, and the table does not fit any more.
#[test]
#[cfg(unix)]
fn input_a_disk_full_for_the_table_loses_nothing() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    done(path, &["study", "small.toml", "--out", "a", "--quiet"]);
    let whole = table(&path.join("a"));
    // A part has sixteen records and needs less, the table more.
    let full = on_a_full_disk(path, 16);
    assert_eq!(full.code, Some(1), "{}", full.err);
    for text in ["cannot write `a/table.parquet`", "every run is kept", "again"] {
        assert!(full.err.contains(text), "{text:?}: {}", full.err);
    }
    assert!(table(&path.join("a")) == whole, "the table that was there stays");
    fs::remove_file(path.join("a/table.parquet")).unwrap();
    assert_eq!(on_a_full_disk(path, 16).code, Some(1));
    assert!(!path.join("a/table.parquet").exists());
    let again = done(path, &["study", "small.toml", "--out", "a"]);
    assert!(again.out.contains("120 were there before"), "{}", again.out);
    assert!(table(&path.join("a")) == whole);
    assert_eq!(names(&path.join("a")), WHOLE, "nothing is left over");
}

#[test]
fn input_what_cannot_be_read_is_named_and_left_alone() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    done(path, &["study", "small.toml", "--out", "a", "--quiet"]);
    let whole = table(&path.join("a"));
    // The description, cut off in the middle.
    let description = path.join("a/study.json");
    let text = fs::read(&description).unwrap();
    fs::write(&description, &text[..text.len() / 2]).unwrap();
    refused(
        path,
        &["study", "small.toml", "--out", "a"],
        1,
        &["cannot read", "study.json", "nothing was touched"],
    );
    assert_eq!(fs::read(&description).unwrap(), text[..text.len() / 2]);
    // Moved away, as the message says, it is made again, and the runs are found.
    fs::rename(&description, path.join("study.json")).unwrap();
    let again = done(path, &["study", "small.toml", "--out", "a"]);
    assert!(again.out.contains("120 were there before"), "{}", again.out);
    assert_eq!(fs::read(&description).unwrap(), text);
    // A folder in the place of a part cannot be read as a file.
    let part = path.join("a/parts/part-000002");
    fs::rename(&part, path.join("part")).unwrap();
    fs::create_dir(&part).unwrap();
    refused(
        path,
        &["study", "small.toml", "--out", "a"],
        1,
        &["cannot read", "part-000002", "moved away"],
    );
    fs::remove_dir(&part).unwrap();
    let again = done(path, &["study", "small.toml", "--out", "a"]);
    assert!(again.out.contains("104 were there before"), "{}", again.out);
    assert!(table(&path.join("a")) == whole);
}

#[test]
fn input_damaged_parts_are_computed_again_and_foreign_ones_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    done(path, &["study", "small.toml", "--out", "a", "--quiet"]);
    let whole = table(&path.join("a"));
    let part = path.join("a/parts/part-000001");
    let mut bytes = fs::read(&part).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    bytes.truncate(bytes.len() - 3);
    fs::write(&part, &bytes).unwrap();
    let again = wedgelab(path, &["study", "small.toml", "--out", "a"]);
    assert_eq!(again.code, Some(0), "{}", again.err);
    assert!(again.err.contains("cut off or damaged") && again.out.contains("118 were there before"));
    assert!(table(&path.join("a")) == whole);
    // A part of another study.
    fs::write(path.join("other.toml"), SMALL.replace("0.6,", "0.5,")).unwrap();
    done(path, &["study", "other.toml", "--out", "b", "--quiet"]);
    fs::copy(path.join("b/parts/part-000001"), &part).unwrap();
    refused(
        path,
        &["study", "small.toml", "--out", "a"],
        1,
        &["part-000001", "another study", "move this file away"],
    );
    fs::remove_file(&part).unwrap();
    done(path, &["study", "small.toml", "--out", "a", "--quiet"]);
    assert!(table(&path.join("a")) == whole);
}

/// Of programs that begin a study in a folder at once, one works there and the others say so.
#[test]
fn issue_048_studies_begun_at_once_say_that_another_program_works_there() {
    const PROGRAMS: usize = 8;
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    let study = Study::read(&path.join("small.toml")).unwrap();
    for round in 0..40 {
        let (own, together) = (path.join(round.to_string()), Barrier::new(PROGRAMS));
        let begin = || {
            together.wait();
            let opened = StudyFolder::open(&own, &study);
            together.wait();
            opened.map(|_| ())
        };
        let opened: Vec<_> = std::thread::scope(|scope| {
            let programs: Vec<_> = (0..PROGRAMS).map(|_| scope.spawn(begin)).collect();
            programs.into_iter().map(|own| own.join().unwrap()).collect()
        });
        assert_eq!(opened.iter().filter(|own| own.is_ok()).count(), 1);
        for error in opened.into_iter().filter_map(Result::err) {
            assert!(matches!(error, StudyFolderError::Busy { .. }), "{error}");
        }
    }
}

#[test]
fn input_a_folder_in_use_is_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("small.toml"), SMALL).unwrap();
    fs::create_dir(path.join("a")).unwrap();
    let lock = fs::File::create(path.join("a/.lock")).unwrap();
    lock.lock().unwrap();
    refused(
        path,
        &["study", "small.toml", "--out", "a"],
        2,
        &["another program works in"],
    );
    drop(lock);
    fs::File::create(path.join("a/mine.txt"))
        .unwrap()
        .write_all(b"mine")
        .unwrap();
    refused(
        path,
        &["study", "small.toml", "--out", "a"],
        2,
        &["holds no study", "mine.txt"],
    );
}
