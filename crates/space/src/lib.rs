//! Ray casting, closest points, grids
