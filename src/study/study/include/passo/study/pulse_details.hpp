// PulseDetails: the decisions, steps and counters of a method in each pulse, in the notation of the method's sources.
//
// A pulse has four phases: decide, step one axis or more, compute, test for the end. The interpolators store only what
// they need. PulseDetails computes the other values for the reader: the fractions and midlines of master and slaves,
// the sums of the integrators, the slopes, the blocks, the end counter.
//
//   pulse │ judge        │ feed │ where it stands │ decision variables │ end counter
//   2     │ F<0          │ +y   │ 1,1             │ 6                  │ 12
//
// For each pulse it needs only the data of PulseSource, so it can be called for one pulse after the other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/study/method.hpp"

namespace passo {

class PulseDetails {
 public:
  // `pulses` is the number of pulses of the whole move.
  PulseDetails(const Method& method, const StepMove& move, std::int64_t pulses);

  // The decision before pulse k (from 1). `place` is the position of the tool before the pulse, `decisions` are the
  // decision variables before it. There is one cell for each name.
  std::vector<std::string> judge_names() const;
  std::vector<std::string> judge(std::int64_t k, const Place& place, const std::vector<std::int64_t>& decisions) const;

  // The counters for the end test, after pulse k. Point comparison counts as selected by Method::end_judging, all other
  // methods count pulses.
  std::vector<std::string> end_names() const;
  std::vector<std::string> end(std::int64_t k, const Place& place) const;

  // Returns e.g. "+x", "-y", "+x+y"; "none" if nothing moves.
  static std::string feed(Pulse pulse);

 private:
  std::vector<std::string> fractions(std::int64_t k, const Place& place) const;
  std::vector<std::string> slopes(const Place& place) const;
  std::vector<std::string> shared_sums(std::int64_t decision) const;
  std::vector<std::string> block(std::int64_t k) const;
  std::int64_t at_midpoint(const Place& place, std::int64_t deviation) const;
  std::int64_t length(std::size_t axis) const;  // steps of an axis of a line
  bool judges_axes() const;

  Method method_;
  StepMove move_;
  std::int64_t pulses_;
  std::int64_t longest_ = 0;
};

}  // namespace passo
