#pragma once

#include "bench/results/sqlite.hpp"

namespace rvbench::bench {

/// The version of the tables that this program writes: PRAGMA user_version. A change of the tables
/// is a further step in schema.cpp; steps that are there are never changed.
extern const int schema_version;

/// Brings the tables of an older file, or of a new one, up to date: all steps or none.
/// Errors  refused: the file cannot be written, or is of a newer version, which the text names
Status bring_up_to_date(SqliteFile& file);

}  // namespace rvbench::bench
