//! Sets as ascending lists.

/// Returns the members of both lists.
pub fn union(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut all = [a, b].concat();
    all.sort_unstable();
    all.dedup();
    all
}

/// Returns the members of the first list that are not in the second.
pub fn difference(a: &[u32], b: &[u32]) -> Vec<u32> {
    let is_left = |x: &&u32| b.binary_search(x).is_err();
    a.iter().filter(is_left).copied().collect()
}
