//! What import and structure find in the shared trees, held against `expected.json` and the truth of
//! the generators: every listed file, exactly, without a single pattern.
