//! Values of the text form.

use super::lexer::{Lexer, Token};
use crate::usd::UsdError;

/// The numbers of a value: a number, a tuple of `size` numbers however nested, or an array of these.
pub(in crate::usd) fn numbers(text: &[u8], size: usize) -> Result<Vec<f64>, UsdError> {
    let mut lexer = Lexer::new(text);
    let mut found = Vec::new();
    if !lexer.take(b'[')? {
        element(&mut lexer, size, &mut found)?;
        return Ok(found);
    }
    while !lexer.take(b']')? {
        element(&mut lexer, size, &mut found)?;
        if !lexer.take(b',')? {
            lexer.require(b']', "`,` or `]`")?;
            break;
        }
    }
    Ok(found)
}

/// One number, or a tuple that holds `size` of them.
fn element(lexer: &mut Lexer, size: usize, found: &mut Vec<f64>) -> Result<(), UsdError> {
    let before = found.len();
    let mut depth = 0_usize;
    loop {
        match lexer.next()? {
            Token::Sign(b'(') => depth += 1,
            Token::Sign(b')') if depth > 0 => depth -= 1,
            Token::Sign(b',') if depth > 0 => {}
            token @ (Token::Number(word) | Token::Word(word)) => {
                found.push(number(word).ok_or_else(|| lexer.expected("a number", token))?);
            }
            other => return Err(lexer.expected("a number or `(`", other)),
        }
        if depth == 0 {
            break;
        }
    }
    match found.len() - before {
        count if count == size => Ok(()),
        count => Err(lexer.error(format!("a tuple of {count} numbers where {size} are due"))),
    }
}

fn number(word: &[u8]) -> Option<f64> {
    match word {
        b"true" => Some(1.0),
        b"false" => Some(0.0),
        word => crate::text::float(word),
    }
}

/// The texts or paths of a value: one of them, or an array.
pub(in crate::usd) fn words(text: &[u8]) -> Result<Vec<String>, UsdError> {
    let mut lexer = Lexer::new(text);
    let mut found = Vec::new();
    let listed = lexer.take(b'[')?;
    loop {
        match lexer.next()? {
            Token::Text(word) | Token::Path(word) => found.push(String::from_utf8_lossy(word).into_owned()),
            Token::Sign(b']') if listed => return Ok(found),
            Token::Sign(b',') if listed => {}
            other => return Err(lexer.expected("a text or a path", other)),
        }
        if !listed {
            return Ok(found);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_all_shapes() {
        let read = |text: &str, size| numbers(text.as_bytes(), size).expect("numbers");
        assert_eq!(read("1.5", 1), [1.5]);
        assert_eq!(read("[]", 3), [0.0; 0]);
        assert_eq!(read("[1, -2, +3e2,]", 1), [1.0, -2.0, 300.0]);
        assert_eq!(read("(1, 2, 3)", 3), [1.0, 2.0, 3.0]);
        assert_eq!(read("[(1, 2), (3, 4)]", 2), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(read("( (1, 2), (3, 4) )", 4), [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(read("[inf, -inf, true]", 1), [f64::INFINITY, f64::NEG_INFINITY, 1.0]);
    }

    #[test]
    fn malformed_numbers() {
        let message = |text: &str, size| {
            let error = numbers(text.as_bytes(), size).expect_err("malformed");
            format!("line {}: {error}", error.line().expect("a line"))
        };
        assert_eq!(message("[1, x]", 1), "line 1: expected a number, not `x`");
        assert_eq!(message("[1\n2]", 1), "line 2: expected `,` or `]`, not `2`");
        assert_eq!(message("[(1, 2)]", 3), "line 1: a tuple of 2 numbers where 3 are due");
        assert_eq!(message("[(1, 2]", 2), "line 1: expected a number or `(`, not `]`");
        assert_eq!(message("[\"a\"]", 1), "line 1: expected a number or `(`, not the text \"a\"");
    }

    #[test]
    fn words_and_paths() {
        let read = |text: &str| words(text.as_bytes()).expect("words");
        assert_eq!(read("\"a\""), ["a"]);
        assert_eq!(read("[\"a\", 'b']"), ["a", "b"]);
        assert_eq!(read("</a/b>"), ["/a/b"]);
        assert!(words(b"[1]").is_err());
    }
}
