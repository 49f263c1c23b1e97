//! Writer of material files.
use super::{Map, Material};
use std::fmt::Write as _;

/// Returns the text of a material file.
pub(in crate::document) fn mtl_text(materials: &[Material]) -> Vec<u8> {
    let mut text = String::new();
    for (k, material) in materials.iter().enumerate() {
        if k > 0 {
            text.push('\n');
        }
        // Writing to memory does not fail.
        let _ = push_material(&mut text, material);
    }
    text.into_bytes()
}

fn push_material(text: &mut String, material: &Material) -> std::fmt::Result {
    writeln!(text, "newmtl {}", material.name)?;
    push_color(text, "Kd", material.color)?;
    push_color(text, "Ke", material.emission)?;
    // A matte surface has no highlight, not one that is everywhere.
    let is_matte = material.roughness == 1.0 && material.specular == [0.5; 3];
    if !is_matte {
        push_color(text, "Ks", material.specular)?;
        let shine = 1000.0 * (1.0 - material.roughness).powi(2);
        writeln!(text, "Ns {}", short(shine))?;
    }
    let numbers = [
        ("Ni", material.ior),
        ("d", material.alpha),
        ("Pr", material.roughness),
        ("Pm", material.metallic),
    ];
    for (keyword, number) in numbers {
        writeln!(text, "{keyword} {}", short(number))?;
    }
    if material.coat[0] > 0.0 {
        let [coat, roughness] = material.coat.map(short);
        writeln!(text, "Pc {coat}\nPcr {roughness}")?;
    }
    // Illumination models: constant color, diffuse, diffuse with highlights.
    let model = match (material.is_unlit, is_matte) {
        (true, _) => 0,
        (false, true) => 1,
        (false, false) => 2,
    };
    writeln!(text, "illum {model}")?;
    // Write the maps.
    if let Some(map) = &material.color_map {
        push_map(text, "map_Kd", "", map)?;
        if material.is_cut_out {
            push_map(text, "map_d", "", map)?;
        }
    }
    if let Some(map) = &material.metallic_roughness_map {
        push_map(text, "map_Pr", " -imfchan g", map)?;
        push_map(text, "map_Pm", " -imfchan b", map)?;
    }
    if let Some(map) = &material.emission_map {
        push_map(text, "map_Ke", "", map)?;
    }
    if let Some(map) = &material.normal_map {
        push_map(text, "norm", "", map)?;
        // Blender looks here for the map and its strength.
        push_map(
            text,
            "map_Bump",
            &format!(" -bm {}", short(map.strength)),
            map,
        )?;
    }
    Ok(())
}

fn push_color(text: &mut String, keyword: &str, color: [f64; 3]) -> std::fmt::Result {
    let [r, g, b] = color.map(short);
    writeln!(text, "{keyword} {r} {g} {b}")
}

fn push_map(text: &mut String, keyword: &str, options: &str, map: &Map) -> std::fmt::Result {
    write!(text, "{keyword}{options}")?;
    for (option, [u, v], neutral) in [("-s", map.scale, 1.0), ("-o", map.offset, 0.0)] {
        if [u, v] != [neutral; 2] {
            write!(text, " {option} {} {} {neutral}", short(u), short(v))?;
        }
    }
    writeln!(text, " {}", map.path)
}

/// Removes rounding noise from a number.
fn short(x: f64) -> f64 {
    (x * 1e9).round() / 1e9 + 0.0
}
