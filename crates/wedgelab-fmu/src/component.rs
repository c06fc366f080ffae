//! Instances behind pointers, and the way of every call: pointer, instance, status, log.

use std::any::Any;
use std::ffi::{CStr, CString, c_char, c_void};
use std::panic::{AssertUnwindSafe, catch_unwind};

use fmi::instance::{Instance, Message, Saved};
use fmi::{Category, Error, Severity};

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

/// Where messages go.
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
    /// Whether anything is logged.
    pub logging: bool,
    /// Which categories are logged.
    pub categories: [bool; 3],
    /// A call has panicked: what is inside may be inconsistent.
    pub broken: bool,
}

/// A saved state behind a pointer.
pub(crate) type SavedState = Saved;

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
            categories: [true; 3],
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
        let mut categories = [names.is_empty(); 3];
        for name in names {
            match Category::ALL.iter().position(|category| category.name() == *name) {
                Some(place) => categories[place] = true,
                None => {
                    let known = Category::ALL.map(Category::name).join(", ");
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

    fn wants(&self, message: &Message) -> bool {
        // What is refused or has failed is always said.
        message.severity == Severity::Error || (self.logging && self.categories[index(message.category)])
    }
}

/// What was thrown, in words.
fn words(panic: &(dyn Any + Send)) -> String {
    let text = panic
        .downcast_ref::<&str>()
        .map(|text| (*text).to_owned())
        .or_else(|| panic.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "no message".to_owned());
    format!("internal error, please report it: {text}; the instance cannot be used any more")
}

/// Runs something that belongs to no instance; what it throws is an error without a message.
pub(crate) fn guard<T>(otherwise: T, run: impl FnOnce() -> T) -> T {
    catch_unwind(AssertUnwindSafe(run)).unwrap_or(otherwise)
}

/// Runs a call on the instance behind a pointer.
///
/// # Safety
/// `pointer` is null or comes from [`hand_out`], has not been freed, and is used by no other thread at the same time: the standard asks
/// importers for that.
pub(crate) unsafe fn call(
    pointer: *mut c_void,
    run: impl FnOnce(&mut Component) -> Result<Status, Error>,
) -> Status {
    if pointer.is_null() {
        return ERROR;
    }
    let component = pointer.cast::<Component>();
    let (status, messages, logger, name) = {
        // SAFETY: by this function's contract the pointer is one of a living component that nobody else uses now; the reference ends with
        // this block, before the importer's logger runs, which may call the instance again.
        let component = unsafe { &mut *component };
        let mut failure = None;
        let status = if component.broken {
            failure = Some("the instance has failed inside and cannot be used any more".to_owned());
            ERROR
        } else {
            match catch_unwind(AssertUnwindSafe(|| run(component))) {
                Ok(Ok(status)) => status,
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
        messages.extend(failure.map(|text| Message {
            severity: Severity::Error,
            category: Category::Error,
            text,
        }));
        messages.retain(|message| component.wants(message));
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

/// Gives a message to an importer.
///
/// # Safety
/// The logger is null or a function of the type that its version asks for.
pub(crate) unsafe fn log(logger: Logger, name: &CStr, message: &Message) {
    let status = match message.severity {
        Severity::Error => ERROR,
        Severity::Warning if message.category == Category::Events => OK,
        Severity::Warning => WARNING,
    };
    let category = CString::new(message.category.name()).unwrap_or_default();
    let text = CString::new(message.text.replace('\0', "")).unwrap_or_default();
    match logger {
        Logger::None => {}
        // SAFETY: by this function's contract; all pointers are of strings that outlive the call. The text is an argument of a format,
        // since it may hold signs of per cent.
        Logger::Two(logger, environment) => unsafe {
            logger(
                environment,
                name.as_ptr(),
                status,
                category.as_ptr(),
                c"%s".as_ptr(),
                text.as_ptr(),
            );
        },
        // SAFETY: as above; here the text is taken as it is.
        Logger::Three(logger, environment) => unsafe {
            logger(environment, status, category.as_ptr(), text.as_ptr());
        },
    }
}

/// A pointer for something that C keeps.
pub(crate) fn hand_out<T>(thing: T) -> *mut c_void {
    Box::into_raw(Box::new(thing)).cast()
}

/// Frees what [`hand_out`] gave.
///
/// # Safety
/// `pointer` is null or comes from [`hand_out`] with the same type, and is not used again.
pub(crate) unsafe fn take_back<T>(pointer: *mut c_void) {
    if !pointer.is_null() {
        // SAFETY: by this function's contract.
        drop(unsafe { Box::from_raw(pointer.cast::<T>()) });
    }
}

fn missing(what: &str) -> Error {
    Error::new(format!("the pointer to {what} is null (or not aligned)"))
}

/// What C means by a pointer and a count.
///
/// # Safety
/// A pointer that is not null points to so many values, which nobody changes while the slice lives.
pub(crate) unsafe fn slice<'a, T>(pointer: *const T, count: usize, what: &str) -> Result<&'a [T], Error> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(missing(what));
    }
    // SAFETY: by this function's contract, and neither null nor misaligned.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// The same to be written to.
///
/// # Safety
/// A pointer that is not null points to so many values, which nobody else uses while the slice lives.
pub(crate) unsafe fn slice_mut<'a, T>(
    pointer: *mut T,
    count: usize,
    what: &str,
) -> Result<&'a mut [T], Error> {
    if count == 0 {
        return Ok(&mut []);
    }
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(missing(what));
    }
    // SAFETY: by this function's contract, and neither null nor misaligned.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// Writes one value.
///
/// # Safety
/// A pointer that is not null may be written to.
pub(crate) unsafe fn put<T>(pointer: *mut T, value: T, what: &str) -> Result<(), Error> {
    if pointer.is_null() || !pointer.is_aligned() {
        return Err(missing(what));
    }
    // SAFETY: by this function's contract, and neither null nor misaligned.
    unsafe { pointer.write(value) };
    Ok(())
}

/// A string from C.
///
/// # Safety
/// A pointer that is not null points to a string that ends with a zero byte and lives as long as the reference.
pub(crate) unsafe fn string<'a>(pointer: *const c_char, what: &str) -> Result<&'a str, Error> {
    if pointer.is_null() {
        return Err(missing(what));
    }
    // SAFETY: by this function's contract.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str()
        .map_err(|_| Error::new(format!("{what} is not UTF-8")))
}

/// Names of log categories from C.
///
/// # Safety
/// As [`slice`] and [`string`].
pub(crate) unsafe fn strings<'a>(
    pointer: *const *const c_char,
    count: usize,
    what: &str,
) -> Result<Vec<&'a str>, Error> {
    // SAFETY: by this function's contract.
    let pointers = unsafe { slice(pointer, count, what) }?;
    pointers
        .iter()
        // SAFETY: by this function's contract.
        .map(|pointer| unsafe { string(*pointer, what) })
        .collect()
}

/// Reads as many variables as there are references.
pub(crate) fn read<T>(
    references: &[u32],
    out: &mut [T],
    mut get: impl FnMut(u32) -> Result<T, Error>,
) -> Result<Status, Error> {
    for (reference, target) in references.iter().zip(out) {
        *target = get(*reference)?;
    }
    Ok(OK)
}

/// Sets as many variables as there are references: all of them, or none if one cannot be set.
pub(crate) fn write<T: Copy>(
    instance: &mut Instance,
    references: &[u32],
    values: &[T],
    check: impl Fn(&Instance, u32, T) -> Result<(), Error>,
    set: impl Fn(&mut Instance, u32, T) -> Result<(), Error>,
) -> Result<Status, Error> {
    for (reference, value) in references.iter().zip(values) {
        check(instance, *reference, *value)?;
    }
    for (reference, value) in references.iter().zip(values) {
        set(instance, *reference, *value)?;
    }
    Ok(OK)
}

/// No variable has a type: only no references at all are right.
pub(crate) fn none_of(count: usize, what: &str) -> Result<Status, Error> {
    if count == 0 {
        return Ok(OK);
    }
    Err(Error::new(format!("the FMU has no variables of the type {what}")))
}

/// Saves the instance's state where `target` points to, into what is there already or anew.
///
/// # Safety
/// `target` is null or points to null or to a state from here that has not been freed.
pub(crate) unsafe fn save(component: &Component, target: *mut *mut c_void) -> Result<Status, Error> {
    // SAFETY: by this function's contract.
    let [place] = (unsafe { slice_mut(target, 1, "the state") })? else {
        return Err(missing("the state"));
    };
    let saved: SavedState = component.instance.save();
    if place.is_null() {
        *place = hand_out(saved);
    } else {
        // SAFETY: by this function's contract it is a state from here.
        unsafe { *place.cast::<SavedState>() = saved };
    }
    Ok(OK)
}

/// The saved state behind a pointer.
///
/// # Safety
/// `pointer` is null or a state from [`save`] that has not been freed.
pub(crate) unsafe fn saved<'a>(pointer: *mut c_void) -> Result<&'a SavedState, Error> {
    // SAFETY: by this function's contract.
    unsafe { pointer.cast::<SavedState>().as_ref() }.ok_or_else(|| missing("the state"))
}

/// Frees a saved state and sets its pointer to null.
///
/// # Safety
/// As [`save`].
pub(crate) unsafe fn free_saved(target: *mut *mut c_void) -> Result<Status, Error> {
    if target.is_null() {
        return Ok(OK);
    }
    // SAFETY: by this function's contract.
    unsafe {
        take_back::<SavedState>(*target);
        *target = std::ptr::null_mut();
    }
    Ok(OK)
}

/// Writes a saved state as bytes.
///
/// # Safety
/// As [`saved`] and [`slice_mut`].
pub(crate) unsafe fn serialize(state: *mut c_void, target: *mut u8, size: usize) -> Result<Status, Error> {
    // SAFETY: by this function's contract.
    let bytes = unsafe { saved(state) }?.to_bytes()?;
    if size < bytes.len() {
        return Err(Error::new(format!(
            "room for {size} bytes of a state that takes {}",
            bytes.len()
        )));
    }
    // SAFETY: by this function's contract.
    let target = unsafe { slice_mut(target, size, "the bytes") }?;
    let (head, tail) = target.split_at_mut(bytes.len());
    head.copy_from_slice(&bytes);
    // Blanks after JSON mean nothing.
    tail.fill(b' ');
    Ok(OK)
}

/// Reads a saved state from bytes.
///
/// # Safety
/// As [`slice`] and [`save`].
pub(crate) unsafe fn deserialize(
    bytes: *const u8,
    size: usize,
    target: *mut *mut c_void,
) -> Result<Status, Error> {
    // SAFETY: by this function's contract.
    let bytes = unsafe { slice(bytes, size, "the bytes") }?;
    let state = SavedState::from_bytes(bytes)?;
    // SAFETY: by this function's contract. What the place held before is not freed: it may be uninitialized.
    unsafe {
        let state = hand_out(state);
        if let Err(error) = put(target, state, "the state") {
            take_back::<SavedState>(state);
            return Err(error);
        }
    }
    Ok(OK)
}
