// ServedJournal: the journal of `passo serve --data`: the file job.journal in its folder, for the running job.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "machine_connection.hpp"

#include "passo/job/interrupted_job.hpp"
#include "passo/job/journal_file.hpp"

namespace passo {

class ServedJournal final : public JobKeeper {
 public:
  // Null, with a message, if another program uses the journal. The machine must outlive this object.
  static std::unique_ptr<ServedJournal> open(const std::string& folder, MachineConnection& machine);

  // Must be called at standstill, before the handshake: checks whether a job was interrupted, and records that this
  // handshake comes next. Returns false, with a message, if the journal cannot be written.
  [[nodiscard]] bool resume_job(const Greeting& greeting);
  const std::optional<BrokenOff>& found() const { return found_; }

  JournalStore& store() override { return file_; }
  std::string read() override { return file_.text(); }
  std::string trouble() override { return file_.trouble(); }
  double noted_at() override { return file_.written_at(); }
  void remove() override { file_.remove(); }
  std::uint16_t new_number() override { return machine_.new_session_number(); }
  void name_session(std::uint16_t number) override { machine_.begin_session(number); }

 private:
  ServedJournal(std::string path, MachineConnection& machine) : file_(std::move(path)), machine_(machine) {}

  JournalFile file_;
  MachineConnection& machine_;
  std::optional<BrokenOff> found_;
};

}  // namespace passo
