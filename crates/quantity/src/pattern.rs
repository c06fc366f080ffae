//! Patterns of names.

/// Returns whether a text is a pattern: whether it has a `*` or `?`.
#[must_use]
pub fn is_pattern(text: &str) -> bool {
    text.contains(['*', '?'])
}

/// Returns whether a name fits a pattern, in which `*` is any text and `?` any one character.
///
/// ```
/// assert!(quantity::fits_pattern("axle_?_*_vertical", "axle_1_left_vertical"));
/// assert!(!quantity::fits_pattern("axle_?_*_vertical", "axle_1_left_lateral"));
/// ```
#[must_use]
pub fn fits_pattern(pattern: &str, name: &str) -> bool {
    let pattern: Vec<char> = pattern.chars().collect();
    let name: Vec<char> = name.chars().collect();
    let (mut at, mut place) = (0, 0);
    // The last `*`, and where the text that it stands for ends so far.
    let mut star: Option<(usize, usize)> = None;
    while place < name.len() {
        match pattern.get(at) {
            Some('*') => {
                star = Some((at, place));
                at += 1;
            }
            Some(sign) if *sign == '?' || *sign == name[place] => {
                at += 1;
                place += 1;
            }
            _ => {
                let Some((own, end)) = star else {
                    return false;
                };
                star = Some((own, end + 1));
                at = own + 1;
                place = end + 1;
            }
        }
    }
    pattern[at..].iter().all(|sign| *sign == '*')
}

#[cfg(test)]
mod tests {
    use super::fits_pattern;

    #[test]
    fn issue_048_patterns_stand_for_any_text_and_any_character() {
        for (pattern, name, fits) in [
            ("*", "", true),
            ("", "", true),
            ("", "a", false),
            ("a", "a", true),
            ("a*", "abc", true),
            ("*c", "abc", true),
            ("*b*", "abc", true),
            ("a*b*c", "a_b_b_c", true),
            ("a*b", "abbc", false),
            ("?", "\u{e4}", true),
            ("??", "a", false),
            ("a?c", "abc", true),
        ] {
            assert_eq!(fits_pattern(pattern, name), fits, "{pattern} {name}");
        }
        // The time grows with the product of both lengths at most.
        assert!(!fits_pattern(&"*a".repeat(50), &"a".repeat(49)));
    }
}
