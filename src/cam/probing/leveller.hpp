// Leveller: follows the operations of a program, and writes it as it is on a surface. Private to probing/.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plain_code.hpp"

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/frame_blocks.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/levelling/height_map.hpp"
#include "passo/levelling/levelled_move.hpp"
#include "passo/probing/levelled_program.hpp"

namespace passo {

// A move as the program means it, in work coordinates.
struct LevelledMove {
  Point from;
  Point to;
  AxisSet named = {};         // axes that the program names
  AxisSet absolute = {};      // of these, those that it names by a place
  bool is_new_place = false;  // the work coordinates of one of them were not known before
  bool rapid = false;
  bool levelled = true;
  bool from_anywhere = false;  // nobody knows where it begins in X or Y
  bool from_above = false;     // nobody knows where it begins in Z
  bool is_arc = false;         // about a centre in X and Y
  double center_x = 0;
  double center_y = 0;
  double sweep = 0;
  double feed = 0;  // mm/min

  bool is_upright() const;
};

// After a change of the frame places differ by what their conversion has rounded.
bool is_same_place(double a, double b);
bool is_same_place(const Point& a, const Point& b);

// Where Z is. Of the machine: at the start, and after G53, G28 and G30. The program has said nothing of the work's Z,
// and moves stay as they are until it does. Of the work: moves are levelled. Where the number of Z is not known (the
// zero has changed, or only ways were given), the height is added as a way.
enum class LevelHeight : std::uint8_t { of_machine, of_work, known };

class Leveller {
 public:
  Leveller(Interpreter& interpreter, const InterpreterOptions& options, const std::string& file, const HeightMap& map,
           const LevelOptions& wish, Diagnostics& diagnostics, const std::function<void(std::string_view)>& write);

  // False: the program ends here.
  bool handle(const Operation& operation);
  void finish();
  const LevelCount& count() const { return count_; }

 private:
  // What comes between moves: a line as it is. Or a move.
  struct Item {
    std::string line;
    LevelledMove move;
    bool is_move = false;
  };
  // A cycle that stays a cycle, see keeps_cycle().
  struct KeptCycle {
    std::uint64_t block = 0;                     // of the words
    std::vector<std::pair<char, double>> words;  // Z, R, P and Q, which stay from line to line; mm
    bool is_kept = false;
    bool is_open = false;  // the line is not written yet
    LevelHeight began_at = LevelHeight::of_machine;
  };

  void handle_move(const Operation& operation);
  void handle_straight(const Operation& operation, const Point& end, bool rapid);
  void handle_arc(const Operation& operation, const operation::ArcFeed& arc);
  void handle_upright_arc(const Operation& operation, const operation::ArcFeed& arc);
  void handle_machine_move(const Point& end, bool rapid);
  bool handle_home(const Point& end);
  LevelledMove move_to(const Operation& operation, const Point& end, bool rapid);
  double feed_of(const Point& end) const;
  void check_lead(const Operation& operation, const Point& end);

  // Frames, and places of the machine.
  void read_block(const FrameBlock& block);
  void read_system(const FrameBlock& block);
  void read_tool_entry(const FrameBlock& block);
  void store_home(const FrameBlock& block);
  bool follow_frame(const Operation& operation);
  bool is_off_already(std::string_view line);
  void write_frame(const Operation& operation, const Frame& before);
  void write_tool_offset();
  void stand_in_machine(const Point& end, AxisSet axes);
  void lose(AxisSet axes);

  bool keeps_cycle(const Operation& operation);
  void read_cycle_words(const FrameBlock& block);
  void end_cycle();

  void report(const Operation& operation, Severity severity, std::string code, std::string message,
              std::string expected);
  void refuse(const Operation& operation, std::string code, std::string message, std::string expected) {
    report(operation, Severity::error, std::move(code), std::move(message), std::move(expected));
  }
  void refuse(const FrameBlock& block, std::string code, std::string message, std::string expected);

  void add(Item item);
  void add_line(std::string line) { add({.line = std::move(line), .move = {}}); }
  // `rises`: a machine's retract ends the run.
  void emit_run(bool rises = false);
  void emit(const Item& item);
  void emit_move(const LevelledMove& move);
  void begin_at_height(const LevelledMove& move);
  void emit_arc_piece(const LevelledMove& move, double from_part, const LevelledPiece& piece);

  FrameBlocks blocks_;
  const HeightMap& map_;
  const LevelOptions& wish_;
  Diagnostics& diagnostics_;
  const std::string& file_;
  PlainCode code_;
  const double highest_;
  const double machine_unit_;  // mm, of the parameters
  const bool has_tools_;
  Frame frame_;
  bool is_reset_ = false;
  std::uint64_t homing_ = 0;      // the block whose way home has begun
  std::uint64_t g92_block_ = 0;   // that has been written
  int system_ = 0;                // that was written; 0: none
  bool has_tool_offset_ = false;  // the program has set one
  Point place_;                   // where the program is, work coordinates
  AxisSet known_;                 // axes whose place in the work the program has said
  LevelHeight at_ = LevelHeight::of_machine;
  double height_;  // Z where the levelled program is
  double feed_ = 0;
  double rotary_feed_ = 0;
  operation::SetPathMode path_mode_;
  KeptCycle cycle_;
  FrameBlock cycle_block_;  // of the line that is open
  // Moves straight up and down, and what is between them, until it is known whether they are a hole.
  std::vector<Item> run_;
  bool any_levelled_ = false;
  bool spindle_is_off_ = false;  // false at the start: nobody knows
  bool coolant_is_off_ = false;
  bool told_height_ = false;
  bool told_place_ = false;
  LevelCount count_;
};

}  // namespace passo
