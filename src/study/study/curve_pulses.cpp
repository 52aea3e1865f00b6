#include "passo/study/curve_pulses.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr int samples = 96;  // of the curve along a chord

bool is_for_two_axes(MethodName name) {
  return name == MethodName::slope_recalculated || name == MethodName::slope_blocks ||
         name == MethodName::point_comparison;
}

}  // namespace

CurvePulses::CurvePulses(PlaceOfCurve at, ParameterRange range, Source<Chord>& chords, const StepScale& scale,
                         const Method& method)
    : at_(std::move(at)),
      range_(range),
      scale_(scale),
      method_(method),
      chords_(chords, at_(range.low), scale),
      start_(chords_.place()),
      place_(start_) {}

bool CurvePulses::fail(std::string words) {
  error_ = std::move(words);
  return false;
}

bool CurvePulses::begin_chord() {
  StepChord chord;
  if (!chords_.next(chord)) return chords_.error() ? fail(chords_.error()->message) : false;
  if (!std::isfinite(chord.chord.deviation.value())) {
    return fail(
        fmt::format("chord {} spans too large an angle to follow its curve; use a shorter period for shorter chords",
                    measures_.chords + 1));
  }
  const bool flat = is_for_two_axes(method_.name);
  if (flat && chord.distances[2] != 0) return fail(title(method_) + " is for two axes, but the curve moves Z");
  StepMove move;
  for (std::size_t axis = 0; axis < (flat ? 2 : space_axes); ++axis) {
    move.from.push_back(0);
    move.to.push_back(chord.distances[axis]);
  }
  auto line = passo::start(method_, move);
  if (!line) return fail(title(method_) + " " + line.error());
  line_ = std::move(*line);
  ++measures_.chords;

  // The nearest place may be beyond the chord's ends: half a chord more on either side.
  const double half = (chord.chord.to - chord.chord.from) / 2;
  const double low = std::max(range_.low, chord.chord.from - half);
  const double high = std::min(range_.high, chord.chord.to + half);
  near_.clear();
  for (int i = 0; i <= samples; ++i) near_.push_back(at_(low + (high - low) * i / samples));
  return true;
}

Mm CurvePulses::distance(const StepPlace& place) const {
  const auto mm = [&](std::size_t i) { return static_cast<double>(place[i].count) / scale_.steps_per_mm[i]; };
  const Vector3 tool{mm(0), mm(1), mm(2)};
  double nearest = HUGE_VAL;
  for (std::size_t i = 1; i < near_.size(); ++i) {
    nearest = std::min(nearest, length(tool - nearest_of(near_[i - 1], near_[i], tool)));
  }
  return Mm(nearest);
}

bool CurvePulses::next(CurvePulse& pulse) {
  while (!line_ || line_->done()) {
    if (!begin_chord()) return false;
  }
  pulse.chord = measures_.chords;
  pulse.pulse = line_->next();
  const int axes = std::popcount(pulse.pulse.steps);
  for (std::size_t axis = 0; axis < space_axes; ++axis) {
    if ((pulse.pulse.steps >> axis & 1) == 0) continue;
    place_[axis].count += (pulse.pulse.directions >> axis & 1) != 0 ? -1 : 1;
  }
  pulse.place = place_;
  pulse.deviation = distance(place_);
  ++measures_.pulses;
  if (axes > 1) ++measures_.together;
  if (axes == 0) {
    ++measures_.idle;
  } else {
    measures_.largest_deviation = std::max(measures_.largest_deviation, pulse.deviation);
    deviations_ += pulse.deviation.value();
  }
  return true;
}

CurveMeasures CurvePulses::measures() const {
  CurveMeasures found = measures_;
  const std::int64_t moving = found.pulses - found.idle;
  if (moving > 0) found.mean_deviation = Mm(deviations_ / static_cast<double>(moving));
  return found;
}

}  // namespace passo
