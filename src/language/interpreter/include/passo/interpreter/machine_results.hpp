// MachineResults: results from the machine on which a program depends: the outcome of a probe move, and the position at
// which a tap reversed.
//
// Position in the pipeline: outside it. All other data flows downstream; only these few results come back. One rule
// makes that safe: no stage reads past a probe move or tap before its result is available. The path builder returns it
// as its last item, and the drive pulls the next item only when the machine is stopped and the result is stored.
#pragma once

#include "passo/interpreter/probe_outcome.hpp"

namespace passo {

class MachineResults {
 public:
  virtual ~MachineResults() = default;
  // Returns the outcome of the last probe move, or null if it is not available: then the probe is assumed to be
  // triggered at the end of the move.
  virtual const ProbeOutcome* probe() const { return nullptr; }
  // Returns the position at which the spindle reversed in the last tap. Returns null if taps do not follow the spindle
  // through the reversal, and retract from their end.
  virtual const Point* tap_reversal() const { return nullptr; }
};

// Returns empty results, for a check or a preview.
inline const MachineResults& no_answers() {
  static const MachineResults none;
  return none;
}

// The results of a running machine, written by the drive.
class StoredResults final : public MachineResults {
 public:
  struct Answers {
    bool probes = true;
    bool taps = false;
  };
  StoredResults() = default;
  explicit StoredResults(const Answers& answers) : answers_(answers) {}

  const ProbeOutcome* probe() const override { return answers_.probes ? &probe_ : nullptr; }
  const Point* tap_reversal() const override { return answers_.taps ? &tap_rest_ : nullptr; }

  void record(const ProbeOutcome& outcome) { probe_ = outcome; }
  void record_tap_rest(const Point& rest) { tap_rest_ = rest; }

 private:
  Answers answers_;
  ProbeOutcome probe_;
  Point tap_rest_;
};

}  // namespace passo
