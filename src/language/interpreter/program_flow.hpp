// ProgramFlow: which block comes next. It reads lines, obeys O-words, goes back for loops and jumps to subs.
//
// Memory does not grow with the number of lines. The flow remembers places in the files: of open constructs and of subs
// that were met. The flow also keeps the blocks of some hundred lines that come again (KeptBlocks). Skipped lines (a
// branch that is not taken, the body of a sub at its definition) are read line by line, and only their O-words are
// parsed. As in RS274/NGC a construct's label tells the construct from others inside it. A sub that is called before it
// was met is looked for in the rest of the file, then in the other files that are open, then in NAME.ngc beside the
// program and in the folders that the options name. Each file is searched once.
//
// A line that is kept costs about 25 ns before it is executed. A line that is parsed costs 100 to 200 ns.
//
// Calls nest 100 deep at most. A loop with an error inside makes no further pass, and the run goes on after it. The
// flow stops a program that goes round its loops, or calls, too often while the machine does nothing, a program whose
// loop or call comes to too many steps in all, and a program that calls a thousand times what is not there.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "block_watcher.hpp"
#include "block_words.hpp"
#include "kept_blocks.hpp"
#include "parameters.hpp"
#include "program_state.hpp"
#include "reporter.hpp"
#include "subprogram_jump.hpp"

#include "passo/gcode/block_parser.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

inline constexpr std::size_t deepest_call = 100;

class ProgramFlow final : public CallStack {
 public:
  struct Options {
    bool block_delete = false;
    std::uint64_t idle_passes = 0;
    std::uint64_t repeated_steps = 0;
    std::uint64_t main_passes = 1;
    std::vector<std::string> sub_folders;  // after the program's own
    Dialect dialect = Dialect::linuxcnc;
    bool numbered_programs = true;  // false: [RS274NGC]DISABLE_FANUC_STYLE_SUB
    bool open_ended = false;        // the lines come one by one, with push_line()
    LetterSet more_grbl_axes = {};  // that the dialect of grbl takes beside X, Y and Z
  };
  enum class End : std::uint8_t { none, file, percent, error };

  ProgramFlow(ProgramReader reader, const Options& options, ProgramState& state, Parameters& parameters,
              SymbolTable& symbols, Reporter& reporter);

  // The next block to execute. Null: the program ends, or an O-word left a sub (take_left_sub), or the contour of
  // call_for_contour() ends.
  const Block* next();
  // Only with `open_ended`, when next() has returned null.
  void push_line(std::string_view text) { files_.front()->reader.push_line(text); }
  // True: the next line was not given yet.
  bool waits_for_line() const { return options_.open_ended && end_ == End::none; }
  // Tells whether a sub was just left, and the line of its call.
  std::optional<std::uint32_t> take_left_sub() { return std::exchange(left_sub_, std::nullopt); }
  // Makes the jump that the block just executed asks for: M98, M99 or a macro. main_ends: there was an M99 in the main
  // program, which is not to run again.
  enum class Followed : std::uint8_t { goes_on, left_sub, main_ends };
  Followed follow(const SubprogramJump& jump);
  End end() const { return end_; }
  // Calls a sub. next() then gives the blocks of this call, and null once at its end. False: the sub cannot be called.
  bool call_for_contour(Symbol sub, Span span);
  // Counts an operation of the program. `works`: the machine does something, so the loops do.
  void count_operation(bool works) {
    ++steps_;
    if (works) idle_passes_ = idle_calls_ = 0;
  }

  // The block at hand has begun a cycle, whose operations count from here if no loop or call is around the block.
  void begin_cycle() {
    if (is_outermost()) steps_ = 0;
  }
  // Called before each part of the cycle. False: the cycle came to too many operations, and the program ends.
  // `repeated` is the word that asks for them.
  bool may_go_on_with_cycle(Span repeated);

  // Called after M2. Reports the constructs around M2 whose end comes nowhere in the file.
  void report_never_closed();
  // Warns of moves that come after the end of the program.
  void report_moves_after_end();
  // Called after M2. True: the program began with '%', and the rest of the file has no closing '%'.
  bool lacks_closing_percent();

  void watch(BlockWatcher& watcher) { watcher_ = &watcher; }

  std::vector<CallPlace> calls() const override;

  std::uint64_t offset() const { return files_.front()->reader.position().offset; }

 private:
  struct SubPlace {
    ReaderPosition at;      // the line with its O-word
    ReaderPosition after;   // the line after it
    bool numbered = false;  // true: "O1234", which M98 calls; false: a sub
  };
  // A file of the program: the main file, or a file with subs.
  struct File {
    File(ProgramReader opened, std::size_t ordinal, SymbolTable& symbols)
        : reader(std::move(opened)),
          number(static_cast<std::uint32_t>(ordinal)),
          name(reader.name()),
          parser(name, symbols) {}
    ProgramReader reader;
    std::uint32_t number;
    std::string name;
    BlockParser parser;
    std::unordered_map<std::uint32_t, SubPlace> subs;  // keyed by label
    ReaderPosition seen;                               // all subs before this place are known
    std::uint64_t read_to = 0;                         // lines that begin before this offset were read already
    bool seen_all = false;
    bool seen_percent = false;           // the search for subs has passed the opening '%'
    std::set<std::uint32_t> unreadable;  // lines that are no G-code and were reported
    // Where the if of a label is, in each sub: by the sub's symbol (0: outside subs) and the label's.
    std::map<std::pair<std::uint32_t, std::uint32_t>, ReaderPosition> ifs;
  };
  // A construct that was entered and not yet left.
  struct Open {
    ControlKind kind = ControlKind::if_;
    Symbol label;
    ReaderPosition at;                // its line
    ReaderPosition after;             // the line after it
    std::uint64_t errors_before = 0;  // errors that were found before it was entered
    std::uint64_t passes_left = 0;    // only of a repeat
  };
  struct Frame {
    File* caller = nullptr;  // the file to which to return
    ReaderPosition return_to;
    Symbol sub;
    SubPlace place;
    std::size_t first_open = 0;
    std::uint64_t errors_before = 0;
    std::uint64_t passes_left = 1;                                     // L of M98, G65, G66
    bool modal_macro = false;                                          // called by G66
    std::optional<std::array<double, sub_parameters>> arguments = {};  // only of a macro
  };

  // A numbered program that was left and is to run again.
  struct Again {
    Frame frame;
    File* file = nullptr;
  };

  // Lines.
  enum class Read : std::uint8_t { block, skipped, end };
  Read read();
  bool next_line(std::string_view& text, std::uint32_t& line);
  bool parse(std::string_view text, std::uint32_t line);
  bool recall();
  void set_block(Block& block);
  static bool may_be_control(std::string_view text);
  static bool names_control(std::string_view text);
  bool is_readable(std::string_view text, std::uint32_t line);
  bool is_percent_end();
  bool closes_program(std::string_view text);
  const Block* finish(End end);

  // O-words.
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

  // The open constructs of the running sub.
  Open& push(ControlKind kind, Symbol label);
  Open* innermost(ControlKind kind, Symbol label);
  Open* require_innermost(ControlKind kind, Symbol label, const Control& control);
  bool any_open() const { return open_.size() > first_open(); }
  std::size_t first_open() const { return frames_.empty() ? 0 : frames_.back().first_open; }
  void go_round(const Open& loop, ReaderPosition to);
  bool may_go_round(const Open& loop);
  bool is_outermost() const { return frames_.empty() && open_.empty(); }

  // Skipping lines: skip_to() reads on to the next O-word of the wanted kinds that belongs to `from`.
  using Kinds = std::uint32_t;
  static constexpr Kinds kinds(std::initializer_list<ControlKind> list) {
    Kinds bits = 0;
    for (const ControlKind kind : list) bits |= Kinds{1} << static_cast<unsigned>(kind);
    return bits;
  }
  bool skip_to(const Open& from, Kinds wanted);
  bool read_control(Symbol& label, bool within_percents = false);
  bool skip_branch(const Open& from);
  static Kinds end_of(ControlKind construct);

  // Subs.
  bool may_call(Span span);
  void enter(const Frame& frame, File* file);
  void leave_frame();
  File* find_sub(Symbol label);
  bool find_in(File& file, Symbol label);
  void report_unknown_sub(Symbol label, Span span, bool numbered);
  void call_program(const SubprogramJump& jump);
  void enter_program(const Frame& frame, File* file);
  void run_again();
  Followed end_program(const SubprogramJump& jump);
  bool restart_main(const SubprogramJump& jump);
  bool check_numbered_programs(Span span, std::string_view what);
  bool check_style(const SubPlace& place, Symbol label, Span span, std::string_view caller);
  File* open_named(Symbol label);
  File* open_in(const std::string& folder, const std::string& name);
  std::string places_looked_at(const std::string& file) const;

  bool label_of(const Control& control, Symbol& label);
  bool label_of_skipped(const Control& control, Symbol& label) const;
  void check_used_once(Symbol label, const Control& control);
  bool is_closed_further_on(const Open& open);
  bool argument(const Control& control, double& value);
  void doubt_label();
  bool is_doubtful(Symbol label) const { return all_labels_doubtful_ || doubtful_labels_.contains(label.id); }
  void report_unclosed(const Open& open);
  void reread_block_text();
  bool stray(Symbol label, const Control& control, std::string message, std::string expected);
  std::string label_text(Symbol label) const;

  Options options_;
  ProgramState& state_;
  Parameters& parameters_;
  SymbolTable& symbols_;
  Reporter& reporter_;
  Diagnostics faults_;    // faults of the line that is read
  Symbol value_name_;     // #<_value>: the value that the last sub returned
  Symbol returned_name_;  // #<_value_returned>

  std::vector<std::unique_ptr<File>> files_;
  File* file_ = nullptr;     // the file that is read
  Block* block_ = &line_;    // the block that is read: line_ or a kept block
  ReaderPosition block_at_;  // the line of that block
  Block line_;
  KeptBlocks kept_;
  std::vector<Open> open_;
  std::vector<Frame> frames_;
  std::optional<std::uint32_t> left_sub_;
  std::optional<Again> again_;
  // The O-words of these labels cannot be read, or of any label if nothing more is known. What lacks them is not
  // reported.
  std::set<std::uint32_t> doubtful_labels_;
  bool all_labels_doubtful_ = false;
  std::uint64_t idle_passes_ = 0;  // passes since the machine last did something
  std::uint64_t idle_calls_ = 0;   // calls since then
  std::uint64_t steps_ = 0;        // passes, calls and operations since the outermost loop or call was entered
  std::uint64_t main_passes_ = 0;
  std::uint64_t unknown_calls_ = 0;
  std::size_t contour_depth_ = 0;  // call depth of the contour that is read; 0: none
  bool begun_ = false;             // something other than a comment or an empty line was read
  bool opened_percent_ = false;    // the program began with '%'
  End end_ = End::none;
  BlockWatcher* watcher_ = nullptr;
};

}  // namespace passo
