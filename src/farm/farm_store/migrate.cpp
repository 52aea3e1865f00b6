#include "migrate.hpp"

#include "migrations.hpp"
#include "store_transaction.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

std::string for_engine(std::string_view statements, const Database& database) {
  constexpr std::string_view token = "{identity}";
  std::string text(statements);
  for (std::size_t at = text.find(token); at != std::string::npos; at = text.find(token, at)) {
    text.replace(at, token.size(), database.identity_column());
  }
  return text;
}

// Others who migrate at the same time wait here.
FarmStore::Answer<Unit> lock_versions(Database& database) {
  const Database::Rows locked =
      database.execute("SELECT name FROM farm_migrations WHERE number = 0" + std::string(database.lock_rows()));
  if (!locked) return Failure{store_error(locked.error())};
  return Unit{};
}

FarmStore::Answer<Unit> apply(Database& database, std::size_t number, const Migration& migration) {
  if (auto locked = lock_versions(database); !locked) return locked;
  const Database::Rows known =
      database.execute("SELECT name FROM farm_migrations WHERE number = $1", {static_cast<std::int64_t>(number)});
  if (!known) return Failure{store_error(known.error())};
  if (!known->empty()) return Unit{};
  if (auto done = database.execute_all(for_engine(migration.statements, database)); !done) {
    return Failure{store_error(done.error())};
  }
  const Database::Rows recorded = database.execute("INSERT INTO farm_migrations (number, name) VALUES ($1, $2)",
                                                   {static_cast<std::int64_t>(number), std::string(migration.name)});
  if (!recorded) return Failure{store_error(recorded.error())};
  return Unit{};
}

}  // namespace

FarmStore::Answer<Unit> migrate(Database& database) {
  const auto created = in_transaction(database, [](Database& within) -> FarmStore::Answer<Unit> {
    const auto done = within.execute_all(
        "CREATE TABLE IF NOT EXISTS farm_migrations (number BIGINT PRIMARY KEY, name TEXT NOT NULL);"
        "INSERT INTO farm_migrations (number, name) VALUES (0, 'none') ON CONFLICT (number) DO NOTHING");
    if (done) return Unit{};
    // PostgreSQL says so if another program creates the same table at the same moment.
    if (done.error().kind == DatabaseError::Kind::duplicate) return refuse(StoreRefusal::conflict);
    return Failure{store_error(done.error())};
  });
  if (!created) return created;
  std::size_t number = 0;
  for (const Migration& migration : migrations()) {
    ++number;
    const auto applied = in_transaction(database, [&](Database& within) { return apply(within, number, migration); });
    if (!applied) return applied;
  }
  const Database::Rows newest = database.execute("SELECT max(number) FROM farm_migrations");
  if (!newest) return Failure{store_error(newest.error())};
  if (const std::int64_t last = newest->front().number(0); last > static_cast<std::int64_t>(number)) {
    return Failure{StoreError{
        .text = fmt::format("the tables are of version {}, but this program knows {} versions", last, number)}};
  }
  return Unit{};
}

}  // namespace passo
