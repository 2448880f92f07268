//! `view`, in windows of an X server of our own: what is pressed and clicked shows in the log, in screenshots, in settings.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::time::{Duration, Instant};

use crate::support::{Ran, command, osculate};

/// Longer than anything takes on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

const CUBE: &str = "\
v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
";

/// A running X server without a screen; killed on drop.
struct Server {
    process: Child,
    display: String,
}

impl Server {
    fn start() -> Self {
        let arguments = ["-displayfd", "1", "-screen", "0", "1000x700x24", "-nolisten", "tcp", "-noreset"];
        let mut process = Command::new("Xvfb")
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("tests of windows need Xvfb (tools/setup.sh --tests installs it): {error}"));
        let mut number = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut number).unwrap();
        assert!(!number.trim().is_empty(), "Xvfb did not start");
        Self { display: format!(":{}", number.trim()), process }
    }

    /// Lets xdotool work; what it prints.
    fn xdotool(&self, arguments: &[&str]) -> String {
        let output =
            Command::new("xdotool").args(arguments).env("DISPLAY", &self.display).output().unwrap_or_else(|error| {
                panic!("tests of windows need xdotool (tools/setup.sh --tests installs it): {error}")
            });
        assert!(output.status.success(), "xdotool {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap().trim().to_owned()
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// A running viewer; killed on drop unless it has ended.
struct Viewer {
    server: Server,
    process: Child,
    lines: Receiver<String>,
    folder: PathBuf,
    /// What it has said so far.
    log: Vec<String>,
    window: String,
}

impl Viewer {
    /// Opens models of a folder under validation, and waits until the first one is shown.
    fn open(folder: &Path, arguments: &[&str]) -> Self {
        let server = Server::start();
        let arguments: Vec<&str> = ["view", "-v", "--size", "800x560"].iter().chain(arguments).copied().collect();
        let mut process = command(folder, &arguments)
            .env("DISPLAY", &server.display)
            .env_remove("WAYLAND_DISPLAY")
            .env("OSCULATE_SETTINGS", folder.join("viewer.json"))
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let (sender, lines) = channel();
        let streams: [Box<dyn std::io::Read + Send>; 2] =
            [Box::new(process.stdout.take().unwrap()), Box::new(process.stderr.take().unwrap())];
        for stream in streams {
            let sender = sender.clone();
            std::thread::spawn(move || {
                BufReader::new(stream).lines().map_while(Result::ok).for_each(|line| {
                    let _test_is_over = sender.send(line);
                });
            });
        }
        let mut viewer =
            Self { server, process, lines, folder: folder.to_owned(), log: Vec::new(), window: String::new() };
        viewer.expect(", level ");
        viewer.window = viewer.server.xdotool(&["search", "--sync", "--onlyvisible", "--name", "osculate"]);
        viewer.server.xdotool(&["windowfocus", "--sync", &viewer.window]);
        viewer
    }

    /// Waits for a line that holds `part`; the line.
    #[track_caller]
    fn expect(&mut self, part: &str) -> String {
        let begin = Instant::now();
        loop {
            match self.lines.recv_timeout(PATIENCE.saturating_sub(begin.elapsed())) {
                Ok(line) => {
                    self.log.push(line.clone());
                    if line.contains(part) {
                        return line;
                    }
                }
                Err(RecvTimeoutError::Timeout) => panic!("no {part:?} in time in {:#?}", self.log),
                Err(RecvTimeoutError::Disconnected) => panic!("ended without {part:?}: {:#?}", self.log),
            }
        }
    }

    /// Presses a key.
    fn press(&self, key: &str) {
        self.server.xdotool(&["key", key]);
    }

    /// Presses a key, and waits for what is said.
    #[track_caller]
    fn press_for(&mut self, key: &str, part: &str) -> String {
        self.press(key);
        self.expect(part)
    }

    /// Moves the pointer to a place in the window, and lets xdotool go on.
    fn mouse(&self, x: i32, y: i32, then: &[&str]) {
        let place = [x.to_string(), y.to_string()];
        let first = ["mousemove", "--window", &self.window, &place[0], &place[1]];
        self.server.xdotool(&first.iter().chain(then).copied().collect::<Vec<_>>());
    }

    /// Drags from one place to another, slowly enough for every step to have a frame of its own.
    #[track_caller]
    fn drag(&mut self, from: [i32; 2], to: [i32; 2]) {
        let middle = [0, 1].map(|axis| (from[axis] + to[axis]) / 2);
        for (place, button) in
            [(from, None), (from, Some("mousedown")), (middle, None), (to, None), (to, Some("mouseup"))]
        {
            let button = button.map(|button| [button, "1"]);
            self.mouse(place[0], place[1], button.as_ref().map_or(&[], |button| button.as_slice()));
            self.screenshot("x");
        }
    }

    /// Writes a screenshot of the picture or of the whole window.
    #[track_caller]
    fn screenshot(&mut self, key: &str) -> Picture {
        let line = self.press_for(key, "written: ");
        let file = self.folder.join(line.split_once("written: ").unwrap().1);
        Picture { rgba: image::open(&file).unwrap().into_rgba8(), file }
    }

    /// Waits for the end; its exit code must be 0 and nothing else was an error than `errors` lines.
    #[track_caller]
    fn ends_with(mut self, errors: usize) {
        let begin = Instant::now();
        let status = loop {
            if let Some(status) = self.process.try_wait().unwrap() {
                break status;
            }
            assert!(begin.elapsed() < PATIENCE, "does not end: {:#?}", self.log);
            std::thread::sleep(Duration::from_millis(5));
        };
        let rest: Vec<String> = self.lines.iter().collect();
        self.log.extend(rest);
        assert_eq!(status.code(), Some(0), "{:#?}", self.log);
        let found = self.log.iter().filter(|line| line.starts_with("error")).count();
        assert_eq!(found, errors, "{:#?}", self.log);
    }
}

impl Drop for Viewer {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

struct Picture {
    rgba: image::RgbaImage,
    file: PathBuf,
}

impl Picture {
    /// How many pixels are not of the colour in the upper left corner.
    fn drawn(&self) -> usize {
        let background = self.rgba.get_pixel(0, 0);
        self.rgba.pixels().filter(|pixel| *pixel != background).count()
    }
}

fn folder_with(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    files.iter().for_each(|(name, text)| std::fs::write(folder.path().join(name), text).unwrap());
    folder
}

#[test]
fn keys_change_what_is_shown() {
    let folder = folder_with(&[("cube.obj", CUBE), ("other.obj", CUBE), ("bad.obj", "v 0 0 0\nf 1 2 3\n")]);
    let mut viewer = Viewer::open(
        folder.path(),
        &["cube.obj", "other.obj", "bad.obj", "--shade", "zebra", "--force-out-of-date", "5"],
    );
    assert!(viewer.log.iter().any(|line| line.contains("cube.obj: gregory2, zebra, level 8")), "{:?}", viewer.log);
    let zebra = viewer.screenshot("x");
    viewer.press_for("s", "cube.obj: stam, zebra, level 8");
    viewer.press_for("c", "cube.obj: stam, reflection, level 8");
    viewer.press_for("3", "cube.obj: stam, reflection, level 3");
    viewer.press_for("plus", "cube.obj: stam, reflection, level 4");
    viewer.press_for("d", "cube.obj: stam and stam, reflection");
    viewer.press_for("e", "cube.obj: stam and stam, reflection");
    let split = viewer.screenshot("x");
    assert_eq!(zebra.rgba.dimensions(), split.rgba.dimensions());
    assert!(zebra.drawn() > 10_000 && split.drawn() > 10_000 && zebra.rgba != split.rgba);
    viewer.press_for("n", "other.obj: stam and stam, reflection");
    // A bad file leaves what is shown.
    viewer.press_for("n", "bad.obj:2:");
    assert!(viewer.screenshot("x").file.ends_with("other-001.png"));
    viewer.press_for("y", "--camera ");
    viewer.press("q");
    viewer.ends_with(1);
    let settings = std::fs::read_to_string(folder.path().join("viewer.json")).unwrap();
    assert!(settings.contains("\"scheme\": \"stam\"") && settings.contains("\"shade\": \"reflection\""), "{settings}");
}

#[test]
fn the_mouse_turns_picks_and_moves_vertices() {
    let folder = folder_with(&[("cube.obj", CUBE)]);
    let camera = "0,0,8:0,0,0:0,1,0:45";
    let mut viewer = Viewer::open(folder.path(), &["cube.obj", "--cage", "--camera", camera, "--lose-device", "3"]);
    if !viewer.log.iter().any(|line| line.contains("opened again")) {
        viewer.expect("opened again");
    }
    viewer.press_for("c", "cube.obj: gregory2, patches");
    // Without panels the picture is the window.
    viewer.press("F2");
    let before = viewer.screenshot("x");
    assert_eq!(before.rgba.dimensions(), (800, 560));
    // In the middle is the middle of the face towards the eye.
    viewer.mouse(400, 280, &["click", "1"]);
    let picked = viewer.expect("face 1 sub -1 s 0.5");
    assert!(picked.contains("t 0.5") || picked.contains("t 0.49"), "{picked}");
    // The vertex (1,1,1) is at a distance of 7, where a unit is 97 pixels long.
    viewer.drag([400 + 97, 280 - 97], [600, 60]);
    let pulled = viewer.screenshot("x");
    assert!(pulled.drawn() > before.drawn() + 1000, "{} and {}", before.drawn(), pulled.drawn());
    viewer.press("BackSpace");
    assert_eq!(viewer.screenshot("x").rgba, before.rgba, "vertices are back");
    // Turned, it looks different; the camera says so.
    viewer.drag([100, 100], [300, 200]);
    assert!(!viewer.press_for("y", "--camera ").contains(" 0,0,8:"));
    // The picture follows the window.
    viewer.server.xdotool(&["windowsize", "--sync", &viewer.window, "600", "400"]);
    assert_eq!(viewer.screenshot("shift+x").rgba.dimensions(), (600, 400));
    viewer.press("F1");
    viewer.press("Escape");
    viewer.press("Escape");
    viewer.ends_with(1);
}

#[test]
fn frames_of_numbered_files_play() {
    let tall = CUBE.replace(" 1 1\n", " 1 9\n");
    let folder = folder_with(&[("f_1.obj", CUBE), ("f_2.obj", CUBE), ("f_3.obj", &tall), ("f_4.obj", &tall)]);
    let mut viewer = Viewer::open(folder.path(), &["f_%d.obj"]);
    let first = viewer.screenshot("x");
    viewer.press("space");
    let begin = Instant::now();
    while viewer.screenshot("x").rgba == first.rgba {
        assert!(begin.elapsed() < PATIENCE, "nothing moves");
    }
    viewer.press("BackSpace");
    while viewer.screenshot("x").rgba != first.rgba {
        assert!(begin.elapsed() < PATIENCE, "the vertices do not come back");
    }
    // A frame that is gone ends the playing, not the window.
    std::fs::remove_file(folder.path().join("f_3.obj")).unwrap();
    viewer.press_for("space", "f_3.obj");
    viewer.press("q");
    viewer.ends_with(1);
}

#[test]
fn without_a_display_there_is_an_error() {
    let folder = folder_with(&[("cube.obj", CUBE)]);
    for display in [None, Some(":65000")] {
        let mut command = command(folder.path(), &["view", "cube.obj"]);
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY").env_remove("WAYLAND_SOCKET");
        command.envs(display.map(|display| ("DISPLAY", display)));
        Ran::new(&["view"], command.output().unwrap()).fails(4, "no window can be opened here");
    }
}

#[test]
fn wrong_arguments_are_refused_before_there_is_a_window() {
    let folder = folder_with(&[("cube.obj", CUBE)]);
    osculate(folder.path(), &["view", "missing.obj"]).fails(3, "missing.obj");
    osculate(folder.path(), &["view", "cube.obj", "--camera", "1,2,3"]).fails(2, "EYE:AT:UP:FOVY");
    osculate(folder.path(), &["view", "cube.obj", "--scheme", "table"]).fails(2, "table");
    osculate(folder.path(), &["view", "cube.obj", "--level", "65"]).fails(2, "1 to 64");
}
