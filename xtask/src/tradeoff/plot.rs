//! A bar chart as SVG: correlation of the normals with traced light, tree by tree.

use super::judged::Judged;
use std::fmt::Write;

/// Length of correlation 1, pixels.
const SCALE: f64 = 420.0;
/// Where bars begin, and what stands between and around rows.
const LEFT: f64 = 340.0;
const BAR: f64 = 9.0;
const GAP: f64 = 12.0;
const TOP: f64 = 48.0;
const COLORS: [&str; 4] = ["#2f6d3a", "#7fae5a", "#a8682c", "#4a7fb5"];

/// The chart.
pub fn svg(judged: &[Judged]) -> String {
    let methods = &judged[0].normals;
    let row = BAR * judged.len() as f64 + GAP;
    let (width, height) = (LEFT + SCALE + 60.0, TOP + row * methods.len() as f64 + 30.0);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    for (index, tree) in judged.iter().enumerate() {
        let x = 20.0 + 190.0 * index as f64;
        let color = COLORS[index % COLORS.len()];
        let _ = writeln!(text, "<rect x=\"{x}\" y=\"12\" width=\"12\" height=\"12\" fill=\"{color}\"/>");
        let _ = writeln!(text, "<text x=\"{}\" y=\"22\">{}</text>", x + 18.0, tree.name);
    }
    for (at, method) in methods.iter().enumerate() {
        let y = TOP + row * at as f64;
        let name = method.name.replace(['*', '`'], "");
        let middle = y + row / 2.0;
        let _ = writeln!(text, "<text x=\"{}\" y=\"{middle}\" text-anchor=\"end\">{name}</text>", LEFT - 10.0);
        for (index, tree) in judged.iter().enumerate() {
            let r = tree.normals[at].correlation[0];
            let (y, length) = (y + BAR * index as f64, SCALE * r.max(0.0));
            let color = COLORS[index % COLORS.len()];
            let _ = writeln!(
                text,
                "<rect x=\"{LEFT}\" y=\"{y:.0}\" width=\"{length:.1}\" height=\"{:.0}\" fill=\"{color}\"/>\
                 <text x=\"{:.1}\" y=\"{:.0}\" font-size=\"9\">{r:.2}</text>",
                BAR - 1.0,
                LEFT + length + 4.0,
                y + BAR - 1.0
            );
        }
    }
    let _ = writeln!(
        text,
        "<text x=\"{LEFT}\" y=\"{:.0}\">correlation of max(0, N.L) with traced, low-passed visibility</text>\n</svg>",
        height - 8.0
    );
    text
}
