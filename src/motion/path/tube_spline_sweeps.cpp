// The steps of the sweeps.
#include "tube_spline.hpp"

namespace passo {
namespace {

// Changes of p'' (1/mm²) smaller than this are rounding.
constexpr double no_change_of_bend = 1e-9;

// Whether the sweep slides control points along the tube.
bool slides(int sweep) {
  constexpr int slides_each = 3;
  return (sweep - TubeSpline::slow_bending_sweeps.first) % slides_each == slides_each - 1;
}

}  // namespace

void TubeSpline::relax(std::int64_t k, int sweep) {
  if (sweep >= sweeps_.all && !at(k).knot.is_even) return;
  const Point before = turns_end(k) ? relaxation_.control(k) : Point{};
  wide_ ? step<axis_count>(k, sweep) : step<3>(k, sweep);
  if (turns_end(k)) turn_end(k, relaxation_.control(k) - before);
}

template <std::size_t axes>
void TubeSpline::step(std::int64_t k, int sweep) {
  const bool is_on_curve = !bends_slowly_ && piece(at(k).knot.piece).is_fitted;
  if (sweep < sweeps_.first || is_on_curve) {
    relaxation_.relax_bending<axes>(k);
  } else if (at(k).knot.is_even && sweep >= sweeps_.before_eighth) {
    step_in_even_row<axes, Relaxation::Power::eighth>(k, sweep);
  } else if (at(k).knot.is_even && sweep >= sweeps_.before_fourth) {
    step_in_even_row<axes, Relaxation::Power::fourth>(k, sweep);
  } else if (bends_slowly_) {
    relaxation_.relax_change<axes>(k, slides(sweep));
  } else {
    relaxation_.relax_highest_bending<axes, Relaxation::Power::fourth>(k);
  }
}

template <std::size_t axes, Relaxation::Power power>
void TubeSpline::step_in_even_row(std::int64_t k, int sweep) {
  if (bends_slowly_) {
    relaxation_.relax_highest_change<axes, power>(k, weights_in_even_row<power>(k), slides(sweep));
  } else {
    relaxation_.relax_highest_bending<axes, power>(k);
  }
}

// The weights of the spans k-2 to k+1. The mean of a span is taken before the first step that needs it, over the spans
// k-2 to k+2. All sweeps before have passed these, and no sweep behind has reached them.
template <Relaxation::Power power>
Relaxation::Four TubeSpline::weights_in_even_row(std::int64_t k) {
  Relaxation::Four weights{};
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::int64_t span = k - 2 + static_cast<std::int64_t>(i);
    if (!has_span(span)) continue;
    Site& site = at(span);
    const double width = site.pace.width;
    if (site.per_change == 0) site.per_change = 1 / (mean_change_around(k) * width * width);
    const double scale = site.per_change;
    weights[i] = site.knot.change_weight / width * (power == Relaxation::Power::fourth ? scale : scale * scale * scale);
  }
  return weights;
}

double TubeSpline::mean_change_around(std::int64_t k) const {
  double sum = no_change_of_bend * no_change_of_bend;
  double widths = 0;
  for (std::int64_t span = k - 2; span <= k + 2; ++span) {
    if (!has_span(span)) continue;
    const double width = at(span).pace.width;
    sum += relaxation_.square_of_change(span) / width;
    widths += width;
  }
  return sum / widths;
}

// The control beyond the end goes the other way.
void TubeSpline::turn_end(std::int64_t k, const Point& step) {
  const std::int64_t beyond = k == 1 ? -1 : knots_;
  relaxation_.set_control(beyond, relaxation_.control(beyond) - step);
}

}  // namespace passo
