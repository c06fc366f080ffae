//! One input once more, and shorter ones that do the same.

use std::fs;
use std::io;
use std::path::Path;
use std::str::FromStr;
use std::time::{Duration, Instant};

use fuzz::inputs::Inputs;
use fuzz::readers::{self, Reader};

use crate::folder::Folder;
use crate::parent::{Worker, WorkerEnd};
use crate::worker::MESSAGES;

/// An input: reader, seed, number.
#[derive(Clone, Debug)]
pub struct Address {
    reader: &'static str,
    seed: u64,
    number: u64,
}

impl FromStr for Address {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts: Vec<&str> = text.split(':').collect();
        let [reader, seed, number] = parts.as_slice() else {
            return Err("READER:SEED:NUMBER is expected, such as units:1:207".to_owned());
        };
        let whole = |text: &str| text.parse().map_err(|_| format!("`{text}` is no whole number"));
        let reader = readers::find(reader).ok_or_else(|| format!("there is no reader `{reader}`"))?;
        Ok(Self {
            reader: reader.name,
            seed: whole(seed)?,
            number: whole(number)?,
        })
    }
}

/// Shows an input and runs it; looks for shorter ones if asked to. Returns whether nothing was found.
///
/// # Errors
/// Workers cannot be started, or files not be written.
pub fn repeat(
    address: &Address,
    patience: Duration,
    shorten: Option<f64>,
    save: Option<&Path>,
) -> Result<bool, String> {
    let Some(reader) = readers::find(address.reader) else {
        return Err(format!("There is no reader `{}`.", address.reader));
    };
    let inputs = Inputs::of(reader);
    let input = inputs.input(address.seed, address.number);
    let made = inputs.mutations(address.seed, address.number);
    say!("{} bytes, by {made:?}:\n{}\n", input.len(), shown(&input));
    let failed = |error: io::Error| error.to_string();
    let (what, detail) = run(reader, &input, patience).map_err(failed)?;
    say!("{detail}");
    let Some(what) = what else { return Ok(true) };
    let mut least = input;
    if let Some(time) = shorten.map(Duration::try_from_secs_f64) {
        let end = Instant::now() + time.map_err(|_| "--shorten wants a positive number.")?;
        least = shortened(reader, least, &what, patience, end).map_err(failed)?;
        say!("\n{} bytes do the same:\n{}", least.len(), shown(&least));
        say!("{}", run(reader, &least, patience).map_err(failed)?.1);
    }
    if let Some(folder) = save {
        let name = format!("{}-{}-{}.input", address.reader, address.seed, address.number);
        let written = fs::create_dir_all(folder).and_then(|()| fs::write(folder.join(name), least));
        written.map_err(|error| format!("{} cannot be written to: {error}", folder.display()))?;
    }
    Ok(false)
}

/// Runs one input in a process of its own: what was found, if anything, and what to say.
fn run(reader: &Reader, input: &[u8], patience: Duration) -> io::Result<(Option<String>, String)> {
    let folder = Folder::make()?;
    let file = folder.path().join("input");
    fs::write(&file, input)?;
    let ended = Worker::start(reader, folder.path())
        .input(&file)
        .watch(patience)?;
    Ok(match (ended.end, ended.findings.into_iter().next()) {
        (WorkerEnd::Failed(text), _) => return Err(io::Error::other(text)),
        (WorkerEnd::Hung, _) => (Some("hangs".to_owned()), "hangs".to_owned()),
        (WorkerEnd::Broke { what, detail }, _) => {
            let text = format!("{what}\n{detail}");
            (Some(what), text)
        }
        (WorkerEnd::Done, Some(found)) => {
            let text = format!("{}\n{}", found.what, found.detail);
            (Some(found.what), text)
        }
        (WorkerEnd::Done, None) => {
            let end = if ended.tally.accepted > 0 {
                "accepted"
            } else {
                "refused"
            };
            let time = ended.tally.slowest as f64 / 1e6;
            let messages = fs::read_to_string(folder.path().join(MESSAGES)).unwrap_or_default();
            (None, format!("{end} in {time:.1} ms\n{messages}"))
        }
    })
}

/// Takes pieces out, larger ones first, as long as the same is found.
fn shortened(
    reader: &Reader,
    mut input: Vec<u8>,
    what: &str,
    patience: Duration,
    end: Instant,
) -> io::Result<Vec<u8>> {
    let mut piece = input.len().div_ceil(2);
    while piece > 0 && Instant::now() < end {
        let (mut at, before) = (0, input.len());
        while at < input.len() && Instant::now() < end {
            let mut less = input.clone();
            less.drain(at..input.len().min(at + piece));
            match run(reader, &less, patience)?.0 {
                Some(found) if found == what => input = less,
                _ => at += piece,
            }
        }
        // The same size again, as long as it helps.
        if input.len() == before {
            piece /= 2;
        }
    }
    Ok(input)
}

/// Returns the beginning and the end of an input, with what is no plain letter escaped.
fn shown(input: &[u8]) -> String {
    const MOST: usize = 1500;
    let plain = |bytes: &[u8]| {
        let text = bytes.escape_ascii().to_string();
        text.replace("\\n", "\n")
            .replace("\\\"", "\"")
            .replace("\\'", "'")
    };
    if input.len() <= 2 * MOST {
        return plain(input);
    }
    let (begin, end) = (&input[..MOST], &input[input.len() - MOST..]);
    let left_out = input.len() - 2 * MOST;
    format!("{}\n... {left_out} bytes ...\n{}", plain(begin), plain(end))
}
