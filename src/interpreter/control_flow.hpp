// ControlFlow: O-words. Subroutines, loops and branches, by going to and fro in the program's text.
//
// Nothing is indexed beforehand: a subroutine's place is kept when it is met, or looked for further on when it is
// called; a loop keeps where it began. So a program of any length takes constant memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "parameters.hpp"

#include "passo/gcode/block_parser.hpp"
#include "passo/gcode/program_reader.hpp"

namespace passo {

// Calls within calls, and loops within loops (of all calls together).
inline constexpr std::size_t deepest_call = 100;
inline constexpr std::size_t deepest_nesting = 1000;

class ControlFlow {
 public:
  ControlFlow(ProgramReader main, SymbolTable& symbols, Parameters& parameters, Diagnostics& diagnostics,
              std::uint64_t idle_passes);

  // The next block to execute: O-words are followed here and never come out. False at the end of the program or when
  // it cannot go on. A block that could not be parsed is reported and skipped.
  [[nodiscard]] bool next(Block& block, bool block_delete);
  // Something was done: a loop that goes on is not idle.
  void note_operation() { passes_ = 0; }

  const std::string& file() const { return files_[current_]->reader.name(); }
  std::uint64_t main_offset() const { return files_.front()->reader.position().offset; }
  bool in_call() const { return !calls_.empty(); }

 private:
  struct File {
    ProgramReader reader;
    BlockParser parser;
  };
  struct Place {
    std::size_t file = 0;
    ReaderPosition position;
  };
  struct Opening {  // an O-word that something must close
    ControlKind kind = ControlKind::while_;
    Symbol label;
    Place at;     // of its line
    Place after;  // of the line after it
    Span span;
    std::uint64_t left = 0;  // passes of a repeat
  };
  struct Call {
    Symbol label;
    Place back;
    std::size_t openings = 0;  // that were there before
  };

  bool read(Block& block);
  bool follow(Block& block);
  bool label_of(const Block& block, Symbol& label);
  bool condition(const Block& block, bool& holds);
  bool argument(const Block& block, std::size_t i, double& value);

  bool on_sub(Block& block, Symbol label);
  bool on_call(const Block& block, Symbol label);
  bool on_return(const Block& block, Symbol label);
  bool on_while(Block& block, Symbol label);
  bool on_repeat(Block& block, Symbol label);
  bool on_if(Block& block, Symbol label);
  bool on_end(const Block& block, Symbol label);
  bool on_break(Block& block, Symbol label);

  bool open(const Block& block, Symbol label, std::uint64_t left = 0);
  bool skip_to(Block& block, Symbol label, std::initializer_list<ControlKind> kinds, const Opening& from);
  Opening opening_at(const Block& block, Symbol label) const;
  bool find_sub(Symbol label, Place& place);
  bool find_sub_in(std::size_t file, Symbol label, ReaderPosition from, Place& place);
  bool open_file(Symbol label, std::size_t& file);
  void go_to(const Place& place);
  bool jump_back(const Block& block, const Place& place);
  bool report_unclosed();
  bool error(const Block& block, const char* code, Span span, std::string message, std::string expected) const;
  std::string name(Symbol label) const { return "o<" + std::string(symbols_.name(label)) + ">"; }

  SymbolTable& symbols_;
  Parameters& parameters_;
  Diagnostics& diagnostics_;
  std::uint64_t most_passes_;
  std::uint64_t passes_ = 0;

  std::vector<std::unique_ptr<File>> files_;
  std::size_t current_ = 0;
  Place line_;  // of the block at hand
  std::unordered_map<std::uint32_t, Place> subs_;
  std::vector<Opening> openings_;
  std::vector<Call> calls_;
};

}  // namespace passo
