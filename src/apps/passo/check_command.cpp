// passo check: interpret the program and build its path, and say what is wrong. Nothing runs.
#include <cstdio>

#include "commands.hpp"
#include "findings_json.hpp"
#include "program_input.hpp"

#include "passo/controller/job.hpp"

namespace passo {
namespace {

nlohmann::ordered_json findings_as_json(const Diagnostics& findings) {
  return {{"good", !findings.any_error()}, {"errors", findings.errors()}, {"findings", as_json(findings.all())}};
}

}  // namespace

int check(const CheckArguments& arguments) {
  Diagnostics diagnostics;
  const auto machine = load_machine_file(arguments.machine, diagnostics);
  show(diagnostics);
  if (!machine) return exit_bad_machine;
  std::optional<ProgramReader> program = open_program(arguments.program);
  const std::optional<InterpreterOptions> options = machine_options(arguments.program);
  if (!program || !options) return exit_bad_program;

  Diagnostics findings;
  const ProgramCheck result = check_program(std::move(*program), *machine, *options, findings);
  if (arguments.json) {
    const auto replace = nlohmann::ordered_json::error_handler_t::replace;
    std::puts(findings_as_json(findings).dump(2, ' ', false, replace).c_str());
  } else {
    show(findings);
    if (result.good) std::printf("%s: no errors\n", arguments.program.program.c_str());
  }
  return result.good ? exit_done : exit_bad_program;
}

}  // namespace passo
