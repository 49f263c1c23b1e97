//! Documents prepared for unwrapping.

use std::collections::HashMap;

use super::merged::check_edges;
use crate::PipelineError;
use crate::arrays::plan::Plan;
use crate::limits;
use crate::options::{GivenSeams, Options, check_grouping};
use unwrapd_files::document::{
    Document, DocumentError, GroupBy, OldUvs, OutputFormat, Primitive, Upload,
};
use unwrapd_maps::mesh::Resolution;

/// A document in the form in which it is written.
pub struct Prepared {
    pub document: Document,
    /// Meshes that share one atlas.
    pub group_by: GroupBy,
    /// Options, with seams in the numbering of the document.
    pub seams: Options,
    /// Origins of vertices and faces in the file.
    pub origins: Origins,
    /// Texture for which kept UVs were made, if the file states it.
    pub texture: Option<Resolution>,
}

/// Original numbers of vertices and faces over all primitives of a document; `None` if they are unchanged.
pub struct Origins {
    pub vertices: Option<Vec<u32>>,
    pub faces: Option<Vec<u32>>,
}

impl Prepared {
    /// Reads a document, and rejects options that it cannot be written with before any work is done.
    pub fn read(upload: &Upload, options: &Options, plan: &Plan) -> Result<Self, PipelineError> {
        let document = Document::read(upload)?;
        limits::check(&options.caller.limits, &document)?;
        // Choose the grouping, and reject what cannot be written.
        let group_by = match options.format {
            // An OBJ file has one UV space, whatever was asked for.
            OutputFormat::Obj => GroupBy::Scene,
            OutputFormat::Glb | OutputFormat::Gltf => {
                options.group_by.unwrap_or(document.grouping())
            }
        };
        check_grouping(options, Some(group_by)).map_err(PipelineError::InvalidOptions)?;
        if options.baking.rebake && !can_rebake(&document, options.format) {
            let what =
                "new textures for an OBJ file from another format than glTF: write .glb or .gltf";
            return Err(DocumentError::UnsupportedOutput(what.to_owned()).into());
        }
        // Convert the document to the form of the output.
        let old_uvs = if plan.reads_uvs() {
            OldUvs::Kept
        } else {
            OldUvs::Sampled
        };
        check_edges(document.primitives(), options)?;
        let texture = document.texture_of(options.sets.source());
        let conversion = document.for_output(options.format, old_uvs)?;
        // Renumber the given seams if vertices have changed their numbers.
        let mut seams = options.clone();
        if let (Some(GivenSeams::Edges(edges)), Some(vertices)) =
            (&options.seams, &conversion.vertices)
        {
            let primitives = conversion.document.primitives();
            let edges = renumbered(edges, vertices, primitives);
            seams.seams = Some(GivenSeams::Edges(edges));
        }
        Ok(Self {
            document: options.nodes().prepared(conversion.document)?,
            group_by,
            seams,
            origins: Origins {
                vertices: conversion.vertices,
                faces: conversion.faces,
            },
            texture,
        })
    }
}

fn can_rebake(document: &Document, format: OutputFormat) -> bool {
    matches!(document, Document::Gltf(_)) || format != OutputFormat::Obj
}

/// Renumbers [checked](check_edges) edges of a file for each primitive that now contains them. `vertices` are the
/// original numbers of the vertices of all primitives.
fn renumbered(edges: &[[u32; 2]], vertices: &[u32], primitives: &[Primitive]) -> Vec<[u32; 2]> {
    // Copies of a vertex lie in one place, so the first in each primitive is enough.
    let mut numbers: HashMap<u32, Vec<(usize, u32)>> = edges
        .as_flattened()
        .iter()
        .map(|&v| (v, Vec::new()))
        .collect();
    let sizes = primitives.iter().map(|primitive| primitive.positions.len());
    let owners = sizes
        .enumerate()
        .flat_map(|(index, n)| std::iter::repeat_n(index, n));
    for ((number, vertex), owner) in (0..).zip(vertices).zip(owners) {
        if let Some(numbers) = numbers.get_mut(vertex)
            && numbers.last().is_none_or(|(last, _)| *last != owner)
        {
            numbers.push((owner, number));
        }
    }
    let mut inside = Vec::new();
    for [a, b] in edges {
        let others: HashMap<usize, u32> = numbers[b].iter().copied().collect();
        let both = numbers[a]
            .iter()
            .filter_map(|(owner, a)| Some([*a, *others.get(owner)?]));
        inside.extend(both);
    }
    inside
}
