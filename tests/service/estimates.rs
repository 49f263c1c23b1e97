//! The share that is shown between reports.

use std::time::Duration;

use unwrapd_worker::Estimator;

fn seconds(seconds: f64) -> Duration {
    Duration::from_secs_f64(seconds)
}

#[test]
fn the_share_moves_without_reports_and_never_falls() {
    let mut estimator = Estimator::default();
    assert_eq!(estimator.reported(0.2, seconds(10.0)), 0.2);
    let mut last = 0.2;
    for half_second in 1..200 {
        let share = estimator.estimated(seconds(10.0 + 0.5 * f64::from(half_second)));
        assert!(last < share && share < 0.5, "{last} {share}");
        last = share;
    }
    assert_eq!(estimator.reported(0.21, seconds(111.0)), last);
    assert_eq!(estimator.reported(0.9, seconds(112.0)), 0.9);
}

#[test]
fn an_estimate_goes_on_at_half_of_the_pace_so_far() {
    let mut estimator = Estimator::default();
    estimator.reported(0.4, seconds(20.0));
    let share = estimator.estimated(seconds(22.0));
    assert!((share - 0.42).abs() < 1e-9, "{share}");
}

#[test]
fn a_report_that_says_nothing_new_counts_as_silence() {
    let mut estimator = Estimator::default();
    estimator.reported(0.4, seconds(20.0));
    for second in [20.5, 21.0, 21.9] {
        assert_eq!(estimator.reported(0.4, seconds(second)), 0.4);
    }
    let share = estimator.estimated(seconds(22.0));
    assert!((share - 0.42).abs() < 1e-9, "{share}");
}

#[test]
fn no_estimate_says_that_all_is_done() {
    let mut estimator = Estimator::default();
    estimator.reported(0.98, seconds(1.0));
    let shares = (2..2000).map(|second| estimator.estimated(seconds(f64::from(second))));
    let last = shares.last().expect("there are some");
    assert!(last < 1.0, "{last}");
    assert!(Estimator::default().estimated(seconds(0.0)) < 0.1);
}
