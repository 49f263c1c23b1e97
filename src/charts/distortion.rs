//! What a map costs of the distortion budget.

use super::MappedChart;
use crate::barrier::{Barrier, BarrierKind, MapEnergy, map_energy};
use crate::embed::rest_shapes;
use crate::energy::EnergyKind;

/// By how much the symmetric Dirichlet energy of a map exceeds its minimum of 4 per area, summed over the area, and that area.
pub fn excess_and_area(mapped: &MappedChart) -> [f64; 2] {
    let triangles = &mapped.chart.disk.triangles;
    let rest = rest_shapes(&mapped.chart.positions, triangles);
    let energy = MapEnergy {
        energy: EnergyKind::SymmetricDirichlet,
        barrier: Barrier {
            kind: BarrierKind::None,
            beta: 0.0,
            s: 1.0,
            epsilon: 0.0,
        },
    };
    let relative: Vec<f64> = (mapped.embedding.uv.as_flattened().iter())
        .map(|x| x / rest.scale)
        .collect();
    let weight: f64 = rest.shapes.iter().map(|shape| shape.weight).sum();
    let halved = map_energy(triangles, &rest.shapes, &energy).value(&relative);
    let per_area = (2.0 * halved / weight.max(f64::MIN_POSITIVE) - 4.0).max(0.0);
    [per_area * rest.true_area, rest.true_area]
}
