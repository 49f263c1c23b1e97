//! How much a search may read.

use super::OnRead;
use unwrapd_method::solver::Control;

/// Words between two reports, about a thousandth of a second.
const BETWEEN_REPORTS: u64 = 300_000;

/// The words that a search may read. The caller is told while they are read, and may end the search.
pub(super) struct ReadLimit<'a> {
    words: u64,
    told: u64,
    is_ended: bool,
    on_read: &'a OnRead<'a>,
}

impl<'a> ReadLimit<'a> {
    pub(super) fn new(words: u64, on_read: &'a OnRead<'a>) -> Self {
        Self {
            words,
            told: 0,
            is_ended: on_read(0) == Control::Finish,
            on_read,
        }
    }

    /// Whether a search goes on that has read so many words.
    pub(super) fn admits(&mut self, read: u64) -> bool {
        !self.is_ended(read) && read < self.words
    }

    /// Whether the caller has ended the search, which has read so many words.
    pub(super) fn is_ended(&mut self, read: u64) -> bool {
        if self.told + BETWEEN_REPORTS <= read {
            self.tell(read);
        }
        self.is_ended
    }

    fn tell(&mut self, read: u64) {
        self.is_ended |= (self.on_read)(read - self.told) == Control::Finish;
        self.told = read;
    }
}
