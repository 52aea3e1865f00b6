#include "served_studies.hpp"

#include <vector>

#include <sys/wait.h>

namespace passo {
namespace {

constexpr const char* studied_machine = "machine.toml";
constexpr const char* studied_program = "program.ngc";
constexpr const char* studied_offsets = "work.var";
constexpr const char* studied_tools = "tool.tbl";
constexpr const char* found_loads = "loads.csv";
constexpr const char* found_curves = "curves.svg";

}  // namespace

bool ServedStudies::begin(const StudyOrder& order) {
  process_.end();
  folder_.remove();
  result_ = {};
  if (!folder_.make() || !write_content(folder_.path(studied_machine), order.machine)) return false;
  std::vector<std::string> words;
  if (order.kind == StudyOrder::Kind::tune) {
    words = {"passo", "tune", "--machine", studied_machine, "--picture", found_curves, "--json"};
    words.insert(words.end(), order.options.begin(), order.options.end());
  } else {
    const bool written = write_content(folder_.path(studied_program), order.program) &&
                         write_content(folder_.path(studied_offsets), order.parameters);
    if (!written) return false;
    words = {"passo",   "check",     "--machine",    studied_machine, "--dialect", order.dialect,
             "--loads", found_loads, "--parameters", studied_offsets, "--json",    studied_program};
    if (!order.tools.empty()) {
      if (!write_content(folder_.path(studied_tools), order.tools)) return false;
      words.insert(words.end(), {"--tools", studied_tools});
    }
  }
  if (!process_.begin(folder_.name(), words)) return false;
  result_.state = StudyResult::State::running;
  return true;
}

const StudyResult& ServedStudies::result() {
  const std::optional<int> end = process_.poll();
  if (!end) return result_;
  result_.words = content_of(folder_.path(BackgroundProcess::said_file)).substr(0, BackgroundProcess::longest_words);
  result_.report = content_of(folder_.path(BackgroundProcess::printed_file));
  // 1 and 2: it has found what is wrong, and tells it.
  const bool good = WIFEXITED(*end) && WEXITSTATUS(*end) <= 2 && result_.report.starts_with("{");
  result_.state = good ? StudyResult::State::done : StudyResult::State::failed;
  if (!good && result_.words.empty()) result_.words = words_of_end(*end);
  return result_;
}

std::string ServedStudies::loads() const {
  return content_of(folder_.path(found_loads));
}

std::string ServedStudies::picture() const {
  return content_of(folder_.path(found_curves));
}

}  // namespace passo
