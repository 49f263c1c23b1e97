//! VTK's XML format for unstructured grids, `.vtu`, as text: written for viewers such as ParaView, not read.
//!
//! Written without a library because it takes few lines: `vtkio`'s last stable release is from 2021 and would bring an
//! XML writer, compressors and a binary framework.
use super::Elements;
use std::fmt::Write;

/// VTK's numbers of triangles and tetrahedra.
const TYPES: [&str; 2] = ["5", "10"];

/// Numbers for each element.
#[derive(Clone, Debug, PartialEq)]
pub struct CellData {
    /// Name of the numbers.
    pub name: &'static str,
    /// Count of numbers per element.
    pub components: usize,
    /// All numbers, element after element.
    pub values: Vec<f64>,
}

/// Returns the text of the elements, triangles before tetrahedra, with data. Data of fewer elements belong to the last
/// ones; the others get NaN.
pub fn write(elements: &Elements, data: &[CellData]) -> String {
    let n_cells = elements.triangles.len() + elements.tets.len();
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\">\n\
         <UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{n_cells}\">\n<Points>\n\
         <DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n",
        elements.vertices.len()
    );
    // Vertices.
    for [x, y, z] in &elements.vertices {
        let _ = writeln!(text, "{x:?} {y:?} {z:?}"); // writing to a string cannot fail
    }
    text.push_str("</DataArray>\n</Points>\n<Cells>\n");
    // Cells.
    array(&mut text, "connectivity", |text| {
        for [a, b, c] in &elements.triangles {
            let _ = writeln!(text, "{a} {b} {c}");
        }
        for [a, b, c, d] in &elements.tets {
            let _ = writeln!(text, "{a} {b} {c} {d}");
        }
    });
    array(&mut text, "offsets", |text| {
        let n_triangles = elements.triangles.len() as u64;
        for k in 1..=n_triangles {
            let _ = writeln!(text, "{}", 3 * k);
        }
        for k in 1..=elements.tets.len() as u64 {
            let _ = writeln!(text, "{}", 3 * n_triangles + 4 * k);
        }
    });
    array(&mut text, "types", |text| {
        for (of_shape, n) in TYPES
            .into_iter()
            .zip([elements.triangles.len(), elements.tets.len()])
        {
            text.extend(std::iter::repeat_n([of_shape, "\n"], n).flatten());
        }
    });
    text.push_str("</Cells>\n");
    // Data of the cells.
    if !data.is_empty() {
        text.push_str("<CellData>\n");
        for cells in data {
            numbers(&mut text, cells, n_cells);
        }
        text.push_str("</CellData>\n");
    }
    text.push_str("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    text
}

fn array(text: &mut String, name: &str, content: impl FnOnce(&mut String)) {
    let _ = writeln!(
        text,
        "<DataArray type=\"Int64\" Name=\"{name}\" format=\"ascii\">"
    );
    content(text);
    text.push_str("</DataArray>\n");
}

/// Writes one line per element.
fn numbers(text: &mut String, data: &CellData, n_cells: usize) {
    let CellData {
        name,
        components,
        values,
    } = data;
    let _ = writeln!(
        text,
        "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
    );
    let unknown = vec![f64::NAN; *components];
    let n_unknown = n_cells.saturating_sub(values.len() / components);
    let lines = std::iter::repeat_n(&unknown[..], n_unknown).chain(values.chunks(*components));
    for line in lines {
        let line: Vec<String> = line.iter().map(|x| format!("{x:?}")).collect();
        let _ = writeln!(text, "{}", line.join(" "));
    }
    text.push_str("</DataArray>\n");
}
