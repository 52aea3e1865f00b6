// BlockExecutor: one block of words -> operations, in RS274/NGC's order of execution.
//
// A block is checked first as a whole (one code of each modal group, every word used, one taker of the axis words) and
// executed then, group by group in a fixed order (block_executor.cpp). What sets and switches is in settings.cpp,
// motion in motion.cpp, what moves the frame in offsets.cpp, cutter compensation in cutter_codes.cpp. A block with an
// error does nothing from the error on, but the position goes where it was meant to go, so that one slip does not make
// errors of all that follows.
//
// Costs no allocation a block. The most operations of one block (an M2 with everything before it) fit the queue.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arc_center.hpp"
#include "block_words.hpp"
#include "cutter_compensation.hpp"
#include "drilling_cycle.hpp"
#include "lathe_cycle.hpp"
#include "machine_state.hpp"
#include "modal_snapshot.hpp"
#include "operation_queue.hpp"
#include "parameters.hpp"
#include "reporter.hpp"
#include "subprogram_jump.hpp"
#include "threading_cycle.hpp"

#include "passo/interpreter/interpreter.hpp"

namespace passo {

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
  // What the block just executed asks of the flow.
  std::optional<SubprogramJump> take_jump() { return std::exchange(jump_, std::nullopt); }
  // A sub was left, by the O-word or M99 there; the flow is back in its caller.
  void leave_sub(const OperationSource& source);
  // M99 in the main program, which does not run once more.
  void end_program(bool pallet);
  // A cycle of the last block has more operations to give.
  bool busy() const { return cycle_ != Cycle::none; }
  void go_on();

  // The program waits for what the machine finds in the probe move that was given last.
  bool awaits_probe() const { return probing_.has_value(); }
  void take_probe_outcome();

  // A lathe cycle wants the blocks of this sub, one after the other, in place of execute().
  bool wants_contour() const { return cycle_ == Cycle::contour; }
  Symbol contour_sub() const { return lathe_->sub; }
  Span contour_span() const { return lathe_->span; }
  void add_to_contour(const Block& block);
  void end_contour();
  void abandon_cycle();
  // The line of the cycle whose contour was read last.
  std::string_view contour_text() const { return lathe_->text; }

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
  bool check_words_shared();
  bool assign(const Block& block);
  bool execute_words();
  bool run(std::span<const Step> steps);

  // Words and groups, in the order in which they are executed.
  bool obey_comments(const Block& block);
  bool obey(const BlockComment& comment);
  bool set_spindle_mode(CodeNumber code);
  bool set_feed_mode(CodeNumber code);
  bool set_feed_rate();
  bool set_spindle_speed();
  bool select_tool();
  bool change_tool(CodeNumber code);
  bool run_spindle_group(CodeNumber code);
  bool use_input_output(CodeNumber code);
  bool run_user_code(CodeNumber code);
  bool switch_coolant(CodeNumber code);
  bool switch_overrides(CodeNumber code);
  bool dwell(CodeNumber code);
  bool select_plane(CodeNumber code);
  bool set_length_units(CodeNumber code);
  bool set_lathe_diameter(CodeNumber code);
  bool set_cutter_compensation(CodeNumber code);
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
  bool move_by(CodeNumber code);
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

  // Cutter compensation.
  bool check_cutter_compensation();
  bool start_cutter_compensation(CodeNumber code);
  bool cutter_from_words(CodeNumber code, CutterSetup& setup);
  bool cutter_from_table(CutterSetup& setup);
  bool straight(bool rapid, const Point& start);
  bool arc_beside(const Point& start, PlanePoint center, std::int32_t turns);
  bool report_cutter(CutterFault fault, Span span);
  Operation origin() const { return {operation::Comment{}, source_, reporter_.file(), reporter_.block().text}; }
  // Tools.
  bool find_tool(std::int32_t number, Span span, const Tool*& tool);
  void load_tool(std::int32_t number);
  bool tool_offset(Point& offset);
  bool reload_tools();
  bool set_tool_table_entry();
  bool check_tool_entry_words(Tool*& tool);
  void set_tool_offsets(Tool& tool);
  // Cycles: checked as a whole when they start, then a hole, a peck or a pass a step.
  enum class Cycle : std::uint8_t { none, drilling, threading, contour, lathe };
  static constexpr std::size_t longest_cycle_step = 18;
  bool step_cycle();
  bool check_cycle(std::string_view name);
  bool check_uncompensated(std::string_view name);
  bool start_drilling(CodeNumber code);
  bool check_drilling(CodeNumber code);
  bool check_drilling_words(CodeNumber code, bool first);
  bool check_drilling_spindle(CodeNumber code);
  void prepare_drilling(CodeNumber code);
  bool step_drilling();
  bool go_to_hole();
  bool peck();
  void finish_hole();
  void tap();
  void bore_back();
  void move_along(Axis axis, double height, bool rapid);
  bool start_threading();
  bool check_threading();
  bool check_threading_words();
  bool step_threading();
  void cut_thread(double depth);
  bool start_lathe(CodeNumber code);
  bool check_lathe(CodeNumber code);
  LathePoint lathe_point(const Point& point) const;
  bool add_segment(const Block& block);
  bool contour_point(LathePoint& end);
  bool contour_arc(LatheSegment& segment);
  bool add_corner(const LatheSegment& behind);
  void lead_out();
  LatheFault plan_roughing();
  LatheFault plan_finishing();
  bool step_lathe();
  bool emit_lathe_move(const LatheMove& move);
  bool report_contour(LatheFault fault);
  bool fail_contour(std::string message, std::string expected);

  // The frame.
  void start_frame();
  bool go_home(int parameter);
  bool store_home(int parameter);
  bool set_table();
  bool set_work_offset();
  bool check_work_offset_words(int& system);
  bool set_g92(CodeNumber code);
  bool set_scaling();
  Point active_g92() const;
  void use_tool_offset(const Point& offset);
  void activate_system(int system, bool with_g92);
  template <class... Operations>
  void change_frame(const Operations&... operations);
  void restore_tool_offset(const ModalSnapshot& saved);

  // Spindles: those of `$`, from first to before end.
  struct SpindleRange {
    std::uint8_t first = 0;
    std::uint8_t end = 1;
  };
  enum class SpindleChoice : std::uint8_t { one, one_or_all };
  bool spindle_word(SpindleChoice choice, SpindleRange& range);
  bool turn_spindle(CodeNumber code);
  bool orient_spindle();
  void stop_spindles();

  // The modal state, saved and restored.
  bool keep_modal_state(CodeNumber code);
  void restore(const ModalSnapshot& saved);
  void restore_spindles(const ModalSnapshot& saved);
  void restore_switches(const ModalSnapshot& saved);

  // Inputs and outputs, probing, subprograms.
  bool set_digital_output(CodeNumber code);
  bool set_analog_output(bool with_motion);
  bool read_input();
  bool probe(CodeNumber code);
  bool check_probe(CodeNumber code);
  void keep_probe_result(const Point& place, bool touched);
  Point preview_backoff(const Point& start, const Point& end) const;
  bool jump(CodeNumber code);
  bool program_words(SubprogramJump& found);

  // Macro calls.
  void call_macro(bool readable);
  bool check_macro_words(const SubprogramJump& call);
  bool end_macro_calls(CodeNumber code);
  bool moves() const;
  void call_modal_macro();

  // Small things.
  bool whole_word(char letter, double lowest, double highest, std::int32_t& value);
  bool fail(std::string_view code, Span span, std::string message, std::string expected = {});
  void emit(const OperationKind& what) {
    operations_.push(operations_.holding() ? Operation{what, source_, reporter_.file(), reporter_.block().text}
                                           : Operation{what, source_});
  }
  // Not behind the moves that cutter compensation holds back: what goes to the operator, or moves nothing.
  void emit_ahead(const OperationKind& what) { operations_.push_ahead({what, source_}); }
  void emit_feed_rate(double units);
  void emit_path_mode();
  // LinuxCNC tells changes of its own modes as comments, and its canonical calls are what others compare with.
  void note(std::string_view text) { emit(operation::Comment{text}); }

  MachineState& state_;
  Parameters& parameters_;
  OperationQueue& operations_;
  Reporter& reporter_;
  SymbolTable& symbols_;

  CutterCompensation cutter_;

  // Of the block that is being executed.
  BlockWords words_;
  const CodeEntry* motion_ = nullptr;  // what it does with the axis words, if a motion does
  OperationSource source_;
  std::string text_;  // of its comment, with parameters filled in
  std::vector<double> assigned_;

  std::optional<CodeNumber> probing_;
  std::optional<SubprogramJump> jump_;
  std::optional<SubprogramJump> modal_macro_;  // of G66

  std::vector<ModalSnapshot> snapshots_;  // by call depth
  InterpreterOptions options_;
  Cycle cycle_ = Cycle::none;
  DrillingWords drilling_words_;
  DrillingCycle drilling_;
  ThreadingCycle thread_;
  std::unique_ptr<LatheCycle> lathe_;  // made when there is one
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
  bool tool_was_loaded_ = false;
  bool has_settings_ = false;
  bool ended_ = false;
};

}  // namespace passo
