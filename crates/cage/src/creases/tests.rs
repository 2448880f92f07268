use crate::{Cage, CreaseDesc, ReadDesc, Warning, obj};

/// A roof of two squares with a flat third one: edges 2-5 (90 degrees) and 3-6 (0 degrees), in file numbers from 1.
const ROOF: &str =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 -1\nv 1 1 -1\nv 1 0 -2\nv 1 1 -2\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

fn read(faces: &str, creases: CreaseDesc) -> Cage {
    let desc = ReadDesc { creases: Some(creases), ..ReadDesc::default() };
    let text = format!("{ROOF}{faces}");
    obj::draft(text.as_bytes(), "a.obj", &desc).and_then(|draft| draft.finish("a.obj", &desc)).expect("a cage")
}

fn ends(cage: &Cage) -> Vec<[u32; 2]> {
    cage.tags().creases.iter().map(|crease| crease.vertices).collect()
}

fn warnings(cage: &Cage) -> Vec<String> {
    let ours = |warning: &&Warning| matches!(warning, Warning::CreasesMade { .. } | Warning::NoCreasesFrom(_));
    cage.warnings().iter().filter(ours).map(ToString::to_string).collect()
}

const PLAIN: &str = "f 1 2 3 4\nf 2 5 6 3\nf 5 7 8 6\n";

#[test]
fn by_angle() {
    let by = |degrees| CreaseDesc { angle: Some(degrees), sharpness: 2.5, ..CreaseDesc::default() };
    let cage = read(PLAIN, by(89.0));
    assert_eq!((ends(&cage), cage.tags().creases[0].sharpness), (vec![[1, 2]], 2.5));
    assert_eq!(warnings(&cage), ["1 crease made"]);
    assert_eq!(ends(&read(PLAIN, by(91.0))), [[0; 2]; 0]);
    assert_eq!(ends(&read(PLAIN, by(-1.0))).len(), 2);
}

#[test]
fn by_smoothing_groups() {
    let by = CreaseDesc { smoothing: true, ..CreaseDesc::default() };
    assert_eq!(ends(&read("s 1\nf 1 2 3 4\nf 2 5 6 3\ns 2\nf 5 7 8 6\n", by)), [[4, 5]]);
    // Faces without a group are flat, even beside each other.
    assert_eq!(ends(&read("s 1\nf 1 2 3 4\ns off\nf 2 5 6 3\nf 5 7 8 6\n", by)), [[1, 2], [4, 5]]);
    assert_eq!(ends(&read("s 1\nf 1 2 3 4\nf 2 5 6 3\nf 5 7 8 6\n", by)), [[0; 2]; 0]);
    let none = read(&format!("s 0\n{PLAIN}"), by);
    assert_eq!(warnings(&none), ["no creases made from smoothing groups, because the file has none", "0 creases made"]);
}

#[test]
fn by_material() {
    let by = CreaseDesc { materials: true, ..CreaseDesc::default() };
    assert_eq!(ends(&read("usemtl a\nf 1 2 3 4\nf 2 5 6 3\nusemtl b\nf 5 7 8 6\n", by)), [[4, 5]]);
    assert_eq!(ends(&read("f 1 2 3 4\nusemtl b\nf 2 5 6 3\nf 5 7 8 6\n", by)), [[1, 2]]);
}

#[test]
fn by_uv() {
    let by = CreaseDesc { uv: true, ..CreaseDesc::default() };
    // Joined by other indices with the same values across the first edge, a seam at one end of the second.
    let faces = "vt 1 0\nvt 1 1\nf 1/1 2/2 3/3 4/4\nf 2/5 5/1 6/4 3/6\nf 5/1 7/2 8/3 6/3\n";
    assert_eq!(ends(&read(faces, by)), [[4, 5]]);
    assert_eq!(warnings(&read(PLAIN, by))[0], "no creases made from texture coordinates, because the file has none");
}

#[test]
fn tags_of_the_file_stay() {
    let by = CreaseDesc { angle: Some(30.0), ..CreaseDesc::default() };
    let cage = read(&format!("{PLAIN}t crease 2/1/0 2 1 0.5\n"), by);
    assert_eq!((ends(&cage), cage.tags().creases[0].sharpness), (vec![[2, 1]], 0.5));
    assert_eq!(warnings(&cage), ["0 creases made (1 edge had a tag already)"]);
}

#[test]
fn size_and_flat_faces_do_not_matter() {
    let by = CreaseDesc { angle: Some(30.0), ..CreaseDesc::default() };
    for scale in [1e-200, 1e-30, 1e15] {
        let word = |word: &str| word.parse::<f64>().map_or(word.to_owned(), |x| format!("{:?}", x * scale));
        let line = |line: &str| line.split(' ').map(word).collect::<Vec<_>>().join(" ") + "\n";
        let text: String = ROOF.lines().filter(|l| l.starts_with("v ")).map(line).chain([PLAIN.into()]).collect();
        let desc = ReadDesc { creases: Some(by), ..ReadDesc::default() };
        let draft = obj::draft(text.as_bytes(), "a.obj", &desc);
        assert_eq!(ends(&draft.and_then(|draft| draft.finish("a.obj", &desc)).expect("a cage")), [[1, 2]], "{scale}");
    }
    let point = "v 5 5 5\nv 5 5 5\nv 5 5 5\nv 5 5 5\nf -4 -3 -2\nf -4 -2 -1\n";
    assert_eq!(ends(&read(point, by)), [[0; 2]; 0]);
}
