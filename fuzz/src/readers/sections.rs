//! Sections that results are cut into, and differences that are accepted in them.

use std::path::Path;

use quantity::{Kind, System as Units};
use study::sections::{Acceptance, Along, SectionQuantity, SectionRequest, section_values};

use super::cases::refused;
use super::{ReadOutcome, Reader};

/// Files of sections, and `--sections` itself.
pub const SECTIONS: Reader = Reader {
    name: "sections",
    about: "files of sections, and --sections of `wedgelab compare`; cutting 1000 m or s by them",
    corpus: || {
        [
            "from [ft], to [ft]\n0, 300\n300, 600\n600, 900\n",
            "# times\nfrom [s], to [ms]\n0,500\n1,2000\n",
            "12",
            "100 m",
            "2.5 s",
        ]
        .map(|text| text.as_bytes().to_vec())
        .to_vec()
    },
    dictionary: &[
        b"from [", b"to [", b"ft]", b"m]", b"s]", b",", b"#", b"e308", b"-", b"10000", b" mi", b" h",
    ],
    read: sections,
};

/// Accepted differences.
pub const ACCEPTED: Reader = Reader {
    name: "accepted",
    about: "--accept of `wedgelab compare`: limits by column and quantity",
    corpus: || {
        ["source = \"ours\"\n[accept.force]\nmean = \"1 kN\"\nmax = \"2 kN\"\n[accept.ratio]\nrms = 0.1\n"]
            .map(|text| text.as_bytes().to_vec())
            .to_vec()
    },
    dictionary: &[
        b"source = \"\"",
        b"[accept.force]",
        b"[accept]",
        b"mean = ",
        b"max = ",
        b"rms = ",
        b"\"500 lbf\"",
        b"0.1",
        b"1e308",
        b"inf",
    ],
    read: accepted,
};

fn sections(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let file = SectionRequest::of_text(Path::new("own.csv"), text);
    let typed = SectionRequest::parse(text);
    [file, typed]
        .map(cut)
        .into_iter()
        .fold(ReadOutcome::NO_TEXT, ReadOutcome::or)
}

/// Cuts by a request, and takes the values of a line over each section.
fn cut(request: Result<SectionRequest, study::case::CaseError>) -> ReadOutcome {
    let request = match request {
        Ok(request) => request,
        Err(error) => return refused(&error),
    };
    let along = request.along().unwrap_or(Along::Time);
    let (places, values) = ([0.0, 400.0, 1000.0], [1.0, -2.0, 3.0]);
    match request.cut(along, [0.0, 1000.0], Units::Us) {
        Ok(cut) => {
            let values = |own: &[f64; 2]| section_values(&places, &values, false, *own);
            let kept = cut.sections.iter().take(100).filter_map(values);
            assert!(kept.flatten().all(f64::is_finite), "not finite: {cut:?}");
            let rising = cut.sections.windows(2).all(|pair| pair[0][0] < pair[1][0]);
            assert!(rising && cut.sections.len() > 1, "sections in no order");
        }
        Err(error) => return ReadOutcome::refused_with(&format!("{error}: {}", error.help())),
    }
    ReadOutcome::ACCEPTED
}

fn accepted(input: &[u8]) -> ReadOutcome {
    let Ok(text) = std::str::from_utf8(input) else {
        return ReadOutcome::NO_TEXT;
    };
    let read = match Acceptance::parse("accepted.toml", text) {
        Ok(read) => read,
        Err(error) => return refused(&error),
    };
    let mut outcome = ReadOutcome::ACCEPTED;
    for column in read.columns() {
        for quantity in SectionQuantity::ALL {
            for kind in [Kind::Force, Kind::Dimensionless] {
                match read.limit(column, quantity, kind) {
                    Ok(limit) => assert!(limit.is_none_or(|own| own > 0.0), "no limit: {limit:?}"),
                    Err(error) => outcome = outcome.or(refused(&error)),
                }
            }
        }
    }
    outcome
}
