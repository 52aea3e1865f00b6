// Any bytes as the configuration of another controller: either they are refused, with places inside their lines, or the
// machine file is one that our own reader reads without an error, and each value of it has a source or is assumed.
#include <cstdint>
#include <string>
#include <string_view>

#include "kit/require.hpp"

#include "passo/controller_file/controller_file.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {
namespace {

using test::require;

void check_findings(const Diagnostics& diagnostics) {
  for (const Diagnostic& finding : diagnostics.all()) {
    require(finding.code.starts_with("import.") && !finding.message.empty(), "a finding without words");
    require(finding.code != "import.bad-result", "a machine file that is wrong");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
}

void check_import(std::string_view text, std::optional<ImportFormat> format) {
  Diagnostics diagnostics;
  const auto machine = import_controller_text({.file = "fuzz", .text = text}, format, diagnostics);
  check_findings(diagnostics);
  require(machine.has_value() == !diagnostics.any_error(), "refused without a word, or taken with an error");
  if (!machine) return;
  Diagnostics wrong;
  require(parse_machine(machine->toml, "fuzz.toml", wrong, MachineUse::any_board).has_value(),
          "a machine file that cannot be read");
  require(!machine->understood.empty() && !machine->warnings.empty(), "nothing to say");
  require(!describe(*machine).empty(), "no report");
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  passo::check_import(text, std::nullopt);
  for (const auto format : {passo::ImportFormat::settings, passo::ImportFormat::fluidnc, passo::ImportFormat::linuxcnc,
                            passo::ImportFormat::mach3}) {
    if (size > 0 && data[0] % 5 == static_cast<std::uint8_t>(format)) passo::check_import(text, format);
  }
  return 0;
}
