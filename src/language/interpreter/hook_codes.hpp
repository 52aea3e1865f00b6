// HookCodes: the hooks of the machine file (ProgramHooks). Each is called like a numbered program: that of the start
// before the first line, that of the end by M2 or M30, which end the program when its lines are done.
#pragma once

#include <cstdint>
#include <optional>

#include "code_family.hpp"
#include "machine_lines.hpp"

namespace passo {

class HookCodes : private CodeFamily {
 public:
  HookCodes(BlockContext& block, FrameCodes& frame) : CodeFamily(block), lines_(block, frame) {}

  // Without it there are no hooks: lines of a sender, and small programs without an end.
  void allow() { are_allowed_ = true; }
  // Begins the hook. Returns the number of the program to call, or 0: there is none. An error ends the program.
  std::int32_t begin_start();
  std::int32_t begin_end(CodeNumber code);
  bool is_in_hook() const { return call_.has_value(); }
  // Whether the program that was left was a hook. `depth`: call depth of its caller.
  bool is_left(int depth) const { return call_ && depth == call_->before.depth; }
  // Ends the hook. Returns the modes to restore; spindle and coolant stay as the lines have left them.
  ModalSnapshot end();
  // After end(): M2 or M30, which ends the program now; 0: none.
  CodeNumber ending() const { return ending_; }
  // Whether the code may stand where it is: a hook cannot end the program.
  bool check_stop(CodeNumber code);

 private:
  struct Call {
    const char* key = "";
    CodeNumber ending = 0;
    MachineLines::Before before;
  };
  std::int32_t begin(const char* key, const std::string& lines, std::int32_t number, CodeNumber ending);

  MachineLines lines_;
  bool are_allowed_ = false;
  std::optional<Call> call_;
  CodeNumber ending_ = 0;
};

}  // namespace passo
