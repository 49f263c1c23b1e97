//! A file with new UVs, certified on the bytes that are written.
//!
//! `cargo run --release --example unwrap_file IN OUT`

use unwrapd_api::Upload;
use unwrapd_pipeline::{Options, Unobserved, unwrap_document};

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = &*arguments else {
        eprintln!("usage: unwrap_file IN OUT");
        return;
    };
    let bytes = std::fs::read(input).expect("a file");
    let upload = Upload::single(input.as_str(), bytes);
    let outcome = unwrap_document(&upload, &Options::default(), &Unobserved).expect("a mesh");
    let (_, main) = &outcome.files[0];
    std::fs::write(output, main).expect("a folder to write to");
    println!("certified: {}", outcome.report.certified);
}
