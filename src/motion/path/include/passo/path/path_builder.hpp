// PathBuilder: operations -> segments. The builder follows the frame, keeps geometry exact (no chords), and checks the
// travel.
//
// There are two exceptions. While the work frame is turned about Z, an arc of the planes ZX and YZ lies in no plane of
// the machine. Such an arc becomes chords within half a thousandth of a millimetre, or half the tolerance if that is
// less. A spline becomes cubics in its length. The cubics leave the spline by at most a tenth of the path's tolerance,
// or half a thousandth of a millimetre where the tolerance is 0.
//
// Place on the street: between the interpreter and the planner. Segments join without a gap: each begins, bit for bit,
// where the one before ended. Moves shorter than a thousandth of a nanometre are rounding, and are dropped. Outputs
// (spindle, coolant) that change without a move between them become one action.
//
// The builder collects errors and goes on, so one pass finds them all. The path after an error must not be played.
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
#include "passo/interpreter/machine_answers.hpp"
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
  PerAxis<MmPerSecond> velocity{};  // the axes' top speeds, for feeds that follow the spindle; 0: no feed is refused
  Mm tolerance{0.01};               // of junctions, if the program gives none (G64 P)
  double spindle_limit = 0;         // fastest spindle, revolutions a minute; 0: no spindle speed is refused
  Point start;                      // machine position at the start
  // True: more operations may come after those that the source has given. At its end nothing is switched off.
  bool open_ended = false;
  // From rest to 1000 turns a minute. Motion waits for the spindle, and a tap has room to reverse.
  Seconds spindle_run_up{0};
  // True: in a thread the spindle turns as fast as the program says, whatever its override. Without an encoder nothing
  // follows the spindle, and another speed would be another pitch.
  bool threads_hold_speed = false;
  std::string file;  // names the program in diagnostics
};

// The code of the error that a move leaves the travel of an axis.
inline constexpr std::string_view travel_exceeded = "travel.exceeded";

// What a path builder remembers when it has handed on all items of the operations so far.
struct PathMemory {
  Frame frame_;
  bool in_step_ = false;  // in step with the spindle since its index
  Point position_;        // machine

  LengthUnits units_ = LengthUnits::mm;  // for messages
  FeedMode feed_mode_ = FeedMode::units_per_minute;
  operation::SetFeedRate feed_rate_;
  std::optional<Mm> synchronised_pitch_;
  PathMode path_mode_ = PathMode::continuous;
  Mm tolerance_{0};
  Heeds heeds_;
  bool gives_tolerance_ = false;  // the program gives a tolerance, with G64 P
  Mm merge_{0};

  OutputState commanded_;  // keeps the spindle's speed also while the spindle stands
  OutputState handed_on_;
  OperationSource outputs_source_;
  double refused_spindle_speed_ = 0;
  MmPerSecond refused_feed_{0};  // the last feed that no axis can make, and that follows the spindle
  Seconds run_up_left_{0};       // the spindle has not reached its speed before that

  // The axes on which the path is now outside the machine. An excursion is reported once, not at each of its moves.
  AxisSet below_;
  AxisSet above_;
  AxisSet missing_;
  std::array<bool, 4> told_{};  // what was already reported, by Lack
};

class PathBuilder final : public Source<PathItem>, private PathMemory {
 public:
  // `options` outlives the builder.
  PathBuilder(Source<Operation>& operations, const PathOptions& options, Diagnostics& diagnostics,
              const MachineAnswers& answers = no_answers());
  ~PathBuilder() override;

  [[nodiscard]] bool next(PathItem& item) override;

  const Frame& frame() const { return frame_; }
  // Where the path has come to, in machine coordinates.
  const Point& position() const { return position_; }
  // Says that the path goes on from somewhere else. What was read of the path before is not part of it any more.
  void stand_at(const Point& machine) {
    position_ = machine;
    below_ = above_ = missing_ = AxisSet();
    refused_feed_ = MmPerSecond(0);
  }
  // Notes what the operations so far have set, and goes back to that, as if those since had not come. Call when next()
  // has returned false.
  void keep() { kept_ = *this; }
  void roll_back() { static_cast<PathMemory&>(*this) = kept_; }

 private:
  bool next_operation();
  bool begin_tap(const operation::RigidTap& tap, PathItem& item);
  bool next_tap_step(PathItem& item);
  void expand(const operation::RigidTap& tap);
  Mm room_to_turn(const Curve& way) const;
  void switch_off();
  // True: the function wrote an item.
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
  bool add_curve(const Curve& curve, bool rapid, PathItem& item);

  Point machine_end(const Point& work_end) const;
  MmPerSecond feed_along(const Curve& curve);
  MmPerSecond feed_with_spindle(double mm_per_revolution);
  void set_spindle_speed(double revolutions_per_minute);
  void set_path_mode(const operation::SetPathMode& mode);
  void set_merge_tolerance(Mm given);
  enum class Lack : std::uint8_t { orientation, outputs, inputs, user_codes };
  void lacks(Lack what);
  void refuse_surface_speed(const operation::SetSpindleMode& mode);
  Heeds heeds() const;
  SpindleLock lock() const;
  OutputState outputs() const;
  Action outputs_action(Action::Kind kind = Action::Kind::outputs, Seconds dwell = Seconds(0)) const;
  bool must_await_index(const PathItem& item);
  bool must_await_speed(const PathItem& item);
  Seconds run_up_after(const OutputState& before) const;

  void check_thread(const Curve& curve, MmPerSecond speed);
  void check_travel(const Curve& curve);
  bool is_within_travel(const Box& box) const;
  void check_side(Axis axis, bool high_side, double reached, const Curve& curve, AxisSet& outside);
  void check_axes(const Curve& curve);
  // Reports at the axis word, or, where there is none, at the words that ask for the current operation.
  void report(Severity severity, std::string code, std::string message, std::string expected,
              std::optional<Axis> axis = std::nullopt);

  Source<Operation>& operations_;
  const PathOptions& options_;
  Diagnostics& diagnostics_;
  const MachineAnswers& answers_;

  // An arc in the turned work frame whose chords are not all given yet.
  struct TiltedArc {
    Curve work;
    std::uint32_t next = 0;
    std::uint32_t chords = 0;
  };
  std::optional<TiltedArc> tilted_;
  // A spline whose pieces are not all given yet.
  std::unique_ptr<SplinePieces> spline_;
  Mm piece_tolerance_{0};  // how far the pieces of the present curve may leave it
  // A probe move is three items. After them the path goes on from where the machine came to rest.
  enum class ProbeStep : std::uint8_t { none, move, end, rest };
  ProbeStep probe_step_ = ProbeStep::none;
  Point probe_end_;  // work coordinates

  // A tap that follows the spindle is three items too: down, the reversal, and back to where the tap began.
  enum class TapStep : std::uint8_t { none, turn, back, end };
  TapStep followed_tap_ = TapStep::none;
  Point tap_start_;  // machine

  Operation operation_;  // the current operation
  std::array<OperationKind, 4> tap_;
  std::size_t tap_step_ = tap_.size();
  std::deque<PathItem> held_;  // items that wait while an item before them is handed on
  PathMemory kept_;
};

}  // namespace passo
