//! Issue 29: whatever an FMU refuses is sent to the importer's logger, with the name of the function and a
//! reason; also while logging is switched off. Every exported function is called in every phase, rightly and
//! wrongly.
#![allow(missing_docs, clippy::unwrap_used, clippy::undocumented_unsafe_blocks)]

mod instantiation;
mod three;
// Where C passes the arguments of a function with `...` in other places, a logger in Rust cannot take them.
#[cfg(not(all(target_vendor = "apple", target_arch = "aarch64")))]
mod two;

use std::collections::BTreeSet;
use std::ffi::{CStr, CString, c_char, c_void};
use std::path::Path;
use std::ptr::null_mut;
use std::sync::Mutex;

use fmi::description::{Description, Version};
use fmi::resources;
use fmi::source::Source;
use study::case::builtin;

const OK: i32 = 0;
const WARNING: i32 = 1;
const DISCARD: i32 = 2;
const ERROR: i32 = 3;

/// All sources with exported functions.
const SOURCES: [(Version, &str); 6] = [
    (Version::Two, include_str!("../../src/fmi2/mod.rs")),
    (Version::Two, include_str!("../../src/fmi2/co_simulation.rs")),
    (Version::Two, include_str!("../../src/fmi2/model_exchange.rs")),
    (Version::Three, include_str!("../../src/fmi3/mod.rs")),
    (Version::Three, include_str!("../../src/fmi3/model_exchange.rs")),
    (Version::Three, include_str!("../../src/fmi3/others.rs")),
];

/// Names of the exported functions of a version, with their bodies; those of the macro `functions` have none.
fn exported(version: Version) -> Vec<(&'static str, Option<&'static str>)> {
    let sources = SOURCES.iter().filter(|(own, _)| *own == version);
    let (mut all, mut rows) = (Vec::new(), Vec::new());
    for (_, text) in sources {
        for text in text.split("#[unsafe(no_mangle)]").skip(1) {
            let start = text.find("extern \"C\" fn ").unwrap() + "extern \"C\" fn ".len();
            let (name, rest) = text[start..].split_once('(').unwrap();
            all.push((name, Some(&rest[..rest.find("\n}\n").unwrap()])));
        }
        let lines = text
            .lines()
            .filter_map(|line| line.strip_prefix("    fn fmi").map(|_| &line[7..]));
        rows.extend(lines.map(|line| (line.split_once('(').unwrap().0, None)));
    }
    all.extend(rows);
    all
}

#[test]
fn issue_029_every_exported_function_is_guarded_and_known_to_these_tests() {
    // The standard's headers have so many.
    for (version, count) in [(Version::Two, 44), (Version::Three, 75)] {
        let functions = exported(version);
        assert_eq!(functions.len(), count);
        for (name, body) in functions {
            // A row of the macro is called by its name, whatever it does.
            let Some(body) = body else {
                let guard = "unsafe { $crate::component::call(stringify!($name), instance,";
                assert!(include_str!("../../src/component.rs").contains(guard));
                continue;
            };
            let made = ["make(", "instantiate("].iter().any(|way| body.contains(way));
            let made = made && body.contains(&format!("\"{name}\""));
            let constant = body.contains("c\"") && !body.contains("unsafe");
            let freed = name.ends_with("FreeInstance") && body.contains("free(");
            assert!(made || constant || freed, "{name} is not guarded: {body}");
        }
    }
}

/// Tests of instances run one after the other: an instance may come to lie where a freed one of another test
/// was.
static ALONE: Mutex<()> = Mutex::new(());

/// The messages of an importer's log: status, category, text.
#[derive(Default)]
struct Log(Mutex<Vec<(i32, String, String)>>);

impl Log {
    fn environment(&self) -> *mut c_void {
        std::ptr::from_ref(self).cast_mut().cast()
    }

    fn note(&self, status: i32, category: *const c_char, text: *const c_char) {
        let [category, text] =
            [category, text].map(|text| unsafe { CStr::from_ptr(text) }.to_str().unwrap().to_owned());
        self.0.lock().unwrap().push((status, category, text));
    }

    fn take(&self) -> Vec<(i32, String, String)> {
        std::mem::take(&mut self.0.lock().unwrap())
    }
}

/// The folder `resources` of a wedge's FMU, its token, and references of variables of each kind.
struct Fmu {
    folder: tempfile::TempDir,
    token: CString,
    names: Names,
}

/// References.
#[derive(Clone, Copy)]
struct Names {
    input: u32,
    longitudinal: u32,
    output: u32,
    mass: u32,
    mode: u32,
    option: u32,
    truth: u32,
    states: usize,
    indicators: usize,
}

impl Fmu {
    fn new(version: Version) -> Self {
        let case = builtin::case("cdrun_toe_out_0.2_psi_0.012").unwrap();
        let description = Description::new(&Source::Wedge(Box::new(case))).unwrap();
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join(fmi::source::CASE), &description.files[0].1).unwrap();
        std::fs::write(folder.path().join(resources::MODEL), "FrictionWedge\n").unwrap();
        let find = |name: &str| {
            let variable = description
                .variables
                .iter()
                .find(|variable| variable.name == name);
            variable.unwrap().reference
        };
        Self {
            names: Names {
                input: find("bolster_z"),
                longitudinal: find("bolster_x"),
                output: find("force_on_bolster_z"),
                mass: find("wedge_mass"),
                mode: find("column_lower_right_state"),
                option: find("coil_mode"),
                truth: find("derive_rates"),
                states: description.entries.states.len(),
                indicators: description.entries.indicators.len(),
            },
            token: CString::new(description.token(version)).unwrap(),
            folder,
        }
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }
}

/// A call of a function.
type Call = Box<dyn Fn(*mut c_void) -> i32>;

/// Calls of a function: what is about them, whether they are refused in every phase, and how they go.
struct Row {
    name: &'static str,
    calls: Vec<(&'static str, Call)>,
}

/// `row!(function: "about" => |instance| call, ...)`; those about which is begun with `!` must be refused
/// wherever they are made.
macro_rules! row {
    ($name:ident: $($about:literal => |$instance:ident| $call:expr),+ $(,)?) => {
        crate::Row {
            name: stringify!($name),
            calls: vec![$(($about, Box::new(move |$instance| {
                #[allow(unused_unsafe)]
                unsafe { $call }
            }) as crate::Call)),+],
        }
    };
}
pub(crate) use row;

/// The functions that are never refused: they do nothing that could fail.
const NEVER_REFUSED: [&str; 3] = ["fmi2Reset", "fmi3Reset", "fmi3EvaluateDiscreteStates"];

/// The functions by which a version makes instances, saves and restores them.
struct Driver<'d> {
    version: Version,
    rows: &'d [Row],
    log: &'d Log,
    save: &'d dyn Fn(*mut c_void) -> *mut c_void,
    restore: &'d dyn Fn(*mut c_void, *mut c_void) -> i32,
    /// Functions that these rows need not have.
    others: &'d [&'d str],
}

impl Driver<'_> {
    /// Returns whether the rows have all functions that are exported.
    fn check_names(&self) {
        let own: BTreeSet<&str> = self
            .rows
            .iter()
            .map(|row| row.name)
            .chain(self.others.iter().copied())
            .collect();
        let exported: BTreeSet<&str> = exported(self.version).into_iter().map(|(name, _)| name).collect();
        assert_eq!(own, exported);
    }

    /// Makes all calls on an instance in some phase, from which it starts again after each; how many were
    /// refused, by function.
    fn drive(&self, instance: *mut c_void, phase: &str, refused: &mut BTreeSet<&'static str>) {
        let here = (self.save)(instance);
        assert!(!here.is_null());
        for Row { name, calls } in self.rows {
            for (about, call) in calls {
                self.log.take();
                let status = call(instance);
                let said = self.log.take();
                assert!(
                    (OK..=ERROR).contains(&status),
                    "{name} ({about}) in {phase}: {status}"
                );
                if status > WARNING {
                    refused.insert(name);
                    let Some((level, category, text)) = said.last() else {
                        panic!("{name} ({about}) in {phase}: {status} without a message")
                    };
                    assert_eq!(*level, status, "{name} ({about}) in {phase}: {text}");
                    let wanted = if status == DISCARD {
                        "logStatusDiscard"
                    } else {
                        "logStatusError"
                    };
                    assert_eq!(category, wanted, "{name} ({about}) in {phase}: {text}");
                    let why = text.strip_prefix(name).and_then(|text| text.strip_prefix(": "));
                    assert!(
                        why.is_some_and(|why| (20..1000).contains(&why.len())),
                        "{name} ({about}) in {phase}: {text}"
                    );
                }
                assert!(
                    !about.starts_with('!') || status > WARNING,
                    "{name} ({about}) in {phase} was not refused"
                );
                assert_eq!((self.restore)(instance, here), OK, "{name} ({about}) in {phase}");
            }
        }
    }

    /// Calls without an instance, and with one that is none, are errors; there is no logger.
    fn drive_nobody(&self, freed: *mut c_void) {
        let mut nothing = [0_u64; 64];
        for instance in [null_mut(), freed, nothing.as_mut_ptr().cast()] {
            for Row { name, calls } in self.rows {
                for (about, call) in calls {
                    assert_eq!(call(instance), ERROR, "{name} ({about}) without an instance");
                }
            }
        }
        assert!(self.log.take().is_empty());
    }

    /// Returns whether all functions were refused at least once, except those that cannot be.
    fn check_refused(&self, refused: &BTreeSet<&'static str>) {
        for Row { name, .. } in self.rows {
            let never = NEVER_REFUSED.contains(name);
            assert_eq!(!refused.contains(name), never, "{name}");
        }
    }
}
