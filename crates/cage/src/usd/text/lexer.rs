//! The tokens of the text form.

use std::ops::Range;

use crate::text::quoted;
use crate::usd::UsdError;

/// A token, with its bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Token<'a> {
    /// A keyword, a type or a name, with its namespaces (`primvars:st:indices`) and parts (`points.timeSamples`).
    Word(&'a [u8]),
    /// What starts like a number.
    Number(&'a [u8]),
    /// What is between the quotes of a string.
    Text(&'a [u8]),
    /// What is between the `@` of a reference to a file.
    Asset(&'a [u8]),
    /// What is between `<` and `>`.
    Path(&'a [u8]),
    /// A character that stands for itself.
    Sign(u8),
    /// There is nothing more.
    End,
}

impl Token<'_> {
    /// The token for a message.
    fn named(self) -> String {
        match self {
            Self::Word(text) | Self::Number(text) => format!("`{}`", quoted(text)),
            Self::Text(text) => format!("the text {:?}", quoted(text)),
            Self::Asset(text) => format!("@{}@", quoted(text)),
            Self::Path(text) => format!("<{}>", quoted(text)),
            Self::Sign(sign) => format!("`{}`", sign.escape_ascii()),
            Self::End => "the end of the file".into(),
        }
    }
}

/// Splits a text into tokens; white space and comments lie between them.
#[derive(Clone)]
pub(super) struct Lexer<'a> {
    text: &'a [u8],
    at: usize,
    /// Where the last token started.
    start: usize,
}

impl<'a> Lexer<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        let at = if text.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        Self { text, at, start: at }
    }

    /// How many bytes are left.
    pub(super) fn left(&self) -> usize {
        self.text.len() - self.at
    }

    /// The error that something else was due than the token that was read last.
    pub(super) fn expected(&self, what: &'static str, found: Token<'_>) -> UsdError {
        self.error(format!("expected {what}, not {}", found.named()))
    }

    /// An error at the token that was read last.
    pub(super) fn error(&self, problem: String) -> UsdError {
        let before = &self.text[..self.start.min(self.text.len())];
        let line = 1 + before.iter().filter(|&&b| b == b'\n').count();
        UsdError::Syntax { line: u32::try_from(line).unwrap_or(u32::MAX), problem }
    }

    /// The next token, which stays the next.
    pub(super) fn peek(&self) -> Result<Token<'a>, UsdError> {
        self.clone().next()
    }

    /// Reads `sign` if it comes next.
    pub(super) fn take(&mut self, sign: u8) -> Result<bool, UsdError> {
        let found = self.peek()? == Token::Sign(sign);
        if found {
            self.next()?;
        }
        Ok(found)
    }

    /// Reads `sign`, which must come next; `what` names it.
    pub(super) fn require(&mut self, sign: u8, what: &'static str) -> Result<(), UsdError> {
        match self.next()? {
            Token::Sign(found) if found == sign => Ok(()),
            other => Err(self.expected(what, other)),
        }
    }

    /// Reads the next token.
    pub(super) fn next(&mut self) -> Result<Token<'a>, UsdError> {
        self.skip_space();
        self.start = self.at;
        let Some(&first) = self.text.get(self.at) else { return Ok(Token::End) };
        match first {
            b'"' | b'\'' => self.string(first).map(Token::Text),
            b'@' => {
                let marks: &[u8] = if self.text[self.at..].starts_with(b"@@@") { b"@@@" } else { b"@" };
                self.enclosed(marks, marks, "@").map(Token::Asset)
            }
            b'<' => self.enclosed(b"<", b">", ">").map(Token::Path),
            b'0'..=b'9' | b'+' | b'-' | b'.' => Ok(Token::Number(self.run(is_in_number))),
            _ if is_in_word(first) && !matches!(first, b':' | b'|') => Ok(Token::Word(self.run(is_in_word))),
            sign => {
                self.at += 1;
                Ok(Token::Sign(sign))
            }
        }
    }

    /// Passes over a value of any type and returns where it lies.
    pub(super) fn skip_value(&mut self) -> Result<Range<usize>, UsdError> {
        let first = self.next()?;
        let start = self.start;
        match first {
            Token::Sign(open @ (b'[' | b'(' | b'{')) => self.skip_to_end_of(open)?,
            Token::Sign(_) | Token::End => return Err(self.expected("a value", first)),
            // A prim in another file.
            Token::Asset(_) if matches!(self.peek()?, Token::Path(_)) => {
                self.next()?;
            }
            _ => {}
        }
        Ok(start..self.at)
    }

    /// Passes over everything up to the bracket that closes `open`, which has been read.
    pub(super) fn skip_to_end_of(&mut self, open: u8) -> Result<(), UsdError> {
        let start = self.start;
        let mut closing = vec![closing_of(open)];
        while let Some(&due) = closing.last() {
            match self.next()? {
                Token::Sign(open @ (b'[' | b'(' | b'{')) => closing.push(closing_of(open)),
                Token::Sign(found) if found == due => {
                    closing.pop();
                }
                found @ Token::Sign(b']' | b')' | b'}') => {
                    let problem = format!("expected `{}`, not {}", due.escape_ascii(), found.named());
                    return Err(self.error(problem));
                }
                Token::End => {
                    self.start = start;
                    return Err(self.error(format!("`{}` is not closed", open.escape_ascii())));
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn skip_space(&mut self) {
        while let Some(&byte) = self.text.get(self.at) {
            match byte {
                b' ' | b'\t' | b'\r' | b'\n' => self.at += 1,
                b'#' => {
                    let rest = &self.text[self.at..];
                    self.at += rest.iter().position(|&b| matches!(b, b'\n' | b'\r')).unwrap_or(rest.len());
                }
                _ => break,
            }
        }
    }

    fn run(&mut self, belongs: impl Fn(u8) -> bool) -> &'a [u8] {
        let rest = &self.text[self.at..];
        let length = rest.iter().position(|&b| !belongs(b)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    fn enclosed(&mut self, open: &[u8], close: &[u8], what: &str) -> Result<&'a [u8], UsdError> {
        let rest = &self.text[self.at + open.len()..];
        let Some(length) = rest.windows(close.len()).position(|end| end == close) else {
            return Err(self.error(format!("a closing {what} is missing")));
        };
        self.at += open.len() + length + close.len();
        Ok(&rest[..length])
    }

    /// A string in one or three quotes, in which a backslash keeps the next character from ending it.
    fn string(&mut self, quote: u8) -> Result<&'a [u8], UsdError> {
        let rest = &self.text[self.at..];
        let marks = if rest.starts_with(&[quote; 3]) { 3 } else { 1 };
        let mut end = marks;
        while !rest.get(end..end + marks).is_some_and(|close| close.iter().all(|&b| b == quote)) {
            let step = match rest.get(end) {
                Some(b'\\') => 2,
                Some(b'\n') if marks == 1 => return Err(self.error("a string is not closed in its line".into())),
                Some(_) => 1,
                None => return Err(self.error("a string is not closed".into())),
            };
            end += step;
        }
        self.at += end + marks;
        Ok(&rest[marks..end])
    }
}

fn closing_of(open: u8) -> u8 {
    match open {
        b'[' => b']',
        b'(' => b')',
        _ => b'}',
    }
}

fn is_in_number(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'+' | b'-' | b'.')
}

/// Names may hold letters of any language.
fn is_in_word(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b':' | b'.' | b'|') || byte >= 0x80
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tokens(text: &str) -> Vec<String> {
        let mut lexer = Lexer::new(text.as_bytes());
        let mut found = Vec::new();
        loop {
            match lexer.next().expect("tokens") {
                Token::End => return found,
                token => found.push(token.named()),
            }
        }
    }

    #[test]
    fn tokens_of_all_kinds() {
        let text = "def Mesh \"a\\\"b\" ( # comment ]\n x:y.z = -1.5e-3, @a b@ @@@c@d@@@ </e/f> ; '''it's'''\n)";
        let expected = [
            "`def`",
            "`Mesh`",
            "the text \"a\\\\\\\"b\"",
            "`(`",
            "`x:y.z`",
            "`=`",
            "`-1.5e-3`",
            "`,`",
            "@a b@",
            "@c@d@",
            "</e/f>",
            "`;`",
            "the text \"it's\"",
            "`)`",
        ];
        assert_eq!(tokens(text), expected);
    }

    #[test]
    fn values_are_skipped_whole() {
        for text in ["[(1, 2), (\"]\", @)@)]", "{ 0: [1], 1: None, }", "1.5", "None", "@a@</b>", "\"a # b\"", "inf"] {
            let whole = format!("  {text} rest");
            let mut lexer = Lexer::new(whole.as_bytes());
            assert_eq!(lexer.skip_value().expect("a value"), 2..2 + text.len(), "{text}");
            assert_eq!(lexer.next().expect("a token"), Token::Word(b"rest"));
        }
    }

    #[test]
    fn what_is_not_closed_is_named_with_its_line() {
        let message = |text: &str| {
            let error = Lexer::new(text.as_bytes()).skip_value().expect_err("malformed");
            format!("line {}: {error}", error.line().expect("a line"))
        };
        assert_eq!(message("\n[1, (2\n"), "line 2: `[` is not closed");
        assert_eq!(message("[1, (2]\n)"), "line 1: expected `)`, not `]`");
        assert_eq!(message("\n\n\"abc\n\""), "line 3: a string is not closed in its line");
        assert_eq!(message("'''abc\n"), "line 1: a string is not closed");
        assert_eq!(message("'abc\\"), "line 1: a string is not closed");
        assert_eq!(message("@abc"), "line 1: a closing @ is missing");
        assert_eq!(message(""), "line 1: expected a value, not the end of the file");
    }
}
