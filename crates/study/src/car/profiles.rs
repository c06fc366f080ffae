//! Profiles of wheels and rails as a case names them: nominal ones and files.

use std::path::{Path, PathBuf};

use wheelrail::profile::{
    Profile, ProfileError, ProfileKind, ProfileNotice, ReadOptions, SlicedProfile, names,
};

use crate::case::field::Written;
use crate::case::problem::Problem;
use crate::case::tables::{NamedFile, Refused};
use crate::reader::CaseReader;
use crate::reader::schema::Form;

/// Largest distance of splines from the points of a file, m.
pub(super) const DEVIATION: f64 = 0.0008 * 0.0254;

/// Sides in paths.
pub(super) const SIDES: [&str; 2] = ["left", "right"];

/// A profile as named, with the full path of the key that names it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NamedProfile {
    pub path: String,
    pub name: String,
}

/// Returns a text, such as the name of a profile.
fn text(r: &mut CaseReader<'_>, key: &'static str, default: &str, comment: &str) -> String {
    let read = |section: &crate::case::section::CaseSection<'_>,
                problems: &mut crate::case::problem::Problems| {
        section.text(key, problems).map(|(text, _)| text.to_owned())
    };
    r.other(key, Form::Text, comment, default.to_owned(), read, |text| {
        Written::text(text)
    })
}

/// Reads the name of a profile.
pub(super) fn named(r: &mut CaseReader<'_>, section: &str, default: &str, comment: &str) -> NamedProfile {
    NamedProfile {
        path: format!("{section}.profile"),
        name: text(r, "profile", default, comment),
    }
}

/// Reads the name of a profile that stands for another one, if it is given.
pub(super) fn named_or(r: &mut CaseReader<'_>, section: &str, base: &NamedProfile) -> NamedProfile {
    let given = r.gives("profile");
    let own = named(r, section, &base.name, "as for all");
    if given { own } else { base.clone() }
}

/// Returns a nominal profile, or one from a file.
pub(super) fn profile(
    r: &mut CaseReader<'_>,
    named: &NamedProfile,
    kind: ProfileKind,
    options: &ReadOptions,
    doubts: &mut Vec<String>,
) -> Option<Profile> {
    let NamedProfile { path, name } = named;
    let nominal = match kind {
        ProfileKind::Wheel => names::wheel(name),
        ProfileKind::Rail => names::rail(name).map(|found| found.map(|(rail, _)| rail)),
    };
    let tables = r.tables();
    let is_file = tables.locate(name).is_ok_and(|file| file.exists());
    match nominal {
        Ok(Some(made)) => return Some(made),
        // A file may have any name.
        Err(error) if !is_file => {
            wrong(r, path, &error);
            return None;
        }
        _ => {}
    }
    let file = located(r, path, name, kind)?;
    let made = Profile::read_with(&file, kind, options);
    r.files.push(NamedFile {
        key: key_of(kind),
        typed: name.to_owned(),
        path: file,
        listed: Vec::new(),
    });
    let made = made.map_err(|error| wrong(r, path, &error)).ok()?;
    doubt(r, path, made.notices(), doubts);
    Some(made)
}

/// Returns whether a name is that of a list of sections of this kind that exists.
pub(super) fn is_list(r: &CaseReader<'_>, named: &NamedProfile, kind: ProfileKind) -> bool {
    let exists = || r.tables().locate(&named.name).is_ok_and(|file| file.exists());
    SlicedProfile::kind_of(Path::new(&named.name)) == Some(kind) && exists()
}

/// Returns a list of sections, with its files.
pub(super) fn sliced(
    r: &mut CaseReader<'_>,
    named: &NamedProfile,
    kind: ProfileKind,
    options: &ReadOptions,
    doubts: &mut Vec<String>,
) -> Option<SlicedProfile> {
    /// A file of the list that is not read.
    enum Fails {
        Profile(ProfileError),
        Refused(String, Refused),
    }
    impl From<ProfileError> for Fails {
        fn from(error: ProfileError) -> Self {
            Self::Profile(error)
        }
    }
    let NamedProfile { path, name } = named;
    let file = located(r, path, name, kind)?;
    let folder = Path::new(name).parent().unwrap_or(Path::new("")).to_owned();
    let tables = r.tables();
    let mut listed = Vec::new();
    let read = SlicedProfile::read_with(&file, options, |own| {
        let typed = folder.join(own).display().to_string();
        let found = tables.locate(&typed);
        let found = found.map_err(|refused| Fails::Refused(tables.shown(&typed), refused))?;
        listed.push((own.to_owned(), found.clone()));
        Ok(found)
    });
    r.files.push(NamedFile {
        key: key_of(kind),
        typed: name.to_owned(),
        path: file,
        listed,
    });
    match read {
        Ok(read) => {
            doubt(r, path, read.notices(), doubts);
            Some(read)
        }
        Err(Fails::Profile(error)) => {
            wrong(r, path, &error);
            None
        }
        Err(Fails::Refused(shown, refused)) => {
            let problem = Problem::new(format!("`{path}`: {shown} {}", refused.reason));
            r.problem(path, problem.label("a file of this list").help(refused.help));
            None
        }
    }
}

/// Returns the name of a file in messages.
pub(super) fn shown(r: &CaseReader<'_>, name: &str) -> String {
    r.tables().shown(name)
}

fn key_of(kind: ProfileKind) -> &'static str {
    match kind {
        ProfileKind::Wheel => "wheels.profile",
        ProfileKind::Rail => "rails.profile",
    }
}

/// Returns the place of a file.
fn located(r: &mut CaseReader<'_>, path: &str, name: &str, kind: ProfileKind) -> Option<PathBuf> {
    let tables = r.tables();
    match tables.locate(name) {
        Ok(file) if file.exists() => Some(file),
        Ok(_) => {
            let problem = Problem::new(format!("`{path}`: there is no file {}", tables.shown(name)));
            let names = match kind {
                ProfileKind::Wheel => names::WHEELS,
                ProfileKind::Rail => names::RAILS,
            };
            let help = format!("name a file of points from the folder of the case file, or {names}");
            r.problem(
                path,
                problem.label("neither a file nor a nominal profile").help(help),
            );
            None
        }
        Err(refused) => {
            let problem = Problem::new(format!("`{path}`: {} {}", tables.shown(name), refused.reason));
            r.problem(path, problem.label("this file").help(refused.help));
            None
        }
    }
}

/// Takes note of what is doubtful about a profile.
fn doubt(r: &CaseReader<'_>, path: &str, notices: &[ProfileNotice], doubts: &mut Vec<String>) {
    doubts.extend(notices.iter().map(|notice| match r.tables().may_quote() {
        true => format!("`{path}`: {}; {}", notice.text, notice.advice),
        false => format!(
            "`{path}`: the points of this file are doubtful; {}",
            notice.advice
        ),
    }));
}

/// Notes that a profile cannot be used.
pub(super) fn wrong(r: &mut CaseReader<'_>, path: &str, error: &ProfileError) {
    let problem = match (r.tables().may_quote(), r.files.is_empty()) {
        (false, false) => {
            let names: Vec<&str> = r.files.iter().map(|file| file.typed.as_str()).collect();
            Problem::of_unquoted(
                path,
                &names.join(", "),
                error.line(),
                "no profile as it is needed here",
            )
        }
        _ => Problem::new(format!("`{path}`: {error}")).help(error.remedy()),
    };
    r.problem(path, problem.label("this profile"));
}
