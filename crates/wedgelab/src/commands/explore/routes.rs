//! Routes: a request is read within its limits, executed on another thread, and answered.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;

use axum::Router;
use axum::body::{Body, Bytes};
use axum::extract::{DefaultBodyLimit, FromRequest, Json, Path, Request, State};
use axum::http::{self, StatusCode, header};
use axum::middleware;
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use report::page::explorer;
use serde::Serialize;
use serde_json::json;
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

use super::api::{Client, Explorer, Export, Refused, SCHEMA, Wanted};
use super::guard::{self, Guard};
use super::limits::{self, Patience};

/// The answer to a request that meets a mistake of the program.
const MISTAKE_OF_THE_PROGRAM: &str = "This request met a mistake of the program, which goes on. Change a \
                                      value and try again; please report it with the message in the \
                                      terminal and with what was typed.";

/// Data that all requests share.
pub struct Server {
    explorer: Arc<Explorer>,
    patience: Patience,
    /// Answers that may be made or sent at once.
    room: Arc<Semaphore>,
}

/// An answer that is not sent yet.
type Made = http::Response<Vec<u8>>;

type Shared = State<Arc<Server>>;

/// Returns the routes of a server, guarded.
pub fn routes(explorer: Arc<Explorer>, guard: Guard, patience: Patience) -> Router {
    let server = Server {
        explorer,
        patience,
        room: Arc::new(Semaphore::new(limits::ANSWERS)),
    };
    Router::new()
        .route("/", get(page))
        .route("/explorer.js", get(script))
        .route("/explorer.css", get(style))
        .route("/api/case", get(opening))
        .route("/api/run", post(run))
        .route("/api/export/{file}", post(export))
        .with_state(Arc::new(server))
        .layer(DefaultBodyLimit::max(limits::BODY))
        .layer(middleware::from_fn_with_state(guard, guard::check))
}

async fn page() -> Response {
    Html(explorer::page()).into_response()
}

async fn script() -> Response {
    part("text/javascript; charset=utf-8", explorer::SCRIPT)
}

async fn style() -> Response {
    part("text/css; charset=utf-8", explorer::STYLE)
}

fn part(media: &'static str, text: &'static str) -> Response {
    ([(header::CONTENT_TYPE, media)], text).into_response()
}

fn text(status: StatusCode, sentence: &str) -> Response {
    (status, format!("{sentence}\n")).into_response()
}

async fn opening(State(server): Shared) -> Response {
    let explorer = Arc::clone(&server.explorer);
    server.away(move || answer(explorer.opening())).await
}

async fn run(State(server): Shared, request: Request) -> Response {
    let wanted = match server.wanted(request).await {
        Ok(wanted) => wanted,
        Err(refused) => return refused,
    };
    // Dropped with this future, which is when the connection ends.
    let client = Client::default();
    let explorer = Arc::clone(&server.explorer);
    let turn = explorer.begin(client.watch());
    server.away(move || answer(explorer.run(&wanted, &turn))).await
}

async fn export(State(server): Shared, Path(file): Path<String>, request: Request) -> Response {
    let wanted = match server.wanted(request).await {
        Ok(wanted) => wanted,
        Err(refused) => return refused,
    };
    let client = Client::default();
    let watch = client.watch();
    let explorer = Arc::clone(&server.explorer);
    let made = move || match explorer.export(&wanted, &file, watch) {
        Ok(Export { name, media, bytes }) => {
            let mut made = Made::new(bytes);
            // Names of cases are names of folders: no quotes, no line ends.
            let disposition = format!("attachment; filename=\"{name}\"");
            for (name, value) in [
                (header::CONTENT_TYPE, media),
                (header::CONTENT_DISPOSITION, &disposition),
            ] {
                if let Ok(value) = value.parse() {
                    made.headers_mut().insert(name, value);
                }
            }
            made
        }
        Err(refused) => refused.answer(),
    };
    server.away(made).await
}

impl Server {
    /// Returns the request as read; its refusal if it is too long, too slow, or no request.
    async fn wanted(&self, request: Request) -> Result<Wanted, Response> {
        let read = Json::<Wanted>::from_request(request, &());
        let rejection = match tokio::time::timeout(self.patience.body, read).await {
            Ok(Ok(Json(wanted))) => return Ok(wanted),
            Ok(Err(rejection)) => rejection,
            Err(_) => {
                let waited = self.patience.body.as_secs();
                let sentence =
                    format!("The body of the request did not come within {waited} s: send it again.");
                return Err(text(StatusCode::REQUEST_TIMEOUT, &sentence));
            }
        };
        Err(match rejection.status() {
            StatusCode::PAYLOAD_TOO_LARGE => {
                let most = limits::BODY / 1024;
                let sentence =
                    format!("The body of the request is longer than {most} KiB: send fewer changes.");
                text(StatusCode::PAYLOAD_TOO_LARGE, &sentence)
            }
            // What was sent is not sent back at length.
            status => text(
                status,
                &rejection.body_text().chars().take(500).collect::<String>(),
            ),
        })
    }

    /// Runs a long task on another thread, so that the server goes on answering. There is room for some
    /// answers at once, each until it is sent.
    async fn away(&self, work: impl FnOnce() -> Made + Send + 'static) -> Response {
        let Ok(room) = Arc::clone(&self.room).acquire_owned().await else {
            return text(StatusCode::SERVICE_UNAVAILABLE, "The server ends.");
        };
        let done = tokio::task::spawn_blocking(move || {
            let made = catch_unwind(AssertUnwindSafe(work))
                .unwrap_or_else(|_| message(StatusCode::INTERNAL_SERVER_ERROR, MISTAKE_OF_THE_PROGRAM));
            made.map(|bytes| Body::from(Bytes::from_owner(Held { bytes, _room: room })))
        });
        match done.await {
            Ok(response) => response,
            // The server ends: the thread was not begun.
            Err(_) => text(StatusCode::SERVICE_UNAVAILABLE, "The server ends."),
        }
    }
}

/// The bytes of an answer, which take room until they are sent.
struct Held {
    bytes: Vec<u8>,
    _room: OwnedSemaphorePermit,
}

impl AsRef<[u8]> for Held {
    fn as_ref(&self) -> &[u8] {
        &self.bytes
    }
}

fn answer(result: Result<impl Serialize, Refused>) -> Made {
    match result {
        Ok(value) => json(StatusCode::OK, &value),
        Err(refused) => refused.answer(),
    }
}

fn json(status: StatusCode, value: &impl Serialize) -> Made {
    let (status, bytes) = match serde_json::to_vec(value) {
        Ok(bytes) => (status, bytes),
        Err(error) => {
            let reason =
                json!({ "schema": SCHEMA, "message": format!("the answer cannot be written: {error}") });
            (StatusCode::INTERNAL_SERVER_ERROR, reason.to_string().into_bytes())
        }
    };
    let mut made = Made::new(bytes);
    *made.status_mut() = status;
    let media = header::HeaderValue::from_static("application/json");
    made.headers_mut().insert(header::CONTENT_TYPE, media);
    made
}

fn message(status: StatusCode, message: &str) -> Made {
    json(status, &json!({ "schema": SCHEMA, "message": message }))
}

impl Refused {
    fn answer(self) -> Made {
        match self {
            Self::Mistakes(errors) => json(
                StatusCode::UNPROCESSABLE_ENTITY,
                &json!({ "schema": SCHEMA, "errors": errors }),
            ),
            Self::Replaced => json(
                StatusCode::CONFLICT,
                &json!({ "schema": SCHEMA, "replaced": true }),
            ),
            Self::Unknown(what) => message(StatusCode::NOT_FOUND, &what),
            Self::Failed(why) => message(StatusCode::INTERNAL_SERVER_ERROR, &why),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, clippy::panic)]
mod tests {
    use super::*;
    use crate::commands::explore::base::Base;
    use axum::body::to_bytes;
    use hyper::body::Frame;
    use std::convert::Infallible;
    use std::pin::Pin;
    use std::task::{Context, Poll};
    use std::time::Duration;

    /// A body of which nothing comes.
    struct Never;

    impl hyper::body::Body for Never {
        type Data = Bytes;
        type Error = Infallible;

        fn poll_frame(
            self: Pin<&mut Self>,
            _: &mut Context<'_>,
        ) -> Poll<Option<Result<Frame<Bytes>, Infallible>>> {
            Poll::Pending
        }
    }

    fn server() -> Arc<Server> {
        let base = Base::BuiltIn("vdrun_toe_0_psi_0".to_owned());
        Arc::new(Server {
            explorer: Arc::new(Explorer::new(base)),
            patience: Patience {
                body: Duration::from_millis(100),
                ..Patience::default()
            },
            room: Arc::new(Semaphore::new(limits::ANSWERS)),
        })
    }

    fn request(body: Body) -> Request {
        let request = Request::post("/api/run").header(header::CONTENT_TYPE, "application/json");
        request.body(body).unwrap()
    }

    async fn read(response: Response) -> (StatusCode, String) {
        let status = response.status();
        let bytes = to_bytes(response.into_body(), usize::MAX).await.unwrap();
        (status, String::from_utf8(bytes.to_vec()).unwrap())
    }

    #[tokio::test]
    async fn issue_029_a_crash_is_answered_and_the_server_goes_on() {
        let server = server();
        for _ in 0..2 * limits::ANSWERS {
            let (status, text) = read(server.away(|| panic!("on purpose")).await).await;
            assert_eq!(status, StatusCode::INTERNAL_SERVER_ERROR);
            assert!(
                text.contains("Change a value and try again") && !text.contains("on purpose"),
                "{text}"
            );
        }
        let (status, text) = read(run(State(server), request(Body::from("{}"))).await).await;
        assert_eq!(status, StatusCode::OK, "{text}");
    }

    #[tokio::test]
    async fn issue_029_answers_take_room_until_they_are_sent() {
        let server = server();
        let first = server.away(|| Made::new(vec![1])).await;
        assert_eq!(server.room.available_permits(), limits::ANSWERS - 1);
        drop(first);
        assert_eq!(server.room.available_permits(), limits::ANSWERS);
    }

    #[tokio::test]
    async fn issue_029_bodies_must_come_soon_and_be_short() {
        let server = server();
        let never = Body::new(Never);
        let (status, text) = read(server.wanted(request(never)).await.unwrap_err()).await;
        assert_eq!(status, StatusCode::REQUEST_TIMEOUT);
        assert!(text.contains("did not come within"), "{text}");
        let mut long = request(Body::from(vec![b' '; limits::BODY + 1]));
        DefaultBodyLimit::max(limits::BODY).apply(&mut long);
        let (status, text) = read(server.wanted(long).await.unwrap_err()).await;
        assert_eq!(status, StatusCode::PAYLOAD_TOO_LARGE);
        assert!(text.contains("longer than 256 KiB"), "{text}");
        let strange = format!("{{\"{}\": 1}}", "a".repeat(10_000));
        let (status, text) = read(server.wanted(request(Body::from(strange))).await.unwrap_err()).await;
        assert_eq!(status, StatusCode::UNPROCESSABLE_ENTITY);
        assert!(text.len() < 600, "{text}");
    }
}
