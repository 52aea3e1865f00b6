#include "passo/job/tool_records.hpp"

#include <algorithm>
#include <map>

#include "sqlite_statement.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr int records_version = 1;
// What an open run has cut, and how much of it belongs to a tool that was replaced meanwhile. Tool 0: the run itself.
constexpr const char* records_tables = R"(
  CREATE TABLE tools (number INTEGER PRIMARY KEY, cut_mm REAL NOT NULL DEFAULT 0, cut_s REAL NOT NULL DEFAULT 0,
    replaced_at REAL NOT NULL DEFAULT 0);
  CREATE TABLE runs (machine TEXT NOT NULL, tool INTEGER NOT NULL, run TEXT NOT NULL DEFAULT '',
    cut_mm REAL NOT NULL DEFAULT 0, cut_s REAL NOT NULL DEFAULT 0, old_mm REAL NOT NULL DEFAULT 0,
    old_s REAL NOT NULL DEFAULT 0, PRIMARY KEY (machine, tool)) WITHOUT ROWID;
  PRAGMA user_version = 1;)";
constexpr int patience_ms = 50;  // for another process; the machine may be moving

}  // namespace

Result<std::unique_ptr<ToolRecords>, std::string> ToolRecords::open(const std::string& file) {
  sqlite3* database = nullptr;
  const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_NOFOLLOW;
  const int opened = sqlite3_open_v2(file.c_str(), &database, flags, nullptr);
  std::unique_ptr<ToolRecords> records(new ToolRecords(database));
  const auto failed = [&](const std::string& reason) { return Failure{file + ": " + reason}; };
  const auto reason = [&] { return std::string(database != nullptr ? sqlite3_errmsg(database) : "no memory"); };
  if (opened != SQLITE_OK) return failed(reason());
  constexpr int patience_at_start_ms = 2000;
  sqlite3_busy_timeout(database, patience_at_start_ms);
  sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  if (!records->run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA wal_autocheckpoint = 0;"
                    "BEGIN IMMEDIATE;")) {
    return failed(reason());
  }
  std::int64_t known = 0;
  {
    SqliteStatement of(database, "PRAGMA user_version");
    if (of.step()) known = of.number();
  }
  if (known > records_version)
    return failed(fmt::format("its version is {}, but this program supports {}", known, records_version));
  if (known == 0 && !records->run(records_tables)) return failed(reason());
  if (!records->run("COMMIT;")) return failed(reason());
  {
    SqliteStatement check(database, "PRAGMA quick_check(1)");
    if (!check.step()) return failed(reason());
    if (const std::string found = check.text(); found != "ok") return failed("it is damaged: " + found);
  }
  sqlite3_busy_timeout(database, patience_ms);
  return records;
}

ToolRecords::~ToolRecords() {
  keep();
  sqlite3_close_v2(database_);
}

bool ToolRecords::run(const char* sql) const {
  return sqlite3_exec(database_, sql, nullptr, nullptr, nullptr) == SQLITE_OK;
}

bool ToolRecords::begin_transaction() {
  is_kept_ = false;
  return run("BEGIN IMMEDIATE");
}

bool ToolRecords::finish(bool done) {
  done = done && run("COMMIT");
  trouble_ = done ? std::string() : sqlite3_errmsg(database_);
  if (!done && sqlite3_get_autocommit(database_) == 0) run("ROLLBACK");
  return done;
}

std::vector<ToolRecord> ToolRecords::all() const {
  std::map<std::int32_t, ToolRecord> found;
  SqliteStatement select(database_,
                         "SELECT number, cut_mm, cut_s, replaced_at FROM tools UNION ALL"
                         " SELECT tool, cut_mm - old_mm, cut_s - old_s, 0 FROM runs WHERE tool > 0");
  while (select.step()) {
    const auto tool = static_cast<std::int32_t>(select.number());
    ToolRecord& record = found[tool];
    record.tool = tool;
    const Mm length(select.real());
    const Seconds time(select.real());
    record.cut += {.length = length, .time = time};
    record.replaced_at = std::max(record.replaced_at, select.real());
  }
  std::vector<ToolRecord> records;
  for (const auto& [tool, record] : found) records.push_back(record);
  return records;
}

bool ToolRecords::replace(std::int32_t tool, double now) {
  if (!begin_transaction()) return finish(false);
  SqliteStatement anew(database_,
                       "INSERT INTO tools (number, replaced_at) VALUES (?1, ?2) ON CONFLICT (number)"
                       " DO UPDATE SET cut_mm = 0, cut_s = 0, replaced_at = ?2");
  SqliteStatement old(database_, "UPDATE runs SET old_mm = cut_mm, old_s = cut_s WHERE tool = ?");
  return finish(anew.with(std::int64_t{tool}).with(now).run() && old.with(std::int64_t{tool}).run());
}

bool ToolRecords::add_to_totals(std::string_view machine) {
  SqliteStatement add(database_,
                      "INSERT INTO tools (number, cut_mm, cut_s)"
                      " SELECT tool, cut_mm - old_mm, cut_s - old_s FROM runs WHERE machine = ? AND tool > 0"
                      " ON CONFLICT (number) DO UPDATE SET cut_mm = cut_mm + excluded.cut_mm,"
                      " cut_s = cut_s + excluded.cut_s");
  SqliteStatement gone(database_, "DELETE FROM runs WHERE machine = ?");
  return add.with(machine).run() && gone.with(machine).run();
}

bool ToolRecords::begin(std::string_view machine, std::string_view run) {
  if (!begin_transaction()) return finish(false);
  SqliteStatement insert(database_, "INSERT INTO runs (machine, tool, run) VALUES (?, 0, ?)");
  return finish(add_to_totals(machine) && insert.with(machine).with(run).run());
}

bool ToolRecords::set(std::string_view machine, const CutAmounts& amounts) {
  return std::ranges::all_of(amounts, [&](const auto& one) {
    SqliteStatement set(database_,
                        "INSERT INTO runs (machine, tool, cut_mm, cut_s) VALUES (?1, ?2, ?3, ?4)"
                        " ON CONFLICT (machine, tool) DO UPDATE SET cut_mm = ?3, cut_s = ?4");
    set.with(machine).with(std::int64_t{one.first});
    return set.with(one.second.length.value()).with(one.second.time.value()).run();
  });
}

bool ToolRecords::record(std::string_view machine, const CutAmounts& amounts) {
  return begin_transaction() ? finish(set(machine, amounts)) : finish(false);
}

bool ToolRecords::end(std::string_view machine) {
  return begin_transaction() ? finish(add_to_totals(machine)) : finish(false);
}

std::optional<CutAmounts> ToolRecords::open_run(std::string_view machine, std::string_view run) const {
  SqliteStatement is_open(database_, "SELECT 1 FROM runs WHERE machine = ? AND tool = 0 AND run = ?");
  if (!is_open.with(machine).with(run).step()) return std::nullopt;
  CutAmounts amounts;
  SqliteStatement select(database_, "SELECT tool, cut_mm, cut_s FROM runs WHERE machine = ? AND tool > 0");
  select.with(machine);
  while (select.step()) {
    CutAmount& amount = amounts[static_cast<std::int32_t>(select.number())];
    amount.length = Mm(select.real());
    amount.time = Seconds(select.real());
  }
  return amounts;
}

bool ToolRecords::recover(std::string_view machine, std::string_view run, const CutAmounts& path) {
  const auto reported = open_run(machine, run);
  if (!reported) return true;
  CutAmounts amounts;
  for (const auto& [tool, whole] : path) {
    const auto known = reported->find(tool);
    const CutAmount before = known == reported->end() ? CutAmount() : known->second;
    CutAmount& amount = amounts[tool] = {.length = std::max(whole.length, before.length), .time = before.time};
    if (whole.length > before.length) amount.time += whole.time * ((whole.length - before.length) / whole.length);
    if (whole.length == Mm(0)) amount.time = std::max(whole.time, before.time);
  }
  if (!begin_transaction()) return finish(false);
  return finish(set(machine, amounts) && add_to_totals(machine));
}

bool ToolRecords::keep() {
  if (is_kept_) return true;
  is_kept_ = sqlite3_wal_checkpoint_v2(database_, nullptr, SQLITE_CHECKPOINT_PASSIVE, nullptr, nullptr) == SQLITE_OK;
  return is_kept_;
}

}  // namespace passo
