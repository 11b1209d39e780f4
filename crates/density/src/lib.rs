//! Metaball density: ambient coefficient k_a and realigned normals (Luft07)
