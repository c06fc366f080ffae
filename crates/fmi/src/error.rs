//! Errors of calls that an instance refuses or fails to do.

use std::fmt::Display;

use input::bounded;
use thiserror::Error;

/// The severity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Done, with a remark.
    Warning,
    /// Not done, because it cannot be answered; all is as before.
    Discard,
    /// Not done; nothing has changed, the instance goes on.
    Error,
}

/// The subject of a message: the log categories of the description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Category {
    /// Something was refused or failed.
    Error,
    /// Something was asked for that there is not.
    Discard,
    /// Something is doubtful.
    Warning,
    /// A corner opened, closed, stuck or slipped.
    Events,
}

impl Category {
    /// All categories.
    pub const ALL: [Category; 4] = [
        Category::Error,
        Category::Discard,
        Category::Warning,
        Category::Events,
    ];

    /// Returns its name in the description.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Category::Error => "logStatusError",
            Category::Discard => "logStatusDiscard",
            Category::Warning => "logStatusWarning",
            Category::Events => "logEvents",
        }
    }

    /// Returns the message.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Category::Error => "calls that are refused, and steps that fail",
            Category::Discard => "questions that the instance has no answer to",
            Category::Warning => "what is doubtful",
            Category::Events => "which corner opens, closes, sticks or slips, and when",
        }
    }
}

/// The reason why a call is refused, or has failed.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct Error {
    /// The whole message.
    pub message: String,
}

impl Error {
    /// Returns an error of this message.
    #[must_use]
    pub fn new(message: impl Into<String>) -> Self {
        Self {
            message: bounded(message.into()),
        }
    }

    /// Returns an error with the message of another one.
    pub(crate) fn of(error: impl Display) -> Self {
        Self::new(error.to_string())
    }
}

/// Returns a member of a saved state that cannot be.
pub(crate) fn damaged(member: &str, found: impl Display, expected: impl Display) -> Error {
    Error::new(format!(
        "the saved state is damaged: {member} is {found}; it must be {expected}; restore a state as it was \
         saved, or reset the instance"
    ))
}

/// Checks the numbers of entries of members: those found, and those that there must be.
pub(crate) fn check_lengths<'m>(
    members: impl IntoIterator<Item = (&'m str, usize, usize)>,
) -> Result<(), Error> {
    match members.into_iter().find(|(_, found, own)| found != own) {
        Some((member, found, own)) => Err(damaged(
            member,
            format!("a list of {found}"),
            format!("a list of {own}"),
        )),
        None => Ok(()),
    }
}

/// Checks whether all numbers of a member are finite.
pub(crate) fn check_finite<'v>(member: &str, values: impl IntoIterator<Item = &'v f64>) -> Result<(), Error> {
    match values
        .into_iter()
        .enumerate()
        .find(|(_, value)| !value.is_finite())
    {
        Some((number, value)) => Err(damaged(
            &format!("{member} {number} (counted from 0)"),
            value,
            "finite",
        )),
        None => Ok(()),
    }
}
