// ProgramLines: the lines of a program and of the files with its subs, as blocks. A line is read and parsed, or its
// block was kept from an earlier pass (KeptBlocks). The lines know which block is at hand and where it stands, and they
// find subs: in the rest of the file, then in the other files that are open, then in NAME.ngc beside the program and in
// the folders that the options name. Each file is searched once.
//
// A line that is kept costs about 25 ns before it is executed. A line that is parsed costs 100 to 200 ns.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "doubtful_labels.hpp"
#include "kept_blocks.hpp"
#include "parameters.hpp"
#include "percent_signs.hpp"
#include "program_state.hpp"
#include "reporter.hpp"

#include "passo/gcode/block_parser.hpp"
#include "passo/gcode/program_reader.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

class ProgramLines {
 public:
  struct Options {
    bool block_delete = false;
    std::vector<std::string> sub_folders;  // after the program's own
    Dialect dialect = Dialect::linuxcnc;
    bool open_ended = false;        // the lines come one by one, with push_line()
    LetterSet more_grbl_axes = {};  // that the dialect of grbl takes beside X, Y and Z
  };
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

  ProgramLines(ProgramReader reader, Options options, const ProgramState& state, const Parameters& parameters,
               SymbolTable& symbols, Reporter& reporter);

  // Reads the next line. block: it is the block at hand.
  enum class Read : std::uint8_t { block, skipped, end };
  Read read();
  // Only of open-ended lines.
  void push_line(std::string_view text) { files_.front()->reader.push_line(text); }
  bool open_ended() const { return options_.open_ended; }

  Block& block() { return *block_; }
  const Block& block() const { return *block_; }
  // The line of that block, and the one after it.
  ReaderPosition at() const { return block_at_; }
  ReaderPosition after() const { return file_->reader.position(); }
  void seek(ReaderPosition place) { file_->reader.seek(place); }
  File& file() { return *file_; }
  const File& file() const { return *file_; }
  // Goes on in another file. The block at hand stays.
  void seek(File& file, ReaderPosition place);
  // Where the main file is read.
  ReaderPosition in_main_file() const { return files_.front()->reader.position(); }

  // Skips lines up to the next one with an O-word, of which alone each line is parsed. False: there is none.
  bool read_control(Symbol& label, bool within_percents = false);
  // Whether an O-word may come first in the line.
  static bool may_be_control(std::string_view text);
  // For use after another place of the file was read. The text of a block that is not kept belongs to the reader, and
  // is lost.
  void reread_block_text();

  // A file that has the sub, which is then in the file's `subs`. Null: there is none.
  File* find_sub(Symbol label);
  std::string places_looked_at(const std::string& file) const;

  DoubtfulLabels& doubtful_labels() { return doubtful_labels_; }
  PercentSigns& percent_signs() { return percent_signs_; }
  // Whether the rest of the main file, from `from` on, lacks the '%' that closes the program.
  bool lacks_closing_percent(ReaderPosition from);
  // Warns of moves that come after the line at hand.
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
  File* open_in(const std::string& folder, const std::string& name);

  Options options_;
  const ProgramState& state_;
  const Parameters& parameters_;
  SymbolTable& symbols_;
  Reporter& reporter_;
  Diagnostics faults_;  // faults of the line that is read
  std::vector<std::unique_ptr<File>> files_;
  File* file_ = nullptr;     // the file that is read
  Block* block_ = &line_;    // the block that is read: line_ or a kept block
  ReaderPosition block_at_;  // the line of that block
  Block line_;
  KeptBlocks kept_;
  DoubtfulLabels doubtful_labels_;
  PercentSigns percent_signs_;
};

// The label as it is written after the O: 100, <name>.
std::string label_text(const SymbolTable& symbols, Symbol label);
// The whole number that a computed label is. Empty: the value is no label.
std::optional<Symbol> label_of_value(double value, SymbolTable& symbols);

}  // namespace passo
