//! Winding of elements whose positions may be folded.

use super::problem_error::ProblemError;

/// A facet of an element with N corners: all of them but one.
struct Facet<const N: usize> {
    /// Corners in increasing order, then `u32::MAX`.
    corners: [u32; N],
    /// `true` if increasing order is an odd permutation of the outward winding.
    is_odd: bool,
    element: u32,
}

impl<const N: usize> Facet<N> {
    /// Creates the facet opposite corner `k`.
    fn opposite(element: &[u32; N], k: usize, id: u32) -> Self {
        let mut corners = *element;
        corners[k] = u32::MAX;
        // Moving the missing corner from place k to the end changes the parity by N − 1 − k, the winding of the facet
        // by k: together the same for all k.
        let mut is_odd = false;
        for end in (1..N).rev() {
            for i in 0..end {
                if corners[i] > corners[i + 1] {
                    corners.swap(i, i + 1);
                    is_odd = !is_odd;
                }
            }
        }
        Self {
            corners,
            is_odd,
            element: id,
        }
    }
}

/// Two elements with a common facet.
#[derive(Clone, Copy)]
struct Neighbors {
    elements: [u32; 2],
    /// `true` if they wind the facet in opposite directions, as elements on its two sides do.
    are_alike: bool,
}

/// Winds triangles or tetrahedra alike across their common edges or faces, by exchanging the last two corners of some;
/// returns the connected part of each, from 0. The first element of a part keeps its winding.
///
/// Positions do not matter, so that a folded mesh can be wound. Costs a sort of the facets.
///
/// # Errors
/// If three elements have a common facet, or the elements are not orientable.
pub(super) fn wind_alike<const N: usize>(
    elements: &mut [[u32; N]],
) -> Result<Vec<u32>, ProblemError> {
    let neighbors = neighbors(elements)?;
    let mut of_element: Vec<Vec<Neighbors>> = vec![Vec::new(); elements.len()];
    for pair in &neighbors {
        for element in pair.elements {
            of_element[element as usize].push(*pair);
        }
    }
    // Spread each part's winding from its first element.
    let mut part = vec![u32::MAX; elements.len()];
    let mut is_turned = vec![false; elements.len()];
    let mut n_parts = 0;
    for first in 0..elements.len() {
        if part[first] != u32::MAX {
            continue;
        }
        part[first] = n_parts;
        let mut pending = vec![first];
        while let Some(element) = pending.pop() {
            for pair in &of_element[element] {
                let [a, b] = pair.elements.map(|e| e as usize);
                let other = if a == element { b } else { a };
                let turns = is_turned[element] == pair.are_alike;
                if part[other] == u32::MAX {
                    part[other] = n_parts;
                    is_turned[other] = turns;
                    pending.push(other);
                } else if is_turned[other] != turns {
                    return Err(ProblemError::NotOrientable { elements: [a, b] });
                }
            }
        }
        n_parts += 1;
    }
    for (element, turns) in elements.iter_mut().zip(is_turned) {
        if turns {
            element.swap(N - 2, N - 1);
        }
    }
    Ok(part)
}

/// Returns all pairs of elements with a common facet.
fn neighbors<const N: usize>(elements: &[[u32; N]]) -> Result<Vec<Neighbors>, ProblemError> {
    let mut facets: Vec<Facet<N>> = (0..)
        .zip(elements)
        .flat_map(|(id, element)| (0..N).map(move |k| Facet::opposite(element, k, id)))
        .collect();
    facets.sort_unstable_by_key(|facet| (facet.corners, facet.element));
    let mut pairs = Vec::new();
    for same in facets.chunk_by(|a, b| a.corners == b.corners) {
        match same {
            [one, other] => pairs.push(Neighbors {
                elements: [one.element, other.element],
                are_alike: one.is_odd != other.is_odd,
            }),
            [one, other, ..] => {
                let elements = [one.element, other.element].map(|element| element as usize);
                return Err(ProblemError::NotOrientable { elements });
            }
            _ => {}
        }
    }
    Ok(pairs)
}
