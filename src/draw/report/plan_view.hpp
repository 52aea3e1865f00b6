// PlanView: maps board positions to the paper, and defines the pens of board pictures. Private to report/.
#pragma once

#include <algorithm>
#include <array>

#include "canvas.hpp"

#include "passo/cam/region.hpp"

namespace passo {

inline const Pen rapids_pen{.colour = {0.62, 0.66, 0.71}, .width = 0.9};

inline const Colour& colour_of_tool(std::size_t tool) {
  static constexpr std::array<Colour, 6> colours = {{{0.12, 0.40, 0.70},
                                                     {0.80, 0.35, 0.10},
                                                     {0.18, 0.55, 0.34},
                                                     {0.55, 0.30, 0.65},
                                                     {0.70, 0.55, 0.05},
                                                     {0.75, 0.15, 0.30}}};
  return colours[tool % colours.size()];
}

inline void extend(DrawnBox& box, DrawnPoint point) {
  box.least = {std::min(box.least.x, point.x), std::min(box.least.y, point.y)};
  box.most = {std::max(box.most.x, point.x), std::max(box.most.y, point.y)};
}

class PlanView {
 public:
  // Centres the box, with a margin of 2 mm, in the area.
  PlanView(const DrawnBox& box, const Area& area) : area_(area) {
    constexpr double air = 2e6;  // nm
    low_ = {static_cast<double>(box.least.x.count) - air, static_cast<double>(box.least.y.count) - air};
    const double width = static_cast<double>(box.most.x.count) + air - low_.x;
    const double height = static_cast<double>(box.most.y.count) + air - low_.y;
    pixels_ = std::min(area.width / width, area.height / height);
    area_.x += (area.width - width * pixels_) / 2;
    area_.y += (area.height - height * pixels_) / 2;
    area_.height = height * pixels_;
  }

  Spot spot(DrawnPoint at) const {
    return {area_.x + (static_cast<double>(at.x.count) - low_.x) * pixels_,
            area_.bottom() - (static_cast<double>(at.y.count) - low_.y) * pixels_};
  }
  double pixels(Nanometres length) const { return static_cast<double>(length.count) * pixels_; }

 private:
  Area area_;
  Spot low_;
  double pixels_ = 1;
};

}  // namespace passo
