//! Pairs of charts of which one is the mirror image of the other.

use super::own_image::Moment;
use crate::charts::chart::Chart;

/// The area and center of a chart.
pub fn moment(chart: &Chart) -> Moment {
    Moment::of(&chart.disk.triangles, &chart.positions)
}

/// For each chart the other that is its mirror image.
pub fn counterparts(charts: &[&Chart]) -> Vec<Option<usize>> {
    let moments: Vec<Moment> = (charts.iter()).map(|chart| moment(chart)).collect();
    let image_of = |i: usize| {
        let plane = charts[i].mirror?;
        let is_image = |j: &usize| *j != i && moments[*j].is_image_of(&moments[i], &plane);
        let own = moments[i].is_image_of(&moments[i], &plane);
        (!own).then(|| (0..charts.len()).find(is_image)).flatten()
    };
    let images: Vec<Option<usize>> = (0..charts.len()).map(image_of).collect();
    let is_mutual = |(i, image): (usize, &Option<usize>)| image.filter(|&j| images[j] == Some(i));
    images.iter().enumerate().map(is_mutual).collect()
}

/// The chart that is the mirror image of one.
pub fn counterpart(charts: &[&Chart], of: usize) -> Option<usize> {
    charts[of].mirror?;
    counterparts(charts)[of]
}
