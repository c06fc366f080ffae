//! The runs of half-trucks in FMUs: read, written and read again, and made a system.

use fmi::half_truck::HalfTruck;
use nucars::builtin;
use nucars::file_sets::{Text, Texts};
use study::half_truck::files::Settings;

use super::{ReadOutcome, Reader, refused_as_written};

/// Runs of half-trucks in FMUs.
pub const FMU_RUNS: Reader = Reader {
    name: "fmu_runs",
    about: "runs of half-trucks in FMUs (run.json)",
    corpus,
    dictionary: &[
        b"null",
        b"{}",
        b"[]",
        b"\"version\": 1",
        b"\"built_in\"",
        b"\"files\"",
        b"\"settings\"",
        b"\"choices\"",
        b"\"speed\"",
        b"\"duration\"",
        b"-1",
        b"1e308",
        b"5e-324",
        b"\\n",
        b"\\ud800",
    ],
    read,
};

fn corpus() -> Vec<Vec<u8>> {
    let built_in = HalfTruck::built_in("nucars_68_variable_toe_in_yaw", &Settings::default());
    let text = |name: &str| {
        Some(Text {
            name: name.to_owned(),
            text: builtin::text(name)?.to_owned(),
        })
    };
    let texts = Texts {
        run: text("bolst_wedge_sf_bolst-vert-displ_69_const.run"),
        system: text("bolst_wedge_sf_69_const.sys"),
        data: text("sngl_trk_69.dat"),
        input: text("bolst_displ_input3.inp"),
    };
    let of_files = HalfTruck::of_files(texts, &Settings::default());
    let made = [built_in, of_files].into_iter().flatten();
    made.map(|own| own.text().as_bytes().to_vec()).collect()
}

fn read(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let half_truck = match HalfTruck::parse(text) {
        Ok(half_truck) => half_truck,
        Err(error) => return ReadOutcome::refused_with(&error.to_string()),
    };
    if let Err(error) = HalfTruck::parse(half_truck.text()) {
        refused_as_written(&error);
    }
    match half_truck.plant(None) {
        Ok(_) => ReadOutcome::ACCEPTED,
        Err(error) => ReadOutcome::refused_with(&error.to_string()),
    }
}
