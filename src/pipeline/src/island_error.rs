//! Errors of island placements.

/// Reason why islands cannot have their placements. Islands are numbered by their position in the list, from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum IslandError {
    /// An island is named by a face that does not exist or has no area.
    #[error("island {0} is named by a face that does not exist or names a vertex twice")]
    UnknownFace(usize),
    /// Two entries name one island.
    #[error("islands {0} and {1} are the same one")]
    Twice(usize, usize),
    /// An island is placed across the border of a page.
    #[error("island {0} leaves the page")]
    OffPage(usize),
    /// Two islands are placed so that they overlap or are closer than the padding.
    #[error("islands {} and {} {}", islands[0], islands[1], apart(*texels, *padding))]
    TooNear {
        /// Numbers of the islands.
        islands: [usize; 2],
        /// Their distance in texels; 0 if they overlap.
        texels: f64,
        /// Required distance in texels.
        padding: u32,
    },
    /// The other islands do not fit around the placed ones.
    #[error("the other islands do not fit around those that stay where they are put")]
    NoRoom,
    /// An atlas has too many islands for a session.
    #[error("the atlas has {islands} islands; in a session, at most {most} can make room")]
    TooMany {
        /// Number of its islands.
        islands: usize,
        /// Maximum number.
        most: usize,
    },
    /// A number of a placement is not finite, or out of range.
    #[error("{0}")]
    BadTarget(String),
    /// A handle does not exist.
    #[error("there is no such handle")]
    UnknownHandle,
    /// Islands have no energy or barrier that could be exchanged.
    #[error("islands keep their shapes: there is no energy or barrier to set")]
    NoEnergy,
}

fn apart(texels: f64, padding: u32) -> String {
    if texels > 0.0 {
        format!("are {texels:.2} texels apart; the padding is {padding}")
    } else {
        "overlap or touch".to_owned()
    }
}

impl IslandError {
    /// Returns the stable code of the error, for programs.
    pub fn code(&self) -> &'static str {
        match self {
            Self::UnknownFace(_) => "unknown_face",
            Self::Twice(..) => "island_named_twice",
            Self::OffPage(_) => "island_off_page",
            Self::TooNear { .. } => "islands_too_near",
            Self::NoRoom => "no_room",
            Self::TooMany { .. } => "too_many_islands",
            Self::BadTarget(_) => "bad_target",
            Self::UnknownHandle => "unknown_handle",
            Self::NoEnergy => "bad_parameter",
        }
    }
}
