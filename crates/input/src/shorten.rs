//! Texts of users in messages: without control characters, and short.

use crate::limits;

/// Returns the beginning of a user's text for a message: at most [`limits::QUOTED`] characters, control
/// characters replaced, with `...` if something was left out.
#[must_use]
pub fn shortened(text: &str) -> String {
    let mut letters = text.chars().map(printable);
    let mut beginning: String = letters.by_ref().take(limits::QUOTED).collect();
    if letters.next().is_some() {
        beginning.push_str("...");
    }
    beginning
}

/// Returns a whole message within [`limits::MESSAGE`] bytes: of a longer one the middle is left out, since
/// what is wrong stands at the end as often as at the beginning.
#[must_use]
pub fn bounded(message: String) -> String {
    if message.len() <= limits::MESSAGE && !message.contains(is_unprintable) {
        return message;
    }
    if message.len() <= limits::MESSAGE {
        return message.chars().map(printable).collect();
    }
    let head = message.floor_char_boundary(limits::MESSAGE * 2 / 3);
    let tail = message.ceil_char_boundary(message.len() - limits::MESSAGE / 4);
    let cut = format!("{} ... {}", &message[..head], &message[tail..]);
    cut.chars().map(printable).collect()
}

/// Returns whether a character is a control character, or turns the direction of writing.
pub(crate) fn is_hidden(letter: char) -> bool {
    letter.is_control()
        || matches!(letter, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

fn is_unprintable(letter: char) -> bool {
    is_hidden(letter) && letter != '\n'
}

fn printable(letter: char) -> char {
    if is_unprintable(letter) { '?' } else { letter }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_texts_of_users_are_short_and_printable() {
        assert_eq!(shortened("32 deg"), "32 deg");
        assert_eq!(shortened("a\u{1b}[31mb\0"), "a?[31mb?");
        let long = shortened(&"ä".repeat(1000));
        assert_eq!(long.chars().count(), limits::QUOTED + 3);
    }

    #[test]
    fn limits_messages_keep_their_beginning_and_end() {
        assert_eq!(bounded("plain\nlines".to_owned()), "plain\nlines");
        let long = bounded(format!("begin {} end", "é\u{7}".repeat(10_000)));
        assert!(long.len() <= limits::MESSAGE, "{}", long.len());
        assert!(long.starts_with("begin ") && long.ends_with(" end") && !long.contains('\u{7}'));
    }
}
