/// A map of space that carries the surfaces of a document along.
///
/// Places are vertex positions as in the file. Each method returns an answer for every place, independent of the other
/// places, as surfaces may be passed in several portions.
pub trait SpaceMap {
    /// Returns the images of the places.
    fn positions(&self, places: &[[f32; 3]]) -> Vec<[f32; 3]>;

    /// Returns the unit normals after the map of surfaces with `normals` at the places.
    fn normals(&self, places: &[[f32; 3]], normals: &[[f32; 3]]) -> Vec<[f32; 3]>;

    /// Returns the unit tangents after the map of curves with `tangents` at the places.
    fn tangents(&self, places: &[[f32; 3]], tangents: &[[f32; 3]]) -> Vec<[f32; 3]>;
}
