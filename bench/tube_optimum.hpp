// The fastest motion inside a tube of two axes, as a convex program over samples of time.
//
// The motion is p[0] to p[n] at equal steps of time h, from rest to rest. Each sample belongs to a leg of the path and
// is at most the tolerance beside it; the last sample of a leg is that near to the corner, which the motion may not cut
// off. With A = a h², the limit of acceleration is linear:
//
//     |p[k+1] - 2 p[k] + p[k-1]| <= A   for each axis,   2 |p[1] - p[0]| <= A   and alike at the end.
//
// The limit of velocity, |p[k+1] - p[k]| <= v h = v sqrt(A / a), is concave in A, so that the set stays convex. The
// least A gives the least time n sqrt(A / a). Newton's method finds it along the central path of the logarithmic
// barrier; its matrix is a band beside the column of A. The tube is taken a little too wide at the legs' ends (an
// octagon about the circle), so the result is a lower bound but for the steps of time, and for how many samples each
// leg has: find_optimum() tries that.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
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
};

class TubeProgram {
 public:
  // `samples`: how many each leg has.
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

  // The least time, in seconds.
  double solve() {
    const double constraints = static_cast<double>(16 * legs_.size());
    for (double weight = constraints / a_; weight < constraints / a_ * 1e5; weight *= 4) {
      for (int step = 0; step < 60 && newton_step(weight) > 1e-3; ++step) {
      }
    }
    return static_cast<double>(legs_.size() - 1) * std::sqrt(a_ / limits_.acceleration);
  }

 private:
  static constexpr std::size_t band = 5;  // a constraint touches three samples of two axes
  // The element `left` places before the diagonal.
  double& element(std::size_t row, std::size_t left) { return matrix_[row * (band + 1) + left]; }
  double element(std::size_t row, std::size_t left) const { return matrix_[row * (band + 1) + left]; }

  // A constraint: the sum of the factors times the variables, plus `constant` plus room(A), is positive.
  struct Term {
    std::size_t variable;
    double factor;
  };
  template <class Use>
  void each_constraint(const Use& use) const {
    const std::size_t last = legs_.size() - 1;
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const auto var = [&](std::size_t k) { return 2 * k + axis; };
      for (const double sign : {1.0, -1.0}) {
        for (std::size_t k = 0; k <= last; ++k) {
          if (k == 0) {
            use(std::array<Term, 3>{{{var(1), 2 * sign}, {var(0), -2 * sign}, {var(0), 0}}}, 0.0, true);
          } else if (k == last) {
            use(std::array<Term, 3>{{{var(k - 1), 2 * sign}, {var(k), -2 * sign}, {var(k), 0}}}, 0.0, true);
          } else {
            use(std::array<Term, 3>{{{var(k - 1), sign}, {var(k), -2 * sign}, {var(k + 1), sign}}}, 0.0, true);
          }
          if (k < last) use(std::array<Term, 3>{{{var(k), sign}, {var(k + 1), -sign}, {var(k), 0}}}, 0.0, false);
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
        use(std::array<Term, 3>{{{2 * k, -nx}, {2 * k + 1, -ny}, {2 * k, 0}}}, most);
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

  double step_room() const { return limits_.velocity * std::sqrt(a_ / limits_.acceleration); }

  void begin_inside() {
    double most = 0;
    for (std::size_t i = 2; i + 2 < z_.size(); ++i) most = std::max(most, std::abs(z_[i - 2] - 2 * z_[i] + z_[i + 2]));
    double stride = 0;
    for (std::size_t i = 0; i + 2 < z_.size(); ++i) stride = std::max(stride, std::abs(z_[i + 2] - z_[i]));
    const double root = stride / limits_.velocity;
    a_ = 1.5 * std::max({most, 2 * stride, root * root * limits_.acceleration});
  }

  bool is_inside() const {
    bool inside = a_ > 0;
    if (!inside) return false;
    const double room = step_room();
    each_constraint([&](const std::array<Term, 3>& terms, double constant, bool accelerates) {
      double slack = constant + (accelerates ? a_ : room);
      for (const Term& term : terms) slack += term.factor * z_[term.variable];
      inside = inside && slack > 0;
    });
    each_side([&](const std::array<Term, 3>& terms, double constant) {
      double slack = constant;
      for (const Term& term : terms) slack += term.factor * z_[term.variable];
      inside = inside && slack > 0;
    });
    return inside;
  }

  // One step on weight A - the sum of the logarithms of all slacks. Returns half the square of Newton's decrement.
  double newton_step(double weight) {
    const std::size_t n = z_.size();
    matrix_.assign(n * (band + 1), 0);
    column_.assign(n, 0);
    gradient_.assign(n, 0);
    double corner = 0;
    double gradient_a = weight;
    const double room = step_room();
    const double room_slope = room / (2 * a_);
    const double room_bend = -room / (4 * a_ * a_);
    const auto add = [&](const std::array<Term, 3>& terms, double slack, double slope, double bend) {
      for (const Term& term : terms) slack += term.factor * z_[term.variable];
      const double inverse = 1 / slack;
      for (const Term& one : terms) {
        gradient_[one.variable] -= one.factor * inverse;
        column_[one.variable] += one.factor * slope * inverse * inverse;
        for (const Term& other : terms) {
          if (other.variable > one.variable) continue;
          element(one.variable, one.variable - other.variable) += one.factor * other.factor * inverse * inverse;
        }
      }
      gradient_a -= slope * inverse;
      corner += slope * slope * inverse * inverse - bend * inverse;
    };
    each_constraint([&](const std::array<Term, 3>& terms, double constant, bool accelerates) {
      add(terms, constant + (accelerates ? a_ : room), accelerates ? 1 : room_slope, accelerates ? 0 : room_bend);
    });
    each_side([&](const std::array<Term, 3>& terms, double constant) { add(terms, constant, 0, 0); });
    for (const std::size_t fixed : {std::size_t{0}, std::size_t{1}, n - 2, n - 1}) hold(fixed);

    factor();
    std::vector<double> by_a = column_;
    std::vector<double> step = gradient_;
    substitute(by_a);
    substitute(step);
    const double pivot = corner - std::inner_product(column_.begin(), column_.end(), by_a.begin(), 0.0);
    const double step_a = -(gradient_a - std::inner_product(column_.begin(), column_.end(), step.begin(), 0.0)) / pivot;
    for (std::size_t i = 0; i < n; ++i) step[i] = -step[i] - by_a[i] * step_a;
    const double decrement =
        -(std::inner_product(gradient_.begin(), gradient_.end(), step.begin(), 0.0) + gradient_a * step_a) / 2;
    take(step, step_a, decrement);
    return decrement;
  }

  void take(const std::vector<double>& step, double step_a, double decrement) {
    const std::vector<double> z = z_;
    const double a = a_;
    // The damped step of self-concordant functions stays inside and always gains.
    const double root = std::sqrt(std::max(2 * decrement, 0.0));
    for (double share = decrement > 0.1 ? std::max(1 / (1 + root), 0.02) * 4 : 1.0; share > 1e-12; share /= 2) {
      const double part = std::min(share, 1.0);
      for (std::size_t i = 0; i < z.size(); ++i) z_[i] = z[i] + part * step[i];
      a_ = a + part * step_a;
      if (is_inside()) return;
    }
    z_ = z;
    a_ = a;
  }

  // A variable that does not move.
  void hold(std::size_t i) {
    for (std::size_t below = i; below < std::min(i + band + 1, z_.size()); ++below) element(below, below - i) = 0;
    for (std::size_t left = 1; left <= band; ++left) element(i, left) = 0;
    element(i, 0) = 1;
    gradient_[i] = 0;
    column_[i] = 0;
  }

  // Cholesky's factors of the band, in place: element(i, d) is the element d places before the diagonal.
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
  double a_ = 0;
  std::vector<double> matrix_;
  std::vector<double> column_;
  std::vector<double> gradient_;
};

// The least time through the corners, where the inner legs are alike and so are the two outer ones.
inline double find_optimum(const std::vector<Place>& corners, const TubeLimits& limits, int samples) {
  const std::size_t legs = corners.size() - 1;
  const auto time_with = [&](int outer) {
    std::vector<int> counts(legs, samples);
    counts.front() = outer;
    counts.back() = outer;
    return TubeProgram(corners, counts, limits).solve();
  };
  if (legs == 2) return time_with(samples);
  int low = samples / 2;
  int high = samples * 2;
  while (high - low > 2) {  // the time falls and then rises
    const int left = low + (high - low) / 3;
    const int right = high - (high - low) / 3;
    (time_with(left) < time_with(right) ? high : low) = time_with(left) < time_with(right) ? right : left;
  }
  return time_with((low + high) / 2);
}

}  // namespace passo::bench
