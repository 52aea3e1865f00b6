// CurvePulses: both levels of interpolation on one curve. A coarse level divides the curve into chords (Chords,
// EqualChords), the ends are rounded to steps (StepChords), and any line method steps along each chord.
//
//   curve ──▶ chords ──▶ ends in whole steps ──▶ pulses, each with its distance from the curve
//
// A pulled stage, one pulse per call. It calls the interpolator through virtual functions and searches for the nearest
// point of the curve after every pulse: it is for studies and pictures, not for a machine.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "passo/geometry/step_chords.hpp"
#include "passo/study/method.hpp"

namespace passo {

struct CurvePulse {
  std::int64_t chord = 0;  // from 1; chords shorter than a step are not counted
  Pulse pulse;
  StepPlace place = {};  // tool position after the pulse
  Mm deviation{0};       // distance from the curve
};

struct CurveMeasures {
  std::int64_t chords = 0;
  std::int64_t pulses = 0;
  std::int64_t together = 0;  // number of pulses in which two or more axes step
  std::int64_t idle = 0;
  Mm largest_deviation{0};  // maximum after pulses that moved the tool
  Mm mean_deviation{0};
};

class CurvePulses {
 public:
  using PlaceOfCurve = std::function<Vector3(double u)>;

  // `chords` divides the curve `at`, whose parameter covers `range`; both must outlive the CurvePulses. Methods for two
  // axes support curves in X and Y.
  CurvePulses(PlaceOfCurve at, ParameterRange range, Source<Chord>& chords, const StepScale& scale,
              const Method& method);

  // Returns false at the end, and after an error; see error().
  [[nodiscard]] bool next(CurvePulse& pulse);
  const std::optional<std::string>& error() const { return error_; }
  // Returns the start of the first chord.
  const StepPlace& start() const { return start_; }
  // Returns the measures of the pulses so far.
  CurveMeasures measures() const;

 private:
  bool begin_chord();
  bool fail(std::string words);
  Mm distance(const StepPlace& place) const;

  PlaceOfCurve at_;
  ParameterRange range_;
  StepScale scale_;
  Method method_;
  StepChords chords_;
  StepPlace start_;
  StepPlace place_;
  std::unique_ptr<PulseSource> line_;
  std::vector<Vector3> near_;  // points of the curve along the current chord, and a little beyond its ends
  CurveMeasures measures_;
  double deviations_ = 0;  // sum of all deviations, mm
  std::optional<std::string> error_;
};

}  // namespace passo
