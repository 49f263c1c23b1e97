//! Connections that are refused because their address has too many. They have a few places of their
//! own, so that they keep nobody else waiting.

use std::collections::VecDeque;
use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1::Builder;
use hyper_util::rt::TokioIo;
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpStream;
use tokio_util::task::AbortOnDropHandle;

use super::counted::Counted;
use super::problem::{Code, Problem};

/// For the request of a client that gets no connection.
const TIME: Duration = Duration::from_secs(1);
/// Who asks at once is answered before so many others come; each takes an open file.
const MOST: usize = 32;

/// Connections that wait for their refusal, the oldest first.
pub(super) struct Refused {
    answer: Router,
    waiting: VecDeque<AbortOnDropHandle<()>>,
}

impl Refused {
    /// None yet. Those that come will hear how many an address may have.
    pub fn of_more_than(most: usize) -> Self {
        let answer = Router::new().fallback(async move || {
            let detail = format!("an address may have {most} connections at a time");
            Problem::new(Code::TooManyConnections, detail).with_limit(most as u64)
        });
        Self {
            answer,
            waiting: VecDeque::with_capacity(MOST),
        }
    }

    /// Refuses what a connection asks for, then closes it; without an answer if it asks for nothing
    /// within a second, or is the oldest of too many. Never waits.
    pub fn add(&mut self, stream: TcpStream) {
        self.waiting.retain(|one| !one.is_finished());
        if self.waiting.len() == MOST {
            self.waiting.pop_front();
        }
        let service = TowerToHyperService::new(self.answer.clone());
        let counted = Counted::refused();
        let answered = async move {
            let _counted = counted;
            let mut http1 = Builder::new();
            let connection = http1.keep_alive(false);
            let connection = connection.serve_connection(TokioIo::new(stream), service);
            // What goes wrong here is the client's going away, or its silence.
            let _ = tokio::time::timeout(TIME, connection).await;
        };
        let waiting = AbortOnDropHandle::new(tokio::spawn(answered));
        self.waiting.push_back(waiting);
    }
}
