#include "sqlite_database.hpp"

#include <utility>

#include <fmt/format.h>
#include <sqlite3.h>

namespace passo {
namespace {

constexpr int wait_for_others_ms = 10'000;

struct Finalize {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

// Binds one parameter. The values outlive the statement.
struct Bind {
  sqlite3_stmt* statement;
  int at;
  int operator()(Null) const { return sqlite3_bind_null(statement, at); }
  int operator()(std::int64_t value) const { return sqlite3_bind_int64(statement, at, value); }
  int operator()(double value) const { return sqlite3_bind_double(statement, at, value); }
  int operator()(const std::string& value) const {
    return sqlite3_bind_text64(statement, at, value.data(), value.size(), SQLITE_STATIC, SQLITE_UTF8);
  }
  int operator()(const Bytes& value) const {
    return sqlite3_bind_blob64(statement, at, value.data.data(), value.data.size(), SQLITE_STATIC);
  }
};

Value value_of(sqlite3_stmt* statement, int column) {
  const auto bytes = [&](const void* data) {
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(statement, column));
    return data == nullptr ? std::string() : std::string(static_cast<const char*>(data), size);
  };
  switch (sqlite3_column_type(statement, column)) {
    case SQLITE_INTEGER: return std::int64_t{sqlite3_column_int64(statement, column)};
    case SQLITE_FLOAT: return sqlite3_column_double(statement, column);
    case SQLITE_TEXT: return bytes(sqlite3_column_text(statement, column));
    case SQLITE_BLOB: return Bytes{bytes(sqlite3_column_blob(statement, column))};
    default: return Null{};
  }
}

}  // namespace

Result<std::unique_ptr<Database>, DatabaseError> SqliteDatabase::open(const std::string& file) {
  sqlite3* connection = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_NOFOLLOW;
  const int opened = sqlite3_open_v2(file.c_str(), &connection, flags, nullptr);
  std::unique_ptr<SqliteDatabase> database(new SqliteDatabase(connection));
  if (opened != SQLITE_OK) return Failure{database->error()};
  sqlite3_extended_result_codes(connection, 1);
  sqlite3_busy_timeout(connection, wait_for_others_ms);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  // FULL: what was committed survives a power failure. An attempt that has started must not be forgotten.
  const Done set =
      database->execute_all("PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON");
  if (!set) return Failure{set.error()};
  return std::unique_ptr<Database>(std::move(database));
}

SqliteDatabase::~SqliteDatabase() {
  sqlite3_close_v2(connection_);
}

Database::Rows SqliteDatabase::execute(std::string_view statement, std::span<const Value> parameters) {
  sqlite3_stmt* prepared = nullptr;
  if (sqlite3_prepare_v2(connection_, statement.data(), static_cast<int>(statement.size()), &prepared, nullptr) !=
      SQLITE_OK) {
    return Failure{error()};
  }
  const Statement owner(prepared);
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const int at = sqlite3_bind_parameter_index(prepared, fmt::format("${}", i + 1).c_str());
    if (at == 0) continue;  // not used
    if (std::visit(Bind{prepared, at}, parameters[i]) != SQLITE_OK) return Failure{error()};
  }
  std::vector<Row> rows;
  const int columns = sqlite3_column_count(prepared);
  int step = SQLITE_OK;
  while ((step = sqlite3_step(prepared)) == SQLITE_ROW) {
    std::vector<Value> values;
    for (int column = 0; column < columns; ++column) values.push_back(value_of(prepared, column));
    rows.emplace_back(std::move(values));
  }
  if (step != SQLITE_DONE) return Failure{error()};
  return rows;
}

Database::Done SqliteDatabase::execute_all(const std::string& statements) {
  if (sqlite3_exec(connection_, statements.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) return Failure{error()};
  return Unit{};
}

// Some errors have rolled back already.
void SqliteDatabase::roll_back() {
  if (sqlite3_get_autocommit(connection_) == 0) static_cast<void>(execute_all("ROLLBACK"));
}

DatabaseError SqliteDatabase::error() const {
  if (connection_ == nullptr) return {DatabaseError::Kind::other, "no memory"};
  using Kind = DatabaseError::Kind;
  Kind kind = Kind::other;
  switch (sqlite3_extended_errcode(connection_)) {
    case SQLITE_CONSTRAINT_UNIQUE:
    case SQLITE_CONSTRAINT_PRIMARYKEY: kind = Kind::duplicate; break;
    default:
      switch (sqlite3_errcode(connection_) & 0xff) {
        case SQLITE_BUSY:
        case SQLITE_LOCKED: kind = Kind::conflict; break;
        case SQLITE_CANTOPEN: kind = Kind::unreachable; break;
        default: break;
      }
  }
  return {kind, sqlite3_errmsg(connection_)};
}

}  // namespace passo
