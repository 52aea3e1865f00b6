// ProgramLines: the lines of a program and of its subroutine files, as blocks. A line is read and parsed, or its block
// is in the cache from an earlier pass (KeptBlocks). The class tracks the current block and its position, and finds
// subroutines: in the rest of the file, then in the other open files, then in NAME.ngc beside the program and in the
// folders named by the options. Each file is searched once.
//
// A cached line costs about 25 ns before its execution. A parsed line costs 100 to 200 ns.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "kept_blocks.hpp"
#include "parameters.hpp"
#include "percent_signs.hpp"
#include "program_state.hpp"
#include "reporter.hpp"
#include "unreadable_labels.hpp"

#include "passo/gcode/block_parser.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

// Lines of the machine file, which are called as a numbered program. Programs of users have other numbers.
struct MachineProgram {
  std::int32_t number = 0;
  std::string name;  // for messages
  std::string lines;
};
inline constexpr std::int32_t change_macro_number = 999'999'006;
inline constexpr std::int32_t start_hook_number = 999'999'001;
inline constexpr std::int32_t end_hook_number = 999'999'002;

class ProgramLines {
 public:
  struct Options {
    bool block_delete = false;
    std::vector<std::string> sub_folders;  // searched after the program's own folder
    Dialect dialect = Dialect::linuxcnc;
    bool open_ended = false;        // the lines arrive one by one, with push_line()
    LetterSet more_grbl_axes = {};  // axes that the Grbl dialect accepts in addition to X, Y and Z
    std::vector<MachineProgram> machine_programs = {};
  };
  struct SubPlace {
    ReaderPosition at;      // the line with its O-word
    ReaderPosition after;   // the line after it
    bool numbered = false;  // true: "O1234", called by M98; false: a subroutine
  };
  // A file of the program: the main file, or a file with subroutines.
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
    std::unordered_map<std::uint32_t, SubPlace> subs;  // by label
    ReaderPosition seen;                               // all subroutines before this position are known
    std::uint64_t read_to = 0;                         // lines that begin before this offset have been read
    bool seen_all = false;
    bool seen_percent = false;           // the search for subroutines has passed the opening '%'
    std::set<std::uint32_t> unreadable;  // lines that are not G-code and were reported
    // The position of the `if` of each label in each subroutine. The key is the symbol of the subroutine (0: none) and
    // that of the label.
    std::map<std::pair<std::uint32_t, std::uint32_t>, ReaderPosition> ifs;
  };

  ProgramLines(ProgramReader reader, Options options, const ProgramState& state, const Parameters& parameters,
               SymbolTable& symbols, Reporter& reporter);

  // Reads the next line. block: it became the current block.
  enum class Read : std::uint8_t { block, skipped, end };
  Read read();
  // For open-ended programs only.
  void push_line(std::string_view text) { files_.front()->reader.push_line(text); }
  bool open_ended() const { return options_.open_ended; }

  Block& block() { return *block_; }
  const Block& block() const { return *block_; }
  // The line of the current block, and the one after it.
  ReaderPosition at() const { return block_at_; }
  ReaderPosition after() const { return file_->reader.position(); }
  void seek(ReaderPosition place) { file_->reader.seek(place); }
  File& file() { return *file_; }
  const File& file() const { return *file_; }
  // Continues in another file. The current block stays.
  void seek(File& file, ReaderPosition place);
  // Returns the read position in the main file.
  ReaderPosition in_main_file() const { return files_.front()->reader.position(); }

  // Skips lines up to the next one with an O-word, the only lines that are parsed. Returns false if there is none.
  bool read_control(Symbol& label, bool within_percents = false);
  // Returns whether the first word of the line may be an O-word.
  static bool may_be_control(std::string_view text);
  // Must be called after another position of the file was read: the text of a block that is not cached belongs to the
  // reader, and is lost.
  void reread_block_text();

  // Returns a file with the subroutine, which is then in the file's `subs`. Null if there is none.
  File* find_sub(Symbol label);
  std::string places_looked_at(const std::string& file) const;

  UnreadableLabels& unreadable_labels() { return unreadable_labels_; }
  PercentSigns& percent_signs() { return percent_signs_; }
  // Returns whether the rest of the main file, starting at `from`, lacks the '%' that closes the program.
  bool lacks_closing_percent(ReaderPosition from);
  // Returns whether M2 or M30 is in any line of the main file. Only before the first line is read.
  bool has_end();
  // Warns about moves after the current line.
  void report_moves_after_end();

 private:
  bool next_line(std::string_view& text, std::uint32_t& line);
  bool parse(std::string_view text, std::uint32_t line);
  bool recall();
  void set_block(Block& block);
  static bool names_control(std::string_view text);
  bool is_readable(std::string_view text, std::uint32_t line);
  bool closes_program(std::string_view text);
  void doubt_label();
  bool label_of_skipped(const Control& control, Symbol& label) const;
  bool find_in(File& file, Symbol label);
  File* open_named(Symbol label);
  File* find_machine_program(Symbol label);
  File* open_in(const std::string& folder, const std::string& name);

  Options options_;
  const ProgramState& state_;
  const Parameters& parameters_;
  SymbolTable& symbols_;
  Reporter& reporter_;
  Diagnostics faults_;  // errors of the line being read
  std::vector<std::unique_ptr<File>> files_;
  File* file_ = nullptr;     // the file being read
  Block* block_ = &line_;    // the current block: line_ or a cached block
  ReaderPosition block_at_;  // the line of that block
  Block line_;
  KeptBlocks kept_;
  UnreadableLabels unreadable_labels_;
  PercentSigns percent_signs_;
};

// Returns the label as written after the O: 100, <name>.
std::string label_text(const SymbolTable& symbols, Symbol label);
// Converts a computed label to a symbol. Empty if the value is not a valid label.
std::optional<Symbol> label_of_value(double value, SymbolTable& symbols);

}  // namespace passo
