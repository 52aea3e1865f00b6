#include "passo/cam/program_text.hpp"

#include <algorithm>

namespace passo {

void ProgramText::begin_modes() {
  if (units_ == ProgramUnits::cm) {
    line("(all lengths are centimetres: for a machine that counts in centimetres)");
    line("G17 G40 G80 G90 G94");
  } else {
    line("G17 {} G40 G80 G90 G94", units_ == ProgramUnits::mm ? "G21" : "G20");
  }
}

std::string ProgramText::number(Nanometres length) const {
  const double mm = to_mm(length).value();
  const double value = units_ == ProgramUnits::mm ? mm : units_ == ProgramUnits::cm ? mm / 10 : mm / mm_per_inch;
  std::string digits = fmt::format("{:.{}f}", value, units_ == ProgramUnits::mm ? 4 : 5);
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return digits == "-0" ? "0" : digits;
}

void ProgramText::begin_tool(const ToolChange& change) {
  const std::string height = number(change.change.height);
  if (change.number == 1 || !change.is_only) line("G0 Z{}", height);
  if (!change.is_only) {
    stop_coolant();
    if (change.number > 1 && change.spindle) line("M5");
    if (change.park) line("G0 {}", place(*change.park));
    line("(MSG, tool {}: {})", change.number, in_comment(change.words));
    line("T{} M6", change.number);
    line("G0 Z{}", height);
  }
  if (change.spindle) {
    line("M3 S{}", *change.spindle);
    const double seconds = change.change.spindle_seconds;
    if (seconds > 0) line("G4 P{:g} (the spindle reaches its speed)", seconds);
  }
  if (!change.change.coolant.empty()) line("{}", change.change.coolant);
  has_coolant_ = !change.change.coolant.empty();
}

void ProgramText::stop_coolant() {
  if (has_coolant_) line("M9");
  has_coolant_ = false;
}

void ProgramText::end(bool has_spindle, std::optional<DrawnPoint> park, std::optional<Nanometres> height) {
  if (height) line("G0 Z{}", number(*height));
  stop_coolant();
  if (has_spindle) line("M5");
  if (park) line("G0 {}", place(*park));
  line("M2");
}

std::string in_comment(std::string_view text) {
  std::string words(text);
  const auto breaks = [](char c) { return c == '(' || c == ')' || c == '%' || static_cast<unsigned char>(c) < ' '; };
  std::ranges::replace_if(words, breaks, '_');
  constexpr std::size_t longest = 120;
  if (words.size() > longest) words = "..." + words.substr(words.size() - longest);
  return words;
}

}  // namespace passo
