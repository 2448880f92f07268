//! Quads by the order of triangles: exporters write the two halves of a quad one after the other, and turn them all alike.
//!
//! Neighbours in the list that share an edge are candidates. Which of them are quads is the best choice of disjoint ones (a dynamic
//! programme over the list); it is believed if one or two patterns of corners, as an exporter makes them that cuts along the shorter
//! diagonal, cover most triangles.

use super::{Found, Pair, Points};
use crate::progress::Watch;

/// Part of the triangles that must be in pairs of the exporter's patterns.
const ENOUGH: f64 = 0.75;
/// Part of the pairs that must be halves of quads if there are only quads; strips have theirs anywhere.
const ALIGNED: f64 = 0.9;
/// Worth of a pair beside its quality: odd quads are quads too.
const PRESENCE: f64 = 0.25;
/// Triangles around a vertex, a pole or an n-gon, are in order as well; only good quads are taken from them.
const GOOD: f64 = 0.6;

/// The pairs of an exporter's order, if there is one.
pub(super) fn pairs(triangles: &[[u32; 3]], points: &Points, watch: &Watch) -> Found<Vec<Pair>> {
    let link = |t: u32| watch.at(t).map(|()| points.pair(triangles, [t - 1, t]));
    let all: Vec<Option<Pair>> = (1..triangles.len() as u32).map(link).collect::<Result<_, _>>()?;
    let mut links: Vec<Option<Pair>> = all.iter().map(|link| link.filter(|pair| pair.quality > 0.0)).collect();
    drop_fans(&mut links, triangles, points);
    let patterns = two_most_frequent(&best(&links));
    let fits = |link: &Option<Pair>| link.filter(|pair| patterns.contains(&pair.pattern));
    watch.look()?;
    let chosen = best(&links.iter().map(fits).collect::<Vec<_>>());
    let covered = 2.0 * chosen.len() as f64 / triangles.len() as f64;
    if chosen.is_empty() || covered < ENOUGH {
        return Ok(None);
    }
    // A mesh of nothing but quads may have concave ones and folded ones, for which most others leave room.
    let aligned = chosen.iter().filter(|pair| pair.triangles[0].is_multiple_of(2)).count();
    let only_quads = triangles.len().is_multiple_of(2) && aligned as f64 >= ALIGNED * chosen.len() as f64;
    let halves: Option<Vec<Pair>> = all.iter().step_by(2).map(fits).collect();
    Ok(Some(halves.filter(|_| only_quads).unwrap_or(chosen)))
}

/// Drops poor pairs from rows of four and more triangles around one vertex.
fn drop_fans(links: &mut [Option<Pair>], triangles: &[[u32; 3]], points: &Points) {
    let diagonal = |link: &Option<Pair>| {
        link.map(|pair| {
            let triangle = triangles[pair.triangles[0] as usize].map(|point| points.vertex(point));
            let opposite = usize::from(pair.pattern / 3);
            [triangle[(opposite + 1) % 3], triangle[(opposite + 2) % 3]]
        })
    };
    let diagonals: Vec<Option<[u32; 2]>> = links.iter().map(diagonal).collect();
    for (i, three) in diagonals.windows(3).enumerate() {
        let [Some(a), Some(b), Some(c)] = three else { continue };
        if a.iter().any(|v| b.contains(v) && c.contains(v)) {
            links[i..i + 3].iter_mut().for_each(|link| *link = link.filter(|pair| pair.quality >= GOOD));
        }
    }
}

/// Of links between neighbours in a list, those that do not touch and are worth most together. `links[t]` joins `t` and `t + 1`.
fn best(links: &[Option<Pair>]) -> Vec<Pair> {
    // worth[t]: the most that triangles from t on can be worth.
    let mut worth = vec![0.0; links.len() + 2];
    let with = |worth: &[f64], t: usize| links[t].map(|pair| PRESENCE + pair.quality + worth[t + 2]);
    for t in (0..links.len()).rev() {
        worth[t] = with(&worth, t).map_or(worth[t + 1], |with| with.max(worth[t + 1]));
    }
    let mut chosen = Vec::new();
    let mut t = 0;
    while t < links.len() {
        match (links[t], with(&worth, t)) {
            (Some(pair), Some(with)) if with >= worth[t] => {
                chosen.push(pair);
                t += 2;
            }
            _ => t += 1,
        }
    }
    chosen
}

fn two_most_frequent(pairs: &[Pair]) -> [u8; 2] {
    let mut counts = [0_usize; 9];
    pairs.iter().for_each(|pair| counts[usize::from(pair.pattern)] += 1);
    let mut patterns: Vec<u8> = (0..9).collect();
    patterns.sort_by_key(|&pattern| std::cmp::Reverse(counts[usize::from(pattern)]));
    [patterns[0], patterns[1]]
}
