#include <cstdio>

#include "commands.hpp"
#include "program_input.hpp"

#include "passo/machine_file/machine_description.hpp"

namespace passo {

int machine(const MachineArguments& arguments) {
  Diagnostics diagnostics;
  const auto description = load_machine_file(arguments.machine, diagnostics);
  show(diagnostics);
  if (!description) return exit_bad_machine;
  const std::string text = describe(*description);
  std::fwrite(text.data(), 1, text.size(), stdout);
  return exit_done;
}

}  // namespace passo
