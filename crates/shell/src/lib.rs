//! Flags, configuration, exit status, reports; the commands of foliar
