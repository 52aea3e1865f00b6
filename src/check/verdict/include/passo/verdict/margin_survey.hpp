// MarginSurvey: watches planned motion, and says whether the motors lose steps in it.
//
// Two looks at the same motion. The physics gives the verdict, and the formula the cause and the cure:
//
//   ToleranceTrial   plays the motion with motors from the weakest to the strongest of the tolerance
//   formula          needed = (J_rotor + J_load)·α + (friction + cut)·sign(ω) + damping·ω + weight
//                    against pull-out at |ω|
//
//   safe      all motors keep their steps, and none swings further than 1.6 full steps from the field
//   doubtful  neither
//   lost      the usual motor loses steps, and so does a weaker one
//
// In the formula α and ω are those of the shaft, from the axis's part of the path: on a curve they include the bending.
// Each phase is looked at in up to 64 places. A motor's true pull-out is only known between two torques (TorqueBand).
// After a jump of the torque the rotor swings beyond its new place. The swing ends well if the energy does not carry
// the rotor over the top: the equal-area criterion, as for a start without a ramp (motor/torque_curve.hpp).
//
// Steps are lost for one of three causes. The motion itself needs more than there surely is, for longer than a quarter
// of the rotor's own period: the torque is short, whatever swings. A shorter acceleration is a jump of the speed, and
// no torque of the formula: the swing after it is the cause. Where the formula finds torque enough for both, the motor
// swings by itself.
//
// A trial leaves out what repeats itself, and ends after a minute. Motion that was not played is safe or doubtful by
// the formula: safe if the low end, less a reserve, is enough.
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
#include "passo/verdict/tolerance_trial.hpp"

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
  MotorSetup setup;  // with the weight towards the low end
  double tolerance = 0;
  RadiansPerSecond fastest = {};  // of the shaft
  TorqueBand band;
  Load load = {};      // the motor's own damping included
  double inertia = 0;  // kg·m², rotor and load
  double weight = 0;   // N·m, pulls towards the low end
  double radians_per_unit = 0;
};

// `setup`: with the weight towards the low end.
SurveyedMotor surveyed_motor(Axis axis, const MotorSetup& setup, double tolerance, double radians_per_unit,
                             RadiansPerSecond fastest);

// The axes whose motor the machine file describes, with a driver that divides a full step evenly.
std::vector<SurveyedMotor> surveyed_motors(const MachineDescription& machine);

// What makes the board's events: the steps of all axes, and the rate below which events divide a step.
struct StepGrid {
  PerAxis<double> steps_per_unit;
  Hertz slow_rate{0};
};
StepGrid step_grid(const MachineDescription& machine);

// A moment when the motion itself, without any swing, needs more torque than there surely is.
struct Lack {
  NewtonMetres needed = {};
  NewtonMetres of_cut = {};
  TorqueRange there = {};
  Hertz rate{0};
};

// The worst moment of an axis in a line of the program.
struct MarginSpot {
  Axis axis = Axis::x;
  std::uint32_t line = 0;
  Seconds time{0};  // of the motion
  Verdict verdict = Verdict::safe;
  Want want = Want::torque;
  bool rapid = false;
  NewtonMetres needed = {};     // with the swing after a jump, unless `want` is torque
  NewtonMetres of_motion = {};  // without it
  NewtonMetres of_cut = {};     // the part of it that the cutting force takes
  TorqueRange there = {};       // pull-out
  Hertz rate{0};                // full steps a second
  MmPerSecond speed{0};         // of the axis
  MmPerSecond path_speed{0};
  MmPerSecond2 acceleration{0};  // of the axis
  MmPerSecond2 bending{0};       // the part of it that turns the path
  // The cure: what would be safe. Empty: not even that helps.
  std::optional<MmPerSecond2> safe_acceleration = {};
  std::optional<MmPerSecond> safe_path_speed = {};
  std::optional<Lack> lack = {};  // where the torque itself is short

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
  // The share of the low end that the formula keeps.
  static constexpr double usual_reserve = 0.2;
  // Full steps from the field to the rotor. Torque falls beyond one, and at two the rotor falls back.
  static constexpr double safe_swing = 1.6;

  // Without a grid each motor steps at its own exact times.
  explicit MarginSurvey(std::vector<SurveyedMotor> motors, const StepGrid& grid = {}, double reserve = usual_reserve);

  // The force of the cut against the tool on the feeds that follow, in N for each mm/s along the path. 0: no cut.
  // Every linear axis that moves feels the whole of it, against its motion.
  void set_cut(double newtons_per_speed) { cut_ = newtons_per_speed; }
  void watch(const MotionItem& item);
  // How much of the sure torque the last move needed at its worst, of any axis.
  double last_load() const { return last_load_; }
  // Call after the last item.
  MarginVerdict verdict();

 private:
  struct State {              // of one motor
    double torque = 0;        // needed at the last moment
    double acceleration = 0;  // of the axis, then
    // The hardest moment of the last tenth of a second: a swing that begins there may lose its steps later.
    std::optional<MarginSpot> hardest = {};
    // Since when the motion itself, without any swing, has needed more than there surely is; and the last moment at
    // which that had lasted for longer than a jump does.
    std::optional<Seconds> lacks_since = {};
    std::optional<MarginSpot> lack = {};
    std::optional<MarginSpot> worst_of_line = {};
    std::optional<MarginSpot> worst = {};
  };
  // The motor whose steps make the events, and the events that make one step of it.
  struct Leader {
    std::optional<Axis> axis = {};
    double division = 1;
  };
  // A moment of the path.
  struct Look {
    Look(const PlannedMove& move, const Phase& phase, Seconds t, Seconds now);
    Seconds time;
    double speed;
    double acceleration;
    Point place;
    Point slope;
    Point bend;
    Leader leader = {};  // from the look before to this one
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
  double share_;  // of the low end that may be used
  std::vector<State> states_;
  std::vector<Look> looks_;  // at the present phase
  std::vector<MarginSpot> worst_;
  std::uint32_t line_ = 0;
  Seconds now_{0};
  double cut_ = 0;  // N for each mm/s
  double last_load_ = 0;
};

}  // namespace passo
