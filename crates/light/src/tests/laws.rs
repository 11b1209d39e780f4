//! The laws of the house over odd plants, one test each.

use crate::Light;
use foliar_bake::laws;
use foliar_plant::sample::odd_plants;

fn holds(law: laws::Law) {
    let breaches: Vec<String> =
        odd_plants().iter().filter_map(|sample| law(&Light, sample).err()).map(|breach| breach.to_string()).collect();
    assert!(breaches.is_empty(), "{}", breaches.join("\n"));
}

#[test]
fn law_2_own_room() {
    holds(laws::own_room);
}

#[test]
fn law_4_repeatable() {
    holds(laws::repeatable);
}

#[test]
fn law_5_meets_its_reference() {
    holds(laws::meets_reference);
}

#[test]
fn law_6_in_range() {
    holds(laws::in_range);
}

#[test]
fn law_7_defaults_agree() {
    holds(laws::defaults_agree);
}

#[test]
fn law_8_order_free() {
    holds(laws::order_free);
}

#[test]
fn law_8_translation_free() {
    holds(laws::translation_free);
}

#[test]
fn law_8_unit_free() {
    holds(laws::unit_free);
}
