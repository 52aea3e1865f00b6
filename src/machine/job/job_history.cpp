#include "passo/job/job_history.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "sqlite_statement.hpp"
#include <fmt/format.h>

#include "passo/base/fingerprint.hpp"

namespace passo {
namespace {

constexpr int version = 1;
constexpr const char* tables = R"(
  CREATE TABLE jobs (
    id INTEGER PRIMARY KEY AUTOINCREMENT, name TEXT NOT NULL, dialect TEXT NOT NULL, bytes INTEGER NOT NULL,
    state INTEGER NOT NULL, why TEXT NOT NULL DEFAULT '', queued_at REAL NOT NULL, begun_at REAL NOT NULL DEFAULT 0,
    ended_at REAL NOT NULL DEFAULT 0, program BLOB);
  CREATE INDEX jobs_by_state ON jobs (state, id);
  CREATE TABLE alarms (id INTEGER PRIMARY KEY AUTOINCREMENT, at REAL NOT NULL, words TEXT NOT NULL);
  PRAGMA user_version = 1;)";
// Younger than the others, and of no use to older programs: the version stays.
constexpr const char* table_of_waits = R"(
  CREATE TABLE IF NOT EXISTS waits (
    job INTEGER NOT NULL, number INTEGER NOT NULL, at REAL NOT NULL, code TEXT NOT NULL, line INTEGER NOT NULL,
    tool INTEGER NOT NULL, words TEXT NOT NULL, PRIMARY KEY (job, number)) WITHOUT ROWID;)";
constexpr const char* table_of_stills = R"(
  CREATE TABLE IF NOT EXISTS stills (
    id INTEGER PRIMARY KEY AUTOINCREMENT, job INTEGER NOT NULL, at REAL NOT NULL, moment TEXT NOT NULL,
    jpeg BLOB NOT NULL);
  CREATE INDEX IF NOT EXISTS stills_by_job ON stills (job, id);)";
// Younger, too. Older programs write no sentence beside their words.
constexpr const char* column_of_sentence = "ALTER TABLE {} ADD COLUMN sentence TEXT NOT NULL DEFAULT ''";
// Younger, too: the ids that clients have given to jobs, and what their programs were, also when these are deleted.
constexpr const char* table_of_attempts = R"(
  CREATE TABLE IF NOT EXISTS attempts (
    attempt TEXT PRIMARY KEY, job INTEGER NOT NULL, fingerprint INTEGER NOT NULL) WITHOUT ROWID;
  CREATE INDEX IF NOT EXISTS attempts_by_job ON attempts (job);)";
constexpr std::string_view killed = "passo serve was killed, or the computer lost power";
constexpr std::string_view killed_sentence =
    R"({"code":"job.killed","arguments":{},"text":"passo serve was killed, or the computer lost power"})";
constexpr std::int64_t no_tool = -1;

constexpr std::int64_t number_of(HistoryState state) {
  return static_cast<std::int64_t>(state);
}

}  // namespace

std::string_view name_of(HistoryState state) {
  constexpr std::string_view names[] = {"queued", "running", "done", "stopped", "failed", "interrupted"};
  return names[static_cast<std::size_t>(state)];
}

Result<std::unique_ptr<JobHistory>, std::string> JobHistory::open(const std::string& file) {
  sqlite3* database = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_NOFOLLOW;
  const int opened = sqlite3_open_v2(file.c_str(), &database, flags, nullptr);
  std::unique_ptr<JobHistory> history(new JobHistory(database));
  const auto failed = [&](const std::string& reason) { return Failure{file + ": " + reason}; };
  const auto reason = [&] { return std::string(database != nullptr ? sqlite3_errmsg(database) : "no memory"); };
  if (opened != SQLITE_OK) return failed(reason());
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  // Another program that writes would be at the same machine. The lock lasts until the end.
  if (!history->run("PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;"
                    "PRAGMA wal_autocheckpoint = 0; BEGIN IMMEDIATE; COMMIT;")) {
    return failed(reason());
  }
  {
    SqliteStatement check(database, "PRAGMA quick_check(1)");
    if (!check.step()) return failed(reason());
    if (const std::string found = check.text(); found != "ok") return failed("it is damaged: " + found);
  }
  std::int64_t known = 0;
  {
    SqliteStatement of(database, "PRAGMA user_version");
    if (of.step()) known = of.number();
  }
  if (known > version) return failed(fmt::format("its version is {}, but this program supports {}", known, version));
  if (known == 0 && !history->run(fmt::format("BEGIN;{}COMMIT;", tables).c_str())) return failed(reason());
  for (const char* const table : {table_of_waits, table_of_stills, table_of_attempts}) {
    if (!history->run(table)) return failed(reason());
  }
  for (const char* const table : {"jobs", "alarms"}) {
    SqliteStatement column(database, fmt::format("SELECT sentence FROM {} LIMIT 0", table).c_str());
    if (column.is_good()) continue;
    if (!history->run(fmt::format(fmt::runtime(column_of_sentence), table).c_str())) return failed(reason());
  }
  SqliteStatement interrupt(database, "UPDATE jobs SET state = ?, why = ?, sentence = ? WHERE state = ?");
  interrupt.with(number_of(HistoryState::interrupted)).with(killed).with(killed_sentence);
  interrupt.with(number_of(HistoryState::running));
  if (!interrupt.run()) return failed(reason());
  return history;
}

JobHistory::~JobHistory() {
  keep();
  sqlite3_close_v2(database_);
}

bool JobHistory::run(const char* sql) const {
  return sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) == SQLITE_OK;
}

bool JobHistory::judge(bool done) {
  trouble_ = done ? std::string() : sqlite3_errmsg(database_);
  return done;
}

std::optional<std::int64_t> JobHistory::insert(HistoryState state, std::string_view name, std::string_view dialect,
                                               std::string_view program, double now) {
  SqliteStatement insert(database_,
                         "INSERT INTO jobs (name, dialect, bytes, state, queued_at, begun_at, program)"
                         " VALUES (?, ?, ?, ?, ?, ?, ?)");
  insert.with(name).with(dialect).with(static_cast<std::int64_t>(program.size())).with(number_of(state)).with(now);
  insert.with(state == HistoryState::running ? now : 0.0).with_bytes(program);
  is_kept_ = false;
  if (!judge(insert.run())) return {};
  return sqlite3_last_insert_rowid(database_);
}

std::optional<std::int64_t> JobHistory::add(std::string_view name, std::string_view dialect, std::string_view program,
                                            double now) {
  SqliteStatement count(database_, "SELECT count(*) FROM jobs WHERE state = ?");
  count.with(number_of(HistoryState::queued));
  if (!judge(count.step()) || count.number() >= static_cast<std::int64_t>(most_queued)) return {};
  return insert(HistoryState::queued, name, dialect, program, now);
}

std::optional<std::int64_t> JobHistory::add_running(std::string_view name, std::string_view dialect,
                                                    std::string_view program, double now) {
  return insert(HistoryState::running, name, dialect, program, now);
}

// One transaction: a job without its attempt could be queued twice.
JobHistory::Attempt JobHistory::add_attempt(std::string_view attempt, std::string_view name, std::string_view dialect,
                                            std::string_view program, double now) {
  Fingerprint fingerprint;
  fingerprint.add(dialect);
  fingerprint.add(program);
  const auto of_program = static_cast<std::int64_t>(fingerprint.value());
  {
    SqliteStatement known(database_, "SELECT job, fingerprint FROM attempts WHERE attempt = ?");
    if (known.with(attempt).step()) {
      const std::int64_t job = known.number();
      return {.job = job, .other_program = known.number() != of_program};
    }
  }
  if (!judge(run("BEGIN"))) return {};
  const auto job = add(name, dialect, program, now);
  if (job) {
    SqliteStatement insert(database_, "INSERT INTO attempts (attempt, job, fingerprint) VALUES (?, ?, ?)");
    if (judge(insert.with(attempt).with(*job).with(of_program).run()) && judge(run("COMMIT"))) {
      return {.job = job, .is_new = true};
    }
  }
  static_cast<void>(run("ROLLBACK"));
  return {};
}

std::optional<HistoryJob> JobHistory::find_attempt(std::string_view attempt) const {
  SqliteStatement known(database_, "SELECT job FROM attempts WHERE attempt = ?");
  return known.with(attempt).step() ? find(known.number()) : std::nullopt;
}

std::vector<HistoryJob> JobHistory::jobs(const char* where, std::int64_t value) const {
  const std::string sql = fmt::format(
      "SELECT id, name, dialect, bytes, state, why, sentence, queued_at, begun_at, ended_at,"
      " (SELECT attempt FROM attempts WHERE job = id) FROM jobs {}",
      where);
  SqliteStatement select(database_, sql.c_str());
  select.with(value);
  std::vector<HistoryJob> found;
  while (select.step()) {
    HistoryJob& job = found.emplace_back();
    job.id = select.number();
    job.name = select.text();
    job.dialect = select.text();
    job.bytes = static_cast<std::uint64_t>(select.number());
    const std::int64_t state = select.number();
    const bool is_known = state >= 0 && state <= number_of(HistoryState::interrupted);
    job.state = is_known ? static_cast<HistoryState>(state) : HistoryState::interrupted;
    job.why = select.text();
    job.why_sentence = select.text();
    job.queued_at = select.real();
    job.begun_at = select.real();
    job.ended_at = select.real();
    job.attempt = select.text();
    const auto end = std::ranges::find(unwritten_, job.id, &End::id);
    if (end == unwritten_.end()) continue;
    job.state = end->state;
    job.why = end->why;
    job.why_sentence = end->why_sentence;
    job.ended_at = end->at;
  }
  add_waits(found, where, value);
  add_stills(found, where, value);
  return found;
}

// One question for the waits of all jobs. `where` and `value`: as the jobs were found.
void JobHistory::add_waits(std::vector<HistoryJob>& jobs, const char* where, std::int64_t value) const {
  std::map<std::int64_t, HistoryJob*> by_id;
  for (HistoryJob& job : jobs) by_id[job.id] = &job;
  const std::string sql = fmt::format(
      "SELECT job, at, code, line, tool, words FROM waits WHERE job IN (SELECT id FROM jobs {}) ORDER BY job, number",
      where);
  SqliteStatement select(database_, sql.c_str());
  select.with(value);
  while (select.step()) {
    const auto job = by_id.find(select.number());
    if (job == by_id.end()) continue;
    HistoryWait& wait = job->second->waits.emplace_back();
    wait.at = select.real();
    wait.code = select.text();
    wait.line = static_cast<std::uint32_t>(select.number());
    const std::int64_t tool = select.number();
    if (tool != no_tool) wait.tool = static_cast<std::int32_t>(tool);
    wait.words = select.text();
  }
}

// The same for the stills, without the pictures.
void JobHistory::add_stills(std::vector<HistoryJob>& jobs, const char* where, std::int64_t value) const {
  std::map<std::int64_t, HistoryJob*> by_id;
  for (HistoryJob& job : jobs) by_id[job.id] = &job;
  const std::string sql = fmt::format(
      "SELECT job, id, at, moment FROM stills WHERE job IN (SELECT id FROM jobs {}) ORDER BY job, id", where);
  SqliteStatement select(database_, sql.c_str());
  select.with(value);
  while (select.step()) {
    const auto job = by_id.find(select.number());
    if (job == by_id.end()) continue;
    HistoryStill& still = job->second->stills.emplace_back();
    still.id = select.number();
    still.at = select.real();
    still.moment = select.text();
  }
}

std::optional<HistoryJob> JobHistory::find(std::int64_t id) const {
  std::vector<HistoryJob> found = jobs("WHERE id = ?", id);
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

std::optional<std::string> JobHistory::program_of(std::int64_t id) const {
  SqliteStatement select(database_, "SELECT program FROM jobs WHERE id = ? AND program IS NOT NULL");
  select.with(id);
  return select.step() ? std::optional(select.text()) : std::nullopt;
}

bool JobHistory::begin(std::int64_t id, double now) {
  is_kept_ = false;
  SqliteStatement update(database_,
                         "UPDATE jobs SET state = ?, begun_at = ?, why = '', sentence = '', ended_at = 0 WHERE id = ?");
  update.with(number_of(HistoryState::running)).with(now).with(id);
  if (!judge(update.run())) return false;
  std::erase_if(unwritten_, [id](const End& one) { return one.id == id; });
  return sqlite3_changes(database_) == 1;
}

bool JobHistory::end(std::int64_t id, HistoryState state, std::string_view why, double now,
                     std::string_view why_sentence) {
  if (!find(id)) return false;
  End end{.id = id, .state = state, .why = std::string(why), .why_sentence = std::string(why_sentence), .at = now};
  if (write(end)) return true;
  unwritten_.push_back(std::move(end));
  return false;
}

bool JobHistory::write(const End& end) {
  is_kept_ = false;
  SqliteStatement update(database_,
                         "UPDATE jobs SET state = ?1, why = ?2, ended_at = ?3, sentence = ?6,"
                         " program = CASE WHEN ?1 = ?4 THEN NULL ELSE program END WHERE id = ?5");
  update.with(number_of(end.state)).with(end.why).with(end.at).with(number_of(HistoryState::done)).with(end.id);
  update.with(end.why_sentence);
  if (!judge(update.run())) return false;
  // What is too old is forgotten the next time, if not now.
  SqliteStatement forget(database_, "DELETE FROM jobs WHERE state > 1 AND id <= (SELECT max(id) FROM jobs) - ?");
  SqliteStatement forget_waits(database_, "DELETE FROM waits WHERE job < (SELECT min(id) FROM jobs)");
  SqliteStatement forget_stills(database_, "DELETE FROM stills WHERE job < (SELECT min(id) FROM jobs)");
  SqliteStatement forget_attempts(database_, "DELETE FROM attempts WHERE job <= (SELECT max(id) FROM jobs) - ?");
  static_cast<void>(forget.with(most_ended).run() && forget_waits.run() && forget_stills.run() &&
                    forget_attempts.with(most_ended).run());
  return true;
}

bool JobHistory::record_wait(std::int64_t id, const HistoryWait& wait) {
  is_kept_ = false;
  SqliteStatement count(database_, "SELECT count(*) FROM waits WHERE job = ?");
  const std::int64_t noted = count.with(id).step() ? count.number() : most_waits;
  if (noted >= most_waits) return false;
  SqliteStatement insert(database_,
                         "INSERT INTO waits (job, number, at, code, line, tool, words) VALUES (?, ?, ?, ?, ?, ?, ?)");
  insert.with(id).with(noted).with(wait.at).with(wait.code).with(std::int64_t{wait.line});
  return judge(insert.with(std::int64_t{wait.tool.value_or(no_tool)}).with(wait.words).run());
}

bool JobHistory::record_still(std::int64_t id, std::string_view moment, double now, std::string_view jpeg) {
  if (jpeg.size() > largest_still) return false;
  is_kept_ = false;
  SqliteStatement insert(database_,
                         "INSERT INTO stills (job, at, moment, jpeg) SELECT ?1, ?2, ?3, ?4"
                         " WHERE (SELECT count(*) FROM jobs WHERE id = ?1) = 1"
                         " AND (SELECT count(*) FROM stills WHERE job = ?1) < ?5");
  insert.with(id).with(now).with(moment).with_bytes(jpeg).with(most_stills);
  if (!judge(insert.run()) || sqlite3_changes(database_) != 1) return false;
  SqliteStatement forget(database_, "DELETE FROM stills WHERE id <= (SELECT max(id) FROM stills) - ?");
  static_cast<void>(forget.with(most_kept_stills).run());
  return true;
}

std::optional<std::string> JobHistory::still(std::int64_t id) const {
  SqliteStatement select(database_, "SELECT jpeg FROM stills WHERE id = ?");
  select.with(id);
  return select.step() ? std::optional(select.text()) : std::nullopt;
}

bool JobHistory::remove(std::int64_t id) {
  is_kept_ = false;
  SqliteStatement gone(database_, "DELETE FROM jobs WHERE id = ? AND state = ?");
  gone.with(id).with(number_of(HistoryState::queued));
  return judge(gone.run()) && sqlite3_changes(database_) == 1;
}

bool JobHistory::record_alarm(std::string_view words, double now, std::string_view sentence) {
  HistoryAlarm alarm{.at = now, .words = std::string(words), .sentence = std::string(sentence)};
  if (write(alarm)) return true;
  constexpr std::size_t most_unwritten = 1000;
  if (unwritten_alarms_.size() < most_unwritten) unwritten_alarms_.push_back(std::move(alarm));
  return false;
}

bool JobHistory::write(const HistoryAlarm& alarm) {
  is_kept_ = false;
  SqliteStatement insert(database_, "INSERT INTO alarms (at, words, sentence) VALUES (?, ?, ?)");
  if (!judge(insert.with(alarm.at).with(alarm.words).with(alarm.sentence).run())) return false;
  SqliteStatement forget(database_, "DELETE FROM alarms WHERE id <= (SELECT max(id) FROM alarms) - ?");
  static_cast<void>(forget.with(most_alarms).run());
  return true;
}

std::vector<HistoryJob> JobHistory::queue() const {
  return jobs("WHERE state = ? ORDER BY id", number_of(HistoryState::queued));
}

// A job that a kill has broken off has no end: it counts from its beginning.
std::vector<HistoryJob> JobHistory::ended(std::int64_t most) const {
  std::vector<HistoryJob> found = jobs("WHERE state > 1 ORDER BY max(ended_at, begun_at) DESC, id DESC LIMIT ?", most);
  for (const End& one : unwritten_) {
    if (auto job = find(one.id)) found.insert(found.begin(), std::move(*job));
  }
  if (found.size() > static_cast<std::size_t>(most)) found.resize(static_cast<std::size_t>(most));
  return found;
}

std::vector<HistoryAlarm> JobHistory::alarms(std::int64_t most) const {
  SqliteStatement select(database_, "SELECT at, words, sentence FROM alarms ORDER BY id DESC LIMIT ?");
  select.with(most);
  // Newest first, also those that are not written yet.
  std::vector<HistoryAlarm> found(unwritten_alarms_.rbegin(), unwritten_alarms_.rend());
  while (select.step()) {
    HistoryAlarm& alarm = found.emplace_back();
    alarm.at = select.real();
    alarm.words = select.text();
    alarm.sentence = select.text();
  }
  return found;
}

bool JobHistory::keep() {
  while (!unwritten_.empty() && write(unwritten_.front())) unwritten_.erase(unwritten_.begin());
  while (!unwritten_alarms_.empty() && write(unwritten_alarms_.front())) {
    unwritten_alarms_.erase(unwritten_alarms_.begin());
  }
  if (is_kept_) return !is_behind();
  is_kept_ = sqlite3_wal_checkpoint_v2(database_, nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr) == SQLITE_OK;
  return is_kept_ && !is_behind();
}

}  // namespace passo
