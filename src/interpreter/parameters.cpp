#include "parameters.hpp"

#include <algorithm>

#include "predefined.hpp"

namespace passo {
namespace {

constexpr int last_tool_parameter = 5413;
constexpr int last_position_parameter = position_parameter + static_cast<int>(axis_count) - 1;

}  // namespace

Parameters::Parameters(SymbolTable& symbols, const MachineState& state) : symbols_(symbols), state_(state) {
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
  } else {
    value = numbers_[static_cast<std::size_t>(number)];
  }
  return true;
}

bool Parameters::is_settable(std::int64_t number) {
  if (number < 1 || number > highest_parameter) return false;
  return !(number >= tool_parameter && number <= last_tool_parameter) &&
         !(number >= position_parameter && number <= last_position_parameter);
}

bool Parameters::named(Symbol name, double& value) const {
  if (name.id >= names_.size()) return false;
  const Named& named = names_[name.id];
  switch (named.kind) {
    case Named::Kind::predefined: value = predefined_parameters()[named.predefined].value(state_); return true;
    case Named::Kind::global: value = named.value; return named.depth >= 0;
    case Named::Kind::local: value = named.value; return named.depth == state_.call_depth;
    case Named::Kind::unseen: break;
  }
  return false;
}

bool Parameters::set_named(Symbol name, double value) {
  Named& named = at(name);
  if (named.kind == Named::Kind::predefined) return false;
  if (named.kind == Named::Kind::unseen) {
    named.kind = symbols_.name(name).starts_with('_') ? Named::Kind::global : Named::Kind::local;
  }
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
  std::copy_n(numbers_.begin() + first, axis_count, point.values.begin());
  return point;
}

void Parameters::set_point(int first, const Point& point) {
  std::ranges::copy(point.values, numbers_.begin() + first);
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
