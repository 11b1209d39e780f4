//! Geometry to facts: roles, leaves, groups, petioles
