#include "program_input.hpp"

#include <cstdio>
#include <cstdlib>

#include <unistd.h>

namespace passo {

bool is_terminal(int descriptor) {
  return isatty(descriptor) != 0;
}

std::optional<ProgramReader> open_program(const ProgramArguments& arguments) {
  Result<ProgramReader, Diagnostic> reader = ProgramReader::open(arguments.program);
  if (reader) return std::move(*reader);
  Diagnostics diagnostics;
  diagnostics.add(reader.error());
  show(diagnostics);
  return std::nullopt;
}

InterpreterOptions interpreter_options(const ProgramArguments& arguments) {
  InterpreterOptions options;
  options.block_delete = arguments.block_delete;
  options.units = arguments.inches ? LengthUnits::inch : LengthUnits::mm;
  options.dialect = arguments.dialect == "grbl" ? Dialect::grbl : Dialect::linuxcnc;
  return options;
}

void show(const Diagnostics& diagnostics) {
  // https://no-color.org
  const bool colour = is_terminal(STDERR_FILENO) && std::getenv("NO_COLOR") == nullptr;
  const std::string text = render(diagnostics, colour);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace passo
