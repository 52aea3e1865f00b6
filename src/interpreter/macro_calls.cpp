// BlockExecutor: macro calls, as Fanuc and grblHAL have them. G65 calls a numbered program with arguments; G66 has it
// called behind each block that moves, until G67.
//
// The letters behind the code are the arguments, whatever they mean elsewhere: in the program that is called they are
// #1 … #26. The table is Fanuc's (argument specification I).
#include "block_executor.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;
using Kind = SubprogramJump::Kind;

constexpr LetterSet argument_letters = "ABCDEFHIJKMQRSTUVWXYZ";

// The number of the parameter that an argument goes to; 0: it goes to none.
constexpr std::size_t parameter_of(char letter) {
  constexpr std::size_t numbers[] = {1, 2, 3, 7,  8,  9,  0,  11, 4,  5,  6,  0,  13,
                                     0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26};
  return numbers[letter - 'A'];
}

}  // namespace

void BlockExecutor::call_macro(bool readable) {
  SubprogramJump call;
  call.kind = words_.has_code(macro, code(65)) ? Kind::macro : Kind::find_macro;
  call.span = words_.span(macro);
  call.good = readable && check_macro_words(call) && program_words(call);
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (argument_letters.has(letter) && words_.has(letter)) call.arguments[parameter_of(letter) - 1] = words_[letter];
  }
  jump_ = call;
  if (call.kind == Kind::macro) return;
  modal_macro_ = call;
  modal_macro_->kind = Kind::modal_macro;
}

bool BlockExecutor::check_macro_words(const SubprogramJump& call) {
  const Block& block = reporter_.block();
  if (!block.assignments.empty()) {
    return fail("gcode.unused-word", block.assignments.front().span,
                fmt::format("an assignment beside {}", call.code()), "a block of its own");
  }
  if (block.words.front().span != call.span) {
    return fail("gcode.macro-argument", block.words.front().span, fmt::format("a word before {}", call.code()),
                fmt::format("{} first, its arguments behind it", call.code()));
  }
  for (const Word& word : block.words) {
    const bool taken = word.letter == 'P' || word.letter == 'L' || word.span == call.span;
    if (taken || (word.letter != 'G' && argument_letters.has(word.letter))) continue;
    return fail("gcode.macro-argument", word.span, fmt::format("{} is no argument of a macro", word.letter),
                "P, the program, L, how often, and A B C D E F H I J K M Q R S T U V W X Y Z");
  }
  if (call.kind == Kind::find_macro && modal_macro_) {
    return fail("gcode.nested-macro", call.span, "G66 while another G66 is active", "G67 before");
  }
  return true;
}

bool BlockExecutor::end_macro_calls(CodeNumber /*number*/) {
  modal_macro_.reset();
  return true;
}

// Whether the block was one that moves. Of a NURBS the last one does.
bool BlockExecutor::moves() const {
  if (ended_) return false;
  if (words_.has_code(non_modal, code(28)) || words_.has_code(non_modal, code(30))) return true;
  if (motion_ == nullptr || motion_->number == code(80) || motion_->number == code(5, 2)) return false;
  return motion_->axes == AxisUse::none || words_.any_axis() || (words_.present() & LetterSet("IJK")).any();
}

void BlockExecutor::call_modal_macro() {
  jump_ = modal_macro_;
  jump_->span = motion_span();
}

}  // namespace passo
