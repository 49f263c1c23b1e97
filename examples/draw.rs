//! draw
use unwrapd::certificate::*;
use unwrapd::measure::*;
use unwrapd::mesh::io::obj;
use unwrapd::picture::*;
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let mut data = vec![];
    for f in &a[3..] {
        let o = obj::read(&std::fs::read(f).unwrap()).unwrap();
        let p: Vec<[f64; 3]> = o.mesh.positions.iter().map(|p| p.map(f64::from)).collect();
        let mut uv = vec![];
        for poly in o.polygons() {
            for k in 1..poly.len() - 1 {
                uv.push([0, k, k + 1].map(|i| o.texcoords[poly[i].texcoord.unwrap() as usize]));
            }
        }
        let ids = chart_ids(&p, &o.mesh.triangles, &uv);
        let d = face_distortion(&p, &o.mesh.triangles, &uv);
        data.push((f.clone(), uv, ids, d));
    }
    let panels: Vec<Panel> = data
        .iter()
        .enumerate()
        .map(|(i, d)| Panel {
            name: if i % 2 == 0 {
                "mesh0/prim3"
            } else {
                "material-1"
            },
            uvs: &d.1,
            charts: &d.2,
            distortion: &d.3,
        })
        .collect();
    let t = std::time::Instant::now();
    std::fs::write(
        format!("{}_layout.png", a[1]),
        layout_png(&panels, a[2].parse().unwrap(), VAxis::Up),
    )
    .unwrap();
    println!(
        "layout {:?} {} faces",
        t.elapsed(),
        data.iter().map(|d| d.1.len()).sum::<usize>()
    );
    for (n, m) in [
        ("conf", HeatmapMeasure::Conformal),
        ("area", HeatmapMeasure::Area),
        ("sd", HeatmapMeasure::SymmetricDirichlet),
    ] {
        let t = std::time::Instant::now();
        std::fs::write(
            format!("{}_{n}.png", a[1]),
            heatmap_png(&panels, m, a[2].parse().unwrap(), VAxis::Up),
        )
        .unwrap();
        println!("{n} {:?}", t.elapsed());
    }
}
