// MachineAnswers: what a machine answers to the program that it runs: what its probe has found, and where the tool
// rested when a tap reversed.
//
// Place on the street: beside the street. All other data flows down; only these few answers come back up. One rule
// makes that safe: no stage reads past a question before the answer is there. The path builder gives the question (a
// probe move, a tap) as its last item. The drive asks for the next item only when the machine rests and the answer is
// written.
#pragma once

#include "passo/interpreter/probe_outcome.hpp"

namespace passo {

class MachineAnswers {
 public:
  virtual ~MachineAnswers() = default;
  // What the last probe move has found. Null: nobody answers, and a probe move is touched at its end.
  virtual const ProbeOutcome* probe() const { return nullptr; }
  // Where the tool rested when the spindle reversed in the last tap. Null: taps do not follow the spindle through the
  // reversal, and a tap goes back from its end.
  virtual const Point* tap_rest() const { return nullptr; }
};

// The answers for a check or a preview.
inline const MachineAnswers& no_answers() {
  static const MachineAnswers none;
  return none;
}

// The answers of a machine that runs the program now. The drive writes them.
class AnswerBook final : public MachineAnswers {
 public:
  struct Answers {
    bool probes = true;
    bool taps = false;
  };
  AnswerBook() = default;
  explicit AnswerBook(const Answers& answers) : answers_(answers) {}

  const ProbeOutcome* probe() const override { return answers_.probes ? &probe_ : nullptr; }
  const Point* tap_rest() const override { return answers_.taps ? &tap_rest_ : nullptr; }

  void record(const ProbeOutcome& outcome) { probe_ = outcome; }
  void record_tap_rest(const Point& rest) { tap_rest_ = rest; }

 private:
  Answers answers_;
  ProbeOutcome probe_;
  Point tap_rest_;
};

}  // namespace passo
