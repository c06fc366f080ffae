//! The requests that are answered: those that a page of this very server can make, or a person who typed its
//! address.
//!
//! A server on 127.0.0.1 can be reached by every page that the same person has open, and by every user of the
//! same machine. A foreign page cannot hide its origin, and one that made its own name point to 127.0.0.1
//! cannot hide that name; other users do not know the token.

use std::net::SocketAddr;
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, StatusCode, Uri, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::connections::Visitor;
use super::token::Token;

/// Parts of the page that are the same for everybody.
const PUBLIC: [&str; 2] = ["/explorer.js", "/explorer.css"];

/// The names under which the server is asked, and what is to be known.
#[derive(Clone)]
pub struct Guard {
    hosts: [String; 2],
    token: Token,
}

impl Guard {
    /// For a server that listens here and answers those who have the token.
    pub fn new(address: SocketAddr, token: Token) -> Self {
        let port = address.port();
        Self {
            hosts: [format!("127.0.0.1:{port}"), format!("localhost:{port}")],
            token,
        }
    }

    /// Returns the reason why a request is refused; `None` if it is answered.
    pub fn refusal(&self, uri: &Uri, headers: &HeaderMap) -> Option<String> {
        let mut hosts = headers.get_all(header::HOST).iter();
        let host = match (hosts.next().and_then(|host| host.to_str().ok()), hosts.next()) {
            (Some(host), None) if self.knows(host) => host,
            _ => {
                return Some(format!(
                    "Refused: this server answers to http://{} only.",
                    self.hosts[0]
                ));
            }
        };
        for origin in headers.get_all(header::ORIGIN) {
            let own = origin
                .to_str()
                .ok()
                .and_then(|origin| origin.strip_prefix("http://"));
            if own != Some(host) {
                return Some("Refused: the request comes from a page of another origin.".to_owned());
            }
        }
        match headers.get("sec-fetch-site").map(HeaderValue::as_bytes) {
            None | Some(b"same-origin" | b"none") => {}
            Some(_) => return Some("Refused: the request was caused by a page of another site.".to_owned()),
        }
        (!self.has_token(uri, headers)).then(|| {
            "Refused: open the address that `wedgelab explore` printed in its terminal, with its token."
                .to_owned()
        })
    }

    /// Returns whether a request needs no token or has it: the page in its address, everything else in a
    /// header. A cookie would be sent to all ports of the machine.
    fn has_token(&self, uri: &Uri, headers: &HeaderMap) -> bool {
        if PUBLIC.contains(&uri.path()) {
            return true;
        }
        let mut given = headers.get_all(header::AUTHORIZATION).iter();
        let in_header = match (given.next(), given.next()) {
            (Some(only), None) => self.token.is_in_header(only.as_bytes()),
            _ => false,
        };
        in_header || uri.path() == "/" && self.token.is_in_query(uri.query().unwrap_or(""))
    }

    fn knows(&self, host: &str) -> bool {
        self.hosts.iter().any(|own| own.eq_ignore_ascii_case(host))
    }
}

/// Rights of browsers with answers: only those that the page needs.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src \
                      'self' data: blob:; connect-src 'self'; base-uri 'none'; form-action 'none'; \
                      frame-ancestors 'none'";

/// Refuses what is to be refused, with status 403 and the reason as text.
pub async fn check(State(guard): State<Guard>, request: Request, next: Next) -> Response {
    let mut response = match guard.refusal(request.uri(), request.headers()) {
        Some(reason) => (StatusCode::FORBIDDEN, format!("{reason}\n")).into_response(),
        None => {
            let visitor = request.extensions().get::<Arc<Visitor>>();
            if let Some(visitor) = visitor.filter(|_| !PUBLIC.contains(&request.uri().path())) {
                visitor.seat();
            }
            next.run(request).await
        }
    };
    let headers = response.headers_mut();
    for (name, value) in [
        (header::CONTENT_SECURITY_POLICY, POLICY),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (header::CACHE_CONTROL, "no-store"),
    ] {
        headers.insert(name, HeaderValue::from_static(value));
    }
    response
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn answered_at(path: &str, query: &str, lines: &[(&'static str, &str)]) -> bool {
        let token = Token::new().unwrap();
        let own = token.query().replace("?token=", "");
        let mut headers = HeaderMap::new();
        for (name, value) in lines {
            headers.append(*name, value.replace("TOKEN", &own).parse().unwrap());
        }
        Guard::new("127.0.0.1:4000".parse().unwrap(), token)
            .refusal(
                &format!("{path}{}", query.replace("TOKEN", &own)).parse().unwrap(),
                &headers,
            )
            .is_none()
    }

    fn answered(lines: &[(&'static str, &str)]) -> bool {
        answered_at("/explorer.js", "", lines)
    }

    #[test]
    fn only_its_own_page_is_answered() {
        let host = ("host", "127.0.0.1:4000");
        assert!(answered(&[host]));
        assert!(answered(&[("host", "localhost:4000")]));
        assert!(answered(&[
            host,
            ("origin", "http://127.0.0.1:4000"),
            ("sec-fetch-site", "same-origin")
        ]));
        assert!(answered(&[host, ("sec-fetch-site", "none")]));
        assert!(!answered(&[]));
        assert!(!answered(&[("host", "127.0.0.1")]));
        assert!(!answered(&[("host", "127.0.0.1:4001")]));
        assert!(!answered(&[("host", "evil.example:4000")]));
        assert!(!answered(&[host, ("host", "evil.example:4000")]));
        assert!(!answered(&[host, ("origin", "null")]));
        assert!(!answered(&[host, ("origin", "https://127.0.0.1:4000")]));
        assert!(!answered(&[host, ("origin", "http://localhost:4000")]));
        assert!(!answered(&[host, ("origin", "http://evil.example")]));
        assert!(!answered(&[host, ("sec-fetch-site", "same-site")]));
        assert!(!answered(&[host, ("sec-fetch-site", "cross-site")]));
    }

    #[test]
    fn issue_029_who_does_not_know_the_token_is_refused() {
        let host = ("host", "127.0.0.1:4000");
        let right = ("authorization", "Bearer TOKEN");
        for path in ["/explorer.js", "/explorer.css"] {
            assert!(answered_at(path, "", &[host]));
            assert!(!answered_at(path, "?token=TOKEN", &[]), "the other guards stay");
        }
        for path in [
            "/",
            "/api/case",
            "/api/run",
            "/api/export/result.csv",
            "/nothing",
            "/explorer.js/",
        ] {
            assert!(!answered_at(path, "", &[host]), "{path}");
            assert!(!answered_at(path, "?token=", &[host]), "{path}");
            assert!(!answered_at(path, "?token=TOKENa", &[host]), "{path}");
            assert!(
                !answered_at(path, "", &[host, ("authorization", "Bearer wrong")]),
                "{path}"
            );
            assert!(
                !answered_at(path, "", &[host, ("cookie", "token=TOKEN")]),
                "{path}"
            );
            assert!(!answered_at(path, "", &[host, right, right]), "{path}");
            assert!(!answered_at(path, "", &[right]), "{path}: the other guards stay");
            assert!(answered_at(path, "", &[host, right]), "{path}");
            assert_eq!(answered_at(path, "?token=TOKEN", &[host]), path == "/", "{path}");
        }
    }
}
