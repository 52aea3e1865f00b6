#include "block_executor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "comment_text.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

constexpr double whole_tolerance = 1e-4;

// The digits after N, as far as they count; N words may have a fraction and any length.
std::int64_t line_number_of(const Block& block) {
  if (!block.line_number) return -1;
  std::int64_t number = 0;
  for (const char digit : *block.line_number) {
    if (digit < '0' || digit > '9' || number > 99'999'999'999) break;
    number = number * 10 + (digit - '0');
  }
  return number;
}

}  // namespace

// The order of execution is LinuxCNC's (execute_block and convert_g of its interpreter): comments, spindle and feed
// mode, F, S, T, M codes, G codes, motion, stops.
const BlockExecutor::Step BlockExecutor::steps_before_words[] = {
    {spindle_mode, &BlockExecutor::set_spindle_mode},
    {feed_mode, &BlockExecutor::set_feed_mode},
};
const BlockExecutor::Step BlockExecutor::steps_after_words[] = {
    {macro, &BlockExecutor::end_macro_calls},
    {input_output, &BlockExecutor::use_input_output},
    {tool_change, &BlockExecutor::change_tool},
    {spindle, &BlockExecutor::run_spindle_group},
    {coolant, &BlockExecutor::switch_coolant},
    {overrides, &BlockExecutor::switch_overrides},
    {user, &BlockExecutor::run_user_code},
    {non_modal, &BlockExecutor::dwell},
    {plane, &BlockExecutor::select_plane},
    {length_units, &BlockExecutor::set_length_units},
    {lathe_diameter, &BlockExecutor::set_lathe_diameter},
    {cutter_compensation, &BlockExecutor::set_cutter_compensation},
    {tool_length, &BlockExecutor::set_tool_length},
    {work_system, &BlockExecutor::select_work_system},
    {path_mode, &BlockExecutor::set_path_mode},
    {distance, &BlockExecutor::set_distance_mode},
    {arc_distance, &BlockExecutor::set_arc_distance_mode},
    {retract, &BlockExecutor::set_retract_mode},
    {non_modal, &BlockExecutor::run_non_modal},
};

BlockExecutor::BlockExecutor(MachineState& state, Parameters& parameters, OperationQueue& operations,
                             Reporter& reporter, SymbolTable& symbols)
    : state_(state),
      parameters_(parameters),
      operations_(operations),
      reporter_(reporter),
      symbols_(symbols),
      cutter_(operations) {}

void BlockExecutor::start(const InterpreterOptions& options) {
  options_ = options;
  if (options.settings) {
    options_.orient_offset = options.settings->number("RS274NGC", "ORIENT_OFFSET").value_or(options.orient_offset);
    options_.spindles = static_cast<int>(options.settings->number("TRAJ", "SPINDLES").value_or(options.spindles));
  }
  state_.on_machine = options.on_machine;
  state_.spindle_count = std::clamp(options_.spindles, 1, static_cast<int>(most_spindles));
  state_.modal.set(length_units, options.units == LengthUnits::inch ? code(20) : code(21));
  state_.tools = options.tools;
  has_settings_ = options.settings != nullptr;
  emit(operation::SetLengthUnits{options.units});
  start_frame();
  state_.position = state_.frame.work_from_machine(options.start);
  emit(operation::SetFeedReference{});
  emit(operation::Reset{});
}

void BlockExecutor::finish(Closing closing) {
  if (nurbs_.open && !nurbs_.wrong && !reporter_.full()) {
    reporter_.error("gcode.open-nurbs", {1, 1},
                    fmt::format("the program ends while the NURBS that begins in line {} is open", nurbs_.line),
                    "G5.3 before");
  }
  (void)cutter_.release();
  source_.line_number = -1;
  if (closing == Closing::percent) emit(operation::Finish{});
  if (closing == Closing::missing) note("interpreter: percent sign missing from end of file");
  // Twice, as rs274 does: the end of the program, and of the interpreter. With settings it does not get there.
  emit(operation::Reset{});
  if (!has_settings_) emit(operation::Reset{});
}

void BlockExecutor::execute(const Block& block) {
  state_.line = block.line;
  source_ = {block.line, line_number_of(block)};
  const bool readable = words_.read(block, parameters_, reporter_);
  if (words_.calls_macro()) return call_macro(readable);
  if (!readable) return;
  if (!resolve_motion() || !check_words_used() || !check_words_shared() || !check_cutter_compensation()) return;
  if (const CodeEntry* const stops = words_.code(stopping); stops != nullptr && stops->number >= code(98)) {
    jump(stops->number);
    return;
  }
  if (!block.assignments.empty() && !assign(block)) return;
  if (!block.comments.empty() && !obey_comments(block)) return;
  if (block.words.empty() || !execute_words()) return;
  go_on();
  if (modal_macro_ && moves()) call_modal_macro();
}

// A cycle gives as many operations at a time as the queue takes, and the rest of its block comes behind it.
void BlockExecutor::go_on() {
  if (cycle_ == Cycle::contour) return;
  while (cycle_ != Cycle::none && operations_.has_room()) {
    if (!step_cycle()) {
      cycle_ = Cycle::none;
      return;
    }
  }
  if (cycle_ == Cycle::none && words_.code(stopping) != nullptr) stop(words_.code(stopping)->number);
}

bool BlockExecutor::step_cycle() {
  switch (cycle_) {
    case Cycle::drilling: return step_drilling();
    case Cycle::threading: return step_threading();
    case Cycle::lathe: return step_lathe();
    case Cycle::contour:
    case Cycle::none: break;
  }
  return true;
}

bool BlockExecutor::execute_words() {
  if (nurbs_.open) check_nurbs_is_closed();
  const bool only_moves = (words_.groups() & ~bit_of(motion)) == 0;  // as most blocks do
  if (!only_moves && !run(steps_before_words)) return false;
  if (words_.has('F') && !set_feed_rate()) return false;
  if (words_.has('S') && !set_spindle_speed()) return false;
  if (words_.has('T') && !select_tool()) return false;
  if (!only_moves && !run(steps_after_words)) return false;
  return motion_ == nullptr || move(motion_->number);
}

bool BlockExecutor::run(std::span<const Step> steps) {
  for (const Step& step : steps) {
    const CodeEntry* const entry = words_.code(step.group);
    if (entry != nullptr && !(this->*step.run)(entry->number)) return false;
  }
  return true;
}

// Who takes the axis words: a code of the block that is no motion, the block's motion, or the motion that is active.
bool BlockExecutor::resolve_motion() {
  motion_ = words_.code(motion);
  const CodeEntry* taker = words_.code(non_modal);
  ModalGroup taker_group = non_modal;
  if (taker == nullptr || taker->axes == AxisUse::none) {
    taker = words_.code(tool_length);
    taker_group = tool_length;
  }
  if (taker != nullptr && taker->axes == AxisUse::none) taker = nullptr;

  const bool any_axis = words_.any_axis();
  if (motion_ != nullptr && motion_->axes != AxisUse::none && taker != nullptr) {
    return fail("gcode.axis-conflict", words_.span(taker_group),
                fmt::format("{} and {} both use the axis words of the block", spelling(*taker), spelling(*motion_)),
                "two blocks");
  }
  const CodeEntry* const user = taker != nullptr ? taker : motion_;
  if (user != nullptr && user->axes == AxisUse::must && !any_axis) {
    return fail("gcode.missing-axis", words_.span(user->group), fmt::format("{} without axis words", spelling(*user)),
                "one of X Y Z A B C U V W at least");
  }
  if (motion_ != nullptr || taker != nullptr) return true;

  const CodeNumber active = state_.modal[motion];
  const bool arc_words = words_.present().bits() != 0 && (words_.present() & LetterSet("IJK")).any();
  if (any_axis || (arc_words && (active == code(2) || active == code(3)))) {
    if (active == code(80)) {
      return fail("gcode.missing-motion", motion_span(), "axis words, and no code that moves is active",
                  "G0, G1, G2, G3 or another motion code before, or in this block");
    }
    motion_ = find_code('G', active);
  }
  return true;
}

// Each word must belong to a code. F, S and T stand for themselves.
bool BlockExecutor::check_words_used() {
  LetterSet used = "FST";
  if (words_.has('S')) used.add('$');
  bool axes = false;
  const auto add = [&](const CodeEntry* entry) {
    if (entry == nullptr) return;
    used = used | entry->letters;
    axes |= entry->axes != AxisUse::none;
  };
  for (std::uint32_t groups = words_.groups(); groups != 0; groups &= groups - 1) {
    add(words_.code(static_cast<ModalGroup>(std::countr_zero(groups))));
  }
  add(motion_);
  if (axes) used = used | axis_letters;

  const LetterSet unused = words_.present() - used;
  if (!unused.any()) return true;
  for (const Word& word : reporter_.block().words) {
    if (!unused.has(word.letter)) continue;
    const std::string users = codes_using(word.letter);
    reporter_.error("gcode.unused-word", word.span, fmt::format("no code of this block uses the word {}", word.letter),
                    users.empty() ? fmt::format("no {}: no code that is supported uses it", word.letter)
                                  : fmt::format("{} with {}", word.letter, users));
  }
  return false;
}

// One word cannot be meant for two codes.
bool BlockExecutor::check_words_shared() {
  if ((words_.groups() & (words_.groups() - 1)) == 0) return true;
  const CodeEntry* owner[letter_count] = {};
  for (std::size_t group = 0; group < modal_group_count; ++group) {
    const CodeEntry* const entry = words_.code(static_cast<ModalGroup>(group));
    if (entry == nullptr) continue;
    const LetterSet shared = (words_.present() & entry->letters) - LetterSet("$");
    for (const Word& word : reporter_.block().words) {
      if (word.letter == 'G' || word.letter == 'M' || word.letter == 'N' || !shared.has(word.letter)) continue;
      const CodeEntry*& taken = owner[letter_index(word.letter)];
      if (taken != nullptr && taken != entry) {
        return fail("gcode.ambiguous-word", word.span,
                    fmt::format("{} belongs to {} or to {}, which both use it", word.letter, spelling(*taken),
                                spelling(*entry)),
                    "two blocks");
      }
      taken = entry;
    }
  }
  return true;
}

// M98 P L and M99 stand alone, as they do in LinuxCNC: what else is in the block would not be executed.
bool BlockExecutor::jump(CodeNumber number) {
  const bool call = number == code(98);
  for (const Word& word : reporter_.block().words) {
    if (word.span == words_.span(stopping) || (call && (word.letter == 'P' || word.letter == 'L'))) continue;
    return fail("gcode.unused-word", word.span, fmt::format("{} beside {}", word.letter, spelling('M', number)),
                call ? "M98 P L alone in the block" : "M99 alone in the block");
  }
  if (const auto& assignments = reporter_.block().assignments; !assignments.empty()) {
    return fail("gcode.unused-word", assignments.front().span,
                fmt::format("an assignment beside {}", spelling('M', number)), "a block of its own");
  }
  SubprogramJump found;
  found.kind = call ? SubprogramJump::Kind::call : SubprogramJump::Kind::leave;
  found.span = words_.span(stopping);
  if (call) found.good = program_words(found);
  if (!call && state_.call_depth == 0) modal_macro_.reset();  // the main program begins again
  jump_ = found;
  return true;
}

// P, the program, and L, how often.
bool BlockExecutor::program_words(SubprogramJump& found) {
  constexpr double highest_program = 999'999'999;
  if (!words_.has('P')) {
    return fail("gcode.missing-word", found.span, fmt::format("{} without P", found.code()),
                "P, the number of the program to call");
  }
  return whole_word('P', 0, highest_program, found.program) &&
         (!words_.has('L') || whole_word('L', 0, highest_program, found.passes));
}

// All values are computed before any is stored: in `#1=2 #2=#1` the second one sees the old #1.
bool BlockExecutor::assign(const Block& block) {
  assigned_.clear();
  for (const Assignment& assignment : block.assignments) {
    double value = 0;
    if (!value_of(block, assignment.value, parameters_, reporter_, value)) return false;
    assigned_.push_back(value);
  }
  for (std::size_t i = 0; i < assigned_.size(); ++i) {
    const Assignment& assignment = block.assignments[i];
    if (!assignment.index) {
      if (parameters_.set_named(assignment.symbol, assigned_[i])) continue;
      return fail("gcode.read-only-parameter", assignment.span,
                  fmt::format("#<{}> tells what the machine does and cannot be set", symbols_.name(assignment.symbol)),
                  "another name");
    }
    double index = 0;
    if (!value_of(block, *assignment.index, parameters_, reporter_, index)) return false;
    const double whole = std::round(index);
    if (std::abs(index - whole) > whole_tolerance || whole < 1 || whole > highest_parameter) {
      return fail("gcode.bad-parameter-number", assignment.index->span,
                  fmt::format("{} is not the number of a parameter", plain_number(index)),
                  fmt::format("a whole number, 1 to {}", highest_parameter));
    }
    if (!Parameters::is_settable(static_cast<std::int64_t>(whole))) {
      return fail("gcode.read-only-parameter", assignment.span,
                  fmt::format("#{} tells what the machine does and cannot be set", plain_number(whole)),
                  "another parameter");
    }
    parameters_.set(static_cast<int>(whole), assigned_[i]);
  }
  return true;
}

// As LinuxCNC does: what follows ';' is never obeyed, and of several comments in parentheses the last one is.
bool BlockExecutor::obey_comments(const Block& block) {
  const BlockComment* last = nullptr;
  for (const BlockComment& comment : block.comments) {
    const bool says_nothing = comment.text.empty() && comment.kind == BlockComment::Kind::plain;
    if (says_nothing || block.text[comment.span.column - 1] == ';') continue;
    if (last != nullptr && last->kind != BlockComment::Kind::plain) {
      reporter_.warning("gcode.hidden-comment", last->span, "only the last comment of a block is obeyed",
                        "one comment a block");
    }
    last = &comment;
  }
  return last == nullptr || obey(*last);
}

bool BlockExecutor::obey(const BlockComment& comment) {
  using Kind = BlockComment::Kind;
  using Log = operation::Log;
  const auto filled = [&]() -> std::string_view {
    fill_in_parameters(comment.text, parameters_, symbols_, text_);
    return text_;
  };
  switch (comment.kind) {
    case Kind::plain:
      emit(operation::Comment{
          comment.text.substr(std::min(comment.text.find_first_not_of(" \t"), comment.text.size()))});
      return true;
    case Kind::message: emit_ahead(operation::Message{comment.text}); return true;
    case Kind::debug:
      if (parameters_.get(show_debug_parameter) != 0) emit_ahead(operation::Message{filled()});
      return true;
    case Kind::print: emit_ahead(operation::Print{filled()}); return true;
    case Kind::log: emit_ahead(Log{Log::Kind::line, filled()}); return true;
    case Kind::log_open: emit_ahead(Log{Log::Kind::open, comment.text}); return true;
    case Kind::log_append: emit_ahead(Log{Log::Kind::append, comment.text}); return true;
    case Kind::log_close: emit_ahead(Log{Log::Kind::close, {}}); return true;
    case Kind::abort:
      ended_ = true;
      return fail("gcode.abort", comment.span, fmt::format("the program gives up:{}", filled()));
    case Kind::probe_open:
    case Kind::probe_close:  // as rs274 shows them: whole
      emit(operation::Comment{reporter_.block().text.substr(comment.span.column, comment.span.length - 2)});
      return true;
  }
  return true;
}

bool BlockExecutor::whole_word(char letter, double lowest, double highest, std::int32_t& value) {
  const double number = words_[letter];
  const double whole = std::round(number);
  if (std::abs(number - whole) > whole_tolerance || whole < lowest || whole > highest) {
    return fail("gcode.not-whole", words_.span(letter), fmt::format("{} is {}", letter, plain_number(number)),
                fmt::format("a whole number, {} to {}", plain_number(lowest), plain_number(highest)));
  }
  value = static_cast<std::int32_t>(whole);
  return true;
}

bool BlockExecutor::fail(std::string_view code, Span span, std::string message, std::string expected) {
  reporter_.error(code, span, std::move(message), std::move(expected));
  return false;
}

}  // namespace passo
