// SubprogramCodes: M98 and M99 call and leave numbered programs. G65 calls one with arguments; G66 has it called behind
// each block that moves, until G67, as Fanuc and grblHAL do.
//
// This class only tells the jump that the block requests. ProgramFlow makes the jump.
#pragma once

#include <optional>
#include <utility>

#include "code_family.hpp"
#include "subprogram_jump.hpp"

namespace passo {

class SubprogramCodes : private CodeFamily {
 public:
  explicit SubprogramCodes(BlockContext& block) : CodeFamily(block) {}

  bool call_or_leave(CodeNumber code);
  void call_macro(bool readable);
  bool end_macro_calls(CodeNumber code);
  // Call after the block was executed. If the block moved, the macro of G66 runs.
  void call_modal_macro();
  // The jump that the block just executed requests.
  std::optional<SubprogramJump> take_jump() { return std::exchange(jump_, std::nullopt); }

 private:
  bool program_words(SubprogramJump& found);
  bool check_macro_words(const SubprogramJump& call);
  bool moves() const;

  std::optional<SubprogramJump> jump_;
  std::optional<SubprogramJump> modal_macro_;  // of G66
};

}  // namespace passo
