// PathBuilder: converts operations into segments. It applies the work coordinate system, keeps geometry exact (no
// chords), and checks the travel.
//
// There are two exceptions. While the work coordinate system is rotated about Z, an arc in the plane ZX or YZ is in no
// coordinate plane of the machine. Such an arc is divided into chords within half a thousandth of a millimetre, or half
// the tolerance if that is less. A spline is converted into cubics of its arc length, which deviate from it by at most
// a tenth of the path tolerance, or half a thousandth of a millimetre where the tolerance is 0.
//
// Position in the pipeline: between the interpreter and the planner. Segments join without a gap: the start of each is
// bit-identical to the end of the previous one. Moves shorter than a thousandth of a nanometre are rounding errors, and
// are dropped. Outputs (spindle, coolant) that change without a move between them become one action.
//
// The builder collects errors and continues, so that one pass finds all of them. The path after an error must not be
// executed.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "passo/base/source.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/machine_results.hpp"
#include "passo/path/hand_tool_change.hpp"
#include "passo/path/motion_outputs.hpp"
#include "passo/path/outside_travel.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class SplinePieces;

struct TravelLimit {
  double low = 0;
  double high = 0;
};

struct PathOptions {
  AxisSet axes;                     // the axes that the machine has
  PerAxis<TravelLimit> travel;      // machine coordinates
  PerAxis<MmPerSecond> velocity{};  // maximum speeds of the axes, for feeds that follow the spindle; 0: no feed is
                                    // rejected
  Mm tolerance{0.01};               // for junctions, if the program gives none (G64 P)
  double turn_tolerance = 0;        // of A, B and C at junctions, degrees; 0: they share the tolerance
  // The radii of the cylinders that A, B and C turn: the feed is the speed along their surface. Empty: degrees count.
  // 0: the tool's distance from the rotation axis, Z in the work coordinate system.
  PerAxis<std::optional<Mm>> surface_radius{};
  double spindle_limit = 0;  // maximum spindle speed, rpm; 0: no spindle speed is rejected
  Point start;               // machine position at the start
  // True: more operations may follow later, so nothing is switched off at the end of the source.
  bool open_ended = false;
  // The spindle's time from standstill to 1000 rpm. Motion waits for the spindle, and tapping leaves room to reverse
  // it.
  Seconds spindle_run_up{0};
  // True: the spindle reports its speed, so motion waits for it (await_speed).
  bool awaits_spindle_speed = false;
  // True: in threads the spindle runs at the programmed speed, regardless of its override. Without an encoder this is
  // necessary: the axes cannot follow the spindle, so another speed would cut another pitch.
  bool threads_hold_speed = false;
  // The rapids at M2 and M30: Z to this machine position, then X and Y to the park position. Empty: none.
  std::optional<double> end_height = {};
  std::optional<Point> park = {};
  MotionOutputOptions outputs = {};  // the outputs that are switched in motion
  std::string file;                  // names the program in diagnostics
};

// The code of the error that a move leaves the travel of an axis.
inline constexpr std::string_view travel_exceeded = "travel.exceeded";

// The state of a path builder between two operations.
struct PathMemory {
  Frame frame_;
  bool in_step_ = false;  // synchronised with the spindle since its index
  Point position_;        // machine

  LengthUnits units_ = LengthUnits::mm;  // for messages
  operation::SetFeedRate feed_rate_;
  std::optional<Mm> synchronised_pitch_;
  PathMode path_mode_ = PathMode::continuous;
  Mm tolerance_{0};
  OverridePermissions heeds_;
  bool gives_tolerance_ = false;  // the program gives a tolerance, with G64 P
  Mm merge_{0};

  OutputState commanded_;  // keeps the commanded spindle speed even while the spindle is stopped
  OutputState handed_on_;
  OperationSource outputs_source_;
  MotionOutputs in_motion_;  // outputs that change without a stop
  struct Refused {
    double spindle_speed = 0;
    MmPerSecond feed{0};  // the last synchronized feed that exceeded the velocity of an axis
  };
  Refused refused_;
  struct SpeedWait {
    Seconds run_up_left{0};  // the time until the spindle has reached its speed
    bool is_new = false;     // with awaits_spindle_speed: no motion has come since the speed changed
  };
  SpeedWait speed_wait_;

  OutsideTravel outside_;
  AxisSet missing_;
  std::array<bool, 4> told_{};  // findings already reported, by TorqueShortage
};

class PathBuilder final : public Source<PathItem>, private PathMemory {
 public:
  // `options` must outlive the builder.
  PathBuilder(Source<Operation>& operations, const PathOptions& options, Diagnostics& diagnostics,
              const MachineResults& answers = no_answers());
  ~PathBuilder() override;

  [[nodiscard]] bool next(PathItem& item) override;

  const Frame& frame() const { return frame_; }
  // The end of the path so far, in machine coordinates.
  const Point& position() const { return position_; }
  // The tool that comments name before the first feed; 0: none.
  std::int32_t named_tool() const { return hand_.at_start(); }
  // Continues the path from another position. The path read so far is dropped.
  void stand_at(const Point& machine) {
    position_ = machine;
    outside_ = {};
    missing_ = AxisSet();
    refused_.feed = MmPerSecond(0);
  }
  // Saves the state after the operations so far, and restores it, as if the later ones had not come. Call it when
  // next() has returned false.
  void keep() {
    kept_ = *this;
    kept_hand_ = hand_;
  }
  void roll_back() {
    static_cast<PathMemory&>(*this) = kept_;
    hand_ = kept_hand_;
  }

 private:
  bool next_operation();
  bool begin_tap(const operation::RigidTap& tap, PathItem& item);
  bool next_tap_step(PathItem& item);
  bool next_end_step(PathItem& item);
  void expand(const operation::RigidTap& tap);
  Mm room_to_turn(const Curve& way) const;
  void switch_off();
  // Returns true if the function wrote an item.
  bool add(const Operation& operation, PathItem& item);
  bool add_line(const Point& work_end, bool rapid, PathItem& item);
  bool add_probe(const operation::StraightProbe& probe, PathItem& item);
  bool next_probe_step(PathItem& item);
  bool add_arc(const operation::ArcFeed& arc, PathItem& item);
  bool add_tilted_arc(const operation::ArcFeed& arc, PathItem& item);
  bool next_chord(PathItem& item);
  bool begin_spline(const operation::NurbsFeed& curve, PathItem& item);
  bool next_spline_piece(PathItem& item);
  void be_piece(bool last, Segment& segment) const;
  bool add_curve(const Curve& curve, bool rapid, PathItem& item, const SurfaceScale& surface = {});
  SurfaceScale surface_to(const Point& machine_end, bool rapid) const;

  Point machine_end(const Point& work_end) const;
  MmPerSecond feed_along(const Curve& curve, const SurfaceScale& surface);
  MmPerSecond feed_with_spindle(double mm_per_revolution);
  void set_spindle_speed(double revolutions_per_minute);
  bool set_power(double s);
  bool set_digital(const operation::SetDigitalOutput& set);
  bool set_analog(const operation::SetAnalogOutput& set);
  void record_new_speed();
  bool must_switch(bool has_item, const PathItem& item) const;
  void set_path_mode(const operation::SetPathMode& mode);
  void set_merge_tolerance(Mm given);
  enum class TorqueShortage : std::uint8_t { orientation, outputs, inputs, user_codes };
  void lacks(TorqueShortage what);
  void refuse_surface_speed(const operation::SetSpindleMode& mode);
  OverridePermissions heeds() const;
  SpindleLock lock() const;
  Mm pitch() const;
  OutputState outputs() const;
  Action outputs_action(Action::Kind kind = Action::Kind::outputs, Seconds dwell = Seconds(0)) const;
  bool must_await_index(const PathItem& item);
  bool must_await_run_up(const PathItem& item);
  bool must_await_speed(const PathItem& item);
  Seconds run_up_after(const OutputState& before) const;

  void check_thread(const Curve& curve, MmPerSecond speed);
  void check_travel(const Curve& curve);
  bool is_within_travel(const Box& box) const;
  void check_side(Axis axis, TravelEnd end, double reached, const Curve& curve);
  void check_axes(const Curve& curve);
  // Reports at the axis word or, without one, at the words of the current operation.
  void report(Severity severity, std::string code, FindingWords message, FindingWords expected,
              std::optional<Axis> axis = std::nullopt);

  Source<Operation>& operations_;
  const PathOptions& options_;
  const bool has_surfaces_;  // some axis turns a cylinder of known radius
  Diagnostics& diagnostics_;
  const MachineResults& answers_;

  // An arc in the rotated work coordinate system, some of whose chords are still to be returned.
  struct TiltedArc {
    Curve work;
    std::uint32_t next = 0;
    std::uint32_t chords = 0;
  };
  std::optional<TiltedArc> tilted_;
  // A spline, some of whose pieces are still to be returned.
  std::unique_ptr<SplinePieces> spline_;
  Mm piece_tolerance_{0};  // maximum deviation of the pieces from the current curve
  // A probe move consists of three items. After them, the path continues from the position at which the machine
  // stopped.
  enum class ProbeStep : std::uint8_t { none, move, end, rest };
  ProbeStep probe_step_ = ProbeStep::none;
  Point probe_end_;  // work coordinates

  // Tapping also consists of three items: down, the reversal, and back to the start.
  enum class TapStep : std::uint8_t { none, turn, back, end };
  TapStep followed_tap_ = TapStep::none;
  Point tap_start_;  // machine

  // The moves at the end of the program, before the end itself.
  enum class EndStep : std::uint8_t { none, rise, park, end };
  EndStep end_step_ = EndStep::none;

  Operation operation_;  // the current operation
  std::array<OperationKind, 4> tap_;
  std::size_t tap_step_ = tap_.size();
  std::deque<PathItem> held_;  // items that wait until the items before them are returned
  PathMemory kept_;
  // Tool changes by hand; kept and restored like the memory.
  HandToolChange hand_;
  HandToolChange kept_hand_;
};

}  // namespace passo
