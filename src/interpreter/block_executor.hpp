// BlockExecutor: one block of words -> operations, in RS274/NGC's order of execution.
//
// A block is checked first as a whole (one code of each modal group, every word used, one taker of the axis words) and
// executed then, group by group in a fixed order (block_executor.cpp). What sets and switches is in settings.cpp,
// motion in motion.cpp, what moves the frame in offsets.cpp. A block with an error does nothing from the error on, but
// the position goes where it was meant to go, so that one slip does not make errors of all that follows.
//
// Costs no allocation a block. The most operations of one block (an M2 with everything before it) fit the queue.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "arc_center.hpp"
#include "block_words.hpp"
#include "machine_state.hpp"
#include "parameters.hpp"
#include "reporter.hpp"

#include "passo/base/ring.hpp"
#include "passo/interpreter/interpreter.hpp"

namespace passo {

using OperationQueue = Ring<Operation, 64>;
inline constexpr double highest_tool = 99999;

class BlockExecutor {
 public:
  BlockExecutor(MachineState& state, Parameters& parameters, OperationQueue& operations, Reporter& reporter,
                SymbolTable& symbols);

  void start(const InterpreterOptions& options);
  void execute(const Block& block);
  // The program has no more blocks: it ended at its closing '%', or with M2 and that is missing, or neither.
  enum class Closing : std::uint8_t { none, percent, missing };
  void finish(Closing closing);
  // After M2, M30 or (ABORT,…).
  bool ended() const { return ended_; }

 private:
  // What a group does with its code. False when that failed: the rest of the block is not executed.
  using GroupFunction = bool (BlockExecutor::*)(CodeNumber);
  struct Step {
    ModalGroup group;
    GroupFunction run;
  };
  static const Step steps_before_words[];
  static const Step steps_after_words[];

  // The block as a whole.
  bool resolve_motion();
  bool check_words_used();
  bool assign(const Block& block);
  bool execute_words();
  bool run(std::span<const Step> steps);

  // Words and groups, in the order in which they are executed.
  bool obey_comments(const Block& block);
  bool obey(const Comment& comment);
  bool set_spindle_mode(CodeNumber code);
  bool set_feed_mode(CodeNumber code);
  bool set_feed_rate();
  bool set_spindle_speed();
  bool select_tool();
  bool change_tool(CodeNumber code);
  bool turn_spindle(CodeNumber code);
  bool switch_coolant(CodeNumber code);
  bool switch_overrides(CodeNumber code);
  bool dwell(CodeNumber code);
  bool select_plane(CodeNumber code);
  bool set_length_units(CodeNumber code);
  bool set_lathe_diameter(CodeNumber code);
  bool end_cutter_compensation(CodeNumber code);
  bool set_tool_length(CodeNumber code);
  bool select_work_system(CodeNumber code);
  bool set_path_mode(CodeNumber code);
  bool set_distance_mode(CodeNumber code);
  bool set_arc_distance_mode(CodeNumber code);
  bool set_retract_mode(CodeNumber code);
  bool run_non_modal(CodeNumber code);
  bool move(CodeNumber code);
  bool stop(CodeNumber code);

  // Motion.
  bool end_point(Point& end);
  bool machine_end_point(Point& end);
  bool apply_polar(Point& end);
  double scaled_place(Axis axis, double value) const;
  double scaled_way(Axis axis, double value) const;
  bool check_scaling(CodeNumber code);
  bool traverse();
  bool feed();
  bool arc(bool clockwise);
  bool find_arc_center(bool clockwise, const Point& end, ArcCenter& found);
  bool center_words(PlanePoint start, PlanePoint& center);
  bool arc_turns(std::int32_t& turns);
  bool report_arc(const ArcCenter& arc);

  // Splines.
  bool check_spline();
  bool check_spline_axes();
  bool fail_pair(std::string_view name, char first, char second, std::string expected);
  bool cubic_spline();
  bool quadratic_spline();
  bool nurbs_point();
  bool check_nurbs();
  bool check_nurbs_feed();
  bool add_nurbs_point(bool first);
  bool end_nurbs();
  void close_nurbs();
  void check_nurbs_is_closed();

  bool threading(bool tapping);
  bool check_feed();
  void emit_inverse_time_feed(double length, bool rotary);
  double axis_word(Axis axis) const;
  Span motion_span() const;

  // The frame.
  bool go_home(int parameter);
  bool store_home(int parameter);
  bool set_work_offset();
  bool check_work_offset_words(int& system);
  bool set_g92(CodeNumber code);
  bool set_scaling();
  Point active_g92() const;
  void activate_system(int system, bool with_g92);
  template <class... Operations>
  void change_frame(const Operations&... operations);
  void end_program(bool pallet);

  // Small things.
  bool whole_word(char letter, double lowest, double highest, std::int32_t& value);
  bool fail(std::string_view code, Span span, std::string message, std::string expected = {});
  void emit(const OperationKind& what) { operations_.push({what, source_}); }
  void emit_feed_rate(double units);
  // LinuxCNC tells changes of its own modes as comments, and its canonical calls are what others compare with.
  void note(std::string_view text) { emit(operation::Comment{text}); }

  MachineState& state_;
  Parameters& parameters_;
  OperationQueue& operations_;
  Reporter& reporter_;
  SymbolTable& symbols_;

  // Of the block that is being executed.
  BlockWords words_;
  const CodeEntry* motion_ = nullptr;  // what it does with the axis words, if a motion does
  OperationSource source_;
  std::string text_;  // of its comment, with parameters filled in
  std::vector<double> assigned_;

  // The control points of a G5 or G5.1, which its operation borrows; and where the last G5 leads on from its end, as
  // long as G5 follows G5.
  std::array<operation::ControlPoint, 4> spline_{};
  std::optional<PlanePoint> spline_exit_;
  // From G5.2 to G5.3. Memory grows with the points of the longest NURBS, up to a bound, and is kept.
  struct OpenNurbs {
    static constexpr std::size_t most_points = 4096;
    std::vector<operation::ControlPoint> points = {};
    std::int32_t order = 0;
    std::uint32_t line = 0;  // where it begins
    bool wrong = false;      // a point was refused, and that was told
    bool open = false;
  };
  OpenNurbs nurbs_;

  bool missing_feed_told_ = false;
  bool missing_tool_table_told_ = false;
  bool ended_ = false;
};

}  // namespace passo
