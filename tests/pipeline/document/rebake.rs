//! Textures that are resampled when the UVs they sample are replaced.

use base64::Engine as _;
use serde_json::{Value, json};
use unwrapd_files::document::{GroupBy, OutputFormat, Upload};
use unwrapd_files::picture::{Image, Picture};
use unwrapd_layout::charts::Cut;
use unwrapd_pipeline::{
    Baking, ImageFormat, KeptMaps, Options, Outcome, PipelineError, Unobserved, unwrap_document,
};

use crate::build::{Builder, parts};

const RED: [u8; 4] = [255, 0, 0, 255];
const BLUE: [u8; 4] = [0, 0, 255, 255];
const FLAT: [u8; 4] = [128, 128, 255, 255];

/// A data URI of a picture of one color.
fn uri(color: [u8; 4]) -> String {
    let mut image = Image::transparent(4, 4);
    image.pixels.fill(color);
    data_uri("image/png", &image.png())
}

fn data_uri(media_type: &str, file: &[u8]) -> String {
    let text = base64::engine::general_purpose::STANDARD.encode(file);
    format!("data:{media_type};base64,{text}")
}

/// A square with UVs and normals, its material with a red texture.
fn square() -> Builder {
    let mut builder = Builder::square();
    let uvs = builder.floats("VEC2", 2, &[0., 0., 1., 0., 1., 1., 0., 1.]);
    let normals = builder.floats("VEC3", 3, &[0., 0., 1.].repeat(4));
    let primitive = &mut builder.json["meshes"][0]["primitives"][0];
    primitive["attributes"]["TEXCOORD_0"] = json!(uvs);
    primitive["attributes"]["NORMAL"] = json!(normals);
    primitive["material"] = json!(0);
    builder.json["materials"] =
        json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    builder.json["textures"] = json!([{"source": 0}, {"source": 1}]);
    builder.json["images"] = json!([{"uri": uri(RED)}, {"uri": uri(BLUE)}]);
    builder
}

/// The square again, as another mesh or as another primitive of the same.
fn twice(mut builder: Builder, place: &str) -> Builder {
    let copy = builder.json["meshes"][0]["primitives"][0].clone();
    match place {
        "mesh" => builder.primitive(&copy),
        _ => push(&mut builder.json["meshes"][0]["primitives"], copy),
    }
    builder
}

fn push(array: &mut Value, object: Value) {
    array.as_array_mut().unwrap().push(object);
}

/// Every mesh by itself, so that several share a material but no texture.
fn options() -> Options {
    Options {
        group_by: Some(GroupBy::Mesh),
        baking: Baking {
            rebake: true,
            bake_size: Some(32),
            ..Baking::default()
        },
        ..Options::default()
    }
}

fn rebaked(builder: &Builder) -> Outcome {
    unwrap_document(&builder.upload(), &options(), &Unobserved).unwrap()
}

/// The JSON and the colors of the picture that a material has in a slot.
fn written(outcome: &Outcome) -> (Value, impl Fn(usize, &str) -> Vec<[u8; 4]> + use<>) {
    let (json, bin) = parts(&outcome.files[0].1);
    let copy = json.clone();
    let colors = move |material: usize, slot: &str| {
        let index = |value: &Value| value.as_u64().unwrap() as usize;
        let info = json["materials"][material].pointer(slot).unwrap();
        let texture = &json["textures"][index(&info["index"])];
        let view = &json["images"][index(&texture["source"])]["bufferView"];
        let view = &json["bufferViews"][index(view)];
        let start = index(&view["byteOffset"]);
        let file = &bin[start..start + index(&view["byteLength"])];
        let mut colors = Image::decode(file).unwrap().pixels;
        colors.sort_unstable();
        colors.dedup();
        colors
    };
    (copy, colors)
}

const BASE: &str = "/pbrMetallicRoughness/baseColorTexture";

#[test]
fn a_texture_follows_its_uvs() {
    let mut builder = square();
    builder.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] =
        json!({"KHR_texture_transform": {"scale": [3, -2], "rotation": 1, "texCoord": 0}});
    builder.json["extensionsUsed"] = json!(["KHR_texture_transform"]);
    let outcome = rebaked(&builder);
    let (json, colors) = written(&outcome);
    assert_eq!(colors(0, BASE), [RED]);
    assert_eq!(json["materials"].as_array().unwrap().len(), 1);
    assert_eq!(
        json["materials"][0].pointer(BASE).unwrap(),
        &json!({"index": 0})
    );
    assert_eq!(json["extensionsUsed"], Value::Null);
    let sampler = &json["samplers"][json["textures"][0]["sampler"].as_u64().unwrap() as usize];
    assert_eq!(sampler, &json!({"wrapS": 33071, "wrapT": 33071}));
    let notes = outcome.report.written.unwrap();
    assert_eq!(
        (notes.primitives[0].texcoord, notes.primitives[0].replaced),
        (0, true)
    );
    assert!(notes.textures_affected.is_empty() && notes.textures_kept.is_empty());
    // The padding of 2 texels at 1024 is much less at 32.
    assert_eq!(notes.warnings.len(), 1, "{:?}", notes.warnings);
    assert_eq!(
        (
            notes.textures_baked[0].texture,
            notes.textures_baked[0].side
        ),
        (0, 32)
    );
}

#[test]
fn a_material_of_two_atlases_becomes_two() {
    let outcome = rebaked(&twice(square(), "mesh"));
    let (json, colors) = written(&outcome);
    assert_eq!(json["materials"].as_array().unwrap().len(), 2);
    let material = |mesh: usize| json["meshes"][mesh]["primitives"][0]["material"].as_u64();
    assert_ne!(material(0), material(1));
    let textures = [0, 1].map(|m| json["materials"][m].pointer(BASE).unwrap()["index"].as_u64());
    assert_ne!(textures[0], textures[1]);
    assert_eq!((colors(0, BASE), colors(1, BASE)), (vec![RED], vec![RED]));
}

#[test]
fn what_takes_no_part_keeps_the_material() {
    let mut builder = twice(square(), "mesh");
    builder.json["meshes"][1]["primitives"][0]["mode"] = json!(0);
    let (json, colors) = written(&rebaked(&builder));
    assert_eq!(json["meshes"][1]["primitives"][0]["material"], 0);
    assert_eq!(json["materials"][0].pointer(BASE).unwrap()["index"], 0);
    assert_eq!(json["meshes"][0]["primitives"][0]["material"], 1);
    assert_eq!(colors(1, BASE), [RED]);
}

#[test]
fn materials_of_one_atlas_share_a_texture() {
    let mut builder = twice(square(), "primitive");
    builder.json["meshes"][0]["primitives"][1]["material"] = json!(1);
    let other = json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}});
    push(&mut builder.json["materials"], other);
    let (json, colors) = written(&rebaked(&builder));
    let textures = [0, 1].map(|m| json["materials"][m].pointer(BASE).unwrap()["index"].as_u64());
    assert_eq!(textures, [Some(0), Some(0)]);
    let colors = colors(0, BASE);
    assert!(colors.contains(&RED) && colors.contains(&BLUE));
}

#[test]
fn occlusion_and_roughness_of_one_image_stay_one() {
    let mut builder = square();
    builder.json["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] =
        json!({"index": 1});
    builder.json["materials"][0]["occlusionTexture"] = json!({"index": 1});
    let (json, colors) = written(&rebaked(&builder));
    let material = &json["materials"][0];
    let roughness = &material["pbrMetallicRoughness"]["metallicRoughnessTexture"];
    assert_eq!(material["occlusionTexture"], *roughness);
    assert_eq!(colors(0, "/occlusionTexture"), [BLUE]);
    assert_eq!(json["textures"].as_array().unwrap().len(), 2);
}

/// Two image entries of the same bytes are decoded once, and what shows them alike is resampled once.
#[test]
fn images_of_equal_bytes_are_one() {
    let mut builder = square();
    let copy = builder.json["images"][0].clone();
    push(&mut builder.json["images"], copy);
    push(&mut builder.json["textures"], json!({"source": 2}));
    builder.json["materials"][0]["emissiveTexture"] = json!({"index": 2});
    let (json, colors) = written(&rebaked(&builder));
    let material = &json["materials"][0];
    assert_eq!(
        material["emissiveTexture"]["index"],
        material.pointer(BASE).unwrap()["index"]
    );
    assert_eq!(colors(0, "/emissiveTexture"), [RED]);
    assert_eq!(json["textures"].as_array().unwrap().len(), 2);
}

#[test]
fn every_variant_of_a_surface_has_its_own() {
    let mut builder = square();
    let other = json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}});
    push(&mut builder.json["materials"], other);
    builder.json["meshes"][0]["primitives"][0]["extensions"] =
        json!({"KHR_materials_variants": {"mappings": [{"material": 1, "variants": [0]}]}});
    let (_, colors) = written(&rebaked(&builder));
    assert_eq!((colors(0, BASE), colors(1, BASE)), (vec![RED], vec![BLUE]));
}

#[test]
fn a_normal_map_gets_its_tangents() {
    let mut builder = square();
    builder.json["images"][1]["uri"] = json!(uri(FLAT));
    builder.json["materials"][0]["normalTexture"] = json!({"index": 1, "scale": 0.5});
    let outcome = rebaked(&builder);
    let (json, colors) = written(&outcome);
    // Of a value between two steps either is right, as the frame is turned.
    let close = |color: &[u8; 4]| color.iter().zip(FLAT).all(|(a, b)| a.abs_diff(b) <= 1);
    assert!(colors(0, "/normalTexture").iter().all(close));
    assert!(json["meshes"][0]["primitives"][0]["attributes"]["TANGENT"].is_u64());
    assert_eq!(json["materials"][0]["normalTexture"]["scale"], 0.5);
}

/// Then the old UVs stay, and the new ones lie beside them.
#[test]
fn what_cannot_be_resampled_stays_right() {
    let kept = |change: &dyn Fn(&mut Builder)| {
        let mut builder = square();
        change(&mut builder);
        let outcome = rebaked(&builder);
        let (json, _) = parts(&outcome.files[0].1);
        let notes = outcome.report.written.unwrap();
        assert_eq!(notes.primitives[0].texcoord, 1, "{notes:?}");
        assert!(notes.textures_affected.is_empty());
        let attributes = &json["meshes"][0]["primitives"][0]["attributes"];
        assert!(attributes["TEXCOORD_0"].is_u64() && attributes["TEXCOORD_1"].is_u64());
        let kept: Vec<String> = notes
            .textures_kept
            .iter()
            .map(|kept| kept.slot.clone())
            .collect();
        (json["materials"][0].clone(), kept)
    };
    let (material, slots) = kept(&|builder| {
        builder.json["images"][0]["uri"] = json!("data:image/webp;base64,UklGRgAAAABXRUJQ");
    });
    assert_eq!(slots, ["pbrMetallicRoughness/baseColorTexture"]);
    assert_eq!(material.pointer(BASE).unwrap(), &json!({"index": 0}));

    let (material, slots) = kept(&|builder| {
        builder.json["materials"][0]["extensions"] =
            json!({"ACME_rust": {"rustTexture": {"index": 1}}});
    });
    assert_eq!(slots, ["extensions/ACME_rust/rustTexture"]);
    assert_eq!(
        material.pointer(BASE).unwrap(),
        &json!({"index": 0, "texCoord": 1})
    );

    // One tangent cannot serve two maps.
    let (material, slots) = kept(&|builder| {
        builder.json["materials"][0]["normalTexture"] = json!({"index": 1});
        builder.json["materials"][0]["extensions"] = json!({"KHR_materials_clearcoat":
            {"clearcoatNormalTexture": {"index": 2}, "clearcoatTexture": {"index": 0}}});
        push(
            &mut builder.json["textures"],
            json!({"extensions": {"MSFT_texture_dds": {"source": 0}}}),
        );
    });
    let clearcoat = &material["extensions"]["KHR_materials_clearcoat"];
    assert_eq!(
        slots,
        [
            "extensions/KHR_materials_clearcoat/clearcoatNormalTexture",
            "normalTexture"
        ]
    );
    assert_eq!(clearcoat["clearcoatTexture"]["texCoord"], 1);
    assert_eq!(clearcoat["clearcoatNormalTexture"], json!({"index": 2}));
}

/// A square with one texture, whose image is at this URI.
fn square_with(image: &str) -> Builder {
    let mut builder = square();
    builder.json["textures"] = json!([{"source": 0}]);
    builder.json["images"] = json!([{"uri": image}]);
    builder
}

/// A square whose texture names its image by an extension.
fn square_of(extension: &str, image: &str) -> Builder {
    let mut builder = square_with(image);
    builder.json["textures"][0] = json!({"extensions": {extension: {"source": 0}}});
    builder.json["extensionsUsed"] = json!([extension]);
    builder.json["extensionsRequired"] = json!([extension]);
    builder
}

/// The file of a result's only image.
fn only_image(outcome: &Outcome) -> (Value, Vec<u8>) {
    let (json, bin) = parts(&outcome.files[0].1);
    let images = json["images"].as_array().unwrap();
    assert_eq!(images.len(), 1);
    let view = &json["bufferViews"][images[0]["bufferView"].as_u64().unwrap() as usize];
    let number = |key: &str| view[key].as_u64().unwrap_or(0) as usize;
    let file = bin[number("byteOffset")..][..number("byteLength")].to_vec();
    (json, file)
}

fn in_format(builder: &Builder, image_format: ImageFormat) -> (Value, Vec<u8>) {
    let baking = Baking {
        image_format,
        ..options().baking
    };
    let options = Options {
        baking,
        ..options()
    };
    only_image(&unwrap_document(&builder.upload(), &options, &Unobserved).unwrap())
}

/// WebP is read and written by its extension, which goes with the last such image.
#[test]
fn webp_is_read_and_written() {
    let mut red = Image::transparent(4, 4);
    red.pixels.fill(RED);
    let webp = square_of(
        "EXT_texture_webp",
        &data_uri("image/webp", &red.webp().unwrap()),
    );
    let png = square_with(&uri(RED));
    for (builder, format) in [(&webp, ImageFormat::Source), (&png, ImageFormat::Webp)] {
        let (json, file) = in_format(builder, format);
        assert_eq!(&file[8..12], b"WEBP");
        assert_eq!(json["images"][0]["mimeType"], "image/webp");
        let texture = &json["textures"][0];
        assert_eq!(texture["extensions"]["EXT_texture_webp"]["source"], 0);
        for list in ["extensionsUsed", "extensionsRequired"] {
            assert_eq!(json[list], json!(["EXT_texture_webp"]), "{list}");
        }
        let picture = Image::decode(&file).unwrap();
        assert!(picture.width == 32 && picture.pixels.iter().all(|texel| *texel == RED));
    }
    let (json, file) = in_format(&webp, ImageFormat::Png);
    assert!(file.starts_with(b"\x89PNG") && json["textures"][0]["source"] == 0);
    assert_eq!(
        [&json["extensionsUsed"], &json["extensionsRequired"]],
        [&Value::Null; 2]
    );
}

#[test]
fn textures_of_16_bits_keep_them_in_png_alone() {
    let color = [1000, 30_001, 65_534, u16::MAX];
    let deep = Image {
        width: 4,
        height: 4,
        pixels: vec![color; 16],
    };
    let builder = square_with(&data_uri("image/png", &deep.png()));
    let (_, file) = in_format(&builder, ImageFormat::Source);
    match Picture::decode(&file).unwrap() {
        Picture::Sixteen(image) => assert!(image.pixels.iter().all(|texel| *texel == color)),
        Picture::Eight(_) => panic!("the texture has 8 bits"),
    }
    let (_, file) = in_format(&builder, ImageFormat::Webp);
    assert_eq!(Image::decode(&file).unwrap().pixels[0], [4, 117, 255, 255]);
}

#[test]
fn an_image_that_is_not_read_is_named() {
    let reason = |extension: &str, image: &str| {
        let outcome = rebaked(&square_of(extension, image));
        assert!(outcome.report.partly_done);
        let notes = outcome.report.written.unwrap();
        notes.textures_kept[0].reason.clone()
    };
    let dds = reason("MSFT_texture_dds", "data:image/vnd-ms.dds;base64,RERTIA==");
    assert!(dds.contains("image 0 of MSFT_texture_dds"), "{dds}");
    let cut = data_uri("image/ktx2", b"\xABKTX 20\xBB\r\n\x1A\n");
    let cut = reason("KHR_texture_basisu", &cut);
    assert!(cut.contains("image 0: invalid picture: KTX2"), "{cut}");
}

/// KTX2 with Basis Universal is read in both of its encodings, and becomes PNG.
#[test]
fn ktx2_is_read() {
    for ktx2 in [
        include_bytes!("../../assets/ktx2/etc1s.ktx2").as_slice(),
        include_bytes!("../../assets/ktx2/uastc.ktx2").as_slice(),
    ] {
        let builder = square_of("KHR_texture_basisu", &data_uri("image/ktx2", ktx2));
        let mut options = options();
        options.cutting.cut = Cut::Keep;
        options.cutting.kept_maps = KeptMaps::AsGiven;
        options.control.control = vec!["all: lock".parse().unwrap()];
        options.baking.bake_size = Some(64);
        let outcome = unwrap_document(&builder.upload(), &options, &Unobserved).unwrap();
        assert!(!outcome.report.partly_done);
        let (json, file) = only_image(&outcome);
        assert!(file.starts_with(b"\x89PNG") && json["textures"][0]["source"] == 0);
        let lists = ["extensionsUsed", "extensionsRequired"].map(|list| &json[list]);
        assert_eq!(lists, [&Value::Null; 2]);
        // The island has not moved, so the texels are those of the picture.
        assert_eq!(
            Picture::decode(&file).unwrap(),
            Picture::decode(ktx2).unwrap()
        );
    }
}

/// Islands that are locked have not moved, so every texel of their texture stays.
#[test]
fn textures_of_locked_islands_are_copied() {
    let mut picture = Image::transparent(32, 32);
    for (k, pixel) in picture.pixels.iter_mut().enumerate() {
        *pixel = [(7 * k) as u8, (13 * k / 5) as u8, (k / 3) as u8, 255];
    }
    let builder = square_with(&data_uri("image/png", &picture.png()));
    let mut options = options();
    options.cutting.cut = Cut::Keep;
    options.cutting.kept_maps = KeptMaps::AsGiven;
    options.control.control = vec!["all: lock".parse().unwrap()];
    let outcome = unwrap_document(&builder.upload(), &options, &Unobserved).unwrap();
    let (_, file) = only_image(&outcome);
    assert_eq!(Image::decode(&file).unwrap(), picture);
}

#[test]
fn new_pictures_lie_beside_a_gltf() {
    let options = Options {
        format: OutputFormat::Gltf,
        ..options()
    };
    let outcome = unwrap_document(&square().upload(), &options, &Unobserved).unwrap();
    let names: Vec<&str> = outcome
        .files
        .iter()
        .map(|(name, _)| name.as_str())
        .collect();
    assert_eq!(names, ["a.gltf", "a.bin", "a_mesh0_baseColor.png"]);
    assert_eq!(Image::decode(&outcome.files[2].1).unwrap().width, 32);
}

#[test]
fn what_cannot_be_done_is_refused() {
    let code = |upload: &Upload, options: &Options| -> String {
        let error: PipelineError = unwrap_document(upload, options, &Unobserved).unwrap_err();
        error.code().to_owned()
    };
    let obj = Upload::single("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n".to_vec());
    let as_obj = Options {
        group_by: None,
        format: OutputFormat::Obj,
        ..options()
    };
    assert_eq!(code(&obj, &as_obj), "unsupported_output");
    let too_large = Options {
        baking: Baking {
            bake_size: Some(8193),
            ..options().baking
        },
        ..options()
    };
    assert_eq!(code(&square().upload(), &too_large), "invalid_options");
    // Three textures of each of three meshes are nine of 8192 × 8192.
    let mut many = square();
    for slot in ["occlusionTexture", "emissiveTexture"] {
        many.json["materials"][0][slot] = json!({"index": 1});
    }
    let many = twice(twice(many, "mesh"), "mesh");
    let large = Options {
        baking: Baking {
            bake_size: Some(8192),
            ..options().baking
        },
        ..options()
    };
    assert_eq!(code(&many.upload(), &large), "limit_exceeded");
}

#[test]
fn what_is_not_resampled_is_not_done() {
    assert!(!rebaked(&square()).report.partly_done);
    // A format that is not read, and a picture that is cut off.
    let avif = "data:image/avif;base64,AAAAHGZ0eXBhdmlmAAAAAGF2aWZtaWYxbWlhZg==";
    let cut = uri(RED);
    for image in [avif, &cut[..cut.len() / 2 / 4 * 4]] {
        let mut builder = square();
        builder.json["images"][0]["uri"] = json!(image);
        let report = rebaked(&builder).report;
        assert!(report.certified && report.partly_done);
        assert!(report.warnings.iter().any(|w| w.code == "textures_kept"));
    }
    // Colors and no texture, and neither.
    let mut builder = Builder::square();
    let report = rebaked(&builder).report;
    assert!(
        report
            .warnings
            .iter()
            .any(|w| w.code == "nothing_to_resample")
    );
    assert!(!report.partly_done);
    let colors = builder.floats("VEC3", 3, &[1., 0., 0.].repeat(4));
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
    let report = rebaked(&builder).report;
    assert!(report.certified && report.partly_done);
    assert!(report.warnings.iter().any(|w| w.code == "colors_kept"));
}
