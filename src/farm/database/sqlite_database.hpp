// SqliteDatabase: a Database in a file of this computer. Several processes may use it: each transaction locks the whole
// file, and others wait for it. Private to database/.
#pragma once

#include "passo/database/database.hpp"

struct sqlite3;

namespace passo {

class SqliteDatabase final : public Database {
 public:
  static Result<std::unique_ptr<Database>, DatabaseError> open(const std::string& file);
  ~SqliteDatabase() override;

  using Database::execute;
  Rows execute(std::string_view statement, std::span<const Value> parameters) override;
  Done execute_all(const std::string& statements) override;
  std::string_view identity_column() const override { return "INTEGER PRIMARY KEY AUTOINCREMENT"; }
  std::string_view lock_rows() const override { return ""; }
  std::string_view skip_locked() const override { return ""; }

 private:
  explicit SqliteDatabase(sqlite3* connection) : connection_(connection) {}
  Done begin() override { return execute_all("BEGIN IMMEDIATE"); }
  Done commit() override { return execute_all("COMMIT"); }
  void roll_back() override;
  DatabaseError error() const;

  sqlite3* connection_;
};

}  // namespace passo
