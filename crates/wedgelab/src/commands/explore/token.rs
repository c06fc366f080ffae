//! The secret in the address: who has seen the terminal may ask, other users of the same machine may not.

use subtle::ConstantTimeEq;

/// Random bytes of a token: 256 bits.
const BYTES: usize = 32;

/// A secret of this start of the server. It is printed once, as part of the address, and not shown otherwise.
#[derive(Clone)]
pub struct Token(String);

impl Token {
    /// Returns a new one from the system's generator.
    ///
    /// # Errors
    /// The system has no random numbers.
    pub fn new() -> Result<Self, getrandom::Error> {
        let mut bytes = [0; BYTES];
        getrandom::fill(&mut bytes)?;
        Ok(Self(bytes.iter().map(|byte| format!("{byte:02x}")).collect()))
    }

    /// Returns the part of the address after `/`.
    pub fn query(&self) -> String {
        format!("?token={}", self.0)
    }

    /// Returns whether this is the token; takes the same time for every wrong one of its length.
    pub fn is(&self, given: &str) -> bool {
        self.0.as_bytes().ct_eq(given.as_bytes()).into()
    }

    /// Returns whether a query, such as `token=...`, has it.
    pub fn is_in_query(&self, query: &str) -> bool {
        let given = query.split('&').find_map(|part| part.strip_prefix("token="));
        given.is_some_and(|given| self.is(given))
    }

    /// Returns whether a header `Authorization` has it: `Bearer ...`.
    pub fn is_in_header(&self, header: &[u8]) -> bool {
        let text = std::str::from_utf8(header).unwrap_or("");
        let given = text
            .split_once(' ')
            .filter(|(scheme, _)| scheme.eq_ignore_ascii_case("bearer"));
        given.is_some_and(|(_, given)| self.is(given.trim()))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn only_the_whole_token_is_taken() {
        let token = Token::new().unwrap();
        let text = token.query().strip_prefix("?token=").unwrap().to_owned();
        assert_eq!(text.len(), 64);
        assert!(text.bytes().all(|byte| byte.is_ascii_hexdigit()));
        assert!(token.is(&text) && token.is_in_query(&format!("a=b&token={text}")));
        assert!(token.is_in_header(format!("Bearer {text}").as_bytes()));
        assert!(token.is_in_header(format!("bearer  {text}").as_bytes()));
        let wrong = [
            String::new(),
            text[1..].to_owned(),
            format!("{text}0"),
            "0".repeat(64),
            text.to_uppercase(),
        ];
        for wrong in wrong.iter().filter(|wrong| **wrong != text) {
            assert!(
                !token.is(wrong) && !token.is_in_query(&format!("token={wrong}")),
                "{wrong}"
            );
            assert!(
                !token.is_in_header(format!("Bearer {wrong}").as_bytes()),
                "{wrong}"
            );
        }
        assert!(
            !token.is_in_query("")
                && !token.is_in_query(&text)
                && !token.is_in_query(&format!("tokens={text}"))
        );
        assert!(
            !token.is_in_header(text.as_bytes()) && !token.is_in_header(format!("Basic {text}").as_bytes())
        );
        assert!(!token.is_in_header(b"\xff\xfe"));
    }

    #[test]
    fn every_start_has_its_own() {
        assert_ne!(Token::new().unwrap().query(), Token::new().unwrap().query());
    }
}
