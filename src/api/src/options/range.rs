//! Numbers and their ranges.

/// A value that can be checked against a range.
pub trait Ranged {
    /// Checks the value against a range. The error names the option.
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String>;
}

impl Ranged for f64 {
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String> {
        within(name, *self, low, high)
    }
}

impl Ranged for u32 {
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String> {
        within(name, f64::from(*self), low, high)
    }
}

impl Ranged for usize {
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String> {
        within(name, *self as f64, low, high)
    }
}

/// An absent value is in every range.
impl<T: Ranged> Ranged for Option<T> {
    fn check(&self, name: &str, low: f64, high: f64) -> Result<(), String> {
        self.as_ref()
            .map_or(Ok(()), |value| value.check(name, low, high))
    }
}

/// Checks a number against its range. The error names the option in backticks, like all texts about options.
pub fn within(name: &str, value: f64, low: f64, high: f64) -> Result<(), String> {
    if (low..=high).contains(&value) {
        Ok(())
    } else {
        Err(format!(
            "`{name}` must lie between {low} and {high}, not {value}"
        ))
    }
}
