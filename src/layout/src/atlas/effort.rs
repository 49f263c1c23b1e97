//! Effort of a search: how many words it may read, and what it spends them on.
//!
//! Effort is counted in machine words that the search reads, not in seconds, so results are the same on every machine.
use unwrapd_method::solver::Control;

/// Callback that receives the number of words read since its last call. Several threads call it.
/// [`Control::Finish`] ends the search with the best result so far.
pub type OnRead<'a> = dyn Fn(u64) -> Control + Sync + 'a;

/// Ignores reports and never ends a search.
pub(crate) const UNHEARD: &OnRead<'static> = &|_| Control::Continue;

/// Number of charts for which the words of an effort are given. Words grow with the 1.5th power of the number of charts: with more charts
/// a trial takes longer, and there are more layouts.
const CHARTS: f64 = 10.0;
/// Words between two reports, about a thousandth of a second.
const BETWEEN_REPORTS: u64 = 300_000;

/// Effort spent on the layout of one candidate among many.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// Tells which candidates are worth more effort.
    Low,
    /// Tells which of these are among the best.
    Medium,
    /// Makes the final layout.
    High,
}

impl Effort {
    /// Returns the number of annealing runs with different seeds.
    pub(super) fn starts(self) -> u32 {
        match self {
            Self::Low => 1,
            Self::Medium => 2,
            Self::High => 4,
        }
    }

    /// Returns the approximate number of words that this effort reads for `n_charts` charts.
    pub fn words(self, n_charts: usize) -> u64 {
        // With the words of two charts, a low effort would miss a good layout.
        let (words, fewest) = match self {
            Self::Low => (1.5e6, 4),
            Self::Medium => (3e6, 1),
            // With 30 million, 71 sets of charts are fuller by .001 at the mean, and packing takes a fifth longer.
            Self::High => (20e6, 1),
        };
        let n = n_charts.max(fewest) as f64 / CHARTS;
        // Rounded alike everywhere, unlike a power.
        (words * n * n.sqrt()) as u64
    }
}

/// Number of words that a search may read. Reports what is read; the receiver may end the search.
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

    /// Returns whether a search that has read `read` words may go on.
    pub(super) fn admits(&mut self, read: u64) -> bool {
        !self.is_ended(read) && read < self.words
    }

    /// Returns whether the receiver has ended the search, which has read `read` words.
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
