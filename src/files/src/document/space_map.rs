/// A map of space that carries the surfaces of a document along.
///
/// Places are vertex positions as the file has them. Each method answers for every place, in the same way whatever places come
/// with it, as surfaces may be asked about in several portions.
pub trait SpaceMap {
    /// Where the places go.
    fn positions(&self, places: &[[f32; 3]]) -> Vec<[f32; 3]>;

    /// Unit normals after the map of surfaces with `normals` at the places.
    fn normals(&self, places: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<[f32; 3]>;

    /// Unit tangents after the map of curves with `tangents` at the places.
    fn tangents(&self, places: &[[f32; 3]], tangents: &[[f32; 3]]) -> Vec<[f32; 3]>;
}
