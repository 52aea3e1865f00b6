// Takes any bytes as a tool table, a parameter file or a settings file. The file must be refused with places inside its
// lines, or taken with bounded, finite contents. A parameter file that is written and read again must say the same.
//
// The first byte chooses the kind of file.
#include <cmath>
#include <cstdint>
#include <string>

#include "kit/require.hpp"
#include <sys/mman.h>
#include <unistd.h>

#include "passo/interpreter/parameter_file.hpp"
#include "passo/interpreter/settings_file.hpp"
#include "passo/interpreter/tool_table_file.hpp"

namespace passo {
namespace {

using test::require;

// The readers take paths; this one is of a file in memory.
class FileInMemory {
 public:
  explicit FileInMemory(const std::string& text) : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC)) {
    require(descriptor_ >= 0, "no file in memory");
    require(::write(descriptor_, text.data(), text.size()) == static_cast<ssize_t>(text.size()), "not written");
  }
  ~FileInMemory() { ::close(descriptor_); }
  FileInMemory(const FileInMemory&) = delete;
  FileInMemory& operator=(const FileInMemory&) = delete;
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

void check_answer(bool good, const Diagnostics& diagnostics) {
  require(good == !diagnostics.any_error(), "refused without a word, or taken with an error");
  for (const Diagnostic& finding : diagnostics.all()) {
    require(!finding.message.empty() && !finding.code.empty(), "a finding without words");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
}

void check_tools(const std::string& path, LengthUnits units) {
  Diagnostics diagnostics;
  ToolTable table;
  check_answer(read_tool_table(path, units, table, diagnostics), diagnostics);
  require(table.all().size() <= ToolTable::most_tools, "too many tools");
  for (const auto& [number, tool] : table.all()) {
    require(number == tool.number && table.find(number) == &tool, "a tool under another number");
    require(tool.orientation >= 0 && tool.orientation <= 9, "an orientation that no tool has");
    for (const double value : tool.offset.values) require(std::isfinite(value), "an offset that is not finite");
    require(std::isfinite(tool.diameter.value()) && std::isfinite(tool.front_angle_deg) &&
                std::isfinite(tool.back_angle_deg),
            "a shape that is not finite");
  }
}

void check_parameters(const std::string& path) {
  Diagnostics diagnostics;
  SavedParameters parameters;
  const bool good = read_parameter_file(path, parameters, diagnostics);
  check_answer(good, diagnostics);
  if (!good) return;
  const std::string text = parameter_file_text(parameters);
  SavedParameters again;
  require(read_parameter_file(FileInMemory(text).path(), again, diagnostics) || text.empty(), "not read again");
  require(parameter_file_text(again) == text, "another file when written again");
}

void check_settings(const std::string& path, const std::string& text) {
  Diagnostics diagnostics;
  SettingsFile settings;
  check_answer(settings.read(path, diagnostics), diagnostics);
  static_cast<void>(settings.machine_units());
  static_cast<void>(settings.sub_folders());
  static_cast<void>(settings.path_of("EMCIO", "TOOL_TABLE"));
  if (const auto value = settings.parameter(text.substr(0, text.find('\n')))) {
    require(std::isfinite(*value), "a setting that is not finite");
  }
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(data + 1, data + size);
  const passo::FileInMemory file(text);
  switch (data[0] % 4) {
    case 0: passo::check_tools(file.path(), passo::LengthUnits::mm); break;
    case 1: passo::check_tools(file.path(), passo::LengthUnits::inch); break;
    case 2: passo::check_parameters(file.path()); break;
    default: passo::check_settings(file.path(), text); break;
  }
  return 0;
}
