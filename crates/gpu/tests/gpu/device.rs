//! Opening devices, and the pipeline cache.

use osculate_gpu::{
    ComputePipelineDesc, Device, DeviceDesc, DeviceError, GraphicsPipeline, Recording, Submission, devices,
};

use crate::harness::{open, shader, with_device};

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

#[test]
fn the_pipeline_cache_is_saved_and_loaded() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipelines");
    with_device(|device| {
        assert!(!device.load_pipeline_cache(&path).unwrap(), "there is no file yet");
        let shader = shader(device, "nothing.comp", "void main() {}");
        let desc = ComputePipelineDesc { name: "nothing", shader: &shader, specialization: &[] };
        device.compute_pipeline(&desc).unwrap();
        device.save_pipeline_cache(&path).unwrap();
        assert!(device.load_pipeline_cache(&path).unwrap());
        device.compute_pipeline(&desc).unwrap();
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 1, "no temporary file is left");
        std::fs::write(&path, b"damaged").unwrap();
        assert!(!device.load_pipeline_cache(&path).unwrap());
        let error = device.save_pipeline_cache(&folder.path().join("no/such/folder")).unwrap_err();
        assert!(error.to_string().contains("no/such/folder"), "{error}");
    });
}
