#include "bench/results/sqlite.hpp"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cmath>
#include <limits>

namespace rvbench::bench {
namespace {

constexpr int busy_timeout_ms = 2000;

}  // namespace

void SqliteFile::Close::operator()(sqlite3* database) const noexcept { sqlite3_close(database); }

Result<SqliteFile> SqliteFile::open(const std::filesystem::path& file,
                                    const std::filesystem::path& shown_as) {
  sqlite3* opened = nullptr;
  const int code =
      sqlite3_open_v2(file.c_str(), &opened, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  SqliteFile database;
  database.shown_as_ = shown_as;
  database.handle_.reset(opened);
  if (code != SQLITE_OK) return database.failure("cannot be opened");
  sqlite3_busy_timeout(opened, busy_timeout_ms);
  return database;
}

Status SqliteFile::execute(const char* sql) {
  if (sqlite3_exec(handle_.get(), sql, nullptr, nullptr, nullptr) == SQLITE_OK) return Done{};
  return failure("cannot be used");
}

IoError SqliteFile::failure(const std::string& what) const {
  return {IoErrc::refused,
          fmt::format("{} {}: {}", shown_as_.string(), what, sqlite3_errmsg(handle_.get()))};
}

void SqlStatement::Finalize::operator()(sqlite3_stmt* statement) const noexcept {
  sqlite3_finalize(statement);
}

// One that cannot be prepared has no rows and never comes to its end: is_done() tells.
SqlStatement::SqlStatement(const SqliteFile& file, const char* sql) {
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(file.handle(), sql, -1, &statement, nullptr);
  statement_.reset(statement);
}

void SqlStatement::restart() {
  done_ = false;
  sqlite3_reset(statement_.get());
}

void SqlStatement::put(int at, const std::string& value) {
  sqlite3_bind_text(statement_.get(), at, value.data(), static_cast<int>(value.size()),
                    SQLITE_TRANSIENT);
}

void SqlStatement::put(int at, double value) {
  std::isnan(value) ? sqlite3_bind_null(statement_.get(), at)
                    : sqlite3_bind_double(statement_.get(), at, value);
}

void SqlStatement::put(int at, std::int64_t value) {
  sqlite3_bind_int64(statement_.get(), at, value);
}

void SqlStatement::bind_all(const std::vector<std::string>& values) {
  restart();
  int at = 0;
  for (const std::string& value : values) put(++at, value);
}

bool SqlStatement::next() {
  if (!statement_ || done_) return false;
  const int code = sqlite3_step(statement_.get());
  done_ = code == SQLITE_DONE;
  return code == SQLITE_ROW;
}

bool SqlStatement::run() {
  while (next()) {
  }
  return done_;
}

std::string SqlStatement::text(int column) const {
  const auto* bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  const int count = sqlite3_column_bytes(statement_.get(), column);
  return bytes == nullptr ? "" : std::string(bytes, static_cast<std::size_t>(count));
}

double SqlStatement::number(int column) const {
  if (sqlite3_column_type(statement_.get(), column) == SQLITE_NULL) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return sqlite3_column_double(statement_.get(), column);
}

std::int64_t SqlStatement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

SqlTransaction::SqlTransaction(SqliteFile& file)
    : file_(file), begun_(file.execute("BEGIN IMMEDIATE")) {
  open_ = bool(begun_);
}

SqlTransaction::~SqlTransaction() {
  if (open_) (void)file_.execute("ROLLBACK");
}

Status SqlTransaction::commit() {
  const Status done = file_.execute("COMMIT");
  open_ = !done;
  return done;
}

}  // namespace rvbench::bench
