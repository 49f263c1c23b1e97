//! Which set is written, and what becomes of what belonged to it.
use crate::build::{Builder, parts};
use crate::documents::{grid_uvs, new_uvs, options, reread};
use serde_json::{Value, json};
use unwrapd_files::document::{Document, OutputFormat, TangentsNote, WriteOptions, Written};

fn write(document: &Document, options: &WriteOptions) -> Written {
    let grid = grid_uvs(document, 8, 1);
    document.write(&new_uvs(&grid, 8), options).unwrap()
}

fn glb() -> WriteOptions {
    options(OutputFormat::Glb)
}

#[test]
fn a_mesh_without_textures_gets_set_0() {
    let written = write(&Builder::square().document(), &glb());
    assert_eq!(written.notes.primitives[0].texcoord, 0);
    let mut builder = Builder::rich();
    builder.json["materials"] = json!([{}]);
    let written = write(&builder.document(), &glb());
    let note = &written.notes.primitives[0];
    assert_eq!((note.texcoord, note.replaced), (0, true));
    assert_eq!(note.tangents, TangentsNote::Untouched);
}

#[test]
fn a_textured_mesh_gets_the_next_free_set() {
    let mut builder = Builder::rich();
    let attributes = &mut builder.json["meshes"][0]["primitives"][0]["attributes"];
    attributes["TEXCOORD_1"] = attributes["TEXCOORD_0"].clone();
    let written = write(&builder.document(), &glb());
    assert_eq!(written.notes.primitives[0].texcoord, 2);
    assert!(written.notes.textures_affected.is_empty());
}

#[test]
fn a_transform_tells_which_set_is_sampled() {
    let mut builder = Builder::rich();
    builder.json["materials"] = json!([{
        "extensions": {"KHR_materials_sheen": {"sheenColorTexture":
            {"index": 0, "extensions": {"KHR_texture_transform": {"texCoord": 1}}}}},
    }]);
    let written = write(&builder.document(), &glb());
    assert_eq!(written.notes.primitives[0].texcoord, 0);
    let asked = WriteOptions {
        texcoord: Some(1),
        ..glb()
    };
    assert_eq!(
        write(&builder.document(), &asked).notes.primitives[0].texcoord,
        1
    );
}

#[test]
fn variants_count_too() {
    let mut builder = Builder::rich();
    builder.json["materials"] = json!([{}, {"occlusionTexture": {"index": 0}}]);
    builder.json["meshes"][0]["primitives"][0]["extensions"] =
        json!({"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]}]}});
    let written = write(&builder.document(), &glb());
    assert_eq!(written.notes.primitives[0].texcoord, 1);
}

#[test]
fn a_set_in_use_is_replaced_only_on_demand() {
    let document = Builder::rich().document();
    let grid = grid_uvs(&document, 8, 1);
    let asked = WriteOptions {
        texcoord: Some(0),
        ..glb()
    };
    let error = document.write(&new_uvs(&grid, 8), &asked).unwrap_err();
    assert_eq!(error.code(), "texcoord_in_use");

    let written = write(
        &document,
        &WriteOptions {
            overwrite: true,
            ..glb()
        },
    );
    let notes = &written.notes;
    let slots: Vec<&str> = notes
        .textures_affected
        .iter()
        .map(|t| t.slot.as_str())
        .collect();
    assert_eq!(
        slots,
        ["normalTexture", "pbrMetallicRoughness/baseColorTexture"]
    );
    assert_eq!(
        notes.transforms_removed,
        ["/materials/0/pbrMetallicRoughness/baseColorTexture"]
    );
    assert!(
        notes
            .extensions_dropped
            .contains(&"KHR_texture_transform".to_owned())
    );
    let (json, _) = parts(&written.files[0].1);
    assert_eq!(
        json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"],
        json!({"index": 0})
    );
    assert_eq!(json["extensionsUsed"], json!(["ACME_mesh", "ACME_root"]));
    assert_eq!(notes.primitives[0].tangents, TangentsNote::Recomputed);
}

/// An unmirrored square with u along x and, v being up, v along y: the tangent is x, its sign positive.
#[test]
fn recomputed_tangents_follow_u() {
    let document = Builder::rich().document();
    let grid = vec![vec![[[0, 0], [8, 0], [8, 8]], [[0, 0], [8, 8], [0, 8]]]];
    let options = WriteOptions {
        overwrite: true,
        ..glb()
    };
    let written = document.write(&new_uvs(&grid, 5), &options).unwrap();
    assert_eq!(written.notes.primitives[0].vertices_after, 4);
    let (json, bin) = parts(&written.files[0].1);
    let index = json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"]
        .as_u64()
        .unwrap();
    let view = json["accessors"][index as usize]["bufferView"]
        .as_u64()
        .unwrap();
    let start = json["bufferViews"][view as usize]["byteOffset"]
        .as_u64()
        .unwrap() as usize;
    let floats: Vec<f32> = bin[start..start + 64]
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes(b.try_into().unwrap()))
        .collect();
    assert_eq!(floats, [1., 0., 0., 1.].repeat(4));
}

#[test]
fn tangents_without_normals_are_dropped() {
    let mut builder = Builder::rich();
    builder.json["meshes"][0]["primitives"][0]["attributes"]
        .as_object_mut()
        .unwrap()
        .remove("NORMAL");
    let written = write(
        &builder.document(),
        &WriteOptions {
            overwrite: true,
            ..glb()
        },
    );
    assert_eq!(written.notes.primitives[0].tangents, TangentsNote::Dropped);
    let (json, _) = parts(&written.files[0].1);
    assert_eq!(
        json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"],
        Value::Null
    );
}

#[test]
fn primitives_of_a_mesh_share_the_set_without_gaps() {
    let mut builder = Builder::rich();
    let mut bare = builder.json["meshes"][0]["primitives"][0].clone();
    bare["attributes"] = json!({"POSITION": 0});
    bare.as_object_mut().unwrap().remove("targets");
    builder.json["meshes"][0]["primitives"]
        .as_array_mut()
        .unwrap()
        .push(bare);
    let written = write(&builder.document(), &glb());
    assert_eq!(written.notes.primitives[1].texcoord, 1);
    let back = reread(&written);
    assert_eq!(
        back.corner_uvs(1, 0).unwrap(),
        back.corner_uvs(1, 1).unwrap()
    );
    assert!(
        written
            .notes
            .warnings
            .iter()
            .any(|warning| warning.code == "uv_sets_filled")
    );
}

#[test]
fn indices_widen_where_the_restart_value_would_be_a_vertex() {
    for (n_faces, component, widened) in [(21_845, 5123, false), (21_846, 5125, true)] {
        let mut builder = Builder::triangle();
        let indices: Vec<u8> = (0..n_faces).flat_map(|_| [0u8, 0, 1, 0, 2, 0]).collect();
        let indices = builder.accessor("SCALAR", 5123, 3 * n_faces, &indices);
        builder.json["meshes"][0]["primitives"][0]["indices"] = json!(indices);
        let document = builder.document();
        let corner = |n: usize| [(n % 1000) as i32, (n / 1000) as i32];
        let grid = vec![
            (0..n_faces)
                .map(|f| [0, 1, 2].map(|c| corner(3 * f + c)))
                .collect(),
        ];
        let written = document.write(&new_uvs(&grid, 10), &glb()).unwrap();
        let note = &written.notes.primitives[0];
        assert_eq!(
            (note.vertices_after, note.indices_widened),
            (3 * n_faces, widened)
        );
        let (json, _) = parts(&written.files[0].1);
        let index = json["meshes"][0]["primitives"][0]["indices"]
            .as_u64()
            .unwrap();
        assert_eq!(
            json["accessors"][index as usize]["componentType"],
            component
        );
    }
}

#[test]
fn strips_become_lists_only_when_split() {
    let mut builder = Builder::square();
    builder.json["meshes"][0]["primitives"][0]["mode"] = json!(5);
    let document = builder.document();
    assert_eq!(document.primitives()[0].triangles.len(), 4);
    let whole: Vec<_> = document.primitives()[0]
        .triangles
        .iter()
        .map(|face| face.map(|v| [v as i32, 0]))
        .collect();
    let written = document.write(&new_uvs(&[whole], 8), &glb()).unwrap();
    assert!(!written.notes.primitives[0].converted_to_triangles);
    let (json, _) = parts(&written.files[0].1);
    assert_eq!(json["meshes"][0]["primitives"][0]["mode"], 5);
    let written = write(&document, &glb());
    assert!(written.notes.primitives[0].converted_to_triangles);
    assert_eq!(reread(&written).primitives()[0].triangles.len(), 4);
}

#[test]
fn uvs_that_do_not_fit_are_refused() {
    let document = Builder::square().document();
    for grid in [vec![], vec![vec![[[0, 0]; 3]]]] {
        let error = document.write(&new_uvs(&grid, 8), &glb()).unwrap_err();
        assert_eq!(error.code(), "invalid_uvs");
    }
    for x in [f32::NAN, f32::INFINITY] {
        let mut uvs = new_uvs(&[vec![[[0, 0]; 3]; 2]], 8);
        uvs.corners[0].as_mut().expect("UVs")[1][2][0] = x;
        let error = document.write(&uvs, &glb()).unwrap_err();
        assert_eq!(error.code(), "invalid_uvs");
    }
}
