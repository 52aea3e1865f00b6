// Leveller: follows the operations of a program, and writes it as it is on a surface. Private to probing/.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "levelled_writer.hpp"
#include "off_codes.hpp"
#include "said_place.hpp"

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/frame_blocks.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/levelling/height_map.hpp"
#include "passo/probing/levelled_program.hpp"

namespace passo {

class Leveller {
 public:
  Leveller(Interpreter& interpreter, const InterpreterOptions& options, const std::string& file, const HeightMap& map,
           const LevelOptions& wish, Diagnostics& diagnostics, const std::function<void(std::string_view)>& write);

  // False: the program ends here.
  bool handle(const Operation& operation);
  void finish();
  const LevelCount& count() const { return writer_.count(); }

 private:
  // A cycle that stays a cycle, see keeps_cycle().
  struct KeptCycle {
    std::uint64_t block = 0;                     // of the words
    std::vector<std::pair<char, double>> words;  // Z, R, P and Q, which stay from line to line; mm
    bool is_kept = false;
    bool is_open = false;  // the line is not written yet
    FrameBlock line;       // that is open
    LevelHeight began_at = LevelHeight::of_machine;
  };
  // What was written of the frame.
  struct WrittenFrame {
    int system = 0;  // 0: none
    std::uint64_t g92_block = 0;
    bool has_tool_offset = false;  // the program has set one
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

  FrameBlocks blocks_;
  const HeightMap& map_;
  const LevelOptions& wish_;
  Diagnostics& diagnostics_;
  const std::string& file_;
  LevelledWriter writer_;
  const double machine_unit_;  // mm, of the parameters
  const bool has_tools_;
  Frame frame_;
  bool is_reset_ = false;
  WrittenFrame written_;
  std::uint64_t homing_ = 0;  // the block whose way home has begun
  Point place_;               // where the program is, work coordinates
  SaidPlace said_;
  operation::FeedPerSecond feed_;
  operation::SetPathMode path_mode_;
  KeptCycle cycle_;
  OffCodes off_codes_;
  bool told_height_ = false;
  bool told_place_ = false;
};

}  // namespace passo
