#include "served_journal.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "program_input.hpp"
#include <sys/stat.h>

namespace passo {

std::unique_ptr<ServedJournal> ServedJournal::open(const std::string& folder, OpenedMachine& machine) {
  const std::string path = (std::filesystem::path(folder) / "job.journal").string();
  std::unique_ptr<ServedJournal> journal(new ServedJournal(path, machine));
  const auto claimed = journal->file_.claim();
  if (claimed) return journal;
  fail(exit_failed, claimed.error() == EWOULDBLOCK
                        ? "--data " + path + ": another passo that runs now keeps its jobs there [serve.data]"
                        : "--data " + path + ": " + std::strerror(claimed.error()) + " [serve.data]");
  return nullptr;
}

bool ServedJournal::take_up(const Greeting& greeting) {
  const auto journal = Journal::read(read());
  if (!journal) return true;
  found_ = broken_off(*journal, machine_.before(), greeting);
  found_->noted_at = noted_at();
  // A virtual board lives and dies with its host.
  if (!machine_.is_on_a_line()) found_->refused = ResumeRefusal::board_reset;
  if (found_->refused) return true;
  JournalWriter writer(file_);
  writer.begin(found_->head);
  if (writer.failed()) fail(exit_failed, file_.path() + ": this journal cannot be written: " + file_.trouble());
  return !writer.failed();
}

double ServedJournal::noted_at() {
  struct stat file {};
  if (stat(file_.path().c_str(), &file) != 0) return 0;
  return static_cast<double>(file.st_mtim.tv_sec) + static_cast<double>(file.st_mtim.tv_nsec) * 1e-9;
}

}  // namespace passo
