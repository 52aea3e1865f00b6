#include "passo/database/database.hpp"

#include <cassert>
#include <utility>

#include "postgres_database.hpp"
#include "sqlite_database.hpp"

namespace passo {
namespace {

template <class T>
const T& value_in(const Value& value) {
  static const T empty{};
  if (std::holds_alternative<Null>(value)) return empty;
  assert(std::holds_alternative<T>(value) && "the column has another type");
  return std::get<T>(value);
}

}  // namespace

std::int64_t Row::number(std::size_t column) const {
  return value_in<std::int64_t>(values_[column]);
}
double Row::real(std::size_t column) const {
  return value_in<double>(values_[column]);
}
const std::string& Row::text(std::size_t column) const {
  return value_in<std::string>(values_[column]);
}
const std::string& Row::bytes(std::size_t column) const {
  return value_in<Bytes>(values_[column]).data;
}

Database::Done Database::transact(const std::function<Done(Database&)>& work) {
  for (int tries = 1;; ++tries) {
    Done done = begin();
    if (done) {
      done = work(*this);
      if (done) done = commit();
      if (done) return done;
      roll_back();
    }
    if (done.error().kind != DatabaseError::Kind::conflict || tries == most_tries) return done;
  }
}

Result<std::unique_ptr<Database>, DatabaseError> open_database(const std::string& where) {
  if (where.starts_with("postgresql://") || where.starts_with("postgres://")) return PostgresDatabase::open(where);
  return SqliteDatabase::open(where);
}

}  // namespace passo
