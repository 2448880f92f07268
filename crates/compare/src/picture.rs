//! RGBA8 pictures, read and written as PNG.

use crate::whole_file;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder, ImageError, ImageFormat, ImageReader};
use std::fmt;
use std::fs::File;
use std::io::{self, BufReader};
use std::path::{Path, PathBuf};

/// The largest picture that is compared, in pixels. FLIP keeps some hundred bytes per pixel.
pub const MAX_PIXELS: u64 = 1 << 26;

/// Why pictures could not be read, compared or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompareError {
    /// The file could not be opened or read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file is not a PNG picture, or a damaged one.
    #[error("{}: not a readable PNG picture: {source}", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// What the decoder said.
        source: ImageError,
    },
    /// The file could not be written.
    #[error("{}: cannot write the picture: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system or the encoder said.
        source: ImageError,
    },
    /// The two pictures differ in size, so no pixel has a counterpart.
    #[error("the pictures differ in size: {a} and {b}")]
    SizesDiffer {
        /// Size of the first picture.
        a: Size,
        /// Size of the second picture.
        b: Size,
    },
    /// The number of bytes is not four per pixel, or a side is zero.
    #[error("a picture of {size} does not have {bytes} bytes; 4 per pixel and at least one pixel are expected")]
    WrongByteCount {
        /// Size that was asked for.
        size: Size,
        /// Bytes that were given.
        bytes: usize,
    },
    /// The picture has more than [`MAX_PIXELS`] pixels.
    #[error("a picture of {0} is too large to compare; at most {MAX_PIXELS} pixels are")]
    TooLarge(Size),
}

/// Width and height of a picture in pixels, written `WxH`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Pixels in a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
}

impl Size {
    /// Number of pixels.
    #[must_use]
    pub fn pixels(self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }
}

impl fmt::Display for Size {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "{}x{}", self.width, self.height)
    }
}

/// A picture of at least one pixel: rows from the top, RGBA, 8 bits each, sRGB colours, alpha not premultiplied.
#[derive(Clone, PartialEq, Eq)]
pub struct Picture {
    size: Size,
    rgba: Vec<u8>,
}

impl fmt::Debug for Picture {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(out, "Picture({})", self.size)
    }
}

impl Picture {
    /// A picture from its bytes.
    ///
    /// # Errors
    ///
    /// [`CompareError::WrongByteCount`] unless there are `4 * width * height > 0` bytes.
    pub fn new(width: u32, height: u32, rgba: Vec<u8>) -> Result<Self, CompareError> {
        let size = Size { width, height };
        if rgba.is_empty() || size.pixels().checked_mul(4) != Some(rgba.len() as u64) {
            return Err(CompareError::WrongByteCount { size, bytes: rgba.len() });
        }
        Ok(Self { size, rgba })
    }

    /// Width and height in pixels.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }

    /// The bytes, four per pixel, rows from the top.
    #[must_use]
    pub fn rgba(&self) -> &[u8] {
        &self.rgba
    }

    /// The pixels in the order of the bytes.
    pub fn pixels(&self) -> impl ExactSizeIterator<Item = [u8; 4]> + '_ {
        self.rgba.as_chunks::<4>().0.iter().copied()
    }

    /// Whether no pixel lets the background through.
    #[must_use]
    pub fn is_opaque(&self) -> bool {
        self.pixels().all(|pixel| pixel[3] == u8::MAX)
    }

    /// Writes the picture as a PNG file, whole or not at all; without an alpha channel if it is opaque.
    ///
    /// # Errors
    ///
    /// [`CompareError::Write`] naming the file.
    pub fn write(&self, path: &Path) -> Result<(), CompareError> {
        let png = self.to_png();
        let written = png.and_then(|png| whole_file::write(path, |out| Ok(out.write_all(&png)?)));
        written.map_err(|source| CompareError::Write { path: path.to_owned(), source })
    }

    /// The bytes of the picture as a PNG file, as small as the encoder makes them.
    pub(crate) fn to_png(&self) -> Result<Vec<u8>, ImageError> {
        let mut png = Vec::new();
        let encoder = PngEncoder::new_with_quality(&mut png, CompressionType::Best, FilterType::Adaptive);
        let Size { width, height } = self.size;
        if self.is_opaque() {
            let rgb: Vec<u8> = self.pixels().flat_map(|[r, g, b, _]| [r, g, b]).collect();
            encoder.write_image(&rgb, width, height, ExtendedColorType::Rgb8)?;
        } else {
            encoder.write_image(&self.rgba, width, height, ExtendedColorType::Rgba8)?;
        }
        Ok(png)
    }
}

/// Reads a PNG file of any bit depth and colour type as RGBA8.
///
/// # Errors
///
/// [`CompareError::Read`] or [`CompareError::Decode`] naming the file.
pub fn load(path: &Path) -> Result<Picture, CompareError> {
    let read_error = |source| CompareError::Read { path: path.to_owned(), source };
    let file = File::open(path).map_err(read_error)?;
    if file.metadata().map_err(read_error)?.is_dir() {
        return Err(read_error(io::Error::from(io::ErrorKind::IsADirectory)));
    }
    let decoded = ImageReader::with_format(BufReader::new(file), ImageFormat::Png)
        .decode()
        .map_err(|source| CompareError::Decode { path: path.to_owned(), source })?
        .into_rgba8();
    Picture::new(decoded.width(), decoded.height(), decoded.into_raw())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gradient(alpha: impl Fn(u32) -> u8) -> Picture {
        let pixel = |i: u32| [(i * 7) as u8, (i * 3) as u8, i as u8, alpha(i)];
        Picture::new(16, 4, (0..64).flat_map(pixel).collect()).unwrap()
    }

    #[test]
    fn png_round_trips_with_and_without_alpha() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        for picture in [gradient(|_| 255), gradient(|i| (i * 4) as u8)] {
            picture.write(&path).unwrap();
            assert_eq!(load(&path).unwrap(), picture);
        }
    }

    #[test]
    fn errors_name_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let missing = folder.path().join("missing.png");
        assert!(load(&missing).unwrap_err().to_string().contains("missing.png"));
        let text = folder.path().join("text.png");
        std::fs::write(&text, "not a picture").unwrap();
        assert!(load(&text).unwrap_err().to_string().contains("text.png: not a readable PNG"));
        assert!(load(folder.path()).is_err());
        let nowhere = folder.path().join("no/where.png");
        assert!(gradient(|_| 255).write(&nowhere).unwrap_err().to_string().contains("where.png"));
    }

    #[test]
    fn byte_counts_are_checked() {
        assert!(Picture::new(2, 2, vec![0; 15]).is_err());
        assert!(Picture::new(0, 2, vec![]).is_err());
        assert!(Picture::new(u32::MAX, u32::MAX, vec![0; 4]).is_err());
    }
}
