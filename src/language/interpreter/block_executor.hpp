// BlockExecutor: executes one block, i.e. converts its words to operations, in RS274/NGC's order of execution.
//
// First the block is checked as a whole (at most one code of each modal group, every word used, at most one code that
// uses the axis words). Then it is executed group by group in a fixed order. The codes belong to families
// (code_family.hpp). A cycle is a source of operations, from which operations are pulled while the queue has room,
// until the cycle is finished. Execution of a block stops at an error. The position is set to the block's intended end
// nevertheless, so that one mistake does not cause errors in all following blocks.
//
// A block needs no memory allocation. The queue has room for the maximum number of operations of one block (an M2 with
// everything before it).
#pragma once

#include <array>
#include <optional>
#include <type_traits>
#include <vector>

#include "active_comments.hpp"
#include "code_family.hpp"
#include "cutter_codes.hpp"
#include "drilling_codes.hpp"
#include "frame_codes.hpp"
#include "hook_codes.hpp"
#include "input_output_codes.hpp"
#include "lathe_codes.hpp"
#include "modal_snapshot.hpp"
#include "mode_codes.hpp"
#include "motion_codes.hpp"
#include "probe_codes.hpp"
#include "spindle_codes.hpp"
#include "spline_codes.hpp"
#include "stop_codes.hpp"
#include "subprogram_codes.hpp"
#include "threading_codes.hpp"
#include "tool_codes.hpp"

namespace passo {

class BlockExecutor : private CodeFamily {
 public:
  BlockExecutor(BlockContext& block, SymbolTable& symbols);

  void start(const InterpreterOptions& options);
  void execute(const Block& block);
  // How the program ended: at its closing '%'; with M2 and without a required '%'; or neither.
  enum class Closing : std::uint8_t { none, percent, missing };
  void finish(Closing closing);
  // Returns true after M2, M30 or (ABORT,…).
  bool ended() const { return block_.ended; }
  // Returns true after (ABORT,…).
  bool gave_up() const { return block_.gave_up; }
  // Save and restore the state that blocks leave to later ones, in addition to the program's state and its parameters.
  // Complete only for the Grbl dialect; splines, cutter compensation and LinuxCNC's macros have further state.
  void keep();
  void roll_back();
  // Continues after the end of the program.
  void reopen() { block_.ended = block_.gave_up = false; }
  // Returns the jump requested by the last block.
  std::optional<SubprogramJump> take_jump() { return subprograms_.take_jump(); }
  // Notes that a subroutine was left, by its O-word or M99, and that the caller continues.
  void leave_sub(const OperationSource& source);
  // Handles M99 in a main program that does not run again.
  void end_program(bool pallet) { stops_.end_program(pallet); }
  // Returns whether a cycle of the last block has more operations.
  bool busy() const { return cycle_ != nullptr; }
  void go_on();
  // Returns the word for the number of repetitions of the cycle: L, or the code of the cycle.
  Span repeated() const { return words_.has('L') ? words_.span('L') : Span{block_.word.column, block_.word.length}; }
  void drop_cycle() { cycle_ = nullptr; }

  // The hooks of the machine file; without allow_hooks() there are none. Returns whether there is one at the start,
  // whose call is then to be followed.
  void allow_hooks() { hooks_.allow(); }
  bool call_start_hook();
  // Returns whether the program waits for the result of the last probe move.
  bool awaits_probe() const { return probe_.awaits_outcome(); }
  void apply_probe_outcome() { probe_.apply_outcome(); }

  // Returns the lathe cycle that receives the blocks of its subroutine one by one instead of execute(), or null if
  // there is none.
  LatheCodes* wants_contour() { return lathe_.wants_contour() ? &lathe_ : nullptr; }
  void add_to_contour(const Block& block);
  void end_contour();

 private:
  bool go_home_beside_g0(const CodeEntry& taker);
  // Executes the code of a group. Returns false if the code failed; the rest of the block is then not executed.
  using GroupFunction = bool (*)(BlockExecutor& executor, const CodeEntry& entry);
  static const std::array<GroupFunction, modal_group_count> group_functions;
  bool set_group(const CodeEntry& entry) { return group_functions[index_of(entry.group)](*this, entry); }
  template <auto method>
  static bool own(BlockExecutor& executor, const CodeEntry& entry) {
    return (executor.*method)(entry.number);
  }
  template <auto family, auto method>
  static bool of(BlockExecutor& executor, const CodeEntry& entry) {
    using Family = std::remove_reference_t<decltype(executor.*family)>;
    if constexpr (std::is_invocable_v<decltype(method), Family&, const CodeEntry&>) {
      return ((executor.*family).*method)(entry);
    } else {
      return ((executor.*family).*method)(entry.number);
    }
  }

  // Checks of the block as a whole.
  bool resolve_motion();
  bool check_words_used();
  bool check_words_shared();
  bool assign(const Block& block);
  bool execute_words();
  bool execute_before_words();
  bool execute_after_words();
  bool execute_after_change();
  bool execute_motion();
  bool run(ModalGroup group);

  // Words and groups, in the order in which they are executed.
  bool set_spindle_speed();
  bool run_spindle_group(CodeNumber code);
  bool run_non_modal(CodeNumber code);
  bool run_user_code(CodeNumber code);
  bool moves_straight() const;
  bool move(CodeNumber code);
  bool move_by(CodeNumber code);
  bool begin(CycleCodes& codes, bool good);

  // Saving and restoring the modal state.
  bool keep_modal_state(CodeNumber code);
  void restore_after_sub(const OperationSource& source);
  void leave_hook();
  void restore(const ModalSnapshot& saved);
  void restore_spindles(const ModalSnapshot& saved);
  void restore_switches(const ModalSnapshot& saved);

  CutterCodes cutter_codes_;
  FrameCodes frame_;
  SpindleCodes spindles_;
  ToolCodes tools_;
  InputOutputCodes input_output_;
  MotionCodes motion_;
  SplineCodes splines_;
  ProbeCodes probe_;
  DrillingCodes drilling_;
  ThreadingCodes threading_;
  LatheCodes lathe_;
  SubprogramCodes subprograms_;
  ModeCodes modes_;
  StopCodes stops_;
  HookCodes hooks_;
  ActiveComments comments_;

  SymbolTable& symbols_;
  CycleCodes* cycle_ = nullptr;           // the active cycle
  std::vector<ModalSnapshot> snapshots_;  // by call depth
  std::vector<double> assigned_;
  bool missing_feed_was_told_ = false;  // its value at keep()
  bool has_settings_ = false;
};

}  // namespace passo
