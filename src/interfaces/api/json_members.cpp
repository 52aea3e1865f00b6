#include "json_members.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace passo {
namespace {

std::optional<Axis> axis_of(const std::string& name, const MachineDescription& machine) {
  for (const AxisDescription& axis : machine.axes) {
    if (name.size() == 1 && name[0] - 'a' + 'A' == letter_of(axis.axis)) return axis.axis;
  }
  return {};
}

}  // namespace

JsonMembers::JsonMembers(nlohmann::ordered_json object) : object_(std::move(object)) {
  if (!object_.is_object()) reason_ = "the body is not a JSON object";
}

std::optional<double> JsonMembers::number(const std::string& key) {
  const auto* const value = find(key);
  if (value == nullptr) return {};
  if (value->is_number() && std::isfinite(value->get<double>())) return value->get<double>();
  fail(key, "a number");
  return {};
}

std::optional<bool> JsonMembers::flag(const std::string& key) {
  const auto* const value = find(key);
  if (value == nullptr) return {};
  if (value->is_boolean()) return value->get<bool>();
  fail(key, "true or false");
  return {};
}

std::optional<Axis> JsonMembers::axis(const std::string& key, const MachineDescription& machine) {
  const auto* const value = find(key);
  if (value == nullptr) return {};
  const auto axis = value->is_string() ? axis_of(value->get<std::string>(), machine) : std::nullopt;
  if (!axis) fail(key, "an axis of the machine, e.g. \"x\"");
  return axis;
}

Point JsonMembers::place(const std::string& key, const MachineDescription& machine, const Point& start) {
  Point place = start;
  const auto* const value = find(key);
  if (value == nullptr || !value->is_object() || value->empty()) {
    fail(key, "an object with a number for each axis");
    return place;
  }
  for (const auto& [name, number] : value->items()) {
    const auto axis = axis_of(name, machine);
    if (!axis || !number.is_number() || !std::isfinite(number.get<double>())) {
      fail(key, "an object with a number for each axis");
      return place;
    }
    place[*axis] = number.get<double>();
  }
  return place;
}

void JsonMembers::fail(const std::string& key, const std::string& expected) {
  if (good()) reason_ = "\"" + key + "\": expected " + expected;
}

bool JsonMembers::end() {
  if (!good()) return false;
  for (const auto& [name, value] : object_.items()) {
    if (std::ranges::find(asked_, name) == asked_.end()) reason_ = "there is no \"" + name.substr(0, 40) + "\"";
  }
  return good();
}

const nlohmann::ordered_json* JsonMembers::find(const std::string& key) {
  asked_.push_back(key);
  if (!good()) return nullptr;
  const auto found = object_.find(key);
  return found == object_.end() || found->is_null() ? nullptr : &*found;
}

}  // namespace passo
