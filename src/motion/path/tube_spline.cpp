#include "tube_spline.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "passo/geometry/euclid.hpp"

namespace passo {
namespace {

// Between the places that the sweeps watch, the deviation may be a little larger than at them. So the sweeps use only
// this share of the tube.
constexpr double share_of_tube = 0.99;
// Where vertices between those places stick out, the sweeps use less, but at least this share.
constexpr double least_share = 0.1;

// How many controls a stage works behind the stage before it. A control depends on three controls on each side.
constexpr std::int64_t reach_of_control = 3;
constexpr std::int64_t lag = reach_of_control + 1;

// Whether the direction at a stop is free. Where the spindle leads, a thread begins along the path.
bool may_turn(const Piece& piece) {
  return piece.segment.lock == SpindleLock::none && !KnotPlacer::is_slow(piece);
}

bool moves_more_than_xyz(const Curve& curve) {
  const Point steepest = curve.steepest();
  return std::any_of(steepest.values.begin() + 3, steepest.values.end(), [](double slope) { return slope != 0; });
}

}  // namespace

double TubeSpline::knot_at(std::int64_t k) const {
  if (k < 0) return 2 * at(0).t - at(-k).t;
  if (k >= knots_) return 2 * at(knots_ - 1).t - at(2 * (knots_ - 1) - k).t;
  return at(k).t;
}

void TubeSpline::add(const Knot& knot) {
  if (closed_ || knots_ == 0) {
    knots_ = 0;
    controls_ = -1;
    taken_ = 0;
    closed_ = false;
    wide_ = false;
    has_even_ = false;
    relaxation_.begin();
  }
  has_even_ = has_even_ || knot.is_even;
  relaxation_.make_room(knots_ + 2, taken_ - 1);
  begin_site(knot);
  if (knots_ == 0) begins_freely_ = knot.s == 0 && may_turn(piece(knot.piece));
  ++knots_;
  if (knots_ > 1) survey(at(knots_ - 2), at(knots_ - 1));
  if (knots_ > 2) advance();
}

void TubeSpline::begin_site(const Knot& knot) {
  Site& site = at(knots_);
  site.knot = knot;
  site.t = knot.s;
  site.pace = {};
  site.place = piece(knot.piece).segment.curve.at(Mm(knot.along));
  site.checked = false;
  site.per_change = 0;
  if (knots_ == 0) return;
  Site& before = at(knots_ - 1);
  before.pace = Pace::between(before.knot.rate, knot.rate, knot.s - before.knot.s);
  site.t = before.t + before.pace.width;
}

void TubeSpline::close() {
  assert(knots_ >= 4);
  closed_ = true;
  const Knot& end = at(knots_ - 1).knot;
  const Piece& last = piece(end.piece);
  ends_freely_ = last.rest_after && end.along >= last.length && may_turn(last);
  while (controls_ <= knots_) advance();
  if (turns_end(knots_ - 2)) find_steps(knots_ - 2);
  // Nothing more comes: each sweep and each check goes on to the end.
  const std::int64_t begun = controls_ - 1 - reach_of_control;
  for (int sweep = 0; sweep < (has_even_ ? sweeps_.even : sweeps_.all); ++sweep) {
    for (std::int64_t k = std::max<std::int64_t>(begun - lag * sweep + 1, 1); k <= knots_ - 2; ++k) {
      if (moves(k)) relax(k, sweep);
    }
  }
  const std::int64_t swept = begun - lag * sweeps_.even - 1;
  for (int round = 0; round < checks; ++round) {
    for (std::int64_t k = std::max<std::int64_t>(swept - lag * round + 1, 0); k <= knots_ - 2; ++k) check(k);
  }
}

// Begins one more control. Every sweep and every check goes on by one.
void TubeSpline::advance() {
  if (controls_ == -1) {
    begin_control(-1);
    controls_ = 0;
  }
  begin_control(controls_);
  const std::int64_t ready = controls_ - reach_of_control;
  ++controls_;
  if (moves(ready)) find_steps(ready);
  std::int64_t k = ready;
  const int sweeps = has_even_ ? sweeps_.even : sweeps_.all;
  for (int sweep = 0; sweep < sweeps && k >= 1; ++sweep, k -= lag) {
    if (moves(k)) relax(k, sweep);
  }
  k = ready - lag * sweeps_.even - 1;
  for (int round = 0; round < checks && k >= 0; ++round, k -= lag) check(k);
}

bool TubeSpline::next(Span& span) {
  const std::int64_t last_checked = controls_ - 1 - reach_of_control - lag * sweeps_.even - 1 - lag * (checks - 1);
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

// At the ends of a stretch, the place is that of the path, bit for bit. So is the tangent, unless it is free.
TubeSpline::End TubeSpline::end_at(std::int64_t k) const {
  const Site& site = at(k);
  End end{.knot = site.knot, .t = site.t, .place = site.place, .tangent = {}, .deviation = 0};
  if (k == 0 || (closed_ && k == knots_ - 1)) {
    const bool is_turned = k == 0 ? begins_freely_ : ends_freely_;
    end.tangent = is_turned ? slope_at(k) : piece(site.knot.piece).segment.curve.tangent(Mm(site.knot.along));
    return end;
  }
  const Point off = relaxation_.off(k);
  end.place = site.place + off;
  end.tangent = slope_at(k);
  end.deviation = length_of(off);
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
  const double mid = from + site.pace.distance(site.pace.width / 2);
  std::uint64_t number = site.knot.piece;
  site.mid_place = path_at(number, mid);
  site.tube = piece(site.knot.piece).tube;
  site.bend_of_path = 0;
  for (std::uint64_t i = site.knot.piece; i <= next.knot.piece; ++i) {
    if (i > site.knot.piece && piece(i).start >= to) break;
    site.tube = std::min(site.tube, piece(i).tube);
    site.bend_of_path = std::max(site.bend_of_path, site.pace.bend_of(piece(i).segment.curve.curvature()));
    wide_ = wide_ || moves_more_than_xyz(piece(i).segment.curve);
  }
  site.slack[0] = slack_between(from, site.place, mid, site.mid_place, site.knot.piece, number);
  site.slack[1] = slack_between(mid, site.mid_place, to, next.place, number, next.knot.piece);

  const auto reach = [](double tube, double slack) {
    return std::max(share_of_tube * tube - slack, least_share * tube);
  };
  const std::int64_t k = knots_ - 2;
  relaxation_.set_middle_reach(k, reach(site.tube, std::max(site.slack[0], site.slack[1])));
  const double behind = k > 0 ? reach(at(k - 1).tube, at(k - 1).slack[1]) : site.tube;
  relaxation_.set_reach(k, std::min(behind, reach(site.tube, site.slack[0])));
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
  site.bend = {2 * in / both, -2 * (in + out) / both, 2 * out / both};
  site.value[0] = (after - here) * in / 3 * right;
  site.value[2] = (here - before) * out / 3 * left;
  site.value[1] = 1 - site.value[0] - site.value[2];
}

// Finds what the steps of a free control need: its effect on p and p'' at three knots, and on p in the middles of four
// spans.
void TubeSpline::find_steps(std::int64_t k) {
  Relaxation::Factors factors;
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t knot = k - 1 + static_cast<std::int64_t>(i);
    const double before = has_span(knot - 1) ? at(knot - 1).pace.width : at(knot).pace.width;
    const double after = has_span(knot) ? at(knot).pace.width : before;
    const double weight = at(knot).knot.weight * (before + after) / 2;
    factors.off[i] = at(knot).value[2 - i];
    factors.bend[i] = at(knot).bend[2 - i];
    factors.pull[i] = weight * factors.bend[i];
    sum += factors.pull[i] * factors.bend[i];
  }
  if (turns_end(k)) {  // with the control beyond the end, neither place nor p'' at the end changes
    const std::size_t end = k == 1 ? 0 : 2;
    sum -= factors.pull[end] * factors.bend[end];
    factors.pull[end] = 0;
    factors.bend[end] = 0;
    factors.off[end] = 0;
  }
  for (double& pull : factors.pull) pull /= sum;
  if (bends_slowly_) find_change_pull(k, factors);

  const auto part = [&](std::size_t i, double square) { return factors.off[i] / 2 - factors.bend[i] * square / 16; };
  for (std::size_t i = 0; i < 4; ++i) {
    const std::int64_t span = k - 2 + static_cast<std::int64_t>(i);
    if (!has_span(span)) continue;
    const double width = at(span).pace.width;
    if (i > 0) factors.middle[i] += part(i - 1, width * width);
    if (i < 3) factors.middle[i] += part(i, width * width);
  }
  relaxation_.set_factors(k, factors);
}

// The sum that slow bending makes least is, over the spans k-2 to k+1, the width times |p'''|² times the span's weight.
// p''' is the difference of p'' at a span's ends, divided by the width. `change_pull` gives the sum's derivative by
// control k, divided by the second derivative.
void TubeSpline::find_change_pull(std::int64_t k, Relaxation::Factors& factors) const {
  const std::array<double, 5> bend = {0, factors.bend[0], factors.bend[1], factors.bend[2], 0};  // at knots k-2 to k+2
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const double change = bend[i + 1] - bend[i];
    const std::int64_t number = k - 2 + static_cast<std::int64_t>(i);
    if (!has_span(number)) continue;
    const Site& span = at(number);
    const double weight = span.knot.change_weight * change / span.pace.width;
    factors.change_pull[i + 1] += weight;
    factors.change_pull[i] -= weight;
    sum += weight * change;
  }
  for (double& pull : factors.change_pull) pull /= sum;
}

// The control of a polynomial is its blossom. Here the polynomial is the path's Taylor polynomial at a knot.
Point TubeSpline::taylor_control(std::int64_t number, std::int64_t k) const {
  const Knot& knot = at(number).knot;
  const double t = at(number).t;
  const double a = knot_at(k - 1) - t;
  const double b = knot_at(k) - t;
  const double c = knot_at(k + 1) - t;
  const Curve& curve = piece(knot.piece).segment.curve;
  const Mm along(knot.along);
  return curve.at(along) + curve.tangent(along) * ((a + b + c) / 3) +
         curve.second_derivative(along) * ((a * b + b * c + c * a) / 6);
}

// The control where pieces meet nearby: a blossom as in taylor_control(). Its slope is the mean of the slopes of the
// chords to the two knots beside. Its second derivative is the mean of the path's at these knots.
Point TubeSpline::secant_control(std::int64_t k) const {
  const Site& before = at(k - 1);
  const Site& here = at(k);
  const Site& after = at(k + 1);
  const double left = before.pace.width;
  const double right = here.pace.width;
  const Point slopes = (here.place - before.place) * (1 / left) + (after.place - here.place) * (1 / right);
  const auto bend = [&](const Site& site) {
    const Curve& curve = piece(site.knot.piece).segment.curve;
    const Mm along(site.knot.along);
    const double rate = site.knot.rate;
    return curve.second_derivative(along) * (rate * rate) + curve.tangent(along) * site.pace.quickening;
  };
  return here.place + slopes * ((right - left) / 6) + (bend(before) + bend(after)) * (-left * right / 12);
}

void TubeSpline::begin_control(std::int64_t k) {
  if (k >= 0 && k < knots_) find_factors(k);
  relaxation_.set_control(k, first_control(k));
  if (k >= 1) measure_knot(k - 1);
  if (k >= 2) measure_middle(k - 2);
}

Point TubeSpline::first_control(std::int64_t k) const {
  if (k <= 1) return taylor_control(0, k);
  if (!is_free(k)) return taylor_control(knots_ - 1, k);
  const Knot& knot = at(k).knot;
  const Pace& before = at(k - 1).pace;
  const Pace& after = at(k).pace;
  const bool alone = knot.along >= before.width && piece(knot.piece).length - knot.along >= after.width;
  return alone && before.is_even() && after.is_even() ? taylor_control(k, k) : secant_control(k);
}

void TubeSpline::measure_knot(std::int64_t k) {
  const Site& site = at(k);
  const Point before = relaxation_.control(k - 1);
  const Point here = relaxation_.control(k);
  const Point after = relaxation_.control(k + 1);
  relaxation_.set_off(k, (before - site.place) * site.value[0] + (here - site.place) * site.value[1] +
                             (after - site.place) * site.value[2]);
  relaxation_.set_bend(k, (before - here) * site.bend[0] + (after - here) * site.bend[2]);
}

void TubeSpline::measure_middle(std::int64_t k) {
  const Site& site = at(k);
  const Point offs = relaxation_.off(k) + relaxation_.off(k + 1);
  const Point bends = relaxation_.bend(k) + relaxation_.bend(k + 1);
  const Point chord = (site.place - site.mid_place) + (at(k + 1).place - site.mid_place);
  relaxation_.set_middle_off(k, (offs + chord) * 0.5 - bends * (site.pace.width * site.pace.width / 16));
}

// ---- checks --------------------------------------------------------------------------------------------------------

Point TubeSpline::slope_at(std::int64_t k) const {
  const Three& factors = at(k).slope;
  return relaxation_.control(k - 1) * factors[0] + relaxation_.control(k) * factors[1] +
         relaxation_.control(k + 1) * factors[2];
}

TubeSpline::SpanForm TubeSpline::form_of(std::int64_t k) const {
  SpanForm form{.off = relaxation_.off(k), .slope = slope_at(k), .bend = relaxation_.bend(k), .change = {}};
  form.change = (relaxation_.bend(k + 1) - form.bend) * (1 / at(k).pace.width);
  return form;
}

TubeSpline::Place TubeSpline::place_in(const Site& site, const SpanForm& form, const Piece& path, double u) {
  const Mm along(std::max(0.0, site.knot.s + site.pace.distance(u) - path.start));
  const Curve& curve = path.segment.curve;
  const double rate = site.pace.rate_at(u);
  const Point path_bend = curve.second_derivative(along) * (rate * rate) + curve.tangent(along) * site.pace.quickening;
  return {.along = u,
          .off = (site.place - curve.at(along)) + form.off + (form.slope + form.bend * (u / 2)) * u +
                 form.change * (u * u * u / 6),
          .off_bend = form.bend + form.change * u - path_bend};
}

// Between two places d apart, the deviation e is at most the larger of its two ends plus d²/8 of the largest |e''|. p''
// is linear in t. The path's P'' leaves its chord by at most d²/8 |P''''|. (At an even pace |P''''| is c³ on an arc of
// the curvature c, and 0 on a line.) So |e''| is at most the larger of its two ends plus that.
TubeSpline::Worst TubeSpline::worse_between(const Place& from, const Place& to, const Piece& path, const Pace& pace) {
  const double curl = pace.curl_of(path.segment.curve.curvature());
  const double square = (to.along - from.along) * (to.along - from.along) / 8;
  const double off_bend = std::max(length_of(from.off_bend), length_of(to.off_bend));
  const double between = square * (off_bend + square * curl);
  const double from_off = length_of(from.off);
  const double to_off = length_of(to.off);
  const Place& worse = from_off > to_off ? from : to;
  return {.excess = std::max(from_off, to_off) + between - path.tube, .along = worse.along, .off = worse.off};
}

// A rough bound is often enough; else the span is gone through quarter by quarter, and from vertex to vertex. If the
// bound between these places says more than the places themselves, smaller parts tell.
TubeSpline::Worst TubeSpline::worst_of(std::int64_t k) const {
  const Site& site = at(k);
  const double width = site.pace.width;
  const double off = std::max(
      {length_of(relaxation_.off(k)), length_of(relaxation_.off(k + 1)), length_of(relaxation_.middle_off(k))});
  const double bend = std::max(length_of(relaxation_.bend(k)), length_of(relaxation_.bend(k + 1)));
  const double slack = std::max(site.slack[0], site.slack[1]);
  Worst worst;
  worst.excess = off + slack + (bend + site.bend_of_path) * width * width / 32 - site.tube;
  for (const int parts : {4, 16}) {
    if (worst.excess > 0) worst = worst_in_parts(k, parts);
    if (length_of(worst.off) > site.tube) break;
  }
  return worst;
}

TubeSpline::Worst TubeSpline::worst_in_parts(std::int64_t k, int parts) const {
  const Site& site = at(k);
  const double width = site.pace.width;
  Worst worst;
  worst.excess = -site.tube;
  const SpanForm form = form_of(k);
  const std::uint64_t last = at(k + 1).knot.piece;
  double from = 0;
  int part = 1;
  for (std::uint64_t number = site.knot.piece; from < width && number <= last; ++number) {
    const Piece& path = piece(number);
    const double end = number < last ? std::min(site.pace.reaches(path.end() - site.knot.s), width) : width;
    Place before = place_in(site, form, path, from);
    while (from < end) {
      const double to = std::min(end, width * part / parts);
      const Place after = place_in(site, form, path, to);
      const Worst here = worse_between(before, after, path, site.pace);
      if (here.excess > worst.excess) worst = here;
      if (to >= width * part / parts) ++part;
      from = to;
      before = after;
    }
  }
  return worst;
}

void TubeSpline::move(std::int64_t k, const Point& step) {
  relaxation_.move(k, step);
  for (std::int64_t span = k - 2; span <= k + 1; ++span) {
    if (has_span(span)) at(span).checked = false;
  }
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

// The effect that each of a span's four controls has at a place in the span.
std::array<double, 4> TubeSpline::weights_at(std::int64_t k, double along) const {
  const Site& site = at(k);
  const Site& next = at(k + 1);
  const double cube = along * along * along / (6 * site.pace.width);
  const double square = along * along / 2 - cube;
  std::array<double, 4> weights{};
  for (std::size_t i = 0; i < 3; ++i) {
    weights[i] += site.value[i] + site.slope[i] * along + site.bend[i] * square;
    weights[i + 1] += next.bend[i] * cube;
  }
  return weights;
}

// Makes the smallest move of the controls that removes the excess.
void TubeSpline::push_back(std::int64_t k, const Worst& worst) {
  constexpr double a_little_more = 1e-3;  // of the tube
  const double off = length_of(worst.off);
  if (!(off > 0)) return;
  std::array<double, 4> weights = weights_at(k, worst.along);
  if (k == 0 && begins_freely_) weights[2] -= weights[0];
  if (closed_ && k == knots_ - 2 && ends_freely_) weights[1] -= weights[3];
  double squares = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (moves(k - 1 + static_cast<std::int64_t>(i))) squares += weights[i] * weights[i];
  }
  if (!(squares > 0)) return;
  const double amount = std::min(worst.excess + a_little_more * at(k).tube, off);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::int64_t control = k - 1 + static_cast<std::int64_t>(i);
    if (!moves(control)) continue;
    const Point step = worst.off * (-amount / off * weights[i] / squares);
    move(control, step);
    if (turns_end(control)) turn_end(control, step);
  }
}

}  // namespace passo
