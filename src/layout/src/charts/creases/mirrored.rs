//! Charts joined alike on both sides of a mirror plane.

use super::joints::Joint;
use super::layout::Layout;
use super::piece::Piece;
use unwrapd_maps::mesh::UnionFind;

impl Layout<'_> {
    /// Joins the pieces of a joint and those of its mirror image, if it is another; both or none.
    pub fn join_alike(&mut self, joint: &Joint, image: Option<&Joint>) -> Joined {
        let before = image.map(|_| self.saved(joint));
        if !self.join(joint) {
            return Joined::None;
        }
        let (Some(image), Some(before)) = (image, before) else {
            return Joined::Alone;
        };
        let of_image = [image.chart, image.run.neighbor].map(|chart| self.pieces.find(chart));
        let joined = if of_image[0] == of_image[1] {
            let is_joined = |h: &u32| {
                let sides = [*h, self.twin[*h as usize]];
                let joined = &self.joined[before.n_joined..];
                joined.iter().any(|h| sides.contains(h))
            };
            if image.run.halfedges.iter().all(is_joined) {
                Joined::Both
            } else {
                Joined::OneAtMost
            }
        } else if self.join(image) {
            Joined::Both
        } else {
            Joined::None
        };
        if joined != Joined::Both {
            self.restore(before);
        }
        joined
    }

    /// What a join may change.
    fn saved(&mut self, joint: &Joint) -> Before {
        let of = [joint.chart, joint.run.neighbor].map(|chart| self.pieces.find(chart));
        self.work += self.places.len() as u64;
        Before {
            n_joined: self.joined.len(),
            places: self.places.clone(),
            is_turned: self.is_turned.clone(),
            vertices: self.vertices.clone(),
            pieces: self.pieces.clone(),
            piece: of.map(|piece| (piece, self.piece[piece as usize].clone())),
        }
    }

    fn restore(&mut self, before: Before) {
        self.joined.truncate(before.n_joined);
        self.places = before.places;
        self.is_turned = before.is_turned;
        self.vertices = before.vertices;
        self.pieces = before.pieces;
        for (number, piece) in before.piece {
            self.piece[number as usize] = piece;
        }
    }
}

/// What became of a joint and its mirror image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joined {
    Both,
    /// It is its own image, or has none.
    Alone,
    /// A piece would cover another.
    None,
    /// With either the pieces of the other are one, as at the end of a ring; so neither is joined.
    OneAtMost,
}

impl Joined {
    /// How many were joined alike.
    pub fn alike(self) -> u64 {
        match self {
            Self::Both => 2,
            Self::Alone => 1,
            Self::None | Self::OneAtMost => 0,
        }
    }
}

/// A layout before a join.
struct Before {
    n_joined: usize,
    places: Vec<[f64; 2]>,
    is_turned: Vec<bool>,
    vertices: UnionFind,
    pieces: UnionFind,
    /// The two pieces, by their numbers.
    piece: [(u32, Piece); 2],
}
