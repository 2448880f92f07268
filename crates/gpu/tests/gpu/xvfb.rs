//! An X server of our own, without a screen, and windows in it.

use std::{
    io::{BufRead, BufReader},
    num::NonZeroU32,
    process::{Child, Command, Stdio},
    ptr::NonNull,
    sync::Arc,
    time::{Duration, Instant},
};

use osculate_gpu::raw_window_handle::{
    DisplayHandle, HandleError, HasDisplayHandle, HasWindowHandle, RawDisplayHandle, RawWindowHandle, WindowHandle,
    XcbDisplayHandle, XcbWindowHandle,
};
use x11rb::{
    connection::Connection,
    protocol::xproto::{ConfigureWindowAux, ConnectionExt, CreateWindowAux, ImageFormat, WindowClass},
    xcb_ffi::XCBConnection,
};

/// A running server; killed on drop.
pub(crate) struct Server {
    process: Child,
    display: String,
}

impl Server {
    /// Starts a server under a number that it chooses itself.
    pub(crate) fn start() -> Self {
        let arguments = ["-displayfd", "1", "-screen", "0", "400x300x24", "-nolisten", "tcp", "-noreset"];
        let mut process = Command::new("Xvfb")
            .args(arguments)
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap_or_else(|error| panic!("tests of windows need Xvfb (tools/setup.sh --tests installs it): {error}"));
        let mut number = String::new();
        BufReader::new(process.stdout.take().unwrap()).read_line(&mut number).unwrap();
        let number = number.trim();
        assert!(!number.is_empty(), "Xvfb did not start");
        Self { display: format!(":{number}"), process }
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// A window on a connection of its own.
pub(crate) struct Window {
    id: u32,
    screen: i32,
    connection: XCBConnection,
}

impl Window {
    pub(crate) fn open(server: &Server, [width, height]: [u16; 2]) -> Arc<Self> {
        let name = std::ffi::CString::new(server.display.as_str()).unwrap();
        let (connection, screen) = XCBConnection::connect(Some(&name)).unwrap();
        let root = &connection.setup().roots[screen];
        let id = connection.generate_id().unwrap();
        let (depth, class, visual) = (root.root_depth, WindowClass::INPUT_OUTPUT, root.root_visual);
        connection
            .create_window(depth, id, root.root, 0, 0, width, height, 0, class, visual, &CreateWindowAux::new())
            .unwrap()
            .check()
            .unwrap();
        connection.map_window(id).unwrap().check().unwrap();
        Arc::new(Self { id, screen: screen as i32, connection })
    }

    pub(crate) fn resize(&self, [width, height]: [u32; 2]) {
        let change = ConfigureWindowAux::new().width(width).height(height);
        self.connection.configure_window(self.id, &change).unwrap().check().unwrap();
    }

    /// Blue, green and red of a pixel, as the server shows it.
    fn pixel(&self, x: i16, y: i16) -> [u8; 3] {
        let image = self.connection.get_image(ImageFormat::Z_PIXMAP, self.id, x, y, 1, 1, u32::MAX);
        let data = image.unwrap().reply().unwrap().data;
        [data[0], data[1], data[2]]
    }

    /// Waits until a pixel shows a colour: presentation takes its time.
    pub(crate) fn expect(&self, at: [i16; 2], bgr: [u8; 3]) {
        let begin = Instant::now();
        while self.pixel(at[0], at[1]) != bgr {
            assert!(
                begin.elapsed() < Duration::from_secs(20),
                "{at:?} shows {:?}, not {bgr:?}",
                self.pixel(at[0], at[1])
            );
            std::thread::sleep(Duration::from_millis(2));
        }
    }
}

impl HasDisplayHandle for Window {
    fn display_handle(&self) -> Result<DisplayHandle<'_>, HandleError> {
        let connection = NonNull::new(self.connection.get_raw_xcb_connection()).ok_or(HandleError::Unavailable)?;
        let raw = XcbDisplayHandle::new(Some(connection.cast()), self.screen);
        // SAFETY: the connection lives as long as self.
        Ok(unsafe { DisplayHandle::borrow_raw(RawDisplayHandle::Xcb(raw)) })
    }
}

impl HasWindowHandle for Window {
    fn window_handle(&self) -> Result<WindowHandle<'_>, HandleError> {
        let raw = XcbWindowHandle::new(NonZeroU32::new(self.id).ok_or(HandleError::Unavailable)?);
        // SAFETY: the window lives as long as its connection, and that as long as self.
        Ok(unsafe { WindowHandle::borrow_raw(RawWindowHandle::Xcb(raw)) })
    }
}
