#include "passo/history/job_history.hpp"

#include <utility>

#include "sqlite_library.hpp"
#include <fmt/format.h>

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
constexpr std::int64_t no_tool = -1;

// Only after open() has found it: whoever has a JobHistory has the library.
const SqliteLibrary& sqlite() {
  return *late_library<SqliteLibrary>();
}

constexpr std::int64_t number_of(HistoryState state) {
  return static_cast<std::int64_t>(state);
}

// One statement. Values are bound in order, and columns read in order.
class Statement {
 public:
  Statement(sqlite3* database, const char* sql) {
    sqlite().sqlite3_prepare_v2(database, sql, -1, &statement_, nullptr);
  }
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;
  ~Statement() { sqlite().sqlite3_finalize(statement_); }

  Statement& with(std::int64_t value) {
    sqlite().sqlite3_bind_int64(statement_, ++bound_, value);
    return *this;
  }
  Statement& with(double value) {
    sqlite().sqlite3_bind_double(statement_, ++bound_, value);
    return *this;
  }
  // The text outlives the statement.
  Statement& with(std::string_view value) {
    sqlite().sqlite3_bind_text64(statement_, ++bound_, value.data(), value.size(), SQLITE_STATIC, SQLITE_UTF8);
    return *this;
  }
  Statement& with_bytes(std::string_view value) {
    sqlite().sqlite3_bind_blob64(statement_, ++bound_, value.data(), value.size(), SQLITE_STATIC);
    return *this;
  }

  // True: there is a row.
  bool step() {
    read_ = -1;
    return statement_ != nullptr && sqlite().sqlite3_step(statement_) == SQLITE_ROW;
  }
  bool run() { return statement_ != nullptr && sqlite().sqlite3_step(statement_) == SQLITE_DONE; }

  std::int64_t number() { return sqlite().sqlite3_column_int64(statement_, ++read_); }
  double real() { return sqlite().sqlite3_column_double(statement_, ++read_); }
  std::string text() {
    const void* const bytes = sqlite().sqlite3_column_blob(statement_, ++read_);
    const auto size = static_cast<std::size_t>(sqlite().sqlite3_column_bytes(statement_, read_));
    return bytes == nullptr ? std::string() : std::string(static_cast<const char*>(bytes), size);
  }

 private:
  sqlite3_stmt* statement_ = nullptr;
  int bound_ = 0;
  int read_ = -1;
};

}  // namespace

std::string_view name_of(HistoryState state) {
  constexpr std::string_view names[] = {"queued", "running", "done", "stopped", "failed", "interrupted"};
  return names[static_cast<std::size_t>(state)];
}

Result<std::unique_ptr<JobHistory>, std::string> JobHistory::open(const std::string& file) {
  if (late_library<SqliteLibrary>() == nullptr) {
    return Failure{file + ": " PASSO_SQLITE_NAME " is not installed, which keeps jobs"};
  }
  sqlite3* database = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_NOFOLLOW;
  const int opened = sqlite().sqlite3_open_v2(file.c_str(), &database, flags, nullptr);
  std::unique_ptr<JobHistory> history(new JobHistory(database));
  const auto failed = [&](const std::string& reason) { return Failure{file + ": " + reason}; };
  const auto reason = [&] {
    return std::string(database != nullptr ? sqlite().sqlite3_errmsg(database) : "no memory");
  };
  if (opened != SQLITE_OK) return failed(reason());
  sqlite().sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  // Another program that writes would be at the same machine. The lock lasts until the end.
  if (!history->run("PRAGMA locking_mode = EXCLUSIVE; PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;"
                    "PRAGMA wal_autocheckpoint = 0; BEGIN IMMEDIATE; COMMIT;")) {
    return failed(reason());
  }
  {
    Statement check(database, "PRAGMA quick_check(1)");
    if (!check.step()) return failed(reason());
    if (const std::string found = check.text(); found != "ok") return failed("it is damaged: " + found);
  }
  std::int64_t known = 0;
  {
    Statement of(database, "PRAGMA user_version");
    if (of.step()) known = of.number();
  }
  if (known > version) return failed(fmt::format("it is of version {}, and this program knows {}", known, version));
  if (known == 0 && !history->run(fmt::format("BEGIN;{}COMMIT;", tables).c_str())) return failed(reason());
  if (!history->run(table_of_waits)) return failed(reason());
  Statement interrupt(database,
                      "UPDATE jobs SET state = ?, why = 'passo serve was killed, or its computer lost its power'"
                      " WHERE state = ?");
  interrupt.with(number_of(HistoryState::interrupted)).with(number_of(HistoryState::running));
  if (!interrupt.run()) return failed(reason());
  return history;
}

JobHistory::~JobHistory() {
  keep();
  sqlite().sqlite3_close_v2(database_);
}

bool JobHistory::run(const char* sql) const {
  return sqlite().sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) == SQLITE_OK;
}

std::optional<std::int64_t> JobHistory::add(std::string_view name, std::string_view dialect, std::string_view program,
                                            double now) {
  Statement count(database_, "SELECT count(*) FROM jobs WHERE state = ?");
  count.with(number_of(HistoryState::queued));
  if (!count.step() || count.number() >= static_cast<std::int64_t>(most_queued)) return {};
  Statement insert(database_,
                   "INSERT INTO jobs (name, dialect, bytes, state, queued_at, program) VALUES (?, ?, ?, ?, ?, ?)");
  insert.with(name).with(dialect).with(static_cast<std::int64_t>(program.size()));
  insert.with(number_of(HistoryState::queued)).with(now).with_bytes(program);
  if (!insert.run()) return {};
  is_kept_ = false;
  return sqlite().sqlite3_last_insert_rowid(database_);
}

std::vector<HistoryJob> JobHistory::jobs(const char* where, std::int64_t value) const {
  const std::string sql =
      fmt::format("SELECT id, name, dialect, bytes, state, why, queued_at, begun_at, ended_at FROM jobs {}", where);
  Statement select(database_, sql.c_str());
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
    job.queued_at = select.real();
    job.begun_at = select.real();
    job.ended_at = select.real();
    job.waits = waits_of(job.id);
  }
  return found;
}

std::optional<HistoryJob> JobHistory::find(std::int64_t id) const {
  std::vector<HistoryJob> found = jobs("WHERE id = ?", id);
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

std::optional<std::string> JobHistory::program_of(std::int64_t id) const {
  Statement select(database_, "SELECT program FROM jobs WHERE id = ? AND program IS NOT NULL");
  select.with(id);
  return select.step() ? std::optional(select.text()) : std::nullopt;
}

bool JobHistory::begin(std::int64_t id, double now) {
  is_kept_ = false;
  Statement update(database_, "UPDATE jobs SET state = ?, begun_at = ?, why = '', ended_at = 0 WHERE id = ?");
  update.with(number_of(HistoryState::running)).with(now).with(id);
  return update.run() && sqlite().sqlite3_changes(database_) == 1;
}

bool JobHistory::end(std::int64_t id, HistoryState state, std::string_view why, double now) {
  is_kept_ = false;
  Statement update(database_,
                   "UPDATE jobs SET state = ?1, why = ?2, ended_at = ?3,"
                   " program = CASE WHEN ?1 = ?4 THEN NULL ELSE program END WHERE id = ?5");
  update.with(number_of(state)).with(why).with(now).with(number_of(HistoryState::done)).with(id);
  const bool good = update.run() && sqlite().sqlite3_changes(database_) == 1;
  Statement forget(database_, "DELETE FROM jobs WHERE state > 1 AND id <= (SELECT max(id) FROM jobs) - ?");
  Statement forget_waits(database_, "DELETE FROM waits WHERE job < (SELECT min(id) FROM jobs)");
  return forget.with(most_ended).run() && forget_waits.run() && good;
}

bool JobHistory::note_wait(std::int64_t id, const HistoryWait& wait) {
  is_kept_ = false;
  Statement count(database_, "SELECT count(*) FROM waits WHERE job = ?");
  const std::int64_t noted = count.with(id).step() ? count.number() : most_waits;
  if (noted >= most_waits) return false;
  Statement insert(database_,
                   "INSERT INTO waits (job, number, at, code, line, tool, words) VALUES (?, ?, ?, ?, ?, ?, ?)");
  insert.with(id).with(noted).with(wait.at).with(wait.code).with(std::int64_t{wait.line});
  return insert.with(std::int64_t{wait.tool.value_or(no_tool)}).with(wait.words).run();
}

std::vector<HistoryWait> JobHistory::waits_of(std::int64_t id) const {
  Statement select(database_, "SELECT at, code, line, tool, words FROM waits WHERE job = ? ORDER BY number");
  select.with(id);
  std::vector<HistoryWait> found;
  while (select.step()) {
    HistoryWait& wait = found.emplace_back();
    wait.at = select.real();
    wait.code = select.text();
    wait.line = static_cast<std::uint32_t>(select.number());
    const std::int64_t tool = select.number();
    if (tool != no_tool) wait.tool = static_cast<std::int32_t>(tool);
    wait.words = select.text();
  }
  return found;
}

bool JobHistory::remove(std::int64_t id) {
  is_kept_ = false;
  Statement gone(database_, "DELETE FROM jobs WHERE id = ? AND state = ?");
  return gone.with(id).with(number_of(HistoryState::queued)).run() && sqlite().sqlite3_changes(database_) == 1;
}

bool JobHistory::note_alarm(std::string_view words, double now) {
  is_kept_ = false;
  Statement insert(database_, "INSERT INTO alarms (at, words) VALUES (?, ?)");
  const bool good = insert.with(now).with(words).run();
  Statement forget(database_, "DELETE FROM alarms WHERE id <= (SELECT max(id) FROM alarms) - ?");
  return forget.with(most_alarms).run() && good;
}

std::vector<HistoryJob> JobHistory::queue() const {
  return jobs("WHERE state = ? ORDER BY id", number_of(HistoryState::queued));
}

std::vector<HistoryJob> JobHistory::ended(std::int64_t most) const {
  return jobs("WHERE state > 1 ORDER BY ended_at DESC, id DESC LIMIT ?", most);
}

std::vector<HistoryAlarm> JobHistory::alarms(std::int64_t most) const {
  Statement select(database_, "SELECT at, words FROM alarms ORDER BY id DESC LIMIT ?");
  select.with(most);
  std::vector<HistoryAlarm> found;
  while (select.step()) {
    HistoryAlarm& alarm = found.emplace_back();
    alarm.at = select.real();
    alarm.words = select.text();
  }
  return found;
}

void JobHistory::keep() {
  if (std::exchange(is_kept_, true)) return;
  sqlite().sqlite3_wal_checkpoint_v2(database_, nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr);
}

}  // namespace passo
