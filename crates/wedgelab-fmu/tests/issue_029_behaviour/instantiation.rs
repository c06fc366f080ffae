//! Instances that cannot be made: null, and a reason for the logger that was given.

use std::ffi::{CStr, CString, c_char, c_void};
use std::fs;
use std::ptr::null;

use fmi::description::Version;
use fmi::{limits, resources};
use wedgelab_fmu::fmi3::*;

use super::{ALONE, ERROR, Fmu, Log, three};

/// Returns the path of the folder `resources`.
pub fn path_of(fmu: &Fmu) -> CString {
    CString::new(fmu.path().to_str().unwrap()).unwrap()
}

/// Returns whether an instance is refused with one message, by this function and with these words.
fn refused(log: &Log, made: *mut c_void, function: &str, words: &str) {
    assert!(made.is_null(), "{function} ({words}) made one");
    let said = log.take();
    let [(status, category, text)] = &said[..] else {
        panic!("{function} ({words}): {said:?}")
    };
    assert_eq!((*status, category.as_str()), (ERROR, "logStatusError"), "{text}");
    assert!(
        text.starts_with(&format!("{function}: ")) && text.contains(words),
        "{words}: {text}"
    );
    assert!(text.len() < 1000, "{text}");
}

type Texts<'t> = [*const c_char; 3];

/// Names, tokens and folders with which there is no instance, and what is said of each.
fn wrong(fmu: &Fmu, good: &CStr) -> Vec<(Texts<'static>, &'static str)> {
    // They live as long as the test.
    let leak = |text: &CStr| -> *const c_char { Box::leak(text.to_owned().into_boxed_c_str()).as_ptr() };
    let (name, token, folder) = (leak(c"wedge"), leak(&fmu.token), leak(good));
    vec![
        (
            [null(), token, folder],
            "the pointer to the instance's name is null",
        ),
        ([name, null(), folder], "is null"),
        ([name, token, null()], "is null"),
        (
            [c"\xff".as_ptr(), token, folder],
            "the instance's name is not UTF-8",
        ),
        (
            [name, c"{00000000}".as_ptr(), folder],
            "the token {00000000} is not that of this FMU",
        ),
        ([name, c"".as_ptr(), folder], "is not that of this FMU"),
        ([name, token, c"".as_ptr()], "cannot be read"),
        (
            [name, token, c"/there/is/no/folder".as_ptr()],
            "the FMU's unpacked `resources`",
        ),
    ]
}

#[test]
fn issue_029_an_instance_of_fmi_3_that_cannot_be_made_says_why() {
    let _alone = ALONE.lock();
    let (fmu, log) = (Fmu::new(Version::Three), Log::default());
    let path = path_of(&fmu);
    let (environment, note) = (log.environment(), Some(three::note as _));
    // Whether logging is on or off.
    for logging in [false, true] {
        let exchange = |[name, token, folder]: Texts<'_>, note: LogMessage| unsafe {
            fmi3InstantiateModelExchange(name, token, folder, false, logging, environment, note)
        };
        let steps =
            |[name, token, folder]: Texts<'_>, event_mode: bool, required: usize, note: LogMessage| unsafe {
                fmi3InstantiateCoSimulation(
                    name,
                    token,
                    folder,
                    false,
                    logging,
                    event_mode,
                    false,
                    null(),
                    required,
                    environment,
                    note,
                    None,
                )
            };
        for (texts, words) in wrong(&fmu, &path) {
            refused(&log, exchange(texts, note), "fmi3InstantiateModelExchange", words);
            refused(
                &log,
                steps(texts, false, 0, note),
                "fmi3InstantiateCoSimulation",
                words,
            );
            assert!(exchange(texts, None).is_null() && log.take().is_empty());
        }
        let good = [c"wedge".as_ptr(), fmu.token.as_ptr(), path.as_ptr()];
        refused(
            &log,
            steps(good, true, 0, note),
            "fmi3InstantiateCoSimulation",
            "no event mode in co-simulation",
        );
        refused(
            &log,
            steps(good, false, 1, note),
            "fmi3InstantiateCoSimulation",
            "no intermediate updates",
        );
        let [name, token, folder] = good;
        let scheduled = unsafe {
            fmi3InstantiateScheduledExecution(
                name,
                token,
                folder,
                false,
                logging,
                environment,
                note,
                None,
                None,
                None,
            )
        };
        refused(
            &log,
            scheduled,
            "fmi3InstantiateScheduledExecution",
            "no scheduled execution",
        );
    }
    // Files that fill the memory: refused before they are read.
    for (file, bytes) in [
        (fmi::source::CASE, limits::TEXT_FILE),
        (resources::MODEL, limits::MODEL_FILE),
    ] {
        let fmu = Fmu::new(Version::Three);
        let written = fs::OpenOptions::new()
            .write(true)
            .open(fmu.path().join(file))
            .unwrap();
        written.set_len(bytes + 1).unwrap();
        let path = path_of(&fmu);
        let made = unsafe {
            fmi3InstantiateModelExchange(
                c"wedge".as_ptr(),
                fmu.token.as_ptr(),
                path.as_ptr(),
                false,
                false,
                environment,
                note,
            )
        };
        refused(
            &log,
            made,
            "fmi3InstantiateModelExchange",
            "are read; the folder given",
        );
    }
    // Of a text that is too long for importers the end is left out.
    let long = CString::new("x".repeat(100_000)).unwrap();
    let made = unsafe {
        fmi3InstantiateModelExchange(
            c"wedge".as_ptr(),
            long.as_ptr(),
            path.as_ptr(),
            false,
            false,
            environment,
            note,
        )
    };
    refused(&log, made, "fmi3InstantiateModelExchange", "x ... x");
}

#[cfg(not(all(target_vendor = "apple", target_arch = "aarch64")))]
#[test]
fn issue_029_an_instance_of_fmi_2_that_cannot_be_made_says_why() {
    use super::two::{callbacks, uri};
    use wedgelab_fmu::fmi2::{CallbackFunctions, fmi2Instantiate};

    let _alone = ALONE.lock();
    let (fmu, log) = (Fmu::new(Version::Two), Log::default());
    let folder = uri(&fmu);
    let logged = callbacks(&log);
    let silent = CallbackFunctions {
        logger: None,
        ..logged
    };
    for logging in [0, 1] {
        let make = |[name, token, folder]: Texts<'_>, kind: i32, functions: *const CallbackFunctions| unsafe {
            fmi2Instantiate(name, kind, token, folder, functions, 0, logging)
        };
        let more = [
            (c"ftp://somewhere/else", "is no URI of a folder on this machine"),
            (c"file:///%zz", "is no URI"),
            // In FMI 2.0 a single sign of this kind has a meaning of its own.
            (c"file:///there/is/no#1", "no##1"),
        ];
        let more =
            more.map(|(folder, words)| ([c"wedge".as_ptr(), fmu.token.as_ptr(), folder.as_ptr()], words));
        for (texts, words) in wrong(&fmu, &folder).into_iter().chain(more) {
            for kind in [0, 1] {
                refused(&log, make(texts, kind, &logged), "fmi2Instantiate", words);
                assert!(make(texts, kind, &silent).is_null() && make(texts, kind, null()).is_null());
            }
        }
        let good = [c"wedge".as_ptr(), fmu.token.as_ptr(), folder.as_ptr()];
        refused(
            &log,
            make(good, 7, &logged),
            "fmi2Instantiate",
            "there is no kind 7 of FMUs",
        );
    }
    assert!(log.take().is_empty());
}
