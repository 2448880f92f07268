//! From the sections of a file to prims.

use std::collections::HashMap;

use super::coding;
use super::cursor::{Cursor, chunks};
use super::damaged;
use super::value::{ValueRep, kind};
use crate::limits::Gauge;
use crate::usd::UsdError;
use crate::usd::layer::{Layer, Prim, Sample, Specifier, is_used};
use crate::usd::values::{Budget, Source, Value, Values};
use crate::{Limits, NONE};

/// What values refer to.
#[derive(Clone, Debug, Default)]
pub(in crate::usd) struct Tables {
    minor: u8,
    tokens: Vec<String>,
    /// The token of each string.
    strings: Vec<u32>,
    /// The tree of names, parents before their children.
    nodes: Vec<Node>,
    /// The node of each path.
    paths: Vec<u32>,
}

/// A path: the name of its last element and the path before that.
#[derive(Clone, Copy, Debug)]
struct Node {
    parent: u32,
    token: u32,
    is_property: bool,
}

/// What is known of a path: the fields of its spec.
#[derive(Clone, Copy, Debug)]
struct Spec {
    node: u32,
    field_set: u32,
    kind: u32,
}

/// Names with their values, and sets of these.
struct Fields {
    fields: Vec<(u32, ValueRep)>,
    /// Indices of fields; a set ends at [`NONE`].
    sets: Vec<u32>,
}

impl Tables {
    /// The length of an array, at which the cursor stands.
    pub(super) fn array_length(&self, cursor: &mut Cursor) -> Result<u64, UsdError> {
        if self.minor < 5 {
            // The rank, which is always 1.
            cursor.u32()?;
        }
        if self.minor < 7 { cursor.u32().map(u64::from) } else { cursor.u64() }
    }

    /// A token, or a string, which is a token by way of a table.
    pub(super) fn word(&self, index: u32, is_string: bool) -> Result<String, UsdError> {
        let token = if is_string { self.strings.get(index as usize).copied() } else { Some(index) };
        token.and_then(|token| self.token(token)).map(str::to_string).ok_or_else(|| damaged("a missing text"))
    }

    /// A path, such as `/World/Cube`.
    pub(super) fn path(&self, index: u32) -> Result<String, UsdError> {
        const LONGEST: usize = 64 << 10;
        let mut names = Vec::new();
        let mut length = 0;
        let mut next = *self.paths.get(index as usize).ok_or_else(|| damaged("a missing path"))?;
        while let Some(node) = self.nodes.get(next as usize).filter(|node| node.parent != NONE) {
            let name = self.token(node.token).unwrap_or_default();
            length += 1 + name.len();
            if length > LONGEST {
                return Err(damaged("a path without end"));
            }
            names.push(name);
            next = node.parent;
        }
        Ok(names.iter().rev().flat_map(|name| ["/", name]).collect())
    }

    fn token(&self, index: u32) -> Option<&str> {
        self.tokens.get(index as usize).map(String::as_str)
    }
}

/// Reads the structure of a file.
pub(in crate::usd) fn parse(bytes: &[u8], limits: Limits, gauge: &mut Gauge) -> Result<(Layer, Tables), UsdError> {
    let source = Source::Memory(bytes);
    let sections = Sections::read(&source, Budget::new(bytes.len() as u64, limits))?;
    let mut tables = Tables { minor: sections.minor, ..Tables::default() };
    tables.tokens = sections.tokens()?;
    tables.strings = sections.strings()?;
    sections.paths(&mut tables)?;
    let specs = sections.specs(&tables)?;
    let fields = sections.fields()?;
    let values = Values::with_budget(Source::Memory(bytes), &tables, sections.budget);
    let layer = Builder { tables: &tables, specs: &specs, fields, values, gauge }.build()?;
    Ok((layer, tables))
}

/// Where the sections of a file are.
struct Sections<'s, 'a> {
    source: &'s Source<'a>,
    minor: u8,
    places: Vec<(String, u64)>,
    budget: Budget,
}

impl<'s, 'a> Sections<'s, 'a> {
    fn read(source: &'s Source<'a>, budget: Budget) -> Result<Self, UsdError> {
        const MOST: u64 = 64;
        let mut cursor = Cursor::new(source, super::MAGIC.len() as u64);
        let version = cursor.bytes(8)?;
        let [major, minor, patch] = [version[0], version[1], version[2]];
        if major != 0 || !(4..=12).contains(&minor) {
            return Err(UsdError::Version(major, minor, patch));
        }
        let contents = cursor.u64()?;
        cursor.at = contents;
        let count = cursor.u64()?;
        if count > MOST {
            return Err(damaged(format!("{count} sections")));
        }
        let mut places = Vec::new();
        for _ in 0..count {
            let name = cursor.bytes(16)?;
            let name = name.split(|&byte| byte == 0).next().unwrap_or_default();
            places.push((String::from_utf8_lossy(name).into_owned(), cursor.u64()?));
            cursor.u64()?;
        }
        Ok(Self { source, minor, places, budget })
    }

    fn section(&self, name: &str) -> Result<Cursor<'s, 'a>, UsdError> {
        let place = self.places.iter().find(|(found, _)| found == name);
        let &(_, at) = place.ok_or_else(|| damaged(format!("the section {name} is missing")))?;
        Ok(Cursor::new(self.source, at))
    }

    fn tokens(&self) -> Result<Vec<String>, UsdError> {
        let mut cursor = self.section("TOKENS")?;
        let count = cursor.u64()?;
        let size = usize::try_from(cursor.u64()?).unwrap_or(usize::MAX);
        let bytes = coding::decompress(&mut cursor, size)?;
        // The last one ends with a zero too.
        let text = bytes.strip_suffix(b"\0").unwrap_or(&bytes);
        let found = text.iter().filter(|&&byte| byte == 0).count() as u64 + u64::from(!bytes.is_empty());
        if bytes.len() != size || found != count {
            return Err(damaged("the texts are not as many as announced"));
        }
        self.budget.take(found * 4)?;
        let token = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        Ok(text.split(|&byte| byte == 0).map(token).take(count as usize).collect())
    }

    fn strings(&self) -> Result<Vec<u32>, UsdError> {
        let mut cursor = self.section("STRINGS")?;
        let count = cursor.u64()?;
        Ok(chunks(&cursor.elements(count, 4)?).map(u32::from_le_bytes).collect())
    }

    /// The tree, in which each entry says where to go on: at its first child, at a sibling, at both or at none.
    fn paths(&self, tables: &mut Tables) -> Result<(), UsdError> {
        let mut cursor = self.section("PATHS")?;
        let announced = cursor.u64()?;
        let count = cursor.u64()?;
        let indices = self.indices(&mut cursor, count)?;
        // Signed: names of properties are below zero, and so are leaves.
        let tokens = self.integers(&mut cursor, count)?;
        let jumps = self.integers(&mut cursor, count)?;
        if announced > count {
            return Err(damaged("there are fewer paths than announced"));
        }
        let malformed = || damaged("the tree of paths is malformed");
        let unknown = Node { parent: NONE, token: NONE, is_property: false };
        let mut visited = vec![false; indices.len()];
        tables.nodes = vec![unknown; indices.len()];
        tables.paths = vec![NONE; announced as usize];
        let mut left = if indices.is_empty() { vec![] } else { vec![(0, NONE)] };
        while let Some((at, parent)) = left.pop() {
            let i = usize::try_from(at).ok().filter(|&i| visited.get(i) == Some(&false)).ok_or_else(malformed)?;
            visited[i] = true;
            let token = u32::try_from(tokens[i].unsigned_abs()).map_err(|_| malformed())?;
            tables.nodes[i] = Node { parent, token, is_property: tokens[i] < 0 };
            *tables.paths.get_mut(indices[i] as usize).ok_or_else(malformed)? = i as u32;
            match jumps[i] {
                -2 => {}
                -1 => left.push((at + 1, i as u32)),
                0 => left.push((at + 1, parent)),
                jump @ 1.. => left.extend([(at + jump, parent), (at + 1, i as u32)]),
                _ => return Err(malformed()),
            }
        }
        Ok(())
    }

    fn specs(&self, tables: &Tables) -> Result<Vec<Spec>, UsdError> {
        let mut cursor = self.section("SPECS")?;
        let count = cursor.u64()?;
        let paths = self.indices(&mut cursor, count)?;
        let sets = self.indices(&mut cursor, count)?;
        let kinds = self.indices(&mut cursor, count)?;
        let spec = |((path, field_set), kind): ((u32, u32), u32)| {
            let node = tables.paths.get(path as usize).copied().filter(|&node| node != NONE)?;
            Some(Spec { node, field_set, kind })
        };
        let specs: Option<Vec<Spec>> = paths.into_iter().zip(sets).zip(kinds).map(spec).collect();
        specs.ok_or_else(|| damaged("a spec without a path"))
    }

    fn fields(&self) -> Result<Fields, UsdError> {
        let mut cursor = self.section("FIELDS")?;
        let count = cursor.u64()?;
        let names = self.indices(&mut cursor, count)?;
        let bytes = coding::decompress(&mut cursor, names.len().saturating_mul(8))?;
        if bytes.len() != names.len() * 8 {
            return Err(damaged("there are fewer fields than announced"));
        }
        let reps = chunks(&bytes).map(|rep| ValueRep(u64::from_le_bytes(rep)));
        let mut cursor = self.section("FIELDSETS")?;
        let count = cursor.u64()?;
        Ok(Fields { fields: names.into_iter().zip(reps).collect(), sets: self.indices(&mut cursor, count)? })
    }

    fn indices(&self, cursor: &mut Cursor, count: u64) -> Result<Vec<u32>, UsdError> {
        Ok(self.integers(cursor, count)?.into_iter().map(|integer| integer as u32).collect())
    }

    fn integers(&self, cursor: &mut Cursor, count: u64) -> Result<Vec<i64>, UsdError> {
        self.budget.take(count)?;
        coding::integers::<4>(cursor, count)
    }
}

/// Makes prims of specs.
struct Builder<'a, 'g> {
    tables: &'a Tables,
    specs: &'a [Spec],
    fields: Fields,
    values: Values<'a>,
    gauge: &'g mut Gauge,
}

/// Kinds of specs, by their numbers in the file.
const ATTRIBUTE: u32 = 1;
const PRIM: u32 = 6;
const ROOT: u32 = 7;
const RELATIONSHIP: u32 = 8;

impl Builder<'_, '_> {
    fn build(mut self) -> Result<Layer, UsdError> {
        let mut layer = Layer::default();
        let mut children: HashMap<(u32, u32), usize> = HashMap::new();
        let mut left = Vec::new();
        for (i, spec) in self.specs.iter().enumerate() {
            match spec.kind {
                PRIM => {
                    let node = self.tables.nodes[spec.node as usize];
                    children.insert((node.parent, node.token), i);
                }
                ROOT => {
                    let order = self.metadata(spec, &mut layer)?;
                    left.extend(order.into_iter().rev().map(|token| (None, spec.node, token)));
                }
                _ => {}
            }
        }
        let mut prims: HashMap<u32, u32> = HashMap::new();
        while let Some((parent, node, token)) = left.pop() {
            // Every prim is taken once, so that no order can go on for ever.
            let Some(spec) = children.remove(&(node, token)).map(|i| self.specs[i]) else { continue };
            let name = self.name(token)?;
            let (prim, order) = self.prim(&spec, layer.child(parent, Specifier::Other, String::new(), name))?;
            let index = layer.add_prim(prim, self.gauge)?;
            prims.insert(spec.node, index);
            left.extend(order.into_iter().rev().map(|token| (Some(index), spec.node, token)));
        }
        for spec in self.specs.iter().filter(|spec| matches!(spec.kind, ATTRIBUTE | RELATIONSHIP)) {
            let node = self.tables.nodes[spec.node as usize];
            let Some(&prim) = prims.get(&node.parent).filter(|_| node.is_property) else { continue };
            let name = self.name(node.token)?;
            if is_used(&name) {
                self.attribute(spec, &name, &mut layer.prims[prim as usize])?;
            }
        }
        Ok(layer)
    }

    /// The fields of a spec, by name.
    fn fields(&self, spec: &Spec) -> Result<Vec<(&'_ str, ValueRep)>, UsdError> {
        let set = self.fields.sets.get(spec.field_set as usize..).ok_or_else(|| damaged("a missing set of fields"))?;
        let mut found = Vec::new();
        for &index in set.iter().take_while(|&&index| index != NONE) {
            let field = self.fields.fields.get(index as usize);
            let &(name, rep) = field.ok_or_else(|| damaged("a missing field"))?;
            self.values.budget.take(1)?;
            found.push((self.tables.token(name).ok_or_else(|| damaged("a field without a name"))?, rep));
            if found.len() > MOST_FIELDS {
                return Err(damaged("a set of too many fields"));
            }
        }
        Ok(found)
    }

    /// Metadata of the file, and the names of its first prims.
    fn metadata(&self, root: &Spec, layer: &mut Layer) -> Result<Vec<u32>, UsdError> {
        let mut order = Vec::new();
        for (name, rep) in self.fields(root)? {
            let number = || self.numbers(rep).map(|numbers| numbers.first().copied());
            let metadata = &mut layer.metadata;
            match name {
                "upAxis" => metadata.up_axis = self.words(rep)?.first().and_then(|axis| axis.bytes().next()),
                "timeCodesPerSecond" => metadata.time_codes_per_second = number()?,
                "framesPerSecond" => metadata.frames_per_second = number()?,
                "subLayers" => metadata.has_sub_layers = !self.words(rep)?.is_empty(),
                "primChildren" => order = self.tokens(rep)?,
                _ => {}
            }
        }
        Ok(order)
    }

    /// A prim without its attributes, and the names of its children.
    fn prim(&self, spec: &Spec, mut prim: Prim) -> Result<(Prim, Vec<u32>), UsdError> {
        let mut order = Vec::new();
        for (name, rep) in self.fields(spec)? {
            match name {
                "specifier" if rep.kind() == kind::SPECIFIER && rep.inlined() == 0 => prim.specifier = Specifier::Def,
                "typeName" => prim.type_name = self.words(rep)?.into_iter().next().unwrap_or_default(),
                "active" => prim.active = self.numbers(rep)?.first() != Some(&0.0),
                "primChildren" => order = self.tokens(rep)?,
                _ => prim.arc = prim.arc.or(arc(name)),
            }
        }
        Ok((prim, order))
    }

    fn attribute(&mut self, spec: &Spec, name: &str, prim: &mut Prim) -> Result<(), UsdError> {
        let (mut default, mut samples) = (None, Vec::new());
        let (mut type_name, mut interpolation) = (None, None);
        for (field, rep) in self.fields(spec)? {
            match field {
                "typeName" => type_name = self.words(rep)?.into_iter().next(),
                "interpolation" => interpolation = self.words(rep)?.into_iter().next(),
                "default" | "targetPaths" => default = Some(rep).filter(|rep| rep.kind() != kind::BLOCK),
                "timeSamples" => samples = self.samples(rep)?,
                _ => {}
            }
        }
        self.gauge.bytes((samples.len() * size_of::<Sample>()) as u64)?;
        let attribute = prim.attribute_mut(name, self.gauge)?;
        attribute.type_name = type_name.unwrap_or_default();
        attribute.interpolation = interpolation;
        attribute.default = default.map(Value::Binary);
        attribute.samples = samples;
        Ok(())
    }

    /// Times, then as many values.
    fn samples(&self, rep: ValueRep) -> Result<Vec<Sample>, UsdError> {
        if rep.kind() != kind::TIME_SAMPLES || rep.is_inlined() {
            return Err(damaged("time samples of another type"));
        }
        let mut cursor = Cursor::new(&self.values.source, rep.place());
        cursor.follow()?;
        let times = self.numbers(ValueRep(cursor.u64()?))?;
        cursor.follow()?;
        let count = cursor.u64()?;
        if count != times.len() as u64 {
            return Err(damaged(format!("{} times for {count} samples", times.len())));
        }
        let reps = cursor.elements(count, 8)?;
        let sample = |(time, rep): (f64, [u8; 8])| {
            let rep = ValueRep(u64::from_le_bytes(rep));
            let value = if rep.kind() == kind::BLOCK { Value::Blocked } else { Value::Binary(rep) };
            Sample { time, value }
        };
        let mut samples: Vec<Sample> = times.into_iter().zip(chunks(&reps)).map(sample).collect();
        samples.retain(|sample| sample.time.is_finite());
        samples.sort_by(|a, b| a.time.total_cmp(&b.time));
        Ok(samples)
    }

    fn numbers(&self, rep: ValueRep) -> Result<Vec<f64>, UsdError> {
        self.values.numbers(Value::Binary(rep), 1)
    }

    fn words(&self, rep: ValueRep) -> Result<Vec<String>, UsdError> {
        self.values.words(Value::Binary(rep))
    }

    /// The indices of the tokens of a list of names.
    fn tokens(&self, rep: ValueRep) -> Result<Vec<u32>, UsdError> {
        if rep.kind() != kind::TOKEN_VECTOR {
            return Err(damaged("a list of names of another type"));
        }
        let mut cursor = Cursor::new(&self.values.source, rep.place());
        let count = cursor.u64()?;
        self.values.budget.take(count)?;
        Ok(chunks(&cursor.elements(count, 4)?).map(u32::from_le_bytes).collect())
    }

    /// The name that a token is.
    fn name(&self, token: u32) -> Result<String, UsdError> {
        let name = self.tables.word(token, false)?;
        self.values.budget.take(1 + name.len() as u64 / 8)?;
        Ok(name)
    }
}

/// A spec has a handful of fields, and fields without names that are known may be among them.
const MOST_FIELDS: usize = 1000;

/// What brings in prims from elsewhere.
fn arc(field: &str) -> Option<&'static str> {
    match field {
        "references" => Some("references"),
        "payload" => Some("a payload"),
        "inheritPaths" => Some("inherits"),
        "specializes" => Some("specializes"),
        "variantSetNames" => Some("variants"),
        "clips" => Some("value clips"),
        _ => None,
    }
}
