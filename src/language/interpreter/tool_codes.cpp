#include "tool_codes.hpp"

#include <algorithm>
#include <cmath>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

using enum ModalGroup;

constexpr int rotary_fixture = 9;  // G10 L11 measures in G59.3

}  // namespace

// Finds null without an error if the number is 0 (no tool) or if no tool table was given.
bool ToolCodes::find_tool(std::int32_t number, Span span, const Tool*& tool) {
  tool = state_.tools.find(number);
  if (tool != nullptr || number == 0 || state_.tools.name.empty()) return true;
  return fail("gcode.unknown-tool", span, fmt::format("there is no tool {} in {}", number, state_.tools.name),
              fmt::format("a line T{} P… in the tool table, or another table (--tools FILE)", number));
}

bool ToolCodes::select() {
  std::int32_t number = 0;
  const Tool* tool = nullptr;
  if (!whole_word('T', 0, highest_tool, number) || !find_tool(number, words_.span('T'), tool)) return false;
  state_.selected_tool = number;
  emit_ahead(operation::SelectTool{number});
  return true;
}

bool ToolCodes::change(CodeNumber number) {
  if (number == code(61)) {
    std::int32_t tool = 0;
    const Tool* known = nullptr;
    if (!words_.has('Q'))
      return fail("gcode.missing-word", words_.span(tool_change), "M61 without Q", "Q, the tool number");
    if (!whole_word('Q', 0, highest_tool, tool) || !find_tool(tool, words_.span('Q'), known)) return false;
    load_tool(tool);
    state_.measured.tool = 0;
    state_.measured.any_change = true;
    emit(operation::SetToolNumber{tool});
    return true;
  }
  if (state_.selected_tool < 0) {
    return fail("gcode.missing-tool", words_.span(tool_change), interpreter_says::no_tool_selected,
                interpreter_says::tool_before);
  }
  if (block_.options.tool_change != nullptr && !macro_) {  // inside the macro, M6 asks and waits
    if (!check_uncompensated("M6") || !check_alone()) return false;
    begin_cycle(state_.selected_tool, false);
    begun_ = true;
    return true;
  }
  load_tool(state_.selected_tool);
  emit(operation::StartToolChange{});
  spindles_.stop();
  emit(operation::ChangeTool{state_.tool});
  return true;
}

void ToolCodes::begin_cycle(std::int32_t to, bool only_checks) {
  ToolChangeCycle::Start start{.machine = state_.machine_position(),
                               .frame = state_.frame,
                               .known = state_.measured,
                               .after_macro = macro_ ? std::optional(macro_->back) : std::nullopt,
                               .macro_fault = macro_ ? macro_->fault : std::string(),
                               .from = state_.tool,
                               .to = to,
                               .only_checks = only_checks,
                               .spindle_turns = macro_ ? macro_->spindle_turns : state_.any_spindle_turns(),
                               .mist = macro_ ? macro_->mist : state_.mist,
                               .flood = macro_ ? macro_->flood : state_.flood};
  const auto remark = state_.tools.remarks.find(to);
  if (remark != state_.tools.remarks.end()) start.remark = remark->second;
  next_tool_ = to;
  only_checks_ = only_checks;
  spindles_.stop();
  OperationSource source = block_.source;
  source.inserted = true;
  cycle_.emplace(*block_.options.tool_change, start, source);
}

// Other words would be executed before the subroutine has changed the tool.
bool ToolCodes::check_alone() {
  if (block_.options.tool_change->way != ToolChangeWay::macro) return true;
  if (speaks_grbl()) {
    return fail("gcode.change-macro", words_.span(tool_change),
                "the macro of the tool change is in the LinuxCNC dialect", "a program in the LinuxCNC dialect");
  }
  const bool others = (words_.groups() & ~bit_of(tool_change)) != 0 || block_.motion != nullptr;
  if (!others) return true;
  return fail("gcode.change-macro", words_.span(tool_change), "M6 calls a subroutine, but its block has other codes",
              "M6 and T in a block of their own");
}

bool ToolCodes::check_stop(CodeNumber number) {
  if (!macro_ || (number != code(2) && number != code(30))) return true;
  return fail("gcode.change-macro", words_.span(stopping), "the program would end in the middle of a tool change",
              "tool_change.macro without M2 and M30");
}

bool ToolCodes::begin_last_check() {
  const ToolChangePlan* const plan = block_.options.tool_change.get();
  const MeasuredTools& known = state_.measured;
  if (plan == nullptr || !plan->wear || known.tool == 0 || known.tool != state_.tool || cutter_.active()) return false;
  begin_cycle(state_.tool, true);
  return true;
}

// The cycle has moved the tool to where it ends; the length comes into force there, and moves nothing.
bool ToolCodes::finish() {
  const ToolChangeCycle& done = *cycle_;
  if (done.calls_macro()) {
    state_.measured = done.known();
    begin_macro();
    return calls_macro_ = true;
  }
  const bool by_macro = macro_.has_value();
  if (by_macro) end_macro();
  if (done.gave_up()) return fail_change(by_macro);
  const double work_shift = state_.measured.work_shift;
  state_.measured = done.known();
  state_.measured.work_shift = work_shift;
  if (state_.feed > 0 && !state_.modal.inverse_time()) emit_feed_rate(state_.feed);
  if (only_checks_) return true;
  load_tool(next_tool_);
  if (next_tool_ == 0) return true;
  if (done.is_measured()) {
    use_length(state_.measured.contact);
  } else {
    use_table_length();
  }
  return true;
}

// The cycle has switched the coolant off; the macro may use its outputs.
void ToolCodes::begin_macro() {
  MacroCall& call = macro_.emplace();
  call.back = cycle_->back();
  call.mist = std::exchange(state_.mist, false);
  call.flood = std::exchange(state_.flood, false);
  call.before = lines_.before();
}

void ToolCodes::end_macro() {
  state_.mist = macro_->mist;
  state_.flood = macro_->flood;
  macro_.reset();
}

void ToolCodes::examine_after_macro() {
  macro_->spindle_turns = state_.any_spindle_turns();
  const std::string fault = lines_.put_back(macro_->before, next_tool_);
  if (!fault.empty()) macro_->fault = "the macro of the tool change " + fault;
}

// Behind a macro, the block is its last one. Returns false.
bool ToolCodes::fail_change(bool by_macro) {
  const ToolChangeCycle& done = *cycle_;
  block_.ended = true;
  std::string_view code = "gcode.tool-not-measured";
  std::string message =
      fmt::format("tool {} was not measured in {} tries: {}", next_tool_, ToolChangeCycle::most_tries, done.reason());
  std::string expected = "a tool setter that works, and a tool that reaches it";
  if (done.has_macro_fault()) {
    code = "gcode.change-macro";
    message = done.reason();
    expected = "tool_change.macro that leaves offsets and tool as the program expects them";
  }
  if (!by_macro) return fail(code, words_.span(tool_change), std::move(message), std::move(expected));
  reporter_.error_at(code, block_.source.line, {}, {}, std::move(message), std::move(expected));
  return false;
}

void ToolCodes::use_length(double contact) {
  const ToolChangePlan& plan = *block_.options.tool_change;
  MeasuredTools& known = state_.measured;
  if (plan.use == LengthUse::work) {
    const double shift = contact - *known.reference;
    frame_.shift_work_z(shift - std::exchange(known.work_shift, shift));
    return;
  }
  Tool* entry = state_.tools.find(next_tool_);
  if (entry == nullptr && state_.tools.add({.number = next_tool_})) entry = state_.tools.find(next_tool_);
  state_.spindle_tool.offset[Axis::z] = contact - (plan.use == LengthUse::absolute ? plan.setter_z : *known.reference);
  if (entry != nullptr) {
    entry->offset = state_.spindle_tool.offset;
    state_.spindle_tool.place = entry->place;
    emit(operation::SetToolTableEntry{entry->place, entry});
  }
  use_table_length();
}

// As G43 does.
void ToolCodes::use_table_length() {
  if (block_.options.tool_change->use == LengthUse::work) return;
  state_.modal.set(tool_length, code(43));
  frame_.use_tool_offset(state_.spindle_tool.offset);
}

void ToolCodes::load_tool(std::int32_t number) {
  const Tool* const known = state_.tools.find(number);
  state_.spindle_tool = known != nullptr ? *known : Tool{.number = number};
  state_.tool = number;
  was_loaded_ = true;
}

bool ToolCodes::set_length(CodeNumber number) {
  Point offset;
  if (number == code(43, 1) || (number == code(43, 2) && !words_.has('H'))) {
    if (number == code(43, 2) && !words_.any_axis()) {
      return fail("gcode.missing-word", words_.span(tool_length), "G43.2 without H and without axis words",
                  "H, the tool whose offset is added, or the offset itself");
    }
    offset = state_.frame.tool_offset();
    const bool adds = number == code(43, 2);
    for (const Axis axis : all_axes) {
      if (words_.has(letter_of(axis))) offset[axis] = axis_word(axis) + (adds ? offset[axis] : 0);
    }
  } else if (number != code(49)) {
    if (number == code(43, 2) && words_.any_axis()) {
      return fail("gcode.unused-word", words_.span('H'), "G43.2 with H and with axis words",
                  "one of them: a tool's offset or the offset itself");
    }
    if (!tool_offset(offset)) return false;
    if (number == code(43, 2)) offset = offset + state_.frame.tool_offset();
  }
  state_.modal.set(tool_length, number);
  frame_.use_tool_offset(offset);
  return true;
}

// The offset of the tool H. Without H or with H0, the offset of the tool in the spindle.
bool ToolCodes::tool_offset(Point& offset) {
  std::int32_t number = 0;
  const Tool* tool = nullptr;
  if (words_.has('H') && !whole_word('H', 0, highest_tool, number)) return false;
  if (number == 0) {
    number = state_.tool;
    tool = &state_.spindle_tool;
  } else if (!find_tool(number, words_.span('H'), tool)) {
    return false;
  }
  if (tool != nullptr) offset = tool->offset;
  const ToolChangePlan* const plan = block_.options.tool_change.get();
  const bool may_lack_table = plan != nullptr;  // M6 measures
  const bool is_known = tool != nullptr || number == state_.tool;
  if (may_lack_table && plan->measures && plan->use != LengthUse::work && !is_known) {
    return fail("gcode.tool-not-measured", words_.span('H'),
                fmt::format("the length of tool {} is unknown: it has not been measured", number),
                fmt::format("T{} M6 first, or a tool table (--tools FILE)", number));
  }
  if (number != 0 && !may_lack_table && state_.tools.name.empty() && !std::exchange(missing_table_told_, true)) {
    reporter_.warning(
        "gcode.no-tool-table", words_.span(tool_length),
        state_.tools.find(number) == nullptr
            ? interpreter_says::offset_taken_as_zero.with({{"tool", std::to_string(number)}})
            : FindingWords(fmt::format("the offset of tool {} is that of an example: no tool table was given", number)),
        "--tools FILE, or G43.1 with the offset itself");
  }
  return true;
}

// G10 L0: LinuxCNC reads the tool table again. Only the program changes the table, and LinuxCNC would have written
// those changes to the file. So here the table stays as it is.
bool ToolCodes::reload_tools() {
  if (state_.tool != 0) {
    return fail("gcode.tool-loaded", words_.span('L'),
                fmt::format("the tool table cannot be reloaded while tool {} is in the spindle", state_.tool),
                "T0 M6 first");
  }
  for (const Word& word : reporter_.block().words) {
    if (word.letter == 'G' || word.letter == 'L' || !(LetterSet("PRIJQ") | axis_letters).has(word.letter)) continue;
    if (words_.is_of_another(word.letter, ModalGroup::non_modal)) continue;
    reporter_.warning("gcode.unused-word", word.span, fmt::format("{} has no effect together with G10 L0", word.letter),
                      "G10 L0 alone");
  }
  emit(operation::ReloadTools{});
  return true;
}

bool ToolCodes::check_tool_entry_words(Tool*& tool) {
  if (!words_.has('P')) {
    return fail("gcode.missing-word", words_.span(non_modal), "G10 without P", "P, the number of the tool to set");
  }
  std::int32_t number = 0;
  std::int32_t orientation = 0;
  const Tool* known = nullptr;
  if (!whole_word('P', 1, highest_tool, number) || !find_tool(number, words_.span('P'), known)) return false;
  if (known == nullptr) {
    return fail("gcode.unknown-tool", words_.span('P'),
                fmt::format("tool {} is unknown, because no tool table was given", number), "--tools FILE");
  }
  if (words_.has('Q') && !whole_word('Q', 0, highest_tool_orientation, orientation)) return false;
  const LetterSet what = words_.present() & (axis_letters | LetterSet("RIJQ"));
  if (!what.any()) {
    return fail("gcode.missing-word", words_.span(non_modal), "G10 without a value for the tool",
                "axis words, R (radius), I and J (angles) or Q (orientation)");
  }
  tool = state_.tools.find(number);
  return true;
}

// G10 L1 sets a tool's offset. L10 sets the offset with which this position is the given one once G43 is active. L11
// does the same as L10 in G59.3 and without a G92 offset.
bool ToolCodes::set_tool_table_entry() {
  Tool* tool = nullptr;
  if (!check_tool_entry_words(tool)) return false;
  set_tool_offsets(*tool);
  if (words_.has('R')) tool->diameter = Mm(2 * words_['R'] * state_.length_unit());
  if (words_.has('I')) tool->front_angle_deg = words_['I'];
  if (words_.has('J')) tool->back_angle_deg = words_['J'];
  if (words_.has('Q')) tool->orientation = static_cast<std::int32_t>(std::round(words_['Q']));
  emit(operation::SetToolTableEntry{tool->place, tool});
  // As in rs274, the first tool of the table counts as the tool in the spindle until a tool is loaded.
  const bool in_spindle = was_loaded_ ? tool->number == state_.tool : tool->place == 1;
  if (in_spindle) {
    state_.spindle_tool = *tool;
    state_.tool = tool->number;
    emit(operation::SetToolTableEntry{0, &state_.spindle_tool});
  }
  return true;
}

void ToolCodes::set_tool_offsets(Tool& tool) {
  if (words_['L'] == 1) {
    for (const Axis axis : all_axes) {
      if (words_.has(letter_of(axis))) tool.offset[axis] = axis_word(axis);
    }
    return;
  }
  Frame frame = state_.frame;
  if (words_['L'] == 11) {
    frame.follow({operation::SetWorkOffset{rotary_fixture, parameters_.point(work_offset_parameter(rotary_fixture))},
                  block_.source});
    frame.follow({operation::SetRotation{parameters_.get(rotation_parameter(rotary_fixture))}, block_.source});
    frame.follow({operation::SetG92Offset{}, block_.source});
  }
  // With the tool's present offset the tool is at `machine`. The new offset takes up the difference to `wanted`.
  frame.follow({operation::SetToolOffset{tool.offset}, block_.source});
  const Point machine = state_.machine_position();
  Point wanted = frame.work_from_machine(machine);
  bool any_of_plane = false;
  for (const Axis axis : all_axes) {
    if (!words_.has(letter_of(axis))) continue;
    wanted[axis] = axis_word(axis);
    any_of_plane |= axis == Axis::x || axis == Axis::y;
  }
  const Point moved = tool.offset + (machine - frame.machine_from_work(wanted));
  for (const Axis axis : all_axes) {
    const bool in_plane = axis == Axis::x || axis == Axis::y;
    if (words_.has(letter_of(axis)) || (in_plane && any_of_plane && frame.rotation_degrees() != 0)) {
      tool.offset[axis] = moved[axis];
    }
  }
}

// G10. L tells what it sets.
bool ToolCodes::set_table() {
  const double table = words_.has('L') ? words_['L'] : -1;
  if (table == 0) return reload_tools();
  if (table == 1 || table == 10 || table == 11) return set_tool_table_entry();
  if (table == 2 || table == 20) return frame_.set_work_offset();
  return fail("gcode.missing-word", words_.has('L') ? words_.span('L') : words_.span(non_modal),
              words_.has('L') ? fmt::format("there is no G10 L{}", plain_number(table)) : "G10 without L",
              "L0, L1, L2, L10, L11 or L20: G10 L2 P1 X… sets an offset, G10 L20 P1 X… makes this the given position, "
              "G10 L1 P1 Z… sets a tool");
}

}  // namespace passo
