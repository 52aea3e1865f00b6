// From the body of a POST to a request of the session.
#include <algorithm>
#include <cmath>
#include <vector>

#include "api_json.hpp"

namespace passo {
namespace {

// Reads members of an object, and notes what is wrong.
class Members {
 public:
  Members(const Json& body, std::string& reason) : body_(body), reason_(reason) {
    if (!body.is_object()) reason_ = "the body is no JSON object";
  }
  bool good() const { return reason_.empty(); }

  std::optional<double> number(const std::string& key) {
    const Json* const value = find(key);
    if (value == nullptr) return {};
    if (value->is_number() && std::isfinite(value->get<double>())) return value->get<double>();
    fail(key, "a number");
    return {};
  }
  std::optional<bool> flag(const std::string& key) {
    const Json* const value = find(key);
    if (value == nullptr) return {};
    if (value->is_boolean()) return value->get<bool>();
    fail(key, "true or false");
    return {};
  }
  // Numbers for some of the machine's axes.
  Point place(const std::string& key, const MachineDescription& machine, const Point& start) {
    Point place = start;
    const Json* const value = find(key);
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
  // Call last.
  void end() {
    if (!good()) return;
    for (const auto& [name, value] : body_.items()) {
      if (std::ranges::find(asked_, name) == asked_.end()) reason_ = "there is no \"" + name.substr(0, 40) + "\"";
    }
  }
  void fail(const std::string& key, const std::string& expected) {
    if (good()) reason_ = "\"" + key + "\": expected " + expected;
  }

 private:
  const Json* find(const std::string& key) {
    asked_.push_back(key);
    if (!good()) return nullptr;
    const auto found = body_.find(key);
    return found == body_.end() || found->is_null() ? nullptr : &*found;
  }
  static std::optional<Axis> axis_of(const std::string& name, const MachineDescription& machine) {
    for (const AxisDescription& axis : machine.axes) {
      if (name.size() == 1 && name[0] - 'a' + 'A' == letter_of(axis.axis)) return axis.axis;
    }
    return {};
  }

  const Json& body_;
  std::string& reason_;
  std::vector<std::string> asked_;
};

request::Jog read_jog(Members& members, const MachineDescription& machine) {
  request::Jog jog;
  jog.way.direction = members.place("direction", machine, Point());
  jog.way.speed = MmPerSecond(members.number("speed").value_or(0) / a_minute);
  jog.way.distance = Mm(members.number("distance").value_or(0));
  jog.lease = Seconds(members.number("lease").value_or(jog.lease.value()));
  return jog;
}

}  // namespace

std::optional<Point> read_place(const Json& body, const MachineDescription& machine, const Point& start,
                                std::string& reason) {
  Members members(body, reason);
  const Point place = members.place("place", machine, start);
  members.end();
  return members.good() ? std::optional<Point>(place) : std::nullopt;
}

std::optional<bool> read_flag(const Json& body, const std::string& key, std::string& reason) {
  Members members(body, reason);
  const auto flag = members.flag(key);
  if (!flag) members.fail(key, "true or false");
  members.end();
  return members.good() ? flag : std::nullopt;
}

std::optional<Request> read_request(std::string_view path, const Json& body, const MachineDescription& machine,
                                    std::string& reason) {
  Members members(body, reason);
  std::optional<Request> request;
  if (path == "/api/v1/hold") request = request::Hold{.for_door = members.flag("door").value_or(false)};
  if (path == "/api/v1/resume") request = request::Resume{};
  if (path == "/api/v1/stop") request = request::Stop{};
  if (path == "/api/v1/home") request = request::Home{};
  if (path == "/api/v1/reset") request = request::ResetMachine{};
  if (path == "/api/v1/sleep") request = request::Sleep{};
  if (path == "/api/v1/wake") request = request::Wake{};
  if (path == "/api/v1/operator-done") request = request::OperatorDone{};
  if (path == "/api/v1/jog/renew") request = request::RenewLease{};
  if (path == "/api/v1/jog") request = read_jog(members, machine);
  if (path == "/api/v1/override") {
    request = request::Override{.feed = members.number("feed"),
                                .adaptive_feed = {},
                                .spindle = members.number("spindle"),
                                .rapids = members.number("rapids")};
  }
  if (path == "/api/v1/stops") {
    request = request::ChooseStops{.single_block = members.flag("single_block"),
                                   .optional_stop = members.flag("optional_stop")};
  }
  if (path == "/api/v1/outputs") {
    request = request::SwitchOutputs{
        .mist = members.flag("mist"), .flood = members.flag("flood"), .spindle_stands = members.flag("spindle_stands")};
  }
  if (path == "/api/v1/position") {
    request = request::SetPosition{{.place = members.place("place", machine, Point()), .trust = Trust::commanded}};
  }
  members.end();
  return members.good() ? std::move(request) : std::nullopt;
}

}  // namespace passo
