#include "gerber_old_codes.hpp"

#include <cmath>

#include "text_lines.hpp"
#include <fmt/format.h>

namespace passo {

DrawnPoint GerberOldCodes::placed(Nanometres x, Nanometres y) const {
  if (exchanges_axes_) std::swap(x, y);
  const double a = mirror_x_ * scale_x_;
  const double b = mirror_y_ * scale_y_;
  if (a == 1 && b == 1) return moved({x, y}, offset_);
  return moved(rounded({static_cast<double>(x.count) * a, static_cast<double>(y.count) * b}), offset_);
}

// "A1.5B-2": each may be missing.
bool GerberOldCodes::read_axes(double& a, double& b) {
  const std::string_view words = findings_.command.words;
  for (std::size_t at = 2; at < words.size();) {
    const std::size_t end = std::min(words.find_first_of("AB", at + 1), words.size());
    const std::optional<double> value = read_gerber_decimal(words.substr(at + 1, end - at - 1));
    if ((words[at] != 'A' && words[at] != 'B') || !value || std::abs(*value) > 1e6) {
      return findings_.refuse(at, end - at, "gerber.bad-number", "this is not a value for an axis", "e.g. A1.5B2");
    }
    (words[at] == 'A' ? a : b) = *value;
    at = end;
  }
  return true;
}

void GerberOldCodes::read_turn() {
  const std::string_view words = findings_.command.words;
  const std::optional<double> degrees = read_gerber_decimal(words.substr(2));
  if (!degrees || (*degrees != 0 && *degrees != 90 && *degrees != 180 && *degrees != 270)) {
    findings_.refuse(2, 0, "gerber.bad-mode", "this is not an image rotation", "IR0, IR90, IR180 or IR270");
    return;
  }
  quarter_turns_ = static_cast<int>(*degrees / 90);
}

bool GerberOldCodes::read() {
  const std::string_view words = findings_.command.words;
  const std::string_view code = words.substr(0, 2);
  double a = 0;
  double b = 0;
  if (code == "IP") {
    is_negative_ = trimmed(words.substr(2)) == "NEG";
  } else if (code == "AS") {
    exchanges_axes_ = words.find("AY") != std::string_view::npos;
  } else if (code == "MI") {
    if (!read_axes(a, b)) return true;
    mirror_x_ = a == 1 ? -1 : 1;
    mirror_y_ = b == 1 ? -1 : 1;
  } else if (code == "SF") {
    a = b = 1;
    if (!read_axes(a, b)) return true;
    scale_x_ = a;
    scale_y_ = b;
  } else if (code == "OF") {
    if (!read_axes(a, b)) return true;
    offset_ = rounded({a * numbers_.nm_per_unit(), b * numbers_.nm_per_unit()});
    const DrawnPoint limit{farthest_drawn, farthest_drawn};
    if (std::abs(offset_.x.count) > limit.x.count || std::abs(offset_.y.count) > limit.y.count) {
      offset_ = {};
      findings_.refuse(0, 0, "drawing.too-far", "the offset is over 100 m", "a smaller offset; check the unit");
    }
  } else if (code == "IR") {
    read_turn();
  } else if (code == "KO" || code == "IF") {
    findings_.refuse(0, 0, "gerber.unsupported", fmt::format("{} is not supported", code),
                     code == "IF" ? "the text of the included file instead" : "LPC, clear polarity, instead");
  } else {
    // Names, and what was for photo plotters.
    return code == "IN" || code == "LN" || code == "IJ" || code == "IO" || code == "IC" || code == "PF" || code == "RO";
  }
  const bool moves = code != "IP" && code != "KO" && code != "IF";
  const bool does = exchanges_axes_ || mirror_x_ != 1 || mirror_y_ != 1 || scale_x_ != 1 || scale_y_ != 1 ||
                    offset_ != DrawnPoint{} || quarter_turns_ != 0;
  if (moves && does)
    findings_.note(fmt::format("the deprecated code {} is applied; check the position of the layer", code));
  return true;
}

}  // namespace passo
