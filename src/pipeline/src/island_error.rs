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
    /// No island has what a rule selects.
    #[error("`control` {0:?} selects no island")]
    SelectsNothing(String),
    /// A rule names a face that does not exist.
    #[error("`control` {rule:?}: primitive {} has no face {}", face[0], face[1])]
    NoSuchFace {
        /// The rule.
        rule: String,
        /// Primitive and face.
        face: [u32; 2],
    },
    /// An island is in two groups, or locked and in a group.
    #[error("the island of face {face} cannot follow both {:?} and {:?}", rules[0], rules[1])]
    Conflict {
        /// A face of the island, in its atlas.
        face: u32,
        /// The rules.
        rules: [String; 2],
    },
    /// Islands of a group have different places, densities or scales.
    #[error("the island of face {face} has other rules than the rest of its group {rule:?}")]
    DividedGroup {
        /// A face of the island, in its atlas.
        face: u32,
        /// The rule of the group.
        rule: String,
    },
    /// A rectangle has no room for its islands, even without others.
    #[error("`rectangle` {0} is too small for its islands")]
    RectangleTooSmall(String),
    /// A locked island crosses the border of a page.
    #[error("the locked island of face {face} crosses the border of a page")]
    LockedOffPage {
        /// A face of the island, in its atlas.
        face: u32,
    },
    /// An island is placed on a locked one, or closer to it than the padding.
    #[error("island {island} and a locked one {}", apart(*texels, *padding))]
    NearLocked {
        /// Number of the island.
        island: usize,
        /// Their distance in texels; 0 if they overlap.
        texels: f64,
        /// Required distance in texels.
        padding: u32,
    },
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
            Self::UnknownFace(_) | Self::NoSuchFace { .. } => "unknown_face",
            Self::Twice(..) => "island_named_twice",
            Self::OffPage(_) | Self::LockedOffPage { .. } => "island_off_page",
            Self::TooNear { .. } | Self::NearLocked { .. } => "islands_too_near",
            Self::SelectsNothing(_) => "selects_nothing",
            Self::Conflict { .. } => "island_in_two_groups",
            Self::DividedGroup { .. } => "divided_group",
            Self::RectangleTooSmall(_) => "rectangle_too_small",
            Self::NoRoom => "no_room",
            Self::TooMany { .. } => "too_many_islands",
            Self::BadTarget(_) => "bad_target",
            Self::UnknownHandle => "unknown_handle",
            Self::NoEnergy => "bad_parameter",
        }
    }
}
