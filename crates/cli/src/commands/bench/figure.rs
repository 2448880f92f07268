//! Frames per second over the tessellation factor, a panel per cage: Figure 5 of Loop, *Hardware Subdivision and Tessellation of
//! Catmull-Clark Surfaces*, MSR-TR-2010-163. The vertical axis is logarithmic to base 10, the horizontal one to base 2.

use super::report::{Row, everywhere};
use crate::failure::Failure;
use osculate_compare::whole_file;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::io;
use std::ops::Range;
use std::path::Path;

/// Width and height of a panel.
const PANEL: (u32, u32) = (460, 360);
/// Panels side by side.
const COLUMNS: usize = 2;

type Panel<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type DrawError = Box<dyn std::error::Error + Send + Sync>;

/// Writes the figure.
pub(super) fn write(file: &Path, rows: &[Row]) -> Result<(), Failure> {
    let text = draw(rows).map_err(|error| Failure::output(file, error))?;
    whole_file::write(file, |out| out.write_all(text.as_bytes()))
        .map_err(|error: io::Error| Failure::output(file, error))
}

/// The figure as SVG.
fn draw(rows: &[Row]) -> Result<String, DrawError> {
    let cages = distinct(rows.iter().map(|row| row.cage.as_str()));
    let columns = cages.len().clamp(1, COLUMNS);
    let lines = cages.len().div_ceil(columns).max(1);
    let mut text = String::new();
    {
        let size = (PANEL.0 * columns as u32, PANEL.1 * lines as u32);
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)?;
        let ranges = (range(rows.iter().map(|row| f64::from(row.level))), range(rows.iter().map(rate)));
        for (panel, cage) in root.split_evenly((lines, columns)).iter().zip(&cages) {
            draw_panel(panel, cage, rows, &ranges)?;
        }
        root.present()?;
    }
    Ok(text)
}

/// One cage: a line per scheme, evaluator and way to refine.
fn draw_panel(
    panel: &Panel<'_>,
    cage: &str,
    rows: &[Row],
    (levels, rates): &(Range<f64>, Range<f64>),
) -> Result<(), DrawError> {
    let mut chart = ChartBuilder::on(panel)
        .caption(cage, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(36)
        .y_label_area_size(52)
        .build_cartesian_2d(levels.clone().log_scale().base(2.0), rates.clone().log_scale())?;
    chart
        .configure_mesh()
        .x_desc("tessellation factor")
        .y_desc("frames per second")
        .x_label_formatter(&|level| format!("{level:.0}"))
        .y_label_formatter(&|rate| if *rate < 1.0 { format!("{rate}") } else { format!("{rate:.0}") })
        .light_line_style(WHITE)
        .draw()?;
    let of_cage = || rows.iter().filter(|row| row.cage == cage);
    let line = |row: &Row| (row.scheme.clone(), row.evaluator.clone(), row.refine.clone());
    for key in distinct(of_cage().map(line)) {
        let is_line = |row: &&Row| line(row) == key;
        let (scheme, evaluator, refine) = &key;
        let everywhere = *refine == everywhere();
        let label = format!("{scheme}, {evaluator}{}", if everywhere { "" } else { ", refined where needed" });
        let color = color(scheme).mix(if everywhere { 1.0 } else { 0.5 });
        let points: Vec<(f64, f64)> = of_cage().filter(is_line).map(|row| (f64::from(row.level), rate(row))).collect();
        let solid = evaluator == "tessellator";
        let style = color.stroke_width(if solid { 2 } else { 1 });
        chart
            .draw_series(LineSeries::new(points.iter().copied(), style))?
            .label(label)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 18, y)], style));
        let size = if solid { 3 } else { 2 };
        chart.draw_series(points.into_iter().map(|point| Circle::new(point, size, color.filled())))?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::LowerLeft)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    Ok(())
}

/// Frames per second.
fn rate(row: &Row) -> f64 {
    1e3 / row.frame_ms.median
}

/// The values in the order in which they first occur.
fn distinct<T: PartialEq>(values: impl Iterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for value in values {
        if !found.contains(&value) {
            found.push(value);
        }
    }
    found
}

/// A range around positive values, with some room on a logarithmic scale.
fn range(values: impl Iterator<Item = f64>) -> Range<f64> {
    let (least, greatest) = values.fold((f64::INFINITY, 0.0_f64), |(a, b), value| (a.min(value), b.max(value)));
    least / 1.3..greatest * 1.3
}

fn color(scheme: &str) -> RGBColor {
    match scheme {
        "gregory1" => RGBColor(230, 120, 0),
        "gregory2" => RGBColor(0, 90, 180),
        "stam" => RGBColor(0, 140, 70),
        "biseptic" => RGBColor(170, 0, 110),
        _ => RGBColor(90, 90, 90),
    }
}

#[cfg(test)]
mod tests {
    use super::super::report::tests::row;
    use super::*;

    #[test]
    fn the_figure_has_a_panel_per_cage_and_a_line_per_scheme() {
        let mut rows = Vec::new();
        for cage in ["one", "two", "three"] {
            for (scheme, level) in [("stam", 1.0), ("stam", 32.0), ("gregory2", 1.0), ("gregory2", 32.0)] {
                rows.push(row(cage, scheme, level, 4.0 * f64::from(level)));
            }
        }
        let text = draw(&rows).unwrap();
        assert!(text.starts_with("<svg ") && text.trim_end().ends_with("</svg>"));
        assert!(["one", "two", "three"].iter().all(|cage| text.contains(&format!("\n{cage}\n"))), "{text}");
        assert_eq!(text.matches("\nstam, tessellator\n").count(), 3);
        // Two points on each of two lines in each of three panels.
        assert_eq!(text.matches("<circle").count(), 12);
    }
}
