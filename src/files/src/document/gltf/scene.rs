//! Nodes that show meshes.

use super::json::{MemorySize, array_mut, as_unsigned, invalid, item, items, unsigned};
use crate::document::DocumentError;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// Three rows of a linear map and a shift.
pub(super) type Affine = [[f64; 4]; 3];

const IDENTITY: Affine = [
    [1.0, 0.0, 0.0, 0.0],
    [0.0, 1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0, 0.0],
];

/// JSON pointer, within a node, of the instances of its mesh.
const INSTANCES: &str = "/extensions/EXT_mesh_gpu_instancing";

/// Gives every node that shows a mesh a mesh of its own: the first keeps it, the others get copies with the same
/// accessors.
///
/// # Errors
/// If one node shows a mesh several times: its instances cannot have UVs of their own.
pub(super) fn separate_meshes(json: &mut Value) -> Result<(), DocumentError> {
    size_when_separate(json)?.check()?;
    let mut shown = BTreeSet::new();
    for node in 0..items(json, "nodes")?.len() {
        let Some(mesh) = unsigned(item(json, "nodes", node)?, "mesh")? else {
            continue;
        };
        if item(json, "nodes", node)?.pointer(INSTANCES).is_some() {
            return Err(DocumentError::Instanced(node));
        }
        if shown.insert(mesh) {
            continue;
        }
        let copy = item(json, "meshes", mesh)?.clone();
        let meshes = array_mut(json, "meshes")?;
        meshes.push(copy);
        let own = meshes.len() - 1;
        array_mut(json, "nodes")?[node]["mesh"] = json!(own);
    }
    Ok(())
}

/// Returns the size of the document including all copies.
fn size_when_separate(json: &Value) -> Result<MemorySize, DocumentError> {
    let mut times: BTreeMap<usize, usize> = BTreeMap::new();
    for node in items(json, "nodes")? {
        if let Some(mesh) = unsigned(node, "mesh")? {
            *times.entry(mesh).or_default() += 1;
        }
    }
    let mut size = MemorySize::of(json);
    for (mesh, n_nodes) in times {
        size += MemorySize::of(item(json, "meshes", mesh)?).times(n_nodes - 1);
    }
    Ok(size)
}

/// Returns the placement of each mesh in the scene, by the first node that shows it; the identity for meshes that no
/// node shows, or that a skin moves. Mirrored ones are mirrored back, so that faces keep their winding.
pub(super) fn placements(json: &Value) -> Result<Vec<Affine>, DocumentError> {
    let nodes = items(json, "nodes")?;
    let mut parents = vec![None; nodes.len()];
    for (parent, node) in nodes.iter().enumerate() {
        for child in items(node, "children")? {
            let child = as_unsigned(child).filter(|child| *child < nodes.len());
            let child = child.ok_or_else(|| invalid("a node has a child that does not exist"))?;
            parents[child] = Some(parent);
        }
    }
    let mut globals = vec![None; nodes.len()];
    let mut placements = vec![None; items(json, "meshes")?.len()];
    for (index, node) in nodes.iter().enumerate() {
        let Some(mesh) = unsigned(node, "mesh")? else {
            continue;
        };
        let placement = placements
            .get_mut(mesh)
            .ok_or_else(|| invalid(format!("meshes[{mesh}] does not exist")))?;
        if placement.is_none() && node.get("skin").is_none() {
            *placement = Some(unmirrored(global(nodes, &parents, index, &mut globals)?));
        }
    }
    Ok(placements
        .into_iter()
        .map(|p| p.unwrap_or(IDENTITY))
        .collect())
}

/// Returns for each mesh whether the placement by the first node that shows it is the identity.
pub(super) fn is_in_place(json: &Value) -> Result<Vec<bool>, DocumentError> {
    let placements = placements(json)?;
    Ok(placements.iter().map(|place| *place == IDENTITY).collect())
}

/// Returns the placed point.
pub(super) fn placed(placement: &Affine, point: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = point.map(f64::from);
    placement.map(|[a, b, c, d]| (a * x + b * y + c * z + d) as f32)
}

/// Returns the transform of a node in the scene; `globals` caches those found on the path to the root.
fn global(
    nodes: &[Value],
    parents: &[Option<usize>],
    node: usize,
    globals: &mut [Option<Affine>],
) -> Result<Affine, DocumentError> {
    let mut path = vec![node];
    while let Some(parent) = parents[path[path.len() - 1]] {
        if globals[parent].is_some() {
            break;
        }
        path.push(parent);
        if path.len() > nodes.len() {
            return Err(invalid("a node is its own ancestor"));
        }
    }
    let mut transform = parents[path[path.len() - 1]].and_then(|parent| globals[parent]);
    for &node in path.iter().rev() {
        let own = local(&nodes[node]);
        transform = Some(transform.map_or(own, |above| product(&above, &own)));
        globals[node] = transform;
    }
    Ok(transform.unwrap_or(IDENTITY))
}

/// Returns the transform of a node relative to its parent.
fn local(node: &Value) -> Affine {
    if let Some(m) = numbers::<16>(node, "matrix") {
        return [0, 1, 2].map(|row| [0, 1, 2, 3].map(|column| m[4 * column + row]));
    }
    let [x, y, z, w] = numbers(node, "rotation").unwrap_or([0.0, 0.0, 0.0, 1.0]);
    let scale: [f64; 3] = numbers(node, "scale").unwrap_or([1.0; 3]);
    let shift: [f64; 3] = numbers(node, "translation").unwrap_or([0.0; 3]);
    let turn = [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - z * w),
            2.0 * (x * z + y * w),
        ],
        [
            2.0 * (x * y + z * w),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - x * w),
        ],
        [
            2.0 * (x * z - y * w),
            2.0 * (y * z + x * w),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ];
    [0, 1, 2].map(|row| {
        let [a, b, c] = turn[row];
        [a * scale[0], b * scale[1], c * scale[2], shift[row]]
    })
}

fn numbers<const N: usize>(node: &Value, key: &str) -> Option<[f64; N]> {
    let values: Option<Vec<f64>> = node
        .get(key)?
        .as_array()?
        .iter()
        .map(Value::as_f64)
        .collect();
    values?.try_into().ok()
}

/// Returns the composition: b, then a.
fn product(a: &Affine, b: &Affine) -> Affine {
    a.map(|row| {
        [0, 1, 2, 3].map(|column| {
            let shift = if column == 3 { row[3] } else { 0.0 };
            (0..3).map(|k| row[k] * b[k][column]).sum::<f64>() + shift
        })
    })
}

fn unmirrored([a, b, c]: Affine) -> Affine {
    let minor = |j: usize, k: usize| b[j] * c[k] - b[k] * c[j];
    let determinant = a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1);
    if determinant < 0.0 {
        [a.map(|x| -x), b, c]
    } else {
        [a, b, c]
    }
}
