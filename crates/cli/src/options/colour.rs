//! The background of a picture.

use std::str::FromStr;

/// An sRGB colour with alpha, 8 bits each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Colour([u8; 4]);

impl Colour {
    /// The channels from 0 to 1 as they are.
    pub(crate) fn plain(self) -> [f32; 4] {
        self.0.map(|channel| f32::from(channel) / 255.0)
    }

    /// Linear light from 0 to 1, by the transfer function of sRGB (IEC 61966-2-1); alpha is linear already.
    pub(crate) fn linear(self) -> [f32; 4] {
        let [r, g, b, alpha] = self.plain();
        let decode = |c: f32| if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) };
        [decode(r), decode(g), decode(b), alpha]
    }
}

impl FromStr for Colour {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "transparent" => return Ok(Self([0; 4])),
            "black" => return Ok(Self([0, 0, 0, 255])),
            "white" => return Ok(Self([255; 4])),
            _ => {}
        }
        hexadecimal(text.strip_prefix('#').unwrap_or(text))
            .map(Self)
            .ok_or_else(|| "expected #RRGGBB, #RRGGBBAA, black, white or transparent".into())
    }
}

fn hexadecimal(digits: &str) -> Option<[u8; 4]> {
    let value = |digits| u32::from_str_radix(digits, 16).ok();
    if !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
        return None;
    }
    match digits.len() {
        6 => Some((value(digits)? << 8 | 0xff).to_be_bytes()),
        8 => Some(value(digits)?.to_be_bytes()),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_light_keeps_the_ends_and_darkens_the_middle() {
        assert_eq!(Colour([0, 255, 0, 128]).linear(), [0.0, 1.0, 0.0, 128.0 / 255.0]);
        let middle = Colour([188, 188, 188, 255]).linear()[0];
        assert!((middle - 0.5).abs() < 0.005, "{middle}");
    }

    #[test]
    fn colours() {
        assert_eq!("#102030".parse(), Ok(Colour([16, 32, 48, 255])));
        assert_eq!("10203040".parse(), Ok(Colour([16, 32, 48, 64])));
        assert_eq!("transparent".parse(), Ok(Colour([0; 4])));
        for wrong in ["", "#", "#123", "#12345g", "+12345", "#1234567", "reddish", "#ééé"] {
            assert!(wrong.parse::<Colour>().is_err(), "{wrong}");
        }
    }
}
