#include "postgres_database.hpp"

#include <charconv>
#include <cstdlib>
#include <utility>

#include <fmt/format.h>
#include <libpq-fe.h>

namespace passo {
namespace {

using Kind = DatabaseError::Kind;

constexpr int oldest_server = 150000;

// Types of columns: src/include/catalog/pg_type.dat.
constexpr Oid type_bytea = 17;
constexpr Oid type_int8 = 20;
constexpr Oid type_int2 = 21;
constexpr Oid type_int4 = 23;
constexpr Oid type_text = 25;
constexpr Oid type_float8 = 701;

struct Clear {
  void operator()(PGresult* result) const { PQclear(result); }
};
using Answer = std::unique_ptr<PGresult, Clear>;

// The parameters of a statement in the form of PQexecParams: numbers as text, bytes as they are.
class Parameters {
 public:
  explicit Parameters(std::span<const Value> values) {
    texts_.reserve(values.size());
    for (const Value& value : values) std::visit([this](const auto& one) { add(one); }, value);
  }
  int size() const { return static_cast<int>(types_.size()); }
  const Oid* types() const { return types_.data(); }
  const char* const* values() const { return values_.data(); }
  const int* lengths() const { return lengths_.data(); }
  const int* formats() const { return formats_.data(); }

 private:
  void add(Null) { put(0, nullptr, 0, 0); }
  void add(std::int64_t value) { put_text(type_int8, fmt::format("{}", value)); }
  void add(double value) { put_text(type_float8, fmt::format("{}", value)); }
  void add(const std::string& value) { put(type_text, value.data(), value.size(), 1); }
  void add(const Bytes& value) { put(type_bytea, value.data.data(), value.data.size(), 1); }
  void put_text(Oid type, std::string text) {
    texts_.push_back(std::move(text));
    put(type, texts_.back().c_str(), 0, 0);
  }
  void put(Oid type, const char* value, std::size_t length, int format) {
    types_.push_back(type);
    values_.push_back(value);
    lengths_.push_back(static_cast<int>(length));
    formats_.push_back(format);
  }

  std::vector<std::string> texts_;  // never grows beyond what was reserved, since values_ points into it
  std::vector<Oid> types_;
  std::vector<const char*> values_;
  std::vector<int> lengths_;
  std::vector<int> formats_;
};

template <class T>
T number_in(std::string_view text) {
  T value{};
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

std::string bytes_in(const char* hexadecimal) {
  std::size_t size = 0;
  unsigned char* const data = PQunescapeBytea(reinterpret_cast<const unsigned char*>(hexadecimal), &size);
  std::string bytes(reinterpret_cast<const char*>(data), size);
  PQfreemem(data);
  return bytes;
}

Value value_of(const PGresult* result, int row, int column) {
  if (PQgetisnull(result, row, column) != 0) return Null{};
  const char* const text = PQgetvalue(result, row, column);
  const std::string_view all(text, static_cast<std::size_t>(PQgetlength(result, row, column)));
  switch (PQftype(result, column)) {
    case type_int2:
    case type_int4:
    case type_int8: return number_in<std::int64_t>(all);
    case type_float8: return number_in<double>(all);
    case type_bytea: return Bytes{bytes_in(text)};
    default: return std::string(all);
  }
}

// Appendix A of the documentation: the first two characters are the class.
Kind kind_of(std::string_view state) {
  if (state == "23505") return Kind::duplicate;
  if (state == "40001" || state == "40P01" || state == "55P03") return Kind::conflict;
  if (state.starts_with("08") || state.starts_with("57P")) return Kind::unreachable;
  return Kind::other;
}

void ignore_notice(void* /*nothing*/, const PGresult* /*notice*/) {}

}  // namespace

Result<std::unique_ptr<Database>, DatabaseError> PostgresDatabase::open(const std::string& url) {
  PGconn* const connection = PQconnectdb(url.c_str());
  std::unique_ptr<PostgresDatabase> database(new PostgresDatabase(connection));
  if (PQstatus(connection) != CONNECTION_OK)
    return Failure{DatabaseError{Kind::unreachable, PQerrorMessage(connection)}};
  if (PQserverVersion(connection) < oldest_server) {
    return Failure{DatabaseError{Kind::other, fmt::format("the server is PostgreSQL {}, but Passo needs 15 or newer",
                                                          PQparameterStatus(connection, "server_version"))}};
  }
  PQsetNoticeReceiver(connection, ignore_notice, nullptr);
  return std::unique_ptr<Database>(std::move(database));
}

PostgresDatabase::~PostgresDatabase() {
  PQfinish(connection_);
}

Database::Rows PostgresDatabase::execute(std::string_view statement, std::span<const Value> parameters) {
  if (const Done connected = connect_again(); !connected) return Failure{connected.error()};
  const Parameters with(parameters);
  const Answer answer(PQexecParams(connection_, std::string(statement).c_str(), with.size(), with.types(),
                                   with.values(), with.lengths(), with.formats(), 0));
  const ExecStatusType status = PQresultStatus(answer.get());
  if (status != PGRES_TUPLES_OK && status != PGRES_COMMAND_OK) return Failure{error(answer.get())};
  std::vector<Row> rows;
  rows.reserve(static_cast<std::size_t>(PQntuples(answer.get())));
  for (int row = 0; row < PQntuples(answer.get()); ++row) {
    std::vector<Value> values;
    for (int column = 0; column < PQnfields(answer.get()); ++column) {
      values.push_back(value_of(answer.get(), row, column));
    }
    rows.emplace_back(std::move(values));
  }
  return rows;
}

Database::Done PostgresDatabase::execute_all(const std::string& statements) {
  if (Done connected = connect_again(); !connected) return connected;
  const Answer answer(PQexec(connection_, statements.c_str()));
  const ExecStatusType status = PQresultStatus(answer.get());
  if (status != PGRES_TUPLES_OK && status != PGRES_COMMAND_OK) return Failure{error(answer.get())};
  return Unit{};
}

Database::Done PostgresDatabase::begin() {
  Done begun = execute_all("BEGIN");
  in_transaction_ = begun.has_value();
  return begun;
}

// A COMMIT of a transaction in which a statement has failed is answered with ROLLBACK.
Database::Done PostgresDatabase::commit() {
  const Answer answer(PQexec(connection_, "COMMIT"));
  if (PQresultStatus(answer.get()) != PGRES_COMMAND_OK) return Failure{error(answer.get())};
  if (std::string_view(PQcmdStatus(answer.get())) != "COMMIT") {
    return Failure{DatabaseError{Kind::other, "a statement of the transaction has failed"}};
  }
  in_transaction_ = false;
  return Unit{};
}

void PostgresDatabase::roll_back() {
  in_transaction_ = false;
  if (PQstatus(connection_) == CONNECTION_OK) static_cast<void>(execute_all("ROLLBACK"));
}

Database::Done PostgresDatabase::connect_again() {
  if (PQstatus(connection_) == CONNECTION_OK) return Unit{};
  if (!in_transaction_) PQreset(connection_);
  if (PQstatus(connection_) == CONNECTION_OK) return Unit{};
  return Failure{DatabaseError{Kind::unreachable, PQerrorMessage(connection_)}};
}

DatabaseError PostgresDatabase::error(const PGresult* result) const {
  const char* const state = result != nullptr ? PQresultErrorField(result, PG_DIAG_SQLSTATE) : nullptr;
  std::string text = result != nullptr ? PQresultErrorMessage(result) : PQerrorMessage(connection_);
  while (text.ends_with('\n')) text.pop_back();
  // Errors that libpq finds by itself have no code. They are those of the connection, which may look good until the
  // next call.
  return {state != nullptr ? kind_of(state) : Kind::unreachable, std::move(text)};
}

}  // namespace passo
