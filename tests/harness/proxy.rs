//! Connections that can be cut.

use std::net::{SocketAddr, TcpListener as StdListener};
use std::sync::Arc;

use tokio::io::copy_bidirectional;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;

/// What happens to those who are connected when a connection is cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cut {
    /// They are told.
    Reset,
    /// They hear nothing, for ever: as if the other machine were gone.
    Silent,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Whole,
    Cut(Cut),
}

/// A way to a server of this machine. It goes when this is dropped.
pub struct Proxy {
    address: SocketAddr,
    state: Arc<watch::Sender<State>>,
}

impl Proxy {
    /// A way to a port.
    pub fn to(port: u16) -> Self {
        let listener = StdListener::bind("127.0.0.1:0").expect("a port");
        let address = listener.local_addr().expect("an address");
        listener.set_nonblocking(true).expect("a socket");
        let listener = TcpListener::from_std(listener).expect("a socket");
        let state = Arc::new(watch::Sender::new(State::Whole));
        tokio::spawn(accept(listener, port, state.subscribe()));
        Self { address, state }
    }

    pub fn port(&self) -> u16 {
        self.address.port()
    }

    /// From now on nobody gets through.
    pub fn cut(&self, how: Cut) {
        self.state.send_replace(State::Cut(how));
    }

    /// New connections get through again.
    pub fn mend(&self) {
        self.state.send_replace(State::Whole);
    }
}

async fn accept(listener: TcpListener, port: u16, state: watch::Receiver<State>) {
    let mut ended = state.clone();
    loop {
        let accepted = tokio::select! {
            accepted = listener.accept() => accepted,
            // The proxy is dropped.
            _ = ended.wait_for(|_| false) => return,
        };
        let Ok((client, _)) = accepted else { continue };
        tokio::spawn(pass_on(client, port, state.clone()));
    }
}

/// Passes on what comes until the connection ends or is cut.
async fn pass_on(mut client: TcpStream, port: u16, mut state: watch::Receiver<State>) {
    if *state.borrow() == State::Whole {
        let Ok(mut server) = TcpStream::connect(("127.0.0.1", port)).await else {
            return;
        };
        tokio::select! {
            _ = copy_bidirectional(&mut client, &mut server) => return,
            _ = state.wait_for(|state| *state != State::Whole) => {}
        }
    }
    let is_silent = *state.borrow() == State::Cut(Cut::Silent);
    if is_silent {
        // The server's end is closed by now: what it was sent, it has.
        let _ = state.wait_for(|_| false).await;
    }
}
