// ParsedLine: a parsed line, for tests: its result, its error, and the values of its expressions.
#pragma once

#include <cstdint>
#include <map>
#include <ostream>
#include <string>

#include "passo/gcode/block_parser.hpp"
#include "passo/gcode/expression.hpp"

namespace passo {

inline void PrintTo(const Span& span, std::ostream* out) {
  *out << "column " << span.column << ", length " << span.length;
}

// Stores parameters in maps.
struct Parameters : ParameterValues {
  bool numbered(std::int64_t number, double& value) const override {
    const auto found = numbers.find(number);
    if (found == numbers.end()) return false;
    value = found->second;
    return true;
  }
  bool named(Symbol name, double& value) const override {
    const auto found = names.find(name.id);
    if (found == names.end()) return false;
    value = found->second;
    return true;
  }
  std::map<std::int64_t, double> numbers;
  std::map<std::uint32_t, double> names;
};

class ParsedLine {
 public:
  explicit ParsedLine(std::string line) : text(std::move(line)) {
    good = BlockParser("part.ngc", symbols).parse(text, 7, block, diagnostics);
  }

  const Diagnostic& fault() const { return diagnostics.all().at(0); }
  // Returns "code column length", a short form of the error.
  std::string fault_at() const {
    if (good) return "good";
    return fault().code + " " + std::to_string(fault().place.column) + " " + std::to_string(fault().place.length);
  }
  Evaluation evaluation(const Expression& expression) const { return evaluate(block, expression, parameters); }
  double value(const Expression& expression) const { return evaluation(expression).value(); }
  // Returns the value of word n.
  double value(std::size_t n = 0) const { return value(block.words.at(n).value); }
  std::string printed() const { return print(block, symbols); }

  std::string text;
  SymbolTable symbols;
  Block block;
  Diagnostics diagnostics;
  Parameters parameters;
  bool good = false;
};

}  // namespace passo
