//! Values to arrays, parameters and facts: what the layer holds.

use crate::{Params, ROOM};
use foliar_bake::{Array, AttributeKey, Baked, params_json};
use foliar_plant::Plant;
use foliar_schema::{Finding, Role, code, names};
use serde_json::json;

/// A plant without leaves: nothing to write, and why.
pub(crate) fn empty(params: &Params) -> Baked {
    let message = format!("{ROOM}: the plant has no leaves, so the layer is empty; name them with --leaf");
    let finding = Finding::new(&code::LEAF_NONE, message);
    Baked { resolved: params_json(params), findings: vec![finding], ..Baked::default() }
}

/// The layer of a plant with leaves, from the shares of each part's vertices.
pub(crate) fn baked(plant: &Plant, shares: Vec<Vec<f32>>, radius: f64, params: &Params) -> Baked {
    let mut baked = Baked { resolved: params_json(params), ..Baked::default() };
    baked.facts.insert("radiusM".into(), json!(radius));
    let parts = plant.parts().iter().enumerate().zip(shares);
    for ((_, part), shares) in parts.filter(|((index, _), _)| plant.role(*index) != Role::Other) {
        let key = AttributeKey { place: part.place, name: names::__ROOM___SHARE.into() };
        baked.attributes.insert(key, Array::scalars(shares));
    }
    baked
}
