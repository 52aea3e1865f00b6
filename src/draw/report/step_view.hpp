// StepView: pulses on the step grid, seen along one axis. Private to report/.
//
// The view fits the pulses and the ideal path into an area of the paper, at the same scale in both directions.
// Positions are in steps.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "canvas.hpp"

#include "passo/study/step_move.hpp"

namespace passo {

// The fonts and colours shared by all pictures of pulses.
namespace step_look {
inline const Font title_font{.size = 24, .colour = {0.13, 0.14, 0.17}, .bold = true};
inline const Font heading_font{.size = 17, .colour = {0.13, 0.14, 0.17}, .bold = true};
inline const Font caption_font{.size = 13, .colour = {0.40, 0.42, 0.46}};
inline const Font tick_font{.size = 11, .colour = {0.40, 0.42, 0.46}};
inline const Colour ideal_colour{0.80, 0.22, 0.20};
inline const Colour one_axis{0.16, 0.38, 0.70};
inline const Colour together{0.93, 0.55, 0.10};
inline const Colour waiting{0.80, 0.82, 0.86};
inline const Colour midline_colour{0.20, 0.60, 0.45};
inline const Colour wrong_colour{0.85, 0.05, 0.10};
}  // namespace step_look

struct Shown {  // one pulse, or the start
  Place place;
  int axes = 0;  // number of axes that stepped
  bool waited = false;
  bool wrong = false;  // of a faulty listing: the right method makes another pulse here
};

class StepView {
 public:
  // `path`: points of the ideal path; the view includes them, too.
  StepView(const std::vector<Shown>& shown, const std::vector<Spot>& path, std::size_t across, std::size_t up,
           const Area& area);
  // Creates a magnified view of `steps` steps from `low` on, which fills the square area.
  StepView(const StepView& whole, Spot low, double steps, const Area& area);

  bool shows(const Place& place) const;
  // Returns whether there is room to draw a pulse as a dot.
  bool has_dots() const { return dot_radius() >= smallest_dot; }
  double dot_radius() const { return std::min(5.0, scale_ * 0.2); }

  static double value(const Place& place, std::size_t axis) {
    return axis < place.size() ? static_cast<double>(place[axis]) : 0;
  }
  Spot spot(double x, double y) const {
    return {frame_.x + (x - low_.x) * scale_, frame_.bottom() - (y - low_.y) * scale_};
  }
  Spot spot(const Place& place) const { return spot(value(place, across_), value(place, up_)); }
  const Area& frame() const { return frame_; }
  const Spot& low() const { return low_; }
  const Spot& high() const { return high_; }
  double scale() const { return scale_; }  // pixels per step
  std::size_t across() const { return across_; }
  std::size_t up() const { return up_; }

 private:
  static constexpr double smallest_dot = 1.2;

  void include(double x, double y);

  std::size_t across_;
  std::size_t up_;
  Spot low_;
  Spot high_;
  double scale_ = 1;
  Area frame_;
};

// Draws a line at every step if there is room, otherwise only at round numbers of steps.
void draw_step_lines(Canvas& canvas, const StepView& view);
// Does the same, and adds ticks.
void draw_step_grid(Canvas& canvas, const StepView& view);
// Draws the pulses, joined by a line. Blue: one axis stepped; orange: several; grey ring: a pause.
void draw_pulses(Canvas& canvas, const StepView& view, const std::vector<Shown>& shown);

// Draws the wrong pulses again, in red: each with the line that led to it.
void draw_wrong_pulses(Canvas& canvas, const StepView& view, const std::vector<Shown>& shown);
// Marks the place where a faulty listing ends, if that is not the end of the move.
void draw_wrong_end(Canvas& canvas, const StepView& view, const Place& place);

struct StepKey {
  std::string text;
  Colour colour;
  bool line = false;  // drawn as a line; otherwise as a dot
};
// Returns the legend entries of every picture of pulses.
std::vector<StepKey> step_keys();
void draw_step_keys(Canvas& canvas, const std::vector<StepKey>& keys, double x, double y);

}  // namespace passo
