//! Pictures of what was baked
