// ToolChangeCycle: the operations of one M6 on a machine that measures its tools (ToolChangePlan): Z up, the way to the
// place of the change, the question to the operator, touches of the tool setter, and the way back over the work.
//
// The cycle is pure: it knows the plan, where the tool is, and the outcome of its probe moves. After a probe move it
// pauses until the outcome is known (awaits() and apply()). If a tool was not measured, the spindle stands, the tool is
// at the safe height, and the operator is asked again, with the reason. Each move is an operation of the program, so a
// check knows it, and an interrupted program continues in the middle of it.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "cycle.hpp"
#include "program_state.hpp"

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/interpreter/tool_change_plan.hpp"

namespace passo {

class ToolChangeCycle final : public Cycle {
 public:
  struct Start {
    Point machine;  // tool position
    Frame frame;
    MeasuredTools known;
    std::optional<Point> after_macro = {};  // set: the macro has changed the tool; the position before it
    std::string macro_fault = {};           // of the macro, which ends the change with the tool up
    std::int32_t from = 0;                  // the tool in the spindle; 0: none
    std::int32_t to = 0;                    // 0: the spindle stays empty
    bool only_checks = false;               // at the end of the program: the tool is measured and stays
    bool spindle_turns = false;
    bool mist = false;
    bool flood = false;
    std::string remark = {};  // of the new tool, for the operator
  };
  ToolChangeCycle(const ToolChangePlan& plan, const Start& start, const OperationSource& source);

  // Whether the next step depends on the outcome of a probe move.
  bool awaits() const override { return awaits_; }
  void apply(const ProbeOutcome* outcome) override;

  const MeasuredTools& known() const { return known_; }
  // Whether the new tool was measured by a machine.
  bool is_measured() const { return is_measured_; }
  // Whether the macro has to change the tool now. A new cycle, with Start::after_macro, goes on behind it.
  bool calls_macro() const { return calls_macro_; }
  // The position to which the change returns.
  const Point& back() const { return start_.after_macro ? *start_.after_macro : start_.machine; }
  // After so many tries to measure, the cycle ends with gave_up().
  static constexpr int most_tries = 10;
  bool gave_up() const { return gave_up_; }
  bool has_macro_fault() const { return !start_.macro_fault.empty(); }
  const std::string& reason() const { return reason_; }

 private:
  enum class Stage : std::uint8_t {
    leave,        // the work: Z up
    macro,        // ends the cycle; or the macro is done
    check_used,   // the way to the setter, also with the used tool
    unload,       // into the rack
    ask,          // for the next tool
    load,         // from the rack
    place_plate,  // asks for the touch plate
    seek,
    latch,
    judge,
    go_back,  // over the work
    give_up,
  };

  bool step() override;
  void leave();
  Stage after_check() const;
  void go_on_after_macro();
  void ask();
  Stage after_load() const;
  std::string remark() const;
  void place_plate();
  void go_to_setter();
  void seek();
  void latch();
  void touch_slowly();
  void judge();
  bool record_slow_touch();
  bool do_touches_agree();
  void judge_used();
  void report_used(std::string text);
  void not_measured(std::string reason);
  void give_up();
  void unload();
  void put_away(std::int32_t tool);
  void load();
  void open_collet(bool open);
  void go_back();

  bool has_pocket(std::int32_t tool) const;
  MachineXy pocket(std::int32_t tool) const;
  MachineXy setter() const;
  void say(std::string text);
  Point with_z(double z) const;
  Point with_xy(const MachineXy& at) const;
  void rise();
  void go_across(const MachineXy& at);
  void go_to(const Point& to);
  void go_to(const Point& to, MmPerSecond speed);
  void probe_to(double z, MmPerSecond speed);
  void probe(const Point& work_end);

  const ToolChangePlan& plan_;
  Start start_;
  Frame frame_;
  Point machine_;
  MeasuredTools known_;
  Stage stage_ = Stage::leave;
  bool used_ = false;  // the tool at the setter is the used one
  bool awaits_ = false;
  bool calls_macro_ = false;
  std::optional<ProbeOutcome> outcome_;  // empty: unknown
  bool is_measured_ = false;
  bool gave_up_ = false;
  int tries_ = 0;
  std::vector<double> touches_;  // of this measurement: machine Z; the fast one is the first
  double touched_ = 0;           // machine Z of the last touch, then their mean
  std::string reason_;
  std::deque<std::string> texts_;  // of messages that were not pulled yet
};

}  // namespace passo
