// Pace: the relation between s and the parameter of a smoothed span.
//
// The spline's parameter is approximately the time that a machine with a jerk limit takes. Around a sharp corner the
// machine must move slowly, so the parameter advances more than s. Then the spline with the smallest change of its
// second derivative has nearly the smallest jerk of a machine that slows down at corners.
//
// Within a span ds/du changes linearly: s = rate u + quickening u²/2. If the rate is 1 at both ends, u equals s
// exactly.
#pragma once

#include <algorithm>
#include <cmath>

namespace passo {

struct Pace {
  double rate = 1;        // ds/du at its start
  double quickening = 0;  // d²s/du²
  double width = 0;       // width of the span, in u

  static Pace between(double rate, double next_rate, double distance) {
    const double width = 2 * distance / (rate + next_rate);
    return {.rate = rate, .quickening = (next_rate - rate) / width, .width = width};
  }

  bool is_even() const { return rate == 1 && quickening == 0; }
  double rate_at(double u) const { return rate + quickening * u; }
  double distance(double u) const { return (rate + quickening * (u / 2)) * u; }
  // Returns the parameter at which a distance is reached.
  double reaches(double distance) const {
    return 2 * distance / (rate + std::sqrt(std::max(0.0, rate * rate + 2 * quickening * distance)));
  }
  // For a curve of the curvature c, passed with this pace: the maximum |d²P/du²| and the maximum |d⁴P/du⁴|. Between two
  // points d apart, d²P/du² deviates from its chord by at most d²/8 |d⁴P/du⁴|.
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
