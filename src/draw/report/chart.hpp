// Chart: a frame with ticks, and curves inside. Private to report/.
//
// The caller chooses the end of an axis; axis_end() computes a round value. An axis begins at 0 by default. A
// logarithmic axis begins and ends at powers of ten.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "canvas.hpp"

namespace passo {

// Returns a round number not below `least`: a multiple of 1, 2 or 5 times a power of ten. 480 → 500, 1040 → 1200.
double axis_end(double least);

class Chart {
 public:
  struct Axis {
    std::string title;
    double end = 1;
    double begin = 0;
    bool logarithmic = false;
  };

  // `area` is the frame. Titles and labels are outside of the frame, on the left and below.
  Chart(Canvas& canvas, const Area& area, Axis x, Axis y);

  // Draws paper, grid, labels and titles. Must be called before any curve. Without `x_labels`, the labels of a chart
  // below are used.
  void draw_grid(bool x_labels = true);
  // Draws a second scale along the upper edge. One unit of this scale is `x_per_unit` units of x long.
  void draw_upper_scale(const std::string& title, double x_per_unit);
  void draw_frame();

  Spot at(double x, double y) const;
  // Fills the area between two functions of x, from the start of the axis to x = `end`.
  using Function = std::function<double(double x)>;
  void fill_between(const Function& lower, const Function& upper, double end, const Colour& colour, double opacity = 1);
  void curve(const Function& function, const Pen& pen, double end);
  void curve(const Function& function, const Pen& pen) { curve(function, pen, x_.end); }
  // Draws a polyline through the values. Values outside of an axis are drawn along the edge of the frame.
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
