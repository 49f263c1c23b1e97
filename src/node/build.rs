//! What linkers of other systems must be told of an addon.

fn main() {
    napi_build::setup();
}
