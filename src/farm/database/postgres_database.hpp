// PostgresDatabase: a Database on a PostgreSQL server, 15 or newer, by libpq. Private to database/.
#pragma once

#include "passo/database/database.hpp"

struct pg_conn;
struct pg_result;

namespace passo {

class PostgresDatabase final : public Database {
 public:
  static Result<std::unique_ptr<Database>, DatabaseError> open(const std::string& url);
  ~PostgresDatabase() override;

  using Database::execute;
  Rows execute(std::string_view statement, std::span<const Value> parameters) override;
  Done execute_all(const std::string& statements) override;
  std::string_view identity_column() const override { return "BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY"; }
  std::string_view lock_rows() const override { return " FOR UPDATE"; }
  std::string_view skip_locked() const override { return " FOR UPDATE SKIP LOCKED"; }

 private:
  explicit PostgresDatabase(pg_conn* connection) : connection_(connection) {}
  Done begin() override;
  Done commit() override;
  void roll_back() override;
  Done connect_again();
  // The error of a result, or of the connection if there is none.
  DatabaseError error(const pg_result* result) const;

  pg_conn* connection_;
  bool in_transaction_ = false;
};

}  // namespace passo
