// Database: SQL statements and transactions, on SQLite or on PostgreSQL.
//
// Purpose: one store for both engines. All statements are written in the subset that both understand: parameters are
// $1, $2, …; the types are BIGINT, DOUBLE PRECISION, TEXT and BYTEA; upserts use ON CONFLICT, and RETURNING returns
// rows. What differs is in open_database(), identity_column(), lock_rows() and skip_locked().
//
// A connection belongs to one thread. After a lost connection, a call outside a transaction connects again; inside one
// it fails with `unreachable` until the end of the transaction, because the server has rolled back what came before.
//
// Sources: PostgreSQL 15 documentation, chapters 34 (libpq), 13.3 (explicit locking) and appendix A (error codes);
// SQLite documentation, "Result and Error Codes" and "SQLite As An Application File Format".
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "passo/base/result.hpp"

namespace passo {

struct DatabaseError {
  enum class Kind : std::uint8_t {
    unreachable,  // no connection, or the connection was lost: a commit may or may not have happened
    conflict,     // with another transaction: try again
    duplicate,    // a UNIQUE or PRIMARY KEY constraint
    other,        // a wrong statement, a full disk, a constraint
  };
  Kind kind = Kind::other;
  std::string text;  // of the engine, for the log
};

struct Null {
  friend bool operator==(const Null&, const Null&) = default;
};
// Binary data, in a column of the type BYTEA.
struct Bytes {
  std::string data;
  friend bool operator==(const Bytes&, const Bytes&) = default;
};
using Value = std::variant<Null, std::int64_t, double, std::string, Bytes>;

// A row of a result. The accessors return an empty value for NULL; another type than the column's is a bug of the
// caller.
class Row {
 public:
  explicit Row(std::vector<Value> values) : values_(std::move(values)) {}
  std::size_t size() const { return values_.size(); }
  const Value& operator[](std::size_t column) const { return values_[column]; }
  bool is_null(std::size_t column) const { return std::holds_alternative<Null>(values_[column]); }
  std::int64_t number(std::size_t column) const;
  double real(std::size_t column) const;
  const std::string& text(std::size_t column) const;
  const std::string& bytes(std::size_t column) const;

 private:
  std::vector<Value> values_;
};

class Database {
 public:
  using Rows = Result<std::vector<Row>, DatabaseError>;
  using Done = Status<DatabaseError>;

  Database() = default;
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;
  virtual ~Database() = default;

  // Executes one statement and returns its rows: of SELECT, or of RETURNING.
  virtual Rows execute(std::string_view statement, std::span<const Value> parameters) = 0;
  Rows execute(std::string_view statement, std::initializer_list<Value> parameters = {}) {
    return execute(statement, std::span<const Value>(parameters.begin(), parameters.size()));
  }
  // Executes several statements without parameters, separated by semicolons.
  virtual Done execute_all(const std::string& statements) = 0;

  // Calls `work` in a transaction. It commits if `work` succeeds, and rolls back if it fails. On a conflict with
  // another transaction `work` is called again, at most most_tries times; it must have no effects outside the database.
  Done transact(const std::function<Done(Database&)>& work);
  static constexpr int most_tries = 20;

  // The definition of a primary key that numbers the rows from 1, and never uses a number again.
  virtual std::string_view identity_column() const = 0;
  // The end of a SELECT that locks its rows until the end of the transaction; and of one that passes over rows that
  // another transaction has locked. Empty where a transaction locks the whole database.
  virtual std::string_view lock_rows() const = 0;
  virtual std::string_view skip_locked() const = 0;

 protected:
  virtual Done begin() = 0;
  virtual Done commit() = 0;
  virtual void roll_back() = 0;
};

// Opens a database, or creates the file. `where`: a URL "postgresql://…" (libpq's connection URI), or the path of an
// SQLite file.
Result<std::unique_ptr<Database>, DatabaseError> open_database(const std::string& where);

}  // namespace passo
