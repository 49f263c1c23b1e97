//! What is told of many attempts.

/// What came of one attempt.
pub struct Outcome {
    /// Handles, and how many of them are at their targets.
    pub handles: usize,
    pub reached: usize,
    pub seconds: f64,
}

/// Prints how many arrived and how long it took.
pub fn conclude(name: &str, all: &[Outcome]) {
    let arrived = all.iter().filter(|o| o.reached == o.handles).count();
    let mut seconds: Vec<f64> = all.iter().map(|o| o.seconds).collect();
    seconds.sort_by(f64::total_cmp);
    let of = |share: f64| seconds[(share * (seconds.len() - 1) as f64).round() as usize];
    let sum = |count: fn(&Outcome) -> usize| all.iter().map(count).sum::<usize>();
    println!(
        "{name}: {arrived} of {} arrived, {} of {} handles, seconds {:.2} median, {:.2} of 95 %, {:.2} worst",
        all.len(),
        sum(|o| o.reached),
        sum(|o| o.handles),
        of(0.5),
        of(0.95),
        of(1.0)
    );
}
