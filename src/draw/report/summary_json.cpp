#include <nlohmann/json.hpp>

#include "passo/report/summary.hpp"

namespace passo {
namespace {

// Keeps the order in which keys are written.
using Json = nlohmann::ordered_json;

std::string key(const AxisSummary& axis) {
  return {letter_of(axis.axis)};
}

template <class Value>
Json of_axes(const RunSummary& summary, const Value& value) {
  Json json = Json::object();
  for (const AxisSummary& axis : summary.axes) json[key(axis)] = value(axis);
  return json;
}

Json range(const std::optional<Range>& extents) {
  if (!extents) return nullptr;
  return {{"min", extents->low}, {"max", extents->high}};
}

void add_motion(const RunSummary& summary, Json& json) {
  json["time_s"] = summary.time().value();
  json["time"] = {{"cutting_s", summary.cutting_time.value()},
                  {"rapid_s", summary.rapid_time.value()},
                  {"dwell_s", summary.dwell_time.value()}};
  json["distance_mm"] = {{"cutting", summary.cutting_distance.value()}, {"rapid", summary.rapid_distance.value()}};
  if (summary.cutting_turn + summary.rapid_turn > 0) {
    json["turning_deg"] = {{"cutting", summary.cutting_turn}, {"rapid", summary.rapid_turn}};
  }
  json["counts"] = {
      {"moves", summary.moves}, {"rapids", summary.rapids}, {"arcs", summary.arcs}, {"dwells", summary.dwells}};
  json["extents_mm"] = {
      {"machine", of_axes(summary, [](const AxisSummary& axis) { return range(axis.machine_extents); })},
      {"work", of_axes(summary, [](const AxisSummary& axis) { return range(axis.work_extents); })},
      {"cutting", of_axes(summary, [](const AxisSummary& axis) { return range(axis.cutting_extents); })}};
  json["peak_speed_mm_s"] = of_axes(summary, [](const AxisSummary& axis) { return axis.peak_speed.value(); });
  json["peak_acceleration_mm_s2"] =
      of_axes(summary, [](const AxisSummary& axis) { return axis.peak_acceleration.value(); });
}

Json ranges(const RunSummary& summary, const std::vector<std::optional<Range>>& extents) {
  Json json = Json::object();
  for (std::size_t i = 0; i < extents.size(); ++i) json[key(summary.axes[i])] = range(extents[i]);
  return json;
}

Json feeds(const std::optional<Range>& feed) {
  if (!feed) return nullptr;
  return {{"min", feed->low * seconds_per_minute}, {"max", feed->high * seconds_per_minute}};
}

void add_program(const RunSummary& summary, Json& json) {
  json["units"] = summary.units == LengthUnits::inch ? "inch" : "mm";
  for (const WorkSummary& work : summary.work) {
    json["work_offsets"][name_of_system(work.system)] = {{"extents_mm", ranges(summary, work.extents)},
                                                         {"cutting_mm", ranges(summary, work.cutting)}};
  }
  for (const ToolSummary& tool : summary.tools) {
    json["tools"].push_back({{"tool", tool.tool},
                             {"cutting_s", tool.cutting_time.value()},
                             {"rapid_s", tool.rapid_time.value()},
                             {"cutting_mm", tool.cutting_distance.value()},
                             {"feed_mm_min", feeds(tool.feed)},
                             {"depth_mm", tool.depth ? Json(*tool.depth) : Json()}});
    if (!tool.turn_feed) continue;
    json["tools"].back()["cutting_deg"] = tool.cutting_turn;
    json["tools"].back()["feed_deg_min"] = feeds(tool.turn_feed);
  }
  for (const ProgramMessage& message : summary.messages) {
    json["messages"].push_back(
        {{"line", message.line}, {"kind", message.print ? "print" : "message"}, {"text", message.text}});
  }
}

void add_board(const RunSummary& summary, const BoardSummary& board, Json& json) {
  json["steps"] = of_axes(summary, [](const AxisSummary& axis) {
    return Json{{"net", axis.net_steps.count}, {"total", axis.total_steps.count}};
  });
  json["position_mm"] = of_axes(summary, [](const AxisSummary& axis) { return axis.position; });
  json["pulses"] = board.pulses;
  json["board"] = {{"end_s", board.end.value()},
                   {"events", board.events},
                   {"frames", board.frames},
                   {"bytes", board.bytes},
                   {"bytes_in_busiest_second", board.busiest_second}};
  if (board.held_items > 0) {
    json["board"]["held_items"] = board.held_items;
    json["board"]["rests"] = board.rests;
    json["board"]["stood_still"] = board.stood_still;
    if (board.stood_still) json["board"]["stood_still_line"] = board.stood_still_line;
  }
  if (board.without_line) {
    json["board"]["cost_of_line_s"] = board.cost_of_line().value();
    json["board"]["cost_of_line_share"] = board.cost_of_line() / *board.without_line;
  }
}

Json places(const RunSummary& summary, const std::vector<double>& values) {
  Json json = Json::object();
  for (std::size_t i = 0; i < values.size(); ++i) json[key(summary.axes[i])] = values[i];
  return json;
}

void add_probes(const RunSummary& summary, const ProbeSummary& probes, Json& json) {
  json["probes"] = {{"moves", probes.moves},
                    {"touched", probes.touched},
                    {"last_touched", probes.last_touched},
                    {"last_contact_mm", places(summary, probes.last_contact)},
                    {"last_rest_mm", places(summary, probes.last_rest)},
                    {"farthest_overrun_mm", probes.farthest_overrun.value()}};
}

void add_tails(const RunSummary& summary, Json& json) {
  for (const StopRampSummary& tail : summary.tails) {
    json["tails"].push_back({{"rest_s", tail.rest.value()},
                             {"position_mm", places(summary, tail.place)},
                             {"resumed_s", tail.resumed.value()}});
  }
}

void add_holds(const RunSummary& summary, Json& json) {
  for (const HoldSummary& hold : summary.holds) {
    json["holds"].push_back({{"asked_s", hold.asked.value()},
                             {"reaction_s", hold.reaction.value()},
                             {"rest_s", hold.rest.value()},
                             {"position_mm", places(summary, hold.place)},
                             {"resumed_s", hold.resumed ? Json(hold.resumed->value()) : Json()}});
  }
}

void add_physics(const PhysicsSummary& physics, Json& json) {
  const auto letter = [](Axis axis) { return std::string(1, letter_of(axis)); };
  Json& out = json["physics"];
  for (const PhysicsSummary::Motor& motor : physics.motors) {
    out["motors"].push_back({{"axis", letter(motor.axis)},
                             {"lost_steps", motor.lost_steps},
                             {"lost_mm", motor.lost},
                             {"following_error_mm", motor.following_error},
                             {"margin", motor.least_margin},
                             {"at_s", motor.least_margin_at.value()},
                             {"line", motor.line},
                             {"position_mm", motor.position}});
  }
  out["losses"] = Json::array();
  for (const PhysicsSummary::Loss& loss : physics.losses) {
    out["losses"].push_back(
        {{"time_s", loss.time.value()}, {"axis", letter(loss.axis)}, {"steps", loss.steps}, {"line", loss.line}});
  }
}

void add_port(const PortSummary& port, Json& json) {
  const auto letter = [](Axis axis) { return std::string(1, letter_of(axis)); };
  Json& out = json["port"];
  for (const PortSummary::Motor& motor : port.motors) {
    out["motors"].push_back({{"axis", letter(motor.axis)},
                             {"commanded_steps", motor.commanded},
                             {"sampled_steps", motor.sampled},
                             {"commanded_net", motor.commanded_net},
                             {"sampled_net", motor.sampled_net},
                             {"true_net", motor.true_net},
                             {"true_position_mm", motor.true_end}});
  }
  out["register_writes"] = port.register_writes;
  out["relay_closings"] = port.relay_closings;
  out["relay_is_closed"] = port.relay_is_closed;
  out["lost_pulses"] = port.lost_pulses();
  out["lost"] = Json::array();
  for (const PortSummary::LostPulse& lost : port.lost) {
    out["lost"].push_back({{"time_s", lost.time.value()}, {"axis", letter(lost.axis)}, {"line", lost.line}});
  }
}

}  // namespace

std::string to_json(const RunSummary& summary) {
  Json json;
  json["program"] = summary.program;
  json["machine"] = summary.machine;
  add_motion(summary, json);
  add_program(summary, json);
  if (summary.board) add_board(summary, *summary.board, json);
  add_holds(summary, json);
  if (summary.probes) add_probes(summary, *summary.probes, json);
  add_tails(summary, json);
  if (summary.physics) add_physics(*summary.physics, json);
  if (summary.board && summary.board->port) add_port(*summary.board->port, json);
  // The name of a program may not be UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace passo
