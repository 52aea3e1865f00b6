// explain: explains in words what the lines of a program do, and with which modal state.
//
// The program is run up to the line, so that parameter values, the active motion code and positions are correct. A line
// in a loop is explained as in its first execution.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

// A range of lines, including `first` and `last`.
struct LineRange {
  std::uint32_t first = 1;
  std::uint32_t last = 1;
};

struct Explanation {
  struct Word {
    std::string word;     // as written
    std::string meaning;  // with its value and units
  };
  // The setting of a modal group, or another state of the machine.
  struct Mode {
    std::string name;
    std::string code;  // "G21"; empty if no code sets it
    std::string meaning;
    bool set_here = false;  // the mode was different before the block
  };
  struct Position {
    Point work;
    Point machine;
  };

  std::uint32_t line = 0;
  std::string text;
  std::uint64_t executions = 0;  // 0: all members below are empty, except the findings
  std::vector<Word> words;
  std::vector<std::string> operations;  // as CanonPrinter prints them, without counter and N
  Position before;
  Position after;
  // The moves of the block. The time is that at the programmed feed rate, without ramps. Empty: the feed rate is not
  // known before the machine runs (G95 without a spindle speed), or there is none.
  struct Moves {
    double feed_length = 0;               // mm; degrees for a move of rotary axes only
    bool in_degrees = false;              // the last feed move
    PerAxis<double> surface_radius{};     // mm, of the surfaces that count in feed_length (A, B, C); 0: none
    double rapid_length = 0;              // mm
    std::optional<double> feed_time = 0;  // s
  };
  Moves moves;
  std::vector<Mode> modes;           // the modes during the block, including its own codes
  std::vector<Diagnostic> findings;  // the errors and warnings of the line
};

struct Explanations {
  std::vector<Explanation> lines;
  std::uint32_t lines_in_file = 0;
  bool whole_run = true;  // false: the run was ended early, so lines may run more often, or later
};

struct ExplainLimits {
  std::uint64_t operations = 10'000'000;       // limit of operations until every line was reached
  std::uint64_t further_operations = 200'000;  // limit of operations after that, to count executions
};

// What the machine makes of the words. Empty: any machine.
struct ExplainedMachine {
  // The radius of the cylinder that A, B or C turns; 0: the distance of the tool from the axis, which is Z.
  PerAxis<std::optional<Mm>> surface_radius{};
  std::optional<double> angle_tolerance = {};  // degrees: how far A, B and C may leave a blended path
};

// `diagnostics` also receives the findings of the other lines.
Explanations explain(ProgramReader program, const InterpreterOptions& options, LineRange range,
                     Diagnostics& diagnostics, const ExplainLimits& limits = {}, const ExplainedMachine& machine = {});

// Returns e.g. "X 10 mm, Y 0 mm, Z 5 mm": X Y Z, and the other axes that are not at 0.
std::string in_words(const Point& point);

}  // namespace passo
