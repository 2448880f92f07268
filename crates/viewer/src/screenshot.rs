//! Pictures of the window in files.

use std::path::{Path, PathBuf};

use osculate::gpu::{BufferDesc, BufferUsage, Device, Format, GpuError, Image, Memory, Recording};

/// Reads an image of four bytes a texel: red, green, blue, alpha, as screens want them.
pub(crate) fn read(device: &Device, image: &Image) -> Result<Vec<u8>, GpuError> {
    let size = image.byte_size();
    let (usage, memory) = (BufferUsage::STORAGE, Memory::Readback);
    let buffer = device.buffer(&BufferDesc { name: "screenshot", size, usage, memory })?;
    let mut recording = Recording::new();
    recording.copy_image_to_buffer(image, &buffer);
    device.run(&recording)?;
    let mut texels = buffer.read::<u8>(0..size)?;
    let blue_first = [Format::Bgra8Srgb, Format::Bgra8Unorm].contains(&image.format());
    for texel in texels.chunks_exact_mut(4) {
        if blue_first {
            texel.swap(0, 2);
        }
        texel[3] = u8::MAX;
    }
    Ok(texels)
}

/// Writes a PNG file into `folder` under a name that is free, made of the model's; returns it.
pub(crate) fn write(folder: &Path, model: &str, [width, height]: [u32; 2], rgba: &[u8]) -> Result<PathBuf, String> {
    let file = free_name(folder, model).ok_or_else(|| format!("{}: too many screenshots", folder.display()))?;
    image::save_buffer(&file, rgba, width, height, image::ColorType::Rgba8)
        .map_err(|error| format!("{}: cannot write: {error}", file.display()))?;
    Ok(file)
}

fn free_name(folder: &Path, model: &str) -> Option<PathBuf> {
    let stem = Path::new(model).file_stem().unwrap_or(model.as_ref()).to_string_lossy();
    (1..10_000).map(|number| folder.join(format!("{stem}-{number:03}.png"))).find(|file| !file.exists())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_free() {
        let folder = tempfile::tempdir().unwrap();
        let names = [0, 1].map(|_| {
            let file = write(folder.path(), "some/cube.obj", [1, 2], &[0; 8]).unwrap();
            file.file_name().unwrap().to_string_lossy().into_owned()
        });
        assert_eq!(names, ["cube-001.png", "cube-002.png"]);
        let error = write(&folder.path().join("missing"), "cube", [1, 2], &[0; 8]).unwrap_err();
        assert!(error.contains("cube-001.png: cannot write"), "{error}");
    }
}
