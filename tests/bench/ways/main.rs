//! Handles whose straight ways are blocked: how many arrive, and how long it takes.
//!
//! `cargo bench --bench ways -- [woody|crowded|warps|impossible] [COUNT]`; without arguments all.
//! `woody` solves the reference problems of a figure whose limbs change places; `crowded` sends 40 handles of a picture each to a
//! random place, 10 times; `warps` does so with 300 random pictures and shorter ways, a third of them with a fixed border,
//! a third bijective; `impossible` sends one of five handles through a fixed wall, in the plane and in space. Seconds are those of
//! the processor.

#[path = "../../support/bodies.rs"]
mod bodies;
#[expect(dead_code, reason = "only seconds are wanted")]
#[path = "../clock.rs"]
mod clock;
mod impossible;
mod outcome;
mod pictures;
mod woody;

use unwrapd::solver::{Control, Iterate};

fn main() {
    let arguments: Vec<String> = std::env::args()
        .skip(1)
        .filter(|a| !a.starts_with('-'))
        .collect();
    let count = arguments.get(1).and_then(|n| n.parse().ok());
    let is_wanted = |name: &str| arguments.first().is_none_or(|first| first == name);
    if is_wanted("woody") {
        woody::woody();
    }
    if is_wanted("crowded") {
        pictures::crowded(count.unwrap_or(10));
    }
    if is_wanted("warps") {
        pictures::warps(count.unwrap_or(300));
    }
    if is_wanted("impossible") {
        impossible::impossible(impossible::plane());
        impossible::impossible(impossible::space());
    }
}

fn go_on(_: &Iterate) -> Control {
    Control::Continue
}
