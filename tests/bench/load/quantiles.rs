//! Times in one line.

use std::time::Duration;

/// Median, 95th and 99th percentile and maximum, in milliseconds.
pub fn of(mut times: Vec<Duration>) -> String {
    times.sort_unstable();
    let Some(&last) = times.last() else {
        return "none".to_owned();
    };
    let ms = |time: Duration| format!("{:.1}", time.as_secs_f64() * 1e3);
    let at = |share: f64| ms(times[((times.len() - 1) as f64 * share).round() as usize]);
    format!(
        "p50 {} ms, p95 {}, p99 {}, max {} of {}",
        at(0.5),
        at(0.95),
        at(0.99),
        ms(last),
        times.len()
    )
}
