//! Connections: taken one by one, served within time limits, ended in peace.
//!
//! Everybody on the machine can connect, but only who has the token can hold a seat. A connection is a
//! stranger until a request with the token has come over it; of more strangers than [`limits::STRANGERS`] the
//! oldest is sent away.

use std::collections::VecDeque;
use std::pin::pin;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::Duration;

use axum::{Extension, Router};
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::{Notify, OwnedSemaphorePermit, Semaphore};
use tokio_io_timeout::TimeoutStream;

use super::limits::{self, Patience};

/// The wait after a connection could not be taken, such as for want of file descriptors.
const BREATH: Duration = Duration::from_millis(200);

/// Serves every connection until `stop`, then waits for those that are open, but not for long.
pub async fn serve(listener: TcpListener, app: Router, patience: Patience, stop: impl Future<Output = ()>) {
    let mut http = http1::Builder::new();
    http.timer(TokioTimer::new())
        .header_read_timeout(patience.head)
        .max_header_size(limits::HEAD);
    let open = GracefulShutdown::new();
    let hall = Arc::new(Hall::default());
    let mut stop = pin!(stop);
    loop {
        let stream = tokio::select! {
            stream = next(&listener) => stream,
            () = &mut stop => break,
        };
        let visitor = Hall::enter(&hall);
        // Small answers go at once.
        let _ = stream.set_nodelay(true);
        let mut stream = TimeoutStream::new(stream);
        stream.set_write_timeout(Some(patience.write));
        let service = TowerToHyperService::new(app.clone().layer(Extension(Arc::clone(&visitor))));
        let connection = open.watch(http.serve_connection(TokioIo::new(Box::pin(stream)), service));
        tokio::spawn(async move {
            tokio::select! {
                // What goes wrong on a connection concerns its client, who sees it end.
                _ = connection => {}
                () = visitor.leave.notified() => {}
            }
            visitor.hall.forget(&visitor);
        });
    }
    drop(listener);
    let _ = tokio::time::timeout(patience.end, open.shutdown()).await;
}

/// Who is connected.
struct Hall {
    seats: Arc<Semaphore>,
    /// Those who have not shown the token, the oldest first.
    strangers: Mutex<VecDeque<Arc<Visitor>>>,
}

impl Default for Hall {
    fn default() -> Self {
        Self {
            seats: Arc::new(Semaphore::new(limits::CONNECTIONS)),
            strangers: Mutex::default(),
        }
    }
}

impl Hall {
    /// Takes a stranger in; the oldest goes if there are too many.
    fn enter(hall: &Arc<Self>) -> Arc<Visitor> {
        let visitor = Arc::new(Visitor {
            hall: Arc::clone(hall),
            leave: Notify::new(),
            seat: OnceLock::new(),
        });
        let mut strangers = hall.strangers.lock().unwrap_or_else(PoisonError::into_inner);
        strangers.push_back(Arc::clone(&visitor));
        if strangers.len() > limits::STRANGERS
            && let Some(oldest) = strangers.pop_front()
        {
            oldest.leave.notify_one();
        }
        visitor
    }

    /// Takes one out of the strangers.
    fn forget(&self, visitor: &Arc<Visitor>) {
        let mut strangers = self.strangers.lock().unwrap_or_else(PoisonError::into_inner);
        strangers.retain(|own| !Arc::ptr_eq(own, visitor));
    }
}

/// One connection.
pub struct Visitor {
    hall: Arc<Hall>,
    /// Told when it must go.
    leave: Notify,
    /// The seat of one who has shown the token.
    seat: OnceLock<OwnedSemaphorePermit>,
}

impl Visitor {
    /// Gives a seat to one who has shown the token; where all are taken, it stays a stranger.
    pub fn seat(self: &Arc<Self>) {
        if self.seat.get().is_some() {
            return;
        }
        if let Ok(seat) = Arc::clone(&self.hall.seats).try_acquire_owned() {
            let _ = self.seat.set(seat);
            self.hall.forget(self);
        }
    }
}

async fn next(listener: &TcpListener) -> TcpStream {
    loop {
        match listener.accept().await {
            Ok((stream, _)) => return stream,
            Err(_) => tokio::time::sleep(BREATH).await,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use axum::body::Bytes;
    use axum::extract::Request;
    use axum::routing::{get, post};
    use std::future::pending;
    use std::net::SocketAddr;
    use tokio::io::{AsyncReadExt, AsyncWriteExt};
    use tokio::sync::mpsc;
    use tokio::task::JoinHandle;

    const BRIEF: Patience = Patience {
        head: Duration::from_millis(150),
        body: Duration::from_millis(150),
        write: Duration::from_millis(150),
        end: Duration::from_millis(150),
    };
    /// Longest time that tests wait for something that takes [`BRIEF`] time.
    const LONG: Duration = Duration::from_secs(20);

    /// Tells when it is dropped.
    struct Ended(mpsc::Sender<()>);

    impl Drop for Ended {
        fn drop(&mut self) {
            let _ = self.0.try_send(());
        }
    }

    async fn start(
        app: Router,
        stop: impl Future<Output = ()> + Send + 'static,
    ) -> (SocketAddr, JoinHandle<()>) {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        (address, tokio::spawn(serve(listener, app, BRIEF, stop)))
    }

    /// Returns the response of a server until it ends the connection.
    async fn answered(stream: &mut TcpStream) -> String {
        let mut bytes = Vec::new();
        let read = tokio::time::timeout(LONG, stream.read_to_end(&mut bytes));
        // A connection that is cut may end with an error.
        let _ = read.await.unwrap();
        String::from_utf8_lossy(&bytes).into_owned()
    }

    #[tokio::test]
    async fn issue_029_a_client_that_sends_no_headers_is_sent_away() {
        let (address, _) = start(Router::new().route("/", get(async || "here")), pending()).await;
        for text in ["", "GET / HT", "GET / HTTP/1.1\r\nHost: a\r\n"] {
            let mut stream = TcpStream::connect(address).await.unwrap();
            stream.write_all(text.as_bytes()).await.unwrap();
            assert!(!answered(&mut stream).await.contains("here"), "{text:?}");
        }
        let mut stream = TcpStream::connect(address).await.unwrap();
        stream
            .write_all(b"GET / HTTP/1.1\r\nHost: a\r\n\r\n")
            .await
            .unwrap();
        assert!(
            answered(&mut stream).await.ends_with("here"),
            "then the idle connection is ended"
        );
    }

    #[tokio::test]
    async fn issue_029_too_long_headers_are_refused() {
        let (address, _) = start(Router::new().route("/", get(async || "here")), pending()).await;
        let mut stream = TcpStream::connect(address).await.unwrap();
        let long = "a".repeat(limits::HEAD);
        let _ = stream
            .write_all(format!("GET / HTTP/1.1\r\nHost: {long}\r\n\r\n").as_bytes())
            .await;
        let answer = answered(&mut stream).await;
        assert!(answer.starts_with("HTTP/1.1 431"), "{answer}");
    }

    #[tokio::test]
    async fn issue_029_a_client_that_does_not_read_is_sent_away() {
        struct Owner {
            bytes: Vec<u8>,
            _signal: Ended,
        }
        impl AsRef<[u8]> for Owner {
            fn as_ref(&self) -> &[u8] {
                &self.bytes
            }
        }
        const LARGE: usize = 32 << 20;
        let (end, mut ended) = mpsc::channel(4);
        let large = async move || {
            Bytes::from_owner(Owner {
                bytes: vec![0; LARGE],
                _signal: Ended(end.clone()),
            })
        };
        let (address, _) = start(Router::new().route("/", get(large)), pending()).await;
        let mut stream = TcpStream::connect(address).await.unwrap();
        stream
            .write_all(b"GET / HTTP/1.1\r\nHost: a\r\n\r\n")
            .await
            .unwrap();
        tokio::time::timeout(LONG, ended.recv()).await.unwrap().unwrap();
        let taken = answered(&mut stream).await.len();
        assert!(taken < LARGE, "{taken} bytes");
    }

    #[tokio::test]
    async fn issue_029_work_ends_when_its_client_goes() {
        let (end, mut ended) = mpsc::channel(4);
        let (begin, mut started) = mpsc::channel(4);
        let endless = move |_: Request| {
            let (ended, begin) = (Ended(end.clone()), begin.clone());
            async move {
                let _signal = ended;
                let _ = begin.send(()).await;
                pending::<&'static str>().await
            }
        };
        let (address, _) = start(Router::new().route("/", post(endless)), pending()).await;
        let mut stream = TcpStream::connect(address).await.unwrap();
        let request = b"POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 0\r\n\r\n";
        stream.write_all(request).await.unwrap();
        started.recv().await.unwrap();
        assert!(ended.try_recv().is_err(), "it goes on while the client waits");
        drop(stream);
        tokio::time::timeout(LONG, ended.recv()).await.unwrap().unwrap();
    }

    /// Strangers that say nothing hold nobody up, and who has the token is not sent away for them.
    #[tokio::test]
    async fn issue_048_connections_without_the_token_hold_no_seat() {
        let patient = Patience {
            head: Duration::from_secs(3600),
            ..BRIEF
        };
        let known = async |Extension(visitor): Extension<Arc<Visitor>>| {
            visitor.seat();
            "known"
        };
        let app = Router::new()
            .route("/", get(async || "here"))
            .route("/known", get(known));
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let address = listener.local_addr().unwrap();
        tokio::spawn(serve(listener, app, patient, pending()));
        let request = |path: &str| format!("GET {path} HTTP/1.1\r\nHost: a\r\n\r\n");
        let answer = async |stream: &mut TcpStream, wanted: &str| {
            let mut bytes = Vec::new();
            while !bytes.ends_with(wanted.as_bytes()) {
                let read = tokio::time::timeout(LONG, stream.read_buf(&mut bytes));
                assert!(
                    read.await.unwrap().unwrap() > 0,
                    "{}",
                    String::from_utf8_lossy(&bytes)
                );
            }
        };
        let mut friend = TcpStream::connect(address).await.unwrap();
        friend.write_all(request("/known").as_bytes()).await.unwrap();
        answer(&mut friend, "known").await;

        let mut silent = Vec::new();
        for _ in 0..2 * (limits::CONNECTIONS + limits::STRANGERS) {
            silent.push(TcpStream::connect(address).await.unwrap());
        }
        let mut stream = TcpStream::connect(address).await.unwrap();
        stream.write_all(request("/").as_bytes()).await.unwrap();
        answer(&mut stream, "here").await;
        // The oldest stranger is gone, the friend is not.
        assert_eq!(answered(&mut silent[0]).await, "");
        friend.write_all(request("/").as_bytes()).await.unwrap();
        answer(&mut friend, "here").await;
    }

    #[tokio::test]
    async fn it_ends_although_a_client_waits() {
        let (stop, stopped) = tokio::sync::oneshot::channel::<()>();
        let app = Router::new().route("/", get(async || pending::<&'static str>().await));
        let (address, server) = start(app, async move { drop(stopped.await) }).await;
        let mut stream = TcpStream::connect(address).await.unwrap();
        stream
            .write_all(b"GET / HTTP/1.1\r\nHost: a\r\n\r\n")
            .await
            .unwrap();
        stop.send(()).unwrap();
        tokio::time::timeout(LONG, server).await.unwrap().unwrap();
        assert!(TcpStream::connect(address).await.is_err());
    }
}
