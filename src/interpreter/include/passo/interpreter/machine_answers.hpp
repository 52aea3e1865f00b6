// MachineAnswers: what a machine answers into the program that it runs: what its probe has found, and where a tap has
// turned round.
//
// Place on the street: beside it. Everything else flows down; these few answers come back up, and that is safe by one
// rule: no stage reads past a question before the answer is there. The path builder gives the question (a probe move, a
// tap) as its last item; the drive asks for the next one when the machine rests and the answer is written.
#pragma once

#include "passo/interpreter/probe_outcome.hpp"

namespace passo {

class MachineAnswers {
 public:
  virtual ~MachineAnswers() = default;
  // What the last probe move has found. Null: nobody answers, and a probe move is touched at its end.
  virtual const ProbeOutcome* probe() const { return nullptr; }
  // Where the tool rested when the spindle turned round in the last tap. Null: nothing follows that, and a tap goes
  // back from its end.
  virtual const Point* tap_rest() const { return nullptr; }
};

// Of a check, or a preview.
inline const MachineAnswers& no_answers() {
  static const MachineAnswers none;
  return none;
}

// The answers of a machine that runs the program now: written where the machine is driven.
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

  void note(const ProbeOutcome& outcome) { probe_ = outcome; }
  void note_tap_rest(const Point& rest) { tap_rest_ = rest; }

 private:
  Answers answers_;
  ProbeOutcome probe_;
  Point tap_rest_;
};

}  // namespace passo
