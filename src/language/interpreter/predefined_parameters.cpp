#include "predefined_parameters.hpp"

#include <iterator>
#include <vector>

namespace passo {
namespace {

using State = ProgramState;

double truth(bool value) {
  return value ? 1 : 0;
}
template <Axis axis>
double work(const State& state) {
  return state.tool_position()[axis] / state.units_of(axis);
}
template <Axis axis>
double machine(const State& state) {
  return state.machine_position()[axis] / state.units_of(axis);
}
// As in LinuxCNC, a code is given as ten times its number.
template <ModalGroup group>
double active(const State& state) {
  return state.modal[group];
}
template <bool State::*flag>
double flag_of(const State& state) {
  return truth(state.*flag);
}
template <bool FeedPermissions::*flag>
double feed_flag_of(const State& state) {
  return truth(state.feed_permissions.*flag);
}
double current_feed(const State& state) {
  return state.feed / state.length_unit();
}
double call_level(const State& state) {
  return state.call_depth;
}
double current_line(const State& state) {
  return state.line;
}
double spindle_speed(const State& state) {
  return state.spindles[0].speed;
}
double spindle_on(const State& state) {
  return truth(state.spindles[0].direction != SpindleDirection::off);
}
double spindle_clockwise(const State& state) {
  return truth(state.spindles[0].direction == SpindleDirection::clockwise);
}
double speed_override(const State& state) {
  return truth(state.spindles[0].speed_override);
}
double current_tool(const State& state) {
  return state.tool;
}
double selected_tool(const State& state) {
  return state.selected_tool < 0 ? 0 : state.selected_tool;
}
double current_pocket(const State& state) {
  return state.spindle_tool.pocket;
}
double selected_pocket(const State& state) {
  const Tool* const tool = state.tools.find(state.selected_tool);
  return tool == nullptr ? -1 : tool->pocket;
}
double tool_offset_on(const State& state) {
  return truth(state.modal[ModalGroup::tool_length] != code(49));
}
// How deep remapped codes are nested. Passo has no remapped codes.
double remap_level(const State&) {
  return 0;
}
// The version of the language, LinuxCNC 2.9. Programs read it to find out what they may use.
double major_version(const State&) {
  return 2.9;
}
double minor_version(const State&) {
  return 0;
}

constexpr PredefinedParameter others[] = {
    {"_vmajor", major_version},
    {"_vminor", minor_version},
    {"_line", current_line},
    {"_call_level", call_level},
    {"_remap_level", remap_level},
    {"_task", flag_of<&State::on_machine>},
    {"_motion_mode", active<ModalGroup::motion>},
    {"_plane", active<ModalGroup::plane>},
    {"_ccomp", active<ModalGroup::cutter_compensation>},
    {"_coord_system", active<ModalGroup::work_system>},
    {"_tool_offset", tool_offset_on},
    {"_feed", current_feed},
    {"_rpm", spindle_speed},
    {"_spindle_on", spindle_on},
    {"_spindle_cw", spindle_clockwise},
    {"_mist", flag_of<&State::mist>},
    {"_flood", flag_of<&State::flood>},
    {"_feed_override", flag_of<&State::feed_override>},
    {"_speed_override", speed_override},
    {"_adaptive_feed", feed_flag_of<&FeedPermissions::adaptive>},
    {"_feed_hold", feed_flag_of<&FeedPermissions::hold>},
    {"_current_tool", current_tool},
    {"_selected_tool", selected_tool},
    {"_current_pocket", current_pocket},
    {"_selected_pocket", selected_pocket},
    {"_x", work<Axis::x>},
    {"_y", work<Axis::y>},
    {"_z", work<Axis::z>},
    {"_a", work<Axis::a>},
    {"_b", work<Axis::b>},
    {"_c", work<Axis::c>},
    {"_u", work<Axis::u>},
    {"_v", work<Axis::v>},
    {"_w", work<Axis::w>},
    {"_abs_x", machine<Axis::x>},
    {"_abs_y", machine<Axis::y>},
    {"_abs_z", machine<Axis::z>},
    {"_abs_a", machine<Axis::a>},
    {"_abs_b", machine<Axis::b>},
    {"_abs_c", machine<Axis::c>},
    {"_abs_u", machine<Axis::u>},
    {"_abs_v", machine<Axis::v>},
    {"_abs_w", machine<Axis::w>},
};

}  // namespace

// Those of the modes are in the rows of the codes.
std::span<const PredefinedParameter> predefined_parameters() {
  static const std::vector<PredefinedParameter> all = [] {
    std::vector<PredefinedParameter> parameters(std::begin(others), std::end(others));
    for (const CodeEntry& entry : code_entries()) {
      if (!entry.parameter.empty()) parameters.push_back({.name = entry.parameter, .mode = &entry});
    }
    return parameters;
  }();
  return all;
}

double PredefinedParameter::value(const ProgramState& state) const {
  return mode == nullptr ? of(state) : truth(state.modal[mode->group] == mode->number);
}

}  // namespace passo
