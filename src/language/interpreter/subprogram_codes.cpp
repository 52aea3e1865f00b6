// The letters after G65 and G66 are arguments, whatever they mean elsewhere. In the program that is called they are #1
// … #26. The table is Fanuc's (argument specification I).
#include "subprogram_codes.hpp"

#include <algorithm>
#include <string>

#include "file_place.hpp"
#include "program_lines.hpp"
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

// M98 P L and M99 stand alone, as in LinuxCNC, because other words of the block would not be executed.
bool SubprogramCodes::call_or_leave(CodeNumber number) {
  const bool call = number == code(98);
  for (const Word& word : reporter_.block().words) {
    if (word.span == words_.span(stopping) || (call && (word.letter == 'P' || word.letter == 'L'))) continue;
    return fail("gcode.unused-word", word.span, fmt::format("{} beside {}", word.letter, spelling('M', number)),
                call ? "only M98, P and L in the block" : "only M99 in the block");
  }
  if (const auto& assignments = reporter_.block().assignments; !assignments.empty()) {
    return fail("gcode.unused-word", assignments.front().span,
                fmt::format("an assignment in the same block as {}", spelling('M', number)), "a block of its own");
  }
  SubprogramJump found;
  found.kind = call ? SubprogramJump::Kind::call : SubprogramJump::Kind::leave;
  found.span = words_.span(stopping);
  if (call) found.good = program_words(found);
  if (!call && state_.call_depth == 0) modal_macro_.reset();  // the main program begins again
  jump_ = found;
  return true;
}

// Reads P, the program, and L, how often it runs.
bool SubprogramCodes::program_words(SubprogramJump& found) {
  constexpr double highest_program = 999'999'999;
  if (!words_.has('P')) {
    return fail("gcode.missing-word", found.span, fmt::format("{} without P", found.code()),
                "P, the number of the program to call");
  }
  return whole_word('P', 0, highest_program, found.program) &&
         (!words_.has('L') || whole_word('L', 0, highest_program, found.passes));
}

void SubprogramCodes::call_machine_program(std::int32_t number, Span span) {
  SubprogramJump call;
  call.kind = Kind::macro;
  call.span = span;
  call.program = number;
  jump_ = call;
}

void SubprogramCodes::call_macro(bool readable) {
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

bool SubprogramCodes::check_macro_words(const SubprogramJump& call) {
  const Block& block = reporter_.block();
  if (!block.assignments.empty()) {
    return fail("gcode.unused-word", block.assignments.front().span,
                fmt::format("an assignment in the same block as {}", call.code()), "a block of its own");
  }
  if (block.words.front().span != call.span) {
    return fail("gcode.macro-argument", block.words.front().span, fmt::format("a word before {}", call.code()),
                fmt::format("{} first, then its arguments", call.code()));
  }
  for (const Word& word : block.words) {
    const bool taken = word.letter == 'P' || word.letter == 'L' || word.span == call.span;
    if (taken || (word.letter != 'G' && argument_letters.has(word.letter))) continue;
    return fail(
        "gcode.macro-argument", word.span, fmt::format("{} cannot be an argument of a macro", word.letter),
        "P (the program), L (the number of calls), and the arguments A B C D E F H I J K M Q R S T U V W X Y Z");
  }
  if (call.kind == Kind::find_macro && modal_macro_) {
    return fail("gcode.nested-macro", call.span, "G66 while another G66 is active", "G67 first");
  }
  return true;
}

bool SubprogramCodes::end_macro_calls(CodeNumber /*number*/) {
  modal_macro_.reset();
  return true;
}

bool SubprogramCodes::has_user_code(CodeNumber number) const {
  const std::string name = fmt::format("m{}.ngc", number / 10);
  return std::ranges::any_of(block_.options.sub_folders,
                             [&](const std::string& folder) { return is_regular_file(file_in_folder(folder, name)); });
}

// P and Q are #1 and #2 of the subroutine, -1 if the block does not have them. The block contains nothing else, because
// the subroutine runs after the block.
bool SubprogramCodes::call_user_code(CodeNumber number) {
  for (const Word& word : reporter_.block().words) {
    if (word.span == words_.span(user) || word.letter == 'P' || word.letter == 'Q') continue;
    return fail("gcode.unused-word", word.span,
                fmt::format("{} in the block of {}, which calls a subroutine", word.letter, spelling('M', number)),
                fmt::format("only {}, P and Q in the block", spelling('M', number)));
  }
  SubprogramJump call;
  call.kind = Kind::user_code;
  call.span = words_.span(user);
  call.program = number / 10;
  call.arguments[0] = words_.has('P') ? words_['P'] : -1;
  call.arguments[1] = words_.has('Q') ? words_['Q'] : -1;
  jump_ = call;
  return true;
}

// Whether the block moves. Of a NURBS only the last block moves.
bool SubprogramCodes::moves() const {
  if (block_.ended) return false;
  if (words_.has_code(non_modal, code(28)) || words_.has_code(non_modal, code(30))) return true;
  if (block_.motion == nullptr || block_.motion->number == code(80) || block_.motion->number == code(5, 2))
    return false;
  return block_.motion->axes == AxisUse::none || words_.any_axis() || (words_.present() & LetterSet("IJK")).any();
}

void SubprogramCodes::call_modal_macro() {
  if (!modal_macro_ || !moves()) return;
  jump_ = modal_macro_;
  jump_->span = motion_span();
}

}  // namespace passo
