//! Records on the pipes between server and child: a tag, the length as u32 little-endian, then the bytes.

use std::io::{Read, Write};

/// From the server: a message of a client.
pub const MESSAGE: u8 = b'm';
/// From the server: write a start file and list the handles.
pub const BAKE: u8 = b'b';
/// From the child: the mesh, once, when it is ready.
pub const MESH: u8 = b'M';
/// From the child: a frame.
pub const FRAME: u8 = b'F';
/// From the child: a reply.
pub const REPLY: u8 = b'R';
/// From the child: the handles of the start file that was written.
pub const BAKED: u8 = b'B';
/// From the child: the reason why there is no session.
pub const FAILED: u8 = b'E';

/// Maximum length of a record in bytes, more than any frame has. A larger length means that the stream is out of step.
const MOST_BYTES: usize = 1 << 30;

/// Returns the five bytes before a record: its tag and its length.
pub fn head(tag: u8, length: usize) -> [u8; 5] {
    let [a, b, c, d] = (length as u32).to_le_bytes();
    [tag, a, b, c, d]
}

/// Parses the length of a record from the bytes before it.
///
/// # Errors
/// Fails if the length exceeds the maximum.
pub fn length(head: [u8; 5]) -> std::io::Result<usize> {
    let [_, a, b, c, d] = head;
    let length = u32::from_le_bytes([a, b, c, d]) as usize;
    if MOST_BYTES < length {
        return Err(std::io::ErrorKind::InvalidData.into());
    }
    Ok(length)
}

/// Writes a record.
pub fn write(to: &mut impl Write, tag: u8, bytes: &[u8]) -> std::io::Result<()> {
    to.write_all(&head(tag, bytes.len()))?;
    to.write_all(bytes)?;
    to.flush()
}

/// Reads a record: its tag and its bytes.
pub fn read(from: &mut impl Read) -> std::io::Result<(u8, Vec<u8>)> {
    let mut head = [0; 5];
    from.read_exact(&mut head)?;
    let mut bytes = vec![0; length(head)?];
    from.read_exact(&mut bytes)?;
    Ok((head[0], bytes))
}
