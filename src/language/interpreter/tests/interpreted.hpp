// Interprets a program from text to canonical calls, for tests.
#pragma once

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "passo/interpreter/canon.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

struct Interpreted {
  std::string canon;                  // the canonical calls, in the format of `rs274 -g`
  std::vector<Operation> operations;  // the operations, without borrowed text
  std::vector<std::vector<operation::ControlPoint>> splines;
  Diagnostics diagnostics{1000};

  std::string rendered() const { return render(diagnostics, false); }
  // Returns only the calls, one per line: without the counter, the N column, the six calls that start every program,
  // and ON_RESET.
  std::string calls() const;
  template <class What>
  std::vector<What> all() const {
    std::vector<What> found;
    for (const Operation& operation : operations) {
      if (const What* what = std::get_if<What>(&operation.what)) found.push_back(*what);
    }
    return found;
  }
  template <class What>
  What last() const {
    const std::vector<What> found = all<What>();
    return found.empty() ? What{} : found.back();
  }
};

inline void interpret(ProgramReader reader, const InterpreterOptions& options, Interpreted& result,
                      const MachineResults& answers = no_answers()) {
  Interpreter interpreter(std::move(reader), options, result.diagnostics, answers);
  CanonPrinter printer(options.machine_units);
  Operation operation;
  while (interpreter.next(operation)) {
    printer.print(operation, result.canon);
    const bool borrows = std::holds_alternative<operation::Comment>(operation.what) ||
                         std::holds_alternative<operation::Message>(operation.what) ||
                         std::holds_alternative<operation::Print>(operation.what) ||
                         std::holds_alternative<operation::Log>(operation.what) ||
                         std::holds_alternative<operation::SetToolTableEntry>(operation.what) ||
                         std::holds_alternative<operation::NurbsFeed>(operation.what);
    if (const auto* curve = std::get_if<operation::NurbsFeed>(&operation.what)) {
      result.splines.emplace_back(curve->points.begin(), curve->points.end());
    }
    if (!borrows) result.operations.push_back(operation);
  }
}

inline Interpreted interpret_text(const std::string& text, const InterpreterOptions& options = {},
                                  const MachineResults& answers = no_answers()) {
  Interpreted result;
  interpret(ProgramReader::from_text("test.ngc", text), options, result, answers);
  return result;
}

inline std::string Interpreted::calls() const {
  std::string calls;
  std::size_t line = 0;
  for (std::size_t at = 0; at < canon.size(); ++line) {
    const std::size_t end = canon.find('\n', at);
    const std::string text = canon.substr(at, end - at);
    at = end + 1;
    constexpr std::size_t head = 13;  // "    7 N..... "
    const bool counted = text.size() > head && text[5] == ' ' && text[6] == 'N';
    const std::string call = counted ? text.substr(head) : text;
    if (line >= 6 && call != "ON_RESET()") calls += call + "\n";
  }
  return calls;
}

inline std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace passo
