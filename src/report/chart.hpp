// Chart: a frame with ticks, and curves in it. Private to report/.
//
// The ends are the caller's: axis_end() makes a round one. Axes begin at 0 unless told otherwise; one whose scale is
// logarithmic begins and ends at powers of ten.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cairo_canvas.hpp"

namespace passo {

// A round number that is not below `least`, with a few steps of 1, 2 or 5 up to it: 480 → 500, 1040 → 1200.
double axis_end(double least);

class Chart {
 public:
  struct Axis {
    std::string title;
    double end = 1;
    double begin = 0;
    bool logarithmic = false;
  };

  // `area` is the frame; titles and labels stand outside of it, on the left and below.
  Chart(Canvas& canvas, const Area& area, Axis x, Axis y);

  // Paper, grid, labels and titles; before all curves. Without `x_labels` the axis belongs to a chart below.
  void draw_grid(bool x_labels = true);
  // A second scale along the upper edge: `x_per_unit` units of x measure one of it.
  void draw_upper_scale(const std::string& title, double x_per_unit);
  void draw_frame();

  Spot at(double x, double y) const;
  // Between the values of two functions of x, from the axis's beginning to x = `end`.
  using Function = std::function<double(double x)>;
  void fill_between(const Function& lower, const Function& upper, double end, const Colour& colour, double opacity = 1);
  void curve(const Function& function, const Pen& pen, double end);
  void curve(const Function& function, const Pen& pen) { curve(function, pen, x_.end); }
  // From value to value; what leaves the axis runs along its edge.
  void polyline(const std::vector<Spot>& values, const Pen& pen);

  const Area& area() const { return area_; }

 private:
  std::vector<Spot> spots(const Function& function, double end) const;

  Canvas& canvas_;
  Area area_;
  Axis x_;
  Axis y_;
};

}  // namespace passo
