//! Unwraps meshes: a glTF goes in and comes back with UVs in which no triangle is flipped, degenerate or overlapping, proven on the
//! bytes written, and with a report of its distortion.
//!
//! The method is that of *Locally Injective Mappings* (Schüller, Kavan, Panozzo, Sorkine-Hornung 2013): add to a deformation energy a
//! barrier that goes to infinity as an element's area goes to zero, and minimize the sum with Newton's method, from a start without
//! inverted elements and with steps that never pass through an inversion. Every iterate is a valid map.
//!
//! ```
//! use unwrapd::{Claims, Settings, Unobserved, certify, unwrap};
//!
//! // A pyramid without its base.
//! let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 0.7_f32]];
//! let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
//! let atlas = unwrap(&positions, &triangles, &Settings::default(), &Unobserved)?;
//!
//! let uvs = atlas.corner_uvs(); // [[u, v]; 3] per triangle, v up, in the unit square, exact in f32
//! assert_eq!(uvs.len(), triangles.len());
//!
//! let positions = positions.map(|p| p.map(f64::from));
//! assert!(certify(&positions, &triangles, &uvs, &Claims::default()).is_bijective());
//! # Ok::<(), unwrapd::PipelineError>(())
//! ```
//!
//! # Stability
//!
//! The functions and types that this page lists under "Re-exports" by themselves are stable: [`unwrap()`], [`unwrap_file`],
//! [`repack_file`], [`measure_file`], [`verify_file`], [`edit_file`], [`deform_file`], [`solve_file`], [`warp_file`], [`certify`],
//! [`Problem`], [`Session`], and what their signatures name. The modules are re-exported for researchers and may change in any
//! release. `src/stability.md` says more.
//!
//! # Crates
//!
//! ```text
//!  file ─► document::read ─► mesh::Surface ─► charts ─► embed ─► atlas ─► document::write ─► file
//!                                                                              │
//!                            report, pictures ◄─ measure, certificate ◄─ document::read again
//!
//!  http ─► jobs ─► store (records, files) ◄─ jobs ─► compute child process ─► pipeline
//!  http ─► sessions ───────────────────────────────► session child process ─► pipeline, deform
//!  cli  ─► bulk ───────────────────────────────────► compute child process ─► pipeline
//!  cli, Python and Node ────────────────────────────────────────────────────► pipeline
//! ```
//!
//! | crate | modules | knows nothing of |
//! |---|---|---|
//! | `unwrapd-method` | [`numerics`], [`energy`], [`barrier`], [`solver`] | meshes, files, JSON |
//! | `unwrapd-maps` | [`mesh`], [`plane`], [`cut`], [`embed`], [`certificate`], [`measure`] | files, cutting into charts |
//! | `unwrapd-layout` | [`charts`], [`atlas`] | files |
//! | `unwrapd-api` | [`mod@options`], tasks, messages, formats | any computation |
//! | `unwrapd-files` | [`io`], [`polygon`], [`document`], [`picture`], [`bake`] | how maps are made |
//! | `unwrapd-deform` | [`deform`] | documents |
//! | `unwrapd-pipeline` | [`pipeline`] | processes, the network |
#![cfg_attr(
    feature = "service",
    doc = "| `unwrapd-worker` | [`worker`]: the child's side of jobs and sessions | the server |"
)]
#![cfg_attr(
    feature = "service",
    doc = "| `unwrapd-server` | [`jobs`], [`store`], [`sessions`], [`webhooks`], [`http`] | every crate above but `unwrapd-api` |"
)]
#![cfg_attr(
    feature = "service",
    doc = "| `unwrapd` | [`bulk`], [`cli`], this facade | |"
)]
//!
//! The geometry is a pure library: no I/O, no clock of its own, no logging, no global state. Options, threads and the observer, which
//! also tells the time, are arguments. The server does no geometry: every computation runs in a child process of the same program with
//! limits of its own, so that a mesh that exhausts memory or finds a bug ends its own job and never the service.
//!
//! `src/decisions.md` records the decisions that a reader may wonder about.
//!
//! # Certificate
//!
//! A map that is injective in `f64` need not be after rounding, so the atlas lives on the integer grid of 2⁻²³, which `f32` holds
//! exactly: orientation is an exact determinant. [`atlas`] moves the vertices whose rounding would flip a triangle; nothing else trusts
//! it: the written bytes are read again and judged by [`certificate`]. The judge shares only exact predicates and mesh types with the
//! code that it judges.
//!
//! v points down in glTF. Internally v is up; the glTF writer stores 1 − v, so an unmirrored chart has *negative* signed area in the
//! numbers of a glTF, and positive in those of an OBJ.
//!
//! # Units
//!
//! Rest shapes are scaled to mean area 1 before they are optimized, and back afterward. So β, ε, tolerances and energies mean the same
//! for a ring and a city. A problem file means its numbers in the unit of its mesh unless it says `"units": "normalized"`. ε of a chart
//! is min(10⁻⁵ · smallest rest area, 0.1 · smallest area of the start).
//!
//! Every surface is cut and mapped in canonical order ([`mesh::canonical_order`]), so a mesh gets the same UVs in whatever order a file
//! has its vertices and faces.
//!
//! # Invariants
//!
//! 1. What leaves [`embed`] has no flip; every iterate of [`solver`] has positive areas; what [`certificate`] says is
//!    exact on the written bytes.
//! 2. Same input bytes and options, same output bytes, for any number of threads, on one processor type.
//! 3. Everything in a document that a job was not asked to change is still there.
//! 4. An accepted job is never lost: it ends succeeded, failed with a cause, or cancelled, over any crash or restart. Outdated
//!    attempts change nothing.
//! 5. A caller without the key of an owner learns nothing of what that owner made, not even that it exists.
//! 6. No input makes the process panic, hang, read a file or open a connection it was not given, or exceed its memory.

pub use unwrapd_deform::{Problem, Session};
pub use unwrapd_maps::certificate::{Certificate, Claims, certify};
pub use unwrapd_pipeline::{
    DeformOptions, EditOptions, MeasureOptions, Observer, Options, PipelineError, RepackOptions,
    Report, Settings, SolveOptions, Unobserved, VerifyOptions, WarpOptions, deform_file,
    edit_document as edit_file, measure_document as measure_file, repack_document as repack_file,
    solve_file, unwrap, unwrap_document as unwrap_file, verify_document as verify_file, warp_file,
};

pub use unwrapd_api::options;
pub use unwrapd_deform as deform;
pub use unwrapd_files::{bake, document, io, picture, polygon};
pub use unwrapd_layout::{atlas, charts};
pub use unwrapd_maps::{certificate, cut, embed, measure, mesh, plane};
pub use unwrapd_method::{barrier, energy, numerics, solver};
pub use unwrapd_pipeline as pipeline;
#[cfg(feature = "service")]
pub use unwrapd_server::{http, jobs, sessions, store, webhooks};
#[cfg(feature = "service")]
pub use unwrapd_worker as worker;

#[cfg(feature = "service")]
pub mod bulk;

#[cfg(feature = "service")]
pub mod cli;
