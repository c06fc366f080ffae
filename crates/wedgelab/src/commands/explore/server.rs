//! The server: start and stop.

use std::io::Write;
use std::net::{Ipv4Addr, SocketAddr};
use std::sync::Arc;

use tokio::net::TcpListener;
use tokio::signal;

use super::api::Explorer;
use super::base::Base;
use super::browser::Leading;
use super::connections;
use super::guard::Guard;
use super::limits::{self, Patience};
use super::routes::routes;
use super::token::Token;
use crate::failure::{Failure, Message, say};

/// Serves the case until Ctrl-C or a request to terminate.
///
/// # Errors
/// The port cannot be had.
pub fn serve(base: Base, port: u16, open: bool) -> Result<(), Failure> {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .thread_stack_size(limits::STACK)
        .max_blocking_threads(limits::ANSWERS)
        .build();
    let runtime = runtime.map_err(|error| {
        Failure::Failed(Message::new(format!("cannot start the server: {error}"), "").into())
    })?;
    let patience = Patience::default();
    let served = runtime.block_on(listen(base, (port, open), patience));
    // Runs end at their next step.
    runtime.shutdown_timeout(patience.end);
    served
}

async fn listen(base: Base, (port, open): (u16, bool), patience: Patience) -> Result<(), Failure> {
    let wanted = SocketAddr::from((Ipv4Addr::LOCALHOST, port));
    let cannot = |error: std::io::Error| {
        let advice = "choose another port with --port, or leave it out";
        Failure::Failed(Message::new(format!("cannot listen at {wanted}: {error}"), advice).into())
    };
    let listener = TcpListener::bind(wanted).await.map_err(cannot)?;
    let address = listener.local_addr().map_err(cannot)?;
    let token = Token::new().map_err(|error| {
        let message = format!("the system gives no random numbers for the address: {error}");
        Failure::Failed(Message::new(message, "without them the server would not be safe").into())
    })?;
    let explorer = Arc::new(Explorer::new(base));
    let app = routes(
        Arc::clone(&explorer),
        Guard::new(address, token.clone()),
        patience,
    );

    let page = format!("http://{address}/{}", token.query());
    {
        let mut out = std::io::stdout().lock();
        writeln!(out, "Open {page} in a browser. Ctrl-C stops.")?;
        out.flush()?;
    }
    let _leading = match open.then(|| Leading::open(&page)).transpose() {
        Ok(leading) => leading,
        Err(error) => {
            say(&format!(
                "no browser can be called ({error}): open the address yourself"
            ));
            None
        }
    };
    let stop = async {
        end_asked_for().await;
        explorer.end();
    };
    connections::serve(listener, app, patience, stop).await;
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
