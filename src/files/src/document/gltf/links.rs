//! References of a document to accessors, buffer views, images, samplers and textures.
use super::json::as_unsigned;
use serde_json::Value;

/// Collections of objects that can lose their last reference. Objects refer only to objects of later collections.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Collection {
    Textures,
    Images,
    Samplers,
    Accessors,
    BufferViews,
}

/// An object of a collection.
pub(super) type Object = (Collection, usize);

impl Collection {
    pub const ALL: [Self; 5] = [
        Self::Textures,
        Self::Images,
        Self::Samplers,
        Self::Accessors,
        Self::BufferViews,
    ];

    /// Returns the member of the document that holds the collection.
    pub fn key(self) -> &'static str {
        match self {
            Self::Textures => "textures",
            Self::Images => "images",
            Self::Samplers => "samplers",
            Self::Accessors => "accessors",
            Self::BufferViews => "bufferViews",
        }
    }

    fn of_key(key: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|collection| collection.key() == key)
    }
}

/// Calls `place` for every reference to an object of a collection, with its owner, the object, and the number.
/// References in unknown extensions are left out; `origin.rs` has them.
pub(super) fn visit(json: &mut Value, place: &mut dyn FnMut(Option<Object>, Object, &mut Value)) {
    let Some(root) = json.as_object_mut() else {
        return;
    };
    for (key, value) in root {
        let collection = Collection::of_key(key);
        match (collection, value) {
            (Some(collection), Value::Array(objects)) => {
                for (index, object) in objects.iter_mut().enumerate() {
                    let mut visitor = Visitor {
                        owner: Some((collection, index)),
                        place,
                    };
                    visitor.collected(collection, object);
                    visitor.infos_and_extensions(object);
                }
            }
            (_, value) => {
                let mut visitor = Visitor { owner: None, place };
                visitor.core(key, value);
                visitor.member_of(key, value);
            }
        }
    }
}

struct Visitor<'a> {
    owner: Option<Object>,
    place: &'a mut dyn FnMut(Option<Object>, Object, &mut Value),
}

impl Visitor<'_> {
    fn number(&mut self, collection: Collection, value: Option<&mut Value>) {
        if let Some(value) = value
            && let Some(index) = as_unsigned(value)
        {
            (self.place)(self.owner, (collection, index), value);
        }
    }

    fn member(&mut self, collection: Collection, object: &mut Value, key: &str) {
        self.number(collection, object.get_mut(key));
    }

    fn all(&mut self, collection: Collection, values: Option<&mut Value>) {
        children(values).for_each(|value| self.number(collection, Some(value)));
    }

    /// Visits the references of an object of a collection.
    fn collected(&mut self, collection: Collection, object: &mut Value) {
        match collection {
            Collection::Textures => {
                self.member(Collection::Images, object, "source");
                self.member(Collection::Samplers, object, "sampler");
            }
            Collection::Images => self.member(Collection::BufferViews, object, "bufferView"),
            Collection::Accessors => {
                self.member(Collection::BufferViews, object, "bufferView");
                for part in ["indices", "values"] {
                    let view = object.pointer_mut(&format!("/sparse/{part}/bufferView"));
                    self.number(Collection::BufferViews, view);
                }
            }
            Collection::Samplers | Collection::BufferViews => {}
        }
    }

    /// Visits the references of another top-level member by the rules of glTF itself.
    fn core(&mut self, key: &str, value: &mut Value) {
        for object in children(Some(value)) {
            match key {
                "meshes" => {
                    children(object.get_mut("primitives")).for_each(|p| self.primitive(p));
                }
                "skins" => self.member(Collection::Accessors, object, "inverseBindMatrices"),
                "animations" => {
                    for sampler in children(object.get_mut("samplers")) {
                        self.member(Collection::Accessors, sampler, "input");
                        self.member(Collection::Accessors, sampler, "output");
                    }
                }
                _ => {}
            }
        }
    }

    fn primitive(&mut self, primitive: &mut Value) {
        self.member(Collection::Accessors, primitive, "indices");
        self.all(Collection::Accessors, primitive.get_mut("attributes"));
        for target in children(primitive.get_mut("targets")) {
            self.all(Collection::Accessors, Some(target));
        }
    }

    /// Visits texture infos and extensions at any depth, which the parser of the document bounds.
    fn infos_and_extensions(&mut self, value: &mut Value) {
        match value {
            Value::Array(items) => items.iter_mut().for_each(|v| self.infos_and_extensions(v)),
            Value::Object(members) => {
                for (key, child) in members {
                    self.member_of(key, child);
                }
            }
            _ => {}
        }
    }

    /// Visits a member of any object.
    fn member_of(&mut self, key: &str, child: &mut Value) {
        match (key, &mut *child) {
            ("extras", _) => return,
            ("extensions", Value::Object(extensions)) => {
                for (name, extension) in extensions {
                    self.extension(name, extension);
                }
            }
            _ if names_texture(key) => {
                self.member(Collection::Textures, child, "index");
            }
            _ => {}
        }
        self.infos_and_extensions(child);
    }

    /// Visits the references of an extension other than texture infos.
    fn extension(&mut self, name: &str, extension: &mut Value) {
        match name {
            "KHR_draco_mesh_compression" => {
                self.member(Collection::BufferViews, extension, "bufferView");
            }
            "EXT_mesh_gpu_instancing" => {
                self.all(Collection::Accessors, extension.get_mut("attributes"));
            }
            "CESIUM_primitive_outline" => self.member(Collection::Accessors, extension, "indices"),
            "EXT_mesh_manifold" => {
                if let Some(primitive) = extension.get_mut("manifoldPrimitive") {
                    self.primitive(primitive);
                }
                self.member(Collection::Accessors, extension, "mergeIndices");
                self.member(Collection::Accessors, extension, "mergeValues");
            }
            "KHR_texture_basisu" | "EXT_texture_webp" | "EXT_texture_avif" | "MSFT_texture_dds" => {
                self.member(Collection::Images, extension, "source");
            }
            "EXT_lights_image_based" => {
                for light in children(extension.get_mut("lights")) {
                    for faces in children(light.get_mut("specularImages")) {
                        self.all(Collection::Images, Some(faces));
                    }
                }
            }
            "EXT_structural_metadata" => self.metadata(extension),
            _ => {}
        }
    }

    fn metadata(&mut self, extension: &mut Value) {
        for table in children(extension.get_mut("propertyTables")) {
            for property in children(table.get_mut("properties")) {
                for key in ["values", "arrayOffsets", "stringOffsets"] {
                    self.member(Collection::BufferViews, property, key);
                }
            }
        }
        for texture in children(extension.get_mut("propertyTextures")) {
            let properties = texture.get_mut("properties").and_then(Value::as_object_mut);
            for (key, property) in properties.into_iter().flatten() {
                // Others are texture infos by their names.
                if !names_texture(key) {
                    self.member(Collection::Textures, property, "index");
                }
            }
        }
    }
}

/// Iterates over the elements of an array or the values of an object.
fn children(value: Option<&mut Value>) -> Box<dyn Iterator<Item = &mut Value> + '_> {
    let Some(value) = value else {
        return Box::new(std::iter::empty());
    };
    match value {
        Value::Array(items) => Box::new(items.iter_mut()),
        Value::Object(members) => Box::new(members.values_mut()),
        _ => Box::new(std::iter::empty()),
    }
}

/// Returns whether a member of this name is a texture info.
fn names_texture(key: &str) -> bool {
    key.to_ascii_lowercase().ends_with("texture")
}
