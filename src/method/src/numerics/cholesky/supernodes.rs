//! Supernodes: columns of the factor that are worked on together.

use super::tree::{self, NONE};

/// Groups of columns as a forest; the columns of the k-th are `starts[k]..starts[k + 1]`, in `order[new] = old`.
pub(super) struct Supernodes {
    pub order: Vec<u32>,
    pub starts: Vec<u32>,
    pub parent: Vec<u32>,
}

/// Size of a group while others join it: its columns, and the rows that they reach together, its own included.
#[derive(Clone, Copy)]
struct SupernodeSize {
    pivots: u32,
    rows: u32,
}

/// Finds the supernodes of columns numbered in postorder, then joins those that are faster together.
pub(super) fn supernodes(parent: &[u32], counts: &[u32], block: usize) -> Supernodes {
    let n = parent.len();
    let starts = fundamental(parent, counts);
    let mut group_of = vec![0; n];
    for (k, window) in starts.windows(2).enumerate() {
        group_of[window[0] as usize..window[1] as usize].fill(k as u32);
    }
    let mut sizes: Vec<SupernodeSize> = (starts.windows(2))
        .map(|w| SupernodeSize {
            pivots: w[1] - w[0],
            rows: counts[w[0] as usize],
        })
        .collect();
    let group_parent: Vec<u32> = (starts.windows(2))
        .map(|w| match parent[w[1] as usize - 1] {
            NONE => NONE,
            p => group_of[p as usize],
        })
        .collect();
    let joined = amalgamate(&group_parent, &mut sizes, block);
    renumber(&starts, &group_parent, &joined)
}

/// Returns the starts of the groups: a column joins the one before if that is its only child and their rows are the
/// same.
fn fundamental(parent: &[u32], counts: &[u32]) -> Vec<u32> {
    let n = parent.len();
    let mut n_children = vec![0_u32; n];
    for &p in parent.iter().filter(|&&p| p != NONE) {
        n_children[p as usize] += 1;
    }
    let joins = |j: usize| {
        parent[j - 1] == j as u32 && n_children[j] == 1 && counts[j - 1] == counts[j] + 1
    };
    let mut starts: Vec<u32> = (0..n)
        .filter(|&j| j == 0 || !joins(j))
        .map(|j| j as u32)
        .collect();
    starts.push(n as u32);
    starts
}

/// Estimates the time of a front in nanoseconds, from its size in unknowns: a constant, flops, adding its update to its
/// parent, reading and writing its panel. Fitted on one core at about 25 Gflop/s; only the ratios matter.
fn nanoseconds(size: SupernodeSize, block: usize) -> f64 {
    let k = (block * size.pivots as usize) as f64;
    let m = (block * size.rows as usize) as f64;
    let flops = k * m * m - m * k * (k - 1.0) + (k - 1.0) * k * (2.0 * k - 1.0) / 6.0;
    400.0 + flops / 25.0 + 0.3 * (m - k) * (m - k) + 0.3 * m * k
}

/// Returns for each group the group that it has joined, or itself: from the leaves up, children join their parent as
/// long as that saves time.
fn amalgamate(parent: &[u32], sizes: &mut [SupernodeSize], block: usize) -> Vec<u32> {
    let n = parent.len();
    let mut joined: Vec<u32> = (0..n as u32).collect();
    let mut children: Vec<Vec<u32>> = vec![Vec::new(); n];
    let saving = |sizes: &[SupernodeSize], child: u32, p: usize| {
        let (c, p) = (sizes[child as usize], sizes[p]);
        let both = SupernodeSize {
            pivots: p.pivots + c.pivots,
            rows: p.rows + c.pivots,
        };
        (
            nanoseconds(c, block) + nanoseconds(p, block) - nanoseconds(both, block),
            both,
        )
    };
    // From the leaves up: try the children of each group, those that save most time first.
    for p in 0..n {
        let mut candidates = std::mem::take(&mut children[p]);
        let mut savings: Vec<(f64, u32)> = candidates
            .iter()
            .map(|&c| (saving(sizes, c, p).0, c))
            .collect();
        savings.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        candidates.clear();
        candidates.extend(savings.iter().map(|s| s.1));
        let mut next = 0;
        while let Some(&child) = candidates.get(next) {
            next += 1;
            let (saved, both) = saving(sizes, child, p);
            if saved > 0.0 {
                sizes[p] = both;
                joined[child as usize] = p as u32;
                // The children of a child that has joined become candidates.
                candidates.append(&mut children[child as usize]);
            } else {
                children[p].push(child);
            }
        }
        if parent[p] != NONE {
            children[parent[p] as usize].push(p as u32);
        }
    }
    // Follow chains of joins to their last group.
    for k in (0..n).rev() {
        joined[k] = joined[joined[k] as usize];
    }
    joined
}

/// Numbers joined groups and their columns in postorder. Columns of a group that joined another come before the
/// latter's own.
fn renumber(starts: &[u32], parent: &[u32], joined: &[u32]) -> Supernodes {
    let n = parent.len();
    // Collect the members of each group that remains.
    let mut members: Vec<Vec<u32>> = vec![Vec::new(); n];
    for (k, &into) in joined.iter().enumerate() {
        members[into as usize].push(k as u32);
    }
    // Number the groups that remain, and find their parents among them.
    let kept: Vec<u32> = (0..n as u32).filter(|&k| joined[k as usize] == k).collect();
    let mut rank = vec![NONE; n];
    for (i, &k) in kept.iter().enumerate() {
        rank[k as usize] = i as u32;
    }
    let kept_parent: Vec<u32> = (kept.iter())
        .map(|&k| match parent[k as usize] {
            NONE => NONE,
            p => rank[joined[p as usize] as usize],
        })
        .collect();
    // Put groups and columns in postorder.
    let postorder = tree::postorder(&kept_parent);
    let mut found = Supernodes {
        order: Vec::with_capacity(starts[n] as usize),
        starts: vec![0],
        parent: tree::reordered(&kept_parent, &postorder),
    };
    for &i in &postorder {
        for &k in &members[kept[i as usize] as usize] {
            found
                .order
                .extend(starts[k as usize]..starts[k as usize + 1]);
        }
        found.starts.push(found.order.len() as u32);
    }
    found
}
