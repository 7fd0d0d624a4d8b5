#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "hal/types/result.hpp"

struct sqlite3;
struct sqlite3_stmt;

namespace rvbench::bench {

/// An SQLite file that is open.
///
/// Errors   refused: the file is locked for longer than two seconds, is no database, cannot be
///          written; the text says which
/// Threads  one caller at a time; several processes may have it open
class SqliteFile {
 public:
  /// Makes the file if there is none. @param shown_as  its name in messages
  static Result<SqliteFile> open(const std::filesystem::path& file,
                                 const std::filesystem::path& shown_as);

  Status execute(const char* sql);  ///< any number of statements, none of which answers
  IoError failure(const std::string& what) const;
  sqlite3* handle() const { return handle_.get(); }
  std::string name() const { return shown_as_.string(); }  ///< as in messages

 private:
  struct Close {
    void operator()(sqlite3* database) const noexcept;
  };

  std::filesystem::path shown_as_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// One SQL statement. Values are bound from ?1 on; columns are counted from 0.
class SqlStatement {
 public:
  SqlStatement(const SqliteFile& file, const char* sql);

  /// Begins it anew with these values: text, double (NaN becomes NULL) or whole numbers.
  template <typename... Values>
  void bind(const Values&... values) {
    restart();
    int at = 0;
    (put(++at, values), ...);
  }

  void bind_all(const std::vector<std::string>& values);

  bool next();                            ///< a further row; false at the end, and on error
  bool is_done() const { return done_; }  ///< the end was reached without an error
  bool run();                             ///< one that answers no row. @return is_done()

  std::string text(int column) const;  ///< or the bytes of a blob, whatever they are
  double number(int column) const;     ///< NaN of NULL
  std::int64_t integer(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept;
  };

  void restart();
  void put(int at, const std::string& value);
  void put(int at, double value);
  void put(int at, std::int64_t value);
  void put(int at, int value) { put(at, std::int64_t{value}); }

  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
  bool done_ = false;
};

/// All or nothing: what was written since is taken back unless commit() was reached.
class SqlTransaction {
 public:
  explicit SqlTransaction(SqliteFile& file);  ///< takes the right to write
  ~SqlTransaction();
  SqlTransaction(const SqlTransaction&) = delete;
  SqlTransaction& operator=(const SqlTransaction&) = delete;

  const Status& begun() const { return begun_; }
  Status commit();

 private:
  SqliteFile& file_;
  Status begun_;
  bool open_ = false;
};

}  // namespace rvbench::bench
