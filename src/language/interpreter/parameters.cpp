#include "parameters.hpp"

#include <algorithm>

#include "predefined_parameters.hpp"

namespace passo {
namespace {

constexpr int last_position_parameter = position_parameter + static_cast<int>(axis_count) - 1;

bool is_used_offset(std::int64_t number) {
  return number >= used_offset_parameter && number < used_offset_parameter + static_cast<int>(axis_count);
}

}  // namespace

Parameters::Parameters(SymbolTable& symbols, const ProgramState& state, LengthUnits machine_units,
                       std::shared_ptr<const SettingsFile> settings)
    : symbols_(symbols),
      state_(state),
      machine_unit_(machine_units == LengthUnits::inch ? mm_per_inch : 1),
      settings_(std::move(settings)) {
  const std::span<const PredefinedParameter> all = predefined_parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    Named& named = at(symbols_.intern(all[i].name));
    named.kind = Named::Kind::predefined;
    named.predefined = static_cast<std::uint8_t>(i);
  }
  set(work_system_parameter, 1);
  set(show_debug_parameter, 1);
}

bool Parameters::numbered(std::int64_t number, double& value) const {
  if (number < 1 || number > highest_parameter) return false;
  if (number >= position_parameter && number <= last_position_parameter) {
    const Axis axis = all_axes[static_cast<std::size_t>(number - position_parameter)];
    value = state_.tool_position()[axis] / state_.units_of(axis);
  } else if (is_machine_position(number)) {
    const Axis axis = all_axes[static_cast<std::size_t>(number - machine_position_parameter)];
    value = state_.machine_position()[axis] / state_.units_of(axis);
  } else if (is_used_offset(number)) {
    const Axis axis = all_axes[static_cast<std::size_t>(number - used_offset_parameter)];
    value = state_.frame.tool_offset()[axis] / unit_of(axis);
  } else if (number >= tool_parameter && number <= last_tool_parameter) {
    value = of_tool(static_cast<int>(number));
  } else {
    value = numbers_[static_cast<std::size_t>(number)];
  }
  return true;
}

// The parameters that describe the tool in the spindle.
double Parameters::of_tool(int number) const {
  const Tool& tool = state_.spindle_tool;
  if (number == tool_parameter) return state_.tool;
  if (number < tool_shape_parameter) {
    const Axis axis = all_axes[static_cast<std::size_t>(number - tool_offset_parameter)];
    return tool.offset[axis] / unit_of(axis);
  }
  switch (number - tool_shape_parameter) {
    case 0: return tool.diameter.value() / machine_unit_;
    case 1: return tool.front_angle_deg;
    case 2: return tool.back_angle_deg;
    default: return tool.orientation;
  }
}

void Parameters::load(const SavedParameters& saved) {
  for (const auto& [number, value] : saved) {
    if (is_settable(number) && !forgets(number)) set(number, value);
  }
}

void Parameters::save(SavedParameters& saved) const {
  for (int number = 1; number <= highest_parameter; ++number) {
    if (is_always_saved(number) || saved.contains(number)) saved[number] = forgets(number) ? 0 : get(number);
  }
}

// With [RS274NGC]DISABLE_G92_PERSISTENCE, the offset of G92 and G52 does not outlive the run.
bool Parameters::forgets(int number) const {
  const bool of_g92 = number >= g92_active_parameter && number < g92_parameter + static_cast<int>(axis_count);
  return of_g92 && settings_ && settings_->is_on("RS274NGC", "DISABLE_G92_PERSISTENCE");
}

bool Parameters::is_settable(std::int64_t number) {
  if (number < 1 || number > highest_parameter) return false;
  return !(number >= tool_parameter && number <= last_tool_parameter) && !is_used_offset(number) &&
         !(number >= position_parameter && number <= last_position_parameter);
}

bool Parameters::named(Symbol name, double& value) const {
  const Named named = name.id < names_.size() ? names_[name.id] : Named{};
  switch (named.kind) {
    case Named::Kind::predefined: value = predefined_parameters()[named.predefined].value(state_); return true;
    case Named::Kind::global: value = named.value; return named.depth >= 0;
    case Named::Kind::local: value = named.value; return named.depth == state_.call_depth;
    case Named::Kind::unseen: break;
  }
  const std::optional<double> setting = settings_ ? settings_->parameter(symbols_.name(name)) : std::nullopt;
  value = setting.value_or(0);
  return setting.has_value();
}

bool Parameters::set_named(Symbol name, double value) {
  Named& named = at(name);
  if (named.kind == Named::Kind::predefined) return false;
  if (named.kind == Named::Kind::unseen) {
    if (symbols_.name(name).starts_with("_ini[") || symbols_.name(name).starts_with("_hal[")) return false;
    named.kind = symbols_.name(name).starts_with('_') ? Named::Kind::global : Named::Kind::local;
  }
  if (keeps_) kept_names_.emplace_back(name, named);
  const std::int32_t depth = named.kind == Named::Kind::local ? state_.call_depth : 0;
  if (named.depth != depth) {
    if (depth > 0) undo_.push_back({name.id, named.depth, named.value});
    named.depth = depth;
  }
  named.value = value;
  return true;
}

Point Parameters::point(int first) const {
  Point point;
  for (const Axis axis : all_axes) point[axis] = get(first + static_cast<int>(index_of(axis))) * unit_of(axis);
  return point;
}

void Parameters::set_point(int first, const Point& point) {
  for (const Axis axis : all_axes) set(first + static_cast<int>(index_of(axis)), point[axis] / unit_of(axis));
}

void Parameters::keep() {
  keeps_ = true;
  kept_numbers_.clear();
  kept_names_.clear();
}

void Parameters::roll_back() {
  for (; !kept_numbers_.empty(); kept_numbers_.pop_back()) {
    numbers_[static_cast<std::size_t>(kept_numbers_.back().first)] = kept_numbers_.back().second;
  }
  for (; !kept_names_.empty(); kept_names_.pop_back()) at(kept_names_.back().first) = kept_names_.back().second;
}

void Parameters::enter_sub(std::span<const double> arguments) {
  Caller& caller = callers_.emplace_back();
  std::copy_n(numbers_.begin() + 1, sub_parameters, caller.numbers.begin());
  caller.undo_size = undo_.size();
  caller.shares_numbers = false;
  std::fill_n(numbers_.begin() + 1, sub_parameters, 0.0);
  std::copy_n(arguments.begin(), std::min(arguments.size(), sub_parameters), numbers_.begin() + 1);
}

void Parameters::enter_subprogram() {
  Caller& caller = callers_.emplace_back();
  caller.undo_size = undo_.size();
  caller.shares_numbers = true;
}

void Parameters::leave_sub() {
  const Caller& caller = callers_.back();
  if (!caller.shares_numbers) std::ranges::copy(caller.numbers, numbers_.begin() + 1);
  for (; undo_.size() > caller.undo_size; undo_.pop_back()) {
    names_[undo_.back().symbol].depth = undo_.back().depth;
    names_[undo_.back().symbol].value = undo_.back().value;
  }
  callers_.pop_back();
}

Parameters::Named& Parameters::at(Symbol name) {
  if (name.id >= names_.size()) names_.resize(std::max<std::size_t>(symbols_.size(), name.id + std::size_t{1}));
  return names_[name.id];
}

}  // namespace passo
