//! From the text to prims. Values are passed over: only where they lie is kept.

use std::ops::Range;

use super::lexer::{Lexer, Token};
use crate::limits::Gauge;
use crate::usd::UsdError;
use crate::usd::layer::{self, Layer, Sample, Specifier};
use crate::usd::values::Value;

/// Reads the structure of a text.
pub(in crate::usd) fn parse(text: &[u8], gauge: &mut Gauge) -> Result<Layer, UsdError> {
    check_version(text)?;
    let mut parser = Parser { text, lexer: Lexer::new(text), layer: Layer::default(), gauge };
    parser.layer_metadata()?;
    parser.prims()?;
    Ok(parser.layer)
}

/// Checks the version after `#usda`: forms with another first number may mean anything by the same words.
fn check_version(text: &[u8]) -> Result<(), UsdError> {
    let text = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text);
    let first = text.split(|byte| matches!(byte, b'\n' | b'\r')).next().unwrap_or_default();
    let version = first.strip_prefix(b"#usda").and_then(|rest| crate::text::words(rest).next()).unwrap_or_default();
    let minor = version.strip_prefix(b"1.").unwrap_or_default();
    if !minor.is_empty() && minor.iter().all(u8::is_ascii_digit) {
        Ok(())
    } else {
        Err(UsdError::TextVersion(crate::text::quoted(version)))
    }
}

struct Parser<'a, 'g> {
    text: &'a [u8],
    lexer: Lexer<'a>,
    layer: Layer,
    gauge: &'g mut Gauge,
}

/// A line between parentheses: `prepend references = @a.usda@`.
struct Metadatum<'a> {
    /// True if it takes something away.
    removes: bool,
    key: &'a [u8],
    value: &'a [u8],
}

impl Metadatum<'_> {
    /// True if the value names nothing.
    fn is_empty(&self) -> bool {
        let mut signs = self.value.iter().filter(|byte| !byte.is_ascii_whitespace());
        self.value == b"None" || signs.all(|byte| b"[]{}".contains(byte))
    }
}

impl<'a> Parser<'a, '_> {
    fn layer_metadata(&mut self) -> Result<(), UsdError> {
        for Metadatum { key, value, .. } in self.metadata()? {
            let metadata = &mut self.layer.metadata;
            match key {
                b"upAxis" => metadata.up_axis = value.get(1).copied(),
                b"timeCodesPerSecond" => metadata.time_codes_per_second = crate::text::float(value),
                b"framesPerSecond" => metadata.frames_per_second = crate::text::float(value),
                b"subLayers" => metadata.has_sub_layers = value.contains(&b'@'),
                _ => {}
            }
        }
        Ok(())
    }

    /// Everything but the metadata: prims with their properties, one after the other, whatever their depth.
    fn prims(&mut self) -> Result<(), UsdError> {
        let mut open: Vec<u32> = Vec::new();
        loop {
            self.gauge.left(self.lexer.left())?;
            let token = self.lexer.next()?;
            let inside = open.last().copied();
            match (token, inside) {
                (Token::End, None) => return Ok(()),
                (Token::End, Some(prim)) => {
                    return Err(self.lexer.error(format!("the file ends within {}", self.layer.shown(prim))));
                }
                (Token::Sign(b'}'), Some(_)) => {
                    open.pop();
                }
                (Token::Sign(b';'), _) => {}
                (Token::Word(b"def"), _) => open.push(self.prim(inside, Specifier::Def)?),
                (Token::Word(b"over" | b"class"), _) => open.push(self.prim(inside, Specifier::Other)?),
                (Token::Word(b"reorder"), _) => self.reorder()?,
                (Token::Word(b"variantSet"), Some(prim)) => self.variant_set(prim)?,
                (Token::Word(word), Some(prim)) => self.property(prim, word)?,
                (found, None) => return Err(self.lexer.expected("a prim, such as `def Mesh \"Cube\"`", found)),
                (found, Some(_)) => return Err(self.lexer.expected("a property, a prim or `}`", found)),
            }
        }
    }

    /// The head of a prim, up to its opening brace.
    fn prim(&mut self, parent: Option<u32>, specifier: Specifier) -> Result<u32, UsdError> {
        let mut token = self.lexer.next()?;
        let mut type_name = String::new();
        if let Token::Word(word) = token {
            type_name = string(word);
            token = self.lexer.next()?;
        }
        let Token::Text(name) = token else { return Err(self.lexer.expected("the name of a prim", token)) };
        let mut prim = self.layer.child(parent, specifier, type_name, string(name));
        for metadatum in self.metadata()? {
            match metadatum.key {
                b"active" => prim.active = !matches!(metadatum.value, b"false" | b"0"),
                key if !metadatum.removes && !metadatum.is_empty() => prim.arc = prim.arc.or(arc(key)),
                _ => {}
            }
        }
        self.lexer.require(b'{', "`{`")?;
        self.layer.add_prim(prim, self.gauge)
    }

    /// `reorder nameChildren = [..]`: an order for display.
    fn reorder(&mut self) -> Result<(), UsdError> {
        self.lexer.next()?;
        self.lexer.require(b'=', "`=`")?;
        self.lexer.skip_value().map(drop)
    }

    /// `variantSet "name" = { "variant" { .. } .. }`.
    fn variant_set(&mut self, prim: u32) -> Result<(), UsdError> {
        self.lexer.next()?;
        self.lexer.require(b'=', "`=`")?;
        self.lexer.skip_value()?;
        self.layer.prims[prim as usize].arc.get_or_insert("variants");
        Ok(())
    }

    /// An attribute or relationship of which `word` is the first word.
    fn property(&mut self, prim: u32, mut word: &'a [u8]) -> Result<(), UsdError> {
        const QUALIFIERS: [&[u8]; 9] =
            [b"custom", b"uniform", b"varying", b"config", b"add", b"append", b"prepend", b"delete", b"reorder"];
        while QUALIFIERS.contains(&word) {
            word = self.word("the type of an attribute")?;
        }
        let mut type_name = string(word);
        if self.lexer.take(b'[')? {
            self.lexer.require(b']', "`]`")?;
            type_name.push_str("[]");
        }
        let name = self.word("the name of an attribute")?;
        let (name, part) = match name.iter().position(|&byte| byte == b'.') {
            Some(dot) => (&name[..dot], &name[dot + 1..]),
            None => (name, &b""[..]),
        };
        let name = string(name);
        let used = layer::is_used(&name);
        if used {
            self.layer.prims[prim as usize].attribute_mut(&name, self.gauge)?.type_name = type_name;
        }
        if self.lexer.take(b'=')? {
            match part {
                b"timeSamples" => {
                    let samples = self.samples()?;
                    if used {
                        self.gauge.bytes((size_of::<Sample>() * samples.len()) as u64)?;
                        self.layer.prims[prim as usize].attribute_mut(&name, self.gauge)?.samples = samples;
                    }
                }
                b"" => {
                    let value = self.value()?;
                    if used {
                        self.layer.prims[prim as usize].attribute_mut(&name, self.gauge)?.default = value;
                    }
                }
                _ => {
                    self.lexer.skip_value()?;
                }
            }
        }
        for Metadatum { key, value, .. } in self.metadata()? {
            if used && key == b"interpolation" {
                let text = string(value.get(1..value.len().saturating_sub(1)).unwrap_or_default());
                self.layer.prims[prim as usize].attribute_mut(&name, self.gauge)?.interpolation = Some(text);
            }
        }
        Ok(())
    }

    /// What stands between parentheses, if they come next: comments and pairs of a key and a value.
    fn metadata(&mut self) -> Result<Vec<Metadatum<'a>>, UsdError> {
        let mut found = Vec::new();
        if !self.lexer.take(b'(')? {
            return Ok(found);
        }
        loop {
            let mut key = match self.lexer.next()? {
                Token::Sign(b')') => return Ok(found),
                Token::Sign(b';' | b',') | Token::Text(_) => continue,
                Token::Word(key) => key,
                other => return Err(self.lexer.expected("a key or `)`", other)),
            };
            let removes = matches!(key, b"delete" | b"reorder");
            if matches!(key, b"add" | b"append" | b"prepend" | b"delete" | b"reorder") {
                key = self.word("a key")?;
            }
            self.lexer.require(b'=', "`=`")?;
            let value = self.lexer.skip_value()?;
            // The layer offset of a reference to a single file.
            if self.lexer.take(b'(')? {
                self.lexer.skip_to_end_of(b'(')?;
            }
            found.push(Metadatum { removes, key, value: &self.text[value] });
        }
    }

    /// `{ 1: value, 2: value, }`, in rising order.
    fn samples(&mut self) -> Result<Vec<Sample>, UsdError> {
        self.lexer.require(b'{', "`{`")?;
        let mut samples: Vec<Sample> = Vec::new();
        while !self.lexer.take(b'}')? {
            let token = self.lexer.next()?;
            let time = match token {
                Token::Number(number) => crate::text::float(number).filter(|time| time.is_finite()),
                _ => None,
            };
            let time = time.ok_or_else(|| self.lexer.expected("the time of a sample", token))?;
            self.lexer.require(b':', "`:`")?;
            let value = self.value()?.unwrap_or(Value::Blocked);
            samples.push(Sample { time, value });
            if !self.lexer.take(b',')? {
                self.lexer.require(b'}', "`,` or `}`")?;
                break;
            }
        }
        samples.sort_by(|a, b| a.time.total_cmp(&b.time));
        Ok(samples)
    }

    /// Where the next value lies; `None` for `None`, which takes a value away.
    fn value(&mut self) -> Result<Option<Value>, UsdError> {
        let Range { start, end } = self.lexer.skip_value()?;
        Ok((&self.text[start..end] != b"None").then_some(Value::Text { start: start as u64, end: end as u64 }))
    }

    fn word(&mut self, what: &'static str) -> Result<&'a [u8], UsdError> {
        match self.lexer.next()? {
            Token::Word(word) => Ok(word),
            other => Err(self.lexer.expected(what, other)),
        }
    }
}

fn string(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// What brings in prims from elsewhere.
fn arc(key: &[u8]) -> Option<&'static str> {
    match key {
        b"references" => Some("references"),
        b"payload" => Some("a payload"),
        b"inherits" => Some("inherits"),
        b"specializes" => Some("specializes"),
        b"variantSets" => Some("variants"),
        b"clips" => Some("value clips"),
        _ => None,
    }
}
