#include "served_journal.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "program_input.hpp"

namespace passo {

std::unique_ptr<ServedJournal> ServedJournal::open(const std::string& folder, MachineConnection& machine) {
  const std::string path = (std::filesystem::path(folder) / "job.journal").string();
  std::unique_ptr<ServedJournal> journal(new ServedJournal(path, machine));
  const auto claimed = journal->file_.claim();
  if (claimed) return journal;
  fail(exit_failed, claimed.error() == EWOULDBLOCK
                        ? "--data " + path + ": in use by another passo [serve.data]"
                        : "--data " + path + ": " + std::strerror(claimed.error()) + " [serve.data]");
  return nullptr;
}

bool ServedJournal::resume_job(const Greeting& greeting) {
  JournaledRun run(file_);
  // A virtual board lives and dies with its host.
  found_ = passo::resume_job(*this, run, machine_.before(), greeting, machine_.is_on_a_line());
  if (!run.is_written()) fail(exit_failed, file_.path() + ": this journal cannot be written: " + file_.trouble());
  return run.is_written();
}

}  // namespace passo
