//! What keys do. One table says it to the program and to its help.

use serde::{Deserialize, Serialize};

/// What can be asked for by a key, or by a button that does the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub(crate) enum Action {
    /// Shows or hides the list of keys.
    Help,
    /// Shows or hides the panels.
    Panels,
    /// Shows or hides the figures over the picture.
    Figures,
    /// Chooses a file.
    Open,
    /// The next model.
    Next,
    /// The model before.
    Previous,
    /// Reads the file again.
    Reload,
    /// Moves the eye so that all is seen.
    Fit,
    /// Circles or flies.
    Fly,
    /// Prints the camera and copies it.
    Camera,
    /// The next scheme.
    Scheme,
    /// The next evaluator.
    Evaluator,
    /// One scheme, two side by side, or one wiped over the other.
    Compare,
    /// A level.
    Level(u8),
    /// Finer.
    Finer,
    /// Coarser.
    Coarser,
    /// The same level for all edges, or edges of equal length in the picture.
    Adaptive,
    /// Leaves out patches of which nothing is seen.
    Culling,
    /// The next spacing.
    Spacing,
    /// Freezes the camera that adaptive factors are chosen for.
    Freeze,
    /// Edges of triangles.
    Wireframe,
    /// The next shade.
    Shade,
    /// The shade before.
    PreviousShade,
    /// Edges of the cage.
    Cage,
    /// Vertices of the cage.
    Points,
    /// Normals of the surface.
    Normals,
    /// A background and back faces that show every hole.
    Leaks,
    /// Plays or stops the animation.
    Play,
    /// Puts moved vertices back.
    Restore,
    /// Writes the picture to a file.
    Screenshot,
    /// Writes the whole window to a file.
    WindowScreenshot,
    /// All of the screen.
    FullScreen,
    /// Reads the shaders again.
    #[cfg(feature = "hot-reload")]
    Shaders,
    /// Ends the program.
    Quit,
}

/// A key, by what it writes or what it is called.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Key {
    /// A character, small letters.
    Character(&'static str),
    /// A key that writes nothing.
    Named(&'static str),
}

/// A key with what it does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeyBinding {
    pub(crate) key: Key,
    /// Whether the shift key is held; characters that need it on some keyboards and not on others go either way.
    pub(crate) shift: Option<bool>,
    pub(crate) action: Action,
    /// Words for the help; empty where another line says it.
    pub(crate) help: &'static str,
}

const fn character(key: &'static str, action: Action, help: &'static str) -> KeyBinding {
    KeyBinding { key: Key::Character(key), shift: Some(false), action, help }
}

const fn shifted(key: &'static str, action: Action, help: &'static str) -> KeyBinding {
    KeyBinding { key: Key::Character(key), shift: Some(true), action, help }
}

const fn symbol(key: &'static str, action: Action, help: &'static str) -> KeyBinding {
    KeyBinding { key: Key::Character(key), shift: None, action, help }
}

const fn named(key: &'static str, action: Action, help: &'static str) -> KeyBinding {
    KeyBinding { key: Key::Named(key), shift: None, action, help }
}

/// A group of the help.
pub(crate) struct Group {
    pub(crate) title: &'static str,
    pub(crate) bindings: &'static [KeyBinding],
}

/// All keys, as the help shows them.
pub(crate) const GROUPS: &[Group] = &[
    Group {
        title: "Models",
        bindings: &[
            character("o", Action::Open, "open a file"),
            character("n", Action::Next, "next model"),
            character("p", Action::Previous, "previous model"),
            named("F5", Action::Reload, "read the file again"),
            character("x", Action::Screenshot, "write the picture to a PNG file"),
            shifted("x", Action::WindowScreenshot, "write the whole window"),
        ],
    },
    Group {
        title: "Surface",
        bindings: &[
            character("s", Action::Scheme, "next scheme"),
            character("e", Action::Evaluator, "next evaluator"),
            character("d", Action::Compare, "two schemes: side by side, wipe, off"),
            character("m", Action::Play, "play or stop the animation"),
            named("Space", Action::Play, ""),
            named("Backspace", Action::Restore, "put moved vertices back"),
        ],
    },
    Group {
        title: "Tessellation",
        bindings: &[
            character("1", Action::Level(1), "levels 1 to 9"),
            character("2", Action::Level(2), ""),
            character("3", Action::Level(3), ""),
            character("4", Action::Level(4), ""),
            character("5", Action::Level(5), ""),
            character("6", Action::Level(6), ""),
            character("7", Action::Level(7), ""),
            character("8", Action::Level(8), ""),
            character("9", Action::Level(9), ""),
            symbol("+", Action::Finer, "finer"),
            symbol("=", Action::Finer, ""),
            symbol("-", Action::Coarser, "coarser"),
            character("v", Action::Adaptive, "by length in the picture"),
            character("t", Action::Spacing, "next spacing"),
            character("b", Action::Culling, "leave out backs, and patches out of sight"),
            symbol("/", Action::Freeze, "freeze the tessellation's camera"),
        ],
    },
    Group {
        title: "Shading",
        bindings: &[
            character("c", Action::Shade, "next shade"),
            shifted("c", Action::PreviousShade, "previous shade"),
            character("w", Action::Wireframe, "edges of triangles"),
            character("h", Action::Cage, "edges of the cage"),
            character("k", Action::Points, "vertices of the cage"),
            character("j", Action::Normals, "normals of the surface"),
            character("l", Action::Leaks, "leak detector"),
        ],
    },
    Group {
        title: "View",
        bindings: &[
            character("f", Action::Fit, "show all"),
            character("g", Action::Fly, "fly, or circle again"),
            character("y", Action::Camera, "print and copy the camera"),
            named("Tab", Action::FullScreen, "full screen"),
            named("F1", Action::Help, "these keys"),
            named("F2", Action::Panels, "panels"),
            named("F3", Action::Figures, "figures"),
            #[cfg(feature = "hot-reload")]
            character("r", Action::Shaders, "read shaders again"),
            character("q", Action::Quit, "quit"),
            named("Escape", Action::Quit, ""),
        ],
    },
];

/// What the mouse does, for the help.
pub(crate) const MOUSE: &[(&str, &str)] = &[
    ("left drag", "circle; move a vertex under the pointer"),
    ("middle drag", "move sideways (also Shift + left)"),
    ("wheel, right drag", "closer, further"),
    ("click", "say what is there"),
    ("W A S D Q E", "move while flying"),
];

/// What a key does.
pub(crate) fn action(key: &winit::keyboard::Key, shift: bool) -> Option<Action> {
    let text;
    let (named, name) = match key {
        winit::keyboard::Key::Character(character) => {
            text = character.to_lowercase();
            (false, text.as_str())
        }
        winit::keyboard::Key::Named(name) => {
            text = format!("{name:?}");
            (true, text.as_str())
        }
        _ => return None,
    };
    let fits = |binding: &&KeyBinding| {
        let same = match binding.key {
            Key::Character(wanted) => !named && wanted == name,
            Key::Named(wanted) => named && wanted == name,
        };
        same && binding.shift.is_none_or(|wanted| wanted == shift)
    };
    GROUPS.iter().flat_map(|group| group.bindings).find(fits).map(|binding| binding.action)
}

impl KeyBinding {
    /// The key as the help writes it.
    pub(crate) fn label(&self) -> String {
        match self.key {
            Key::Character(key) if self.shift == Some(true) => format!("Shift {}", key.to_uppercase()),
            Key::Character("1") => "1 .. 9".to_owned(),
            Key::Character(key) => key.to_uppercase(),
            Key::Named("Escape") => "Esc".to_owned(),
            Key::Named(key) => key.to_owned(),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use winit::keyboard::{Key as Pressed, NamedKey};

    use super::*;

    fn press(text: &str, shift: bool) -> Option<Action> {
        action(&Pressed::Character(text.into()), shift)
    }

    #[test]
    fn keys_do_one_thing() {
        let mut seen = HashSet::new();
        for binding in GROUPS.iter().flat_map(|group| group.bindings) {
            for shift in [false, true].into_iter().filter(|&shift| binding.shift.is_none_or(|wanted| wanted == shift)) {
                assert!(seen.insert((format!("{:?}", binding.key), shift)), "{} is bound twice", binding.label());
            }
        }
    }

    #[test]
    fn keys_are_found() {
        assert_eq!(press("f", false), Some(Action::Fit));
        assert_eq!((press("c", false), press("C", true)), (Some(Action::Shade), Some(Action::PreviousShade)));
        assert_eq!(
            (press("7", false), press("+", true), press("+", false)),
            (Some(Action::Level(7)), Some(Action::Finer), Some(Action::Finer))
        );
        assert_eq!(action(&Pressed::Named(NamedKey::F1), false), Some(Action::Help));
        assert_eq!(action(&Pressed::Named(NamedKey::Escape), false), Some(Action::Quit));
        assert_eq!(action(&Pressed::Named(NamedKey::Space), true), Some(Action::Play));
        assert_eq!((press("ö", false), press("F1", false)), (None, None));
    }

    #[test]
    fn every_action_is_in_the_help() {
        let bindings = || GROUPS.iter().flat_map(|group| group.bindings);
        for binding in bindings() {
            let told = |other: &KeyBinding| {
                !other.help.is_empty()
                    && (other.action == binding.action
                        || matches!((other.action, binding.action), (Action::Level(_), Action::Level(_))))
            };
            assert!(bindings().any(told), "nothing says what {} does", binding.label());
        }
    }
}
