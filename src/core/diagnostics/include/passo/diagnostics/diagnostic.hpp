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

// A place in a file. Line and column count from 1; columns and length are in bytes. Line 0 means the file as a whole.
struct SourcePlace {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  std::uint32_t length = 1;
  friend bool operator==(const SourcePlace&, const SourcePlace&) = default;
};

enum class Severity : std::uint8_t { warning, error };

// A sub that was running, and the place that called it.
struct CallPlace {
  std::string sub;   // "o100", "o<name>", "O1000"
  std::string file;  // the file that holds the call
  std::uint32_t line = 0;
  friend bool operator==(const CallPlace&, const CallPlace&) = default;
};

struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;  // "gcode.missing-feed": area, dot, what is wrong; never changes once published
  std::string file;  // as the user named it
  SourcePlace place;
  FindingWords message;   // one sentence without a full stop: what is wrong, with the value found
  FindingWords expected;  // what would have been right, or how to correct it; may be empty
  std::string text;       // the source line, for the caret; may be empty
  std::string rule = {};  // the document that makes this wrong, or another program's number for it; may be empty
  std::vector<CallPlace> calls = {};  // the subs that were running, the innermost first
  // Of a warning that a program earns more than once: the other lines of the file, rising.
  std::vector<std::uint32_t> more_lines = {};

  static constexpr std::size_t most_lines = 1000;  // beyond that, lines are not noted
  // The same was found in this line, too.
  void add_line(std::uint32_t line);
};

// Collects diagnostics up to a limit of errors. Errors above the limit are counted, not kept. The same finding at the
// same place (a line in a loop) is kept and counted once. A warning that says the same of other lines is kept once, and
// notes those lines.
class Diagnostics {
 public:
  explicit Diagnostics(std::size_t limit = 20) : limit_(limit) {}

  void add(Diagnostic diagnostic);
  // From now on an error may be a mere consequence of `reason`, so errors are kept as warnings. Errors given to
  // add_certain() stay errors. An empty reason ends this.
  void doubt_errors(std::string reason) { doubt_ = std::move(reason); }
  void add_certain(Diagnostic diagnostic);
  // True: a warning of this code and file is kept already, and gets the line as one more. A program may cause a warning
  // a million times: the first one is kept with its message, and the others are only counted.
  bool count_repeated(std::string_view code, std::string_view file, std::uint32_t line);
  // Gives the rule of a diagnostic that comes without one. The stage that knows the rules sets it.
  using RuleOf = std::string (*)(const Diagnostic& diagnostic);
  void look_up_rules_with(RuleOf rule_of) { rule_of_ = rule_of; }
  // Forgets what was found. The settings are kept.
  void clear() {
    errors_ = 0;
    all_.clear();
  }
  const std::vector<Diagnostic>& all() const { return all_; }
  std::size_t errors() const { return errors_; }
  bool any_error() const { return errors_ > 0; }
  // True when no more errors are kept; a stage may then stop looking for more.
  bool full() const { return errors_ >= limit_; }

 private:
  std::size_t limit_;
  RuleOf rule_of_ = nullptr;
  std::string doubt_;
  std::size_t errors_ = 0;
  std::vector<Diagnostic> all_;
};

// The form that compilers use. A long source line is shown as a window around the place:
//
//   part.ngc:3:5: error: no feed rate is set [gcode.missing-feed]
//       3 | G1 X10
//         |    ^~~
//         = expected: F before the first feed move, or on it
//         = rule: RS274/NGC 3.5.2, G1
//         = in o<slot>, called at part.ngc:9
//         = and 12 more, lines 40, 52, 66, ...
//
// Of a long stack of calls, only the innermost and the outermost are shown.
std::string render(const Diagnostic& diagnostic, bool colour);
// All diagnostics, each as above, and a last line with their number ("2 errors").
std::string render(const Diagnostics& diagnostics, bool colour);

// "and 12 more, lines 40, 52, 66, ...": the other lines with the same finding. Empty: there are none.
std::string more_lines_in_words(const Diagnostic& diagnostic);

// The word of `candidates` nearest to `word` (edit distance, at most a third of its length), or an empty view.
std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates);

// The word that a user probably meant by a name that is not known: the nearest name, or a name with swapped letters
// ("naem"), or one that is longer or shorter at its end ("max_velocity"). An empty view: no guess.
std::string_view suggestion(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace passo
