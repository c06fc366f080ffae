//! A whole FMU as bytes: description, library, case, documentation, licences.

use std::borrow::Cow;
use std::io::{Cursor, Read, Write};
use std::path::{Path, PathBuf};

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use crate::description::{Description, Version};
use crate::resources::MODEL;
use crate::source::Source;
use crate::{Error, limits};

const LICENSES: [(&str, &str); 2] = [
    ("LICENSE-MIT", include_str!("../../../LICENSE-MIT")),
    ("LICENSE-APACHE", include_str!("../../../LICENSE-APACHE")),
];

/// A platform that an FMU may hold a library for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Platform {
    /// Its folder in FMI 2.0.
    pub two: &'static str,
    /// Its folder in FMI 3.0.
    pub three: &'static str,
    /// The ending of its libraries.
    pub ending: &'static str,
}

/// The platforms.
pub const PLATFORMS: [Platform; 5] = [
    Platform {
        two: "linux64",
        three: "x86_64-linux",
        ending: "so",
    },
    Platform {
        two: "linux64-aarch64",
        three: "aarch64-linux",
        ending: "so",
    },
    Platform {
        two: "win64",
        three: "x86_64-windows",
        ending: "dll",
    },
    Platform {
        two: "darwin64",
        three: "x86_64-darwin",
        ending: "dylib",
    },
    Platform {
        two: "darwin64-aarch64",
        three: "aarch64-darwin",
        ending: "dylib",
    },
];

impl Platform {
    /// Returns the one that this program runs on.
    #[must_use]
    pub fn here() -> Option<Self> {
        let system = match std::env::consts::OS {
            "macos" => "darwin",
            other => other,
        };
        let name = format!("{}-{system}", std::env::consts::ARCH);
        PLATFORMS.into_iter().find(|platform| platform.three == name)
    }

    /// Checks whether bytes begin as a library of this platform does.
    fn check(self, library: &Library) -> Result<(), Error> {
        let (kind, beginnings): (_, &[&[u8]]) = match self.ending {
            "dll" => ("PE", &[b"MZ"]),
            "dylib" => ("Mach-O", &[b"\xcf\xfa\xed\xfe", b"\xca\xfe\xba\xbe"]),
            _ => ("ELF", &[b"\x7fELF"]),
        };
        if beginnings
            .iter()
            .any(|beginning| library.bytes.starts_with(beginning))
        {
            return Ok(());
        }
        Err(Error::new(format!(
            "{} is no library for {}: it does not begin as a file of the kind {kind}; name the library \
             wedgelab_fmu that was built there",
            library.name, self.three
        )))
    }

    /// Returns its folder in an FMU of a version.
    #[must_use]
    pub fn folder(self, version: Version) -> &'static str {
        match version {
            Version::Two => self.two,
            Version::Three => self.three,
        }
    }
}

/// The library of FMUs.
#[derive(Clone, Debug)]
pub struct Library {
    /// Its name in messages.
    name: String,
    bytes: Cow<'static, [u8]>,
}

impl Library {
    /// Reads a library from its file.
    ///
    /// # Errors
    /// It cannot be read, or is too large.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let bytes = limits::read(path, limits::FMU_LIBRARY)
            .map_err(|error| Error::new(format!("the library {error}")))?;
        Ok(Self {
            name: path.display().to_string(),
            bytes: bytes.into(),
        })
    }

    /// Returns the library that a program carries with it.
    #[must_use]
    pub fn carried(bytes: &'static [u8]) -> Self {
        Self {
            name: "what the program carries".to_owned(),
            bytes: bytes.into(),
        }
    }
}

/// Returns the FMU of what is made of a source, with the library for one platform, as the bytes of its file,
/// and its description.
///
/// # Errors
/// Nothing can be made of the source, or the library is none for the platform.
pub fn fmu(
    source: &Source,
    version: Version,
    library: &Library,
    platform: Platform,
) -> Result<(Vec<u8>, Description), Error> {
    let description = Description::new(source)?;
    let name = description.model.name();
    platform.check(library)?;
    let binary = library.bytes.to_vec();
    let library = format!(
        "binaries/{}/{}.{}",
        platform.folder(version),
        name,
        platform.ending
    );
    let mut files: Vec<(String, Vec<u8>)> = vec![
        (
            "modelDescription.xml".to_owned(),
            description.xml(version)?.into_bytes(),
        ),
        (library, binary),
        (format!("resources/{MODEL}"), format!("{name}\n").into_bytes()),
        (
            "documentation/index.html".to_owned(),
            page(&description).into_bytes(),
        ),
    ];
    let resources = description.files.iter();
    files.extend(resources.map(|(name, bytes)| (format!("resources/{name}"), bytes.clone())));
    for (name, text) in LICENSES {
        files.push((
            format!("documentation/licenses/{name}.txt"),
            text.as_bytes().to_vec(),
        ));
    }
    Ok((pack(&files)?, description))
}

/// Joins FMUs that differ only in their libraries into one that holds them all; returns the bytes of its file
/// and the number of libraries.
///
/// # Errors
/// They differ otherwise, hold two libraries for one platform, or cannot be read.
pub fn merged(parts: &[PathBuf]) -> Result<(Vec<u8>, usize), Error> {
    let mut files: Vec<(String, Vec<u8>)> = Vec::new();
    for part in parts {
        let taken: u64 = files.iter().map(|(_, bytes)| bytes.len() as u64).sum();
        for (name, bytes) in unpack(part, limits::FMU_UNPACKED.saturating_sub(taken))? {
            match files.iter().find(|(known, _)| *known == name) {
                None if files.is_empty() || name.starts_with("binaries/") || *part == parts[0] => {
                    files.push((name, bytes));
                }
                None => {
                    return Err(Error::new(format!(
                        "{} holds {name}, which {} does not: only FMUs of the same case and version can be \
                         merged",
                        part.display(),
                        parts[0].display()
                    )));
                }
                Some((_, known)) if *known == bytes => {}
                Some(_) => {
                    return Err(Error::new(format!(
                        "{name} in {} is not that of the FMUs before it: only FMUs of the same case and \
                         version, for different platforms, can be merged",
                        part.display()
                    )));
                }
            }
        }
    }
    let libraries = files.iter().filter(|(name, _)| name.starts_with("binaries/"));
    let count = libraries.count();
    Ok((pack(&files)?, count))
}

/// Returns the files in an FMU, which must have no more bytes than these in all.
fn unpack(path: &Path, most: u64) -> Result<Vec<(String, Vec<u8>)>, Error> {
    let failed = |error: &dyn std::fmt::Display| Error::new(format!("{} is no FMU: {error}", path.display()));
    let file = limits::open(path, limits::FMU_FILE)?;
    let mut archive = ZipArchive::new(file).map_err(|error| failed(&error))?;
    if archive.len() > limits::FMU_FILES {
        let (own, most) = (archive.len(), limits::FMU_FILES);
        return Err(failed(&format!(
            "it holds {own} files, and at most {most} are read"
        )));
    }
    let mut left = most;
    let mut files = Vec::new();
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).map_err(|error| failed(&error))?;
        if entry.is_dir() {
            continue;
        }
        let name = entry.name().map_err(|error| failed(&error))?.into_owned();
        if entry.enclosed_name().is_none() {
            return Err(failed(&format!(
                "the name {name:?} in it leads out of its folder"
            )));
        }
        let size = entry.size();
        let too_much = || {
            let most = limits::shown(limits::FMU_UNPACKED);
            failed(&format!(
                "unpacked it has more than the {most} that are read, at {name}"
            ))
        };
        left = left.checked_sub(size).ok_or_else(too_much)?;
        // What is packed may be more than it says.
        let mut bytes = Vec::new();
        let read = entry
            .by_ref()
            .take(size.saturating_add(1))
            .read_to_end(&mut bytes);
        if read.map_err(|error| failed(&error))? as u64 > size {
            return Err(failed(&format!("{name} in it is longer than it says")));
        }
        files.push((name, bytes));
    }
    if files.iter().all(|(name, _)| name != "modelDescription.xml") {
        return Err(failed(&"it holds no modelDescription.xml"));
    }
    Ok(files)
}

/// Returns the archive of these files as bytes.
pub(crate) fn pack(files: &[(String, Vec<u8>)]) -> Result<Vec<u8>, Error> {
    let failed = |error: &dyn std::fmt::Display| Error::new(format!("the archive cannot be made: {error}"));
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    // No times: the same FMU has the same bytes.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Deflated)
        .last_modified_time(zip::DateTime::default())
        .unix_permissions(0o644);
    for (name, bytes) in files {
        let options = if name.starts_with("binaries/") {
            options.unix_permissions(0o755)
        } else {
            options
        };
        archive
            .start_file(name.as_str(), options)
            .map_err(|error| failed(&error))?;
        archive.write_all(bytes).map_err(|error| failed(&error))?;
    }
    let archive = archive.finish().map_err(|error| failed(&error))?;
    Ok(archive.into_inner())
}

/// Returns the page that documents an FMU.
fn page(description: &Description) -> String {
    let escape = |text: &str| {
        text.replace('&', "&amp;")
            .replace('<', "&lt;")
            .replace('>', "&gt;")
    };
    let mut rows = String::new();
    for variable in &description.variables {
        let unit = variable.unit.and_then(crate::unit::Unit::name).unwrap_or("");
        rows += &format!(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{unit}</td><td>{}</td></tr>\n",
            escape(&variable.name),
            variable.causality.name(),
            variable.variability.name(),
            escape(&variable.text)
        );
    }
    let files = description.files.iter();
    let files = files.map(|(name, _)| format!("<code>resources/{name}</code>"));
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head><meta charset=\"utf-8\"><title>{name}</title>\n\
         <style>body {{ font-family: sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em }} td, \
         th {{ text-align: left; padding: 0.1em 0.8em 0.1em 0; vertical-align: top }}</style></head>\n\
         <body>\n<h1>{name}</h1>\n<p>{text}</p>\n\
         <p>Made by wedgelab {version}. {conventions} All values are in SI units.</p>\n\
         <p>What it is made of is in {files}; licences are in \
         <code>documentation/licenses</code>.</p>\n<table>\n\
         <tr><th>variable</th><th>causality</th><th>variability</th><th>unit</th><th></th></tr>\n\
         {rows}</table>\n</body>\n</html>\n",
        name = description.model.name(),
        text = escape(&description.text),
        version = env!("CARGO_PKG_VERSION"),
        conventions = description.model.conventions(),
        files = files.collect::<Vec<String>>().join(", "),
    )
}
