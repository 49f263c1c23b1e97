//! `min` and `max` of accessors.
use super::component::Component;
use serde_json::{Value, json};

/// Writes the smallest and largest value of each component, in the stored encoding.
pub(super) fn set(accessor: &mut Value, packed: &[u8], component: Component, width: usize) {
    let mut low = vec![f64::INFINITY; width];
    let mut high = vec![f64::NEG_INFINITY; width];
    for element in packed.chunks_exact(component.size() * width) {
        for (axis, bytes) in element.chunks_exact(component.size()).enumerate() {
            let value = component.read(bytes);
            low[axis] = low[axis].min(value);
            high[axis] = high[axis].max(value);
        }
    }
    let numbers = |values: Vec<f64>| -> Value {
        let is_integer = component != Component::F32;
        let number = |value: f64| {
            if is_integer {
                json!(value as i64)
            } else {
                json!(value)
            }
        };
        values.into_iter().map(number).collect()
    };
    accessor["min"] = numbers(low);
    accessor["max"] = numbers(high);
}
