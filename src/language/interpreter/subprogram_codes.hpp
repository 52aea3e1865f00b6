// SubprogramCodes: M98 and M99 call and leave numbered programs. G65 calls one with arguments; G66 makes each following
// block with motion call one, until G67, as in Fanuc controls and grblHAL. M100 to M199 call the subroutine m100 to
// m199 if one of the folders with subroutines has a file of that name.
//
// This class only determines the requested jump. ProgramFlow executes it.
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
  // Returns whether a folder with subroutines has a file for this user code.
  bool has_user_code(CodeNumber code) const;
  bool call_user_code(CodeNumber code);
  // Must be called after the block was executed. If the block moved, requests the macro of G66.
  void call_modal_macro();
  // Requests the program that changes tools. `span`: M6.
  void call_machine_program(std::int32_t number, Span span);
  // Returns the jump requested by the last block.
  std::optional<SubprogramJump> take_jump() { return std::exchange(jump_, std::nullopt); }

 private:
  bool program_words(SubprogramJump& found);
  bool check_macro_words(const SubprogramJump& call);
  bool moves() const;

  std::optional<SubprogramJump> jump_;
  std::optional<SubprogramJump> modal_macro_;  // the modal macro of G66
};

}  // namespace passo
