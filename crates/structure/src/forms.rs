//! What the pieces of a part look like together, and what that says of its role.

use crate::evidence::{Evidence, Source};
use crate::shape::{Form, PieceShape};
use foliar_schema::Role;

/// A part is of one form where at least this share of its area is.
const MOSTLY: f64 = 0.9;
/// From this many sheets on they look like leaves rather than like a thing with a few sides.
const MANY: usize = 8;
/// Sizes are similar where the 10th and 90th percentile of area differ by less than this factor.
const SIMILAR: f64 = 30.0;
/// A card has fewer triangles than this; an outline has more.
const OUTLINE: usize = 24;
/// So few large cards show the whole plant each.
const FEW: usize = 4;
/// A body whose spread is at least this share of the plant's diagonal is a trunk or a bough.
const TRUNK: f64 = 0.1;
/// Wood fills no more than this share of the ball with its spread, averaged over its area.
const SLENDER: f64 = 0.08;

/// Areas of a part by form.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Forms {
    /// All of it.
    pub area: f64,
    /// Area-weighted mean height over the plant's center, meters.
    pub height: f64,
    sheets: f64,
    silhouettes: f64,
    silhouette_count: usize,
    silhouette_triangles: usize,
    blobs: f64,
    bodies: f64,
    /// One body is about as large as the plant.
    has_trunk: bool,
    sheet_count: usize,
    similar: bool,
    /// Area-weighted mean fullness of the bodies.
    body_fullness: f64,
}

impl Forms {
    pub fn of(shapes: &[PieceShape], diagonal: f64) -> Self {
        let mut forms = Forms::default();
        let mut sheet_areas = Vec::new();
        for shape in shapes {
            forms.area += shape.area;
            forms.height += shape.area * shape.center.y;
            match shape.form(diagonal) {
                Form::Nothing => {}
                Form::Sheet => {
                    forms.sheets += shape.area;
                    sheet_areas.push(shape.area);
                }
                Form::LargeSheet => {
                    forms.silhouettes += shape.area;
                    forms.silhouette_count += 1;
                    forms.silhouette_triangles += shape.triangles;
                }
                Form::Blob => forms.blobs += shape.area,
                Form::Body => {
                    forms.has_trunk |= shape.spread >= TRUNK * diagonal;
                    forms.bodies += shape.area;
                    forms.body_fullness += shape.area * shape.fullness();
                }
            }
        }
        sheet_areas.sort_unstable_by(f64::total_cmp);
        let percentile = |p: usize| sheet_areas.get(sheet_areas.len() * p / 100).copied().unwrap_or(0.0);
        forms.sheet_count = sheet_areas.len();
        forms.similar = percentile(90) <= SIMILAR * percentile(10);
        forms.height /= forms.area.max(f64::MIN_POSITIVE);
        forms.body_fullness /= forms.bodies.max(f64::MIN_POSITIVE);
        forms
    }

    fn share(&self, area: f64) -> f64 {
        if self.area > 0.0 { area / self.area } else { 0.0 }
    }

    pub fn mostly_blobs(&self) -> bool {
        self.share(self.blobs) >= MOSTLY
    }

    /// Trunk and foliage: by area both, or foliage with a trunk in it (whose area is lost among thousands of leaves).
    pub fn wood_and_foliage(&self) -> bool {
        let little = 1.0 - MOSTLY;
        let foliage = self.share(self.sheets + self.blobs) > little;
        foliage && (self.has_trunk || self.share(self.bodies) > little)
    }

    /// Large sheets that are cut out along a plant's outline, or too few to be anything but its pictures.
    pub fn mostly_silhouettes(&self) -> bool {
        let cut_out = self.silhouette_triangles >= OUTLINE * self.silhouette_count;
        let few = self.silhouette_count <= FEW && self.share(self.silhouettes) >= MOSTLY;
        self.share(self.silhouettes) >= 0.5 && (cut_out || few)
    }
}

/// What the forms of a part's pieces say of its role.
pub(crate) fn shape_evidence(forms: &Forms) -> Vec<Evidence> {
    let percent = |area| 100.0 * forms.share(area);
    let evidence = |role, weight, reason| vec![Evidence { source: Source::Shape, role, weight, reason }];
    if forms.mostly_blobs() {
        let reason = format!("{:.0} % of the area is closed, full bodies", percent(forms.blobs));
        return evidence(Role::Leaf, 2.0, reason);
    }
    if forms.share(forms.sheets) >= MOSTLY {
        let (count, share) = (forms.sheet_count, percent(forms.sheets));
        let (weight, size) = match (count >= MANY, forms.similar) {
            (true, true) => (3.0, "of similar size"),
            (true, false) => (2.0, "of all sizes"),
            (false, _) => (1.0, "few as they are"),
        };
        let reason = format!("{share:.0} % of the area is {count} small flat pieces {size}");
        return evidence(Role::Leaf, weight, reason);
    }
    if forms.share(forms.bodies) >= MOSTLY {
        let fullness = forms.body_fullness;
        let (weight, kind) =
            if fullness <= SLENDER { (2.5, "slender tubes or branches") } else { (1.0, "bodies, not slender") };
        let reason = format!(
            "{:.0} % of the area is {kind} (they fill {fullness:.3} of the ball of their size)",
            percent(forms.bodies)
        );
        return evidence(Role::Wood, weight, reason);
    }
    let foliage = forms.sheets + forms.blobs + forms.silhouettes;
    let both = [(Role::Leaf, foliage, "sheets and blobs"), (Role::Wood, forms.bodies, "tubes and branching bodies")];
    both.into_iter()
        .filter(|both| both.1 > 0.0)
        .map(|(role, area, what)| Evidence {
            source: Source::Shape,
            role,
            weight: forms.share(area),
            reason: format!("{:.0} % of the area is {what}", percent(area)),
        })
        .collect()
}
