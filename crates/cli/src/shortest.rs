//! Numbers as text.

use std::fmt::{self, Display, LowerExp};

/// A number in the fewest characters that read back as the same number: with an exponent if that is shorter, and without
/// the sign of zero.
pub(crate) struct Shortest<T>(pub(crate) T);

impl<T: Copy + Display + LowerExp + Into<f64>> Display for Shortest<T> {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = self.0;
        let size = number.into().abs();
        if size == 0.0 {
            return out.write_str("0");
        }
        // Between these, writing the digits out is never much longer.
        if (1e-3..1e6).contains(&size) {
            return write!(out, "{number}");
        }
        let (plain, exponent) = (number.to_string(), format!("{number:e}"));
        out.write_str(if exponent.len() < plain.len() { &exponent } else { &plain })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shorter_form_is_written() {
        let cases = [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (-0.25, "-0.25"),
            (0.1, "0.1"),
            (1e300, "1e300"),
            (-1.5e-20, "-1.5e-20"),
            (123_456_789.5, "123456789.5"),
        ];
        for (number, text) in cases {
            assert_eq!(Shortest(number).to_string(), text);
            assert_eq!(text.parse(), Ok(number));
        }
        assert_eq!(Shortest(0.1_f32).to_string(), "0.1");
        assert_eq!(Shortest(1e-30_f32).to_string(), "1e-30");
    }
}
