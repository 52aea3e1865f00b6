// Pace: how s goes on with the parameter of a smoothed span.
//
// The spline's parameter is about the time that a machine with a limit of jerk takes: around a sharp corner, where it
// must go slowly, more of it passes than of s. So the least change of the spline's second derivative is about the
// least jerk, and not that of a machine which goes round the corner as fast as along the lines beside it.
//
// Within a span ds/du changes evenly: s = rate u + quickening u²/2. Where the rate is 1 at both ends, u is s, to the
// bit.
#pragma once

#include <algorithm>
#include <cmath>

namespace passo {

struct Pace {
  double rate = 1;        // ds/du at its start
  double quickening = 0;  // d²s/du²
  double width = 0;       // of the span, in u

  static Pace between(double rate, double next_rate, double distance) {
    const double width = 2 * distance / (rate + next_rate);
    return {.rate = rate, .quickening = (next_rate - rate) / width, .width = width};
  }

  bool is_even() const { return rate == 1 && quickening == 0; }
  double rate_at(double u) const { return rate + quickening * u; }
  double distance(double u) const { return (rate + quickening * (u / 2)) * u; }
  // Where a distance is reached.
  double reaches(double distance) const {
    return 2 * distance / (rate + std::sqrt(std::max(0.0, rate * rate + 2 * quickening * distance)));
  }
  // A curve of the curvature c, passed with this pace: the largest |d²P/du²|, and how far d²P/du² leaves its chord
  // between two places d apart, in d²/8: |d⁴P/du⁴|.
  double bend_of(double c) const { return c * fastest() * fastest() + std::abs(quickening); }
  double curl_of(double c) const {
    const double turn = c * fastest();
    const double quick = std::abs(quickening);
    return c * (3 * quick * quick + 6 * turn * fastest() * quick + turn * turn * fastest() * fastest());
  }

 private:
  double fastest() const { return std::max(rate, rate_at(width)); }
};

}  // namespace passo
