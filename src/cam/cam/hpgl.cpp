#include "passo/cam/hpgl.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hpgl_plotter.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

constexpr double units_of_cm = 400;

// What moves no pen: speed, force, widths of pens, fills, questions to the plotter.
constexpr std::string_view silent_orders =
    "VS FS AS AP AF AH PG RP NR PW WU PT FT PC NP CR MC MG PP TR LA UL SB RF TD CF PS SV KY GC GM GP EC EN ES IM IR OA "
    "OC OD OE OF OG OH OI OK OL OO OP OS OT OW BP QL IW UC CS CA SS SA SD AD FI FN ";

}  // namespace

const std::span<const HpglPlotter::Order> HpglPlotter::orders = [] {
  using P = HpglPlotter;
  static constexpr Order all[] = {{"PU", &P::pen_up},
                                  {"PD", &P::pen_down},
                                  {"PA", &P::absolute},
                                  {"PR", &P::relative},
                                  {"SP", &P::select_pen},
                                  {"AA", &P::arc_absolute, 3},
                                  {"AR", &P::arc_relative, 3},
                                  {"AT", &P::three_absolute, 4},
                                  {"RT", &P::three_relative, 4},
                                  {"CI", &P::circle, 1},
                                  {"EA", &P::edge_absolute, 2},
                                  {"ER", &P::edge_relative, 2},
                                  {"RA", &P::edge_absolute, 2},
                                  {"RR", &P::edge_relative, 2},
                                  {"EW", &P::wedge, 3},
                                  {"WG", &P::wedge, 3},
                                  {"BZ", &P::bezier_absolute, 6},
                                  {"BR", &P::bezier_relative, 6},
                                  {"PM", &P::polygon_mode},
                                  {"EP", &P::draw_polygon},
                                  {"FP", &P::draw_polygon},
                                  {"IP", &P::corners},
                                  {"SC", &P::scale},
                                  {"RO", &P::turn},
                                  {"LT", &P::line_type},
                                  {"SI", &P::letter_size},
                                  {"SR", &P::letter_share},
                                  {"DI", &P::direction},
                                  {"DR", &P::direction_share},
                                  {"SL", &P::slant},
                                  {"ES", &P::extra_space},
                                  {"LO", &P::label_origin},
                                  {"CP", &P::cells},
                                  {"TL", &P::tick_length},
                                  {"XT", &P::tick_on_x},
                                  {"YT", &P::tick_on_y},
                                  {"IN", &P::initialize},
                                  {"DF", &P::initialize}};
  return std::span<const Order>(all);
}();

Drawing HpglPlotter::plot() {
  while (!diagnostics_.full() && !pen_.is_full()) {
    const std::optional<HpglCommand> command = words_.command();
    if (!command) {
      if (!words_.at_end())
        refuse(words_.place(), "hpgl.syntax", "this is not an HPGL command", "two letters, e.g. PU");
      break;
    }
    line_ += static_cast<std::uint32_t>(
        std::count(text_.data() + counted_to_, text_.data() + std::max(counted_to_, command->place), '\n'));
    counted_to_ = std::max(counted_to_, command->place);
    pen_.set_line(line_);
    if (!carry_out(*command)) break;
  }
  pen_.raise();
  DrawingBuilder& builder = pen_.builder();
  for (const auto& [what, count] : left_out_) builder.note(fmt::format("ignored: {} {}", count, what));
  if (!pen_.has_drawn() && !diagnostics_.any_error()) {
    diagnostics_.add({.code = "hpgl.no-drawing",
                      .file = name_,
                      .place = {},
                      .message = "the plot draws nothing",
                      .expected = "PD with coordinates, arcs, circles or labels",
                      .text = ""});
  }
  return builder.take();
}

void HpglPlotter::refuse(std::size_t place, std::string code, std::string message, std::string expected) {
  place = std::min(place, text_.size());
  const std::string_view before = text_.substr(0, place);
  const std::size_t start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  const auto line = static_cast<std::uint32_t>(std::count(before.begin(), before.end(), '\n')) + 1;
  constexpr std::size_t longest = 100'000;
  diagnostics_.add({.code = std::move(code),
                    .file = name_,
                    .place = {line, static_cast<std::uint32_t>(place - start) + 1, 1},
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = place - start > longest ? ""
                                                    : std::string(text_.substr(
                                                          start, std::min(text_.find('\n', start) - start, longest)))});
}

bool HpglPlotter::knows(const HpglCommand& command) {
  constexpr std::string_view with_text = "LB BL WD PB DT SM CO PE ";
  const std::string name = std::string(command.name()) + ' ';
  return std::ranges::any_of(orders, [&](const Order& order) { return command.is(order.name); }) ||
         with_text.find(name) != std::string_view::npos || silent_orders.find(name) != std::string_view::npos;
}

// False: the plot cannot be followed any further.
bool HpglPlotter::carry_out(const HpglCommand& command) {
  if (carry_out_text(command)) return !diagnostics_.any_error();
  const auto order = std::ranges::find_if(orders, [&](const Order& one) { return command.is(one.name); });
  if (order == orders.end()) {
    if (command.is("UC")) leave_out("characters that the plot draws itself");
    if (command.is("IW")) leave_out("clipping windows");
    if (command.is("CS") || command.is("CA") || command.is("SD") || command.is("AD")) leave_out("choices of letters");
    if (!knows(command)) leave_out(fmt::format("unknown commands {}", command.name()));
    words_.skip_to_end_of_command();
    return true;
  }
  const std::optional<Numbers> numbers = words_.numbers();
  if (!numbers) {
    refuse(words_.place(), "hpgl.syntax", fmt::format("this is not a number of {}", command.name()),
           "numbers separated by commas, then ';' or the next command");
    return false;
  }
  if (numbers->size() < order->least) {
    refuse(command.place, "hpgl.numbers", fmt::format("{} has {}", command.name(), counted(numbers->size(), "number")),
           fmt::format("{} or more", order->least));
    return false;
  }
  (this->*order->carry_out)(*numbers);
  return !diagnostics_.full();
}

// Commands that are followed by text.
bool HpglPlotter::carry_out_text(const HpglCommand& command) {
  if (command.is("LB") || command.is("BL") || command.is("WD")) {
    const std::size_t from = words_.place();
    const std::string_view text = words_.until(label_end_);
    if (from + text.size() >= text_.size()) {
      refuse(command.place, "hpgl.label", "this label is not closed",
             label_end_ == '\x03' ? "the character ETX (code 3), or another terminator, set earlier by DT"
                                  : fmt::format("'{}', the terminator set by DT", label_end_));
      return true;
    }
    if (command.is("LB")) label(text);
    if (command.is("BL")) buffered_ = text;
  } else if (command.is("PB")) {
    label(buffered_);
  } else if (command.is("DT")) {
    const std::optional<char> end = words_.character();
    label_end_ = end.value_or('\x03');
    words_.skip_to_end_of_command();
  } else if (command.is("SM")) {
    if (words_.character()) leave_out("symbols at points");
    words_.skip_to_end_of_command();
  } else if (command.is("CO")) {
    words_.skip_comment();
  } else if (command.is("PE")) {
    packed_line();
  } else {
    return false;
  }
  return true;
}

void HpglPlotter::reset() {
  corners_ = usual_corners;
  scaling_.clear();
  find_scaling();
  pen_.rotate_sheet(0);
  pen_.set_dashes({});
  is_down_ = false;
  is_relative_ = false;
  labels_ = {.width = 0.187 * units_of_cm, .height = 0.269 * units_of_cm, .line_start = pen_.at()};
  label_end_ = '\x03';
  ticks_ = {0.005, 0.005};
  is_polygon_ = false;
  polygon_.clear();
}

void HpglPlotter::find_scaling() {
  user_ = {};
  if (scaling_.empty()) return;
  const int type = scaling_.size() > 4 ? static_cast<int>(scaling_[4]) : 0;
  double sx = type == 2 ? scaling_[1] : (corners_[2] - corners_[0]) / (scaling_[1] - scaling_[0]);
  double sy = type == 2 ? scaling_[3] : (corners_[3] - corners_[1]) / (scaling_[3] - scaling_[2]);
  double left = 0;
  double low = 0;
  if (type == 1) {
    const double s = std::min(std::abs(sx), std::abs(sy));
    const double left_share = scaling_.size() > 5 ? scaling_[5] / 100 : 0.5;
    const double low_share = scaling_.size() > 6 ? scaling_[6] / 100 : 0.5;
    left = (corners_[2] - corners_[0]) * (1 - s / std::abs(sx)) * left_share;
    low = (corners_[3] - corners_[1]) * (1 - s / std::abs(sy)) * low_share;
    sx = std::copysign(s, sx);
    sy = std::copysign(s, sy);
  }
  user_ = {.xx = sx, .yy = sy, .dx = corners_[0] + left - sx * scaling_[0], .dy = corners_[1] + low - sy * scaling_[2]};
}

void HpglPlotter::corners(const Numbers& n) {
  if (n.size() >= 4) {
    std::copy_n(n.begin(), 4, corners_.begin());
  } else if (n.size() >= 2) {
    corners_ = {n[0], n[1], n[0] + corners_[2] - corners_[0], n[1] + corners_[3] - corners_[1]};
  } else {
    corners_ = usual_corners;
  }
  // A sheet without a width would make all places one.
  if (corners_[2] == corners_[0]) corners_[2] += 1;
  if (corners_[3] == corners_[1]) corners_[3] += 1;
  find_scaling();
}

void HpglPlotter::scale(const Numbers& n) {
  scaling_ = n.size() >= 4 ? n : Numbers{};
  const bool has_factors = n.size() > 4 && n[4] == 2;
  const bool is_flat = n.size() >= 4 && (has_factors ? n[1] == 0 || n[3] == 0 : n[0] == n[1] || n[2] == n[3]);
  if (is_flat || (!n.empty() && n.size() < 4)) {
    scaling_.clear();
    refuse(words_.place() - 1, "hpgl.numbers", "these numbers are not a valid scaling",
           "the smallest and the largest X, the smallest and the largest Y");
  }
  find_scaling();
}

void HpglPlotter::turn(const Numbers& n) {
  pen_.rotate_sheet(n.empty() ? 0 : static_cast<int>(std::clamp(n[0], 0.0, 270.0)) / 90);
}

void HpglPlotter::line_type(const Numbers& n) {
  // Shares of the pattern: a line, a gap, a line, ...; no length is a dot.
  static const std::array<std::vector<double>, 9> patterns = {{{},
                                                               {0, 100},
                                                               {50, 50},
                                                               {70, 30},
                                                               {80, 10, 0, 10},
                                                               {70, 10, 10, 10},
                                                               {50, 10, 10, 10, 10, 10},
                                                               {70, 10, 0, 10, 0, 10},
                                                               {50, 10, 0, 10, 10, 10, 0, 10}}};
  if (n.empty()) {
    pen_.set_dashes({});
    return;
  }
  const double diagonal = std::hypot(corners_[2] - corners_[0], corners_[3] - corners_[1]);
  const double share = n.size() > 1 ? std::abs(n[1]) / 100 : 0.04;
  const bool is_mm = n.size() > 2 && n[2] == 1;
  const double length = std::max(1.0, is_mm ? share * 100 / 0.025 : share * diagonal);
  const auto type = static_cast<std::size_t>(std::abs(n[0]));
  if (type == 0 || type >= patterns.size()) {
    leave_out("unknown line types");
    pen_.set_dashes({});
    return;
  }
  constexpr double dot = 1;  // plotter unit
  std::vector<double> dashes = patterns.at(type);
  for (double& dash : dashes) dash = std::max(dot, dash / 100 * length);
  pen_.set_dashes(std::move(dashes));
}

void HpglPlotter::letter_size(const Numbers& n) {
  labels_.width = (n.size() >= 2 ? n[0] : 0.187) * units_of_cm;
  labels_.height = (n.size() >= 2 ? n[1] : 0.269) * units_of_cm;
}

void HpglPlotter::letter_share(const Numbers& n) {
  labels_.width = (n.size() >= 2 ? n[0] : 0.75) / 100 * (corners_[2] - corners_[0]);
  labels_.height = (n.size() >= 2 ? n[1] : 1.5) / 100 * (corners_[3] - corners_[1]);
}

void HpglPlotter::direction(const Numbers& n) {
  labels_.direction = n.size() >= 2 ? std::atan2(n[1], n[0]) : 0;
}

void HpglPlotter::direction_share(const Numbers& n) {
  labels_.direction =
      n.size() >= 2 ? std::atan2(n[1] * (corners_[3] - corners_[1]), n[0] * (corners_[2] - corners_[0])) : 0;
}

void HpglPlotter::extra_space(const Numbers& n) {
  labels_.extra_x = n.empty() ? 0 : std::clamp(n[0], -1.0, 100.0);
  labels_.extra_y = n.size() < 2 ? 0 : std::clamp(n[1], -1.0, 100.0);
}

void HpglPlotter::label_origin(const Numbers& n) {
  const double origin = n.empty() ? 1 : n[0];
  const bool is_known = (origin >= 1 && origin <= 9) || (origin >= 11 && origin <= 19);
  labels_.origin = is_known ? static_cast<int>(origin) : 1;
}

void HpglPlotter::cells(const Numbers& n) {
  const HpglSpot to = n.size() >= 2 ? moved_by_cells(labels_, pen_.at(), n[0], n[1])
                                    : moved_by_cells(labels_, labels_.line_start, 0, -1);
  pen_.move_to(to);
  labels_.line_start = n.size() >= 2 ? moved_by_cells(labels_, labels_.line_start, 0, n[1]) : to;
}

void HpglPlotter::tick_length(const Numbers& n) {
  ticks_ = {n.empty() ? 0.005 : n[0] / 100, n.empty() ? 0.005 : n.size() > 1 ? n[1] / 100 : 0};
}

void HpglPlotter::label(std::string_view text) {
  if (const std::size_t unknown = write_label(text, labels_, pen_); unknown > 0) {
    left_out_["characters that the font does not have"] += unknown;
  }
}

Drawing read_hpgl(const std::string& name, std::string_view text, const HpglOptions& options,
                  Diagnostics& diagnostics) {
  return HpglPlotter(name, text, options, diagnostics).plot();
}

bool looks_like_hpgl(std::string_view text) {
  constexpr std::size_t looked_at = 4096;
  text = text.substr(0, looked_at);
  if (text.starts_with("\x1B.") || text.starts_with("\x1B%") ||
      text.starts_with("\x1B"
                       "E\x1B%"))
    return true;
  if (text.starts_with("INCH")) return false;  // a drill file
  HpglWords words(text);
  // Words begin with two letters, too. Of a plot, known commands lead to a number or to a ';'.
  constexpr int most_looked_at = 8;
  for (int i = 0; i < most_looked_at; ++i) {
    const std::optional<HpglCommand> command = words.command();
    if (!command || !HpglPlotter::knows(*command)) return false;
    const std::size_t behind = words.place();
    if (command->is("DT") || command->is("LB")) return i > 0;
    if (command->is("CO")) {
      words.skip_comment();
      continue;
    }
    if (!words.numbers()) return false;
    const std::string_view taken = text.substr(behind, words.place() - behind);
    if (taken.find_first_of("0123456789;") != std::string_view::npos) return true;
  }
  return false;
}

}  // namespace passo
