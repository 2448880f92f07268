//! The choice of a device.

use crate::{DeviceError, DeviceInfo};

/// Picks a device: by number, by a part of its name (upper and lower case alike), or else the best kind that can be opened.
/// Among several devices that match a name the best kind wins, then the first in order.
pub(crate) fn choose(devices: &[DeviceInfo], wanted: Option<&str>) -> Result<usize, DeviceError> {
    if devices.is_empty() {
        return Err(DeviceError::NoDevice);
    }
    let wanted = wanted.map(str::trim).filter(|wanted| !wanted.is_empty());
    let matching = devices.iter().enumerate().filter(|(_, device)| wanted.is_none_or(|wanted| matches(device, wanted)));
    let best = matching.min_by_key(|(position, device)| (!device.missing.is_empty(), device.kind, *position));
    let Some((position, device)) = best else {
        let available = devices.iter().map(|device| format!("{}: {}", device.index, device.name)).collect();
        return Err(DeviceError::NoMatch { wanted: wanted.unwrap_or_default().to_owned(), available });
    };
    match device.missing.first() {
        None => Ok(position),
        Some(feature) => Err(DeviceError::MissingFeature { device: device.name.clone(), feature: feature.clone() }),
    }
}

/// Whether `wanted` is the device's number or a part of its name.
fn matches(device: &DeviceInfo, wanted: &str) -> bool {
    match wanted.parse::<usize>() {
        Ok(index) => device.index == index,
        Err(_) => device.name.to_lowercase().contains(&wanted.to_lowercase()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DeviceKind, Features, Limits};

    fn device(index: usize, name: &str, kind: DeviceKind, missing: &[&str]) -> DeviceInfo {
        DeviceInfo {
            index,
            name: name.to_owned(),
            kind,
            driver_name: String::new(),
            driver_info: String::new(),
            api_version: String::new(),
            is_llvmpipe: false,
            limits: Limits::default(),
            features: Features::default(),
            missing: missing.iter().map(|&one| one.to_owned()).collect(),
        }
    }

    fn zoo() -> Vec<DeviceInfo> {
        vec![
            device(0, "llvmpipe (LLVM 15)", DeviceKind::Cpu, &[]),
            device(1, "Iris", DeviceKind::Integrated, &[]),
            device(2, "Old Card", DeviceKind::Discrete, &["Vulkan 1.3"]),
        ]
    }

    #[test]
    fn the_default_is_the_best_kind_that_can_be_opened() {
        assert_eq!(choose(&zoo(), None).unwrap(), 1);
        assert_eq!(choose(&zoo()[..1], None).unwrap(), 0);
    }

    #[test]
    fn a_device_is_found_by_number_and_by_part_of_its_name() {
        assert_eq!(choose(&zoo(), Some("0")).unwrap(), 0);
        assert_eq!(choose(&zoo(), Some("LLVMPipe")).unwrap(), 0);
        assert_eq!(choose(&zoo(), Some(" iris ")).unwrap(), 1);
    }

    #[test]
    fn an_empty_selection_is_none() {
        assert_eq!(choose(&zoo(), Some("")).unwrap(), 1);
    }

    #[test]
    fn errors_name_what_there_is() {
        assert!(matches!(choose(&[], None), Err(DeviceError::NoDevice)));
        let error = choose(&zoo(), Some("radeon")).unwrap_err().to_string();
        assert!(error.contains("\"radeon\"") && error.contains("1: Iris"), "{error}");
        assert!(matches!(choose(&zoo(), Some("7")), Err(DeviceError::NoMatch { .. })));
        let error = choose(&zoo(), Some("old")).unwrap_err().to_string();
        assert!(error.contains("Old Card") && error.contains("Vulkan 1.3"), "{error}");
    }
}
