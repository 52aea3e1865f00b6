// Takes any bytes as a program with subs, loops and parameters, in either dialect. The work must be bounded, and every
// place and every number of an operation finite. Every operation must have a canonical call. explain() must say
// something of each line that ran, and nothing of the others.
//
// The first byte chooses: bit 0 the dialect, bit 1 inches, bit 2 block delete, bit 3 whether it is explained.
#include <cmath>
#include <cstdint>
#include <string>

#include "kit/require.hpp"

#include "passo/interpreter/canon.hpp"
#include "passo/interpreter/explain.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {
namespace {

constexpr int most_operations = 3000;

using test::require;

void check_diagnostics(const Diagnostics& diagnostics) {
  for (const Diagnostic& finding : diagnostics.all()) {
    require(!finding.message.empty() && !finding.code.empty(), "a finding without words");
    require(finding.place.column == 0 || finding.text.empty() || finding.place.column - 1 <= finding.text.size(),
            "a finding outside its line");
    static_cast<void>(render(finding, true));
  }
}

void run(const std::string& program, const InterpreterOptions& options) {
  Diagnostics diagnostics;
  Interpreter interpreter(ProgramReader::from_text("fuzz.ngc", program), options, diagnostics);
  CanonPrinter printer;
  std::string canon;
  Operation operation;
  for (int i = 0; i < most_operations && interpreter.next(operation); ++i) {
    canon.clear();
    printer.print(operation, canon);
    const bool is_silent =
        std::holds_alternative<operation::ReadInput>(operation.what);  // rs274 prints nothing for M66
    require(is_silent || (!canon.empty() && canon.back() == '\n'), "no canonical call");
    const bool text = canon.find('"') != std::string::npos || std::holds_alternative<operation::Print>(operation.what);
    require(text || (canon.find("nan") == std::string::npos && canon.find("inf") == std::string::npos),
            "an operation with a number that is not finite");
  }
  check_diagnostics(diagnostics);
}

void explain_all(const std::string& program, const InterpreterOptions& options) {
  Diagnostics diagnostics;
  const Explanations result = explain(ProgramReader::from_text("fuzz.ngc", program), options, {1, 1000}, diagnostics,
                                      {.operations = most_operations, .further_operations = 100});
  for (const Explanation& line : result.lines) {
    require(line.executions > 0 || (line.words.empty() && line.operations.empty()), "words of a line that never ran");
    require(line.executions == 0 || !line.modes.empty(), "a line without modes");
  }
}

}  // namespace
}  // namespace passo

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const unsigned choice = data[0];
  passo::InterpreterOptions options;
  options.idle_passes = 200;
  options.repeated_steps = 20'000;
  if ((choice & 1U) != 0) options.dialect = passo::Dialect::grbl;
  if ((choice & 2U) != 0) options.units = passo::LengthUnits::inch;
  options.block_delete = (choice & 4U) != 0;
  const std::string program(data + 1, data + size);
  passo::run(program, options);
  if ((choice & 8U) != 0) passo::explain_all(program, options);
  return 0;
}
