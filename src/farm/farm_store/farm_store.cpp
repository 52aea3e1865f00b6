#include "passo/farm_store/farm_store.hpp"

#include <array>

#include "farm_store_rows.hpp"
#include "migrate.hpp"
#include "store_transaction.hpp"
#include <fmt/format.h>
#include <sodium.h>

namespace passo {
namespace {

std::string hash_of(const std::string& data) {
  std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
  crypto_hash_sha256(hash.data(), reinterpret_cast<const unsigned char*>(data.data()), data.size());
  std::string text;
  for (const unsigned char byte : hash) text += fmt::format("{:02x}", byte);
  return text;
}

}  // namespace

FarmStore::Answer<FarmStore> FarmStore::open(Database& database, std::string passo) {
  if (const auto migrated = migrate(database); !migrated) return Failure{migrated.error()};
  return FarmStore(database, std::move(passo));
}

FarmStore::Answer<std::string> FarmStore::add_contents(const std::string& data) {
  std::string hash = hash_of(data);
  const auto added = database_->execute(
      "INSERT INTO contents (hash, data) VALUES ($1, $2) ON CONFLICT (hash) DO NOTHING", {hash, Bytes{data}});
  if (!added) return Failure{store_error(added.error())};
  return hash;
}

FarmStore::Answer<std::optional<std::string>> FarmStore::contents(const std::string& hash) {
  const auto rows = database_->execute("SELECT data FROM contents WHERE hash = $1", {hash});
  if (!rows) return Failure{store_error(rows.error())};
  if (rows->empty()) return std::optional<std::string>();
  return std::optional(rows->front().bytes(0));
}

FarmStore::Answer<Unit> FarmStore::put_machine(const FarmMachine& machine) {
  const auto put = database_->execute(
      "INSERT INTO machines (" + machine_columns +
          ") VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10) ON CONFLICT (name) DO UPDATE SET url = $2, token = $3,"
          " machine_file = $4, labels = $5, materials = $6, tools = $7, stock = $8",
      {machine.name, machine.url, machine.token, machine.machine_file, joined(in_order(machine.labels)),
       joined(in_order(machine.materials)), joined(in_order(machine.tools)), machine.stock, machine.heard_at,
       machine.status});
  if (put) return Unit{};
  if (put.error().kind == DatabaseError::Kind::duplicate) return refuse(StoreRefusal::url_in_use);
  return Failure{store_error(put.error())};
}

FarmStore::Answer<std::vector<FarmMachine>> FarmStore::machines() {
  const auto rows = database_->execute("SELECT " + machine_columns + " FROM machines ORDER BY name");
  if (!rows) return Failure{store_error(rows.error())};
  std::vector<FarmMachine> machines;
  for (const Row& row : *rows) machines.push_back(machine_of(row));
  return machines;
}

FarmStore::Answer<Unit> FarmStore::hear(const std::string& name, const std::string& status, double now) {
  const auto heard = database_->execute("UPDATE machines SET status = $2, heard_at = $3 WHERE name = $1 RETURNING name",
                                        {name, status, now});
  if (!heard) return Failure{store_error(heard.error())};
  if (heard->empty()) return refuse(StoreRefusal::no_such_machine);
  return Unit{};
}

FarmStore::Answer<std::int64_t> FarmStore::add_job(const FarmJob& job) {
  const auto added = database_->execute(
      "INSERT INTO jobs (name, program, quantity, material, tools, stock, labels, priority, due_at, owner, state,"
      " created_at) VALUES ($1, $2, $3, $4, $5, $6, $7, $8, $9, $10, $11, $12) RETURNING id",
      {job.name, job.program, job.quantity, job.material, joined(in_order(job.tools)), job.stock,
       joined(in_order(job.labels)), job.priority, job.due_at, job.owner, number_of(FarmJobState::open),
       job.created_at});
  if (!added) return Failure{store_error(added.error())};
  return added->front().number(0);
}

FarmStore::Answer<std::vector<FarmJob>> FarmStore::jobs(FarmJobState state) {
  const auto rows =
      database_->execute("SELECT " + job_columns + " FROM jobs WHERE state = $1 ORDER BY id", {number_of(state)});
  if (!rows) return Failure{store_error(rows.error())};
  std::vector<FarmJob> jobs;
  for (const Row& row : *rows) jobs.push_back(job_of(row));
  return jobs;
}

FarmStore::Answer<Unit> FarmStore::cancel_job(std::int64_t id) {
  const auto cancelled = database_->execute("UPDATE jobs SET state = $2 WHERE id = $1 AND state <> $3 RETURNING id",
                                            {id, number_of(FarmJobState::cancelled), number_of(FarmJobState::done)});
  if (!cancelled) return Failure{store_error(cancelled.error())};
  if (!cancelled->empty()) return Unit{};
  const auto known = database_->execute("SELECT id FROM jobs WHERE id = $1", {id});
  if (!known) return Failure{store_error(known.error())};
  return refuse(known->empty() ? StoreRefusal::no_such_job : StoreRefusal::job_ended);
}

}  // namespace passo
