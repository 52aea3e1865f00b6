// HpglPlotter: executes the commands of a plot. Private to cam/.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hpgl_labels.hpp"
#include "hpgl_pen.hpp"
#include "hpgl_words.hpp"

namespace passo {

class HpglPlotter {
 public:
  HpglPlotter(const std::string& name, std::string_view text, const HpglOptions& options, Diagnostics& diagnostics)
      : name_(name), text_(text), words_(text), diagnostics_(diagnostics), pen_(name, options, diagnostics) {
    reset();
  }

  Drawing plot();
  static bool knows(const HpglCommand& command);

 private:
  using Numbers = std::vector<double>;
  struct Order {
    const char* name;
    void (HpglPlotter::*carry_out)(const Numbers& numbers);
    std::size_t least = 0;  // minimum number of parameters
  };
  static const std::span<const Order> orders;
  static constexpr std::array<double, 4> usual_corners = {603, 521, 10603, 7721};  // P1 and P2 of the HP 7475A, A4

  bool carry_out(const HpglCommand& command);
  bool carry_out_text(const HpglCommand& command);
  void refuse(std::size_t place, std::string code, std::string message, std::string expected);
  void leave_out(const std::string& what) { ++left_out_[what]; }

  void reset();
  void find_scaling();
  HpglSpot user(double x, double y) const { return {user_.x(x, y), user_.y(x, y)}; }
  HpglSpot user_way(double x, double y) const { return {user_.xx * x, user_.yy * y}; }
  // Returns the target, relative to the pen position or to the origin.
  HpglSpot target(double x, double y, bool is_relative) const;
  void go(HpglSpot to);
  void go_along(const Numbers& numbers);
  void arc_about(HpglSpot centre, double sweep_degrees);
  void arc_through(HpglSpot second, HpglSpot third);
  void polygon(const std::vector<HpglSpot>& corners);
  void rectangle(HpglSpot to);
  void wedge(const Numbers& numbers);
  void bezier(const Numbers& numbers, bool is_relative);
  void packed_line();
  std::optional<double> packed_number(bool is_base_32, double unit);
  void label(std::string_view text);

  void pen_up(const Numbers& n) {
    if (is_down_ && !is_polygon_) pen_.raise();
    is_down_ = false;
    go_along(n);
  }
  void pen_down(const Numbers& n) {
    if (!is_polygon_) pen_.lower();
    is_down_ = true;
    go_along(n);
  }
  void absolute(const Numbers& n) { is_relative_ = false, go_along(n); }
  void relative(const Numbers& n) { is_relative_ = true, go_along(n); }
  void select_pen(const Numbers& n) {
    pen_.select_pen(static_cast<std::uint32_t>(n.empty() ? 0 : std::clamp(n[0], 0.0, 255.0)));
  }
  void arc_absolute(const Numbers& n) { arc_about(user(n[0], n[1]), n[2]); }
  void arc_relative(const Numbers& n) { arc_about(target(n[0], n[1], true), n[2]); }
  void three_absolute(const Numbers& n) { arc_through(user(n[0], n[1]), user(n[2], n[3])); }
  void three_relative(const Numbers& n) { arc_through(target(n[0], n[1], true), target(n[2], n[3], true)); }
  void circle(const Numbers& n);
  void edge_absolute(const Numbers& n) { rectangle(user(n[0], n[1])); }
  void edge_relative(const Numbers& n) { rectangle(target(n[0], n[1], true)); }
  void bezier_absolute(const Numbers& n) { bezier(n, false); }
  void bezier_relative(const Numbers& n) { bezier(n, true); }
  void polygon_mode(const Numbers& n);
  void draw_polygon(const Numbers& n);
  void corners(const Numbers& n);
  void scale(const Numbers& n);
  void turn(const Numbers& n);
  void line_type(const Numbers& n);
  void letter_size(const Numbers& n);
  void letter_share(const Numbers& n);
  void direction(const Numbers& n);
  void direction_share(const Numbers& n);
  void slant(const Numbers& n) { labels_.slant = n.empty() ? 0 : std::clamp(n[0], -10.0, 10.0); }
  void extra_space(const Numbers& n);
  void label_origin(const Numbers& n);
  void cells(const Numbers& n);
  void tick_length(const Numbers& n);
  void tick_on_x(const Numbers& n);
  void tick_on_y(const Numbers& n);
  void initialize(const Numbers&) { reset(); }
  void nothing(const Numbers&) {}

  const std::string& name_;
  std::string_view text_;
  HpglWords words_;
  Diagnostics& diagnostics_;
  HpglPen pen_;
  bool is_down_ = false;
  bool is_relative_ = false;
  std::array<double, 4> corners_ = usual_corners;
  std::vector<double> scaling_;
  DxfTransform user_;
  HpglLabels labels_;
  char label_end_ = '\x03';
  std::string_view buffered_;
  std::array<double, 2> ticks_ = {0.005, 0.005};
  std::vector<std::vector<HpglSpot>> polygon_;
  bool is_polygon_ = false;  // polygon mode: corners are collected
  std::map<std::string, std::size_t> left_out_;
  std::size_t counted_to_ = 0;  // offset up to which lines have been counted
  std::uint32_t line_ = 1;
};

}  // namespace passo
