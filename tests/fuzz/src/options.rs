//! Options: the first byte says of which kind, the rest is their JSON.
#![no_main]

use libfuzzer_sys::fuzz_target;
use unwrapd_api::Kind;
use unwrapd_worker::Work;

const KINDS: [Kind; 10] = [
    Kind::Unwrap,
    Kind::Measure,
    Kind::Verify,
    Kind::Solve,
    Kind::Deform,
    Kind::Warp,
    Kind::EditUv,
    Kind::TextureMap,
    Kind::Repack,
    Kind::Untangle,
];

fuzz_target!(|bytes: &[u8]| {
    let Some((&kind, json)) = bytes.split_first() else {
        return;
    };
    let kind = KINDS[usize::from(kind) % KINDS.len()];
    let Ok(options) = serde_json::from_slice(json) else {
        return;
    };
    if let Ok(work) = Work::new(kind, options) {
        let complete = work.into_options();
        // What is stored is read again by whoever computes the job.
        let again = Work::new(kind, complete.clone()).map(Work::into_options);
        assert_eq!(again.ok(), Some(complete));
    }
});
