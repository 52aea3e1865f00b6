#include "passo/sender/grbl_reply.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace passo {
namespace {

std::optional<std::size_t> read_count(std::string_view text) {
  const auto value = read_grbl_number(text);
  if (!value || *value < 0 || *value > 1e6) return {};
  return static_cast<std::size_t>(*value);
}

// "120,100,90"
std::optional<GrblOverrides> read_overrides(std::string_view text) {
  const auto feed = read_count(next_grbl_field(text, ','));
  const auto rapids = read_count(next_grbl_field(text, ','));
  const auto spindle = read_count(next_grbl_field(text, ','));
  if (!feed || !rapids || !spindle) return {};
  return GrblOverrides{
      .feed = static_cast<int>(*feed), .rapids = static_cast<int>(*rapids), .spindle = static_cast<int>(*spindle)};
}

void read_field(std::string_view name, std::string_view value, std::string_view axes, GrblReport& report) {
  if (name == "MPos") report.machine_place = read_grbl_place(value, axes);
  if (name == "WPos") report.work_place = read_grbl_place(value, axes);
  if (name == "MPos" || name == "WPos") report.values = 1 + static_cast<std::size_t>(std::ranges::count(value, ','));
  if (name == "WCO") report.work_offset = read_grbl_place(value, axes);
  if (name == "F" || name == "FS") report.feed = read_grbl_number(next_grbl_field(value, ','));
  if (name == "FS") report.speed = read_grbl_number(next_grbl_field(value, ','));
  if (name == "Pn") report.pins = value;
  if (name == "A") report.outputs = value;
  if (name == "SD") {
    // "12.5,part.nc"; "Pending" after its end.
    const auto percent = read_grbl_number(next_grbl_field(value, ','));
    if (percent) report.file_share = std::clamp(*percent / 100, 0.0, 1.0);
  }
  if (name == "Ov") {
    report.overrides = read_overrides(value);
    // Without a field for outputs all are off.
    if (!report.outputs) report.outputs.emplace();
  }
  if (name != "Bf") return;
  report.blocks_free = read_count(next_grbl_field(value, ','));
  report.bytes_free = read_count(value);
}

}  // namespace

bool GrblReport::rests() const {
  if (state == "Hold") return detail == 0;
  if (state == "Door") return detail == 0 || detail == 1;  // 2 and 3: it parks, or returns
  return state == "Idle" || state == "Alarm" || state == "Sleep" || state == "Check" || state == "Tool";
}

std::optional<double> read_grbl_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::string_view next_grbl_field(std::string_view& text, char mark) {
  const std::size_t at = text.find(mark);
  const std::string_view part = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view() : text.substr(at + 1);
  return part;
}

std::optional<Point> read_grbl_place(std::string_view text, std::string_view axes) {
  Point place;
  AxisSet read;
  if (text.empty()) return {};
  for (const char letter : axes) {
    if (text.empty()) break;
    const auto value = read_grbl_number(next_grbl_field(text, ','));
    if (!value) return {};
    const auto axis = axis_of(letter);
    if (!axis || read.has(*axis)) continue;
    read.add(*axis);
    place[*axis] = *value;
  }
  return place;
}

std::optional<GrblReport> read_grbl_report(std::string_view line, std::string_view axes) {
  if (line.size() < 3 || line.front() != '<' || line.back() != '>' || is_report_of_old_grbl(line)) return {};
  line = line.substr(1, line.size() - 2);
  GrblReport report;
  std::string_view state = next_grbl_field(line, '|');
  report.state = next_grbl_field(state, ':');
  if (report.state.empty()) return {};
  if (const auto detail = read_count(state)) report.detail = static_cast<int>(*detail);
  while (!line.empty()) {
    std::string_view field = next_grbl_field(line, '|');
    const std::string_view name = next_grbl_field(field, ':');
    read_field(name, field, axes, report);
  }
  return report;
}

bool is_report_of_old_grbl(std::string_view line) {
  if (!line.starts_with('<') || !line.ends_with('>')) return false;
  return line.find(',') < line.find_first_of("|:");
}

}  // namespace passo
