// explain: what the lines of a program do, in words, and under which modal state each of them runs.
//
// Not from the line alone: the program is run up to it, so that parameters have their values, the active motion is
// known and positions are true. A line in a loop is explained as it is first executed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

// Both of them too.
struct LineRange {
  std::uint32_t first = 1;
  std::uint32_t last = 1;
};

struct Explanation {
  struct Word {
    std::string word;     // as written
    std::string meaning;  // with its value and units
  };
  // What a modal group is set to, or another state of the machine.
  struct Mode {
    std::string name;
    std::string code;  // "G21"; empty where no code says it
    std::string meaning;
    bool set_here = false;  // it was something else before the block
  };
  struct Position {
    Point work;
    Point machine;
  };

  std::uint32_t line = 0;
  std::string text;
  std::uint64_t executions = 0;  // 0: all below is empty, but the findings
  std::vector<Word> words;
  std::vector<std::string> operations;  // as CanonPrinter prints them, without counter and N
  Position before;
  Position after;
  std::vector<Mode> modes;           // as the block runs: its own codes count
  std::vector<Diagnostic> findings;  // what is wrong with the line
};

struct Explanations {
  std::vector<Explanation> lines;
  std::uint32_t lines_in_file = 0;
  bool whole_run = true;  // else the run was cut short, and lines may be executed more often, or later
};

struct ExplainLimits {
  std::uint64_t operations = 10'000'000;       // until every line was seen…
  std::uint64_t further_operations = 200'000;  // …and from then on, to count
};

// `diagnostics` takes what is wrong with the rest of the program too.
Explanations explain(ProgramReader program, const InterpreterOptions& options, LineRange range,
                     Diagnostics& diagnostics, const ExplainLimits& limits = {});

// "X 10 mm, Y 0 mm, Z 5 mm": X Y Z, and of the other axes those that are not at 0.
std::string in_words(const Point& point);

}  // namespace passo
