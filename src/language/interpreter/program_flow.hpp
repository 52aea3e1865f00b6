// ProgramFlow: determines the next block. It reads lines, executes O-words, loops, and calls subroutines.
//
// Memory does not grow with the number of lines. The flow stores positions in the files: of open constructs and of
// known subroutines. ProgramLines reads the lines and finds the subroutines. Skipped lines (a branch that is not taken,
// the body of a subroutine at its definition) are read line by line, and only their O-words are parsed. As in
// RS274/NGC, labels distinguish nested constructs.
//
// Calls may be nested 100 deep. A loop with an error inside makes no further pass, and execution continues after it.
// The flow stops a program whose loops or calls repeat too often while the machine does nothing, a program with too
// many steps in one loop or call, and a program that calls missing subroutines a thousand times.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "block_watcher.hpp"
#include "block_words.hpp"
#include "parameters.hpp"
#include "program_lines.hpp"
#include "program_state.hpp"
#include "reporter.hpp"
#include "runaway_guard.hpp"
#include "subprogram_jump.hpp"

#include "passo/gcode/block_parser.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

inline constexpr std::size_t deepest_call = 100;

class ProgramFlow final : public CallStack {
 public:
  struct Options {
    ProgramLines::Options lines;
    RunawayGuard::Limits bounds;
    bool numbered_programs = true;  // false if [RS274NGC]DISABLE_FANUC_STYLE_SUB is set
  };
  enum class End : std::uint8_t { none, file, percent, error };

  ProgramFlow(ProgramReader reader, const Options& options, ProgramState& state, Parameters& parameters,
              SymbolTable& symbols, Reporter& reporter);

  // Returns the next block to execute. Returns null if the program ends, if an O-word left a subroutine
  // (take_left_sub), or if the contour of call_for_contour() ends.
  const Block* next();
  // Adds a line. Only with `open_ended`, when next() has returned null.
  void push_line(std::string_view text) { lines_.push_line(text); }
  // Returns whether the program is a whole one, with M2 or M30. Only before the first block.
  bool is_job() { return !lines_.open_ended() && lines_.has_end(); }
  // Returns whether the next line is not available yet.
  bool waits_for_line() const { return lines_.open_ended() && end_ == End::none; }
  // Returns the line of the call if a subroutine was just left.
  std::optional<std::uint32_t> take_left_sub() { return std::exchange(left_sub_, std::nullopt); }
  // Executes the jump requested by the last block: M98, M99 or a macro. main_ends: an M99 in a main program that is not
  // to run again.
  enum class Followed : std::uint8_t { goes_on, left_sub, main_ends };
  Followed follow(const SubprogramJump& jump);
  End end() const { return end_; }
  // Calls a subroutine. next() then returns the blocks of this call, and null once at its end. Returns false if the
  // subroutine cannot be called.
  bool call_for_contour(Symbol sub, Span span);
  // Counts an operation of the program. `works`: the machine does something, so the loops are not idle.
  void count_operation(bool works) { bounds_.count_operation(works); }

  // Notes that the current block has begun a cycle. If no loop or call contains the block, operations are counted from
  // here.
  void begin_cycle() {
    if (is_outermost()) bounds_.begin();
  }
  // Called before each part of the cycle. Returns false if the cycle has too many operations; the program then ends.
  // `repeated`: the word for the number of repetitions.
  bool may_go_on_with_cycle(Span repeated);

  // Called after M2. Reports the constructs around M2 that are never closed in the file.
  void report_never_closed();
  // Warns about moves after the end of the program.
  void report_moves_after_end() {
    if (!lines_.open_ended() && frames_.empty()) lines_.report_moves_after_end();
  }
  // Called after M2. Returns whether the program began with '%', and the rest of the file has no closing '%'.
  bool lacks_closing_percent() {
    return lines_.lacks_closing_percent(frames_.empty() ? lines_.in_main_file() : frames_.front().return_to);
  }

  void watch(BlockWatcher& watcher) { watcher_ = &watcher; }

  std::vector<CallLocation> calls() const override;

  std::uint64_t offset() const { return lines_.in_main_file().offset; }

 private:
  using SubPlace = ProgramLines::SubPlace;
  using File = ProgramLines::File;
  // The return value of a subroutine: #<_value> and #<_value_returned>.
  class Returned {
   public:
    Returned(SymbolTable& symbols, Parameters& parameters)
        : parameters_(parameters), value_(symbols.intern("_value")), has_value_(symbols.intern("_value_returned")) {
      set(0, false);
    }
    void set(double value, bool has_value) {
      (void)parameters_.set_named(value_, value);
      (void)parameters_.set_named(has_value_, has_value ? 1 : 0);
    }

   private:
    Parameters& parameters_;
    Symbol value_;
    Symbol has_value_;
  };
  // A construct that was entered and not yet left.
  struct Open {
    ControlKind kind = ControlKind::if_;
    Symbol label;
    ReaderPosition at;                // its line
    ReaderPosition after;             // the line after it
    std::uint64_t errors_before = 0;  // number of errors found before it was entered
    std::uint64_t passes_left = 0;    // remaining passes of a repeat
  };
  struct Frame {
    File* caller = nullptr;  // the file to return to
    ReaderPosition return_to;
    Symbol sub;
    SubPlace place;
    std::size_t first_open = 0;
    std::uint64_t errors_before = 0;
    std::uint64_t passes_left = 1;                                     // L of M98, G65, G66
    bool modal_macro = false;                                          // called by G66
    std::optional<std::array<double, sub_parameters>> arguments = {};  // arguments of a macro
  };

  // A numbered program that has ended and is to run again.
  struct Again {
    Frame frame;
    File* file = nullptr;
  };

  const Block* finish(End end);

  // Execution of O-words.
  void obey(const Control& control);
  void begin_sub(Symbol label, const Control& control);
  void call(Symbol label, const Control& control);
  void leave_sub(Symbol label, const Control& control);
  void begin_if(Symbol label, const Control& control);
  void next_branch(Symbol label, const Control& control);
  void begin_while(Symbol label, const Control& control);
  void end_while(Symbol label, const Control& control);
  void end_do(Symbol label, const Control& control);
  void begin_repeat(Symbol label, const Control& control);
  void end_repeat(Symbol label, const Control& control);
  void leave_or_continue_loop(Symbol label, const Control& control);

  // The open constructs of the running subroutine.
  Open& push(ControlKind kind, Symbol label);
  Open* innermost(ControlKind kind, Symbol label);
  Open* require_innermost(ControlKind kind, Symbol label, const Control& control);
  bool any_open() const { return open_.size() > first_open(); }
  std::size_t first_open() const { return frames_.empty() ? 0 : frames_.back().first_open; }
  void go_round(const Open& loop, ReaderPosition to);
  bool may_go_round(const Open& loop);
  bool is_outermost() const { return frames_.empty() && open_.empty(); }

  // Skipping lines: skip_to() reads up to the next O-word of the given kinds that belongs to `from`.
  using Kinds = std::uint32_t;
  static constexpr Kinds kinds(std::initializer_list<ControlKind> list) {
    Kinds bits = 0;
    for (const ControlKind kind : list) bits |= Kinds{1} << static_cast<unsigned>(kind);
    return bits;
  }
  bool skip_to(const Open& from, Kinds wanted);
  bool skip_branch(const Open& from);
  static Kinds end_of(ControlKind construct);

  // Subroutines.
  bool may_call(Span span);
  void enter(const Frame& frame, File* file);
  void leave_frame();
  void report_unknown_sub(Symbol label, Span span, bool numbered);
  void call_program(const SubprogramJump& jump);
  void call_user_code(const SubprogramJump& jump);
  void enter_program(const Frame& frame, File* file);
  void run_again();
  Followed end_program(const SubprogramJump& jump);
  bool restart_main(const SubprogramJump& jump);
  bool check_numbered_programs(Span span, std::string_view what);
  bool check_style(const SubPlace& place, Symbol label, Span span, std::string_view caller);

  bool label_of(const Control& control, Symbol& label);
  void check_used_once(Symbol label, const Control& control);
  bool is_closed_further_on(const Open& open);
  bool argument(const Control& control, double& value);
  void report_unclosed(const Open& open);
  bool stray(Symbol label, const Control& control, FindingWords message, FindingWords expected);
  std::string label_text(Symbol label) const { return passo::label_text(symbols_, label); }

  bool numbered_programs_;
  ProgramState& state_;
  Parameters& parameters_;
  SymbolTable& symbols_;
  Reporter& reporter_;
  Returned returned_;
  ProgramLines lines_;
  RunawayGuard bounds_;
  std::vector<Open> open_;
  std::vector<Frame> frames_;
  std::optional<std::uint32_t> left_sub_;
  std::optional<Again> again_;
  std::size_t contour_depth_ = 0;  // call depth of the contour being read; 0: none
  End end_ = End::none;
  BlockWatcher* watcher_ = nullptr;
};

}  // namespace passo
