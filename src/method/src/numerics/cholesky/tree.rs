//! The elimination tree: which columns of the factor depend on which others.

use super::graph::Graph;

/// Parent of a root.
pub(super) const NONE: u32 = u32::MAX;

/// Computes the parent of each column: the row of the first entry below its diagonal in the factor.
///
/// From: Liu 1986, A Compact Row Storage Scheme for Cholesky Factors Using Elimination Trees.
pub(super) fn elimination_tree(graph: &Graph) -> Vec<u32> {
    let n = graph.n() as u32;
    let mut parent = vec![NONE; n as usize];
    let mut ancestor = parent.clone();
    for j in 0..n {
        for &i in graph.of(j).iter().take_while(|&&i| i < j) {
            // The path from i to its root, which now is j; compressed on the way.
            let mut at = i;
            while at != j {
                let up = std::mem::replace(&mut ancestor[at as usize], j);
                if up == NONE {
                    parent[at as usize] = j;
                    break;
                }
                at = up;
            }
        }
    }
    parent
}

/// Numbers every tree of a forest from its leaves up, subtree by subtree: `order[new] = old`.
pub(super) fn postorder(parent: &[u32]) -> Vec<u32> {
    let n = parent.len();
    // List the children of each vertex. Later ones are put in front of the list first, so each list is increasing.
    let (mut first_child, mut sibling) = (vec![NONE; n], vec![NONE; n]);
    let mut roots = Vec::new();
    for v in (0..n as u32).rev() {
        match parent[v as usize] {
            NONE => roots.push(v),
            p => {
                sibling[v as usize] = first_child[p as usize];
                first_child[p as usize] = v;
            }
        }
    }
    // Walk each tree depth first; an explicit stack, because trees can be as deep as they have vertices.
    let mut order = Vec::with_capacity(n);
    let mut stack = Vec::new();
    while let Some(root) = roots.pop() {
        stack.push(root);
        while let Some(&v) = stack.last() {
            let child = first_child[v as usize];
            if child == NONE {
                order.push(v);
                stack.pop();
            } else {
                first_child[v as usize] = sibling[child as usize];
                stack.push(child);
            }
        }
    }
    order
}

/// Returns the parents after a renumbering `order[new] = old`.
pub(super) fn reordered(parent: &[u32], order: &[u32]) -> Vec<u32> {
    let place = super::graph::inverse(order);
    let new = |p: u32| if p == NONE { NONE } else { place[p as usize] };
    order.iter().map(|&old| new(parent[old as usize])).collect()
}

/// Counts the entries of each column of the factor, including the diagonal, for a graph numbered in postorder.
///
/// Takes nearly linear time: a column's count is the number of row subtrees that contain it, and those are found from
/// their leaves. From: Gilbert, Ng, Peyton 1994, An Efficient Algorithm to Compute Row and Column Counts.
pub(super) fn column_counts(graph: &Graph, parent: &[u32]) -> Vec<u32> {
    let n = parent.len();
    // Find the first descendant of each column.
    let mut first_descendant: Vec<u32> = (0..n as u32).collect();
    for j in 0..n {
        if parent[j] != NONE {
            let p = parent[j] as usize;
            first_descendant[p] = first_descendant[p].min(first_descendant[j]);
        }
    }
    // Count each leaf of a row subtree, and take one off where the paths of two successive leaves meet.
    let mut ancestor: Vec<u32> = (0..n as u32).collect();
    let mut last_leaf = vec![NONE; n];
    let mut counts: Vec<i32> = (0..n as u32)
        .map(|j| i32::from(first_descendant[j as usize] == j))
        .collect();
    for j in 0..n as u32 {
        if parent[j as usize] != NONE {
            counts[parent[j as usize] as usize] -= 1;
        }
        for &i in graph.of(j).iter().rev().take_while(|&&i| i > j) {
            let previous = last_leaf[i as usize];
            if previous != NONE && first_descendant[j as usize] <= previous {
                continue;
            }
            last_leaf[i as usize] = j;
            counts[j as usize] += 1;
            if previous != NONE {
                counts[find(&mut ancestor, previous) as usize] -= 1;
            }
        }
        if parent[j as usize] != NONE {
            ancestor[j as usize] = parent[j as usize];
        }
    }
    // Sum the counts from the leaves up.
    for j in 0..n {
        if parent[j] != NONE {
            counts[parent[j] as usize] += counts[j];
        }
    }
    counts.into_iter().map(|count| count as u32).collect()
}

fn find(ancestor: &mut [u32], v: u32) -> u32 {
    let mut root = v;
    while ancestor[root as usize] != root {
        root = ancestor[root as usize];
    }
    let mut at = v;
    while at != root {
        at = std::mem::replace(&mut ancestor[at as usize], root);
    }
    root
}
