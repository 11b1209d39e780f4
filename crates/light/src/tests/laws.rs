//! The laws of the house over odd plants, one test each.

foliar_bake::law_tests!(crate::Light, foliar_plant::sample::odd_plants());
