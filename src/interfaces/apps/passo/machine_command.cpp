#include <cstdio>
#include <optional>

#include "board_settings.hpp"
#include "commands.hpp"
#include "grbl_connection.hpp"
#include "named_files.hpp"
#include "program_input.hpp"
#include <nlohmann/json.hpp>

#include "passo/controller_file/controller_file.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/report/output_file.hpp"

namespace passo {
namespace {

std::string import_json(const ImportedMachine& machine) {
  nlohmann::ordered_json json = {
      {"format", name_of(machine.format)}, {"controller", machine.controller}, {"machine_file", machine.toml}};
  json["understood"] = nlohmann::ordered_json::array();
  for (const UnderstoodValue& value : machine.understood) {
    json["understood"].push_back(
        {{"source", value.source}, {"value", value.value}, {"target", value.target}, {"line", value.line}});
  }
  json["assumed"] = nlohmann::ordered_json::array();
  for (const AssumedValue& value : machine.assumed) {
    json["assumed"].push_back({{"target", value.target}, {"reason", value.reason}});
  }
  json["unmapped"] = nlohmann::ordered_json::array();
  for (const UnmappedValue& value : machine.unmapped) {
    json["unmapped"].push_back(
        {{"source", value.source}, {"value", value.value}, {"reason", value.reason}, {"line", value.line}});
  }
  json["warnings"] = machine.warnings;
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

int write_new_machine(const std::string& text, const std::string& path) {
  auto file = OutputFile::open(path);
  if (!file) return fail(exit_failed, file.error().message);
  file->write(text);
  const auto done = file->commit();
  return done ? exit_done : fail(exit_failed, done.error().message);
}

int import_machine_file(const MachineArguments& arguments) {
  const bool is_board = names_grbl_machine(arguments.from);
  NamedFiles files;
  if (!is_board) files.reads("--from", arguments.from);
  files.writes("--output", arguments.output);
  if (!files.are_apart()) return exit_bad_program;
  Diagnostics diagnostics;
  std::optional<ImportedMachine> machine;
  if (is_board) {
    int code = exit_done;
    const auto told = controller_text_of(arguments.from, code);
    if (!told) return code;
    machine = import_controller_text({.file = arguments.from, .text = *told}, import_format_of(arguments.format),
                                     diagnostics);
  } else {
    machine = import_controller_file(arguments.from, import_format_of(arguments.format), diagnostics);
  }
  show(diagnostics);
  if (!machine) return exit_bad_program;
  if (!arguments.output.empty()) {
    if (const int code = write_new_machine(machine->toml, arguments.output); code != exit_done) return code;
  }
  if (arguments.json) {
    const std::string json = import_json(*machine);
    std::fwrite(json.data(), 1, json.size(), stdout);
    return flush_output();
  }
  const std::string report = describe(*machine);
  std::fwrite(report.data(), 1, report.size(), stderr);
  if (arguments.output.empty()) std::fwrite(machine->toml.data(), 1, machine->toml.size(), stdout);
  return flush_output();
}

}  // namespace

int machine(const MachineArguments& arguments) {
  if (!arguments.from.empty()) return import_machine_file(arguments);
  if (arguments.machine.empty()) {
    return fail(exit_bad_program, "give a machine file, or --from and the configuration of another controller");
  }
  Diagnostics diagnostics;
  const auto description = load_machine_file(arguments.machine, diagnostics, MachineUse::any_board);
  show(diagnostics);
  if (!description) return exit_bad_machine;
  const std::string text = describe(*description);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return exit_done;
}

}  // namespace passo
