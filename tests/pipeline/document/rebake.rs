//! Textures that are resampled when the UVs they sample are replaced.

use base64::Engine as _;
use serde_json::{Value, json};
use std::sync::Mutex;
use std::time::Duration;
use unwrapd_files::document::{Document, GroupBy, OutputFormat, Upload, Warning};
use unwrapd_files::picture::{Image, Picture};
use unwrapd_layout::atlas::Rotation;
use unwrapd_layout::charts::Cut;
use unwrapd_maps::mesh::Resolution;
use unwrapd_method::solver::Control;
use unwrapd_pipeline::{
    Baking, ImageFormat, KeptMaps, Observer, Options, Outcome, PipelineError, Progress,
    RepackOptions, Stacking, Stage, Unobserved, repack_document, unwrap_document,
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
    let mut options = options();
    options.baking.bake_tiled = true;
    let outcome = unwrap_document(&builder.upload(), &options, &Unobserved).unwrap();
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
    assert!(
        outcome
            .report
            .warnings
            .iter()
            .any(|w| w.code == "textures_tiled")
    );
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

// Textures that repeat.

/// Collects the warnings that come before the work.
#[derive(Default)]
struct Warned(Mutex<Vec<Warning>>);

impl Observer for Warned {
    fn progress(&self, progress: &Progress) -> Control {
        let has_begun = !matches!(progress.stage, Stage::Read);
        assert!(
            !has_begun || !self.0.lock().unwrap().is_empty(),
            "no warning"
        );
        Control::Continue
    }
    fn elapsed(&self) -> Duration {
        Duration::ZERO
    }
    fn warning(&self, warning: &Warning) {
        self.0.lock().unwrap().push(warning.clone());
    }
}

/// A square on which a texture of 4 × 4 texels repeats 16 × 16 times.
fn tiled_square() -> Builder {
    let mut builder = square();
    let uvs = builder.floats("VEC2", 2, &[0., 0., 16., 0., 16., 16., 0., 16.]);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
    builder
}

/// A texture that repeats stays on its set, with a warning before the work that tells the repeats and the loss.
#[test]
fn a_texture_that_repeats_stays_unless_asked() {
    let upload = tiled_square().upload();
    let warned = Warned::default();
    let outcome = unwrap_document(&upload, &options(), &warned).unwrap();
    let warned = warned.0.into_inner().unwrap();
    let [warning] = warned.as_slice() else {
        panic!("{warned:?}")
    };
    // 64 × 64 texels on a side of 32.
    for part in [
        "16.0 × 16.0 times",
        "256.0 times",
        "32 × 32",
        "at most 50 %",
        "--bake-tiled",
    ] {
        assert!(
            warning.message.contains(part),
            "{part}: {}",
            warning.message
        );
    }
    assert!(outcome.report.partly_done && outcome.report.warnings.contains(warning));
    let notes = outcome.report.written.as_ref().unwrap();
    assert_eq!(notes.primitives[0].texcoord, 1);
    let (json, _) = parts(&outcome.files[0].1);
    assert_eq!(
        json["materials"][0].pointer(BASE).unwrap(),
        &json!({"index": 0})
    );

    let mut asked = options();
    asked.baking.bake_tiled = true;
    let warned = Warned::default();
    let outcome = unwrap_document(&upload, &asked, &warned).unwrap();
    let warned = warned.0.into_inner().unwrap();
    assert_eq!(warned[0].code, "textures_tiled");
    assert!(!outcome.report.partly_done && outcome.report.warnings.contains(&warned[0]));
    let (_, colors) = written(&outcome);
    assert_eq!(colors(0, BASE), [RED]);
}

/// A texture is shown once by islands that are apart, that stick out of the square a little, or that a sampler clamps.
#[test]
fn what_is_shown_once_is_no_tiling() {
    let tiled = |change: &dyn Fn(&mut Builder)| {
        let mut builder = square();
        change(&mut builder);
        let report = rebaked(&builder).report;
        !report.written.unwrap().textures_kept.is_empty()
    };
    let with_uvs = |uvs: &[f32]| {
        let uvs = uvs.to_vec();
        move |builder: &mut Builder| {
            let uvs = builder.floats("VEC2", 2, &uvs);
            builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
        }
    };
    assert!(!tiled(&with_uvs(&[
        -0.02, 0., 1.02, 0., 1.02, 1., -0.02, 1.
    ])));
    assert!(!tiled(&with_uvs(&[5.5, 3., 6.5, 3., 6.5, 4., 5.5, 4.])));
    assert!(tiled(&with_uvs(&[0., 0., 2., 0., 2., 1., 0., 1.])));
    assert!(!tiled(&|builder| {
        with_uvs(&[0., 0., 2., 0., 2., 1., 0., 1.])(builder);
        builder.json["samplers"] = json!([{"wrapS": 33071}]);
        builder.json["textures"][0]["sampler"] = json!(0);
    }));
}

/// Merged materials need the texture in any case.
#[test]
fn merged_materials_take_textures_that_repeat() {
    let mut builder = twice(tiled_square(), "primitive");
    builder.json["meshes"][0]["primitives"][1]["material"] = json!(1);
    let other = json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}});
    push(&mut builder.json["materials"], other);
    let mut options = options();
    options.group_by = None;
    options.merge_materials = vec!["all".parse().unwrap()];
    let outcome = unwrap_document(&builder.upload(), &options, &Unobserved).unwrap();
    assert!(!outcome.report.partly_done);
    let warnings = outcome.report.warnings.iter();
    assert_eq!(warnings.filter(|w| w.code == "textures_tiled").count(), 2);
    let (json, colors) = written(&outcome);
    assert_eq!(json["materials"].as_array().unwrap().len(), 1);
    assert!(colors(0, BASE).contains(&RED) && colors(0, BASE).contains(&BLUE));
}

// Vertex colors.

fn with_colors(mut builder: Builder, colors: &[f32]) -> Builder {
    let colors = builder.floats("VEC3", 3, colors);
    builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(colors);
    builder
}

fn drawn(builder: &Builder) -> Outcome {
    let mut options = options();
    options.baking.rebake = false;
    options.baking.bake_colors = true;
    unwrap_document(&builder.upload(), &options, &Unobserved).unwrap()
}

/// The texture has what the texture and the colors showed, without gaps between charts, and the attribute is gone.
#[test]
fn vertex_colors_are_drawn_into_the_texture() {
    let blue_and_green = [0., 0.5, 1.].repeat(4);
    let mut white = square();
    white.json["images"][0]["uri"] = json!(uri([255; 4]));
    let plain = Builder::square();
    let mut factor = Builder::square();
    factor.json["materials"] = json!([{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 1, 1]}}]);
    factor.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    for (builder, wanted) in [
        (square(), [0, 0, 0, 255]),
        (white, [0, 188, 255, 255]),
        (plain, [0, 188, 255, 255]),
        (factor, [0, 188, 255, 255]),
    ] {
        let outcome = drawn(&with_colors(builder, &blue_and_green));
        let (json, colors) = written(&outcome);
        assert_eq!(colors(0, BASE), [wanted]);
        let attributes = &json["meshes"][0]["primitives"][0]["attributes"];
        assert_eq!(attributes["COLOR_0"], Value::Null);
        assert_eq!(json["meshes"][0]["primitives"][0]["material"], 0);
        let report = outcome.report;
        assert!(report.certified && !report.partly_done);
        assert_eq!(report.written.unwrap().colors_baked, 1);
    }
}

/// Colors belong to a primitive, so others with its material are drawn without.
#[test]
fn colors_of_one_primitive_stay_on_it() {
    let builder = twice(square(), "primitive");
    let outcome = drawn(&with_colors(builder, &[0., 1., 1.].repeat(4)));
    let (json, colors) = written(&outcome);
    assert_eq!(json["materials"].as_array().unwrap().len(), 1);
    let colors = colors(0, BASE);
    assert!(colors.contains(&RED) && colors.contains(&[0, 0, 0, 255]));
}

#[test]
fn merged_materials_have_the_vertex_colors() {
    let mut builder = twice(Builder::square(), "primitive");
    builder.json["materials"] = json!([{}, {}]);
    builder.json["meshes"][0]["primitives"][0]["material"] = json!(0);
    builder.json["meshes"][0]["primitives"][1]["material"] = json!(1);
    let mut options = options();
    options.group_by = None;
    options.baking.bake_colors = true;
    options.merge_materials = vec!["all".parse().unwrap()];
    let upload = with_colors(builder, &[1., 0., 0.].repeat(4)).upload();
    let outcome = unwrap_document(&upload, &options, &Unobserved).unwrap();
    let (json, colors) = written(&outcome);
    assert_eq!(json["meshes"][0]["primitives"].as_array().unwrap().len(), 1);
    let colors = colors(0, BASE);
    assert!(colors.contains(&RED) && colors.contains(&[255; 4]));
}

/// Colors stay where a material could not show them, and a warning says why.
#[test]
fn colors_that_cannot_be_drawn_stay() {
    let kept = |change: &dyn Fn(&mut Builder), why: &str| {
        let mut builder = with_colors(square(), &[0., 1., 0.].repeat(4));
        change(&mut builder);
        let outcome = drawn(&builder);
        let (json, _) = parts(&outcome.files[0].1);
        let attributes = &json["meshes"][0]["primitives"][0]["attributes"];
        assert!(attributes["COLOR_0"].is_u64(), "{why}");
        let report = outcome.report;
        assert!(report.partly_done && report.written.unwrap().colors_baked == 0);
        let mut warnings = report.warnings.iter();
        assert!(
            warnings.any(|w| w.code == "colors_kept" && w.message.contains(why)),
            "{why}"
        );
    };
    kept(
        &|builder| {
            let more = builder.floats("VEC3", 3, &[0.; 12]);
            builder.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_1"] = json!(more);
        },
        "further colors",
    );
    kept(
        &|builder| {
            let morph = builder.floats("VEC3", 3, &[0.; 12]);
            builder.json["meshes"][0]["primitives"][0]["targets"] = json!([{"COLOR_0": morph}]);
        },
        "morph targets",
    );
    kept(
        &|builder| {
            builder.json["materials"][0]["extensions"] =
                json!({"KHR_materials_pbrSpecularGlossiness": {}});
        },
        "specular-glossiness",
    );
    kept(
        &|builder| {
            builder.json["images"][0]["uri"] = json!("data:image/webp;base64,UklGRgAAAABXRUJQ");
        },
        "not resampled",
    );
}

#[test]
fn an_obj_gets_the_texture_in_place_of_the_colors() {
    let mut options = options();
    (options.group_by, options.format) = (None, OutputFormat::Obj);
    options.baking.bake_colors = true;
    let upload = with_colors(Builder::square(), &[0., 0., 1.].repeat(4)).upload();
    let outcome = unwrap_document(&upload, &options, &Unobserved).unwrap();
    let text = String::from_utf8(outcome.files[0].1.clone()).unwrap();
    let vertices = text.lines().filter(|line| line.starts_with("v "));
    assert!(
        vertices.clone().count() == 4 && vertices.into_iter().all(|v| v.split(' ').count() == 4)
    );
    let picture = outcome
        .files
        .iter()
        .find(|(name, _)| name.contains("baseColor"))
        .unwrap();
    let texels = Image::decode(&picture.1).unwrap().pixels;
    assert!(texels.iter().all(|texel| *texel == BLUE));
}

// Islands that share texels.

/// Two squares of one material, the second shown by this part of the texture.
fn stack(second: &[f32]) -> Builder {
    let mut builder = twice(square(), "primitive");
    let mut picture = Image::transparent(32, 32);
    for (k, pixel) in picture.pixels.iter_mut().enumerate() {
        *pixel = [(7 * k) as u8, (13 * k / 5) as u8, (k / 3) as u8, 255];
    }
    builder.json["images"][0]["uri"] = json!(data_uri("image/png", &picture.png()));
    let positions = [5., 0., 0., 6., 0., 0., 6., 1., 0., 5., 1., 0.];
    let positions = builder.floats("VEC3", 3, &positions);
    let uvs = builder.floats("VEC2", 2, second);
    let attributes = &mut builder.json["meshes"][0]["primitives"][1]["attributes"];
    attributes["POSITION"] = json!(positions);
    attributes["TEXCOORD_0"] = json!(uvs);
    builder
}

/// Islands that had the same texels share those of the new texture.
#[test]
fn stacks_of_the_same_texels_are_resampled() {
    let same = [0., 0., 1., 0., 1., 1., 0., 1.];
    let options = RepackOptions {
        baking: options().baking,
        ..RepackOptions::default()
    };
    let outcome = repack_document(&stack(&same).upload(), &options, &Unobserved).unwrap();
    assert!(outcome.report.certified && !outcome.report.partly_done);
    let document = Document::read(&Upload::single("a.glb", outcome.files[0].1.clone())).unwrap();
    let uvs = |primitive: usize| document.corner_uvs(primitive, 0).unwrap();
    assert_eq!(uvs(0), uvs(1));
}

/// A stack by shape whose islands had other texels is refused by name.
#[test]
fn stacks_of_other_texels_are_refused() {
    let turned = [1., 0., 1., 1., 0., 1., 0., 0.];
    let mut options = options();
    options.layout.stack = Some(Stacking::Identical);
    let upload = stack(&turned).upload();
    let error = unwrap_document(&upload, &options, &Unobserved).unwrap_err();
    assert_eq!((error.code(), error.exit_code()), ("stacks_differ", 3));
    assert!(error.to_string().contains("baseColor"), "{error}");
    options.layout.stack_offset = true;
    let error = unwrap_document(&upload, &options, &Unobserved).unwrap_err();
    assert_eq!(error.code(), "invalid_options");
}

/// Islands that keep their density and turn by quarters are packed on whole texels of their texture.
#[test]
fn islands_that_keep_their_size_move_by_whole_texels() {
    // Squares of 10 texels, of 32, whose corners are 3/10 of a texel off.
    let square = |low: f32| {
        let [low, high] = [low, low + 10.0].map(|x| (x + 0.3) / 32.0);
        [low, low, high, low, high, high, low, high]
    };
    let mut builder = stack(&square(18.0));
    let uvs = builder.floats("VEC2", 2, &square(3.0));
    builder.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(uvs);
    let mut options = RepackOptions {
        baking: options().baking,
        ..RepackOptions::default()
    };
    options.layout.resolution = Resolution::square(32);
    options.layout.rotate = Rotation::Quarter;
    options.control.control = vec!["all: density keep".parse().unwrap()];
    let outcome = repack_document(&builder.upload(), &options, &Unobserved).unwrap();
    assert!(outcome.report.certified);
    let document = Document::read(&Upload::single("a.glb", outcome.files[0].1.clone())).unwrap();
    let uvs = [0, 1].map(|primitive| document.corner_uvs(primitive, 0).unwrap().unwrap());
    for x in uvs.concat().as_flattened().as_flattened() {
        let off = (32.0 * x).fract();
        let is_near = |part: f64| (off - part).abs() < 1e-4;
        assert!(is_near(0.3) || is_near(0.7), "{off}");
    }
}
