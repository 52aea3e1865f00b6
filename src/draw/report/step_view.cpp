#include "step_view.hpp"

#include <algorithm>
#include <cmath>

#include "axis_ticks.hpp"

namespace passo {
namespace {

using step_look::caption_font;
using step_look::tick_font;

const Colour grid_colour{0.90, 0.91, 0.93};
const Colour edge_colour{0.62, 0.64, 0.67};

// Ticks at whole steps, where each label needs `room` pixels.
std::vector<Tick> step_ticks(double low, double high, double scale, double room) {
  const double step = std::max(1.0, round_step(room / scale));
  std::vector<Tick> all;
  for (double value = std::ceil(low / step) * step; value <= high; value += step) {
    all.push_back({value, tick_label(value, step)});
  }
  return all;
}

void draw_ticks(Canvas& canvas, const StepView& view) {
  const Area& frame = view.frame();
  double label_end = frame.x;
  const double widest = std::max(canvas.text_width(tick_label(view.low().x, 1), tick_font),
                                 canvas.text_width(tick_label(view.high().x, 1), tick_font));
  for (const Tick& tick : step_ticks(view.low().x, view.high().x, view.scale(), widest + 12)) {
    const double x = view.spot(tick.value, 0).x;
    canvas.text({x, frame.bottom() + 12}, tick.label, tick_font, Align::centre);
    label_end = x + canvas.text_width(tick.label, tick_font) / 2;
  }
  for (const Tick& tick : step_ticks(view.low().y, view.high().y, view.scale(), 18)) {
    canvas.text({frame.x - 7, view.spot(0, tick.value).y}, tick.label, tick_font, Align::right);
  }
  // The last label may reach out beyond the frame.
  canvas.text({std::max(frame.right() + 14, label_end + 10), frame.bottom() + 12}, axis_name(view.across()), tick_font);
  canvas.text({frame.x - 7, frame.y - 14}, axis_name(view.up()), tick_font, Align::right);
}

}  // namespace

StepView::StepView(const std::vector<Shown>& shown, const std::vector<Spot>& path, std::size_t across, std::size_t up,
                   const Area& area)
    : across_(across), up_(up), low_{INFINITY, INFINITY}, high_{-INFINITY, -INFINITY} {
  for (const Shown& one : shown) include(value(one.place, across), value(one.place, up));
  for (const Spot& spot : path) include(spot.x, spot.y);
  constexpr double border = 0.6;
  const double width = high_.x - low_.x + 2 * border;
  const double height = high_.y - low_.y + 2 * border;
  scale_ = std::min({area.width / width, area.height / height, 60.0});
  low_.x -= border;
  low_.y -= border;
  high_.x += border;
  high_.y += border;
  frame_ = {area.x + (area.width - width * scale_) / 2, area.y + (area.height - height * scale_) / 2, width * scale_,
            height * scale_};
}

StepView::StepView(const StepView& whole, Spot low, double steps, const Area& area)
    : across_(whole.across_),
      up_(whole.up_),
      low_(low),
      high_{low.x + steps, low.y + steps},
      scale_(area.width / steps),
      frame_(area) {}

bool StepView::shows(const Place& place) const {
  const double x = value(place, across_);
  const double y = value(place, up_);
  return x >= low_.x - 1 && x <= high_.x + 1 && y >= low_.y - 1 && y <= high_.y + 1;
}

void StepView::include(double x, double y) {
  low_ = {std::min(low_.x, x), std::min(low_.y, y)};
  high_ = {std::max(high_.x, x), std::max(high_.y, y)};
}

void draw_step_lines(Canvas& canvas, const StepView& view) {
  const Pen pen{.colour = grid_colour, .width = 1};
  const Area& frame = view.frame();
  const double step = view.scale() >= 6 ? 1 : round_step(12 / view.scale());
  for (double x = std::ceil(view.low().x / step) * step; x <= view.high().x; x += step) {
    const Spot at = view.spot(x, 0);
    canvas.line({at.x, frame.y}, {at.x, frame.bottom()}, pen);
  }
  for (double y = std::ceil(view.low().y / step) * step; y <= view.high().y; y += step) {
    const Spot at = view.spot(0, y);
    canvas.line({frame.x, at.y}, {frame.right(), at.y}, pen);
  }
  canvas.frame(frame, {.colour = edge_colour, .width = 1});
}

void draw_step_grid(Canvas& canvas, const StepView& view) {
  draw_step_lines(canvas, view);
  draw_ticks(canvas, view);
}

void draw_pulses(Canvas& canvas, const StepView& view, const std::vector<Shown>& shown) {
  using namespace step_look;
  const double radius = view.dot_radius();
  const bool dots = view.has_dots();
  for (const Shown& one : shown) {
    if (dots && one.waited) canvas.disc(view.spot(one.place), radius * 1.9, waiting);
  }
  canvas.move_to(view.spot(shown.front().place));
  for (const Shown& one : shown) canvas.line_to(view.spot(one.place));
  canvas.stroke({.colour = one_axis, .width = dots ? 1.6 : 1.2, .opacity = dots ? 0.55 : 1});
  for (const Shown& one : shown) {
    if (dots) canvas.disc(view.spot(one.place), radius, one.axes > 1 ? together : one_axis);
  }
}

void draw_wrong_pulses(Canvas& canvas, const StepView& view, const std::vector<Shown>& shown) {
  for (std::size_t k = 1; k < shown.size(); ++k) {
    if (!shown[k].wrong) continue;
    canvas.line(view.spot(shown[k - 1].place), view.spot(shown[k].place),
                {.colour = step_look::wrong_colour, .width = 3});
    if (view.has_dots()) canvas.disc(view.spot(shown[k].place), view.dot_radius(), step_look::wrong_colour);
  }
}

void draw_wrong_end(Canvas& canvas, const StepView& view, const Place& place) {
  constexpr double arm = 9;
  const Spot at = view.spot(place);
  const Pen pen{.colour = step_look::wrong_colour, .width = 2.5};
  canvas.line({at.x - arm, at.y - arm}, {at.x + arm, at.y + arm}, pen);
  canvas.line({at.x - arm, at.y + arm}, {at.x + arm, at.y - arm}, pen);
}

std::vector<StepKey> step_keys() {
  return {{"ideal path", step_look::ideal_colour, true},
          {"one axis steps", step_look::one_axis, false},
          {"several axes step", step_look::together, false},
          {"no step for a pulse or more", step_look::waiting, false}};
}

void draw_step_keys(Canvas& canvas, const std::vector<StepKey>& keys, double x, double y) {
  for (const StepKey& key : keys) {
    if (key.line) {
      canvas.line({x, y}, {x + 22, y}, {.colour = key.colour, .width = 1.6});
    } else {
      canvas.disc({x + 14, y}, 5, key.colour);
    }
    canvas.text({x + 28, y}, key.text, caption_font);
    x += 28 + canvas.text_width(key.text, caption_font) + 26;
  }
}

}  // namespace passo
