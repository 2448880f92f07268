//! Opening devices, and the pipeline cache.

use osculate_gpu::{
    ComputePipelineDesc, Device, DeviceDesc, DeviceError, Features, GpuError, GraphicsPipeline, Recording, Shader,
    Submission, devices,
};

use crate::harness::{open, shader, spirv, with_device};

#[test]
fn the_open_device_is_one_of_the_list() {
    let list = devices().unwrap();
    with_device(|device| {
        let info = device.info();
        let same = &list[info.index];
        assert_eq!((&same.name, same.kind, same.features), (&info.name, info.kind, info.features));
        assert!(info.missing.is_empty());
        assert_eq!(info.is_llvmpipe, info.name.contains("llvmpipe"));
        assert!(info.limits.sample_counts.contains(&1) && info.limits.max_patch_vertices >= 32);
        assert!(info.limits.max_tessellation_level >= 64 && info.limits.max_push_constants >= 128);
    });
}

#[test]
fn a_device_is_chosen_by_number_and_by_name() {
    let name = open(false).info().name.clone();
    for select in [name.to_uppercase(), open(false).info().index.to_string()] {
        let device = Device::new(&DeviceDesc { select: Some(select), ..DeviceDesc::default() }).unwrap();
        assert_eq!(device.info().name, name);
    }
}

#[test]
fn an_unknown_device_is_refused_with_the_list() {
    let select = Some("no such device".to_owned());
    match Device::new(&DeviceDesc { select, ..DeviceDesc::default() }).unwrap_err() {
        DeviceError::NoMatch { wanted, available } => {
            assert_eq!(wanted, "no such device");
            assert_eq!(available.len(), devices().unwrap().len());
        }
        error => panic!("{error}"),
    }
}

#[test]
fn without_validation_there_are_no_messages() {
    let device = open(false);
    device.run(&Recording::new()).unwrap();
    assert!(device.validation_messages().is_empty());
}

/// What was left off is off for good: limits are 0, and what needs it is refused with its name, before Vulkan hears of it.
#[test]
fn a_device_can_be_opened_with_fewer_features() {
    let select = std::env::var("OSCULATE_DEVICE").ok();
    let desc = DeviceDesc { select, validation: true, without: Features::ALL, ..DeviceDesc::default() };
    let device = Device::new(&desc).unwrap();
    let log = device.message_log();
    let info = device.info();
    assert_eq!(info.features, Features::default());
    let limits = &info.limits;
    assert_eq!([limits.max_patch_vertices, limits.max_tessellation_level, limits.max_capture_stride], [0; 3]);
    for (name, needs, source) in [
        ("control.tesc", "tessellationShader", "layout(vertices = 1) out; void main() { gl_TessLevelOuter[0] = 1.0; }"),
        ("evaluation.tese", "tessellationShader", "layout(quads) in; void main() { gl_Position = vec4(0.0); }"),
        (
            "capture.vert",
            "VK_EXT_transform_feedback",
            "layout(location = 0, xfb_buffer = 0, xfb_stride = 4, xfb_offset = 0) out float x; void main() { x = 1.0; }",
        ),
    ] {
        let error = device.shader(name, &spirv(name, source)).unwrap_err();
        assert!(matches!(error, GpuError::MissingFeature { .. }), "{error}");
        assert!(error.to_string().contains(needs) && error.to_string().contains(name), "{error}");
    }
    device.run(&Recording::new()).unwrap();
    drop(device);
    assert!(log.all().is_empty(), "{:?}", log.all());
}

#[test]
fn objects_outlive_the_devices_handle() {
    with_device(|_| {
        let device = open(true);
        let log = device.message_log();
        let shader = shader(&device, "nothing.comp", "void main() {}");
        drop(device);
        drop(shader);
        assert!(log.all().is_empty(), "{:?}", log.all());
    });
}

#[test]
fn handles_can_be_sent_between_threads() {
    fn check<T: Send + Sync>() {}
    check::<Device>();
    check::<GraphicsPipeline>();
    check::<Recording>();
    check::<Submission>();
}

/// Makes a pipeline with a constant of its own.
fn make_pipeline(device: &Device, shader: &Shader, number: u32) {
    let desc = ComputePipelineDesc { name: "nothing", shader, specialization: &[(0, number)] };
    device.compute_pipeline(&desc).unwrap();
}

fn nothing(device: &Device) -> Shader {
    shader(device, "nothing.comp", "layout(constant_id = 0) const uint n = 0; void main() {}")
}

#[test]
fn the_pipeline_cache_is_saved_and_loaded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new/folder").join(open(false).pipeline_cache_name());
    with_device(|device| {
        assert!(!device.load_pipeline_cache(&path).unwrap(), "there is no file yet");
        make_pipeline(device, &nothing(device), 1);
        assert!(device.save_pipeline_cache(&path).unwrap());
        assert!(!device.save_pipeline_cache(&path).unwrap(), "there is nothing new to save");
        let files = std::fs::read_dir(path.parent().unwrap()).unwrap();
        assert_eq!(files.count(), 1, "no temporary file is left");
    });
    with_device(|device| {
        make_pipeline(device, &nothing(device), 2);
        assert!(device.load_pipeline_cache(&path).unwrap(), "a new device uses the file, having made pipelines, too");
        make_pipeline(device, &nothing(device), 1);
        device.save_pipeline_cache(&path).unwrap();
        assert!(device.load_pipeline_cache(&path).unwrap());
    });
}

#[test]
fn damaged_pipeline_caches_are_ignored_and_replaced() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipelines");
    with_device(|device| {
        device.save_pipeline_cache(&path).unwrap();
        let whole = std::fs::read(&path).unwrap();
        let mut flipped = whole.clone();
        flipped[40] ^= 0x10;
        for damaged in [&b"damaged"[..], b"", &whole[..whole.len() - 1], &whole[..16], &flipped] {
            std::fs::write(&path, damaged).unwrap();
            assert!(!device.load_pipeline_cache(&path).unwrap(), "{} bytes", damaged.len());
            assert!(device.save_pipeline_cache(&path).unwrap());
            assert_eq!(std::fs::read(&path).unwrap(), whole);
        }
    });
}

#[test]
fn pipeline_caches_that_cannot_be_used_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let (file, inside) = (folder.path().join("file"), folder.path().join("file/pipelines"));
    std::fs::write(&file, "").unwrap();
    with_device(|device| {
        let errors = [
            device.save_pipeline_cache(&inside).unwrap_err(),
            device.load_pipeline_cache(&inside).unwrap_err(),
            device.load_pipeline_cache(folder.path()).unwrap_err(),
        ];
        for error in errors.map(|error| error.to_string()) {
            assert!(error.starts_with("pipeline cache ") && error.contains(folder.path().to_str().unwrap()), "{error}");
        }
    });
}

/// Threads that make, load and save at the same time: every file is whole, and validation has nothing to say of objects that
/// two threads use at once.
#[test]
fn pipelines_are_made_and_kept_by_several_threads() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipelines");
    with_device(|device| {
        let shader = nothing(device);
        device.save_pipeline_cache(&path).unwrap();
        std::thread::scope(|scope| {
            for thread in 0..4 {
                let (path, shader) = (&path, &shader);
                scope.spawn(move || {
                    for round in 0..10 {
                        make_pipeline(device, shader, 10 * thread + round);
                        device.save_pipeline_cache(path).unwrap();
                        assert!(device.load_pipeline_cache(path).unwrap(), "a file is whole at any time");
                    }
                });
            }
        });
    });
}
