#include "passo/api/program_store.hpp"

#include <algorithm>
#include <utility>

namespace passo {
namespace {

constexpr std::uint64_t items_a_turn = 500;

}  // namespace

std::string_view name_of(UploadState state) {
  switch (state) {
    case UploadState::unchecked: return "unchecked";
    case UploadState::checking: return "checking";
    case UploadState::good: return "good";
    case UploadState::bad: return "bad";
  }
  return "";
}

const StoredProgram* ProgramStore::add(std::string name, Dialect dialect, std::string text) {
  if (programs_.size() >= most_programs || text.size() > longest_program || bytes_ + text.size() > most_bytes) {
    return nullptr;
  }
  bytes_ += text.size();
  const std::uint64_t id = ++last_id_;
  StoredProgram& program = programs_[id];
  program.id = id;
  program.name = std::move(name);
  program.dialect = dialect;
  program.lines = static_cast<std::uint64_t>(std::ranges::count(text, '\n'));
  if (!text.empty() && text.back() != '\n') ++program.lines;
  program.text = std::move(text);
  return &program;
}

const StoredProgram* ProgramStore::find(std::uint64_t id) const {
  const auto found = programs_.find(id);
  return found == programs_.end() ? nullptr : &found->second;
}

bool ProgramStore::remove(std::uint64_t id) {
  const auto found = programs_.find(id);
  if (found == programs_.end()) return false;
  if (checked_ == id) checker_.reset();
  bytes_ -= found->second.text.size();
  programs_.erase(found);
  return true;
}

InterpreterOptions ProgramStore::options_of(const StoredProgram& program) const {
  InterpreterOptions options;
  options.dialect = program.dialect;
  return options;
}

void ProgramStore::check(std::uint64_t id, const MachineDescription& machine, const Point& start) {
  const auto found = programs_.find(id);
  if (found == programs_.end()) return;
  if (checker_) {
    if (const auto before = programs_.find(checked_); before != programs_.end()) {
      before->second.state = UploadState::unchecked;
    }
    checker_.reset();
  }
  StoredProgram& program = found->second;
  program.findings.clear();
  program.state = UploadState::checking;
  InterpreterOptions options = options_of(program);
  options.start = start;
  checked_ = id;
  checker_ = std::make_unique<ProgramChecker>(ProgramReader::from_text(program.name, program.text), machine, options,
                                              program.findings);
  path_ = PathFingerprint();
  checker_->watch([this](const PathItem& item) { path_.add(item); });
}

void ProgramStore::turn() {
  if (!checker_ || !checker_->go_on(items_a_turn)) return;
  StoredProgram& program = programs_.at(checked_);
  program.check = checker_->result();
  program.path = path_.value();
  program.state = program.check.good ? UploadState::good : UploadState::bad;
  checker_.reset();
}

}  // namespace passo
