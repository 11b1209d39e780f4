//! The legend below a picture: name, unit, colors with their numbers.

use crate::colors;
use crate::key::{Key, Legend};
use crate::text::{self, SMALL, number};
use foliar_schema::Role;
use glam::Vec3;
use image::{Rgba, RgbaImage};

/// Free pixels around the legend.
const PAD: u32 = 10;
/// Size of the bar of colors, pixels.
pub(crate) const BAR: [u32; 2] = [256, 16];

/// In the order of the bar.
const ROLES: [Role; 3] = [Role::Wood, Role::Leaf, Role::Other];
/// Behind the legend.
const PAPER: Rgba<u8> = Rgba([28, 28, 30, 255]);

/// Where the bar's left upper corner lies in a picture of this height, its legend counted in.
pub(crate) fn bar_corner(height: u32) -> [u32; 2] {
    [PAD, height.saturating_sub(PAD + text::height(SMALL) + 4 + BAR[1])]
}

/// The picture with its legend on a strip of its own below, where it hides nothing; unchanged where it is
/// too narrow to hold one.
pub(crate) fn below(picture: RgbaImage, legend: &Legend) -> RgbaImage {
    let (width, top) = picture.dimensions();
    if width < BAR[0] + 2 * PAD {
        return picture;
    }
    let line = text::height(SMALL) + 4;
    let unit = if legend.unit.is_empty() || legend.unit == "1" { String::new() } else { format!(" [{}]", legend.unit) };
    let title = text::wrapped(SMALL, &format!("{}{unit}", legend.name), width - 2 * PAD);
    let doc = text::wrapped(SMALL, &legend.doc, width - 2 * PAD);
    let head = (title.len() + doc.len()) as u32 * line;
    let mut whole = RgbaImage::from_pixel(width, top + PAD + head + BAR[1] + line + PAD, PAPER);
    image::imageops::replace(&mut whole, &picture, 0, 0);
    let lines = title.iter().map(|words| (words, 255)).chain(doc.iter().map(|words| (words, 190)));
    for (row, (words, gray)) in (0u32..).zip(lines) {
        text::write(&mut whole, SMALL, i64::from(PAD), i64::from(top + PAD + row * line), words, gray);
    }
    let [x, y] = bar_corner(whole.height());
    bar(&mut whole, legend, x, y);
    numbers(&mut whole, &legend.kind, x, y + BAR[1] + 4);
    whole
}

fn bar(picture: &mut RgbaImage, legend: &Legend, x: u32, y: u32) {
    for column in 0..BAR[0] {
        let share = column as f32 / (BAR[0] - 1) as f32;
        for row in 0..BAR[1] {
            let color = colors::to_bytes(bar_color(&legend.kind, share, row), 1.0);
            picture.put_pixel(x + column, y + row, Rgba(color));
        }
    }
}

fn bar_color(kind: &Key, share: f32, row: u32) -> Vec3 {
    let third = (share * 3.0).min(2.999);
    let axis = |unit: [Vec3; 3]| unit[third as usize];
    match kind {
        Key::Ramp(..) => colors::ramp(share),
        Key::Diverging(_) => colors::diverging(2.0 * share - 1.0),
        // Upper half: toward the axis; lower half: away from it.
        Key::Direction => colors::of_direction(axis(Vec3::AXES) * if row < BAR[1] / 2 { 1.0 } else { -1.0 }),
        Key::Steps(low, high) => colors::ramp(step(share, high - low) as f32 / (high - low) as f32),
        Key::Box(..) => axis(Vec3::AXES) * colors::to_linear(third.fract()),
        Key::Ids(_) => colors::of_id((share * 31.99) as u32),
        Key::Roles => colors::of_role(ROLES[third as usize]),
    }
}

/// Which of `span` + 1 blocks of the bar lies there.
fn step(share: f32, span: i32) -> i32 {
    ((share * (span + 1) as f32) as i32).min(span)
}

/// Three digits: a third of the bar holds two numbers.
fn short(value: f32) -> String {
    let digits = if value.abs() >= 100.0 { 0 } else { usize::from(value.abs() < 10.0) + 1 };
    format!("{value:.digits$}")
}

fn numbers(picture: &mut RgbaImage, kind: &Key, x: u32, y: u32) {
    let words: Vec<String> = match kind {
        Key::Ramp(low, high) if low >= high => vec![format!("{} everywhere", number(*low))],
        Key::Ramp(low, high) => vec![number(*low), number(low.midpoint(*high)), number(*high)],
        Key::Diverging(most) => vec![number(-most), "0".into(), format!("+{}", number(*most))],
        Key::Direction => ["+-X", "+-Y", "+-Z"].map(String::from).into(),
        Key::Box(names, low, high) => {
            let word = |c: usize| format!("{} {}..{}", names[c], short(low[c]), short(high[c]));
            (0..3).map(|c| text::fitted(SMALL, &word(c), BAR[0] / 3)).collect()
        }
        Key::Steps(low, high) => (*low..=*high).map(|n| n.to_string()).collect(),
        Key::Roles => ROLES.map(|role| role.to_string()).into(),
        Key::Ids(count) => vec![format!("{count} ids, colors without order")],
    };
    let last = words.len().max(2) - 1;
    let blocks = words.len().max(1) as u32;
    for (index, word) in words.iter().enumerate() {
        let length = text::width(SMALL, word);
        let at = if matches!(kind, Key::Steps(..) | Key::Box(..) | Key::Direction | Key::Roles) {
            // Under the middle of its block.
            x + (BAR[0] * (2 * index as u32 + 1) / (2 * blocks)).saturating_sub(length / 2)
        } else {
            // First at the left end, last at the right end, others centered.
            x + BAR[0].saturating_sub(length) * index as u32 / last as u32
        };
        text::write(picture, SMALL, i64::from(at), i64::from(y), word, 235);
    }
}
