// Beats: what a method judges, feeds and counts in each pulse, as the method's sources print it.
//
// A pulse has four beats: judge, feed one axis or more, compute, judge the end. The interpolators keep only what they
// need. Beats computes the rest anew for a reader: the fractions and midlines of master and slaves, the sums of the
// integrators, the slopes, the blocks, the counter of the end.
//
//   pulse │ judge        │ feed │ where it stands │ decision variables │ end counter
//   2     │ F<0          │ +y   │ 1,1             │ 6                  │ 12
//
// Of each pulse it needs only what PulseSource shows, so it can be asked about any pulse in turn.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/study/method.hpp"

namespace passo {

class Beats {
 public:
  // `pulses` is the number of pulses of the whole move.
  Beats(const Method& method, const StepMove& move, std::int64_t pulses);

  // What the method judges before pulse k (from 1). `place` is where the tool stands before the pulse, `decisions` are
  // the decision variables before it. For every name there is a cell.
  std::vector<std::string> judge_names() const;
  std::vector<std::string> judge(std::int64_t k, const Place& place, const std::vector<std::int64_t>& decisions) const;

  // The counters that judge the end, after pulse k. Point comparison counts as Method::end_judging says, all other
  // methods count pulses.
  std::vector<std::string> end_names() const;
  std::vector<std::string> end(std::int64_t k, const Place& place) const;

  // "+x", "-y", "+x+y"; "none" where nothing moves.
  static std::string feed(Pulse pulse);

 private:
  std::vector<std::string> fractions(std::int64_t k, const Place& place) const;
  std::vector<std::string> slopes(const Place& place) const;
  std::vector<std::string> block(std::int64_t k) const;
  std::int64_t at_midpoint(const Place& place, std::int64_t deviation) const;
  std::int64_t length(std::size_t axis) const;  // the steps of an axis of a line
  bool judges_axes() const;

  Method method_;
  StepMove move_;
  std::int64_t pulses_;
  std::int64_t longest_ = 0;
};

}  // namespace passo
