//! The joints: a chain along the loft, and limbs on both sides.

use glam::DVec3;

use super::super::super::skin::Joint;
use super::super::body::middle;
use super::super::half::reflect;

/// Joints along the loft: name, parent, and the row of the loft that it turns about.
const SPINE: [(&str, &str, f64); 12] = [
    ("hips", "", 21.0),
    ("back", "hips", 18.3),
    ("chest", "back", 16.0),
    ("neck1", "chest", 13.4),
    ("neck2", "neck1", 11.5),
    ("head", "neck2", 9.8),
    ("tail1", "hips", 22.3),
    ("tail2", "tail1", 24.3),
    ("tail3", "tail2", 26.4),
    ("tail4", "tail3", 28.6),
    ("tail5", "tail4", 30.6),
    ("tail6", "tail5", 32.4),
];

/// Joints of the side where x is positive, which is the creature's own left since it faces along z: name, parent (on its side if
/// there is one), and place.
const SIDE: [(&str, &str, [f64; 3]); 12] = [
    ("ear1", "head", [0.38, 1.71, 0.77]),
    ("ear2", "ear1", [0.58, 1.84, 0.68]),
    ("wing1", "chest", [0.27, 1.06, 0.06]),
    ("wing2", "wing1", [0.45, 1.52, -0.28]),
    ("shoulder", "chest", [0.330, 0.62, 0.24]),
    ("elbow", "shoulder", [0.340, 0.36, 0.20]),
    ("wrist", "elbow", [0.340, 0.115, 0.29]),
    ("forefoot", "wrist", [0.340, 0.03, 0.50]),
    ("thigh", "hips", [0.400, 0.62, -0.40]),
    ("knee", "thigh", [0.430, 0.36, -0.28]),
    ("ankle", "knee", [0.430, 0.115, -0.41]),
    ("hind_foot", "ankle", [0.430, 0.03, -0.19]),
];

/// Sides of a joint's name and place.
pub(super) const SIDES: [&str; 2] = ["left", "right"];

/// All joints, parents before children.
pub(super) fn joints() -> Vec<Joint> {
    let mut joints: Vec<Joint> = Vec::new();
    for (name, parent, row) in SPINE {
        let parent = joints.iter().position(|joint| joint.name == parent);
        joints.push(Joint { name: name.into(), parent, place: middle(row) });
    }
    for side in SIDES {
        for (name, parent, place) in SIDE {
            let place = DVec3::from(place);
            let parent = joints
                .iter()
                .position(|joint| joint.name == sided(parent, side) || joint.name == parent)
                .expect("parents stand before their children");
            let place = if side == SIDES[0] { place } else { reflect(place) };
            joints.push(Joint { name: sided(name, side), parent: Some(parent), place });
        }
    }
    joints
}

/// The name of a joint on a side.
pub(super) fn sided(name: &str, side: &str) -> String {
    format!("{name}.{side}")
}

/// The index of the joint of that name.
pub(super) fn find(joints: &[Joint], name: &str) -> usize {
    joints.iter().position(|joint| joint.name == name).unwrap_or_else(|| panic!("no joint {name}"))
}

/// The rows that the joints along the loft turn about: forward from the hips, and back.
pub(super) fn chains() -> [Vec<(&'static str, f64)>; 2] {
    let chain = |names: &[(&'static str, &str, f64)]| names.iter().map(|&(name, _, row)| (name, row)).collect();
    [chain(&SPINE[1..6]), chain(&SPINE[6..])]
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;

    #[test]
    fn sides_mirror_each_other() {
        let joints = joints();
        for joint in &joints {
            let (Some(name), Some(parent)) = (joint.name.strip_suffix(".left"), joint.parent) else { continue };
            let other = &joints[find(&joints, &sided(name, "right"))];
            assert_eq!(other.place, joint.place * dvec3(-1.0, 1.0, 1.0), "{name}");
            let other_parent = &joints[other.parent.expect("a parent")].name;
            assert_eq!(other_parent.replace(".right", ".left"), joints[parent].name);
        }
    }
}
