//! unwrapd unwraps meshes: a glTF goes in, comes back with UVs in which no triangle is flipped or degenerate, proven on
//! the bytes written, and with a report of its distortion.
//!
//! It stands on one paper, *Locally Injective Mappings* (Schüller, Kavan, Panozzo, Sorkine-Hornung 2013): add to a
//! deformation energy a barrier that goes to infinity as an element's area goes to zero, and minimize the sum with
//! Newton's method, from a start in which no element is inverted and with steps that never pass through an inversion.
//! Every iterate is a valid map.
//!
//! # In a few lines
//!
//! ```
//! use unwrapd::pipeline::{Settings, Unobserved, unwrap};
//!
//! // A pyramid without its base.
//! let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.5, 0.5, 0.7_f32]];
//! let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
//! let atlas = unwrap(&positions, &triangles, &Settings::default(), &Unobserved)?;
//!
//! let uvs = atlas.corner_uvs(); // [[u, v]; 3] per triangle, v up, in the unit square, exact in f32
//! assert_eq!(uvs.len(), triangles.len());
//!
//! use unwrapd::certificate::{Claims, certify};
//! let positions = positions.map(|p| p.map(f64::from));
//! assert!(certify(&positions, &triangles, &uvs, &Claims::default()).is_bijective());
//! # Ok::<(), unwrapd::pipeline::PipelineError>(())
//! ```
//!
//! Each stage is usable alone: [`embed::start`] gives a valid embedding of a disk, [`embed::optimize`] improves a given
//! one under an observer, [`certificate::certify`] judges UVs from anywhere, [`measure::measure`] says what they are
//! worth.
//!
//! # One picture
//!
//! ```text
//!  file ─► document::read ─► mesh::Surface ─► charts ─► embed ─► atlas ─► document::write ─► file
//!                                                                              │
//!                            report, pictures ◄─ measure, certificate ◄─ document::read again
//!
//!  http ─► jobs ─► store (records, files) ◄─ jobs ─► compute child process ─► pipeline
//!      unwrapd serve                    unwrapd worker, or the same serve
//!  http ─► sessions ───────────────────────────────► session child process ─► pipeline, deform::Session
//!  cli ─► bulk (lists, records, summaries) ────────► compute child process ─► pipeline
//!  cli  ──────────────────────────────────────────────────────────────────► pipeline
//!  Python package (`src/python`, a crate of its own) ──────────────────────► pipeline, deform, cli
//!  npm package (`src/node`, a crate of its own) ──────────────────────────► pipeline
//! ```
//!
//! The geometry is a pure library: no I/O, no clock of its own, no logging, no global state. Options, threads and the
//! observer, which also tells the time, are arguments; a time limit only ends the work early. The server does no geometry: every
//! computation runs in a child process of the same program, with a memory limit and a wall-clock limit of its own, so
//! that a mesh that exhausts memory or finds a bug ends its own job with a cause and never the service.
//!
//! # Modules, and who may import whom
//!
//! In this order; each may import only earlier ones. A test reads the sources and enforces it, and which outside crates a
//! module may name.
//!
//! | module | what lives there |
//! |---|---|
//! | [`mod@options`] | what an option is, for code, JSON and the command line: written once |
//! | [`numerics`] | multifrontal sparse Cholesky (symbolic once, numeric each iteration), exact predicates, 2×2 and 3×3 matrices, boxes, convex hulls |
//! | [`mesh`] | surfaces welded by position, their defects, adjacency, [`mesh::Disk`]: proven to be one disk, holes allowed; planar and tetrahedral meshes; triangles inside polygons; readers and writers, and the table of file formats; UVs as files have them |
//! | [`plane`] | plane geometry of many pieces, for those who make maps: a spatial index, segments, polygons, triangles that overlap |
//! | [`cut`] | surfaces opened along seams to disks |
//! | [`energy`], [`barrier`] | densities as functions of singular values, for triangles and tetrahedra; quadratic terms; what keeps elements from inverting |
//! | [`solver`] | projected Newton, exact largest step, line search, status; handles that travel, or are dragged; the paper's own iteration |
//! | [`embed`] | a valid start for every disk and the way from it to the optimum |
//! | [`charts`] | where to cut: surfaces divided, mapped, and parted where the maps fold over themselves |
//! | [`atlas`] | orientation, packing, pages, the integer grid |
//! | [`certificate`] | exact judgment of UVs as a file has them |
//! | [`measure`] | distortion, seams, packing, overlaps of any UV map |
//! | [`document`] | glTF, OBJ and others, with everything else preserved |
//! | [`picture`] | UV layouts and distortion as PNG, pictures with transparency |
//! | [`bake`] | textures resampled from one UV map of a surface to another |
//! | [`deform`] | bodies of the plane and of space pulled by handles, at once or in a session, an iteration at a time; from pictures, drawings and surfaces in cages |
//! | [`pipeline`] | every application as a function from arrays or a file's bytes to files' bytes and a report |
#![cfg_attr(
    feature = "service",
    doc = "| [`jobs`], [`store`], [`http`] | queue and compute child; records in SQLite or PostgreSQL, files in a folder or S3; routes |"
)]
#![cfg_attr(
    feature = "service",
    doc = "| [`sessions`] | bodies, pictures and UVs pulled live: messages in, frames out, each in a child process |"
)]
#![cfg_attr(
    feature = "service",
    doc = "| [`webhooks`] | ends of jobs, told to others |"
)]
#![cfg_attr(
    feature = "service",
    doc = "| [`bulk`] | many files in one run: lists, shards, records, gates, summaries |"
)]
#![cfg_attr(feature = "service", doc = "| [`cli`] | commands |")]
//!
//! # The certificate
//!
//! A map that is injective in f64 need not be after rounding, so the atlas lives on the integer grid of 2⁻²³, exact in
//! f32: orientation is an exact determinant. [`atlas`] moves the vertices whose rounding would flip a triangle; nothing
//! else trusts it: the written bytes are read again and judged by [`certificate`].
//!
//! The judge shares no code with those it judges but the exact predicates of
//! [`numerics::predicates`] and the types and edges of [`mesh`]. Makers of maps search for overlaps
//! too, with what is in [`plane`]; none of them imports [`certificate`], and it imports nothing of
//! theirs, so that it finds their faults. Only [`measure`], which judges as well, and [`pipeline`],
//! which asks for the judgment, build on it.
//!
//! Pages of an atlas lie side by side along u. `f32` is coarser there, so the grid of three and more pages is too; along the shorter side of
//! a texture it has as much larger steps as texels are larger, so that charts are rounded alike in both directions.
//!
//! v points down in glTF. Internally v is up; the glTF writer stores 1 − v, so an unmirrored chart has *negative* signed
//! area in the numbers of a glTF, and positive in those of an OBJ. Orientation is judged relative to the chart.
//!
//! # Units
//!
//! A chart's rest shapes are scaled to mean area 1 before they are optimized and back afterward, and so are bodies that
//! are deformed, which are moved to the origin besides. So β, ε, tolerances and energies mean the same for a ring and a
//! city. A problem file means its numbers in the unit of its mesh, as those of the authors do, unless it says
//! `"units": "normalized"`. Faces of zero area get a rest shape of bounded aspect. ε of a chart is
//! min(10⁻⁵ · smallest rest area, 0.1 · smallest area of the start).
//!
//! # The order of the input
//!
//! Every surface is cut and mapped in canonical order ([`mesh::canonical_order`]): breadth first from a halfedge that its shape singles
//! out. So a mesh gets the same UVs whatever order a file has its vertices and faces in, and ties are broken by its shape, not by
//! the tool that wrote it. Moved, rotated and scaled meshes get the same cut but for rounding: maps are cut for fill in coordinates of
//! their own.
//!
//! # Where this differs from what one might expect
//!
//! - Indices are plain `u32` in plain arrays, not typed ids: researchers hand in and take out their own arrays, and a
//!   conversion at every border would be most of the code.
//! - GLB framing is our own 60 lines: the `gltf` crate's typed round trip loses members and its validation panics.
//! - The readers of OBJ, OFF, PLY and STL are our own: the crates that were tried lose what writing back needs, refuse
//!   files that occur, or never return on crafted ones (the docs of `mesh::io` say which).
//! - Polygons are filled with triangles by `spade`, which [`mesh`] may name for that in `mesh::polygon`, as a part of the feature
//!   `files`: a fan from the first corner overlaps itself in concave ones. What is left as a fan is named in a warning.
//! - What UVs are worth has a module of its own, [`measure`], apart from the certificate that says whether they hold.
//! - An OBJ file has one UV space: written as OBJ, a document is one group whatever `group-by` says. Written as glTF it is one unless
//!   `group-by` is given, and becomes glTF before anything else is done, so that one code knows sets, materials and textures.
//! - Charts too small for the grid (fewer than 16 cells per triangle) are enlarged and counted: the one exception to uniform
//!   texel density.
//! - The geometry library (`default-features = false`) has neither files nor JSON; the feature `files` adds them.
//! - The pages of an atlas are the first row of UDIM tiles, at most ten: v stays in the unit interval, where floating point is finest.
//! - More pages never give less density: a layout is looked for on one page, then on two, and so on, each time from the charts of the
//!   fullest so far, which stays unless a fuller one is found. Nothing of that depends on how many pages there may be. A page costs
//!   more than the one before where there are more charts by then: Spot takes .3 s on one page and 28 s on ten. More than 512
//!   charts, of which the fill grows evenly with the pages, are laid out on all pages at once.
//! - Charts come from the top down: disks are slit until they keep a bound on the distortion, rather than regions grown or
//!   merged. Slits are seams but make no charts, so there are a tenth as many charts, and the seams are a third as long.
//! - What consists of planes is put together instead: each plane is laid into the page as it is, and they are joined along straight
//!   borders, first where a seam would cost most, as long as none covers another. So no plane is bent, stretched or cut,
//!   and only what is round between them is mapped.
//! - A surface of noise has no unfolding: a chart of it is cut where the smoothed surface needs it, and mapped as it is. The bound
//!   is one on the smoothed surface then, and the report gives both distortions; a bound that a caller gives stays one on the
//!   surface itself, however many charts that takes.
//! - A closed surface is opened in up to four ways, each between two vertices far apart. Slits are planned for each way by prediction,
//!   and the best has the least length of seams times the distortion that is left. The seams of four meshes in several orders,
//!   scales and rotations differ by 4 % at the median; opened at the first vertex, they differed by 11 %
//!   (`tests/bench/invariance.py`).
//! - Few charts pack badly: those that do not fill their convex hulls are cut, after they are mapped, as long as the atlas
//!   gains more from it than the seam costs. That takes back a part of what slits saved, and the price is the user's.
//!   Hulls and sizes tell about how many cuts pay, by a fit to layouts; one cut less, that many and one more are then laid out.
//! - A surface that is its own mirror image, exactly or nearly, is cut alike on both sides. It is not halved: seams are planned on the
//!   whole, and each is drawn once more along the cheapest edges near its mirror image, so that it does not matter whether
//!   the triangles are mirrored, too. Planes are joined in pairs that are mirror images of each other.
//! - Placing charts one after the other leaves room between them. All of a page move and turn at once afterward,
//!   pushed apart by Levenberg's method on rasters of their distances while the page shrinks, and end exactly as far from each
//!   other as they must be; a raster decides only where that fails, and for crowds.
//! - Islands that stay where a user puts them take their cells before the first chart is placed. The others have one scale among
//!   themselves, the largest at which each finds a place; what stays has its own, and is not moved to make room.
//! - Layouts are searched on a raster of only 96 cells, on which charts may overlap by half a cell: looked at briefly, many ways to
//!   cut charts can be compared, and what a fine raster would add is found again when charts are pushed apart.
//! - Unwrapping minimizes the symmetric Dirichlet energy by default ([`pipeline::Mapping`]), in which the bound is stated:
//!   at the bound of 4.1 it needs fewer charts than ARAP (1 against 3 on a closed surface with four handles), and folds
//!   over itself less often. [`embed::Options`] and the deformations of [`deform`] default to ARAP, as in the paper.
//! - A large disk is parted as its simplification is, small charts given back included: what takes rounds is done there. The seams
//!   are carried over as the collapsed vertices are put back, then drawn anew along the cheapest ways nearby, and each chart is
//!   mapped once. Planned so, koala has 10 charts and not 14, and seams a fifth shorter.
//! - A lightmap needs a region for each instance, and glTF has no offset and scale of UVs per node: each node gets its own copy of
//!   the mesh, which every engine reads.
//! - Meshes of one shape are mapped once, and what is asked is not whether they share a name or an accessor but whether their triangles
//!   are the same and their positions equal up to a rigid motion and a scale. In an atlas of several, those that touch others
//!   stay with them.
//! - A chart of which floating point finds no valid map is cut into halves, even where one chart per component was asked
//!   for: a valid atlas with a seam more is worth more than none.
//!
//! - Jobs are queued in tables of our own, by four operations (claim, beat, sweep, end), because the
//!   record that clients read, its fence and its result must change in one transaction. Of 200 jobs
//!   under workers killed every 2 s such tables lost none and had no effect twice; `graphile_worker` lost
//!   one in each run, `apalis` had up to 27 effects twice and never parked a job that kills its
//!   workers, and Temporal needs our row beside its own. PostgreSQL, which most operators run, does
//!   830 of them a second (SQLite 2,800), a thousand times more than jobs of seconds need.
//!   `cargo bench --bench crash` kills, stops, fills, cuts and sets clocks wrong: nine faults at ten
//!   moments each of 200 jobs lost none, had no effect twice, and left nothing behind.
//!
//! - Whoever calls the service is known by a key, as in most services that programs use, and not by an
//!   account: no passwords, no sign-up, nothing to ask elsewhere. What is another owner's is answered
//!   like what never was. A place that could forget to ask does not exist: the store looks for
//!   nothing without being told how far to look (`jobs::access::Reach`), and handlers know that
//!   from their caller only.
//!
//! - A job that equals an earlier one of its owner gets copies of its files, not references to them: other names of
//!   the same content in a folder, copies within the bucket. Every job owns its files, so that nothing
//!   has to be counted before one is removed. Equal are input, kind, options and the checksum of the
//!   program that computed; what was cut short is computed again.
//!
//! - Owners take turns, by how many of their jobs run, then by when one was last started. Priorities
//!   order the jobs of one owner only: among owners they would be a way to starve others.
//!
//! - A density is three functions of the signed singular values, and the smallest of these is found from the determinant:
//!   one definition serves plane and space, and loses nothing where areas span thirty orders of magnitude.
//! - Handles are held exactly, by elimination, where the paper has soft constraints; points inside elements are soft and harden
//!   at the end. Substepping (the paper's equations 10 and 11) would do nothing for a projected Newton, whose shift is nearly 0:
//!   the targets advance instead as far as inversions and the quadratic model allow. A group of handles that elements connect
//!   travels as a rigid body, so that half a turn of a bar's end does not pass through a point.
//! - Where a map of the plane shall stay bijective its boundary has a barrier of its own, between vertices and edges, whose blocks join the
//!   Hessian as they come near: the pattern is analyzed again, which is rare, instead of leaving them out. Handles whose straight
//!   ways do not lead to their targets try ways that are bent to one side.
//! - A body that is pulled from exact rest in one jump is shaken by a thousandth of its smallest element first: a pressed bar
//!   would otherwise end on the saddle that its symmetry keeps it on.
//! - A start that is supplied, UVs to be edited or positions of a problem, may have inversions: it is untangled with as few vertices
//!   moved as it takes, or refused. Inverted rest shapes are refused.
//! - Solids are factored like surfaces, ordered by nested dissection. A large cage starts where a coarser one ends, and where a
//!   factorization would take more than 6 GiB conjugate gradients take over ([`numerics::linear_solver`] has the memory per element).
//! - The inverse spline's support ends at s(λ⁰ − ε), as in the authors' code, so that it is zero at rest; the paper has sλ⁰.
//!
//! # Invariants
//!
//! 1. What leaves [`embed`] has no flip; every iterate of [`solver`] has positive areas; what [`certificate`] says is
//!    exact on the written bytes.
//! 2. Same input bytes and options, same output bytes, for any number of threads, on one processor type.
//! 3. Everything in a document that a job was not asked to change is still there.
//! 4. An accepted job is never lost: it ends succeeded, failed with a cause, or cancelled, over any
//!    crash or restart, and what an outdated attempt says or writes changes nothing.
//! 5. Whoever has no key for it learns nothing of what others made, not even that it exists.
//! 6. No input makes the process panic, hang, read a file or open a connection it was not given, or exceed its memory.

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
