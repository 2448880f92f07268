//! The event loop: what the window system says goes to the session, and what goes wrong ends it, or starts it again.

use std::sync::Arc;
use std::time::{Duration, Instant};

use osculate::EngineError;
use osculate::gpu::{GpuError, MessageLog};
use winit::application::ApplicationHandler;
use winit::dpi::LogicalSize;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoopProxy};
use winit::window::{Window, WindowId};

use crate::ViewerDesc;
use crate::builder::News;
use crate::error::ViewerError;
use crate::session::{Session, SessionId};
use crate::state::State;

/// A device that is lost again within this time will not come back.
const GIVE_UP: Duration = Duration::from_secs(10);

/// What other threads wake the window with.
pub(crate) enum Wake {
    /// The builder of a session says something.
    News(SessionId, Box<News>),
    /// Shaders have changed, or cannot be compiled.
    #[cfg(feature = "hot-reload")]
    Shaders(Box<Result<osculate::ShaderSet, String>>),
}

/// The program while its window is open.
pub(crate) struct App {
    desc: ViewerDesc,
    wake: EventLoopProxy<Wake>,
    /// What the window is to show, before there is one.
    state: Option<State>,
    session: Option<Session>,
    /// How many sessions were started.
    sessions: SessionId,
    /// When the device was lost.
    lost: Option<Instant>,
    pub(crate) failure: Option<ViewerError>,
    /// What validation says, of all devices that were open.
    pub(crate) logs: Vec<MessageLog>,
}

impl App {
    pub(crate) fn new(desc: ViewerDesc, wake: EventLoopProxy<Wake>, state: State) -> Self {
        Self { desc, wake, state: Some(state), session: None, sessions: 0, lost: None, failure: None, logs: Vec::new() }
    }

    /// Ends the session; what the user has chosen.
    pub(crate) fn close(&mut self) -> Option<State> {
        if let Some(session) = self.session.take() {
            session.save_pipelines();
            self.state = Some(session.state);
        }
        self.state.take()
    }

    fn open(&mut self, event_loop: &ActiveEventLoop) -> Result<(), ViewerError> {
        let Some(state) = self.state.take() else { return Ok(()) };
        let [width, height] = self.desc.size.unwrap_or(state.settings.screen.size);
        let attributes = Window::default_attributes()
            .with_title("osculate")
            .with_inner_size(LogicalSize::new(width, height))
            .with_min_inner_size(LogicalSize::new(320, 240));
        let window = event_loop
            .create_window(attributes)
            .map_err(|error| ViewerError::NoDisplay { reason: error.to_string() })?;
        self.start(Arc::new(window), state)
    }

    fn start(&mut self, window: Arc<Window>, state: State) -> Result<(), ViewerError> {
        self.sessions += 1;
        let session = Session::open(&self.desc, window, (self.sessions, &self.wake), state)?;
        self.logs.push(session.device().message_log());
        session.window.request_redraw();
        self.session = Some(session);
        Ok(())
    }

    /// Goes on after work in the session, or without it.
    fn settle(&mut self, event_loop: &ActiveEventLoop, result: Result<(), ViewerError>) {
        let result = match result {
            Err(error) if is_loss(&error) => self.restart(error),
            result => result,
        };
        if let Err(error) = result {
            self.failure = Some(error);
            event_loop.exit();
        }
        if self.session.as_ref().is_some_and(|session| session.is_done) {
            event_loop.exit();
        }
    }

    /// Opens the device again after it was lost.
    fn restart(&mut self, error: ViewerError) -> Result<(), ViewerError> {
        let now = Instant::now();
        let again = self.lost.replace(now).is_some_and(|last| now.saturating_duration_since(last) < GIVE_UP);
        let Some(session) = self.session.take().filter(|_| !again) else { return Err(error) };
        let window = Arc::clone(&session.window);
        self.desc.lose_device = None;
        let Session { state, .. } = session;
        let mut state = state.forget_device();
        state.status.error(format!("{error}; it was opened again"));
        self.start(window, state)
    }
}

/// Whether the device was lost.
fn is_loss(error: &ViewerError) -> bool {
    matches!(
        error,
        ViewerError::Gpu(GpuError::DeviceLost { .. })
            | ViewerError::Engine(EngineError::Gpu(GpuError::DeviceLost { .. }))
    )
}

impl ApplicationHandler<Wake> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        if self.session.is_none() {
            let result = self.open(event_loop);
            self.settle(event_loop, result);
        }
    }

    fn user_event(&mut self, event_loop: &ActiveEventLoop, wake: Wake) {
        let Some(session) = &mut self.session else { return };
        let result = match wake {
            // What was built on a device that is lost is of no use.
            Wake::News(from, _) if from != session.id => Ok(()),
            Wake::News(_, news) => session.on_news(*news),
            #[cfg(feature = "hot-reload")]
            Wake::Shaders(shaders) => {
                session.on_shaders(*shaders);
                Ok(())
            }
        };
        self.settle(event_loop, result);
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(session) = &mut self.session else { return };
        match event {
            WindowEvent::CloseRequested => event_loop.exit(),
            WindowEvent::RedrawRequested => {
                let result = session.frame();
                self.settle(event_loop, result);
            }
            event => session.on_event(&event),
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let now = Instant::now();
        event_loop.set_control_flow(match self.session.as_ref().and_then(|session| session.due(now)) {
            Some(due) if due > now => ControlFlow::WaitUntil(due),
            Some(_) => {
                self.session.iter().for_each(|session| session.window.request_redraw());
                ControlFlow::Wait
            }
            None => ControlFlow::Wait,
        });
    }
}
