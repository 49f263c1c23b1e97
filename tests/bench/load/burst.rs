//! Thousands of small jobs at once.

use std::pin::pin;
use std::time::{Duration, Instant};

use super::service::Service;
use super::{count, meshes, quantiles};

/// Requests that are under way at the same time.
const AT_ONCE: usize = 32;
/// Between two looks at a job, from the first submission to the last end.
const LOOKS: Duration = Duration::from_millis(20);

pub async fn run() {
    let count = count("JOBS", 5000);
    let service = Service::start();
    let (begin, at_start) = (Instant::now(), service.resident_mib());
    let known = service.submit(meshes::block(count)).await.0;
    let path = known["links"]["self"].as_str().expect("a link");
    let work = async {
        let (jobs, posts) = service
            .submit_all((0..count).map(meshes::block), AT_ONCE)
            .await;
        let (accepted, queued) = (begin.elapsed(), service.resident_mib());
        let losses = service.losses(&jobs).await;
        (posts, accepted, queued, losses)
    };
    let (mut work, mut gets, mut most) = (pin!(work), Vec::new(), at_start);
    let (posts, accepted, queued, losses) = loop {
        tokio::select! {
            done = &mut work => break done,
            () = tokio::time::sleep(LOOKS) => {
                let begin = Instant::now();
                service.get(path).await;
                gets.push(begin.elapsed());
                most = most.max(service.resident_mib());
            }
        }
    };
    let (seconds, at_end) = (begin.elapsed().as_secs_f64(), service.resident_mib());
    println!("burst of {count} jobs of 12 faces");
    println!(
        "  accepted in {:.1} s, done in {seconds:.1} s, lost {losses}",
        accepted.as_secs_f64()
    );
    println!("  POST: {}", quantiles::of(posts));
    println!("  GET meanwhile: {}", quantiles::of(gets));
    println!(
        "  memory: {at_start} MiB, {queued} with all queued, {at_end} at the end, {most} at most"
    );
}
