//! Weighted quantiles.

/// Values with weights, sorted.
pub(super) struct Weighted {
    values: Vec<f64>,
    /// Sum of the weights up to each value.
    cumulated: Vec<f64>,
}

impl Weighted {
    pub fn new(mut pairs: Vec<(f64, f64)>) -> Weighted {
        // Shares are summed, not weights: where half of twelve equal weights is asked for, rounding decides between the
        // sixth and the seventh value, and so it decides as in other programs that normalize first.
        let total: f64 = pairs.iter().map(|pair| pair.1).sum();
        pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let mut sum = 0.0;
        let cumulated = pairs.iter().map(|(_, weight)| {
            sum += weight / total;
            sum
        });
        Weighted {
            cumulated: cumulated.collect(),
            values: pairs.iter().map(|p| p.0).collect(),
        }
    }

    /// Returns the smallest value at which the cumulated weight reaches the share `q` of the total.
    pub fn quantile(&self, q: f64) -> Option<f64> {
        let wanted = q * self.cumulated.last()?;
        let index = self.cumulated.partition_point(|&c| c < wanted);
        Some(self.values[index.min(self.values.len() - 1)])
    }

    pub fn min(&self) -> Option<f64> {
        self.values.first().copied()
    }

    pub fn max(&self) -> Option<f64> {
        self.values.last().copied()
    }
}
