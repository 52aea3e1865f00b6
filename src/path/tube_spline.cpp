#include "tube_spline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "euclid.hpp"

namespace passo {
namespace {

// Between the places that the sweeps watch the deviation may be a little more than there.
constexpr double share_of_tube = 0.98;
// What is left of the tube, at least, where vertices between those places stick out.
constexpr double least_share = 0.1;

// Steps shorter than this (mm) are none.
constexpr double no_step = 1e-12;

// Behind how many controls a stage works on the one before it; a control feels three on each side.
constexpr std::int64_t reach_of_control = 3;
constexpr std::int64_t lag = reach_of_control + 1;

bool moves_many_axes(const Curve& curve) {
  const Point steepest = curve.steepest();
  return std::any_of(steepest.values.begin() + 4, steepest.values.end(), [](double slope) { return slope != 0; });
}

}  // namespace

double TubeSpline::knot_at(std::int64_t k) const {
  if (k < 0) return 2 * knot_at(k + 1) - knot_at(k + 2);
  if (k >= knots_) return 2 * knot_at(k - 1) - knot_at(k - 2);
  return at(k).knot.s;
}

void TubeSpline::add(const Knot& knot) {
  if (closed_ || knots_ == 0) {
    knots_ = 0;
    controls_ = -1;
    taken_ = 0;
    closed_ = false;
    wide_ = false;
  }
  Site& site = at(knots_);
  site.knot = knot;
  site.place = piece(knot.piece).segment.curve.at(Mm(knot.along));
  site.checked = false;
  ++knots_;
  if (knots_ > 1) survey(at(knots_ - 2), site);
  if (knots_ > 2) advance();
}

void TubeSpline::close() {
  assert(knots_ >= 4);
  closed_ = true;
  at(knots_ - 1).reach = at(knots_ - 2).mid_reach;
  at(knots_ - 1).width = 0;
  while (controls_ <= knots_) advance();
  // Nothing more comes: each sweep and each check goes on to the end.
  const std::int64_t begun = controls_ - 1 - reach_of_control;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for (std::int64_t k = std::max<std::int64_t>(begun - lag * sweep + 1, 2); k <= knots_ - 3; ++k) relax(k);
  }
  const std::int64_t swept = begun - lag * sweeps - 1;
  for (int round = 0; round < checks; ++round) {
    for (std::int64_t k = std::max<std::int64_t>(swept - lag * round + 1, 0); k <= knots_ - 2; ++k) check(k);
  }
}

// One control more begins, and every sweep goes on by one.
void TubeSpline::advance() {
  if (controls_ == -1) {
    begin_control(-1);
    controls_ = 0;
  }
  begin_control(controls_);
  const std::int64_t ready = controls_ - reach_of_control;
  ++controls_;
  if (is_free(ready)) find_steps(ready);
  std::int64_t k = ready;
  for (int sweep = 0; sweep < sweeps && k >= 2; ++sweep, k -= lag) {
    if (is_free(k)) relax(k);
  }
  k = ready - lag * sweeps - 1;
  for (int round = 0; round < checks && k >= 0; ++round, k -= lag) check(k);
}

bool TubeSpline::next(Span& span) {
  const std::int64_t last_checked = controls_ - 1 - reach_of_control - lag * sweeps - 1 - lag * (checks - 1);
  const std::int64_t final = closed_ ? knots_ - 2 : last_checked - lag - 1;
  if (taken_ > final) return false;
  span.from = end_at(taken_);
  span.to = end_at(taken_ + 1);
  span.in_tube = is_in_tube(taken_);
  span.goes_on = (closed_ && taken_ == knots_ - 2) || is_in_tube(taken_ + 1);
  ++taken_;
  return true;
}

bool TubeSpline::is_in_tube(std::int64_t k) const {
  return at(k).checked || worst_of(k).excess <= 0;
}

// The ends of a stretch are the path's own, to the bit.
TubeSpline::End TubeSpline::end_at(std::int64_t k) const {
  const Site& site = at(k);
  End end{.knot = site.knot, .place = site.place, .tangent = {}, .deviation = 0};
  if (k == 0 || (closed_ && k == knots_ - 1)) {
    end.tangent = piece(site.knot.piece).segment.curve.tangent(Mm(site.knot.along));
    return end;
  }
  end.place = site.place + site.off;
  end.tangent = at(k - 1).control * site.slope[0] + site.control * site.slope[1] + at(k + 1).control * site.slope[2];
  end.deviation = length_of(site.off);
  return end;
}

// ---- the path -----------------------------------------------------------------------------------------------------

Point TubeSpline::path_at(std::uint64_t& number, double s) const {
  while (s > piece(number).end() && !piece(number).rest_after) ++number;
  const Piece& found = piece(number);
  return found.segment.curve.at(Mm(s - found.start));
}

void TubeSpline::survey(Site& site, const Site& next) {
  const double from = site.knot.s;
  const double to = next.knot.s;
  const double mid = (from + to) / 2;
  std::uint64_t number = site.knot.piece;
  site.width = to - from;
  site.mid_place = path_at(number, mid);
  site.tube = piece(site.knot.piece).tube;
  site.curvature = 0;
  for (std::uint64_t i = site.knot.piece; i <= next.knot.piece; ++i) {
    if (i > site.knot.piece && piece(i).start >= to) break;
    site.tube = std::min(site.tube, piece(i).tube);
    site.curvature = std::max(site.curvature, piece(i).segment.curve.curvature());
    wide_ = wide_ || moves_many_axes(piece(i).segment.curve);
  }
  site.slack[0] = slack_between(from, site.place, mid, site.mid_place, site.knot.piece, number);
  site.slack[1] = slack_between(mid, site.mid_place, to, next.place, number, next.knot.piece);

  const auto reach = [](double tube, double slack) {
    const double within = std::max(share_of_tube * tube - slack, least_share * tube);
    return within * within;
  };
  site.mid_reach = reach(site.tube, std::max(site.slack[0], site.slack[1]));
  site.reach = reach(site.tube, site.slack[0]);
  if (knots_ > 2) {
    const Site& before = at(knots_ - 3);
    site.reach = std::min(site.reach, reach(before.tube, before.slack[1]));
  }
}

// How far vertices between two places are from the chord.
double TubeSpline::slack_between(double from, const Point& from_place, double to, const Point& to_place,
                                 std::uint64_t first, std::uint64_t last) const {
  double slack = 0;
  for (std::uint64_t i = first; i < last; ++i) {
    const double vertex = piece(i).end();
    if (vertex <= from || vertex >= to) continue;
    const Point chord = from_place + (to_place - from_place) * ((vertex - from) / (to - from));
    slack = std::max(slack, distance(chord, piece(i).segment.curve.end()));
  }
  return slack;
}

// ---- controls ------------------------------------------------------------------------------------------------------

void TubeSpline::find_factors(std::int64_t k) {
  const double before2 = knot_at(k - 2);
  const double before = knot_at(k - 1);
  const double here = knot_at(k);
  const double after = knot_at(k + 1);
  const double after2 = knot_at(k + 2);
  const double both = after - before;
  const double left = (here - before) / both;
  const double right = (after - here) / both;
  const double in = 3 / (after - before2);
  const double out = 3 / (after2 - before);
  Site& site = at(k);
  site.slope = {-in * right, in * right - out * left, out * left};
  site.bend_of = {2 * in / both, -2 * (in + out) / both, 2 * out / both};
  site.value[0] = (after - here) * in / 3 * right;
  site.value[2] = (here - before) * out / 3 * left;
  site.value[1] = 1 - site.value[0] - site.value[2];
}

// What the steps of a free control need: its part in p'' at three knots and in the middles of four spans.
void TubeSpline::find_steps(std::int64_t k) {
  Site& site = at(k);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t knot = k - 1 + static_cast<std::int64_t>(i);
    const double weight = (at(knot - 1).width + at(knot).width) / 2;
    const double factor = at(knot).bend_of[2 - i];
    site.pull[i] = weight * factor;
    sum += weight * factor * factor;
  }
  for (double& pull : site.pull) pull /= sum;

  const auto part = [&](std::int64_t knot, double square) {
    const std::int64_t i = k - knot + 1;
    if (i < 0 || i > 2) return 0.0;
    const Site& at_knot = at(knot);
    const auto index = static_cast<std::size_t>(i);
    return at_knot.value[index] / 2 - at_knot.bend_of[index] * square / 16;
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const std::int64_t span = k - 2 + static_cast<std::int64_t>(i);
    const double square = at(span).width * at(span).width;
    site.mid[i] = part(span, square) + part(span + 1, square);
  }
}

// The control that a polynomial has: its blossom, here of the path's Taylor polynomial at a knot.
Point TubeSpline::taylor_control(const Knot& knot, std::int64_t k) const {
  const double a = knot_at(k - 1) - knot.s;
  const double b = knot_at(k) - knot.s;
  const double c = knot_at(k + 1) - knot.s;
  const Curve& curve = piece(knot.piece).segment.curve;
  const Mm along(knot.along);
  return curve.at(along) + curve.tangent(along) * ((a + b + c) / 3) +
         curve.second_derivative(along) * ((a * b + b * c + c * a) / 6);
}

// Where pieces meet nearby: of the parabola through three knots.
Point TubeSpline::secant_control(std::int64_t k) const {
  const Site& before = at(k - 1);
  const Site& here = at(k);
  const Site& after = at(k + 1);
  const double left = before.width;
  const double right = here.width;
  const Point slopes = (here.place - before.place) * (1 / left) + (after.place - here.place) * (1 / right);
  const auto bend = [&](const Site& site) {
    return piece(site.knot.piece).segment.curve.second_derivative(Mm(site.knot.along));
  };
  return here.place + slopes * ((right - left) / 6) + (bend(before) + bend(after)) * (-left * right / 12);
}

void TubeSpline::begin_control(std::int64_t k) {
  if (k >= 0 && k < knots_) find_factors(k);
  if (k <= 1) {
    at(k).control = taylor_control(at(0).knot, k);
  } else if (!is_free(k)) {
    at(k).control = taylor_control(at(knots_ - 1).knot, k);
  } else {
    const Knot& knot = at(k).knot;
    const Piece& around = piece(knot.piece);
    const bool alone = knot.along >= at(k - 1).width && around.length - knot.along >= at(k).width;
    at(k).control = alone ? taylor_control(knot, k) : secant_control(k);
  }
  if (k >= 1) measure_knot(k - 1);
  if (k >= 2) measure_middle(k - 2);
}

void TubeSpline::measure_knot(std::int64_t k) {
  Site& site = at(k);
  const Point& before = at(k - 1).control;
  const Point& after = at(k + 1).control;
  site.off = (before - site.place) * site.value[0] + (site.control - site.place) * site.value[1] +
             (after - site.place) * site.value[2];
  site.bend = (before - site.control) * site.bend_of[0] + (after - site.control) * site.bend_of[2];
}

void TubeSpline::measure_middle(std::int64_t k) {
  Site& site = at(k);
  const Site& next = at(k + 1);
  const double square = site.width * site.width;
  site.mid_off = (site.off + next.off) * 0.5 - (site.bend + next.bend) * (square / 16) +
                 ((site.place - site.mid_place) + (next.place - site.mid_place)) * 0.5;
}

// ---- sweeps --------------------------------------------------------------------------------------------------------

template <std::size_t axes>
void TubeSpline::move(std::int64_t k, const Point& step) {
  const auto add = [&](Point& to, double factor) {
    for (std::size_t i = 0; i < axes; ++i) to.values[i] += factor * step.values[i];
  };
  Site& site = at(k);
  add(site.control, 1);
  for (std::size_t i = 0; i < 3; ++i) {
    Site& knot = at(k - 1 + static_cast<std::int64_t>(i));
    add(knot.off, knot.value[2 - i]);
    add(knot.bend, knot.bend_of[2 - i]);
  }
  for (std::size_t i = 0; i < 4; ++i) at(k - 2 + static_cast<std::int64_t>(i)).checked = false;
  for (std::size_t i = 0; i < 4; ++i) add(at(k - 2 + static_cast<std::int64_t>(i)).mid_off, site.mid[i]);
}

template <std::size_t axes>
void TubeSpline::relax(std::int64_t k) {
  const Site& site = at(k);
  const Site& before = at(k - 1);
  const Site& after = at(k + 1);
  Point step;
  double square = 0;
  for (std::size_t i = 0; i < axes; ++i) {
    step.values[i] = -(site.pull[0] * before.bend.values[i] + site.pull[1] * site.bend.values[i] +
                       site.pull[2] * after.bend.values[i]);
    square += step.values[i] * step.values[i];
  }
  if (square < no_step * no_step) return;

  // The longest share of the step that leaves no place farther off than it may be, or than it is.
  double share = 1;
  const auto shorten = [&](const Point& off, double factor, double reach) {
    double now = 0;
    double along = 0;
    for (std::size_t i = 0; i < axes; ++i) {
      now += off.values[i] * off.values[i];
      along += off.values[i] * step.values[i];
    }
    const double a = factor * factor * square;
    const double b = factor * along;
    const double most = std::max(reach, now);
    if (now + share * (2 * b + share * a) <= most) return;
    share = std::max(0.0, (std::sqrt(std::max(b * b + a * (most - now), 0.0)) - b) / a);
  };
  shorten(before.off, before.value[2], before.reach);
  shorten(site.off, site.value[1], site.reach);
  shorten(after.off, after.value[0], after.reach);
  for (std::size_t i = 0; i < 4; ++i) {
    const Site& span = at(k - 2 + static_cast<std::int64_t>(i));
    shorten(span.mid_off, site.mid[i], span.mid_reach);
  }
  if (share == 0) return;
  if (share < 1) {
    for (double& value : step.values) value *= share;
  }
  move<axes>(k, step);
}

// ---- checks --------------------------------------------------------------------------------------------------------

// Between two places d apart the deviation e is at most the larger of both plus d²/8 of the largest |e''|. p'' is a
// straight line of s; the path's d²P/ds² is nothing on a line, and on an arc of the curvature c it leaves its chord by
// at most d²/8 c³. So |e''| is at most its larger end plus that.
TubeSpline::Worst TubeSpline::worst_of(std::int64_t k) const {
  const Site& site = at(k);
  const Site& next = at(k + 1);
  const double width = site.width;
  const double largest =
      std::sqrt(std::max({dot(site.off, site.off), dot(next.off, next.off), dot(site.mid_off, site.mid_off)}));
  const double bend = std::sqrt(std::max(dot(site.bend, site.bend), dot(next.bend, next.bend)));
  const double slack = std::max(site.slack[0], site.slack[1]);
  Worst worst;
  worst.excess = largest + slack + (bend + site.curvature) * width * width / 32 - site.tube;
  if (worst.excess <= 0) return worst;
  worst.excess = -site.tube;

  // Quarter by quarter, and at the vertices between.
  const Point slope =
      at(k - 1).control * site.slope[0] + site.control * site.slope[1] + at(k + 1).control * site.slope[2];
  const auto place_of = [&](const Piece& path, double u) {
    const Mm along(std::max(0.0, site.knot.s + u - path.start));
    const double cube = u * u * u / (6 * width);
    Place place;
    place.off = (site.place - path.segment.curve.at(along)) + site.off + slope * u + site.bend * (u * u / 2) +
                (next.bend - site.bend) * cube;
    place.off_bend = site.bend + (next.bend - site.bend) * (u / width) - path.segment.curve.second_derivative(along);
    return place;
  };
  double from = 0;
  int quarter = 1;
  for (std::uint64_t number = site.knot.piece; from < width && number <= next.knot.piece; ++number) {
    const Piece& path = piece(number);
    const double curvature = path.segment.curve.curvature();
    const double end = number < next.knot.piece ? std::min(path.end() - site.knot.s, width) : width;
    Place before = place_of(path, from);
    while (from < end) {
      const double to = std::min(end, width * quarter / 4);
      const Place after = place_of(path, to);
      const double from_off = length_of(before.off);
      const double to_off = length_of(after.off);
      const double square = (to - from) * (to - from) / 8;
      const double off_bend =
          std::sqrt(std::max(dot(before.off_bend, before.off_bend), dot(after.off_bend, after.off_bend)));
      const double between = square * (off_bend + square * curvature * curvature * curvature);
      const double excess = std::max(from_off, to_off) + between - path.tube;
      if (excess > worst.excess) {
        worst = from_off > to_off ? Worst{excess, from, before.off} : Worst{excess, to, after.off};
      }
      if (to >= width * quarter / 4) ++quarter;
      from = to;
      before = after;
    }
  }
  return worst;
}

void TubeSpline::check(std::int64_t k) {
  constexpr int tries = 4;
  for (int i = 0; i < tries && !at(k).checked; ++i) {
    const Worst worst = worst_of(k);
    if (worst.excess <= 0) {
      at(k).checked = true;
    } else {
      push_back(k, worst);
    }
  }
}

// What each of the four controls of a span does at a place in it.
std::array<double, 4> TubeSpline::weights_at(std::int64_t k, double along) const {
  const Site& site = at(k);
  const Site& next = at(k + 1);
  const double cube = along * along * along / (6 * site.width);
  const double square = along * along / 2 - cube;
  std::array<double, 4> weights{};
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] += site.value[i] + site.slope[i] * along + site.bend_of[i] * square;
    weights[i + 1] += next.bend_of[i] * cube;
  }
  return weights;
}

// Moves the controls the least way that takes the excess off.
void TubeSpline::push_back(std::int64_t k, const Worst& worst) {
  constexpr double a_little_more = 1e-3;  // of the tube
  const double off = length_of(worst.off);
  if (!(off > 0)) return;
  const std::array<double, 4> weights = weights_at(k, worst.along);
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (is_free(k - 1 + static_cast<std::int64_t>(i))) squares += weights[i] * weights[i];
  }
  if (!(squares > 0)) return;
  const double amount = std::min(worst.excess + a_little_more * at(k).tube, off);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::int64_t control = k - 1 + static_cast<std::int64_t>(i);
    if (is_free(control)) move<axis_count>(control, worst.off * (-amount / off * weights[i] / squares));
  }
}

}  // namespace passo
