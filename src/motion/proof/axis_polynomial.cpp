#include "axis_polynomial.hpp"

#include <algorithm>
#include <cmath>

namespace passo::proof {
namespace {

// A peak is found to this share of itself.
constexpr double precision_of_peak = 1e-10;
constexpr int most_halvings = 40;

using Coefficients = std::array<double, 10>;  // degree 9 at most

// A part of 0..1, and the polynomial's Bernstein coefficients there.
struct Part {
  Coefficients at{};
  double from = 0;
  double width = 1;
  int halvings = 0;
};

// From powers of u: b_i is the sum of C(i,k)/C(n,k) a_k over k <= i. Each round of the loop adds Pascal's next row.
Coefficients bernstein_of(const Coefficients& powers, std::size_t count) {
  Coefficients b{};
  double choices = 1;  // C(n, k)
  for (std::size_t k = 0; k < count; ++k) {
    b[k] = powers[k] / choices;
    choices = choices * static_cast<double>(count - 1 - k) / static_cast<double>(k + 1);
  }
  for (std::size_t round = 1; round < count; ++round) {
    for (std::size_t i = count - 1; i >= round; --i) b[i] += b[i - 1];
  }
  return b;
}

double largest_of(const Coefficients& b, std::size_t count) {
  double largest = 0;
  for (std::size_t i = 0; i < count; ++i) largest = std::max(largest, std::abs(b[i]));
  return largest;
}

// Cuts a part in the middle: it becomes the first half, and the second one is returned.
Part cut(Part& part, std::size_t count) {
  Part second = part;
  for (std::size_t round = 1; round < count; ++round) {
    second.at[count - round] = part.at[count - 1];
    for (std::size_t i = count - 1; i >= round; --i) part.at[i] = (part.at[i - 1] + part.at[i]) / 2;
  }
  second.at[0] = part.at[count - 1];
  part.width /= 2;
  second.width = part.width;
  second.from = part.from + part.width;
  second.halvings = ++part.halvings;
  return second;
}

}  // namespace

AxisPolynomial::AxisPolynomial(const Derivatives& slopes, const Phase& phase) {
  const double duration = phase.duration.value();
  const std::array<double, 4> way = {0, phase.velocity.value() * duration,
                                     phase.acceleration.value() * duration * duration / 2,
                                     phase.jerk.value() * duration * duration * duration / 6};
  const std::size_t powers = phase.jerk.value() != 0 ? 3 : 2;
  const bool is_line = slopes.second == 0 && slopes.third == 0;
  count_ = (is_line ? powers : 3 * powers) + 1;
  Terms& q = terms_[0];
  for (std::size_t i = 1; i <= powers; ++i) q[i] = slopes.first * way[i];
  if (!is_line) {
    std::array<double, 7> squares{};
    for (std::size_t i = 1; i <= powers; ++i) {
      for (std::size_t k = 1; k <= powers; ++k) squares[i + k] += way[i] * way[k];
    }
    for (std::size_t i = 2; i <= 2 * powers; ++i) q[i] += slopes.second / 2 * squares[i];
    for (std::size_t i = 2; i <= 2 * powers; ++i) {
      for (std::size_t k = 1; k <= powers; ++k) q[i + k] += slopes.third / 6 * squares[i] * way[k];
    }
  }
  for (std::size_t order = 1; order < terms_.size(); ++order) {
    for (std::size_t i = 0; i + 1 < most_terms; ++i) {
      terms_[order][i] = static_cast<double>(i + 1) * terms_[order - 1][i + 1] / duration;
    }
  }
}

double AxisPolynomial::value(double u, Order order) const {
  const Terms& terms = terms_[static_cast<std::size_t>(order)];
  double sum = 0;
  for (std::size_t i = count_; i-- > 0;) sum = sum * u + terms[i];
  return sum;
}

double AxisPolynomial::highest(Order order) const {
  const auto number = static_cast<std::size_t>(order);
  const std::size_t count = count_ > number ? count_ - number : 1;
  return largest_of(bernstein_of(terms_[number], count), count);
}

std::optional<AxisPolynomial::Peak> AxisPolynomial::peak_above(double least, Order order) const {
  const auto number = static_cast<std::size_t>(order);
  const std::size_t count = count_ > number ? count_ - number : 1;
  std::optional<Peak> peak;
  double best = least;
  const auto see = [&](double value, double u) {
    if (!(std::abs(value) > best)) return;
    best = std::abs(value);
    peak = {.value = best, .u = u};
  };
  // Depth first: at most one part waits for each halving.
  std::array<Part, most_halvings + 2> waiting;
  std::size_t parts = 0;
  waiting[parts++] = {.at = bernstein_of(terms_[number], count)};
  while (parts > 0) {
    Part part = waiting[--parts];
    see(part.at[0], part.from);
    see(part.at[count - 1], part.from + part.width);
    if (!(largest_of(part.at, count) > best * (1 + precision_of_peak)) || part.halvings == most_halvings) continue;
    Part second = cut(part, count);
    const bool first_is_larger = largest_of(part.at, count) > largest_of(second.at, count);
    waiting[parts++] = first_is_larger ? second : part;
    waiting[parts++] = first_is_larger ? part : second;
  }
  return peak;
}

}  // namespace passo::proof
