#include "passo/machine_import/machine_import.hpp"

#include <fmt/format.h>

#include "format_imports.hpp"
#include "import_context.hpp"
#include "machine_text.hpp"
#include "model_completion.hpp"

namespace passo {
namespace {

void import_model(ImportFormat format, const SourceNode& tree, ImportContext& context, ImportedModel& model) {
  switch (format) {
    case ImportFormat::settings: return import_settings(tree, context, model);
    case ImportFormat::fluidnc: return import_fluidnc(tree, context, model);
    case ImportFormat::linuxcnc: return import_linuxcnc(tree, context, model);
    case ImportFormat::mach3: return import_mach3(tree, context, model);
  }
}

std::string place_of(std::uint32_t line) {
  return line == 0 ? "" : fmt::format(" (line {})", line);
}

}  // namespace

std::optional<ImportedMachine> import_machine(ImportFormat format, const SourceNode& tree, const ImportSource& source,
                                              Diagnostics& diagnostics) {
  ImportedMachine result{.format = format};
  ImportedModel model;
  ImportContext context(source, result, diagnostics);
  import_model(format, tree, context, model);
  const auto board = complete_model(model, context);
  if (!board || context.has_failed()) return std::nullopt;
  result.toml = write_machine_text(model, *board, context);
  context.warn("there are no motor data: Passo cannot check whether the motors lose steps; see [axis.X.torque]");
  return result;
}

std::string describe(const ImportedMachine& machine) {
  std::string text = fmt::format("{}: {} {} understood, {} not taken over\n", machine.controller,
                                 machine.understood.size(), machine.understood.size() == 1 ? "value" : "values",
                                 machine.unmapped.size());
  const auto heading = [&](const char* words, std::size_t count) {
    if (count > 0) text += fmt::format("\n{}:\n", words);
  };
  heading("Understood", machine.understood.size());
  for (const UnderstoodValue& value : machine.understood) {
    text += fmt::format("  {} = {} -> {}\n", value.source, value.value, value.target);
  }
  heading("Assumed, because the source does not have it", machine.assumed.size());
  for (const AssumedValue& value : machine.assumed) text += fmt::format("  {}: {}\n", value.target, value.reason);
  heading("Not taken over", machine.unmapped.size());
  for (const UnmappedValue& value : machine.unmapped) {
    text += fmt::format("  {}{}{}{}: {}\n", value.source, value.value.empty() ? "" : " = ", value.value,
                        place_of(value.line), value.reason.empty() ? "not understood" : value.reason);
  }
  heading("To check", machine.warnings.size());
  for (const std::string& warning : machine.warnings) text += fmt::format("  {}\n", warning);
  return text;
}

}  // namespace passo
