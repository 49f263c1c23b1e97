//! Refusal of connections whose address has too many. They have a few slots of their own, so that they delay nobody
//! else.

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

/// Time for the request of a refused client.
const TIME: Duration = Duration::from_secs(1);
/// Maximum number of refusals under way. Clients that send at once are answered before they are pushed out; each
/// connection takes an open file.
const MOST: usize = 32;

/// Connections waiting for their refusal, oldest first.
pub(super) struct Refused {
    answer: Router,
    waiting: VecDeque<AbortOnDropHandle<()>>,
}

impl Refused {
    /// Creates an empty set. The refusal states the limit per address, `most`.
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

    /// Answers the request of a connection with a refusal, then closes it. Closes it without an answer if no request
    /// comes within a second, or if it is the oldest of too many. Never waits.
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
