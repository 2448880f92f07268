//! The shipped cages: what each exercises, and the chore that writes them to `assets/cages`.
//!
//! Each cage is a pure function of nothing, so that a change of the generator shows as a change of the committed file.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};

mod creature;
mod glb;
mod mesh;
mod obj;
mod primitives;
mod readme;
mod rng;
mod shell;
mod skin;
mod sphere;
mod star;
mod survey;
mod triangles;
mod voxels;

use mesh::Mesh;
use skin::Skin;
use survey::Survey;

/// One shipped cage.
struct Asset {
    /// File name without the extension.
    name: String,
    /// One line: what the cage exercises.
    exercises: &'static str,
    mesh: Mesh,
    /// What moves it; such a cage is a binary glTF file, any other one OBJ text.
    skin: Option<Skin>,
}

impl Asset {
    fn new(name: impl Into<String>, exercises: &'static str, mesh: Mesh) -> Self {
        Self { name: name.into(), exercises, mesh, skin: None }
    }

    fn animated(name: impl Into<String>, exercises: &'static str, (mesh, skin): (Mesh, Skin)) -> Self {
        Self { name: name.into(), exercises, mesh, skin: Some(skin) }
    }

    fn file_name(&self) -> String {
        format!("{}.{}", self.name, if self.skin.is_some() { "glb" } else { "obj" })
    }

    fn bytes(&self) -> Vec<u8> {
        let comment = format!("{}: {}", self.name, self.exercises);
        match &self.skin {
            Some(skin) => glb::to_glb(&self.mesh, skin, &comment),
            None => obj::to_obj(&self.mesh, &comment).into_bytes(),
        }
    }
}

/// Every shipped cage, in the order of the table in the README.
fn assets() -> Vec<Asset> {
    let mut assets = vec![
        Asset::new("cube", "valence 3 at every corner; the smallest closed quad cage", primitives::cube()),
        Asset::new(
            "pyramid",
            "triangles beside a quad, valence 3 and 4; the report's worked example",
            primitives::pyramid(),
        ),
        Asset::new("torus", "regular patches only: no extraordinary vertex, no boundary", primitives::torus(12, 8)),
        Asset::new("twohole", "genus 2; quads with several extraordinary corners, valence 3 to 5", voxels::two_holes()),
        Asset::new("grid", "open regular grid: boundary patches and four one-face corners", primitives::grid(8)),
        Asset::new("ngon", "triangles, quads, pentagons and a hexagon in one closed cage", primitives::ngon()),
    ];
    for valence in star::VALENCES {
        let exercises = match valence {
            4 => "one interior vertex of valence 4: the regular control case",
            13.. => "one interior vertex beyond the valences with a pipeline of their own",
            _ => "one interior extraordinary vertex in an open dome of quads",
        };
        assets.push(Asset::new(format!("star{valence}"), exercises, star::star(valence)));
    }
    assets.extend([
        Asset::new("stars", "the stars of valence 3 to 12 side by side: all pipelines of a scheme", star::stars()),
        Asset::new(
            "uvsphere",
            "two poles of valence 64 in fans of triangles; uv with a seam",
            sphere::uv_sphere(64, 12),
        ),
        Asset::new("shell", "open shell: boundary vertices with 1, 2, 3, 4 and 5 faces", shell::shell()),
        Asset::new(
            "shell_edge_only",
            "the shell with smooth boundary corners (tag interpolateboundary 2)",
            shell::shell_edge_only(),
        ),
        Asset::new("triangles", "closed cage of triangles only, valence 4 to 9", triangles::pebble()),
        Asset::new("dragon", "the creature of the pictures: all quads, valence 3 to 6, uv", creature::dragon()),
        Asset::animated(
            "dragon_walk",
            "the dragon with a skeleton and a walk on the spot that loops: 36 joints, four to a vertex",
            creature::walking_dragon(),
        ),
    ]);
    assets
}

/// The folder of the shipped cages.
fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/cages")
}

/// Name and content of every file that belongs in [`folder`].
fn files() -> anyhow::Result<Vec<(String, Vec<u8>)>> {
    let assets = assets();
    let mut files = Vec::with_capacity(assets.len() + 1);
    let mut rows = Vec::with_capacity(assets.len());
    for asset in &assets {
        let survey = Survey::of(&asset.mesh).with_context(|| format!("{} is not fit to ship", asset.file_name()))?;
        files.push((asset.file_name(), asset.bytes()));
        rows.push((asset, survey));
    }
    files.push(("README.md".into(), readme::text(&rows).into_bytes()));
    Ok(files)
}

/// Writes every shipped cage and the README that lists them.
pub(crate) fn write() -> anyhow::Result<()> {
    let folder = folder();
    fs::create_dir_all(&folder).with_context(|| format!("cannot create {}", folder.display()))?;
    for (name, content) in files()? {
        let path = folder.join(name);
        fs::write(&path, content).with_context(|| format!("cannot write {}", path.display()))?;
    }
    Ok(())
}

/// Fails if a committed file differs from what [`write()`] would write, or belongs to no cage.
pub(crate) fn check() -> anyhow::Result<()> {
    let folder = folder();
    let expected = files()?;
    let mut wrong: Vec<String> = Vec::new();
    for (name, content) in &expected {
        match fs::read(folder.join(name)) {
            Ok(found) if same(name, &found, content) => {}
            Ok(_) => wrong.push(format!("{name} differs")),
            Err(error) => wrong.push(format!("{name} cannot be read: {error}")),
        }
    }
    for entry in fs::read_dir(&folder).with_context(|| format!("cannot list {}", folder.display()))? {
        let name = entry?.file_name().to_string_lossy().into_owned();
        if !expected.iter().any(|(known, _)| *known == name) {
            wrong.push(format!("{name} comes from no generator"));
        }
    }
    ensure!(wrong.is_empty(), "assets/cages is out of date: {}; run `cargo xtask cages`", wrong.join(", "));
    Ok(())
}

/// Whether two files are the same. Git may have turned line ends of text on the way to this machine; that is no difference.
fn same(name: &str, found: &[u8], expected: &[u8]) -> bool {
    let lines = |text: &[u8]| String::from_utf8_lossy(text).replace("\r\n", "\n");
    found == expected || (!name.ends_with(".glb") && lines(found) == lines(expected))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn survey(name: &str) -> Survey {
        let asset = assets().into_iter().find(|asset| asset.name == name).expect("a shipped cage");
        Survey::of(&asset.mesh).expect("a sound cage")
    }

    #[test]
    fn committed_files_are_what_the_generators_write() {
        check().unwrap();
    }

    #[test]
    fn names_are_unique_and_files_small() {
        let files = files().unwrap();
        for (index, (name, content)) in files.iter().enumerate() {
            assert!(files[..index].iter().all(|(earlier, _)| earlier != name), "{name} occurs twice");
            assert!(content.len() < 1 << 20, "{name} has {} bytes", content.len());
        }
    }

    #[test]
    fn closed_cages_are_closed_and_wound_outward() {
        for name in ["cube", "pyramid", "torus", "twohole", "ngon", "uvsphere", "triangles", "dragon", "dragon_walk"] {
            let survey = survey(name);
            assert!(survey.is_closed(), "{name} is open");
            assert!(survey.volume > 0.0, "{name} is inside out");
        }
    }

    #[test]
    fn genus_is_as_promised() {
        for (name, characteristic) in [("cube", 2), ("torus", 0), ("twohole", -2), ("uvsphere", 2), ("triangles", 2)] {
            assert_eq!(survey(name).characteristic, characteristic, "{name}");
        }
    }

    #[test]
    fn a_star_has_one_extraordinary_vertex() {
        for valence in star::VALENCES {
            let survey = survey(&format!("star{valence}"));
            let mut expected = [(4, 2 * valence)].to_vec();
            match valence {
                4 => expected[0].1 += 1,
                _ => expected.push((valence, 1)),
            }
            expected.sort_unstable();
            assert_eq!(survey.interior_valences.into_iter().collect::<Vec<_>>(), expected, "star{valence}");
            assert!(survey.boundary_faces.keys().all(|faces| *faces <= 2), "star{valence}");
        }
    }

    #[test]
    fn stars_side_by_side_have_every_valence_and_stay_apart() {
        let survey = survey("stars");
        let expected = star::SIDE_BY_SIDE.map(|valence| match valence {
            4 => (4, star::SIDE_BY_SIDE.map(|valence| 2 * valence).sum::<usize>() + 1),
            _ => (valence, 1),
        });
        assert_eq!(survey.interior_valences.into_iter().collect::<Vec<_>>(), expected.collect::<Vec<_>>());
        assert_eq!(survey.characteristic, star::SIDE_BY_SIDE.count() as isize, "as many disks as stars");
    }

    #[test]
    fn poles_have_valence_64() {
        let survey = survey("uvsphere");
        assert_eq!(survey.interior_valences[&64], 2);
        assert_eq!(survey.interior_valences.len(), 2);
    }

    #[test]
    fn shells_have_every_boundary_vertex_they_promise() {
        for name in ["shell", "shell_edge_only"] {
            let found: Vec<usize> = survey(name).boundary_faces.into_keys().collect();
            assert_eq!(found, [1, 2, 3, 4, 5], "{name}");
        }
    }

    #[test]
    fn triangle_cage_has_valences_4_to_9() {
        let survey = survey("triangles");
        assert_eq!(survey.face_sizes.into_keys().collect::<Vec<_>>(), [3]);
        assert_eq!(survey.interior_valences.into_keys().collect::<Vec<_>>(), [4, 5, 6, 7, 8, 9]);
    }

    #[test]
    fn the_dragon_is_one_body_and_two_eyes_of_quads() {
        let survey = survey("dragon");
        assert_eq!(survey.face_sizes.keys().copied().collect::<Vec<_>>(), [4]);
        assert!((1000..=2000).contains(&survey.faces()), "{} quads", survey.faces());
        assert_eq!(survey.interior_valences.keys().copied().collect::<Vec<_>>(), [3, 4, 5, 6]);
        assert_eq!(survey.characteristic, 3 * 2, "three spheres");
    }
}
