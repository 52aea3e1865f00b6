#include "backlash_ramp.hpp"

namespace passo {

BacklashRamp::BacklashRamp(double begin, double middle, double end, Smoothness smoothness) {
  const double steepest = 2 / (end - begin);
  const bool is_continuous = smoothness == Smoothness::slow_bending;
  Local here{.from = begin};
  const auto add = [&](double until, double bend, double next_bend) {
    const double way = until - here.from;
    here.bend = bend;
    here.twist = (next_bend - bend) / way;
    knots_[count_] = here.from;
    pieces_[count_++] = here;
    here.value += (here.slope + (bend / 2 + here.twist * way / 6) * way) * way;
    here.slope += (bend + here.twist * way / 2) * way;
    here.from = until;
  };
  const auto add_part = [&](double until, double mean_bend) {
    if (!is_continuous) return add(until, mean_bend, mean_bend);
    const double peak_at = (here.from + until) / 2;
    add(peak_at, 0, 2 * mean_bend);
    add(until, 2 * mean_bend, 0);
  };
  add_part(middle, steepest / (middle - begin));
  add_part(end, -steepest / (end - middle));
  knots_[count_] = end;
  pieces_[count_++] = {.from = end, .value = 1};
}

BacklashRamp::Local BacklashRamp::at_knot_before(double s) const {
  std::size_t i = count_ - 1;
  while (i > 0 && s < knots_[i]) --i;
  return pieces_[i];
}

double BacklashRamp::at(double s) const {
  const Local piece = at_knot_before(s);
  const double way = s - piece.from;
  return piece.value + (piece.slope + (piece.bend / 2 + piece.twist * way / 6) * way) * way;
}

double BacklashRamp::slope(double s) const {
  const Local piece = at_knot_before(s);
  const double way = s - piece.from;
  return piece.slope + (piece.bend + piece.twist * way / 2) * way;
}

double BacklashRamp::second_derivative(double s) const {
  const Local piece = at_knot_before(s);
  return piece.bend + piece.twist * (s - piece.from);
}

}  // namespace passo
