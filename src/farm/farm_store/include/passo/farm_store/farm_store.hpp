// FarmStore: the machines, jobs, checks and attempts of a farm, in a Database.
//
// Purpose: the only place that changes them. Each call is one transaction, so that any number of farm processes and
// workers may use one database, be killed, and be started again.
//
// An *attempt* is one part of a job on one machine. Its states:
//
//     claimed -> started -> done | failed
//        |          |
//        +----------+--> unknown -> started | done | failed | never_started
//
// Invariants, in every state of the database:
// - done + open attempts of a job never exceed its quantity (open: claimed, started, unknown), so no part is cut twice;
// - a machine has at most one open attempt;
// - an ended attempt never changes again.
// An attempt whose machine is silent is `unknown`. Only the machine's own history ends it: never a guess.
//
// Times are seconds since 1970, and come from the caller.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/database/database.hpp"

namespace passo {

// Words such as labels and tools, each at most once, in ascending order.
using Words = std::vector<std::string>;

struct FarmMachine {
  std::string name;
  std::string url;           // of its `passo serve`
  std::string token;         // for it
  std::string machine_file;  // hash of its contents
  Words labels = {};
  Words materials = {};
  Words tools = {};         // loaded now
  std::string stock = {};   // on the table now; empty: none
  double heard_at = 0;      // 0: never
  std::string status = {};  // JSON, as the machine gave it
};

enum class FarmJobState : std::uint8_t { open, done, cancelled };

struct FarmJob {
  std::int64_t id = 0;  // assigned by add_job()
  std::string name;
  std::string program;  // hash of its contents
  std::int64_t quantity = 1;
  std::string material = {};  // empty: any
  Words tools = {};           // all of them must be loaded
  std::string stock = {};     // empty: any
  Words labels = {};          // the machine must have all of them
  std::int64_t priority = 0;  // a higher one comes first
  double due_at = 0;          // 0: none
  std::string owner = {};
  FarmJobState state = FarmJobState::open;
  double created_at = 0;
  // Derived from its attempts.
  std::int64_t parts_done = 0;
  std::int64_t parts_open = 0;
};

enum class CheckState : std::uint8_t { wanted, taken, good, bad };

struct CheckOrder {
  std::string program;  // hashes
  std::string machine_file;
};

struct CheckOutcome {
  bool good = false;
  double planned_s = 0;
  std::string findings = {};  // JSON
};

enum class AttemptState : std::uint8_t { claimed, started, unknown, done, failed, never_started };
constexpr bool is_open(AttemptState state) {
  return state <= AttemptState::unknown;
}
std::string_view name_of(AttemptState state);

struct Attempt {
  std::string id;  // 1 to 64 characters, chosen by the caller: the same id again is the same attempt
  std::int64_t job = 0;
  std::string machine;
  std::string operator_name = {};
  AttemptState state = AttemptState::claimed;
  std::string why = {};  // of its last state
  double claimed_at = 0;
  double started_at = 0;  // 0: not yet
  double ended_at = 0;
};

// A job that a machine can make now.
struct Offer {
  std::int64_t job = 0;
  double planned_s = 0;
};

enum class StoreRefusal : std::uint8_t {
  unreachable,  // the database; the change may or may not have been made, and the same call may be repeated
  conflict,     // other transactions kept changing the same rows: try again
  failed,       // the database refuses; the text says why
  no_such_machine,
  no_such_job,
  no_such_attempt,
  url_in_use,        // another machine has this URL
  job_ended,         // all parts are made or being made, or the job is cancelled
  machine_is_taken,  // it has another open attempt
  not_proven,        // no good check of the program on the machine's file
  unsuitable,        // tools, stock, material or labels
  other_attempt,     // the id belongs to another job or machine
  wrong_state,       // the attempt cannot go from its state to this one
};
struct StoreError {
  StoreRefusal refusal = StoreRefusal::failed;
  std::string text = {};  // of the database, for the log
};

class FarmStore {
 public:
  template <class T>
  using Answer = Result<T, StoreError>;

  // Brings the tables to this version. Fails if they are of a newer one. `passo`: the version whose checks count.
  static Answer<FarmStore> open(Database& database, std::string passo);

  // Returns the hash of the contents.
  Answer<std::string> add_contents(const std::string& data);
  Answer<std::optional<std::string>> contents(const std::string& hash);

  // Adds the machine, or replaces what is known of one with this name. The contents of its machine file are stored.
  Answer<Unit> put_machine(const FarmMachine& machine);
  Answer<std::vector<FarmMachine>> machines();
  Answer<Unit> hear(const std::string& name, const std::string& status, double now);

  Answer<std::int64_t> add_job(const FarmJob& job);
  Answer<std::vector<FarmJob>> jobs(FarmJobState state);
  // Its open attempts go on.
  Answer<Unit> cancel_job(std::int64_t id);

  // Adds a wanted check for each program of an open job on each machine file that has none. Returns their number.
  Answer<std::int64_t> want_checks();
  // Gives one wanted check to a worker, until now + lease; a later one gives it to somebody else. Empty: there is none.
  Answer<std::optional<CheckOrder>> take_check(const std::string& worker, double now, double lease);
  // The result counts whoever had taken the check, because it depends on nothing but the contents.
  Answer<Unit> finish_check(const CheckOrder& order, const CheckOutcome& outcome);

  // The jobs that the machine can make now, the most urgent first: by priority, then due time, then age.
  Answer<std::vector<Offer>> offers(const std::string& machine);
  // Begins an attempt. If there is one with this id already, it is returned as it is.
  Answer<Attempt> claim(const Attempt& attempt, double now);
  Answer<Attempt> attempt(const std::string& id);
  Answer<std::vector<Attempt>> open_attempts();
  Answer<std::vector<Attempt>> attempts_of(std::int64_t job);
  // Repeating a change does nothing.
  Answer<Attempt> change(const std::string& id, AttemptState to, const std::string& why, double now);
  // Open attempts of machines that were last heard before `before` become unknown. Returns their number.
  Answer<std::int64_t> doubt_silent(double before);

 private:
  FarmStore(Database& database, std::string passo) : database_(&database), passo_(std::move(passo)) {}

  Database* database_;
  std::string passo_;
};

}  // namespace passo
