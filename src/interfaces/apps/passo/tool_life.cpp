#include "tool_life.hpp"

#include <filesystem>

#include "commands.hpp"
#include "program_input.hpp"
#include "state_folder.hpp"
#include <fmt/format.h>

#include "passo/api/tool_lives.hpp"

namespace passo {

namespace fs = std::filesystem;

std::string tool_records_file(const std::string& given) {
  if (!given.empty()) return given;
  const std::string folder = state_folder();
  return folder.empty() ? std::string() : (fs::path(folder) / "tools.sqlite").string();
}

std::unique_ptr<ToolRecords> open_tool_records(const std::string& file, int& code) {
  std::error_code none;
  if (const fs::path folder = fs::path(file).parent_path(); !folder.empty()) fs::create_directories(folder, none);
  auto records = ToolRecords::open(file);
  if (records) return std::move(*records);
  code = fail(exit_failed, fmt::format("{} [tools.records]", records.error()));
  return nullptr;
}

int CountedCuts::open(const ToolLifeArguments& arguments, const std::string& machine) {
  const std::string file = tool_records_file(arguments.records);
  if (file.empty()) return exit_done;
  int code = exit_done;
  records_ = open_tool_records(file, code);
  if (records_) recorder_.emplace(*records_, machine);
  return code;
}

void end_cuts(CutRecorder* cuts) {
  if (cuts == nullptr || cuts->end()) return;
  note("what the tools have cut was not counted: " + cuts->records().trouble());
}

std::optional<LivesLeft> read_lives(const ToolLifeArguments& arguments, int& code) {
  if (arguments.library.empty()) return LivesLeft();
  Diagnostics findings;
  const auto library = ToolLibrary::read(arguments.library, findings);
  show(findings);
  if (!library) {
    code = exit_bad_program;
    return std::nullopt;
  }
  const std::string file = tool_records_file(arguments.records);
  std::error_code none;
  if (file.empty() || !fs::exists(file, none)) return lives_left(*library, {});
  const auto records = open_tool_records(file, code);
  if (!records) return std::nullopt;
  return lives_left(*library, records->all());
}

}  // namespace passo
