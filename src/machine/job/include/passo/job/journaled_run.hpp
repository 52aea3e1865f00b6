// JournaledRun: a run of a program whose journal is kept, so that another run can go on with the job.
//
// First begin() writes the head of the journal. Then the board hears the numbers in the head. Then the run begins, with
// what add_to() adds to it.
#pragma once

#include <optional>

#include "passo/job/job_entry.hpp"

namespace passo {

class JournaledRun {
 public:
  // The store outlives the run.
  explicit JournaledRun(JournalStore& store) : writer_(store) {}

  // Writes the head. `entry`: for a continued job; empty: the caller of add_to() gives the entry point of the path.
  // False: the head cannot be written.
  [[nodiscard]] bool begin(const JournalHead& head, std::optional<JobEntry> entry = {});
  const std::optional<JobEntry>& entry() const { return entry_; }
  // The run enters the path at its entry point, and its journal records stop points and probe moves. This outlives the
  // run.
  void add_to(request::Start& start);
  // False: something could not be written, so the job could not go on.
  bool is_written() const { return !writer_.failed(); }

 private:
  JournalWriter writer_;
  std::optional<JobEntry> entry_;
};

}  // namespace passo
