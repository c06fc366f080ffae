//! Folders of runs of every model, as `wedgelab report` and `wedgelab compare` read them.

use std::path::Path;
use std::sync::LazyLock;

use report::comparison::{ComparedResult, Comparison};
use report::page::{self, side_by_side};
use report::run_files::RunFiles;
use report::run_folder::RunFolder;
use report::table::ResultTable;
use staging::Folder;
use study::run::Run;

use super::models;
use super::{ReadOutcome, Reader, check_page, in_folder};

/// Folders of runs.
pub const RUN_FOLDERS: Reader = Reader {
    name: "run_folders",
    about: "folders of runs, in one text: a page of them, and a comparison",
    corpus,
    dictionary: &[
        b"=== summary.json\n",
        b"=== result.csv\n",
        b"=== case.toml\n",
        b"=== index.html\n",
        b"wedgelab.summary/2",
        b"wedgelab.car/1",
        b"wedgelab.truck/2",
        b"wedgelab.three_piece_truck/1",
        b"wedgelab.wheelset/1",
        b"null",
        b"{}",
        b"[]",
        b"\"stopped\": null",
        b"\"rows\": 0",
        b"\"units\": \"si\"",
        b"1e308",
        b"-1e308",
        b"\\u0000",
        b"\\u001b",
        b"time_s",
    ],
    read,
};

/// Before the name of each file.
const MARK: &str = "=== ";
/// The markup around the data of a page.
const DATA: [&str; 2] = ["<script type=\"application/json\"", "</script>"];
/// The files that are read.
const FILES: [&str; 4] = ["summary.json", "result.csv", "case.toml", page::FILE_NAME];

/// Returns the files of a folder as one text; of a page the data alone.
fn text_of(folder: &Path) -> String {
    let mut text = String::new();
    for name in FILES {
        let Ok(mut file) = std::fs::read_to_string(folder.join(name)) else {
            continue;
        };
        if let (true, Some(at)) = (name == page::FILE_NAME, file.find(DATA[0])) {
            let length = file[at..].find(DATA[1]).map_or(0, |end| end + DATA[1].len());
            file = format!("<!doctype html>\n<html>{}</html>\n", &file[at..at + length]);
        }
        text += &format!("{MARK}{name}\n{file}");
        if !text.ends_with('\n') {
            text.push('\n');
        }
    }
    text
}

/// Puts the files of a text into a folder.
fn put(text: &str, folder: &Path) -> std::io::Result<()> {
    let text = format!("\n{text}");
    for part in text.split(&format!("\n{MARK}")).skip(1) {
        let (name, content) = part.split_once('\n').unwrap_or((part, ""));
        if FILES.contains(&name) {
            std::fs::write(folder.join(name), format!("{content}\n"))?;
        }
    }
    Ok(())
}

/// Returns the folder of the first rows of a case's run as a text, with its page if one is rendered.
fn folder_of<C: RunFiles>(case: &C, page: impl FnOnce(C::Output) -> Option<String>) -> Option<Vec<u8>> {
    let folder = tempfile::tempdir().ok()?;
    let files = Folder::check(folder.path(), &case.names(&case.output_files()), true).ok()?;
    case.write(&files, &Run::new(case).ok()?.finish(|_| ())).ok()?;
    if let Some(page) = page(Run::new(case).ok()?.finish(|_| ())) {
        std::fs::write(folder.path().join(page::FILE_NAME), page).ok()?;
    }
    Some(text_of(folder.path()).into_bytes())
}

fn corpus() -> Vec<Vec<u8>> {
    let wedge = models::wedge().and_then(|case| {
        folder_of(case, |result| {
            page::wedge_run::render(&(case.clone(), result)).ok()
        })
    });
    let truck = models::truck().and_then(|case| folder_of(case, |_| None));
    let half_truck = models::half_truck().and_then(|case| {
        folder_of(case, |result| {
            page::half_truck_run::render(case, &result, None).ok()
        })
    });
    let car = models::car().and_then(|case| folder_of(case, |_| None));
    let wheelset = models::wheelset().and_then(|case| folder_of(case, |_| None));
    [wedge, truck, half_truck, car, wheelset]
        .into_iter()
        .flatten()
        .collect()
}

/// The run of a wedge beside which others are shown.
static OTHER: LazyLock<Option<RunFolder>> = LazyLock::new(|| {
    let folder = tempfile::tempdir().ok()?;
    let text = models::wedge().and_then(|case| folder_of(case, |_| None))?;
    put(std::str::from_utf8(&text).ok()?, folder.path()).ok()?;
    RunFolder::read(folder.path()).ok()
});

fn read(input: &[u8]) -> ReadOutcome {
    let (Ok(text), Some(other)) = (std::str::from_utf8(input), OTHER.as_ref()) else {
        return ReadOutcome::NO_TEXT;
    };
    in_folder(|folder| match put(text, folder) {
        Ok(()) => reported(folder, other).or(compared(folder, other)),
        Err(_) => ReadOutcome::NO_TEXT,
    })
}

/// What `wedgelab report` does with it.
fn reported(folder: &Path, other: &RunFolder) -> ReadOutcome {
    let run = match RunFolder::read(folder) {
        Ok(run) => run,
        Err(error) => return ReadOutcome::refused(&error),
    };
    for note in &run.notes {
        let _ = ReadOutcome::refused_with(note);
    }
    if let Some(told) = run.summary.shared().outcome().told() {
        let _ = ReadOutcome::refused_with(&told);
    }
    for number in run.key_numbers() {
        assert!(
            !number.value.value.is_nan(),
            "a key number that is none: {}",
            number.what
        );
    }
    for runs in [vec![run.clone()], vec![other.clone(), run]] {
        let links: Vec<String> = runs.iter().map(|_| "../run/".to_owned()).collect();
        check_page(&side_by_side::render(&runs, &links).unwrap_or_default());
    }
    ReadOutcome::ACCEPTED
}

/// What `wedgelab compare` does with it.
fn compared(folder: &Path, other: &RunFolder) -> ReadOutcome {
    let table = match ResultTable::read(folder) {
        Ok(table) => table,
        Err(error) => return ReadOutcome::refused(&error),
    };
    let entry = |label: &str, table: &ResultTable| ComparedResult {
        label: label.to_owned(),
        table: table.clone(),
    };
    let entries = [entry("a", &table), entry("b", &other.table)];
    match Comparison::of(&entries, &[]) {
        Ok(comparison) => {
            for note in &comparison.notes {
                let _ = ReadOutcome::refused_with(note);
            }
            match comparison.figures(&entries) {
                Ok(_) => ReadOutcome::ACCEPTED,
                Err(error) => ReadOutcome::refused(&error),
            }
        }
        Err(error) => ReadOutcome::refused(&error),
    }
}
