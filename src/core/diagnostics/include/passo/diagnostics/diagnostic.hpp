// Diagnostic: an error, warning or note about the user's file: position, message, expectation, stable code.
//
// Diagnostics are collected, not thrown: one run over a file shows them all, up to a limit. Each has a stable code
// ("gcode.unknown-word"). Scripts and search engines may rely on the code.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "passo/diagnostics/finding_words.hpp"

namespace passo {

// A position in a file. Line and column count from 1; columns and length are in bytes. Line 0 means the file as a
// whole.
struct SourceLocation {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint32_t length = 1;
  friend bool operator==(const SourceLocation&, const SourceLocation&) = default;
};

enum class Severity : std::uint8_t { warning, error };

// A subroutine that was running, and the position of its call.
struct CallLocation {
  std::string sub;   // "o100", "o<name>", "O1000"
  std::string file;  // the file that holds the call
  std::uint32_t line = 0;
  friend bool operator==(const CallLocation&, const CallLocation&) = default;
};

struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;  // "gcode.missing-feed": area, dot, what is wrong; never changes once published
  std::string file;  // the file name as the user wrote it
  SourceLocation place;
  FindingWords message;   // one sentence without a full stop: what is wrong, with the value found
  FindingWords expected;  // the correct form, or how to correct the error; may be empty
  std::string text;       // the source line, for the caret; may be empty
  std::string rule = {};  // the standard that the program violates, or another program's number for the error; may be
                          // empty
  std::vector<CallLocation> calls = {};  // the subroutines that were running, the innermost first
  // For a repeated warning: the other lines of the file, in ascending order.
  std::vector<std::uint32_t> more_lines = {};

  static constexpr std::size_t most_lines = 1000;  // further lines are not recorded
  // Adds another line with the same finding.
  void add_line(std::uint32_t line);
};

// Collects diagnostics up to a limit of errors. Errors above the limit are counted, not kept. The same finding at the
// same position (a line in a loop) is kept and counted once. A repeated warning is kept once, with the list of its
// other lines.
class Diagnostics {
 public:
  explicit Diagnostics(std::size_t limit = 20) : limit_(limit) {}

  void add(Diagnostic diagnostic);
  // From now on errors may be mere consequences of `reason`, so they are kept as warnings. Errors passed to
  // add_certain() stay errors. An empty reason ends this mode.
  void doubt_errors(std::string reason) { doubt_ = std::move(reason); }
  void add_certain(Diagnostic diagnostic);
  // Returns true if a warning of this code and file is already kept; the line is added to it. A program may cause a
  // warning a million times: the first one is kept with its message, and the others are only counted.
  bool count_repeated(std::string_view code, std::string_view file, std::uint32_t line);
  // Returns the rule for a diagnostic without one. The stage that knows the rules sets this function.
  using RuleOf = std::string (*)(const Diagnostic& diagnostic);
  void look_up_rules_with(RuleOf rule_of) { rule_of_ = rule_of; }
  // Removes all findings. The settings are kept.
  void clear() {
    errors_ = 0;
    all_.clear();
  }
  const std::vector<Diagnostic>& all() const { return all_; }
  std::size_t errors() const { return errors_; }
  bool any_error() const { return errors_ > 0; }
  // True when the error limit is reached; a stage may then stop looking for more.
  bool full() const { return errors_ >= limit_; }

 private:
  std::size_t limit_;
  RuleOf rule_of_ = nullptr;
  std::string doubt_;
  std::size_t errors_ = 0;
  std::vector<Diagnostic> all_;
};

// Formats a diagnostic like a compiler. A long source line is shown as an excerpt around the position:
//
//   part.ngc:3:5: error: no feed rate is set [gcode.missing-feed]
//       3 | G1 X10
//         |    ^~~
//         = expected: F before the first feed move, or on it
//         = rule: RS274/NGC 3.5.2, G1
//         = in o<slot>, called at part.ngc:9
//         = and 12 more, lines 40, 52, 66, ...
//
// In a long call stack, only the innermost and the outermost calls are shown.
std::string render(const Diagnostic& diagnostic, bool colour);
// Formats all diagnostics as above, and adds a last line with their number ("2 errors").
std::string render(const Diagnostics& diagnostics, bool colour);

// Lists the other lines with the same finding: "and 12 more, lines 40, 52, 66, ...". Empty: there are none.
std::string more_lines_in_words(const Diagnostic& diagnostic);

// Returns the word of `candidates` nearest to `word` (edit distance, at most a third of its length), or an empty view.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);

// Returns the known word that the user probably meant: the nearest one, one with two letters swapped ("naem"), or one
// that is longer or shorter at its end ("max_velocity"). Empty: no guess.
std::string_view suggestion(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace passo
