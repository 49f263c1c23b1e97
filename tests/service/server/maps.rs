//! Charts that relax before the eyes of whoever watches a job.

use std::collections::HashSet;
use std::sync::Mutex;
use std::time::Duration;

use serde_json::Value;
use unwrapd::charts::MapUnderway;
use unwrapd::document::Upload;
use unwrapd::numerics::predicates::orient2d_sign;
use unwrapd::pipeline::{Observer, Options, Progress, unwrap_document};
use unwrapd::solver::Control;

use crate::meshes;
use crate::server::{Server, assert_problem};

/// Faces of a map that are sent at most.
const MOST_FACES: usize = 100_000;

/// A map as it is sent.
struct Sent {
    first: u32,
    iteration: u32,
    n_faces: u32,
    flips: u32,
    unit: f64,
    energy: f64,
    is_plan: bool,
    faces: Vec<u32>,
    corners: Vec<[[f64; 2]; 3]>,
}

/// Numbers from bytes, one after the other.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (head, rest) = self.0.split_first_chunk().expect("bytes");
        self.0 = rest;
        *head
    }
    fn u32(&mut self) -> u32 {
        u32::from_le_bytes(self.take())
    }
    fn f64(&mut self) -> f64 {
        f64::from_le_bytes(self.take())
    }
    fn map(&mut self) -> Sent {
        let [_, first, iteration, n_faces, n, flips, width, plan] =
            std::array::from_fn(|_| self.u32());
        let [unit, energy, _] = std::array::from_fn(|_| self.f64());
        let faces = (0..n).map(|_| self.u32()).collect();
        let mut coordinate = || match width {
            4 => f64::from(f32::from_le_bytes(self.take())),
            _ => self.f64(),
        };
        let mut point = || [coordinate(), coordinate()];
        let mut triangle = |_| [point(), point(), point()];
        Sent {
            first,
            iteration,
            n_faces,
            flips,
            unit,
            energy,
            is_plan: plan == 1,
            faces,
            corners: (0..n).map(&mut triangle).collect(),
        }
    }
}

/// The number of a frame and its maps.
fn read(bytes: &[u8]) -> (u64, Vec<Sent>) {
    let mut from = Reader(bytes);
    assert_eq!(from.take(), [3, 0, 0, 0, 0, 0, 0, 0], "a frame");
    let number = u64::from_le_bytes(from.take());
    let mut maps = Vec::new();
    while !from.0.is_empty() {
        maps.push(from.map());
    }
    (number, maps)
}

fn path(job: &Value) -> String {
    format!("{}/maps", job["links"]["self"].as_str().expect("a link"))
}

/// The frames of a job until it ends; the job still runs when the first one is there.
async fn frames(server: &Server, job: &Value) -> Vec<Vec<Sent>> {
    let mut frames: Vec<Vec<Sent>> = Vec::new();
    let mut after = 0;
    loop {
        let next = server.get(&format!("{}?after={after}", path(job)));
        let answer = next.send().await.expect("an answer");
        if answer.status() == 204 {
            return frames;
        }
        assert_eq!(answer.headers()["content-type"], "application/octet-stream");
        let (number, maps) = read(&answer.bytes().await.expect("bytes"));
        assert!(after < number && !maps.is_empty());
        if frames.is_empty() {
            let link = job["links"]["self"].as_str().expect("a link");
            let answer = server.get(link).send().await.expect("an answer");
            let now: Value = answer.json().await.expect("the job");
            assert_eq!(now["state"], "running");
        }
        after = number;
        frames.push(maps);
    }
}

fn assert_no_flips(maps: &[Sent]) {
    for map in maps {
        let signs = map
            .corners
            .iter()
            .map(|[a, b, c]| orient2d_sign(*a, *b, *c));
        assert!(signs.into_iter().all(|sign| sign > 0));
        assert_eq!(map.flips, 0);
        assert!(map.unit > 0.0 && map.corners.len() == map.faces.len());
    }
}

#[tokio::test]
async fn charts_are_seen_relaxing_without_a_flip() {
    let server = Server::start();
    let job = server.submit(meshes::hills(150), "").await;
    let frames = frames(&server, &job).await;
    assert!(!frames.is_empty(), "nothing was seen");
    for maps in &frames {
        assert_no_flips(maps);
    }
    let moved = frames.iter().flatten().any(|map| 0 < map.iteration);
    assert!(moved, "charts move");
    assert_eq!(server.ended(&job).await["state"], "succeeded");
}

/// What the library's solver had: chart, iteration, energy and rounded corners of each map.
#[derive(Default)]
struct Seen(Mutex<HashSet<Vec<u64>>>);

/// A map as the set has it.
fn key(
    first: u32,
    iteration: u32,
    energy: f64,
    corners: impl Iterator<Item = [f64; 2]>,
) -> Vec<u64> {
    let numbers = corners.flatten().map(|x| u64::from((x as f32).to_bits()));
    let head = [first.into(), iteration.into(), energy.to_bits()];
    head.into_iter().chain(numbers).collect()
}

impl Observer for Seen {
    fn progress(&self, _: &Progress) -> Control {
        Control::Continue
    }
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
    fn map(&self, _: usize, map: &MapUnderway) {
        let corners = map.chart.disk.triangles.iter().flatten();
        let corners = corners.map(|&v| [map.x[2 * v as usize], map.x[2 * v as usize + 1]]);
        let first = map.chart.corners[0][0] / 3;
        let key = key(
            first,
            map.iterate.iteration as u32,
            map.iterate.energy,
            corners,
        );
        self.0.lock().expect("no panic").insert(key);
    }
}

#[tokio::test]
async fn every_frame_is_what_the_solver_had() {
    let server = Server::start();
    let glb = meshes::hills(120);
    let job = server.submit(glb.clone(), "filename=hills.glb").await;
    let frames = frames(&server, &job).await;
    assert!(!frames.is_empty());
    let upload = Upload {
        name: "hills.glb".to_owned(),
        bytes: glb,
        resources: std::collections::BTreeMap::default(),
    };
    let seen = Seen::default();
    unwrap_document(&upload, &Options::default(), &seen).expect("it unwraps");
    let seen = seen.0.into_inner().expect("no panic");
    for map in frames.iter().flatten() {
        let corners = map.corners.iter().flatten().copied();
        let key = key(map.first, map.iteration, map.energy, corners);
        assert!(
            seen.contains(&key),
            "chart {}, iteration {}",
            map.first,
            map.iteration
        );
    }
}

#[tokio::test]
async fn seams_of_large_charts_are_seen_being_planned() {
    let server = Server::start();
    let job = server.submit(meshes::hills(180), "").await;
    let frames = frames(&server, &job).await;
    let maps: Vec<&Sent> = frames.iter().flatten().collect();
    let plans = maps.iter().take_while(|map| map.is_plan);
    let n_plans = plans.clone().count();
    assert!(
        0 < n_plans && n_plans < maps.len(),
        "first plans, then charts"
    );
    for plan in plans {
        assert!(plan.n_faces < 60_000, "simplified");
        let distinct: HashSet<&u32> = plan.faces.iter().collect();
        assert!(100 * distinct.len() >= 99 * plan.faces.len());
        assert!(plan.faces.iter().all(|&face| face < 2 * 180 * 180));
    }
    for maps in &frames {
        assert_no_flips(maps);
    }
}

#[tokio::test]
async fn of_large_charts_a_part_is_seen() {
    let server = Server::start();
    let job = server.submit(meshes::hills(300), "cut=disk").await;
    let frames = frames(&server, &job).await;
    let map = frames.iter().flatten().next().expect("a map");
    assert_eq!(map.n_faces, 180_000);
    assert!(map.faces.len() <= MOST_FACES && 80_000 < map.faces.len());
    assert!(map.faces.iter().all(|face| face % 2 == 0));
    assert_no_flips(&frames[0]);
}

#[tokio::test]
async fn a_job_without_charts_under_way_has_no_frames() {
    let server = Server::start();
    let unknown = "/v1/jobs/01890a5d-ac96-774b-bcce-b302099a8057/maps";
    let answer = server.get(unknown).send().await.expect("an answer");
    assert_problem(answer, 404, "job_not_found").await;
    let job = server.submit(meshes::small(), "").await;
    server.ended(&job).await;
    let answer = server.get(&path(&job)).send().await.expect("an answer");
    assert_eq!(answer.status(), 204);
}
