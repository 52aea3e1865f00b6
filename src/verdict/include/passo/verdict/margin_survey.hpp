// MarginSurvey: watches planned motion, and says whether the motors have the torque for it.
//
//     needed = (J_rotor + J_load)·α + friction·sign(ω) + damping·ω + weight        against pull-out at |ω|
//
// α and ω are those of the shaft, from the axis's part of the path: on a curve they include the bending. Each phase is
// looked at in up to 64 places.
//
// A motor's true pull-out is only known between two torques (TorqueBand). So there are three verdicts:
//
//   safe      the low end, less a reserve, is enough for what is needed, and for the swing after a jump of it
//   lost      what is needed exceeds the high end so long that the rotor falls a full step behind; or the high end
//             does not catch the swing
//   doubtful  neither
//
// After a jump of the torque the rotor swings beyond its new place. The swing ends well if the energy does not carry
// the rotor over the top: the equal-area criterion, as for a start without a ramp (motor/torque_curve.hpp). A motor
// that stays at about one speed may begin to swing by itself: there the low end is TorqueBand::while_steady().
//
// Memory is bounded, whatever the program. docs/manual/checking.md says how far the verdicts are right.
// Source of the criterion: any textbook of power systems.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/motor/torque_band.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

enum class Verdict : std::uint8_t { safe, doubtful, lost };
enum class Want : std::uint8_t {
  torque,  // the motion needs more than there surely is
  jump,    // the motion would do, but not the swing after a jump of what is needed
  calm,    // the motor may swing by itself at this rate
};

const char* name_of(Verdict verdict);

// An axis with its motor, as the survey knows it.
struct SurveyedMotor {
  Axis axis = Axis::x;
  TorqueBand band;
  Load load = {};      // the motor's own damping included
  double inertia = 0;  // kg·m², rotor and load
  double weight = 0;   // N·m, pulls towards the low end
  double radians_per_unit = 0;
  bool coarse_steps =
      false;  // full or half steps: each step makes the rotor ring, so a ramp through a resonance counts
};

// The axes whose motor the machine file describes, with a driver that divides a full step evenly. The trials of an axis
// take some tenths of a second.
std::vector<SurveyedMotor> surveyed_motors(const MachineDescription& machine);

// The worst moment of an axis in a line of the program.
struct MarginSpot {
  Axis axis = Axis::x;
  std::uint32_t line = 0;
  Seconds time{0};  // of the motion
  Verdict verdict = Verdict::safe;
  Want want = Want::torque;
  bool rapid = false;
  NewtonMetres needed = {};     // with the swing, where `want` is jump
  NewtonMetres of_motion = {};  // without it
  TorqueRange there = {};       // pull-out; the low end with swinging, where `want` is calm
  Hertz rate{0};                // full steps a second
  MmPerSecond speed{0};         // of the axis
  MmPerSecond path_speed{0};
  MmPerSecond2 acceleration{0};  // of the axis
  MmPerSecond2 bending{0};       // the part of it that turns the path
  // The cure: what would be safe. Empty: not even that helps.
  std::optional<MmPerSecond2> safe_acceleration = {};
  std::optional<MmPerSecond> safe_path_speed = {};

  // The share of the least torque that is needed. Above 1: more than there surely is.
  double load() const;
};

struct AxisMargin {
  Axis axis = Axis::x;
  std::optional<MarginSpot> worst = {};  // empty: the axis did not move
};

struct MarginVerdict {
  Verdict verdict = Verdict::safe;
  std::vector<AxisMargin> axes;   // of the motors that were surveyed
  std::vector<MarginSpot> worst;  // the worst first; one a line and axis
};

class MarginSurvey {
 public:
  static constexpr std::size_t most_worst = 10;
  // The share of the low end that is kept.
  static constexpr double usual_reserve = 0.1;

  explicit MarginSurvey(std::vector<SurveyedMotor> motors, double reserve = usual_reserve);

  void watch(const MotionItem& item);
  // How much of the sure torque the last move needed at its worst, of any axis.
  double last_load() const { return last_load_; }
  // Call after the last item.
  MarginVerdict verdict();

 private:
  struct State {              // of one motor
    double torque = 0;        // needed at the last moment
    double acceleration = 0;  // of the axis, then
    double lasted = 0;        // s since the torque jumped
    // How far the rotor would be behind if its motor had the high end.
    double behind = 0;       // rad
    double behind_rate = 0;  // rad/s
    std::optional<MarginSpot> worst_of_line = {};
    std::optional<MarginSpot> worst = {};
  };
  struct Moment;

  void watch_move(const PlannedMove& move);
  void watch_phase(const PlannedMove& move, const Phase& phase, std::size_t motor);
  void judge(std::size_t motor, const Moment& moment);
  void judge_jump(std::size_t motor, const Moment& moment, const Phase& phase, const State& before);
  bool falls_behind(std::size_t motor, const Moment& moment, double time);
  void note(std::size_t motor, const MarginSpot& spot);
  static MarginSpot spot_at(const SurveyedMotor& own, const Moment& moment);
  std::optional<MmPerSecond2> safe_acceleration(const SurveyedMotor& own, const MarginSpot& spot) const;
  void find_safe_speed(MarginSpot& spot) const;
  void end_line();
  void keep(const MarginSpot& spot);
  void rest();
  void stand(std::size_t motor);

  std::vector<SurveyedMotor> motors_;
  double share_;  // of the low end that may be used
  std::vector<State> states_;
  std::vector<MarginSpot> worst_;
  std::uint32_t line_ = 0;
  Seconds now_{0};
  double last_load_ = 0;
};

}  // namespace passo
