#include "part_job_programs.hpp"

#include <algorithm>
#include <filesystem>

#include "part_job_record.hpp"
#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

// The text without the mark and the number at its beginning; if it has none, the text itself.
std::string_view without_number(std::string_view text, std::string_view mark) {
  if (!text.starts_with(mark)) return text;
  std::string_view rest = text.substr(mark.size());
  while (!rest.empty() && rest.front() >= '0' && rest.front() <= '9') rest.remove_prefix(1);
  return rest.size() + mark.size() < text.size() ? rest : text;
}

// What a job adds to the name of its output: "-2" for a sheet, "-1-T3" for a tool, "-2-1-T3" for both.
bool is_of_sheet_or_tool(std::string_view added) {
  const std::string_view first = without_number(added, "-");
  if (first.size() == added.size()) return false;
  if (first.empty()) return true;
  const std::string_view tool = without_number(first, "-");
  return tool.starts_with("-T") && without_number(tool, "-T").empty();
}

// A record may have been edited: it must not lead to other files.
bool may_be_of_job(const std::string& name, const std::filesystem::path& output) {
  if (name == output.filename().string()) return true;
  const std::string begin = output.stem().string();
  const std::string end = output.extension().string();
  if (!name.starts_with(begin) || !name.ends_with(end) || name.size() < begin.size() + end.size()) return false;
  return is_of_sheet_or_tool(std::string_view(name).substr(begin.size(), name.size() - begin.size() - end.size()));
}

Diagnostic edited(const EarlierProgram& program, Severity severity, std::string message, std::string expected) {
  Diagnostic finding = of_file("job.edited", program.file, std::move(message), std::move(expected));
  finding.severity = severity;
  return finding;
}

}  // namespace

std::string program_of_tool(const std::string& output, std::size_t number, std::int32_t tool) {
  const std::filesystem::path path(output);
  return (path.parent_path() /
          fmt::format("{}-{}-T{}{}", path.stem().string(), number, tool, path.extension().string()))
      .string();
}

std::vector<EarlierProgram> earlier_programs(const nlohmann::ordered_json& record, const std::string& output,
                                             const std::vector<TrialProgram>& programs) {
  std::vector<EarlierProgram> earlier;
  const std::filesystem::path path(output);
  for (const RecordedProgram& written : programs_of_record(record)) {
    if (!may_be_of_job(written.name, path)) continue;
    EarlierProgram program{.file = (path.parent_path() / written.name).string()};
    Diagnostics unreadable;
    const auto text = read_bytes(program.file, {.area = "job", .expected = "a program"}, unreadable);
    if (!text) continue;
    const auto now = std::ranges::find(programs, program.file, &TrialProgram::file);
    program.is_made_again = now != programs.end();
    const bool is_as_now = program.is_made_again && now->text == *text;
    program.is_edited = !is_as_now && fingerprint_of_text(*text) != written.fingerprint;
    earlier.push_back(std::move(program));
  }
  return earlier;
}

void check_edited(const std::vector<EarlierProgram>& earlier, bool overwrites, Diagnostics& findings) {
  for (const EarlierProgram& program : earlier) {
    if (!program.is_edited) continue;
    if (!program.is_made_again) {
      findings.add(edited(program, Severity::warning,
                          "the job does not make this program any more; it was edited, so it stays", "another name"));
    } else if (overwrites) {
      findings.add(edited(program, Severity::warning, "it was edited, and is overwritten", ""));
    } else {
      findings.add(edited(program, Severity::error, "it was edited after the job had written it",
                          "another name for the edited program, another --output, or --force to overwrite it"));
    }
  }
}

std::vector<std::string> remove_old_programs(const std::vector<EarlierProgram>& earlier) {
  std::vector<std::string> removed;
  for (const EarlierProgram& program : earlier) {
    if (program.is_made_again || program.is_edited) continue;
    std::error_code error;
    if (std::filesystem::remove(program.file, error)) removed.push_back(program.file);
  }
  return removed;
}

}  // namespace passo
