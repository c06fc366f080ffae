//! Instances behind pointers, and the way of every call: pointer, instance, status, log.

use std::any::Any;
use std::ffi::{CStr, CString, c_char, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};

use fmi::instance::{Instance, Message};
use fmi::{Category, Error, Severity};

use crate::handles::{HandleKind, hand_out, is_alive, take_back};
use crate::pointers::{slice, slice_mut, string};

/// Status codes, the same in both versions.
pub(crate) type Status = i32;
/// All well.
pub(crate) const OK: Status = 0;
/// Done, with a remark.
pub(crate) const WARNING: Status = 1;
/// Not possible, without harm.
pub(crate) const DISCARD: Status = 2;
/// Refused or failed.
pub(crate) const ERROR: Status = 3;

/// The importer's logger in FMI 2.0. The message is a format of `printf`.
pub(crate) type Logger2 =
    unsafe extern "C" fn(*mut c_void, *const c_char, Status, *const c_char, *const c_char, ...);
/// The importer's logger in FMI 3.0.
pub(crate) type Logger3 = unsafe extern "C" fn(*mut c_void, Status, *const c_char, *const c_char);

/// The destination of messages.
#[derive(Clone, Copy)]
pub(crate) enum Logger {
    /// Nowhere.
    None,
    /// To a logger of FMI 2.0 with its environment.
    Two(Logger2, *mut c_void),
    /// To a logger of FMI 3.0 with its environment.
    Three(Logger3, *mut c_void),
}

/// An instance behind a pointer.
pub(crate) struct Component {
    pub instance: Instance,
    pub logger: Logger,
    /// The instance's name, as it was given.
    pub name: CString,
    /// True if anything is logged.
    pub logging: bool,
    /// The categories that are logged.
    pub categories: [bool; Category::ALL.len()],
    /// The question that a call could not answer, to be logged.
    unanswered: Option<String>,
    /// A call has panicked: what is inside may be inconsistent.
    pub broken: bool,
}

fn index(category: Category) -> usize {
    Category::ALL.iter().position(|one| *one == category).unwrap_or(0)
}

impl Component {
    pub fn new(instance: Instance, logger: Logger, name: &str, logging: bool) -> Self {
        let mut component = Self {
            instance,
            logger,
            // A name from C holds no zero byte.
            name: CString::new(name).unwrap_or_default(),
            logging,
            categories: [true; Category::ALL.len()],
            unanswered: None,
            broken: false,
        };
        component.follow_logging();
        component
    }

    /// Tells the instance whether events are worth noting.
    pub fn follow_logging(&mut self) {
        let on = self.logging && self.categories[index(Category::Events)];
        self.instance.log_events(on);
    }

    /// Switches logging, of some categories or (with none named) of all.
    pub fn set_logging(&mut self, on: bool, names: &[&str]) -> Result<(), Error> {
        let mut categories = [names.is_empty(); Category::ALL.len()];
        for name in names {
            match Category::ALL.iter().position(|category| category.name() == *name) {
                Some(place) => categories[place] = true,
                None => {
                    let known = Category::ALL.map(Category::name).join(", ");
                    let name: String = name.chars().take(40).collect();
                    return Err(Error::new(format!(
                        "there is no log category `{name}`; there are {known}"
                    )));
                }
            }
        }
        if on {
            self.logging = true;
            self.categories = categories;
        } else if names.is_empty() {
            self.logging = false;
        } else {
            for (own, off) in self.categories.iter_mut().zip(categories) {
                *own &= !off;
            }
        }
        self.follow_logging();
        Ok(())
    }

    /// Returns the answer to a question to which there is none, and why there is none.
    pub fn discard(&mut self, why: &str) -> Result<Status, Error> {
        self.unanswered = Some(why.to_owned());
        Ok(DISCARD)
    }

    fn wants(&self, message: &Message) -> bool {
        // What is refused, has failed or is doubtful is always said.
        matches!(
            message.category,
            Category::Error | Category::Discard | Category::Warning
        ) || (self.logging && self.categories[index(message.category)])
    }
}

/// Returns the message of a panic.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".to_owned());
    format!(
        "internal error, please report it: {text}; free this instance, if there is one, and make another one"
    )
}

/// Runs something that belongs to no instance and tells nothing; nothing that it throws leaves the library.
pub(crate) fn guard(run: impl FnOnce()) {
    drop(catch_unwind(AssertUnwindSafe(run)));
}

/// Returns a message of what was refused, with the name of the function that was called.
fn refusal(function: &str, severity: Severity, why: &str) -> Message {
    let category = match severity {
        Severity::Discard => Category::Discard,
        Severity::Warning | Severity::Error => Category::Error,
    };
    Message {
        severity,
        category,
        text: format!("{function}: {why}"),
    }
}

/// Makes an instance behind a pointer; null, with a message for the importer's logger, if it cannot be made.
///
/// # Safety
/// As [`string`] for the name, and as [`log`] for the logger.
pub(crate) unsafe fn instantiate(
    function: &'static str,
    logger: Logger,
    name: *const c_char,
    logging: bool,
    make: impl FnOnce(&str) -> Result<Instance, Error>,
) -> *mut c_void {
    // SAFETY: by this function's contract.
    let name = unsafe { string(name, "the instance's name") };
    let made = catch_unwind(AssertUnwindSafe(|| {
        let name = name.clone()?;
        Ok(Component::new(make(name)?, logger, name, logging))
    }));
    let error = match made {
        Ok(Ok(component)) => return hand_out(component, HandleKind::Instance),
        Ok(Err(error)) => error,
        Err(panic) => Error::new(words(&*panic)),
    };
    let name = CString::new(name.unwrap_or_default()).unwrap_or_default();
    let message = refusal(function, Severity::Error, &error.message);
    // SAFETY: by this function's contract.
    unsafe { log(logger, &name, &message) };
    std::ptr::null_mut()
}

/// Frees an instance; what is none is left alone.
///
/// # Safety
/// Nobody uses the instance at the same time.
pub(crate) unsafe fn free(pointer: *mut c_void) {
    guard(|| {
        // SAFETY: by this function's contract; instances are components.
        let _ = unsafe { take_back::<Component>(pointer, HandleKind::Instance) };
    });
}

/// What a call gives back where nothing is wrong.
pub(crate) trait Answer {
    /// Returns the status of it.
    fn status(self) -> Status;
}

impl Answer for Status {
    fn status(self) -> Status {
        self
    }
}

impl Answer for () {
    fn status(self) -> Status {
        OK
    }
}

/// Defines functions of the C interface, each with its arguments after the instance and what it does with the
/// [`Component`] there.
macro_rules! functions {
    ($(
        $(#[$about:meta])*
        fn $name:ident($($argument:ident: $type:ty),* $(,)?) |$component:pat_param| $run:expr;
    )*) => {$(
        $(#[$about])*
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: *mut c_void, $($argument: $type),*) -> Status {
            // SAFETY: the standard's contract, which the documentation of the module repeats.
            unsafe { $crate::component::call(stringify!($name), instance, |$component| $run) }
        }
    )*};
}
pub(crate) use functions;

/// Runs a call of a function on the instance behind a pointer. Without an instance there is no logger to tell
/// that to: it is an error, and nothing else.
///
/// # Safety
/// The instance behind `pointer` is used by no other thread at the same time: the standard asks importers for
/// that.
pub(crate) unsafe fn call<A: Answer>(
    function: &'static str,
    pointer: *mut c_void,
    run: impl FnOnce(&mut Component) -> Result<A, Error>,
) -> Status {
    if !is_alive(pointer, HandleKind::Instance) {
        return ERROR;
    }
    let component = pointer.cast::<Component>();
    let (status, messages, logger, name) = {
        // SAFETY: the component is alive, and by this function's contract nobody else uses it now; the
        // reference ends with this block, before the importer's logger runs, which may call the instance
        // again.
        let component = unsafe { &mut *component };
        let mut failure = None;
        let status = if component.broken {
            let why =
                "the instance has failed inside and cannot be used any more: free it and make another one";
            failure = Some(why.to_owned());
            ERROR
        } else {
            match catch_unwind(AssertUnwindSafe(|| run(component))) {
                Ok(Ok(answer)) => answer.status(),
                Ok(Err(error)) => {
                    failure = Some(error.message);
                    ERROR
                }
                Err(panic) => {
                    component.broken = true;
                    failure = Some(words(&*panic));
                    ERROR
                }
            }
        };
        let mut messages = component.instance.take_log();
        let unanswered = component.unanswered.take();
        messages.extend(unanswered.map(|why| refusal(function, Severity::Discard, &why)));
        messages.extend(failure.map(|why| refusal(function, Severity::Error, &why)));
        messages.retain(|message| component.wants(message));
        let is_doubtful = messages
            .iter()
            .any(|message| message.category == Category::Warning);
        let status = if is_doubtful { status.max(WARNING) } else { status };
        if messages.is_empty() {
            return status;
        }
        (status, messages, component.logger, component.name.clone())
    };
    for message in &messages {
        // SAFETY: the logger is that of the component, given by its importer to be called at any time.
        unsafe { log(logger, &name, message) };
    }
    status
}

/// Importers may have room for a thousand bytes only: the rest of longer texts is left out.
const LONGEST_TEXT: usize = 960;

/// Returns a text as C takes it: without zero bytes, and not longer than importers can bear.
fn text_of(text: &str) -> CString {
    let mut text = text.replace('\0', "");
    if text.len() > LONGEST_TEXT {
        text.truncate(text.floor_char_boundary(LONGEST_TEXT));
        text.push_str(" ... (cut off)");
    }
    CString::new(text).unwrap_or_default()
}

/// Gives a message to an importer.
///
/// # Safety
/// The logger is null or a function of the type that its version asks for.
pub(crate) unsafe fn log(logger: Logger, name: &CStr, message: &Message) {
    let status = match message.severity {
        Severity::Error => ERROR,
        Severity::Discard => DISCARD,
        Severity::Warning if message.category == Category::Events => OK,
        Severity::Warning => WARNING,
    };
    let category = CString::new(message.category.name()).unwrap_or_default();
    match logger {
        Logger::None => {}
        Logger::Two(logger, environment) => {
            // In FMI 2.0 a single # begins the reference of a variable.
            let text = text_of(&message.text.replace('#', "##"));
            // SAFETY: by this function's contract; all pointers are of strings that outlive the call. The
            // text is an argument of a format, since it may hold signs of per cent.
            unsafe {
                logger(
                    environment,
                    name.as_ptr(),
                    status,
                    category.as_ptr(),
                    c"%s".as_ptr(),
                    text.as_ptr(),
                );
            }
        }
        Logger::Three(logger, environment) => {
            let text = text_of(&message.text);
            // SAFETY: as above; here the text is taken as it is.
            unsafe { logger(environment, status, category.as_ptr(), text.as_ptr()) };
        }
    }
}

/// References of variables and their number.
pub(crate) type Referenced = (*const u32, usize);

/// Reads as many variables as there are references.
///
/// # Safety
/// As of the functions of the interface.
pub(crate) unsafe fn get<T>(
    component: &mut Component,
    (references, count): Referenced,
    values: *mut T,
    one: impl Fn(&mut Instance, u32) -> Result<T, Error>,
) -> Result<(), Error> {
    // SAFETY: by this function's contract.
    let (references, values) = unsafe {
        (
            slice(references, count, "the references")?,
            slice_mut(values, count, "the values")?,
        )
    };
    for (reference, value) in references.iter().zip(values) {
        *value = one(&mut component.instance, *reference)?;
    }
    Ok(())
}

/// Sets as many variables as there are references: all of them, or none if one cannot be set.
///
/// # Safety
/// As of the functions of the interface.
pub(crate) unsafe fn set<T: Copy>(
    component: &mut Component,
    (references, count): Referenced,
    values: *const T,
    check: impl Fn(&Instance, u32, T) -> Result<(), Error>,
    set: impl Fn(&mut Instance, u32, T) -> Result<(), Error>,
) -> Result<(), Error> {
    // SAFETY: by this function's contract.
    let (references, values) = unsafe {
        (
            slice(references, count, "the references")?,
            slice(values, count, "the values")?,
        )
    };
    for (reference, value) in references.iter().zip(values) {
        check(&component.instance, *reference, *value)?;
    }
    for (reference, value) in references.iter().zip(values) {
        set(&mut component.instance, *reference, *value)?;
    }
    Ok(())
}

/// Refuses a call.
pub(crate) fn refuse(why: &str) -> Result<(), Error> {
    Err(Error::new(why))
}

/// No variable has a type: only no references at all are right.
pub(crate) fn none_of(count: usize, what: &str) -> Result<(), Error> {
    if count == 0 {
        return Ok(());
    }
    Err(Error::new(format!(
        "the FMU has no variables of the type {what}: modelDescription.xml lists all there are"
    )))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, clippy::panic)]

    use std::sync::Mutex;

    use fmi::description::Version;
    use fmi::element::Interface;
    use fmi::source::FmuModel;
    use study::case::builtin;

    use super::*;

    static SAID: Mutex<Vec<(Status, String)>> = Mutex::new(Vec::new());

    unsafe extern "C" fn note(_: *mut c_void, status: Status, _: *const c_char, text: *const c_char) {
        // SAFETY: texts of messages are strings.
        let text = unsafe { CStr::from_ptr(text) }.to_str().unwrap().to_owned();
        SAID.lock().unwrap().push((status, text));
    }

    /// Neither out of a call nor out of the making of an instance.
    #[test]
    fn issue_029_panics_do_not_leave_the_library_and_are_reported() {
        let case = builtin::case("cdrun_toe_0_psi_0").unwrap();
        let make = |name: &str| {
            Instance::of_case(
                name,
                None,
                FmuModel::QuasiStatic,
                case.clone(),
                Version::Three,
                Interface::CoSimulation,
            )
        };
        let logger = Logger::Three(note, std::ptr::null_mut());
        let said = || std::mem::take(&mut *SAID.lock().unwrap());
        // SAFETY: the name is a string, and the logger is one; nobody else has the instance.
        unsafe {
            let none = instantiate("fmiMake", logger, c"wedge".as_ptr(), false, |_| {
                panic!("on purpose")
            });
            assert!(none.is_null());
            let [(ERROR, text)] = &said()[..] else {
                panic!("no message")
            };
            assert!(
                text.starts_with("fmiMake: internal error") && text.contains("on purpose"),
                "{text}"
            );

            let instance = instantiate("fmiMake", logger, c"wedge".as_ptr(), false, make);
            assert_eq!(call("fmiDo", instance, |_| Ok(OK)), OK);
            assert!(said().is_empty());
            assert_eq!(
                call::<Status>("fmiDo", instance, |_| panic!("{} purpose", "on")),
                ERROR
            );
            let [(ERROR, text)] = &said()[..] else {
                panic!("no message")
            };
            assert!(
                text.starts_with("fmiDo: internal error") && text.contains("on purpose"),
                "{text}"
            );
            // From then on it refuses everything, and says so.
            assert_eq!(call("fmiDo", instance, |_| Ok(OK)), ERROR);
            let [(ERROR, text)] = &said()[..] else {
                panic!("no message")
            };
            assert!(text.contains("free it and make another one"), "{text}");
            free(instance);
            assert_eq!(call("fmiDo", instance, |_| Ok(OK)), ERROR);
            assert!(said().is_empty());
        }
    }

    unsafe extern "C" fn keep(
        log: *mut c_void,
        status: Status,
        category: *const c_char,
        text: *const c_char,
    ) {
        // SAFETY: the environment is the list below, and texts are strings.
        let (log, category, text) = unsafe {
            let log = &mut *log.cast::<Vec<(Status, String, String)>>();
            (log, CStr::from_ptr(category), CStr::from_ptr(text))
        };
        let [category, text] = [category, text].map(|text| text.to_str().unwrap().to_owned());
        log.push((status, category, text));
    }

    /// Once, and the status of the call says so.
    #[test]
    fn issue_047_warnings_reach_the_logger_while_logging_is_off() {
        let case = builtin::case("cdrun_toe_0_psi_0").unwrap();
        let (two, side) = (Version::Two, Interface::CoSimulation);
        let make = |name: &str| Instance::of_case(name, None, FmuModel::Wedge, case, two, side);
        let mut log: Vec<(Status, String, String)> = Vec::new();
        let logger = Logger::Three(keep, std::ptr::from_mut(&mut log).cast());
        // SAFETY: the name is a string, and the logger is one; nobody else has the instance.
        let statuses: Vec<Status> = unsafe {
            let wedge = instantiate("fmiMake", logger, c"wedge".as_ptr(), false, make);
            let begin = |component: &mut Component| {
                component.instance.enter_initialization()?;
                component.instance.exit_initialization().map(|()| OK)
            };
            assert_eq!(call("fmiBegin", wedge, begin), OK);
            let step = |component: &mut Component, number: u32| {
                let instance = &mut component.instance;
                let variables = &instance.description().variables;
                let find = |name: &str| variables.iter().find(|own| own.name == name).unwrap().reference;
                let [position, rate] = ["bolster_z", "bolster_z_rate"].map(find);
                instance.set_float(position, 1e-4 * f64::from(number))?;
                instance.set_float(rate, 0.0)?;
                instance.do_step(instance.time(), 0.002).map(|()| OK)
            };
            let steps = (0..10).map(|number| call("fmiDoStep", wedge, |component| step(component, number)));
            let statuses = steps.collect();
            free(wedge);
            statuses
        };
        let [(WARNING, category, text)] = &log[..] else {
            panic!("{log:?}")
        };
        assert!(
            category == "logStatusWarning" && text.contains("`bolster_z`"),
            "{text}"
        );
        let warned = statuses.iter().filter(|status| **status == WARNING).count();
        assert!(
            warned == 1 && statuses.iter().all(|status| *status <= WARNING),
            "{statuses:?}"
        );
    }
}
