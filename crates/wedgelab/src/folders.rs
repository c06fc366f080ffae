//! The folders that a command writes into, checked before it computes anything.

use std::fs;
use std::path::{Path, PathBuf};

use staging::{self, Folder};

use crate::failure::{Failure, say};

/// Returns a folder for these files, as [`Folder::check`] has it; tells what killed runs had left beside it
/// and is removed.
pub fn check(path: impl Into<PathBuf>, names: &[&str], force: bool) -> Result<Folder, Failure> {
    let folder = Folder::check(path, names, force).map_err(|error| Failure::Input(error.into()))?;
    tell_removed(&staging::remove_left_over([&folder]));
    Ok(folder)
}

/// As [`check`], for several folders.
pub fn check_all<'n>(
    folders: impl IntoIterator<Item = (PathBuf, &'n [&'n str])>,
    force: bool,
) -> Result<Vec<Folder>, Failure> {
    let folders = staging::check_all(folders, force).map_err(|error| Failure::Input(error.into()))?;
    tell_removed(&staging::remove_left_over(&folders));
    Ok(folders)
}

/// Returns the names of files in a folder with their sizes, and the size of all.
pub fn listed(folder: &Path, names: &[&str]) -> String {
    let sizes: Vec<u64> = names.iter().map(|name| bytes(&folder.join(name))).collect();
    let all: Vec<String> = names
        .iter()
        .zip(&sizes)
        .map(|(name, bytes)| format!("{name} ({})", size(*bytes)))
        .collect();
    format!("{}; {} in all", all.join(", "), size(sizes.iter().sum()))
}

/// Returns the size of a file; zero where it is not there.
pub fn bytes(file: &Path) -> u64 {
    fs::metadata(file).map_or(0, |found| found.len())
}

/// Returns a number of bytes in words, to three digits.
pub fn size(bytes: u64) -> String {
    let [kilo, mega] = [1e3, 1e6].map(|unit| bytes as f64 / unit);
    match bytes {
        0..1_000 => format!("{bytes} bytes"),
        1_000..9_995 => format!("{kilo:.2} kB"),
        9_995..99_950 => format!("{kilo:.1} kB"),
        99_950..999_500 => format!("{kilo:.0} kB"),
        999_500..9_995_000 => format!("{mega:.2} MB"),
        9_995_000..99_950_000 => format!("{mega:.1} MB"),
        _ => format!("{mega:.0} MB"),
    }
}

/// Tells which hidden folders were removed.
pub fn tell_removed(removed: &[PathBuf]) {
    for path in removed {
        let path = path.strip_prefix(Path::new(".")).unwrap_or(path);
        say(&format!(
            "removed `{}`, left by a run that was killed",
            path.display()
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::size;

    #[test]
    fn issue_048_sizes_have_three_digits() {
        for (bytes, words) in [
            (0, "0 bytes"),
            (999, "999 bytes"),
            (1_234, "1.23 kB"),
            (9_996, "10.0 kB"),
            (88_925, "88.9 kB"),
            (99_960, "100 kB"),
            (999_600, "1.00 MB"),
            (6_051_234, "6.05 MB"),
            (12_345_678, "12.3 MB"),
            (1_234_567_890, "1235 MB"),
        ] {
            assert_eq!(size(bytes), words);
        }
    }
}
