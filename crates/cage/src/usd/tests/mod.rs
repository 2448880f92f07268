mod forms;
mod meshes;
mod refused;
mod scenes;

use super::*;
use crate::RepairDesc;

/// A cage from the text of a file without its first line.
fn cage(text: &str) -> Cage {
    read(text).unwrap_or_else(|error| panic!("{error}"))
}

fn read(text: &str) -> Result<Cage, ReadError> {
    read_usd(format!("#usda 1.0\n{text}").as_bytes(), "a.usda", &ReadDesc::default())
}

/// The message for a text without its first line, without the name of the file; with the line, if it has one.
fn message(text: &str) -> String {
    let message = read(text).expect_err("must be refused").to_string();
    let message = message.strip_prefix("a.usda").expect("the file comes first");
    message.strip_prefix(": ").unwrap_or(message).to_string()
}

/// The properties of a square in the plane of x and y.
const SQUARE: &str = "int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]";

/// A square with further properties.
fn square(properties: &str) -> String {
    format!("def Mesh \"Square\" {{\n{SQUARE}\n{properties}\n}}\n")
}

/// Two squares side by side.
fn strip(properties: &str) -> String {
    format!(
        "def Mesh \"Strip\" {{
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 4, 3, 1, 2, 5, 4]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (0, 1, 0), (1, 1, 0), (2, 1, 0)]
    {properties}\n}}\n"
    )
}
