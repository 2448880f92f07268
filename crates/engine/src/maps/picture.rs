//! Pictures that surfaces are mapped with: heights and colours, read from files.

use std::io::Cursor;
use std::path::{Path, PathBuf};

use image::{DynamicImage, ImageError, ImageReader};

/// Why a picture cannot be used as a map.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MapError {
    /// The file cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is no picture, or a damaged one.
    #[error("{name}: not a readable picture (PNG, JPEG or OpenEXR): {source}")]
    Decode {
        /// The file, or what else the bytes are called.
        name: String,
        /// What the decoder said.
        source: ImageError,
    },
    /// A height cannot be computed with.
    #[error("{name}: the height in column {column}, row {row} (from 0) is not finite")]
    NotFinite {
        /// The file, or what else the map is called.
        name: String,
        /// Its column.
        column: usize,
        /// Its row from the top.
        row: usize,
    },
    /// There are not as many texels as the size says, or none.
    #[error("{name}: a map of {} x {} texels does not have {found} values", size[0], size[1])]
    Size {
        /// What the map is called.
        name: String,
        /// Width and height.
        size: [u32; 2],
        /// Values given.
        found: usize,
    },
}

/// Heights of a displacement: rows from the top, 0 to 1 where they come from integers.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    size: [u32; 2],
    heights: Vec<f32>,
}

impl HeightMap {
    /// A map from its heights, rows from the top.
    ///
    /// # Errors
    /// If there are not as many as the size says, or one is not finite.
    pub fn new(name: &str, size: [u32; 2], heights: Vec<f32>) -> Result<Self, MapError> {
        let texels = u64::from(size[0]) * u64::from(size[1]);
        if texels == 0 || texels != heights.len() as u64 {
            return Err(MapError::Size { name: name.to_owned(), size, found: heights.len() });
        }
        if let Some(at) = heights.iter().position(|height| !height.is_finite()) {
            let width = size[0] as usize;
            return Err(MapError::NotFinite { name: name.to_owned(), column: at % width, row: at / width });
        }
        Ok(Self { size, heights })
    }

    /// The red channel of a PNG, JPEG or OpenEXR file, taken as linear.
    ///
    /// # Errors
    /// If it cannot be read, or a height is not finite.
    pub fn read(path: &Path) -> Result<Self, MapError> {
        Self::decode(&path.display().to_string(), &read(path)?)
    }

    /// The same from the bytes of a file.
    ///
    /// # Errors
    /// If they cannot be decoded, or a height is not finite.
    pub fn decode(name: &str, bytes: &[u8]) -> Result<Self, MapError> {
        let image = decode(name, bytes)?.into_rgb32f();
        let size = [image.width(), image.height()];
        let heights = image.into_raw().into_iter().step_by(3).collect();
        Self::new(name, size, heights)
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The heights, rows from the top.
    pub fn heights(&self) -> &[f32] {
        &self.heights
    }

    /// The same map with fewer texels: each the mean of what it covers.
    pub(super) fn shrunk(&self, size: [u32; 2]) -> Self {
        let [columns, rows] = [0, 1].map(|axis| shares(self.size[axis] as usize, size[axis] as usize));
        let width = self.size[0] as usize;
        let mean = |row: &Share, column: &Share| {
            let texels = row.iter().flat_map(|(y, wy)| column.iter().map(move |(x, wx)| (y * width + x, wy * wx)));
            texels.map(|(at, weight)| weight * f64::from(self.heights[at])).sum::<f64>() as f32
        };
        let heights = rows.iter().flat_map(|row| columns.iter().map(move |column| mean(row, column))).collect();
        Self { size, heights }
    }
}

/// Texels, and what each of them counts for.
type Share = Vec<(usize, f64)>;

/// Of `from` texels in a row what each of `to` texels covers.
fn shares(from: usize, to: usize) -> Vec<Share> {
    let ratio = from as f64 / to as f64;
    let share = |i: usize| {
        let (begin, end) = (i as f64 * ratio, (i + 1) as f64 * ratio);
        let covered = |x: usize| (end.min((x + 1) as f64) - begin.max(x as f64)) / ratio;
        let texels = begin.floor() as usize..(end.ceil() as usize).min(from);
        texels.map(|x| (x, covered(x))).filter(|&(_, weight)| weight > 0.0).collect()
    };
    (0..to).map(share).collect()
}

/// Colours: rows from the top, red, green, blue, alpha, encoded as sRGB but for alpha.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ColorMap {
    size: [u32; 2],
    rgba: Vec<[u8; 4]>,
}

impl ColorMap {
    /// A map from its texels, rows from the top.
    ///
    /// # Errors
    /// If there are not as many as the size says.
    pub fn new(name: &str, size: [u32; 2], rgba: Vec<[u8; 4]>) -> Result<Self, MapError> {
        let texels = u64::from(size[0]) * u64::from(size[1]);
        if texels == 0 || texels != rgba.len() as u64 {
            return Err(MapError::Size { name: name.to_owned(), size, found: rgba.len() });
        }
        Ok(Self { size, rgba })
    }

    /// The colours of a PNG or JPEG file.
    ///
    /// # Errors
    /// If it cannot be read.
    pub fn read(path: &Path) -> Result<Self, MapError> {
        Self::decode(&path.display().to_string(), &read(path)?)
    }

    /// The same from the bytes of a file.
    ///
    /// # Errors
    /// If they cannot be decoded.
    pub fn decode(name: &str, bytes: &[u8]) -> Result<Self, MapError> {
        let image = decode(name, bytes)?.into_rgba8();
        let size = [image.width(), image.height()];
        Self::new(name, size, image.into_raw().as_chunks::<4>().0.to_vec())
    }

    /// Width and height in texels.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The texels, rows from the top.
    pub fn rgba(&self) -> &[[u8; 4]] {
        &self.rgba
    }
}

fn read(path: &Path) -> Result<Vec<u8>, MapError> {
    std::fs::read(path).map_err(|source| MapError::Read { path: path.to_owned(), source })
}

/// The format is told by the first bytes, not by the name.
fn decode(name: &str, bytes: &[u8]) -> Result<DynamicImage, MapError> {
    let error = |source| MapError::Decode { name: name.to_owned(), source };
    let reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|io| error(io.into()))?;
    reader.decode().map_err(error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shrinking_keeps_the_mean_whatever_the_sizes() {
        for size in [[8, 4], [7, 5], [3, 1], [1, 6]] {
            let count = size[0] * size[1];
            let map = HeightMap::new("ramp", size, (0..count).map(|i| (i * i) as f32).collect()).unwrap();
            let mean =
                |map: &HeightMap| map.heights.iter().map(|&h| f64::from(h)).sum::<f64>() / map.heights.len() as f64;
            let small = map.shrunk(size.map(|n| (n / 2).max(1)));
            assert!((mean(&small) - mean(&map)).abs() < 1e-5 * mean(&map), "{size:?}");
        }
        let map = HeightMap::new("row", [3, 1], vec![0.0, 3.0, 9.0]).unwrap();
        assert_eq!(map.shrunk([1, 1]).heights, [4.0]);
        assert_eq!(HeightMap::new("row", [4, 1], vec![0.0, 2.0, 4.0, 8.0]).unwrap().shrunk([2, 1]).heights, [1.0, 6.0]);
    }

    fn encoded(image: DynamicImage, format: image::ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn integers_become_parts_of_one_and_floats_stay() {
        use image::{ImageBuffer, ImageFormat, Luma, Rgb};
        let bits8 = DynamicImage::ImageLuma8(ImageBuffer::from_fn(2, 1, |x, _| Luma([[51u8, 255][x as usize]])));
        let bits16 =
            DynamicImage::ImageLuma16(ImageBuffer::from_fn(2, 1, |x, _| Luma([[13107u16, 65535][x as usize]])));
        for image in [bits8, bits16] {
            let heights = HeightMap::decode("map", &encoded(image, ImageFormat::Png)).unwrap().heights;
            assert!((heights[0] - 0.2).abs() < 1e-6 && heights[1] == 1.0, "{heights:?}");
        }
        let float = ImageBuffer::from_fn(2, 1, |x, _| Rgb([[-2.5f32, 1000.0][x as usize], 9.0, 9.0]));
        let exr = encoded(DynamicImage::ImageRgb32F(float), ImageFormat::OpenExr);
        assert_eq!(HeightMap::decode("map", &exr).unwrap().heights, [-2.5, 1000.0]);
    }

    #[test]
    fn what_is_no_map_is_refused_by_name() {
        let error = HeightMap::decode("x.png", b"no picture").unwrap_err();
        assert!(error.to_string().starts_with("x.png: not a readable picture"), "{error}");
        let error = HeightMap::new("x", [2, 2], vec![0.0, 0.0, f32::NAN, 0.0]).unwrap_err();
        assert!(error.to_string().contains("column 0, row 1"), "{error}");
        assert!(HeightMap::new("x", [2, 2], vec![0.0; 3]).is_err());
        assert!(ColorMap::new("x", [0, 2], Vec::new()).is_err());
        assert!(matches!(ColorMap::read("no/such.png".as_ref()), Err(MapError::Read { .. })));
    }
}
