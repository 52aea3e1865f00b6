// CutRecorder: counts what the tools of a run cut, and reports it to ToolRecords each second.
//
//   begin() -> the run's executed motion -> poll() … -> end()
//
// A record that cannot be written is written with the next report, so a full disk loses nothing while this process
// lives, and never stops the machine.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "passo/activity/cut_meter.hpp"
#include "passo/job/tool_records.hpp"
#include "passo/session/request.hpp"

namespace passo {

class CutRecorder {
 public:
  // `machine`: see ToolRecords. The records must outlive this object.
  CutRecorder(ToolRecords& records, std::string machine) : records_(records), machine_(std::move(machine)) {}

  // Adds an observer of the executed motion to the run, which is about to start. `run`: run_of() its journal; empty: it
  // has none. This object must outlive the run.
  void begin(request::Start& start, std::string_view run);
  // `now`: any clock, in seconds.
  void poll(double now);
  // The machine is stopped. Returns false, with the reason in the records' trouble(), if the amounts are not written.
  bool end();
  bool is_open() const { return is_open_; }
  // For a job that an earlier process did not end: see ToolRecords::recover().
  bool recover(std::string_view run, const CutAmounts& path) { return records_.recover(machine_, run, path); }
  ToolRecords& records() { return records_; }

 private:
  bool report();

  static constexpr double between_reports = 1;  // s

  ToolRecords& records_;
  std::string machine_;
  std::string run_;
  bool is_begun_ = false;  // the records know the run
  CutMeter meter_;
  CutAmounts reported_;
  double reported_at_ = 0;
  bool is_open_ = false;
};

}  // namespace passo
