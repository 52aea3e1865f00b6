#include "passo/proof/motion_proof.hpp"

#include <cmath>
#include <utility>

#include "lost_motion.hpp"
#include "path_deviation.hpp"
#include "phase_peaks.hpp"
#include "rounding.hpp"
#include "speed_limit.hpp"
#include "step_peaks.hpp"
#include "time_bound.hpp"
#include "tube_bound.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// Limits are checked with this factor, because a plan has finitely many digits.
constexpr double slack = 1.0001;
constexpr double place_rounding = 1e-9;  // mm

MotionProof begun(const ProofOptions& options) {
  MotionProof proof;
  proof.gap.limit = place_rounding;
  for (const ProvenAxis& axis : options.axes) {
    AxisProof own;
    own.axis = axis.axis;
    own.velocity.limit = own.step_velocity.limit = axis.velocity.value();
    own.acceleration.limit = own.step_acceleration.limit = axis.acceleration.value();
    own.jerk.limit = axis.jerk.value();
    own.velocity_jump.limit = proof::velocity_rounding * axis.velocity.value();
    if (axis.backlash > Mm(0)) own.lost_motion.limit = axis.step.value() + place_rounding;
    if (axis.jerk > MmPerSecond3(0))
      own.acceleration_jump.limit = proof::acceleration_rounding * axis.acceleration.value();
    proof.axes.push_back(own);
  }
  return proof;
}

std::string place_of(const Finding& finding) {
  if (finding.line == 0) return fmt::format("at {:.6f} s", finding.time.value());
  return fmt::format("line {}, at {:.6f} s", finding.line, finding.time.value());
}

class FaultList {
 public:
  void add(const std::string& what, const Finding& finding, double noise = 0) {
    if (!(finding.limit > 0) || finding.value <= (finding.limit + noise) * slack) return;
    faults_.push_back(
        fmt::format("{}: {:.6g}, limit {:.6g} ({})", what, finding.value, finding.limit + noise, place_of(finding)));
  }
  std::vector<std::string> take() { return std::move(faults_); }

 private:
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> MotionProof::faults() const {
  FaultList list;
  for (const AxisProof& own : axes) {
    const std::string name = fmt::format("axis {} ", letter_of(own.axis));
    list.add(name + "velocity", own.velocity);
    list.add(name + "acceleration", own.acceleration);
    list.add(name + "jerk", own.jerk);
    list.add(name + "velocity jumps", own.velocity_jump);
    list.add(name + "acceleration jumps", own.acceleration_jump);
    list.add(name + "backlash that is not taken up", own.lost_motion);
    list.add(name + "velocity of the steps", own.step_velocity, own.step_velocity_noise);
    list.add(name + "acceleration of the steps", own.step_acceleration, own.step_acceleration_noise);
  }
  list.add("feed", feed);
  list.add("deviation from the programmed path", deviation);
  list.add("gap in the planned path", gap);
  return list.take();
}

class MotionProver::Implementation {
 public:
  explicit Implementation(const ProofOptions& options) : Implementation(options, proof::speed_limits(options.axes)) {}
  Implementation(const ProofOptions& options, const std::vector<proof::SpeedLimit>& limits)
      : proof_(begun(options)),
        peaks_(proof_, options, limits),
        steps_(options, proof_),
        deviation_(proof_),
        bound_(options, limits),
        tube_(options, limits),
        backlash_(options, proof_) {}

  void watch(const PathItem& item) {
    deviation_.programmed(item);
    tube_.watch(item);
  }
  void watch(const BoardItem& item) {
    if (const auto* segment = std::get_if<BoardSegment>(&item)) steps_.watch(*segment);
  }
  void watch(const MotionItem& item) {
    if (const auto* action = std::get_if<Action>(&item)) {
      if (action->kind == Action::Kind::feed_hold) {
        peaks_.rest(action->dwell);  // somewhere on the path
      } else {
        rest(action->dwell);
      }
      return;
    }
    const auto& move = std::get<PlannedMove>(item);
    if (!move.segment.curve.has_length() || move.phase_count == 0) return;
    const proof::ExactCurve curve(move.segment.curve);
    backlash_.watch(move, curve, peaks_.now());
    if (backlash_.way_of_tool().empty()) {
      deviation_.planned(move, curve, peaks_.now());
    } else {
      deviation_.went(backlash_.way_of_tool(), peaks_.now());
    }
    bound_.watch(move, curve);
    peaks_.watch(move, curve, deviation_.programmed_speed());
  }
  MotionProof finish() {
    deviation_.finish(peaks_.now());
    bound_.rest(Seconds(0));
    peaks_.rest(Seconds(0));
    steps_.finish();
    proof_.time = peaks_.now();
    proof_.time_bound = bound_.time();
    proof_.tube_bound = tube_.finish();
    return std::move(proof_);
  }

 private:
  void rest(Seconds dwell) {
    deviation_.rest(peaks_.now());
    bound_.rest(dwell);
    peaks_.rest(dwell);
  }

  MotionProof proof_;
  proof::PhasePeaks peaks_;
  proof::StepPeaks steps_;
  proof::PathDeviation deviation_;
  proof::TimeBound bound_;
  proof::TubeBound tube_;
  proof::LostMotion backlash_;
};

MotionProver::MotionProver(const ProofOptions& options) : implementation_(std::make_unique<Implementation>(options)) {}
MotionProver::~MotionProver() = default;

void MotionProver::watch(const PathItem& item) {
  implementation_->watch(item);
}
void MotionProver::watch(const MotionItem& item) {
  implementation_->watch(item);
}
void MotionProver::watch(const BoardItem& item) {
  implementation_->watch(item);
}
MotionProof MotionProver::finish() {
  return implementation_->finish();
}

}  // namespace passo
