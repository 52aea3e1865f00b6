// passo canon: prints the operations that the interpreter makes of a program.
#include <cstdio>

#include "commands.hpp"
#include "named_files.hpp"
#include "program_input.hpp"

#include "passo/interpreter/canon.hpp"
#include "passo/report/output_file.hpp"

namespace passo {
namespace {

constexpr std::size_t written_at_once = 65'536;

}  // namespace

int canon(const CanonArguments& arguments) {
  std::optional<ProgramReader> program = streamed_program(arguments.program);
  std::optional<InterpreterOptions> options = interpreter_options(arguments.program);
  if (!program || !options) return exit_bad_program;
  NamedFiles files = files_of(arguments.program, *options);
  files.writes("--output", arguments.output);
  if (!files.are_apart()) return exit_bad_program;
  if (options->tools.name.empty()) options->tools = example_tools();
  Result<OutputFile, OutputError> output = OutputFile::open(arguments.output.empty() ? "-" : arguments.output);
  if (!output) {
    std::fprintf(stderr, "passo: error: %s\n", output.error().message.c_str());
    return exit_failed;
  }

  Diagnostics findings;
  Interpreter interpreter(std::move(*program), *options, findings);
  CanonPrinter printer(options->machine_units);
  FindingsDisplay display(findings);
  Operation operation;
  std::string text;
  while (!output->failed() && !findings.full() && interpreter.next(operation)) {
    printer.print(operation, text);
    if (text.size() >= written_at_once) {
      output->write(text);
      text.clear();
    }
    display.update();
  }
  output->write(text);
  display.finish();
  // Standard output gets what was good. A file appears only if the whole program is good.
  if (findings.any_error() && !arguments.output.empty()) return exit_bad_program;
  const Status<OutputError> written = output->commit();
  if (!written) {
    std::fprintf(stderr, "passo: error: %s\n", written.error().message.c_str());
    return exit_failed;
  }
  return findings.any_error() ? exit_bad_program : exit_done;
}

}  // namespace passo
