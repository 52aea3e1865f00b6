#include "parameters.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace passo {
namespace {

// Positions and offsets are told in the program's units.
double in_units(const ModalState& state, Axis axis, double value) {
  return is_rotary(axis) ? value : value / state.scale();
}

struct Predefined {
  std::string_view name;
  double (*value)(const ModalState&);
};

template <Axis axis>
double work_position(const ModalState& state) {
  return in_units(state, axis, state.work[axis]);
}

constexpr auto predefined_names = std::to_array<Predefined>({
    {"_x", work_position<Axis::x>},
    {"_y", work_position<Axis::y>},
    {"_z", work_position<Axis::z>},
    {"_a", work_position<Axis::a>},
    {"_b", work_position<Axis::b>},
    {"_c", work_position<Axis::c>},
    {"_u", work_position<Axis::u>},
    {"_v", work_position<Axis::v>},
    {"_w", work_position<Axis::w>},
    {"_motion_mode", [](const ModalState& s) { return static_cast<double>(s.motion.value_or(800)); }},
    {"_plane", [](const ModalState& s) { return 170.0 + 10 * static_cast<int>(s.plane); }},
    {"_coord_system",
     [](const ModalState& s) {
       return s.work_system < 6 ? 540.0 + 10 * static_cast<double>(s.work_system)
                                : 591.0 + static_cast<double>(s.work_system - 6);
     }},
    {"_incremental", [](const ModalState& s) { return s.incremental ? 1.0 : 0.0; }},
    {"_absolute", [](const ModalState& s) { return s.incremental ? 0.0 : 1.0; }},
    {"_imperial", [](const ModalState& s) { return s.units == LengthUnits::inch ? 1.0 : 0.0; }},
    {"_metric", [](const ModalState& s) { return s.units == LengthUnits::mm ? 1.0 : 0.0; }},
    {"_inverse_time", [](const ModalState& s) { return s.feed_mode == FeedMode::inverse_time ? 1.0 : 0.0; }},
    {"_units_per_minute", [](const ModalState& s) { return s.feed_mode == FeedMode::units_per_minute ? 1.0 : 0.0; }},
    {"_units_per_rev", [](const ModalState& s) { return s.feed_mode == FeedMode::units_per_revolution ? 1.0 : 0.0; }},
    {"_feed", [](const ModalState& s) { return s.feed_rate * seconds_per_minute / s.scale(); }},
    {"_rpm", [](const ModalState& s) { return s.spindle_speed; }},
    {"_spindle_on", [](const ModalState& s) { return s.spindle != SpindleDirection::off ? 1.0 : 0.0; }},
    {"_spindle_cw", [](const ModalState& s) { return s.spindle == SpindleDirection::clockwise ? 1.0 : 0.0; }},
    {"_current_tool", [](const ModalState& s) { return static_cast<double>(s.tool); }},
    {"_selected_tool", [](const ModalState& s) { return static_cast<double>(s.selected_tool); }},
    {"_ijk_absolute_mode", [](const ModalState& s) { return s.arc_centers_absolute ? 1.0 : 0.0; }},
    {"_vmajor", [](const ModalState&) { return 2.9; }},
});

}  // namespace

Parameters::Parameters(const ModalState& state, const SymbolTable& symbols)
    : state_(state), symbols_(symbols), numbers_(highest + 1), scopes_(1) {}

bool Parameters::is_global(Symbol name) const {
  return symbols_.name(name).starts_with('_');
}

bool Parameters::predefined(Symbol name, double& value) const {
  const auto* found = std::ranges::find(predefined_names, symbols_.name(name), &Predefined::name);
  if (found == predefined_names.end()) return false;
  value = found->value(state_);
  return true;
}

// The numbers that RS274/NGC keeps positions and offsets in.
bool Parameters::of_state(std::int64_t number, double& value) const {
  constexpr std::int64_t axes = 9;
  const auto axis_value = [&](std::int64_t first, const Point& point) {
    const Axis axis = all_axes[static_cast<std::size_t>(number - first)];
    value = in_units(state_, axis, point[axis]);
    return true;
  };
  if (number >= 5161 && number < 5161 + axes) return axis_value(5161, state_.homes[0]);
  if (number >= 5181 && number < 5181 + axes) return axis_value(5181, state_.homes[1]);
  if (number == 5210) return value = state_.g92_active ? 1 : 0, true;
  if (number >= 5211 && number < 5211 + axes) return axis_value(5211, state_.g92_offset);
  if (number == 5220) return value = static_cast<double>(state_.work_system + 1), true;
  if (number >= 5221 && number < 5221 + 20 * static_cast<std::int64_t>(work_offset_count)) {
    const auto system = static_cast<std::size_t>((number - 5221) / 20);
    const std::int64_t index = (number - 5221) % 20;
    if (index < axes) return axis_value(number - index, state_.work_offsets[system]);
    if (index == axes) return value = state_.rotations[system], true;
  }
  if (number == 5400) return value = state_.tool, true;
  if (number >= 5401 && number < 5401 + axes) return axis_value(5401, state_.tool_offset);
  if (number >= 5420 && number < 5420 + axes) return axis_value(5420, state_.work);
  return false;
}

bool Parameters::numbered(std::int64_t number, double& value) const {
  if (number < 1 || number > highest) return false;
  if (number <= static_cast<std::int64_t>(locals)) {
    value = scopes_.back().numbers[static_cast<std::size_t>(number - 1)];
    return true;
  }
  if (number >= 5161 && of_state(number, value)) return true;
  value = numbers_[static_cast<std::size_t>(number)];
  return true;
}

bool Parameters::named(Symbol name, double& value) const {
  if (!is_global(name)) {
    for (const auto& [known, known_value] : scopes_.back().names) {
      if (known != name) continue;
      value = known_value;
      return true;
    }
    return false;
  }
  if (name.id < globals_.size() && globals_[name.id].first) {
    value = globals_[name.id].second;
    return true;
  }
  return predefined(name, value);
}

Parameters::Setting Parameters::set_numbered(std::int64_t number, double value) {
  if (number < 1 || number > highest) return Setting::out_of_range;
  double told = 0;
  if (number >= 5161 && of_state(number, told)) return Setting::read_only;
  if (number <= static_cast<std::int64_t>(locals)) {
    scopes_.back().numbers[static_cast<std::size_t>(number - 1)] = value;
  } else {
    numbers_[static_cast<std::size_t>(number)] = value;
  }
  return Setting::done;
}

Parameters::Setting Parameters::set_named(Symbol name, double value) {
  if (is_global(name)) {
    double told = 0;
    if (predefined(name, told)) return Setting::read_only;
    if (globals_.size() <= name.id) globals_.resize(name.id + 1);
    globals_[name.id] = {true, value};
    return Setting::done;
  }
  for (auto& [known, known_value] : scopes_.back().names) {
    if (known != name) continue;
    known_value = value;
    return Setting::done;
  }
  scopes_.back().names.emplace_back(name, value);
  return Setting::done;
}

void Parameters::enter(const std::vector<double>& arguments) {
  Scope scope;
  std::copy_n(arguments.begin(), std::min(arguments.size(), locals), scope.numbers.begin());
  scopes_.push_back(std::move(scope));
}

void Parameters::leave() {
  scopes_.pop_back();
}

}  // namespace passo
