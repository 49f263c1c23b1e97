//! Charts of UV-connected faces and the winding within them.

/// Two faces that share an edge in UV space.
pub(crate) struct Link {
    pub faces: [u32; 2],
    /// `true` if both faces run along the edge in the same direction, that is, are wound against each other.
    pub same_direction: bool,
}

/// Components of linked faces.
pub(crate) struct Charts {
    /// Chart of every face, numbered in the order of their first faces.
    pub of_face: Vec<u32>,
    /// For each chart, whether its winding contradicts itself (a Möbius strip in one piece).
    pub nonorientable: Vec<bool>,
    /// +1 for faces wound as the first face of their chart, −1 for the others; +1 throughout a nonorientable chart.
    pub winding: Vec<i8>,
}

impl Charts {
    pub fn new(n_faces: usize, links: impl Iterator<Item = Link>) -> Charts {
        let mut forest = Forest {
            parent: (0..n_faces as u32).collect(),
            reversed: vec![false; n_faces],
            contradiction: vec![false; n_faces],
        };
        for link in links {
            forest.join(&link);
        }
        let mut charts = Charts {
            of_face: Vec::with_capacity(n_faces),
            nonorientable: Vec::new(),
            winding: Vec::with_capacity(n_faces),
        };
        // A root is the smallest face of its tree, so it has been numbered before any other face asks.
        for face in 0..n_faces as u32 {
            let (root, reversed) = forest.root(face);
            if root == face {
                charts.of_face.push(charts.nonorientable.len() as u32);
                charts
                    .nonorientable
                    .push(forest.contradiction[face as usize]);
            } else {
                charts.of_face.push(charts.of_face[root as usize]);
            }
            let contradiction = forest.contradiction[root as usize];
            charts
                .winding
                .push(if reversed && !contradiction { -1 } else { 1 });
        }
        charts
    }
}

/// Union–find whose links carry a sign: `true` for a face that is wound against its parent.
struct Forest {
    parent: Vec<u32>,
    reversed: Vec<bool>,
    contradiction: Vec<bool>,
}

impl Forest {
    /// Returns the root of `face` and whether `face` is wound against it; halves the path on the way.
    fn root(&mut self, mut face: u32) -> (u32, bool) {
        let mut against = false;
        loop {
            let f = face as usize;
            let parent = self.parent[f];
            if parent == face {
                return (face, against);
            }
            let p = parent as usize;
            self.reversed[f] ^= self.reversed[p]; // a root is not reversed
            self.parent[f] = self.parent[p];
            against ^= self.reversed[f];
            face = self.parent[f];
        }
    }

    /// Joins the trees of two faces under the smaller root.
    fn join(&mut self, link: &Link) {
        let (a, against_a) = self.root(link.faces[0]);
        let (b, against_b) = self.root(link.faces[1]);
        let against = against_a ^ against_b ^ link.same_direction;
        let (root, child) = (a.min(b), a.max(b));
        if root == child {
            self.contradiction[root as usize] |= against;
        } else {
            self.parent[child as usize] = root;
            self.reversed[child as usize] = against;
            self.contradiction[root as usize] |= self.contradiction[child as usize];
        }
    }
}
