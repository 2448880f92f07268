//! Presentation, to windows of an X server of our own: what the server shows is what was drawn.

use std::sync::Arc;

use osculate_gpu::{
    Acquired, Bindings, BufferUsage, ColorTarget, Device, DeviceDesc, Draw, Format, Frame, GpuError,
    GraphicsPipelineDesc, Image, PresentMode, Presented, Presenter, PresenterDesc, Recording, RenderPass, WindowSystem,
};

use crate::{
    harness::{open, shader},
    xvfb::{Server, Window},
};

const RED: [f32; 4] = [1.0, 0.0, 0.0, 1.0];
const GREEN: [f32; 4] = [0.0, 1.0, 0.0, 1.0];
const SHOWN_RED: [u8; 3] = [0, 0, 255];
const SHOWN_GREEN: [u8; 3] = [0, 255, 0];
const SIZE: [u32; 2] = [120, 80];

/// Runs a test with a window and its presenter, validation on; everything is gone in order at the end, without a message.
fn with_window(test: impl FnOnce(&Device, &Window, &mut Presenter)) {
    let server = Server::start();
    let window = Window::open(&server, SIZE.map(|one| one as u16));
    let device = Device::new(&DeviceDesc {
        select: std::env::var("OSCULATE_DEVICE").ok(),
        validation: true,
        application: "osculate-gpu tests".to_owned(),
        windows: Some(WindowSystem::of(&*window).unwrap()),
        ..DeviceDesc::default()
    })
    .unwrap();
    let log = device.message_log();
    let desc = PresenterDesc { size: SIZE, ..PresenterDesc::default() };
    let mut presenter = device.presenter(Arc::clone(&window), &desc).unwrap();
    test(&device, &window, &mut presenter);
    // Both may go in any order: the presenter keeps the device.
    drop(device);
    drop(presenter);
    assert_eq!(Arc::strong_count(&window), 1, "the presenter is gone, but something keeps its window");
    assert!(log.all().is_empty(), "validation messages:\n{}", log.all().join("\n"));
}

fn frame(presenter: &mut Presenter) -> Frame {
    match presenter.acquire().unwrap() {
        Acquired::Frame(frame) => frame,
        other => panic!("{other:?}"),
    }
}

fn clear(image: &Image, color: [f32; 4]) -> RenderPass {
    RenderPass {
        name: "clear".to_owned(),
        color: Some(ColorTarget { image: image.clone(), clear: Some(color), resolve: None }),
        depth: None,
        viewport: image.size().into(),
        area: None,
        draws: vec![],
    }
}

/// Fills a frame and shows it.
fn show(device: &Device, presenter: &mut Presenter, color: [f32; 4]) -> Presented {
    let frame = frame(presenter);
    let mut recording = Recording::new();
    recording.render(clear(frame.image(), color));
    let submission = device.submit(&recording).unwrap();
    let presented = presenter.present(frame).unwrap();
    submission.wait().unwrap();
    presented
}

#[test]
fn windows_show_frame_after_frame() {
    with_window(|device, window, presenter| {
        assert!(presenter.modes().contains(&PresentMode::Fifo), "{:?}", presenter.modes());
        // More frames than there are images and slots, without waiting for any.
        for _ in 0..10 {
            assert_eq!(show(device, presenter, RED), Presented::Shown);
            assert_eq!(show(device, presenter, GREEN), Presented::Shown);
        }
        window.expect([100, 60], SHOWN_GREEN);
        assert_eq!(show(device, presenter, RED), Presented::Shown);
        window.expect([1, 1], SHOWN_RED);
        assert_eq!(presenter.size(), SIZE);
    });
}

#[test]
fn draws_into_a_frame_are_shown_and_can_be_read() {
    with_window(|device, window, presenter| {
        let vertex = shader(
            device,
            "left.vert",
            "void main() { gl_Position = vec4(gl_VertexIndex == 0 ? -9 : 0, gl_VertexIndex == 1 ? -9 : 9, 0, 1); }",
        );
        let fragment =
            shader(device, "green.frag", "layout(location = 0) out vec4 c; void main() { c = vec4(0, 1, 0, 1); }");
        let desc = GraphicsPipelineDesc::new("left", &vertex);
        let color_format = Some(presenter.format());
        let desc = GraphicsPipelineDesc { fragment: Some(&fragment), color_format, ..desc };
        let pipeline = device.graphics_pipeline(&desc).unwrap();
        let draw = Draw {
            pipeline,
            bindings: Bindings::new(),
            push: vec![],
            vertices: (0..3).into(),
            instances: 0..1,
            attributes: None,
            scissor: None,
        };
        let frame = frame(presenter);
        let texels =
            device.upload("texels", BufferUsage::empty(), &vec![0u8; frame.image().byte_size() as usize]).unwrap();
        let mut recording = Recording::new();
        recording.render(RenderPass { draws: vec![draw], ..clear(frame.image(), RED) });
        recording.copy_image_to_buffer(frame.image(), &texels);
        device.run(&recording).unwrap();
        assert_eq!(presenter.present(frame).unwrap(), Presented::Shown);
        window.expect([30, 40], SHOWN_GREEN);
        window.expect([90, 40], SHOWN_RED);
        let texels: Vec<[u8; 4]> = device.download(&texels, ..).unwrap();
        assert!([Format::Bgra8Srgb, Format::Bgra8Unorm].contains(&presenter.format()), "{:?}", presenter.format());
        assert_eq!((texels[40 * 120 + 30], texels[40 * 120 + 90]), ([0, 255, 0, 255], [0, 0, 255, 255]));
    });
}

#[test]
fn frames_follow_the_windows_size() {
    with_window(|device, window, presenter| {
        let _ = show(device, presenter, RED);
        for size in [[200, 150], [64, 48]] {
            window.resize(size);
            presenter.resize(size);
            assert_eq!(show(device, presenter, GREEN), Presented::Shown);
            assert_eq!(presenter.size(), size);
            let corner = size.map(|one| one as i16 - 1);
            window.expect(corner, SHOWN_GREEN);
            let _ = show(device, presenter, RED);
            window.expect(corner, SHOWN_RED);
        }
        // Without a word from us the presenter may notice or not, but it must not fail, and it ends with the right size.
        window.resize(SIZE);
        for _ in 0..5 {
            if let Acquired::Frame(frame) = presenter.acquire().unwrap() {
                let _ = presenter.present(frame).unwrap();
            }
        }
        presenter.resize(SIZE);
        let _ = show(device, presenter, GREEN);
        window.expect([119, 79], SHOWN_GREEN);
        assert_eq!(presenter.size(), SIZE);
    });
}

#[test]
fn a_window_without_pixels_has_no_frames() {
    with_window(|device, window, presenter| {
        presenter.resize([0, 0]);
        assert!(matches!(presenter.acquire().unwrap(), Acquired::Hidden));
        presenter.resize(SIZE);
        let _ = show(device, presenter, RED);
        presenter.resize([0, 80]);
        assert!(matches!(presenter.acquire().unwrap(), Acquired::Hidden));
        presenter.resize(SIZE);
        let _ = show(device, presenter, GREEN);
        window.expect([60, 40], SHOWN_GREEN);
    });
}

#[test]
fn out_of_date_windows_are_told_and_got_over() {
    with_window(|device, window, presenter| {
        // At the first acquire, at one between frames, and at a present.
        presenter.force_out_of_date();
        assert!(matches!(presenter.acquire().unwrap(), Acquired::OutOfDate));
        assert_eq!(show(device, presenter, RED), Presented::Shown);
        presenter.force_out_of_date();
        assert!(matches!(presenter.acquire().unwrap(), Acquired::OutOfDate));
        assert_eq!(show(device, presenter, GREEN), Presented::Shown);
        window.expect([60, 40], SHOWN_GREEN);
        let frame = frame(presenter);
        presenter.force_out_of_date();
        assert_eq!(presenter.present(frame).unwrap(), Presented::OutOfDate);
        assert_eq!(show(device, presenter, RED), Presented::Shown);
        window.expect([60, 40], SHOWN_RED);
    });
}

#[test]
fn modes_change_between_frames() {
    with_window(|device, window, presenter| {
        for mode in [PresentMode::Immediate, PresentMode::Mailbox, PresentMode::Fifo] {
            presenter.set_mode(mode);
            let expected = if presenter.modes().contains(&mode) { mode } else { PresentMode::Fifo };
            assert_eq!(presenter.mode(), expected);
            for color in [RED, GREEN, RED, GREEN] {
                assert_eq!(show(device, presenter, color), Presented::Shown);
            }
            window.expect([60, 40], SHOWN_GREEN);
        }
    });
}

#[test]
fn frames_that_are_not_presented_are_handed_out_again() {
    with_window(|device, window, presenter| {
        let first = frame(presenter);
        let image = first.image().clone();
        drop(first);
        assert_eq!(frame(presenter).image(), &image);
        // One that was acquired, but not drawn to, may be replaced; it then leads nowhere.
        let forgotten = frame(presenter);
        window.resize([64, 48]);
        presenter.resize([64, 48]);
        let next = frame(presenter);
        assert_ne!(next.image(), &image);
        assert_eq!(presenter.present(forgotten).unwrap(), Presented::OutOfDate);
        let mut recording = Recording::new();
        recording.render(clear(next.image(), GREEN));
        device.run(&recording).unwrap();
        assert_eq!(presenter.present(next).unwrap(), Presented::Shown);
        window.expect([60, 40], SHOWN_GREEN);
        // An image that nobody drew to can be presented; what it shows is undefined.
        let blank = frame(presenter);
        let _ = presenter.present(blank).unwrap();
    });
}

#[test]
fn images_of_windows_are_used_only_between_acquire_and_present() {
    with_window(|device, _, presenter| {
        let frame = frame(presenter);
        let image = frame.image().clone();
        let mut recording = Recording::new();
        recording.render(clear(&image, RED));
        let mut prepared = device.prepare(&recording).unwrap();
        prepared.run().unwrap();
        let _ = presenter.present(frame).unwrap();
        assert!(matches!(device.submit(&recording), Err(GpuError::NotAcquired { .. })));
        assert!(matches!(prepared.submit(), Err(GpuError::NotAcquired { .. })));
        // When its turn comes again, the prepared recording is good again.
        loop {
            let next = self::frame(presenter);
            let found = *next.image() == image;
            if found {
                prepared.run().unwrap();
            }
            let _ = presenter.present(next).unwrap();
            if found {
                break;
            }
        }
        // The image outlives its window's frames, to no use.
        presenter.resize([64, 48]);
        let _ = presenter.acquire().unwrap();
        assert!(matches!(device.submit(&recording), Err(GpuError::NotAcquired { .. })));
    });
}

#[test]
fn devices_opened_without_windows_have_no_presenters() {
    let server = Server::start();
    let window = Window::open(&server, [10, 10]);
    let error = open(true).presenter(window, &PresenterDesc::default()).unwrap_err().to_string();
    assert!(error.contains("\"window\"") && error.contains("DeviceDesc::windows"), "{error}");
}
