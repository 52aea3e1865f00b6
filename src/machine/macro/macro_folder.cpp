#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "passo/diagnostics/file_bytes.hpp"
#include "passo/macro/macro.hpp"

namespace passo {
namespace {

constexpr std::size_t most_files = 1000;

std::vector<std::filesystem::path> programs_of(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code trouble;
  for (std::filesystem::directory_iterator one(folder, trouble), end; !trouble && one != end; one.increment(trouble)) {
    std::error_code ignored;
    if (one->path().extension() != ".ngc" || !one->is_regular_file(ignored)) continue;
    files.push_back(one->path());
    if (files.size() == most_files) break;
  }
  std::ranges::sort(files);
  return files;
}

}  // namespace

MacroFolder read_macro_folder(const std::string& folder) {
  MacroFolder all;
  for (const std::filesystem::path& path : programs_of(folder)) {
    const auto bytes =
        read_bytes(path.string(), {.area = "macro", .expected = "a macro", .most = Macro::longest}, all.findings);
    if (!bytes || !has_macro_head(*bytes)) continue;
    auto macro = parse_macro(*bytes, path.stem().string(), path.filename().string(), all.findings);
    if (macro && all.macros.size() < MacroFolder::most_macros) all.macros.push_back(std::move(*macro));
  }
  return all;
}

}  // namespace passo
