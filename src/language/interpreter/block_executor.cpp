#include "block_executor.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "interpreter_sentences.hpp"
#include "whole_number.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

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

constexpr bool drills(CodeNumber number) {
  return number == code(73) || number == code(74) || (number > code(80) && number <= code(89));
}

// From the first word to the end of the last.
WordPlace place_of_words(const Block& block) {
  if (block.words.empty()) return {};
  const Span& first = block.words.front().span;
  const Span& last = block.words.back().span;
  return {first.column, last.column + last.length - first.column};
}
WordPlace place_of(Span span) {
  return {span.column, span.length};
}

// Whether a word stands right behind a digit, as the E of X1E3.
bool follows_digit(std::string_view text, Span word) {
  return word.column > 1 && word.column <= text.size() && text[word.column - 2] >= '0' && text[word.column - 2] <= '9';
}

}  // namespace

// What the code of each group does. Most modes are nothing but set.
const std::array<BlockExecutor::GroupFunction, modal_group_count> BlockExecutor::group_functions = [] {
  std::array<GroupFunction, modal_group_count> all{};
  all.fill(of<&BlockExecutor::modes_, &ModeCodes::set>);
  const auto does = [&all](ModalGroup group, GroupFunction function) { all[index_of(group)] = function; };
  does(spindle_mode, of<&BlockExecutor::spindles_, &SpindleCodes::set_mode>);
  does(feed_mode, of<&BlockExecutor::modes_, &ModeCodes::set_feed_mode>);
  does(macro, of<&BlockExecutor::subprograms_, &SubprogramCodes::end_macro_calls>);
  does(input_output, of<&BlockExecutor::input_output_, &InputOutputCodes::run>);
  does(tool_change, of<&BlockExecutor::tools_, &ToolCodes::change>);
  does(spindle, own<&BlockExecutor::run_spindle_group>);
  does(coolant, of<&BlockExecutor::modes_, &ModeCodes::switch_coolant>);
  does(overrides, of<&BlockExecutor::modes_, &ModeCodes::switch_overrides>);
  does(user, own<&BlockExecutor::run_user_code>);
  does(cutter_compensation, of<&BlockExecutor::cutter_codes_, &CutterCodes::set>);
  does(tool_length, of<&BlockExecutor::tools_, &ToolCodes::set_length>);
  does(work_system, of<&BlockExecutor::frame_, &FrameCodes::select_work_system>);
  does(path_mode, of<&BlockExecutor::modes_, &ModeCodes::set_path_mode>);
  does(non_modal, own<&BlockExecutor::run_non_modal>);
  return all;
}();

BlockExecutor::BlockExecutor(BlockContext& block, SymbolTable& symbols)
    : CodeFamily(block),
      cutter_codes_(block),
      frame_(block),
      spindles_(block),
      tools_(block, frame_, spindles_),
      input_output_(block),
      motion_(block, cutter_codes_),
      splines_(block),
      probe_(block),
      drilling_(block),
      threading_(block),
      lathe_(block, cutter_codes_, symbols),
      subprograms_(block),
      modes_(block),
      stops_(block, cutter_codes_, frame_),
      hooks_(block, frame_),
      comments_(block, symbols),
      symbols_(symbols) {}

void BlockExecutor::start(const InterpreterOptions& options) {
  block_.options = options;
  if (options.settings) {
    block_.options.orient_offset =
        options.settings->number("RS274NGC", "ORIENT_OFFSET").value_or(options.orient_offset);
    block_.options.spindles = static_cast<int>(options.settings->number("TRAJ", "SPINDLES").value_or(options.spindles));
  }
  state_.on_machine = options.on_machine;
  state_.measured.by_plan = options.tool_change != nullptr;
  state_.spindle_count = std::clamp(block_.options.spindles, 1, static_cast<int>(most_spindles));
  state_.modal.set(length_units, options.units == LengthUnits::inch ? code(20) : code(21));
  state_.tools = options.tools;
  has_settings_ = options.settings != nullptr;
  emit(operation::SetLengthUnits{options.units});
  frame_.start();
  state_.position = state_.frame.work_from_machine(options.start);
  emit(operation::SetFeedReference{});
  emit(operation::Reset{});
}

void BlockExecutor::keep() {
  missing_feed_was_told_ = block_.missing_feed_told;
  drilling_.keep();
}

void BlockExecutor::roll_back() {
  block_.missing_feed_told = missing_feed_was_told_;
  drilling_.roll_back();
  cycle_ = nullptr;
  tools_.drop_change();
  reopen();  // the program had not ended when its last line came
}

void BlockExecutor::finish(Closing closing) {
  splines_.report_open_nurbs();
  (void)cutter_.release();
  block_.source.line_number = -1;
  if (closing == Closing::percent) emit(operation::Finish{});
  if (closing == Closing::missing) emit_comment("interpreter: percent sign missing from end of file");
  // Twice, as rs274 does: the end of the program, and of the interpreter. With settings it does not get there.
  emit(operation::Reset{});
  if (!has_settings_) emit(operation::Reset{});
}

void BlockExecutor::execute(const Block& block) {
  state_.line = block.line;
  block_.source = {block.line, line_number_of(block), tools_.is_in_macro() || hooks_.is_in_hook()};
  block_.word = place_of_words(block);
  if (block.spaced_number) reporter_.warn_of_blank(*block.spaced_number);
  const bool readable = words_.read(block, parameters_, reporter_);
  if (words_.calls_macro()) return subprograms_.call_macro(readable);
  if (!readable) return;
  words_.find_axes(block_.axis_words);
  if (words_.has_code(non_modal, code(4)) && !words_.has('P')) {
    fail("gcode.missing-word", words_.span(non_modal), interpreter_says::dwell_without_p,
         words_.has('X') || words_.has('U') ? FindingWords("P, the time to wait in seconds; other controls use X or U")
                                            : interpreter_says::seconds_to_wait);
    return;
  }
  if (!resolve_motion() || (!speaks_grbl() && !check_words_used()) || !check_words_shared() || !cutter_codes_.check()) {
    return;
  }
  if (const CodeEntry* const stops = words_.code(stopping); stops != nullptr && stops->number >= code(98)) {
    subprograms_.call_or_leave(stops->number);
    return;
  }
  if (!block.assignments.empty() && !assign(block)) return;
  if (!block.comments.empty() && !comments_.obey(block)) return;
  if (block.words.empty() || !execute_words()) return;
  // grbl looks for words without use at the very end. Of a line with an error nothing is executed all the same.
  if (speaks_grbl() && !check_words_used()) return;
  const bool ends = words_.has_code(stopping, code(2)) || words_.has_code(stopping, code(30));
  if (ends && cycle_ == nullptr && tools_.begin_last_check()) cycle_ = &tools_;
  go_on();
  subprograms_.call_modal_macro();
}

// The order of execution is LinuxCNC's (execute_block and convert_g of its interpreter): comments, spindle and feed
// mode, F, S, T, M codes, G codes, motion, stops. grbl's order has the same effect, but for units, which come before F.
bool BlockExecutor::execute_words() {
  if (splines_.nurbs_is_open()) splines_.check_nurbs_is_closed();
  const WordPlace all = block_.word;
  const bool only_moves = (words_.groups() & ~bit_of(motion)) == 0;  // as most blocks do
  if (!only_moves && !execute_before_words()) return false;
  if (words_.has('F') && !modes_.set_feed_rate()) return false;
  // In grbl, F of inverse time counts for its own line alone, also when G94 comes.
  if (speaks_grbl() && state_.modal.inverse_time()) state_.feed = words_.has('F') ? words_['F'] : 0;
  if (words_.has('S') && !set_spindle_speed()) return false;
  if (words_.has('T') && !tools_.select()) return false;
  if (!only_moves) {
    for (const ModalGroup group : {macro, input_output, tool_change}) {
      if (!run(group)) return false;
    }
    if (tools_.has_begun()) return begin(tools_, true);
    if (!execute_after_words()) return false;
  }
  block_.word = all;
  return execute_motion();
}

bool BlockExecutor::execute_motion() {
  return block_.motion == nullptr || move(block_.motion->number);
}

// The words of an M6 with a cycle, once the tool is changed.
bool BlockExecutor::execute_after_change() {
  if (!execute_after_words()) return false;
  block_.word = place_of_words(reporter_.block());
  return execute_motion();
}

bool BlockExecutor::execute_before_words() {
  return run(spindle_mode) && run(feed_mode) && (!speaks_grbl() || run(length_units));
}

bool BlockExecutor::execute_after_words() {
  for (const ModalGroup group : {spindle, coolant, overrides, user}) {
    if (!run(group)) return false;
  }
  if (!stops_.dwell()) return false;
  for (const ModalGroup group : modes_in_order) {
    const bool is_set = group == length_units && speaks_grbl();
    if (!is_set && !run(group)) return false;
  }
  return run(non_modal);
}

bool BlockExecutor::set_spindle_speed() {
  block_.word = place_of(words_.span('S'));
  return spindles_.set_speed();
}

bool BlockExecutor::run(ModalGroup group) {
  const CodeEntry* const entry = words_.code(group);
  if (entry == nullptr) return true;
  block_.word = place_of(words_.span(group));
  return set_group(*entry);
}

// M3, M4, M5, M19 share a modal group with M70 to M73.
bool BlockExecutor::run_spindle_group(CodeNumber number) {
  switch (number) {
    case code(19): return spindles_.orient();
    case code(70):
    case code(71):
    case code(72):
    case code(73): return keep_modal_state(number);
    default: return spindles_.turn(number);
  }
}

bool BlockExecutor::move(CodeNumber number) {
  if (!drills(number)) drilling_.forget();
  state_.modal.set(motion, number);
  const LetterSet in_doubt = reporter_.doubts().axes();
  const bool good = move_by(number);
  const bool is_arc = number == code(2) || number == code(3);  // a wrong one leads to its end, too
  if (good ? in_doubt.any() : is_arc) {
    reporter_.doubts().set_axes(state_.modal.incremental() ? in_doubt : in_doubt - words_.present());
  }
  if (cutter_.active()) {
    if (!good) cutter_.skip_to(state_.position);
    state_.cutter_shift = cutter_.shift(state_.position);
  }
  return good;
}

bool BlockExecutor::move_by(CodeNumber number) {
  if (!motion_.check_scaling(number)) return false;
  if (number != code(5)) splines_.interrupt();
  switch (number) {
    case code(0): return motion_.traverse();
    case code(1): return motion_.feed();
    case code(2): return motion_.arc(true);
    case code(3): return motion_.arc(false);
    case code(5): return splines_.cubic();
    case code(5, 1): return splines_.quadratic();
    case code(5, 2): return splines_.nurbs_point();
    case code(5, 3): return splines_.end_nurbs();
    case code(33): return motion_.threading(false);
    case code(33, 1): return motion_.threading(true);
    case code(38, 2):
    case code(38, 3):
    case code(38, 4):
    case code(38, 5): return probe_.probe(number);
    case code(73):
    case code(74):
    case code(81):
    case code(82):
    case code(83):
    case code(84):
    case code(85):
    case code(86):
    case code(87):
    case code(88):
    case code(89): return begin(drilling_, drilling_.start(number));
    case code(76): return begin(threading_, threading_.start());
    case code(70):
    case code(71):
    case code(71, 1):
    case code(71, 2):
    case code(72):
    case code(72, 1):
    case code(72, 2): return lathe_.start(number);
    default: emit_comment("interpreter: motion mode set to none"); return true;  // G80
  }
}

bool BlockExecutor::begin(CycleCodes& codes, bool good) {
  if (good) cycle_ = &codes;
  return good;
}

// Who takes the axis words: a code of the block that is no motion, the block's motion, or the motion that is active.
bool BlockExecutor::resolve_motion() {
  block_.motion = words_.code(motion);
  const CodeEntry* taker = words_.code(non_modal);
  ModalGroup taker_group = non_modal;
  if (taker == nullptr || taker->axes == AxisUse::none) {
    taker = words_.code(tool_length);
    taker_group = tool_length;
  }
  if (taker != nullptr && taker->axes == AxisUse::none) taker = nullptr;

  const bool any_axis = words_.any_axis();
  if (block_.motion != nullptr && block_.motion->axes != AxisUse::none && taker != nullptr) {
    const bool homes = taker->number == code(28) || taker->number == code(30);
    if (homes && block_.motion->number == code(0) && !speaks_grbl()) return go_home_beside_g0(*taker);
    return fail(
        "gcode.axis-conflict", words_.span(taker_group),
        interpreter_says::both_use_axes.with({{"first", spelling(*taker)}, {"second", spelling(*block_.motion)}}),
        interpreter_says::two_blocks);
  }
  const CodeEntry* const user = taker != nullptr ? taker : block_.motion;
  if (user != nullptr && user->axes == AxisUse::must && !any_axis) {
    return fail("gcode.missing-axis", words_.span(user->group),
                interpreter_says::without_axes.with({{"code", spelling(*user)}}), interpreter_says::an_axis);
  }
  if (block_.motion != nullptr || taker != nullptr) return true;

  const CodeNumber active = state_.modal[motion];
  // In grbl only axis words move.
  const bool arc_words = !speaks_grbl() && (words_.present() & LetterSet("IJK")).any();
  if (any_axis || (arc_words && (active == code(2) || active == code(3)))) {
    if (active == code(80)) {
      return fail("gcode.missing-motion", motion_span(), interpreter_says::nothing_moves,
                  interpreter_says::motion_code);
    }
    block_.motion = find_code('G', active);
  }
  return true;
}

// `G0 G91 G28 Z0`, as Fanuc's programs have it: the axis words are G28's, and G0 stays in force.
bool BlockExecutor::go_home_beside_g0(const CodeEntry& taker) {
  reporter_.warning("gcode.g0-with-home", words_.span(motion),
                    interpreter_says::home_beside_g0.with({{"code", spelling(taker)}}),
                    interpreter_says::home_alone.with({{"code", spelling(taker)}}));
  state_.modal.set(motion, code(0));
  block_.motion = nullptr;
  return true;
}

// Each word must belong to a code. F, S and T stand for themselves.
bool BlockExecutor::check_words_used() {
  LetterSet used = "FST";
  if (words_.has('S')) used.add('$');
  bool axes = false;
  const auto add = [&](const CodeEntry* entry) {
    if (entry == nullptr) return;
    used = used | (speaks_grbl() ? letters_of(*entry) : entry->letters);
    axes |= entry->axes != AxisUse::none;
  };
  for (std::uint32_t groups = words_.groups(); groups != 0; groups &= groups - 1) {
    add(words_.code(static_cast<ModalGroup>(std::countr_zero(groups))));
  }
  add(block_.motion);
  if (axes) used = used | axis_letters;

  const LetterSet unused = words_.present() - used;
  if (!unused.any()) return true;
  for (const Word& word : reporter_.block().words) {
    if (!unused.has(word.letter)) continue;
    const std::string users = codes_using(word.letter);
    std::string expected = users.empty() ? fmt::format("no {}, which no supported code uses", word.letter)
                                         : fmt::format("{} with {}", word.letter, users);
    if (word.letter == 'E' && follows_digit(reporter_.block().text, word.span)) {
      expected += "; numbers cannot have an exponent, so 1E3 is written 1000";
    }
    reporter_.error("gcode.unused-word", word.span,
                    interpreter_says::unused_word.with({{"letter", std::string(1, word.letter)}}), std::move(expected));
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
    const LetterSet shared = (words_.present() & letters_of(*entry)) - LetterSet("$");
    for (const Word& word : reporter_.block().words) {
      if (word.letter == 'G' || word.letter == 'M' || word.letter == 'N' || !shared.has(word.letter)) continue;
      const CodeEntry*& taken = owner[letter_index(word.letter)];
      if (taken != nullptr && taken != entry) {
        return fail(
            "gcode.ambiguous-word", word.span,
            fmt::format("{} is ambiguous: both {} and {} use it", word.letter, spelling(*taken), spelling(*entry)),
            interpreter_says::two_blocks);
      }
      taken = entry;
    }
  }
  return true;
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
                  fmt::format("#<{}> is a read-only system parameter", symbols_.name(assignment.symbol)),
                  "another name");
    }
    double index = 0;
    if (!value_of(block, *assignment.index, parameters_, reporter_, index)) return false;
    const std::optional<double> whole = whole_within(index, 1, highest_parameter);
    if (!whole) {
      return fail("gcode.bad-parameter-number", assignment.index->span,
                  fmt::format("{} is not a parameter number", plain_number(index)),
                  fmt::format("a whole number, 1 to {}", highest_parameter));
    }
    const auto number = static_cast<std::int64_t>(*whole);
    if (!Parameters::is_settable(number) || parameters_.is_machine_position(number)) {
      return fail("gcode.read-only-parameter", assignment.span,
                  fmt::format("#{} is a read-only system parameter", plain_number(*whole)), "another parameter");
    }
    parameters_.set(static_cast<int>(*whole), assigned_[i]);
  }
  return true;
}

// In grbl a G53 without axis words needs no motion in its block.
bool BlockExecutor::moves_straight() const {
  if (block_.motion == nullptr && !speaks_grbl()) return false;
  const CodeNumber number = block_.motion != nullptr ? block_.motion->number : state_.modal[motion];
  return number == code(0) || number == code(1);
}

bool BlockExecutor::run_user_code(CodeNumber number) {
  return subprograms_.has_user_code(number) ? subprograms_.call_user_code(number) : input_output_.run_user_code(number);
}

bool BlockExecutor::run_non_modal(CodeNumber number) {
  switch (number) {
    case code(10): return tools_.set_table();
    case code(28): return splines_.interrupt(), frame_.go_home(first_home_parameter);
    case code(28, 1): return frame_.store_home(first_home_parameter);
    case code(30): return splines_.interrupt(), frame_.go_home(second_home_parameter);
    case code(30, 1): return frame_.store_home(second_home_parameter);
    case code(50): state_.scaling = Scaling{}; return true;
    case code(51): return frame_.set_scaling();
    case code(52):
    case code(92):
    case code(92, 1):
    case code(92, 2):
    case code(92, 3): return frame_.set_g92(number);
    case code(53):
      if (moves_straight()) return true;
      return fail("gcode.g53-without-move", words_.span(non_modal), "G53 without G0 or G1", "G53 G0 … or G53 G1 …");
    default: return true;  // G4 was executed before
  }
}

}  // namespace passo
