//! The programs of foliar, five lines each
