//! Stops commands at a signal: SIGINT (Ctrl-C), SIGTERM or SIGHUP, on Windows Ctrl-C.
//!
//! A command that writes calls [`listen`] before it does anything. From then on a signal ends the program at
//! once, without leaving a hidden folder, unless the command has said by [`stops`] that it ends
//! its work by itself when [`wanted`] says so. A second signal always ends the program at once. The exit code
//! is 128 and the signal's number, as shells have it.
//!
//! Signals come by tokio, which is there for the explorer, knows which signal came, and works on Windows too.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;

use staging::{Abandoned, abandon};
use study::summary::Stopped;

use crate::failure::say;

/// The reason in the summary of an interrupted run.
pub const REASON: &str = "interrupted";

/// The reaction of a command to a signal.
#[derive(Debug)]
struct Reaction {
    /// The message on a first signal if the command ends by itself.
    stop: Option<String>,
    /// The message about files kept when the program ends at once. Without it, all files that are in their
    /// place are whole results.
    kept: Option<String>,
}

static REACTION: Mutex<Reaction> = Mutex::new(Reaction {
    stop: None,
    kept: None,
});
/// True if the command is to end by itself.
static WANTED: AtomicBool = AtomicBool::new(false);
/// The exit code of the signal that came; 0 if none did.
static CODE: AtomicU8 = AtomicU8::new(0);

/// From now on a first signal asks the command to end by itself, and says `first`; a second one ends it and
/// says `kept`.
pub fn stops(first: &str, kept: &str) {
    set(Some(first), Some(kept));
}

/// As [`stops`], for a command whose single run stops and is written.
pub fn stops_run() {
    let first = "stopping: what was computed is written, marked as incomplete \
                 (once more: ends at once and writes nothing)";
    set(Some(first), None);
}

/// From now on a signal ends the program at once, and says what is kept.
pub fn ends(kept: &str) {
    set(None, Some(kept));
}

fn set(stop: Option<&str>, kept: Option<&str>) {
    *REACTION.lock().unwrap_or_else(PoisonError::into_inner) = Reaction {
        stop: stop.map(str::to_owned),
        kept: kept.map(str::to_owned),
    };
}

/// Returns whether the command is to end by itself, for those who look at it themselves.
pub fn flag() -> &'static AtomicBool {
    &WANTED
}

/// Returns whether the command is to end by itself.
pub fn wanted() -> bool {
    WANTED.load(Ordering::Relaxed)
}

/// Returns whether a run goes on after a step.
pub fn go_on() -> ControlFlow<String> {
    if wanted() {
        ControlFlow::Break(REASON.to_owned())
    } else {
        ControlFlow::Continue(())
    }
}

/// Returns whether this is why a run stopped.
pub fn is_reason(stopped: Option<&Stopped>) -> bool {
    stopped.is_some_and(|stopped| stopped.reason == REASON)
}

/// Returns the exit code of the signal that came, if one did.
pub fn code() -> Option<u8> {
    Some(CODE.load(Ordering::Relaxed)).filter(|code| *code != 0)
}

/// Begins to listen for signals. If that is not possible they do what they do to any program.
pub fn listen() {
    let (ready, started) = mpsc::channel();
    let listener = thread::Builder::new().name("signals".to_owned()).spawn(move || {
        let runtime = tokio::runtime::Builder::new_current_thread().enable_io().build();
        let Ok(runtime) = runtime else { return };
        runtime.block_on(async {
            let mut signals = signals::Signals::new();
            // Nobody waits any more only if the program ends.
            let _ = ready.send(());
            loop {
                react(signals.next().await);
            }
        });
    });
    if listener.is_ok() {
        // An error says that the thread has ended, without listening.
        let _ = started.recv();
    }
}

/// Does what a signal with this exit code asks for.
fn react(code: u8) {
    let reaction = REACTION.lock().unwrap_or_else(PoisonError::into_inner);
    CODE.store(code, Ordering::Relaxed);
    if let Some(text) = &reaction.stop
        && !WANTED.swap(true, Ordering::Relaxed)
    {
        say(text);
        return;
    }
    let abandoned = abandon();
    say(&message(reaction.kept.as_deref(), &abandoned));
    // Nothing is written until then: `abandoned` lives, and so does the lock on the reaction.
    std::process::exit(i32::from(code));
}

/// Returns the message of a program that ends at once.
fn message(kept: Option<&str>, abandoned: &Abandoned) -> String {
    match (kept, abandoned.placed()) {
        (Some(kept), _) => format!("{REASON}: {kept}"),
        (None, Some(folder)) => format!(
            "{REASON}: everything was written before, into {}",
            folder.display()
        ),
        (None, None) => format!("{REASON}: nothing was written. The same command begins anew."),
    }
}

#[cfg(unix)]
mod signals {
    use std::mem::MaybeUninit;
    use std::ptr;

    use tokio::signal::unix::{Signal, SignalKind, signal};

    /// The signals that are listened to.
    pub struct Signals {
        interrupt: Option<Signal>,
        terminate: Option<Signal>,
        hangup: Option<Signal>,
    }

    impl Signals {
        /// Begins to listen to those that the program was not started to ignore, as by `nohup`.
        pub fn new() -> Self {
            let of = |kind: SignalKind| {
                let heard = !is_ignored(kind.as_raw_value());
                heard.then(|| signal(kind).ok()).flatten()
            };
            Self {
                interrupt: of(SignalKind::interrupt()),
                terminate: of(SignalKind::terminate()),
                hangup: of(SignalKind::hangup()),
            }
        }

        /// Returns the exit code of the next signal.
        pub async fn next(&mut self) -> u8 {
            let kind = tokio::select! {
                () = received(&mut self.interrupt) => SignalKind::interrupt(),
                () = received(&mut self.terminate) => SignalKind::terminate(),
                () = received(&mut self.hangup) => SignalKind::hangup(),
            };
            128 + kind.as_raw_value() as u8
        }
    }

    async fn received(signal: &mut Option<Signal>) {
        let came = match signal {
            Some(signal) => signal.recv().await,
            None => None,
        };
        if came.is_none() {
            std::future::pending::<()>().await;
        }
    }

    /// Returns whether this program ignores a signal.
    #[allow(unsafe_code)]
    fn is_ignored(signal: i32) -> bool {
        let mut action = MaybeUninit::<libc::sigaction>::zeroed();
        // SAFETY: without a new action `sigaction` changes nothing; it writes the present one into memory
        // that is large enough. Its fields are numbers and addresses, for which zeros are values. No safe
        // function of the standard library or of a crate in use asks this.
        let action = unsafe {
            let asked = libc::sigaction(signal, ptr::null(), action.as_mut_ptr());
            (asked == 0).then(|| action.assume_init())
        };
        action.is_some_and(|action| action.sa_sigaction == libc::SIG_IGN)
    }
}

#[cfg(not(unix))]
mod signals {
    /// Ctrl-C.
    pub struct Signals;

    impl Signals {
        /// Begins to listen.
        pub fn new() -> Self {
            Self
        }

        /// Returns the exit code of the next signal.
        pub async fn next(&mut self) -> u8 {
            if tokio::signal::ctrl_c().await.is_err() {
                std::future::pending::<()>().await;
            }
            130
        }
    }
}
