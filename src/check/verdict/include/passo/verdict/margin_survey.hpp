// MarginSurvey: observes planned motion and determines whether the motors lose steps.
//
// The same motion is analysed in two ways. The simulated physics gives the verdict, the formula the cause and the
// remedy:
//
//   ToleranceTrial   plays the motion with motors from the weakest to the strongest of the tolerance
//   formula          needed = (J_rotor + J_load)·α + (friction + cut)·sign(ω) + damping·ω + weight
//                    against pull-out at |ω|
//
//   safe      all motors keep their steps, and none lags the field by more than 1.6 full steps
//   doubtful  neither
//   lost      the nominal motor loses steps, and so does a weaker one
//
// In the formula α and ω are those of the shaft, derived from the axis's component of the path: on a curve they include
// the centripetal acceleration. Each phase is evaluated at up to 64 points. A motor's actual pull-out torque is only
// known to lie between two values (TorqueBand). After a step change of the torque the rotor overshoots its new
// equilibrium. It stays in synchronism if the energy does not carry it past the unstable equilibrium: the equal-area
// criterion, as for a start without a ramp (motor/torque_curve.hpp).
//
// Lost steps have one of three causes. If the motion itself needs more than the guaranteed torque for longer than a
// quarter of the rotor's natural period, the torque is insufficient, whatever the oscillation. A shorter acceleration
// acts as a step change of the speed, and the oscillation after it is the cause. If the formula finds enough torque for
// both, the cause is resonance.
//
// A trial skips repetitions, and ends after a minute. Motion that was not played is rated safe or doubtful by the
// formula: safe if the low end of the torque band, minus a reserve, is sufficient.
//
// Memory is bounded, whatever the program. docs/manual/checking.md describes how accurate the verdicts are. Source of
// the criterion: any textbook on power systems.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "passo/machine_file/machine_description.hpp"
#include "passo/motor/torque_band.hpp"
#include "passo/trajectory/phase.hpp"
#include "passo/verdict/tolerance_trial.hpp"

namespace passo {

enum class Verdict : std::uint8_t { safe, doubtful, lost };
enum class LossCause : std::uint8_t {
  torque,  // the motion needs more than the guaranteed torque
  jump,    // enough torque for the motion, but not for the oscillation after a step change of the torque
  calm,    // no torque shortage, but the motor may resonate at this rate
};

const char* name_of(Verdict verdict);

// An axis and its motor, in the form needed by the survey.
struct SurveyedMotor {
  Axis axis = Axis::x;
  MotorSetup setup;  // including the weight, as a torque towards the low end
  double tolerance = 0;
  RadiansPerSecond fastest = {};  // maximum shaft speed
  TorqueBand band;
  Load load = {};      // the load, including the motor's own damping
  double inertia = 0;  // inertia of rotor and load, kg·m²
  double weight = 0;   // torque of the weight towards the low end, N·m
  double radians_per_unit = 0;
};

// `setup`: including the weight, as a torque towards the low end.
SurveyedMotor surveyed_motor(Axis axis, const MotorSetup& setup, double tolerance, double radians_per_unit,
                             RadiansPerSecond fastest);

// Returns the axes whose motor the machine file describes, if the driver divides a full step evenly.
std::vector<SurveyedMotor> surveyed_motors(const MachineDescription& machine);

// The data that determine the board's events: the steps of all axes, and the rate below which events divide a step.
struct StepGrid {
  PerAxis<double> steps_per_unit;
  Hertz slow_rate{0};
};
StepGrid step_grid(const MachineDescription& machine);

// A moment at which the motion itself, without any oscillation, needs more than the guaranteed torque.
struct TorqueShortage {
  NewtonMetres needed = {};
  NewtonMetres of_cut = {};
  TorqueRange there = {};
  Hertz rate{0};
};

// The worst moment of an axis in one line of the program.
struct MarginSpot {
  Axis axis = Axis::x;
  std::uint32_t line = 0;
  Seconds time{0};  // time within the motion
  Verdict verdict = Verdict::safe;
  LossCause want = LossCause::torque;
  bool rapid = false;
  NewtonMetres needed = {};     // including the overshoot after a step change, unless `want` is torque
  NewtonMetres of_motion = {};  // torque without the overshoot
  NewtonMetres of_cut = {};     // the part of it due to the cutting force
  TorqueRange there = {};       // pull-out torque at that speed
  Hertz rate{0};                // full steps per second
  MmPerSecond speed{0};         // axis speed
  MmPerSecond path_speed{0};
  MmPerSecond2 acceleration{0};  // axis acceleration
  MmPerSecond2 bending{0};       // the centripetal part of it
  // The remedy: the safe limit. Empty: no value of it is sufficient.
  std::optional<MmPerSecond2> safe_acceleration = {};
  std::optional<MmPerSecond> safe_path_speed = {};
  std::optional<TorqueShortage> lack = {};  // set if the torque itself is insufficient

  // Returns the fraction of the minimum torque that is needed. Above 1: more than the guaranteed torque.
  double load() const;
};

struct AxisMargin {
  Axis axis = Axis::x;
  std::optional<MarginSpot> worst = {};  // empty: the axis did not move
};

struct MarginVerdict {
  Verdict verdict = Verdict::safe;
  std::vector<AxisMargin> axes;   // one per surveyed motor
  std::vector<MarginSpot> worst;  // the worst first; one per line and axis
};

class MarginSurvey {
 public:
  static constexpr std::size_t most_worst = 10;
  // The fraction of the low end that the formula keeps in reserve.
  static constexpr double usual_reserve = 0.2;
  // Lag of the rotor behind the field, full steps. The torque decreases beyond one step, and at two steps the rotor
  // slips.
  static constexpr double safe_swing = 1.6;

  // Without a grid, each motor steps at its own exact times.
  explicit MarginSurvey(std::vector<SurveyedMotor> motors, const StepGrid& grid = {}, double reserve = usual_reserve);

  // Sets the cutting force on the tool in the following feed moves, in N for each mm/s along the path. 0: no cut. The
  // whole force acts on every linear axis that moves, against its motion.
  void set_cut(double newtons_per_speed) { cut_ = newtons_per_speed; }
  void watch(const MotionItem& item);
  // Returns the fraction of the guaranteed torque that the last move needed at its worst moment, maximum over all axes.
  double last_load() const { return last_load_; }
  // Must be called after the last item.
  MarginVerdict verdict();

 private:
  struct State {              // the state of one motor
    double torque = 0;        // torque needed at the last evaluated moment
    double acceleration = 0;  // axis acceleration at that moment
    // The moment with the greatest load in the last tenth of a second: an oscillation that begins there may lose steps
    // later.
    std::optional<MarginSpot> hardest = {};
    // Since when the motion itself, without any oscillation, has needed more than the guaranteed torque; and the last
    // moment at which this had lasted too long to act as a step change.
    std::optional<Seconds> lacks_since = {};
    std::optional<MarginSpot> lack = {};
    std::optional<MarginSpot> worst_of_line = {};
    std::optional<MarginSpot> worst = {};
  };
  // The motor whose steps define the events, and the events per step.
  struct Leader {
    std::optional<Axis> axis = {};
    double division = 1;
  };
  // An evaluation point of the path.
  struct Look {
    Look(const PlannedMove& move, const Phase& phase, Seconds t, Seconds now);
    Seconds time;
    double speed;
    double acceleration;
    Point place;
    Point slope;
    Point bend;
    Leader leader = {};  // from the previous point to this one
  };
  struct Moment;
  static constexpr int most_looks = 64;

  void watch_move(const PlannedMove& move);
  void watch_phase(const PlannedMove& move, const Phase& phase);
  void watch_motor(const PlannedMove& move, std::size_t motor);
  void find_leader(const Look& from, const Look& to);
  MarginSpot spot_at(std::size_t motor, const Moment& moment) const;
  void add_jump(std::size_t motor, const Moment& moment, MarginSpot& spot) const;
  void update_lack(std::size_t motor, const MarginSpot& spot);
  bool is_lack(std::size_t motor, MarginSpot& spot) const;
  void judge(std::size_t motor, MarginSpot spot, const TrialFinding& finding);
  void record(std::size_t motor, const MarginSpot& spot);
  std::optional<MmPerSecond2> safe_acceleration(const SurveyedMotor& own, const MarginSpot& spot) const;
  void find_safe_speed(MarginSpot& spot);
  static void show_lack(MarginSpot& spot);
  void end_line();
  void keep(const MarginSpot& spot);
  void rest(Seconds time);
  void stand(std::size_t motor, Seconds time);

  std::vector<SurveyedMotor> motors_;
  std::vector<ToleranceTrial> trials_;
  StepGrid grid_;
  Leader leader_;
  double share_;  // usable fraction of the low end
  std::vector<State> states_;
  std::vector<Look> looks_;  // the points of the current phase
  std::vector<MarginSpot> worst_;
  std::uint32_t line_ = 0;
  Seconds now_{0};
  double cut_ = 0;  // N per mm/s
  double last_load_ = 0;
};

}  // namespace passo
