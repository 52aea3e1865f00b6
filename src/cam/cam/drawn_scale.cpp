#include "drawn_scale.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr double thinnest_usual = 0.2;  // mm, of the middle one of a board's holes
constexpr double widest_usual = 5;
constexpr double half_pitch = 1.27;  // mm, on which the pins of most parts stand
constexpr std::size_t most_asked = 500;
constexpr std::size_t most_compared = 5000;

double middle_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

bool is_usual(double diameter) {
  return diameter >= thinnest_usual && diameter <= widest_usual;
}

// The distance of each hole from its nearest neighbour, in mm.
std::vector<double> distances_of(const Drawing& drawing) {
  std::vector<double> distances;
  const std::size_t compared = std::min(drawing.holes.size(), most_compared);
  for (std::size_t i = 0; i < std::min(compared, most_asked); ++i) {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < compared; ++j) {
      const double apart = distance_nm(drawing.holes[i].at, drawing.holes[j].at);
      if (apart > 0) nearest = std::min(nearest, apart);
    }
    if (std::isfinite(nearest)) distances.push_back(nearest / nanometres_per_mm);
  }
  return distances;
}

bool are_multiples(const std::vector<double>& distances, double unit) {
  const auto fits = [unit](double distance) { return std::abs(std::remainder(distance, unit)) < 0.02 * unit; };
  return 2 * std::ranges::count_if(distances, fits) > static_cast<std::ptrdiff_t>(distances.size());
}

}  // namespace

std::string words_on_scale(const Drawing& drawing) {
  std::vector<double> diameters;
  for (const DrawnHole& hole : drawing.holes) {
    if (hole.diameter.count > 0) diameters.push_back(to_mm(hole.diameter).value());
  }
  if (!diameters.empty()) {
    const double middle = middle_of(diameters);
    if (is_usual(middle)) return {};
    for (const double factor : {0.1, 10.0, 1 / mm_per_inch, mm_per_inch}) {
      if (!is_usual(middle * factor)) continue;
      return fmt::format(
          "the median hole diameter is {:.4g} mm; the scale may be off by a factor of {:.4g}: with a factor of {:.4g} "
          "it would "
          "be {:.4g} mm",
          middle, factor < 1 ? 1 / factor : factor, factor, middle * factor);
    }
    return {};
  }
  std::vector<double> distances = distances_of(drawing);
  if (distances.size() < 4) return {};
  const double middle = middle_of(distances);
  if (middle > 12 && are_multiples(distances, half_pitch * 10)) {
    return fmt::format(
        "the hole spacing is a multiple of 12.7 mm; the scale may be off by a factor of 10: with a factor of 0.1 it "
        "would be "
        "1.27 mm");
  }
  if (middle < 1.2 && are_multiples(distances, half_pitch / 10)) {
    return fmt::format(
        "the hole spacing is a multiple of 0.127 mm; the scale may be off by a factor of 10: with a factor of 10 it "
        "would be "
        "1.27 mm");
  }
  return {};
}

}  // namespace passo
