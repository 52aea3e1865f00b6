#include "passo/sender/grbl_reply.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

namespace passo {
namespace {

template <class Number>
std::optional<Number> read_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

// Takes what comes before the next `mark`.
std::string_view take_part(std::string_view& text, char mark) {
  const std::size_t at = text.find(mark);
  const std::string_view part = text.substr(0, at);
  text = at == std::string_view::npos ? std::string_view() : text.substr(at + 1);
  return part;
}

void read_field(std::string_view name, std::string_view value, GrblReport& report) {
  if (name == "MPos") report.machine_place = read_grbl_place(value);
  if (name == "WPos") report.work_place = read_grbl_place(value);
  if (name == "WCO") report.work_offset = read_grbl_place(value);
  if (name == "Pn") report.pins = value;
  if (name != "Bf") return;
  report.blocks_free = read_number<std::size_t>(take_part(value, ','));
  report.bytes_free = read_number<std::size_t>(value);
}

struct Meaning {
  int number;
  std::string_view words;
};

constexpr std::array errors = {
    Meaning{1, "a word has no letter"},
    Meaning{2, "a number is not readable"},
    Meaning{3, "the '$' line is not known"},
    Meaning{4, "a value is negative"},
    Meaning{5, "homing is not enabled ($22)"},
    Meaning{6, "the step pulse is too short"},
    Meaning{7, "its settings were not readable, and were reset"},
    Meaning{8, "it is not idle"},
    Meaning{9, "it is locked by an alarm"},
    Meaning{10, "soft limits need homing"},
    Meaning{11, "the line is too long"},
    Meaning{12, "the step rate would be too high"},
    Meaning{13, "its safety door is open"},
    Meaning{14, "the line is too long to be stored"},
    Meaning{15, "the jog would leave the travel"},
    Meaning{16, "the jog is wrong"},
    Meaning{17, "laser mode needs a PWM output"},
    Meaning{20, "it does not know a code of the line"},
    Meaning{21, "two codes of one group"},
    Meaning{22, "no feed rate is set"},
    Meaning{23, "a code needs a whole number"},
    Meaning{24, "two codes need the axis words"},
    Meaning{25, "a word is there twice"},
    Meaning{26, "axis words are missing"},
    Meaning{27, "the line number is out of range"},
    Meaning{28, "a value is missing"},
    Meaning{29, "there is no such work system"},
    Meaning{30, "G53 needs G0 or G1"},
    Meaning{31, "axis words that nothing needs"},
    Meaning{32, "an arc has no axis word of its plane"},
    Meaning{33, "the end of the motion is wrong"},
    Meaning{34, "the radius of an arc is wrong"},
    Meaning{35, "an arc has no centre"},
    Meaning{36, "words that nothing needs"},
    Meaning{37, "G43.1 is for the Z axis"},
    Meaning{38, "the tool number is too large"},
};

constexpr std::array alarms = {
    Meaning{1, "a limit switch has closed; the place is lost"},
    Meaning{2, "the motion would have left its travel (soft limit); the place is kept"},
    Meaning{3, "it was reset while it moved; the place is lost"},
    Meaning{4, "the probe was not in its initial state"},
    Meaning{5, "the probe has touched nothing"},
    Meaning{6, "homing was reset"},
    Meaning{7, "the door was opened while it homed"},
    Meaning{8, "homing did not get off a switch"},
    Meaning{9, "homing found no switch"},
    Meaning{10, "homing found no second switch"},
};

std::string_view meaning_of(std::span<const Meaning> meanings, int number, std::string_view otherwise) {
  const auto found = std::ranges::find(meanings, number, &Meaning::number);
  return found == meanings.end() ? otherwise : found->words;
}

}  // namespace

std::optional<Point> read_grbl_place(std::string_view text) {
  Point place;
  std::size_t count = 0;
  while (!text.empty() && count < axis_count) {
    const auto value = read_number<double>(take_part(text, ','));
    if (!value) return {};
    place.values[count++] = *value;
  }
  if (count == 0) return {};
  return place;
}

std::optional<GrblReport> read_grbl_report(std::string_view line) {
  if (line.size() < 3 || line.front() != '<' || line.back() != '>') return {};
  line = line.substr(1, line.size() - 2);
  GrblReport report;
  std::string_view state = take_part(line, '|');
  report.state = take_part(state, ':');
  if (report.state.empty()) return {};
  report.detail = read_number<int>(state).value_or(-1);
  while (!line.empty()) {
    std::string_view field = take_part(line, '|');
    const std::string_view name = take_part(field, ':');
    read_field(name, field, report);
  }
  return report;
}

std::string_view words_of_grbl_error(int number) {
  return meaning_of(errors, number, "an error that is not of Grbl 1.1");
}

std::string_view words_of_grbl_alarm(int number) {
  return meaning_of(alarms, number, "an alarm that is not of Grbl 1.1");
}

}  // namespace passo
