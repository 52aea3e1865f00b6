// PathBuilder: operations -> segments. Follows the frame, keeps geometry exact (no chords), checks the travel.
//
// One exception: an arc of the planes ZX and YZ while the work frame is turned about Z lies in no plane of the machine,
// and is walked in chords within a thousandth of a millimetre. A spline becomes cubics of its length, which leave it by
// a tenth of the path's tolerance at most, or a thousandth of a millimetre where that is 0.
//
// Between the interpreter and the planner. Segments join without gap: each begins, bit for bit, where the one before
// ended. Moves shorter than a nanometre's thousandth are rounding, not moves, and are dropped. Outputs (spindle,
// coolant) that change without a move between them become one action.
//
// Errors are collected and the builder goes on, so that one pass finds them all; what it gives after an error is not
// to be played.
#pragma once

#include <array>
#include <deque>
#include <memory>
#include <optional>
#include <string>

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
  AxisSet axes;                 // the axes that the machine has
  PerAxis<TravelLimit> travel;  // machine coordinates
  Mm tolerance{0.01};           // of junctions, where the program gives none (G64 P)
  double spindle_limit = 0;     // fastest spindle, revolutions a minute; 0: no spindle speed is refused
  Point start;                  // machine position at the start
  Seconds spindle_run_up{0};    // from rest to 1000 turns a minute: so much room is left for a tap to turn round
  std::string file;             // names the program in diagnostics
};

class PathBuilder final : public Source<PathItem> {
 public:
  // `options` outlives the builder.
  PathBuilder(Source<Operation>& operations, const PathOptions& options, Diagnostics& diagnostics,
              const MachineAnswers& answers = no_answers());
  ~PathBuilder() override;

  [[nodiscard]] bool next(PathItem& item) override;

  const Frame& frame() const { return frame_; }

 private:
  bool next_operation();
  bool take_tap(const operation::RigidTap& tap, PathItem& item);
  bool take_tap_step(PathItem& item);
  void expand(const operation::RigidTap& tap);
  Mm room_to_turn(const Curve& way) const;
  void switch_off();
  // Each says whether it wrote an item.
  bool take(const Operation& operation, PathItem& item);
  bool take_line(const Point& work_end, bool rapid, PathItem& item);
  bool take_probe(const operation::StraightProbe& probe, PathItem& item);
  bool take_probe_step(PathItem& item);
  bool take_arc(const operation::ArcFeed& arc, PathItem& item);
  bool take_tilted_arc(const operation::ArcFeed& arc, PathItem& item);
  bool take_chord(PathItem& item);
  bool take_spline(const operation::NurbsFeed& curve, PathItem& item);
  bool take_spline_piece(PathItem& item);
  bool take_curve(const Curve& curve, bool rapid, PathItem& item);

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
  Action outputs_action() const;
  bool must_await_index(const PathItem& item);

  void check_travel(const Curve& curve);
  void check_side(Axis axis, bool high_side, double reached, const Curve& curve, AxisSet& outside);
  void check_axes(const Curve& curve);
  // Points at the axis word, or where there is none at the words that ask for the operation in hand.
  void report(Severity severity, std::string code, std::string message, std::string expected,
              std::optional<Axis> axis = std::nullopt);

  Source<Operation>& operations_;
  const PathOptions& options_;
  Diagnostics& diagnostics_;
  const MachineAnswers& answers_;
  Frame frame_;

  // An arc in the turned work frame, of which pieces are still to come.
  struct TiltedArc {
    Curve work;
    std::uint32_t next = 0;
    std::uint32_t chords = 0;
  };
  std::optional<TiltedArc> tilted_;
  // A spline, of which pieces are still to come.
  std::unique_ptr<SplinePieces> spline_;
  Mm spline_tolerance_{0};
  // A probe move is three items; and then the path goes on from where the machine came to rest.
  enum class ProbeStep : std::uint8_t { none, move, end, rest };
  ProbeStep probe_step_ = ProbeStep::none;
  Point probe_end_;  // work coordinates

  // And so is a tap that is followed: down, turned round, back to where it began.
  enum class TapStep : std::uint8_t { none, turn, back, end };
  TapStep followed_tap_ = TapStep::none;
  Point tap_start_;  // machine

  Operation operation_;  // the one in hand
  std::array<OperationKind, 4> tap_;
  std::size_t tap_step_ = tap_.size();
  std::deque<PathItem> held_;  // wait while what comes before them is handed on
  bool in_step_ = false;       // with the spindle, since its index
  Point position_;             // machine

  FeedMode feed_mode_ = FeedMode::units_per_minute;
  operation::SetFeedRate feed_rate_;
  std::optional<Mm> synchronised_pitch_;
  PathMode path_mode_ = PathMode::continuous;
  Mm tolerance_{0};
  Heeds heeds_;
  bool gives_tolerance_ = false;  // the program, with G64 P
  Mm merge_{0};

  OutputState commanded_;  // with the spindle's speed also while it stands
  OutputState handed_on_;
  OperationSource outputs_source_;
  double refused_spindle_speed_ = 0;

  // Where the path is outside the machine now: an excursion is reported once, not at each of its moves.
  AxisSet below_;
  AxisSet above_;
  AxisSet missing_;
  std::array<bool, 4> told_{};  // by Lack
};

}  // namespace passo
