//! Light in the crown: optical depths of leaves in eight directions, and the model that lights them (Boulanger08).

pub mod octants;
