// ToolCodes: the codes and words of tools (T, M6, M61, G43, G49, G10 L0, L1, L10, L11): the tool in the spindle, its
// offset, and its entry in the tool table. On a machine that measures its tools, M6 is a cycle (ToolChangeCycle).
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "cycle_codes.hpp"
#include "frame_codes.hpp"
#include "machine_lines.hpp"
#include "spindle_codes.hpp"
#include "tool_change_cycle.hpp"

namespace passo {

class ToolCodes final : public CycleCodes {
 public:
  ToolCodes(BlockContext& block, FrameCodes& frame, SpindleCodes& spindles)
      : CycleCodes(block), frame_(frame), spindles_(spindles), lines_(block, frame) {}

  bool select();
  bool change(CodeNumber code);
  // Whether an M6 has begun a cycle whose block has other words, which wait for its end.
  bool has_begun() const { return begun_; }
  bool take_begun() { return std::exchange(begun_, false); }
  // As if the M6 had not been read.
  void drop_change() {
    begun_ = calls_macro_ = false;
    macro_.reset();
  }
  // Returns whether the tool is now to be changed by the lines of the machine file. Called once after each cycle.
  bool take_macro_call() { return std::exchange(calls_macro_, false); }
  bool is_in_macro() const { return macro_.has_value(); }
  // Whether the subroutine that was left was that of the change. `depth`: call depth of its caller.
  bool changes_by_macro(int depth) const { return macro_ && depth == macro_->before.depth; }
  // Finds what the macro has left that the program does not expect. Called before the modes are restored.
  void examine_after_macro();
  const ModalSnapshot& modes_before_macro() const { return macro_->before.modes; }
  // Begins the cycle that goes on behind it.
  void go_on_after_macro() { begin_cycle(next_tool_, false); }
  // Whether the code may stand where it is: the lines of a change cannot end the program.
  bool check_stop(CodeNumber code);
  // Begins a cycle that measures the used tool at the end of the program. Returns false if there is nothing to measure.
  bool begin_last_check();
  Cycle& cycle() override { return *cycle_; }
  bool finish() override;
  bool set_length(CodeNumber code);
  bool set_table();

 private:
  bool reload_tools();
  bool set_tool_table_entry();
  bool find_tool(std::int32_t number, Span span, const Tool*& tool);
  void load_tool(std::int32_t number);
  void begin_cycle(std::int32_t to, bool only_checks);
  void begin_macro();
  void end_macro();
  bool fail_change(bool by_macro);
  bool check_alone();
  void use_length(double contact);
  void use_table_length();
  bool tool_offset(Point& offset);
  bool check_tool_entry_words(Tool*& tool);
  void set_tool_offsets(Tool& tool);

  FrameCodes& frame_;
  SpindleCodes& spindles_;
  bool missing_table_told_ = false;
  bool was_loaded_ = false;
  std::optional<ToolChangeCycle> cycle_;
  std::int32_t next_tool_ = 0;  // of the cycle
  bool only_checks_ = false;
  bool begun_ = false;
  bool calls_macro_ = false;
  // Set while the macro runs, and until its change is over. It has no initializers, since
  // clang 14 would read them too late for std::optional; emplace() sets all to zero.
  struct MacroCall {
    Point back;  // the machine position before the change
    bool mist;   // that of the program; off while the macro runs
    bool flood;
    MachineLines::Before before;
    bool spindle_turns;  // the macro has left it so
    std::string fault;
  };
  std::optional<MacroCall> macro_;
  MachineLines lines_;
};

}  // namespace passo
