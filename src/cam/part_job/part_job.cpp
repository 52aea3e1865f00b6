#include "passo/part_job/part_job.hpp"

#include <algorithm>
#include <array>
#include <filesystem>

#include "part_job_reader.hpp"

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/toml/fit_for_parser.hpp"

namespace passo {
namespace {

constexpr std::array<std::string_view, 9> part_kind_names = {"face",    "profile", "pocket", "drill",      "bore",
                                                             "engrave", "chamfer", "relief", "thread-mill"};

std::string folder_of(const std::string& file) {
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? "" : file.substr(0, slash + 1);
}

}  // namespace

std::string_view name_of(PartKind kind) {
  return part_kind_names[static_cast<std::size_t>(kind)];
}

std::optional<PartKind> part_kind_of(std::string_view name) {
  const auto* const found = std::ranges::find(part_kind_names, name);
  if (found == part_kind_names.end()) return std::nullopt;
  return static_cast<PartKind>(found - part_kind_names.begin());
}

std::vector<std::string_view> names_of_part_kinds() {
  return {part_kind_names.begin(), part_kind_names.end()};
}

bool PartOperation::has(std::string_view key) const {
  return std::ranges::find(keys, key, &PartKey::name) != keys.end();
}

Diagnostic PartJob::finding(const char* code, const SourceLocation& place, std::string message,
                            std::string expected) const {
  const bool has_line = place.line > 0 && place.line <= lines.size();
  return {.severity = Severity::error,
          .code = code,
          .file = file,
          .place = place,
          .message = std::move(message),
          .expected = std::move(expected),
          .text = has_line ? lines[place.line - 1] : ""};
}

std::vector<CamOption> cam_options_of(PartOperation& operation) {
  return std::visit([](auto& arguments) { return cam_options_of(arguments); }, operation.arguments);
}

std::optional<PartJob> parse_part_job(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  Diagnostics found(most_sorted_errors);
  const TomlReporter reporter(text, file, found, {.area = "job", .words = "a job file"});
  PartJob job;
  job.file = file;
  job.folder = folder_of(file);
  for (std::uint32_t line = 1; line <= reporter.line_count(); ++line) job.lines.emplace_back(reporter.line(line));
  if (is_fit_for_parser(reporter)) {
    const TomlDocument document = parse_toml(std::string(text), reporter);
    PartJobReader(document, reporter, job).read();
  }
  hand_over(found, diagnostics);
  if (found.any_error()) return std::nullopt;
  if (job.name.empty()) job.name = std::filesystem::path(file).stem().string();
  if (job.output.empty()) job.output = job.folder + std::filesystem::path(file).stem().string() + ".ngc";
  return job;
}

std::optional<PartJob> read_part_job(const std::string& path, Diagnostics& diagnostics) {
  constexpr std::size_t most_bytes = 1U << 20U;
  const auto text = read_bytes(
      path, {.area = "job", .expected = "a job file: tables and keys in TOML", .most = most_bytes}, diagnostics);
  if (!text) return std::nullopt;
  return parse_part_job(*text, path, diagnostics);
}

}  // namespace passo
