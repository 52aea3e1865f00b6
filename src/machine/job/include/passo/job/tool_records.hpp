// ToolRecords: how far and how long each tool has cut since it was new, in an SQLite file (tools.sqlite) beside the job
// history.
//
// Position in the pipeline: outside it. CutRecorder reports what a run has cut so far.
//
// A run is open while it moves. Its amounts are set, not added, so a report that is repeated counts once. They are
// added to the totals when the run ends. A killed process leaves its run open, with the amounts of its last report;
// recover() or the next run of the same machine adds them. Each call is one transaction in a write-ahead log; keep()
// flushes the log to the disk, which may be slow: call it while the machine is stopped. Several processes may use the
// file.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "passo/activity/cut_meter.hpp"
#include "passo/base/result.hpp"

struct sqlite3;

namespace passo {

struct ToolRecord {
  std::int32_t tool = 0;
  CutAmount cut;
  double replaced_at = 0;  // when it was replaced; seconds since 1970; 0: never
};

class ToolRecords {
 public:
  // Opens or creates the file. The error is a sentence with the reason: the file is damaged or belongs to a newer
  // version.
  static Result<std::unique_ptr<ToolRecords>, std::string> open(const std::string& file);
  ~ToolRecords();
  ToolRecords(const ToolRecords&) = delete;
  ToolRecords& operator=(const ToolRecords&) = delete;

  // All tools that have cut or were replaced, including open runs, by their numbers.
  std::vector<ToolRecord> all() const;
  // The tool is new from now on, also in an open run.
  bool replace(std::int32_t tool, double now);

  // `machine`: where the run is, e.g. the path of its journal. One run at a time is open there; begin() ends an earlier
  // one. All return false, with trouble(), if the file cannot be written; the run then stays as it was.
  bool begin(std::string_view machine, std::string_view run);
  bool record(std::string_view machine, const CutAmounts& amounts);
  bool end(std::string_view machine);
  // Returns the amounts of that run, if it is open there.
  std::optional<CutAmounts> open_run(std::string_view machine, std::string_view run) const;
  // Ends that run, if it is open there, with the path that it has cut: lengths are exact, and the time of what was not
  // reported yet is that of the path.
  bool recover(std::string_view machine, std::string_view run, const CutAmounts& path);

  // Flushes everything to the disk. Returns false if some data is not on the disk yet; try again.
  bool keep();
  // The error of the last call that writes. Empty: it succeeded.
  const std::string& trouble() const { return trouble_; }

 private:
  explicit ToolRecords(sqlite3* database) : database_(database) {}
  bool run(const char* sql) const;
  bool finish(bool done);
  bool begin_transaction();
  bool set(std::string_view machine, const CutAmounts& amounts);
  bool add_to_totals(std::string_view machine);

  sqlite3* database_;
  bool is_kept_ = true;
  std::string trouble_;
};

}  // namespace passo
