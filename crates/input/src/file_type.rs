//! The type of a file, from its first bytes.

use crate::Separated;

/// A type of file that users have around Wedgelab.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileType {
    /// A case (TOML).
    Case,
    /// A study (TOML).
    Study,
    /// A track file (TOML).
    Track,
    /// A regime: a track with speeds (TOML).
    Regime,
    /// Limits of rules (TOML).
    Limits,
    /// Conditions of a car (TOML).
    Conditions,
    /// A file of NUCARS (keywords that begin with `\`).
    Nucars,
    /// A table of results (CSV with a column of times).
    Results,
    /// A measured track (CSV with a column of distances).
    MeasuredTrack,
    /// A profile of a wheel or a rail (CSV with y and z, Simpack, MiniProf, VAMPIRE).
    Profile,
    /// An assessment (JSON).
    Assessment,
    /// JSON: a summary, the description of a study, a saved state.
    Json,
    /// A web page, such as a report.
    Page,
    /// A figure: PNG, SVG, PDF.
    Figure,
    /// A MAT-file.
    MatFile,
    /// A ZIP archive: an FMU or a system structure, or an office document.
    Archive,
    /// A Parquet table of a study.
    Parquet,
    /// Records of a study.
    Records,
    /// No text.
    Binary,
}

/// Largest number of bytes at the beginning of a file that [`FileType::of`] needs.
pub const HEAD: usize = 1 << 16;

impl FileType {
    /// All of them.
    pub const ALL: [Self; 19] = [
        Self::Case,
        Self::Study,
        Self::Track,
        Self::Regime,
        Self::Limits,
        Self::Conditions,
        Self::Nucars,
        Self::Results,
        Self::MeasuredTrack,
        Self::Profile,
        Self::Assessment,
        Self::Json,
        Self::Page,
        Self::Figure,
        Self::MatFile,
        Self::Archive,
        Self::Parquet,
        Self::Records,
        Self::Binary,
    ];

    /// Returns the type that the beginning of a file shows; `None` if it says nothing.
    #[must_use]
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let signatures: [(&[u8], Self); 9] = [
            (b"MATLAB 5.0 MAT-file", Self::MatFile),
            (b"PK\x03\x04", Self::Archive),
            (b"PAR1", Self::Parquet),
            (b"WLR1", Self::Records),
            (b"\x89PNG", Self::Figure),
            (b"%PDF-", Self::Figure),
            (b"\x7fELF", Self::Binary),
            (b"\x1f\x8b", Self::Binary),
            (b"\x93NUMPY", Self::Binary),
        ];
        if let Some((_, found)) = signatures.iter().find(|(sign, _)| bytes.starts_with(sign)) {
            return Some(*found);
        }
        let head = &bytes[..bytes.len().min(HEAD)];
        if head.starts_with(b"\xff\xfe") || head.starts_with(b"\xfe\xff") {
            // UTF-16: only files of NUCARS are read in it, and its keywords are not looked for here.
            return None;
        }
        if head.contains(&0) {
            return Some(Self::Binary);
        }
        let text = String::from_utf8_lossy(head);
        let text = text.trim_start_matches('\u{feff}').trim_start();
        let begins = |sign: &str| {
            text.get(..sign.len())
                .is_some_and(|own| own.eq_ignore_ascii_case(sign))
        };
        if begins("<!doctype html") || begins("<html") {
            return Some(Self::Page);
        }
        if begins("<svg") || (begins("<?xml") && text.contains("<svg")) {
            return Some(Self::Figure);
        }
        if begins("{") || begins("[{") {
            return match text.contains("\"wedgelab.assessment/") {
                true => Some(Self::Assessment),
                false => Some(Self::Json),
            };
        }
        let lines = || text.split(['\n', '\r']).map(str::trim_end);
        if lines().any(is_nucars_keyword) {
            return Some(Self::Nucars);
        }
        if let Some(found) = toml_type(lines()) {
            return Some(found);
        }
        let of_profile = |line: &str| {
            ["spline.begin", "point.begin", "WHEELPROFILE", "RAILPROFILE"].contains(&line.trim())
                || ["XYPoints=", "ProgramName=MiniProf"]
                    .iter()
                    .any(|key| line.starts_with(key))
        };
        if lines().any(of_profile) {
            return Some(Self::Profile);
        }
        let mut rows = lines().filter(|line| !line.is_empty() && !line.starts_with('#'));
        table_type(rows.next()?)
    }

    /// Returns its name with its article, for messages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Case => "a case file",
            Self::Study => "a study file",
            Self::Track => "a track file",
            Self::Regime => "a regime's file",
            Self::Limits => "a file of limits",
            Self::Conditions => "a file of conditions",
            Self::Nucars => "a file of NUCARS",
            Self::Results => "a table of results",
            Self::MeasuredTrack => "a measured track",
            Self::Profile => "a profile of a wheel or a rail",
            Self::Assessment => "an assessment",
            Self::Json => "a JSON file",
            Self::Page => "a web page",
            Self::Figure => "a figure",
            Self::MatFile => "a MAT-file",
            Self::Archive => "a ZIP archive",
            Self::Parquet => "a Parquet table",
            Self::Records => "a file of a study's records",
            Self::Binary => "not text",
        }
    }

    /// Returns the command that takes such a file; `path` is the file as the user named it.
    #[must_use]
    pub fn advice(self, path: &str) -> String {
        match self {
            Self::Case => format!("`wedgelab run {path}` runs it"),
            Self::Study => format!("`wedgelab study {path}` runs it"),
            Self::Track => {
                format!("`wedgelab track show {path}` shows it; a case runs on it by track.file = \"{path}\"")
            }
            Self::Regime => format!("`wedgelab regime {path} CAR` runs a car in it"),
            Self::Limits => format!("`wedgelab assess CAR --limits {path}` compares a car with them"),
            Self::Conditions => format!("`wedgelab assess CAR --conditions {path}` runs a car in them"),
            Self::Nucars if path.to_ascii_lowercase().ends_with(".run") => {
                format!("`wedgelab nucars run {path}` runs it, `wedgelab nucars check {path}` reads it")
            }
            Self::Nucars => {
                format!("`wedgelab nucars check {path}` reads it; `wedgelab nucars run` takes the .RUN file")
            }
            Self::Results => format!("`wedgelab compare` and `wedgelab plot {path}` take it"),
            Self::MeasuredTrack => format!(
                "write a track file with [[irregularities]], table = \"{path}\" and form = \"space_curve\" \
                 or \"mid_chord\", and [columns] if its titles are its own; `wedgelab track show` \
                 takes that file"
            ),
            Self::Profile => format!(
                "`wedgelab wheelrail check` takes it; in a case, write wheels.profile = \"{path}\" or \
                 rails.profile"
            ),
            Self::Assessment => {
                "`wedgelab assess CAR --against DIR` takes the folder that it lies in".to_owned()
            }
            Self::Json => {
                "`wedgelab compare` takes the folder that a summary.json lies in; no command takes other JSON"
                    .to_owned()
            }
            Self::Page => "open it in a browser; the case of a run is its case.toml".to_owned(),
            Self::Figure => {
                "open it in a browser or viewer; `wedgelab plot` makes figures of results".to_owned()
            }
            Self::MatFile => {
                "load it in MATLAB, Octave or SciPy; the same result as text is its result.csv".to_owned()
            }
            Self::Archive => {
                "an FMU is for importers; `wedgelab fmu export CASE` makes one of a case".to_owned()
            }
            Self::Parquet => "read it with pandas, Polars or DuckDB; `wedgelab study` makes it".to_owned(),
            Self::Records => "`wedgelab study` reads it in its folder".to_owned(),
            Self::Binary => "name a text file".to_owned(),
        }
    }
}

/// Returns true for a line such as `\BODY DATA`.
fn is_nucars_keyword(line: &str) -> bool {
    let word = line
        .strip_prefix('\\')
        .or_else(|| line.trim_start().strip_prefix("$\\"));
    word.is_some_and(|word| word.starts_with(|letter: char| letter.is_ascii_alphabetic()))
}

/// Returns results, a measured track or a profile, by the titles of columns.
fn table_type(titles: &str) -> Option<FileType> {
    // Also as measuring cars of North America abbreviate them.
    const TRACK: [&str; 9] = [
        "prof",
        "align",
        "cross_level",
        "crosslevel",
        "superelevation",
        "gauge",
        "gage",
        "curvature",
        "degree_of_curve",
    ];
    let separated = Separated::of(titles);
    let cells: Vec<String> = separated.cells(titles).map(str::to_ascii_lowercase).collect();
    let any = |is: &dyn Fn(&str) -> bool| cells.iter().any(|cell| is(cell.trim_matches('"')));
    if cells.len() < 2 {
        return None;
    }
    if titles.contains(',') && any(&|cell| ["time", "time_s"].contains(&cell)) {
        return Some(FileType::Results);
    }
    let is_track = |cell: &str| TRACK.iter().any(|name| cell.contains(name));
    let is_place =
        |cell: &str| cell == "mp" || ["distance", "milepost"].iter().any(|name| cell.starts_with(name));
    if any(&is_place) && any(&is_track) {
        return Some(FileType::MeasuredTrack);
    }
    let axis = |name: &'static str| {
        move |cell: &str| {
            let title = cell.split(['[', '(']).next().unwrap_or("").trim();
            title.split('_').next() == Some(name) && cell.contains(['[', '('])
        }
    };
    (any(&axis("y")) && any(&axis("z"))).then_some(FileType::Profile)
}

/// Returns a case, a study, a track, a regime, limits or conditions, by the sections and keys that only one
/// of them has.
fn toml_type<'t>(lines: impl Iterator<Item = &'t str>) -> Option<FileType> {
    const CASE: [&str; 8] = [
        "[wedge]",
        "[control_coil]",
        "[contact]",
        "[friction]",
        "[side_frame]",
        "[bolster]",
        "[environment]",
        "[simulation]",
    ];
    const STUDY: [&str; 3] = ["[vary]", "[[variants]]", "[set]"];
    let mut found = None;
    // Before the first section.
    let mut top = true;
    for line in lines {
        let line = line.split('#').next().unwrap_or("").trim();
        let key = line.split(['=', '.']).next().unwrap_or("").trim();
        let is_section = line.starts_with('[');
        top &= !is_section;
        let own = match key.trim_matches(['[', ']']) {
            "limits" => Some(FileType::Limits),
            "conditions" => Some(FileType::Conditions),
            "segments" | "grades" | "irregularities" | "center_line" => Some(FileType::Track),
            "looks_at" | "speeds" | "distance" | "settle" => Some(FileType::Regime),
            _ => None,
        };
        if own.is_some() && (is_section || (top && line.contains('='))) {
            return own;
        }
        if STUDY.contains(&line) || (["sampling", "case"].contains(&key) && line.contains('=')) {
            return Some(FileType::Study);
        }
        let table = CASE
            .iter()
            .any(|section| *section == line || section.trim_matches(['[', ']']) == key);
        if table && (is_section || line.contains('=')) {
            found = Some(FileType::Case);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_files_are_recognized_by_their_beginning() {
        let page = format!("\u{feff}<!DOCTYPE html>{}", "x".repeat(1000));
        let files: [(&[u8], Option<FileType>); 34] = [
            (b"[wedge]\ndamping = \"constant\"", Some(FileType::Case)),
            (b"wedge.angle = \"32 deg\"", Some(FileType::Case)),
            (b"# a [vary] study?\n[bolster]\n", Some(FileType::Case)),
            (b"case = \"x\"\n[vary]\nwedge.angle = []", Some(FileType::Study)),
            (b"name = \"x\"\n[[variants]] # list", Some(FileType::Study)),
            (b"  ! head\n\\BODY DATA\n", Some(FileType::Nucars)),
            (b"$\\TITLE\r\n", Some(FileType::Nucars)),
            (b"time_s,wedge_x_in\n0,1\n", Some(FileType::Results)),
            (b"# remark\nwedge_x_in , time\n", Some(FileType::Results)),
            (b"time [s], value [in]\n0, 1\n", None),
            (b"{\"schema\": \"wedgelab.summary/1\"}", Some(FileType::Json)),
            (
                b"{\"schema\": \"wedgelab.assessment/1\"}",
                Some(FileType::Assessment),
            ),
            (b"title = \"m\"\n[[segments]]\n", Some(FileType::Track)),
            (b"segments = [{ tangent = \"1 ft\" }]", Some(FileType::Track)),
            (
                b"model = \"car\"\n[track]\nsegments = []\n[wedge]",
                Some(FileType::Case),
            ),
            (b"speeds = [\"9 mph\"]\n[set]\n[track]\n", Some(FileType::Regime)),
            (b"title = \"ours\"\n[[limits]]\n", Some(FileType::Limits)),
            (
                b"[conditions.worn]\ntitle = \"\"\n[conditions.worn.set]",
                Some(FileType::Conditions),
            ),
            (
                b"distance [m]; left_profile [mm]\n ; up\n",
                Some(FileType::MeasuredTrack),
            ),
            (
                b"Milepost,Gage,Left Prof 62\n100.0,56.5,0\n",
                Some(FileType::MeasuredTrack),
            ),
            (b"MP,Speed\n1,2\n", None),
            (b"distance_ft,time_s,speed_mph\n0,0,1\n", Some(FileType::Results)),
            (b"distance_ft,speed_mph\n0,1\n", None),
            (b"# wheel\ny_gauge (in); z_down (in)\n", Some(FileType::Profile)),
            (
                b"header.begin\nheader.end\nspline.begin\n",
                Some(FileType::Profile),
            ),
            (page.as_bytes(), Some(FileType::Page)),
            (b"<?xml version=\"1.0\"?><svg/>", Some(FileType::Figure)),
            (b"\x89PNG\r\n", Some(FileType::Figure)),
            (b"MATLAB 5.0 MAT-file, \0", Some(FileType::MatFile)),
            (b"PK\x03\x04", Some(FileType::Archive)),
            (b"\0\0\0\0", Some(FileType::Binary)),
            (b"\xff\xfe\\\0T\0", None),
            (b"", None),
            (b"hello", None),
        ];
        for (bytes, found) in files {
            assert_eq!(FileType::of(bytes), found, "{}", String::from_utf8_lossy(bytes));
        }
    }
}
