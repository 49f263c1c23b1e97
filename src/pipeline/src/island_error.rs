//! Why islands cannot stay where they are put.

/// Why islands cannot stay where they are put. They are named by their places in the list, from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum IslandError {
    /// An island is named by a face that is not there, or that has no area.
    #[error("island {0} is named by a face that does not exist or names a vertex twice")]
    UnknownFace(usize),
    /// Two entries name one island.
    #[error("islands {0} and {1} are the same one")]
    Twice(usize, usize),
    /// An island is put beyond the borders of a page.
    #[error("island {0} leaves the page")]
    OffPage(usize),
    /// Two islands are put where they overlap or are nearer than the padding.
    #[error("islands {} and {} {}", islands[0], islands[1], apart(*texels, *padding))]
    TooNear {
        /// Both.
        islands: [usize; 2],
        /// Their distance in texels, 0 where they overlap.
        texels: f64,
        /// The least distance.
        padding: u32,
    },
    /// The others do not fit around those that stay.
    #[error("the other islands do not fit around those that stay where they are put")]
    NoRoom,
}

fn apart(texels: f64, padding: u32) -> String {
    if texels > 0.0 {
        format!("are {texels:.2} texels apart; the padding is {padding}")
    } else {
        "overlap or touch".to_owned()
    }
}

impl IslandError {
    /// Stable name of the cause, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnknownFace(_) => "unknown_face",
            Self::Twice(..) => "island_named_twice",
            Self::OffPage(_) => "island_off_page",
            Self::TooNear { .. } => "islands_too_near",
            Self::NoRoom => "no_room",
        }
    }
}
