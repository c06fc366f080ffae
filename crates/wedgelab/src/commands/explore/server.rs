//! The server: routes, start and stop.

use std::io::Write;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::extract::rejection::JsonRejection;
use axum::extract::{Json, Path, State};
use axum::http::{StatusCode, header};
use axum::middleware;
use axum::response::{Html, IntoResponse, Response};
use axum::routing::{get, post};
use report::page::explorer;
use serde_json::json;
use tokio::net::TcpListener;
use tokio::signal;
use tokio::sync::watch;

use super::api::{Explorer, Export, Refused, SCHEMA, Wanted};
use super::base::Base;
use super::guard::{self, Guard};
use crate::failure::{Failure, Message, say};

/// How long open connections are waited for at the end.
const PATIENCE: Duration = Duration::from_secs(2);

type Shared = State<Arc<Explorer>>;

/// Serves the case until Ctrl-C or a request to terminate.
///
/// # Errors
/// The port cannot be had.
pub fn serve(base: Base, port: u16) -> Result<(), Failure> {
    let runtime = tokio::runtime::Builder::new_current_thread().enable_all().build();
    let runtime = runtime.map_err(|error| {
        Failure::Failed(Message::new(format!("cannot start the server: {error}"), "").into())
    })?;
    let served = runtime.block_on(listen(base, port));
    // Runs end at their next step.
    runtime.shutdown_timeout(PATIENCE);
    served
}

async fn listen(base: Base, port: u16) -> Result<(), Failure> {
    let wanted = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    let cannot = |error: std::io::Error| {
        let advice = "choose another port with --port, or leave it out";
        Failure::Failed(Message::new(format!("cannot listen at {wanted}: {error}"), advice).into())
    };
    let listener = TcpListener::bind(wanted).await.map_err(cannot)?;
    let address = listener.local_addr().map_err(cannot)?;
    let explorer = Arc::new(Explorer::new(base));
    let app = routes(Arc::clone(&explorer), Guard::new(address));
    let (stop, stopped) = watch::channel(false);
    tokio::spawn(async move {
        end_asked_for().await;
        // Ends a run under way.
        explorer.begin();
        let _ = stop.send(true);
    });

    {
        let mut out = std::io::stdout().lock();
        writeln!(out, "Open http://{address} in a browser. Ctrl-C stops.")?;
        out.flush()?;
    }
    if explorer::Explorer::embedded().is_none() {
        say(explorer::MISSING);
    }
    let wait = |mut stopped: watch::Receiver<bool>| async move {
        let _ = stopped.wait_for(|stopped| *stopped).await;
    };
    let server = axum::serve(listener, app).with_graceful_shutdown(wait(stopped.clone()));
    let end = async {
        wait(stopped).await;
        tokio::time::sleep(PATIENCE).await;
    };
    tokio::select! {
        served = server => served.map_err(cannot)?,
        () = end => {}
    }
    Ok(())
}

/// Waits for Ctrl-C or, where there is such a thing, a request to terminate.
async fn end_asked_for() {
    let interrupted = async {
        if signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    };
    #[cfg(unix)]
    let terminated = async {
        match signal::unix::signal(signal::unix::SignalKind::terminate()) {
            Ok(mut terminate) => {
                terminate.recv().await;
            }
            Err(_) => std::future::pending().await,
        }
    };
    #[cfg(not(unix))]
    let terminated = std::future::pending::<()>();
    tokio::select! {
        () = interrupted => {}
        () = terminated => {}
    }
}

fn routes(explorer: Arc<Explorer>, guard: Guard) -> Router {
    Router::new()
        .route("/", get(page))
        .route("/explorer.js", get(script))
        .route("/explorer.css", get(style))
        .route("/api/case", get(opening))
        .route("/api/run", post(run))
        .route("/api/export/{file}", post(export))
        .with_state(explorer)
        .layer(middleware::from_fn_with_state(guard, guard::check))
}

async fn page() -> Response {
    match explorer::Explorer::embedded() {
        Some(explorer) => Html(explorer.page()).into_response(),
        None => (
            StatusCode::SERVICE_UNAVAILABLE,
            format!("{}\n", explorer::MISSING),
        )
            .into_response(),
    }
}

async fn script() -> Response {
    part("text/javascript; charset=utf-8", |explorer| explorer.script)
}

async fn style() -> Response {
    part("text/css; charset=utf-8", |explorer| explorer.style)
}

fn part(media: &'static str, of: fn(explorer::Explorer) -> &'static str) -> Response {
    match explorer::Explorer::embedded() {
        Some(explorer) => ([(header::CONTENT_TYPE, media)], of(explorer)).into_response(),
        None => StatusCode::NOT_FOUND.into_response(),
    }
}

async fn opening(State(explorer): Shared) -> Response {
    match explorer.opening() {
        Ok(opening) => Json(opening).into_response(),
        Err(refused) => refused.into_response(),
    }
}

async fn run(State(explorer): Shared, wanted: Result<Json<Wanted>, JsonRejection>) -> Response {
    let Json(wanted) = match wanted {
        Ok(wanted) => wanted,
        Err(rejection) => return rejection.into_response(),
    };
    let number = explorer.begin();
    away(move || match explorer.run(&wanted, number) {
        Ok(answer) => Json(answer).into_response(),
        Err(refused) => refused.into_response(),
    })
    .await
}

async fn export(
    State(explorer): Shared,
    Path(file): Path<String>,
    wanted: Result<Json<Wanted>, JsonRejection>,
) -> Response {
    let Json(wanted) = match wanted {
        Ok(wanted) => wanted,
        Err(rejection) => return rejection.into_response(),
    };
    away(
        move || match explorer.export(&wanted, &file, || explorer.begin()) {
            Ok(Export { name, media, bytes }) => {
                // Names of cases are names of folders: no quotes, no line ends.
                let disposition = format!("attachment; filename=\"{name}\"");
                let headers = [
                    (header::CONTENT_TYPE, media.to_owned()),
                    (header::CONTENT_DISPOSITION, disposition),
                ];
                (headers, bytes).into_response()
            }
            Err(refused) => refused.into_response(),
        },
    )
    .await
}

/// Does what takes time on another thread, so that the server goes on answering.
async fn away(work: impl FnOnce() -> Response + Send + 'static) -> Response {
    match tokio::task::spawn_blocking(work).await {
        Ok(response) => response,
        Err(_) => StatusCode::INTERNAL_SERVER_ERROR.into_response(),
    }
}

impl IntoResponse for Refused {
    fn into_response(self) -> Response {
        let (status, body) = match self {
            Self::Mistakes(errors) => (
                StatusCode::UNPROCESSABLE_ENTITY,
                json!({ "schema": SCHEMA, "errors": errors }),
            ),
            Self::Replaced => (
                StatusCode::CONFLICT,
                json!({ "schema": SCHEMA, "replaced": true }),
            ),
            Self::Unknown(message) => (
                StatusCode::NOT_FOUND,
                json!({ "schema": SCHEMA, "message": message }),
            ),
            Self::Failed(message) => (
                StatusCode::INTERNAL_SERVER_ERROR,
                json!({ "schema": SCHEMA, "message": message }),
            ),
        };
        (status, Json(body)).into_response()
    }
}
