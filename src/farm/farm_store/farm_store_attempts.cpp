// FarmStore: what a machine may make, and what became of it.
#include "farm_store_rows.hpp"
#include "store_transaction.hpp"

namespace passo {
namespace {

// Whether the machine is set up for the job.
bool is_set_up(const FarmMachine& machine, const FarmJob& job) {
  const bool has_material = job.material.empty() || has_all(machine.materials, {job.material});
  const bool has_stock = job.stock.empty() || job.stock == machine.stock;
  return has_material && has_stock && has_all(machine.tools, job.tools) && has_all(machine.labels, job.labels);
}

FarmStore::Answer<FarmMachine> find_machine(Database& database, const std::string& name) {
  const auto rows = database.execute("SELECT " + machine_columns + " FROM machines WHERE name = $1", {name});
  if (!rows) return Failure{store_error(rows.error())};
  if (rows->empty()) return refuse(StoreRefusal::no_such_machine);
  return machine_of(rows->front());
}

FarmStore::Answer<std::optional<Attempt>> find_attempt(Database& database, const std::string& id, bool locks) {
  const auto rows = database.execute("SELECT " + attempt_columns + " FROM attempts WHERE id = $1" +
                                         (locks ? std::string(database.lock_rows()) : std::string()),
                                     {id});
  if (!rows) return Failure{store_error(rows.error())};
  if (rows->empty()) return std::optional<Attempt>();
  return std::optional(attempt_of(rows->front()));
}

// Locks the job, so that what is counted of its parts stays true until the end of the transaction.
FarmStore::Answer<FarmJob> lock_job(Database& database, std::int64_t id) {
  const auto locked = database.execute("SELECT id FROM jobs WHERE id = $1" + std::string(database.lock_rows()), {id});
  if (!locked) return Failure{store_error(locked.error())};
  if (locked->empty()) return refuse(StoreRefusal::no_such_job);
  // A statement of its own: PostgreSQL counts what was committed before the statement began.
  const auto rows = database.execute("SELECT " + job_columns + " FROM jobs WHERE id = $1", {id});
  if (!rows) return Failure{store_error(rows.error())};
  return job_of(rows->front());
}

FarmStore::Answer<bool> is_proven(Database& database, const FarmJob& job, const FarmMachine& machine,
                                  const std::string& passo) {
  const auto rows = database.execute(
      "SELECT state FROM checks WHERE program = $1 AND machine_file = $2 AND passo = $3 AND state = $4",
      {job.program, machine.machine_file, passo, number_of(CheckState::good)});
  if (!rows) return Failure{store_error(rows.error())};
  return !rows->empty();
}

// What may follow a state. An attempt that is not known to have started may have ended all the same.
bool may_follow(AttemptState from, AttemptState to) {
  using enum AttemptState;
  switch (from) {
    case claimed: return to == started || to == unknown || to == never_started || to == failed;
    case started: return to == done || to == failed || to == unknown;
    case unknown: return to != claimed;
    default: return false;
  }
}

FarmStore::Answer<Unit> end_job_if_made(Database& database, std::int64_t id) {
  const FarmStore::Answer<FarmJob> job = lock_job(database, id);
  if (!job) return Failure{job.error()};
  if (job->parts_done < job->quantity || job->state != FarmJobState::open) return Unit{};
  const auto ended = database.execute("UPDATE jobs SET state = $2 WHERE id = $1", {id, number_of(FarmJobState::done)});
  if (!ended) return Failure{store_error(ended.error())};
  return Unit{};
}

FarmStore::Answer<std::vector<Attempt>> attempts_where(Database& database, const std::string& condition,
                                                       std::initializer_list<Value> parameters) {
  const auto rows = database.execute(
      "SELECT " + attempt_columns + " FROM attempts WHERE " + condition + " ORDER BY claimed_at, id", parameters);
  if (!rows) return Failure{store_error(rows.error())};
  std::vector<Attempt> attempts;
  for (const Row& row : *rows) attempts.push_back(attempt_of(row));
  return attempts;
}

}  // namespace

std::string_view name_of(AttemptState state) {
  constexpr std::string_view names[] = {"claimed", "started", "unknown", "done", "failed", "never started"};
  return names[static_cast<std::size_t>(state)];
}

FarmStore::Answer<std::vector<Offer>> FarmStore::offers(const std::string& machine) {
  const Answer<FarmMachine> found = find_machine(*database_, machine);
  if (!found) return Failure{found.error()};
  const auto rows = database_->execute(
      "SELECT " + job_columns +
          ", planned_s FROM jobs JOIN (SELECT program AS proven, planned_s FROM checks"
          " WHERE machine_file = $1 AND passo = $2 AND state = $3) AS good ON proven = program WHERE state = $4"
          " ORDER BY priority DESC, CASE WHEN due_at > 0 THEN due_at ELSE 1e300 END, id",
      {found->machine_file, passo_, number_of(CheckState::good), number_of(FarmJobState::open)});
  if (!rows) return Failure{store_error(rows.error())};
  std::vector<Offer> offers;
  for (const Row& row : *rows) {
    const FarmJob job = job_of(row);
    if (job.parts_done + job.parts_open >= job.quantity || !is_set_up(*found, job)) continue;
    offers.push_back({.job = job.id, .planned_s = row.real(row.size() - 1)});
  }
  return offers;
}

FarmStore::Answer<Attempt> FarmStore::claim(const Attempt& wanted, double now) {
  return in_transaction(*database_, [&](Database& within) -> Answer<Attempt> {
    const Answer<FarmJob> job = lock_job(within, wanted.job);
    if (!job) return Failure{job.error()};
    const auto known = find_attempt(within, wanted.id, false);
    if (!known) return Failure{known.error()};
    if (*known) {
      const bool is_same = (*known)->job == wanted.job && (*known)->machine == wanted.machine;
      return is_same ? Answer<Attempt>(**known) : refuse(StoreRefusal::other_attempt);
    }
    const Answer<FarmMachine> machine = find_machine(within, wanted.machine);
    if (!machine) return Failure{machine.error()};
    if (job->state != FarmJobState::open || job->parts_done + job->parts_open >= job->quantity) {
      return refuse(StoreRefusal::job_ended);
    }
    if (!is_set_up(*machine, *job)) return refuse(StoreRefusal::unsuitable);
    const Answer<bool> proven = is_proven(within, *job, *machine, passo_);
    if (!proven) return Failure{proven.error()};
    if (!*proven) return refuse(StoreRefusal::not_proven);
    Attempt attempt = wanted;
    attempt.state = AttemptState::claimed;
    attempt.claimed_at = now;
    const auto added = within.execute(
        "INSERT INTO attempts (" + attempt_columns + ") VALUES ($1, $2, $3, $4, $5, '', $6, 0.0, 0.0)",
        {attempt.id, attempt.job, attempt.machine, attempt.operator_name, number_of(attempt.state), now});
    if (added) return attempt;
    // The index of open attempts decides, also between two programs.
    if (added.error().kind == DatabaseError::Kind::duplicate) return refuse(StoreRefusal::machine_is_taken);
    return Failure{store_error(added.error())};
  });
}

FarmStore::Answer<Attempt> FarmStore::attempt(const std::string& id) {
  const auto found = find_attempt(*database_, id, false);
  if (!found) return Failure{found.error()};
  if (!*found) return refuse(StoreRefusal::no_such_attempt);
  return **found;
}

FarmStore::Answer<std::vector<Attempt>> FarmStore::open_attempts() {
  return attempts_where(*database_, "state < $1", {number_of(AttemptState::done)});
}

FarmStore::Answer<std::vector<Attempt>> FarmStore::attempts_of(std::int64_t job) {
  return attempts_where(*database_, "job = $1", {job});
}

FarmStore::Answer<Attempt> FarmStore::change(const std::string& id, AttemptState to, const std::string& why,
                                             double now) {
  return in_transaction(*database_, [&](Database& within) -> Answer<Attempt> {
    // The job first, as claim() does: two transactions that lock the same rows in another order would block each other.
    const auto known = find_attempt(within, id, false);
    if (!known) return Failure{known.error()};
    if (!*known) return refuse(StoreRefusal::no_such_attempt);
    if (const auto job = lock_job(within, (*known)->job); !job) return Failure{job.error()};
    const auto found = find_attempt(within, id, true);
    if (!found) return Failure{found.error()};
    Attempt attempt = **found;
    if (attempt.state == to) return attempt;
    if (!may_follow(attempt.state, to)) return refuse(StoreRefusal::wrong_state);
    attempt.state = to;
    attempt.why = why;
    if (to == AttemptState::started && attempt.started_at == 0) attempt.started_at = now;
    if (!is_open(to)) attempt.ended_at = now;
    const auto changed =
        within.execute("UPDATE attempts SET state = $2, why = $3, started_at = $4, ended_at = $5 WHERE id = $1",
                       {id, number_of(to), why, attempt.started_at, attempt.ended_at});
    if (!changed) return Failure{store_error(changed.error())};
    if (to == AttemptState::done) {
      if (const auto ended = end_job_if_made(within, attempt.job); !ended) return Failure{ended.error()};
    }
    return attempt;
  });
}

FarmStore::Answer<std::int64_t> FarmStore::doubt_silent(double before) {
  const auto doubted = database_->execute(
      "UPDATE attempts SET state = $1, why = 'the machine is silent' WHERE state IN ($2, $3) AND claimed_at < $4"
      " AND machine IN (SELECT name FROM machines WHERE heard_at < $4) RETURNING id",
      {number_of(AttemptState::unknown), number_of(AttemptState::claimed), number_of(AttemptState::started), before});
  if (!doubted) return Failure{store_error(doubted.error())};
  return static_cast<std::int64_t>(doubted->size());
}

}  // namespace passo
