// JournaledRun: a run of a program with a journal, so that a later run can continue the job.
//
// First begin() writes the head of the journal. Then the handshake gives the board the numbers in the head. Then the
// run starts, with the additions of add_to().
#pragma once

#include <optional>

#include "passo/job/job_entry.hpp"

namespace passo {

class JournaledRun {
 public:
  // The store must outlive the run.
  explicit JournaledRun(JournalStore& store) : writer_(store) {}

  // Writes the head. `entry`: for a continued job; empty: the caller of add_to() gives the entry point of the path.
  // Returns false if the head cannot be written.
  [[nodiscard]] bool begin(const JournalHead& head, std::optional<JobEntry> entry = {});
  const std::optional<JobEntry>& entry() const { return entry_; }
  // Sets the run's entry point on the path, and adds the recording of stop points and probe results in the journal.
  // This object must outlive the run.
  void add_to(request::Start& start);
  // Returns false if a write failed, so the job could not be continued.
  bool is_written() const { return !writer_.failed(); }

 private:
  JournalWriter writer_;
  std::optional<JobEntry> entry_;
};

}  // namespace passo
