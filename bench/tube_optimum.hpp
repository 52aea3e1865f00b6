// The fastest motion inside a tolerance tube of two axes, as a convex program over samples of time.
//
// The motion is p[0] to p[n] at equal time steps h, from stop to stop. Each sample belongs to a leg of the path and
// deviates from it by at most the tolerance; the last sample of a leg is that close to the corner, which the motion
// must not cut off. The limits of velocity, acceleration and jerk apply to the first, second and third differences of
// each axis:
//
//     |p[k+1] - p[k]| <= v h,   |p[k+1] - 2 p[k] + p[k-1]| <= a h²,   |p[k+2] - 3 p[k+1] + 3 p[k] - p[k-1]| <= j h³
//
// At both ends the motion is stopped: 2 |p[1] - p[0]| <= a h², 6 |p[1] - p[0]| <= j h³, and p[-1] = p[0]. In addition
// to the samples, the unknown is b, the power of h in the highest limit: in b, the limits are linear or concave, so the
// set is convex. The minimum b gives the minimum time n h. Newton's method finds it along the central path of the
// logarithmic barrier; its matrix is a band matrix plus the column of b. The tube is slightly too wide at the ends of
// the legs (an octagon about the circle), so the result is a lower bound except for the discretisation of time and the
// number of samples of each leg, which find_optimum() varies.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <numeric>
#include <vector>

namespace passo::bench {

struct Place {
  double x = 0;
  double y = 0;
};

struct TubeLimits {
  double tolerance = 0.01;    // mm
  double acceleration = 500;  // mm/s², of each axis
  double velocity = 100;      // mm/s, of each axis
  double jerk = 0;            // mm/s³, of each axis; 0: no limit
};

class TubeProgram {
 public:
  // `samples`: number of samples of each leg.
  TubeProgram(const std::vector<Place>& corners, const std::vector<int>& samples, const TubeLimits& limits)
      : limits_(limits) {
    for (std::size_t leg = 0; leg + 1 < corners.size(); ++leg) {
      for (int i = leg == 0 ? 0 : 1; i <= samples[leg]; ++i) {
        const double share = static_cast<double>(i) / samples[leg];
        z_.push_back(corners[leg].x + (corners[leg + 1].x - corners[leg].x) * share);
        z_.push_back(corners[leg].y + (corners[leg + 1].y - corners[leg].y) * share);
        legs_.push_back(leg);
      }
    }
    corners_ = corners;
    begin_inside();
  }

  // Returns the minimum time, in seconds.
  double solve() {
    const double constraints = static_cast<double>(20 * legs_.size());
    // On the central path, b exceeds the minimum by at most constraints / weight.
    for (double weight = constraints; constraints > 1e-5 * weight * b_; weight *= 6) {
      for (int i = 0; i < 100 && newton_step(weight * 6) > 1e-2; ++i) {
      }
    }
    return static_cast<double>(legs_.size() - 1) * step();
  }
  // x and y of each sample.
  const std::vector<double>& samples() const { return z_; }

 private:
  static constexpr std::size_t band = 7;  // a constraint involves four samples of two axes
  // Returns the element `left` columns before the diagonal.
  double& element(std::size_t row, std::size_t left) { return matrix_[row * (band + 1) + left]; }
  double element(std::size_t row, std::size_t left) const { return matrix_[row * (band + 1) + left]; }

  // A constraint: the sum of the factors times the variables, plus `constant`, plus the limit for the derivative of
  // this order, is positive.
  struct Term {
    std::size_t variable;
    double factor;
  };
  using Terms = std::initializer_list<Term>;
  template <class Use>
  void each_limit(const Use& use) const {
    const std::size_t last = legs_.size() - 1;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto var = [&](std::size_t k) { return 2 * k + axis; };
      for (const double sign : {1.0, -1.0}) {
        const auto difference = [&](std::size_t from, std::size_t to, double times, int order) {
          use(Terms{{var(to), times * sign}, {var(from), -times * sign}}, order);
        };
        for (std::size_t k = 0; k < last; ++k) difference(k, k + 1, 1, 1);
        difference(0, 1, 2, 2);
        difference(last, last - 1, 2, 2);
        for (std::size_t k = 1; k < last; ++k) {
          use(Terms{{var(k - 1), sign}, {var(k), -2 * sign}, {var(k + 1), sign}}, 2);
        }
        if (limits_.jerk == 0) continue;
        difference(0, 1, 6, 3);
        difference(last, last - 1, 6, 3);
        use(Terms{{var(0), 2 * sign}, {var(1), -3 * sign}, {var(2), sign}}, 3);
        use(Terms{{var(last), 2 * sign}, {var(last - 1), -3 * sign}, {var(last - 2), sign}}, 3);
        for (std::size_t k = 1; k + 2 <= last; ++k) {
          use(Terms{{var(k - 1), -sign}, {var(k), 3 * sign}, {var(k + 1), -3 * sign}, {var(k + 2), sign}}, 3);
        }
      }
    }
  }
  template <class Use>
  void each_side(const Use& use) const {
    const double slanted = std::sqrt(0.5);
    for (std::size_t k = 1; k + 1 < legs_.size(); ++k) {
      const Place& from = corners_[legs_[k]];
      const Place& to = corners_[legs_[k] + 1];
      const double length = std::hypot(to.x - from.x, to.y - from.y);
      const double tx = (to.x - from.x) / length;
      const double ty = (to.y - from.y) / length;
      const bool meets = k + 1 < legs_.size() && legs_[k + 1] != legs_[k];
      const auto side = [&](double nx, double ny, double beyond) {
        const double most = beyond + nx * from.x + ny * from.y + limits_.tolerance;
        use(Terms{{2 * k, -nx}, {2 * k + 1, -ny}}, most);
      };
      side(-ty, tx, 0);
      side(ty, -tx, 0);
      side(tx, ty, length);
      side(-tx, -ty, meets ? -length : 0);
      for (const double turn : {1.0, -1.0}) {
        const double nx = slanted * (tx - turn * ty);
        const double ny = slanted * (ty + turn * tx);
        side(nx, ny, slanted * length);
        const double bx = slanted * (-tx - turn * ty);
        const double by = slanted * (-ty + turn * tx);
        side(bx, by, meets ? -slanted * length : 0);
      }
    }
  }

  // Returns the limit of the derivative of this order, multiplied by the time step to the power of the order.
  double room(int order) const { return limit(order) * std::pow(step(), order); }
  double highest_order() const { return limits_.jerk > 0 ? 3 : 2; }
  double step() const { return first_step_ * std::pow(b_, 1 / highest_order()); }  // in seconds
  double limit(int order) const {
    return order == 1 ? limits_.velocity : order == 2 ? limits_.acceleration : limits_.jerk;
  }
  std::array<double, 4> rooms() const { return {0, room(1), room(2), room(3)}; }

  void begin_inside() {
    first_step_ = 0;
    b_ = 1;
    each_limit([&](Terms terms, int order) {
      const double needed = std::pow(std::abs(sum_of(terms)) / limit(order), 1.0 / order);
      first_step_ = std::max(first_step_, 1.2 * needed);
    });
  }

  double sum_of(Terms terms) const {
    double sum = 0;
    for (const Term& term : terms) sum += term.factor * z_[term.variable];
    return sum;
  }

  // Returns the function that Newton's method minimises: weight b - the sum of the logarithms of all slacks. Infinite
  // outside.
  double merit(double weight) const {
    constexpr double outside = std::numeric_limits<double>::infinity();
    if (!(b_ > 0)) return outside;
    const std::array<double, 4> most = rooms();
    double sum = weight * b_;
    double product = 1;  // product of slacks: one logarithm for many
    const auto take = [&](double slack) {
      if (!(slack > 0)) {
        sum = outside;
        return;
      }
      product *= slack;
      if (product < 1e-200 || product > 1e200) {
        sum -= std::log(product);
        product = 1;
      }
    };
    each_limit([&](Terms terms, int order) { take(sum_of(terms) + most[static_cast<std::size_t>(order)]); });
    each_side([&](Terms terms, double constant) { take(sum_of(terms) + constant); });
    return sum - std::log(product);
  }

  // Computes one step. Returns half the square of Newton's decrement.
  double newton_step(double weight) {
    const std::size_t n = z_.size();
    matrix_.assign(n * (band + 1), 0);
    column_.assign(n, 0);
    gradient_.assign(n, 0);
    double corner = 0;
    double gradient_b = weight;
    const std::array<double, 4> most = rooms();
    const auto add = [&](Terms terms, double slack, double slope, double bend) {
      slack += sum_of(terms);
      const double inverse = 1 / slack;
      for (const Term& one : terms) {
        gradient_[one.variable] -= one.factor * inverse;
        column_[one.variable] += one.factor * slope * inverse * inverse;
        for (const Term& other : terms) {
          if (other.variable > one.variable) continue;
          element(one.variable, one.variable - other.variable) += one.factor * other.factor * inverse * inverse;
        }
      }
      gradient_b -= slope * inverse;
      corner += slope * slope * inverse * inverse - bend * inverse;
    };
    each_limit([&](Terms terms, int order) {
      const double power = order / highest_order();
      const double room = most[static_cast<std::size_t>(order)];
      add(terms, room, power * room / b_, power * (power - 1) * room / (b_ * b_));
    });
    each_side([&](Terms terms, double constant) { add(terms, constant, 0, 0); });
    for (const std::size_t fixed : {std::size_t{0}, std::size_t{1}, n - 2, n - 1}) hold(fixed);

    factor();
    std::vector<double> by_b = column_;
    std::vector<double> step = gradient_;
    substitute(by_b);
    substitute(step);
    const double pivot = corner - std::inner_product(column_.begin(), column_.end(), by_b.begin(), 0.0);
    const double step_b = -(gradient_b - std::inner_product(column_.begin(), column_.end(), step.begin(), 0.0)) / pivot;
    for (std::size_t i = 0; i < n; ++i) step[i] = -step[i] - by_b[i] * step_b;
    const double decrement =
        -(std::inner_product(gradient_.begin(), gradient_.end(), step.begin(), 0.0) + gradient_b * step_b) / 2;
    take(step, step_b, decrement, weight);
    return decrement;
  }

  // Moves along the step as far as the merit decreases by a fraction of the predicted decrease.
  void take(const std::vector<double>& step, double step_b, double decrement, double weight) {
    constexpr double promised = 0.1;
    const std::vector<double> z = z_;
    const double b = b_;
    const double before = merit(weight);
    for (double share = 1; share > 1e-12; share /= 2) {
      for (std::size_t i = 0; i < z.size(); ++i) z_[i] = z[i] + share * step[i];
      b_ = b + share * step_b;
      if (merit(weight) <= before - promised * share * 2 * decrement + 1e-9 * std::abs(before)) return;
    }
    z_ = z;
    b_ = b;
  }

  // Fixes a variable.
  void hold(std::size_t i) {
    for (std::size_t below = i; below < std::min(i + band + 1, z_.size()); ++below) element(below, below - i) = 0;
    for (std::size_t left = 1; left <= band; ++left) element(i, left) = 0;
    element(i, 0) = 1;
    gradient_[i] = 0;
    column_[i] = 0;
  }

  // Computes the Cholesky factors of the band in place: element(i, d) is d columns before the diagonal.
  void factor() {
    for (std::size_t i = 0; i < z_.size(); ++i) {
      for (std::size_t d = std::min(band, i) + 1; d-- > 0;) {
        const std::size_t j = i - d;
        double sum = element(i, d);
        for (std::size_t e = d + 1; e <= std::min(band, i) && e - d <= band; ++e) {
          sum -= element(i, e) * element(j, e - d);
        }
        element(i, d) = d == 0 ? std::sqrt(std::max(sum, 1e-300)) : sum / element(j, 0);
      }
    }
  }
  void substitute(std::vector<double>& right) const {
    for (std::size_t i = 0; i < right.size(); ++i) {
      for (std::size_t d = 1; d <= std::min(band, i); ++d) right[i] -= element(i, d) * right[i - d];
      right[i] /= element(i, 0);
    }
    for (std::size_t i = right.size(); i-- > 0;) {
      for (std::size_t d = 1; d <= band && i + d < right.size(); ++d) right[i] -= element(i + d, d) * right[i + d];
      right[i] /= element(i, 0);
    }
  }

  TubeLimits limits_;
  std::vector<Place> corners_;
  std::vector<double> z_;  // x and y of each sample
  std::vector<std::size_t> legs_;
  double first_step_ = 0;  // in seconds, for b = 1
  double b_ = 1;
  std::vector<double> matrix_;
  std::vector<double> column_;
  std::vector<double> gradient_;
};

// Returns the minimum time through the corners, where the inner legs are equal and so are the two outer ones. The
// number of samples of the outer legs is first determined with few samples.
inline double find_optimum(const std::vector<Place>& corners, const TubeLimits& limits, int samples) {
  const std::size_t legs = corners.size() - 1;
  const auto time_with = [&](int inner, int outer) {
    std::vector<int> counts(legs, inner);
    counts.front() = outer;
    counts.back() = outer;
    return TubeProgram(corners, counts, limits).solve();
  };
  if (legs == 2) return time_with(samples, samples);
  constexpr int coarse = 5;
  const int few = samples / coarse;
  int outer = few;
  double best = time_with(few, outer);
  for (const int turn : {1, -1}) {  // the time decreases and then increases
    for (double time = time_with(few, outer + turn); time < best; time = time_with(few, outer + turn)) {
      best = time;
      outer += turn;
    }
  }
  outer *= coarse;
  best = time_with(samples, outer);
  for (const int turn : {1, -1}) {
    for (double time = time_with(samples, outer + turn); time < best; time = time_with(samples, outer + turn)) {
      best = time;
      outer += turn;
    }
  }
  return best;
}

}  // namespace passo::bench
