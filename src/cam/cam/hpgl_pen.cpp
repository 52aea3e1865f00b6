#include "hpgl_pen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr double plotter_unit_mm = 0.025;

}  // namespace

HpglPen::HpglPen(const std::string& file, const HpglOptions& options, Diagnostics& diagnostics)
    : options_(options),
      builder_(file, diagnostics),
      unit_mm_(plotter_unit_mm * options.scale),
      tolerance_(options.tolerance.value() / unit_mm_) {
  rotate_sheet(0);
  select_pen(1);
}

void HpglPen::select_pen(std::uint32_t number) {
  raise();
  has_pen_ = number > 0;
  if (!has_pen_) return;
  const std::string name = fmt::format("pen {}", number);
  layer_ = builder_.layer(name);
  is_chosen_ = options_.layers.empty() || std::ranges::find(options_.layers, name) != options_.layers.end();
}

void HpglPen::rotate_sheet(int quarters) {
  end_path();
  constexpr std::array<double, 4> cosines = {1, 0, -1, 0};
  const double c = cosines.at(static_cast<std::size_t>(quarters) % 4) * unit_mm_;
  const double s = cosines.at((static_cast<std::size_t>(quarters) + 3) % 4) * unit_mm_;
  sheet_ = {.xx = c, .xy = -s, .yx = s, .yy = c};
}

void HpglPen::set_dashes(std::vector<double> lengths) {
  end_path();
  dashes_ = std::move(lengths);
  dash_ = 0;
  dash_used_ = 0;
}

void HpglPen::put(HpglSpot spot, double bulge_before) {
  has_drawn_ = true;
  if (!builder_.has_room_for(1, place(), "")) return;
  const auto at = builder_.point(Mm(sheet_.x(spot.x, spot.y)), Mm(sheet_.y(spot.x, spot.y)), place(), "");
  if (!at) return;
  if (!path_.points.empty()) {
    path_.points.back().bulge = bulge_before;
    if (path_.points.back().at == *at) return;
  }
  path_.points.push_back({*at, 0});
}

void HpglPen::end_path() {
  DrawnPath path = std::move(path_);
  path_ = {};
  if (path.points.size() > 2 && path.points.front().at == path.points.back().at) {
    path.points.pop_back();
    path.is_closed = true;
  }
  path.layer = layer_;
  path.line = line_;
  if (path.points.size() > 1) {
    last_ = path.is_closed ? path.points.front().at : path.points.back().at;
    has_last_ = true;
  }
  builder_.add_path(std::move(path));
}

void HpglPen::lower() {
  if (draws() && path_.points.empty() && dashes_.empty()) put(at_);
}

void HpglPen::raise() {
  if (path_.points.size() == 1) {
    // A dot at the end of the last line adds nothing.
    const DrawnPoint at = path_.points.front().at;
    if (!(has_last_ && last_ == at)) builder_.add_hole({at, {}, layer_, line_});
    last_ = at;
    has_last_ = true;
    path_ = {};
  }
  end_path();
}

void HpglPen::move_to(HpglSpot to) {
  end_path();
  at_ = to;
  dash_ = 0;
  dash_used_ = 0;
}

void HpglPen::line_to(HpglSpot to) {
  if (draws()) {
    if (!dashes_.empty()) {
      dashed_to(to);
    } else {
      if (path_.points.empty()) put(at_);
      put(to);
    }
  }
  at_ = to;
}

void HpglPen::dashed_to(HpglSpot to) {
  const double length = std::hypot(to.x - at_.x, to.y - at_.y);
  const auto along = [&](double way) {
    return HpglSpot{at_.x + (to.x - at_.x) * way / length, at_.y + (to.y - at_.y) * way / length};
  };
  for (double way = 0; way < length && !builder_.is_full();) {
    const double left = dashes_[dash_] - dash_used_;
    const bool ends = left <= length - way;
    const double next = ends ? way + left : length;
    if (dash_ % 2 == 0) {
      if (path_.points.empty()) put(along(way));
      put(along(next));
    }
    dash_used_ += next - way;
    way = next;
    if (!ends) return;
    end_path();
    // Each dash is a path of its own, which costs more than its points.
    constexpr std::size_t cost = 6;
    if (dash_ % 2 == 0 && !builder_.has_room_for(cost, place(), "")) return;
    dash_ = (dash_ + 1) % dashes_.size();
    dash_used_ = 0;
  }
}

void HpglPen::arc(HpglSpot centre, double sweep) {
  const double radius = std::hypot(at_.x - centre.x, at_.y - centre.y);
  const double start = std::atan2(at_.y - centre.y, at_.x - centre.x);
  const double share = std::clamp(tolerance_ / std::max(radius, 1e-9), 1e-6, 0.5);
  const bool has_chords = !dashes_.empty();
  const double most = has_chords ? 2 * std::acos(1 - share) : std::numbers::pi * 1.0001;
  const double parts = std::max(1.0, std::ceil(std::abs(sweep) / most));
  for (double i = 1; i <= parts && !builder_.is_full(); ++i) {
    const double angle = start + sweep * i / parts;
    const HpglSpot to{centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)};
    if (!draws() || has_chords) {
      line_to(to);
      continue;
    }
    if (path_.points.empty()) put(at_);
    put(to, std::tan(sweep / parts / 4));
    at_ = to;
  }
}

void HpglPen::circle(double radius) {
  if (!draws() || radius == 0) return;
  end_path();
  if (!dashes_.empty()) {
    const HpglSpot centre = at_;
    move_to({centre.x + std::abs(radius), centre.y});
    arc(centre, 2 * std::numbers::pi);
    move_to(centre);
    return;
  }
  has_drawn_ = true;
  const auto at = builder_.point(Mm(sheet_.x(at_.x, at_.y)), Mm(sheet_.y(at_.x, at_.y)), place(), "");
  const auto diameter = builder_.length(Mm(2 * std::abs(radius) * unit_mm_), place(), "");
  if (at && diameter && builder_.has_room_for(1, place(), "")) builder_.add_hole({*at, *diameter, layer_, line_});
}

}  // namespace passo
