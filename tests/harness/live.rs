//! A client of live sessions, which judges frames by their bytes.

use futures_util::{SinkExt, StreamExt};
use serde_json::{Value, json};
use tokio::net::TcpStream;
use tokio_tungstenite::tungstenite::Message;
use tokio_tungstenite::tungstenite::client::IntoClientRequest;
use tokio_tungstenite::{MaybeTlsStream, WebSocketStream, connect_async};
use unwrapd::numerics::predicates::{orient2d_sign, orient3d_sign};

use super::SOON;

/// A mesh as it is sent.
pub struct Mesh {
    pub dim: usize,
    pub rest: Vec<f64>,
    pub elements: Vec<Vec<u32>>,
    pub triangles: Vec<Vec<u32>>,
    pub skin: Vec<Vec<u32>>,
    pub weights: Vec<Vec<f32>>,
    pub picture: [u32; 2],
    /// Of each element the orientation at rest.
    signs: Vec<i8>,
}

/// A frame as it is sent.
#[derive(Clone)]
pub struct Frame {
    pub width: usize,
    pub stage: u8,
    pub step: u32,
    pub message: u32,
    pub flips: u32,
    pub energy: f64,
    pub smallest: f64,
    pub positions: Vec<f64>,
    /// The bytes of the coordinates.
    pub bytes: Vec<u8>,
}

/// What comes from the server.
pub enum Heard {
    Frame(Frame),
    Reply(Value),
    Closed(u16, String),
}

/// Numbers from bytes, one after the other.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (head, rest) = self.0.split_first_chunk().expect("bytes");
        self.0 = rest;
        *head
    }

    fn u8(&mut self) -> u8 {
        let [byte] = self.take();
        byte
    }

    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }

    fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }

    fn f32(&mut self) -> f32 {
        f32::from_le_bytes(self.take())
    }

    fn lists(&mut self, n: u32, length: usize) -> Vec<Vec<u32>> {
        let list = |_| (0..length).map(|_| self.u32()).collect();
        (0..n).map(list).collect()
    }
}

impl Mesh {
    pub fn read(bytes: &[u8]) -> Self {
        let mut from = Reader(bytes);
        assert_eq!(from.u8(), 1, "a mesh");
        let (dim, n_corners, has_skin) = (from.u8() as usize, from.u8() as usize, from.u8());
        let counts: [u32; 7] = std::array::from_fn(|_| from.u32());
        let [
            n_vertices,
            n_elements,
            n_triangles,
            n_skin,
            columns,
            rows,
            _,
        ] = counts;
        let rest: Vec<f64> = (0..n_vertices as usize * dim).map(|_| from.f64()).collect();
        let elements = from.lists(n_elements, n_corners);
        let triangles = from.lists(n_triangles, 3);
        let skin = from.lists(n_skin, 4);
        let weights = skin.iter().map(|_| (0..4).map(|_| from.f32()).collect());
        let weights = weights.collect();
        assert!(from.0.is_empty() && (has_skin == 1) == (n_skin > 0));
        let sign = |element: &Vec<u32>| sign(dim, &rest, element);
        Self {
            signs: elements.iter().map(sign).collect(),
            picture: [columns, rows],
            dim,
            rest,
            elements,
            triangles,
            skin,
            weights,
        }
    }

    /// Elements whose orientation is not that at rest, exactly.
    pub fn flips(&self, frame: &Frame) -> usize {
        let signs = self.elements.iter().zip(&self.signs);
        let is_flipped = |(element, at_rest): &(&Vec<u32>, &i8)| {
            sign(self.dim, &frame.positions, element) != **at_rest
        };
        signs.filter(is_flipped).count()
    }
}

fn sign(dim: usize, positions: &[f64], element: &[u32]) -> i8 {
    let at = |v: u32| &positions[dim * v as usize..dim * (v as usize + 1)];
    match *element {
        [a, b, c] => {
            let [a, b, c] = [a, b, c].map(|v| [at(v)[0], at(v)[1]]);
            orient2d_sign(a, b, c)
        }
        [a, b, c, d] => {
            let [a, b, c, d] = [a, b, c, d].map(|v| [at(v)[0], at(v)[1], at(v)[2]]);
            orient3d_sign(a, b, c, d)
        }
        _ => panic!("three or four corners"),
    }
}

impl Frame {
    pub fn read(bytes: &[u8]) -> Self {
        let mut from = Reader(bytes);
        assert_eq!(from.u8(), 2, "a frame");
        let (width, stage, dim) = (from.u8() as usize, from.u8(), from.u8() as usize);
        let [step, message, flips] = [from.u32(), from.u32(), from.u32()];
        let [energy, smallest] = [from.f64(), from.f64()];
        let n = from.u32() as usize * dim;
        from.u32();
        let bytes = from.0.to_vec();
        assert_eq!(bytes.len(), n * width);
        let coordinate = |_| match width {
            4 => f64::from(from.f32()),
            _ => from.f64(),
        };
        Self {
            positions: (0..n).map(coordinate).collect(),
            bytes,
            width,
            stage,
            step,
            message,
            flips,
            energy,
            smallest,
        }
    }

    pub fn is_moving(&self) -> bool {
        self.stage == 0
    }
}

/// A connection to a session.
pub struct Live {
    stream: WebSocketStream<MaybeTlsStream<TcpStream>>,
    pub mesh: Mesh,
    n: u32,
}

impl Live {
    /// Connects and takes the mesh.
    pub async fn connect(request: impl IntoClientRequest + Unpin) -> Self {
        let (mut stream, _) = connect_async(request).await.expect("a WebSocket");
        let mesh = loop {
            let message = stream.next().await.expect("a message");
            if let Message::Binary(bytes) = message.expect("a message") {
                break Mesh::read(&bytes);
            }
        };
        Self { stream, mesh, n: 0 }
    }

    /// Says what is wished and returns the number of the message.
    pub async fn say(&mut self, wish: Value) -> u32 {
        self.n += 1;
        let mut message = json!({ "n": self.n });
        let wish = wish.as_object().expect("a wish").clone();
        message.as_object_mut().expect("a message").extend(wish);
        let text = Message::text(message.to_string());
        self.stream.send(text).await.expect("it is heard");
        self.n
    }

    /// The next frame, reply or end.
    pub async fn hear(&mut self) -> Heard {
        loop {
            let message = tokio::time::timeout(SOON, self.stream.next()).await;
            let message = message.expect("a message in time").expect("a message");
            match message.expect("a message") {
                Message::Binary(bytes) => return Heard::Frame(Frame::read(&bytes)),
                Message::Text(text) => {
                    return Heard::Reply(serde_json::from_str(&text).expect("JSON"));
                }
                Message::Close(frame) => {
                    let frame = frame.expect("a reason");
                    return Heard::Closed(frame.code.into(), frame.reason.to_string());
                }
                _ => {}
            }
        }
    }

    /// The first frame that contains a message; every frame on the way is judged.
    pub async fn frame_with(&mut self, n: u32) -> Frame {
        loop {
            if let Heard::Frame(frame) = self.hear().await {
                self.judge(&frame);
                if n <= frame.message {
                    return frame;
                }
            }
        }
    }

    /// The reply to a message.
    pub async fn reply_to(&mut self, n: u32) -> Value {
        loop {
            match self.hear().await {
                Heard::Reply(reply) if reply["n"] == n => return reply,
                Heard::Closed(code, reason) => panic!("closed: {code} {reason}"),
                _ => {}
            }
        }
    }

    /// The first frame with a message after which nothing is left to do.
    pub async fn settled(&mut self, n: u32) -> Frame {
        let mut frame = self.frame_with(n).await;
        while frame.is_moving() {
            frame = self.frame_with(n).await;
        }
        frame
    }

    /// A frame has no flip, and says so.
    pub fn judge(&self, frame: &Frame) {
        assert_eq!((self.mesh.flips(frame), frame.flips), (0, 0));
        assert!(frame.smallest > 0.0);
    }
}
