#pragma once

#include "bench/judgement.hpp"
#include "bench/limits_versions.hpp"
#include "bench/qualification/station_records.hpp"
#include "bench/result_database.hpp"
#include "bench/results/sqlite.hpp"

/// Rows of the tables of results/schema.cpp. Errors  refused, as SqliteFile; the caller has begun
/// the transaction.
namespace rvbench::bench {

/// The run with all it measured and found, in place of what was entered of it before; its later
/// judgements stay.
Status enter_run(SqliteFile& file, const RunRow& row, const Judgement& judgement);

/// One judgement of a run that has been entered.
Status enter_judgement_row(SqliteFile& file, const JudgementRow& row);

/// A version of limits and how far it has come; writes nothing where that is there already.
Status enter_limits_version(SqliteFile& file, const LimitsVersion& limits);

/// Records of stations; those that are there already stay, for a record never changes.
Status enter_station_records(SqliteFile& file, const StationRecords& records);

}  // namespace rvbench::bench
