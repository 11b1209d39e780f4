//! How a map is made: tissue, models, and the size of a texel.

use crate::kernel::{Spread, mean_medium};
use crate::light::{Entrance, Entry, Fit};
use crate::transport::{AddingDoubling, Boundary, DeltaP1, Layer, Medium, Multipole, Totals};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Where energy comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Model {
    /// The image series in closed form, as the paper had it; its shape too.
    Multipole,
    /// Delta-P1.
    Diffusion,
    /// Adding-doubling; the shape is delta-P1's.
    #[default]
    AddingDoubling,
}

/// Whether light spreads inside the leaf.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Spreading {
    /// Each texel for itself.
    None,
    /// By the kernel of the thickness where it leaves.
    #[default]
    Kernel,
}

/// One layer of tissue and its share of the thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tissue {
    /// What it is made of.
    pub medium: Medium,
    /// Its share of the leaf's thickness; all together are 1.
    pub share: f64,
}

/// How a map is made.
#[derive(Clone, Debug, PartialEq)]
pub struct Recipe {
    /// Layers from the lit side.
    pub tissues: Vec<Tissue>,
    /// Where energy comes from.
    pub model: Model,
    /// How light enters.
    pub entry: Entry,
    /// How directions are weighed.
    pub fit: Fit,
    /// Whether the two-number curve bends the linear function.
    pub curve: bool,
    /// Whether light spreads.
    pub spreading: Spreading,
    /// Filters of the bank, the identity among them; without it as many as its accuracy takes.
    pub filters: Option<usize>,
    /// Size of a texel, mm: across and down.
    pub texel_mm: [f64; 2],
}

/// Gauss nodes of adding-doubling: T is right to 6e-4.
pub const NODES: usize = 16;

impl Recipe {
    /// A leaf of one tissue, at the defaults.
    pub fn new(medium: Medium, texel_mm: [f64; 2]) -> Recipe {
        Recipe {
            tissues: vec![Tissue { medium, share: 1.0 }],
            model: Model::default(),
            entry: Entry::default(),
            fit: Fit::default(),
            curve: false,
            spreading: Spreading::default(),
            filters: None,
            texel_mm,
        }
    }

    /// Index of refraction.
    pub fn index(&self) -> f64 {
        self.tissues.first().map_or(1.0, |tissue| tissue.medium.index)
    }

    fn layers(&self, thickness_mm: f64) -> Vec<Layer> {
        let layer = |t: &Tissue| Layer { medium: t.medium, thickness_mm: t.share * thickness_mm };
        self.tissues.iter().map(layer).collect()
    }

    /// What a leaf of this thickness lets in. Diffusion and multipole take layers as their mean.
    pub fn entrance(&self, thickness_mm: f64) -> Entrance {
        let layers = self.layers(thickness_mm);
        let Some((mean, _)) = mean_medium(&layers) else { return Entrance::of(&[], NODES) };
        let model = |cosine: f64| match self.model {
            Model::Multipole => Multipole::new(&mean, thickness_mm, cosine).transmittance(),
            _ => DeltaP1::new(&mean, thickness_mm, cosine).totals().1,
        };
        if self.model == Model::AddingDoubling {
            return Entrance::of(&layers, NODES);
        }
        // The same cosines as adding-doubling's nodes, from a plate that costs nothing.
        let clear = Layer { medium: Medium { absorption: 0.0, scattering: 0.0, ..mean }, thickness_mm };
        let mut solved = AddingDoubling::solve(&[clear], &[1.0], NODES);
        let fill = |totals: &mut Totals| totals.transmittance = model(totals.cosine);
        solved.nodes.iter_mut().for_each(fill);
        solved.front.iter_mut().for_each(fill);
        Entrance::new(&solved, mean.index)
    }

    /// How light spreads in a leaf of this thickness.
    pub fn spread(&self, thickness_mm: f64, boundary: &Boundary) -> Option<Spread> {
        let (mean, total) = mean_medium(&self.layers(thickness_mm))?;
        Some(match self.model {
            Model::Multipole => Spread::multipole(&mean, total),
            _ => Spread::diffusion(&mean, total, boundary),
        })
    }
}
