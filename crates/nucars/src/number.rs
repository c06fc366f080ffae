//! Numbers, truth values, degrees of freedom and components as Fortran programs write them.

use crate::tree::{Component, Dof, DofKind};

/// Returns a real number: `32`, `1.0E6`, `1.D0`, `-15e3`, `.5`, `1.5+3` (exponent without letter). `None` for
/// anything else, for numbers beyond double precision, and for `inf` and `nan`.
pub fn real(text: &str) -> Option<f64> {
    let bytes = text.as_bytes();
    let digits = match bytes {
        [b'+' | b'-', rest @ ..] => rest,
        rest => rest,
    };
    if !matches!(digits, [b'0'..=b'9', ..] | [b'.', b'0'..=b'9', ..]) {
        return None;
    }
    let plain = bytes
        .iter()
        .all(|byte| matches!(byte, b'0'..=b'9' | b'.' | b'-' | b'+' | b'e' | b'E'));
    let value = if plain && !has_bare_exponent(bytes) {
        text.parse::<f64>().ok()?
    } else {
        let mut standard = String::with_capacity(text.len() + 1);
        let mut exponent = false;
        for (at, byte) in bytes.iter().enumerate() {
            match byte {
                b'd' | b'D' | b'e' | b'E' | b'q' | b'Q' if !exponent => {
                    exponent = true;
                    standard.push('e');
                }
                b'+' | b'-' if at > 0 && !exponent => {
                    exponent = true;
                    standard.push('e');
                    standard.push(char::from(*byte));
                }
                byte if byte.is_ascii() => standard.push(char::from(*byte)),
                _ => return None,
            }
        }
        standard.parse::<f64>().ok()?
    };
    value.is_finite().then_some(value)
}

fn has_bare_exponent(bytes: &[u8]) -> bool {
    let digit_before = |pair: &[u8]| matches!(pair, [b'0'..=b'9' | b'.', b'+' | b'-']);
    bytes.windows(2).any(digit_before)
}

/// Returns a whole number from 0 on.
pub fn whole(text: &str) -> Option<u32> {
    let digits = text.strip_prefix('+').unwrap_or(text);
    let all = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    if all { digits.parse().ok() } else { None }
}

/// Returns a truth value: `.T.`, `.F.`, `.true.`, `T`, `false`, in any case.
pub fn logical(text: &str) -> Option<bool> {
    let bare = text.strip_prefix('.').unwrap_or(text);
    let bare = bare.strip_suffix('.').unwrap_or(bare);
    if bare.eq_ignore_ascii_case("t") || bare.eq_ignore_ascii_case("true") {
        Some(true)
    } else if bare.eq_ignore_ascii_case("f") || bare.eq_ignore_ascii_case("false") {
        Some(false)
    } else {
        None
    }
}

/// Returns a degree of freedom: `1` to `9`, or `7.01` for the first mode of kind 7.
pub fn dof(text: &str) -> Option<Dof> {
    let (kind, mode) = match text.split_once('.') {
        None | Some((_, "")) => (text.trim_end_matches('.'), 0),
        Some((kind, mode)) if mode.len() <= 2 && mode.bytes().all(|byte| byte.is_ascii_digit()) => {
            let value: u8 = mode.parse().ok()?;
            (kind, if mode.len() == 1 { value * 10 } else { value })
        }
        Some(_) => return None,
    };
    let kind = DofKind::from_code(whole(kind)?)?;
    (mode == 0 || kind.is_flexible()).then_some(Dof { kind, mode })
}

/// Returns a component of a connection, `127.1`: connection and position in its list of degrees of freedom,
/// from 1.
pub fn component(text: &str) -> Option<Component> {
    let (connection, position) = text.split_once('.')?;
    Some(Component {
        connection: whole(connection)?,
        position: whole(position).filter(|position| *position > 0)?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_as_fortran_writes_them() {
        for (text, value) in [
            ("1.0E6", 1e6),
            ("1.D0", 1.0),
            ("-1.d0", -1.0),
            ("1.0D5", 1e5),
            ("-15E3", -15e3),
            ("1.E6", 1e6),
            ("32", 32.0),
            (".5", 0.5),
            ("+2.", 2.0),
            ("0.8350204E07", 8_350_204.0),
            ("1.5+3", 1500.0),
            ("1.5-3", 0.0015),
            ("2.5d-1", 0.25),
        ] {
            assert_eq!(real(text), Some(value), "{text}");
        }
        for text in [
            "", ".", "-", "e5", "inf", "nan", "1e999", "1.2.3", "1,5", "0x10", "3*1.0", "1e", "--1", "1d5e3",
            "é",
        ] {
            assert_eq!(real(text), None, "{text}");
        }
    }

    #[test]
    fn truth_values() {
        for text in [".T.", ".t.", "T", ".TRUE.", "true"] {
            assert_eq!(logical(text), Some(true), "{text}");
        }
        for text in [".F.", "f", ".false."] {
            assert_eq!(logical(text), Some(false), "{text}");
        }
        assert_eq!(logical("1"), None);
        assert_eq!(logical(""), None);
    }

    #[test]
    fn degrees_of_freedom_and_components() {
        assert_eq!(dof("3").map(|dof| dof.kind), Some(DofKind::Z));
        assert_eq!(
            dof("7.01").map(|dof| (dof.kind, dof.mode)),
            Some((DofKind::FlexX, 1))
        );
        for text in ["0", "10", "1.01", "7.001", "x", ""] {
            assert_eq!(dof(text), None, "{text}");
        }
        let read = component("127.10").map(|component| (component.connection, component.position));
        assert_eq!(read, Some((127, 10)));
        for text in ["127", "127.0", ".1", "a.1", "127.x"] {
            assert_eq!(component(text), None, "{text}");
        }
    }
}
