//! Moments as clients see them.

use unwrapd::jobs::Timestamp;

#[test]
fn dates_are_rfc_3339() {
    let shown = |ms| Timestamp(ms).to_string();
    assert_eq!(shown(0), "1970-01-01T00:00:00.000Z");
    assert_eq!(shown(951_782_400_123), "2000-02-29T00:00:00.123Z");
    assert_eq!(shown(4_107_542_399_999), "2100-02-28T23:59:59.999Z");
    assert_eq!(shown(4_107_542_400_000), "2100-03-01T00:00:00.000Z");
}
