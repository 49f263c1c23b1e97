//! Documents whose surfaces are deformed in a cage.

use super::solution::{CageReport, Deformed, FrameObserver, solve};
use super::source::{check_format, check_frames, moved, moved_frame};
use crate::documents::corner_selection::{CornerSelection, VertexSelection};
use crate::documents::input::Merged;
use crate::options::BodyFormat;
use crate::options::DeformOptions;
use crate::start::start;
use crate::tracker::Tracker;
use crate::{PipelineError, limits};
use unwrapd_api::{Limits, Stage};
use unwrapd_deform::cage::{Cage, Caged, CagedSurface, Embedding};
use unwrapd_deform::{Body, Handle, Model, Problem, ProblemError, Solution};
use unwrapd_files::document::{
    AddedVertex, Document, GroupBy, OutputFormat, Primitive, SpaceMap, Subdivision, Upload, Written,
};
use unwrapd_files::io::Format;
use unwrapd_maps::certificate::{Crossings, crossings};
use unwrapd_method::solver::Watch;

/// A document with all its triangles in one cage.
///
/// Positions are those of the meshes, each once: transforms of nodes are not applied, so meshes that a scene keeps
/// apart may share voxels and then move together.
pub struct CagedDocument {
    document: Document,
    cage: Cage,
    problem: Problem,
    handles: Vec<Handle>,
    idle_parts: usize,
    options: CageOptions,
}

/// Options for caging, deforming and writing a document.
#[derive(Clone, Debug)]
pub struct CageOptions {
    /// Number of voxels along the longest side of the bounding box of all triangles.
    pub n_voxels: u32,
    /// Treatment of triangles that span several tetrahedra.
    pub surfaces: Surfaces,
    /// Energy and barrier of the deformation.
    pub model: Model,
    /// Format of the result: glTF for a glTF document, OBJ for OBJ, either for triangles without a document.
    pub format: OutputFormat,
    /// Name of the main file without its extension.
    pub stem: String,
    /// Limits of the computation.
    pub limits: Limits,
}

/// Treatment of triangles that span several tetrahedra, between which the map of the cage is not linear.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Surfaces {
    /// Only their vertices are moved, so the triangles stay flat.
    #[default]
    Whole,
    /// They are split, so that they follow the cage exactly.
    Split,
}

/// Deforms the surfaces of a file in a cage.
pub fn deform(
    upload: &Upload,
    options: &DeformOptions,
    n_voxels: u32,
    tracker: &Tracker,
) -> Result<Deformed, PipelineError> {
    // Read the file and build the cage around it.
    tracker.stage(Stage::Read);
    let format = options.format.and_then(BodyFormat::of_document);
    let format = format.unwrap_or(match Format::of_name(&upload.name) {
        Some(Format::Obj) => OutputFormat::Obj,
        _ => OutputFormat::Glb,
    });
    if options.frames {
        check_frames(format)?;
    }
    let mut caged = CagedDocument::read(
        upload,
        &options.handles,
        CageOptions {
            n_voxels,
            surfaces: if options.split {
                Surfaces::Split
            } else {
                Surfaces::Whole
            },
            model: options.model.clone(),
            format,
            stem: options.caller.stem(upload),
            limits: options.caller.limits,
        },
    )?;
    caged.problem.search = options.pulling.search;
    // Start from the given map, or from the solution in a coarser cage.
    match start(upload, caged.problem.start.len())? {
        Some(start) => {
            caged.problem.start = start;
            caged.problem.untangle_start()?;
        }
        None => caged.start_coarse(tracker),
    }
    // Solve.
    let file = |x: &[f64]| moved_frame(&caged.document, &caged.map(x), caged.options.format);
    let frames = FrameObserver {
        tracker,
        file: &file,
    };
    let viewer: Option<&dyn Watch> = if options.frames { Some(&frames) } else { None };
    let solved = solve(caged.problem(), options.plan(), tracker, viewer)?;
    // Write the deformed document.
    tracker.stage(Stage::Write);
    let (written, cage) = caged.write(&solved.solution)?;
    let mut report = solved.report;
    report.warnings.extend_from_slice(&cage.warnings);
    report.cage = Some(cage);
    Ok(Deformed {
        files: written.files,
        report,
        trace: solved.trace,
    })
}

impl CagedDocument {
    /// Reads a file, builds a cage around all triangles, and binds it to handles, which must name places.
    pub fn read(
        upload: &Upload,
        handles: &[Handle],
        options: CageOptions,
    ) -> Result<Self, PipelineError> {
        let document = Document::read(upload)?;
        limits::check(&options.limits, &document)?;
        check_format(&document, options.format)?;
        // Refuse handles that name vertices: users do not know those of the cage.
        if let Some(handle) = handles.iter().position(Handle::names_vertices) {
            return Err(ProblemError::VertexOfCage { handle }.into());
        }
        // Build the cage, and split the triangles if asked to.
        let positions = positions(&document);
        let cage = Cage::around(&surfaces(&document, &positions), options.n_voxels)?;
        let document = match options.surfaces {
            Surfaces::Whole => document,
            Surfaces::Split => {
                let cuts = document.primitives().iter().map(|p| subdivision(&cage, p));
                let cuts = cuts.collect::<Result<Vec<_>, _>>()?;
                document.subdivided(&cuts)?
            }
        };
        // Bind the handles, and hold the parts without any.
        let mut handles = handles.to_vec();
        let mut selects = handles.iter_mut().filter_map(Handle::select_mut).peekable();
        if selects.peek().is_some() {
            selection(&document, &cage)?.fill(selects)?;
        }
        let mut problem = Problem::new(Body::from(cage.mesh()), &handles, &options.model)?;
        let idle_parts = problem.hold_idle_parts();
        Ok(Self {
            document,
            cage,
            problem,
            handles,
            idle_parts,
            options,
        })
    }

    /// Starts a large cage from the solution in a coarser one, unless handles select vertices, which are those of this
    /// cage.
    fn start_coarse(&mut self, watch: &dyn Watch) {
        if self
            .handles
            .iter_mut()
            .any(|handle| handle.select_mut().is_some())
        {
            return;
        }
        let positions = positions(&self.document);
        let caged = Caged {
            surfaces: &surfaces(&self.document, &positions),
            handles: &self.handles,
            model: &self.options.model,
        };
        caged.start(&mut self.problem, &self.cage, self.options.n_voxels, watch);
    }

    /// Returns the problem of deforming the cage with its handles.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    fn map<'a>(&'a self, x: &'a [f64]) -> CageMap<'a> {
        CageMap {
            cage: &self.cage,
            deformed: x.as_chunks().0,
        }
    }

    /// Writes the document with its surfaces moved by a solution of the problem. Everything else is kept: nodes,
    /// skins, morph targets, materials, UVs.
    pub fn write(self, solution: &Solution) -> Result<(Written, CageReport), PipelineError> {
        let crossings_before = crossings_of(&self.document);
        let map = self.map(&solution.x);
        let (moved, written) = moved(
            &self.document,
            &map,
            self.options.format,
            &self.options.stem,
        )?;
        let report = CageReport {
            voxels: self.cage.mesh().tets().len() / 6,
            tets: self.cage.mesh().tets().len(),
            idle_parts: self.idle_parts,
            surface_vertices: moved.primitives().iter().map(|p| p.positions.len()).sum(),
            surface_triangles: moved.primitives().iter().map(|p| p.triangles.len()).sum(),
            crossings_before,
            crossings_after: crossings_of(&moved),
            warnings: [self.document.warnings(), &written.notes.warnings].concat(),
        };
        Ok((written, report))
    }
}

/// Returns the selection of the vertices of a cage that carry selected vertices of a document.
pub fn selection(document: &Document, cage: &Cage) -> Result<VertexSelection, PipelineError> {
    let (mut places, mut triangles) = (Vec::new(), Vec::new());
    for primitive in document.primitives() {
        let first = places.len() as u32;
        triangles.extend(primitive.triangles.iter().map(|t| t.map(|v| v + first)));
        places.extend(widened(&primitive.positions));
    }
    let tets = cage.embed(&places)?.tets.into_iter();
    let primitives = 0..document.primitives().len();
    Ok(VertexSelection {
        corners: CornerSelection::new(document.clone(), primitives.collect()),
        faces: (0..triangles.len() as u32).collect(),
        triangles,
        carriers: Some(tets.map(|tet| cage.mesh().tets()[tet as usize]).collect()),
    })
}

/// Returns the positions of every primitive.
pub fn positions(document: &Document) -> Vec<Vec<[f64; 3]>> {
    let primitives = document.primitives().iter();
    primitives.map(|p| widened(&p.positions)).collect()
}

/// Returns the triangles of every primitive with their positions.
pub fn surfaces<'a>(
    document: &'a Document,
    positions: &'a [Vec<[f64; 3]>],
) -> Vec<CagedSurface<'a>> {
    let primitives = positions.iter().zip(document.primitives());
    primitives
        .map(|(positions, primitive)| CagedSurface {
            positions,
            triangles: &primitive.triangles,
        })
        .collect()
}

fn crossings_of(document: &Document) -> Crossings {
    let mut found = Crossings::default();
    for group in document.groups(GroupBy::Scene) {
        let merged = Merged::new(document.primitives(), &group);
        found = crossings(&merged.positions, &merged.triangles);
    }
    found
}

// The map of space defined by a deformed cage, and the pieces of triangles on which it is linear.

/// Piecewise linear map of a deformed cage.
pub struct CageMap<'a> {
    pub cage: &'a Cage,
    pub deformed: &'a [[f64; 3]],
}

impl CageMap<'_> {
    /// Embeds places in the cage. Nonfinite places, which only unused vertices of shared accessors can have, count as
    /// the origin.
    fn embed(&self, places: &[[f32; 3]]) -> Embedding {
        let finite = |place: &[f64; 3]| {
            if place.iter().all(|x| x.is_finite()) {
                *place
            } else {
                [0.0; 3]
            }
        };
        let places: Vec<[f64; 3]> = widened(places).iter().map(finite).collect();
        self.cage.embed(&places).unwrap_or_default()
    }
}

impl SpaceMap for CageMap<'_> {
    fn positions(&self, places: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let embedding = self.embed(places);
        rounded(&self.cage.interpolate(&embedding, self.deformed))
    }

    fn normals(&self, places: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let embedding = self.embed(places);
        rounded(
            &self
                .cage
                .normals(&embedding, self.deformed, &widened(normals)),
        )
    }

    fn tangents(&self, places: &[[f32; 3]], tangents: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let embedding = self.embed(places);
        rounded(
            &self
                .cage
                .tangents(&embedding, self.deformed, &widened(tangents)),
        )
    }
}

/// Splits the triangles of a primitive so that each piece lies in one tetrahedron.
pub fn subdivision(cage: &Cage, primitive: &Primitive) -> Result<Subdivision, PipelineError> {
    let positions = widened(&primitive.positions);
    let split = cage.split(&CagedSurface {
        positions: &positions,
        triangles: &primitive.triangles,
    })?;
    let places = rounded(&split.positions[positions.len()..]);
    let added = split.added.iter().zip(places);
    let added = added.map(|(added, position)| AddedVertex {
        position,
        corners: primitive.triangles[added.triangle as usize],
        weights: added.weights,
    });
    Ok(Subdivision {
        added: added.collect(),
        triangles: split.triangles,
    })
}

pub fn widened(vectors: &[[f32; 3]]) -> Vec<[f64; 3]> {
    vectors.iter().map(|v| v.map(f64::from)).collect()
}

fn rounded(vectors: &[[f64; 3]]) -> Vec<[f32; 3]> {
    vectors.iter().map(|v| v.map(|x| x as f32)).collect()
}
