// Leveller: processes the operations of a program and writes them with the height map applied. Private to probing/.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "known_work_position.hpp"
#include "levelled_writer.hpp"
#include "off_codes.hpp"

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

  // Returns false at the end of the program.
  bool handle(const Operation& operation);
  void finish();
  const LevelCount& count() const { return writer_.count(); }

 private:
  // A drilling cycle that is kept as a cycle, see keeps_cycle().
  struct KeptCycle {
    std::uint64_t block = 0;                     // block that contains the words
    std::vector<std::pair<char, double>> words;  // Z, R, P and Q, which stay the same from line to line; mm
    bool is_kept = false;
    bool is_open = false;  // the line is not yet written
    FrameBlock line;       // the block being written
    LevelHeight began_at = LevelHeight::of_machine;
  };
  // The frame commands written so far.
  struct WrittenFrame {
    int system = 0;  // 0: none
    std::uint64_t g92_block = 0;
    bool has_tool_offset = false;  // the program has set a tool length offset
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

  // Processes frame changes and moves in machine coordinates.
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
  const double machine_unit_;  // mm, unit of the parameters
  const bool has_tools_;
  Frame frame_;
  bool is_reset_ = false;
  WrittenFrame written_;
  std::uint64_t homing_ = 0;  // the block whose homing move has begun
  Point place_;               // position of the original program, work coordinates
  KnownWorkPosition said_;
  operation::FeedPerSecond feed_;
  operation::SetPathMode path_mode_;
  KeptCycle cycle_;
  OffCodes off_codes_;
  bool told_height_ = false;
  bool told_place_ = false;
};

}  // namespace passo
