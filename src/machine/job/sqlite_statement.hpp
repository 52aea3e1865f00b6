// SqliteStatement: one statement. Values are bound in order, and columns read in order. Private to job/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <sqlite3.h>

namespace passo {

class SqliteStatement {
 public:
  SqliteStatement(sqlite3* database, const char* sql) { sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr); }
  SqliteStatement(const SqliteStatement&) = delete;
  SqliteStatement& operator=(const SqliteStatement&) = delete;
  ~SqliteStatement() { sqlite3_finalize(statement_); }

  SqliteStatement& with(std::int64_t value) {
    sqlite3_bind_int64(statement_, ++bound_, value);
    return *this;
  }
  SqliteStatement& with(double value) {
    sqlite3_bind_double(statement_, ++bound_, value);
    return *this;
  }
  // The text outlives the statement.
  SqliteStatement& with(std::string_view value) {
    sqlite3_bind_text64(statement_, ++bound_, value.data(), value.size(), SQLITE_STATIC, SQLITE_UTF8);
    return *this;
  }
  SqliteStatement& with_bytes(std::string_view value) {
    sqlite3_bind_blob64(statement_, ++bound_, value.data(), value.size(), SQLITE_STATIC);
    return *this;
  }

  // False: the database has no such tables or columns.
  bool is_good() const { return statement_ != nullptr; }
  // True: there is a row.
  bool step() {
    read_ = -1;
    return statement_ != nullptr && sqlite3_step(statement_) == SQLITE_ROW;
  }
  bool run() { return statement_ != nullptr && sqlite3_step(statement_) == SQLITE_DONE; }

  std::int64_t number() { return sqlite3_column_int64(statement_, ++read_); }
  double real() { return sqlite3_column_double(statement_, ++read_); }
  std::string text() {
    const void* const bytes = sqlite3_column_blob(statement_, ++read_);
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement_, read_));
    return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
  int read_ = -1;
};

}  // namespace passo
