// Operation: a canonical command. Operations are the meaning of a program, after modal state, offsets and expressions
// have been resolved.
//
// canon.hpp prints operations in exactly the format of `rs274 -g`. As in that output, coordinates are in the *work*
// frame, and separate operations set offsets (frame.hpp converts to machine positions). Unlike it, lengths are always
// in mm, and feeds in mm/s.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

#include "passo/geometry/axes.hpp"
#include "passo/units/units.hpp"

namespace passo {

struct Tool;

// G17, G18, G19, and the planes of U V W: G17.1, G18.1, G19.1. The planes of U V W have no arcs.
enum class Plane : std::uint8_t { xy, zx, yz, uv, wu, vw };
enum class LengthUnits : std::uint8_t { mm, inch };
enum class FeedMode : std::uint8_t { units_per_minute, inverse_time, units_per_revolution };  // G94, G93, G95
enum class PathMode : std::uint8_t { exact_path, exact_stop, continuous };                    // G61, G61.1, G64
enum class SpindleDirection : std::uint8_t { off, clockwise, counterclockwise };

namespace operation {

struct SetLengthUnits {
  LengthUnits units = LengthUnits::mm;
};
struct SetWorkOffset {
  std::uint8_t system = 1;
  Point offset;
};  // 1 = G54 … 9 = G59.3
struct SetG92Offset {
  Point offset;
};
struct SetRotation {
  double degrees = 0;
};  // rotates the work frame about Z
struct SetToolOffset {
  Point offset;
};
struct SelectPlane {
  Plane plane = Plane::xy;
};
struct SetFeedMode {
  FeedMode mode = FeedMode::units_per_minute;
};
// The feed of G94. The interpreter converts inverse time (G93) with the length of each move, as LinuxCNC does.
// `rotary` is for moves of A B C only.
struct FeedPerSecond {
  MmPerSecond linear{0};
  double rotary = 0;     // degrees/s, with any length unit
  bool by_time = false;  // from inverse time, so that the duration of the move counts
};
// The feed of G95, per revolution of the spindle.
struct FeedPerRevolution {
  Mm linear{0};
  double rotary = 0;  // degrees per revolution
};
// In the mode of the last SetFeedMode.
struct SetFeedRate {
  std::variant<FeedPerSecond, FeedPerRevolution> feed;
};
struct SetPathMode {
  PathMode mode = PathMode::continuous;
  Mm tolerance{0};
};  // tolerance 0: the machine's own
struct SetMergeTolerance {
  Mm tolerance{0};
};  // G64 Q, the naive cam detector
struct StraightTraverse {
  Point end;
};
struct StraightFeed {
  Point end;
};
// The end is in `end`, and the centre, in the plane's own two axes, in `first_center` and `second_center`. The axis
// normal to the plane and all others move proportionally (helix). `turns`: +n counterclockwise seen from the plane's
// positive axis, −n clockwise. 1 is up to one full turn, 2 one more.
struct ArcFeed {
  Plane plane = Plane::xy;
  Point end;
  Mm first_center;
  Mm second_center;
  std::int32_t turns = 1;
};
// A feed along a rational B-spline in X and Y; the other axes do not move. Its degree is `order` - 1 (2 to 9). Its
// knots are clamped, with all spans 1 long. The curve therefore starts at the first control point, the current
// position, and ends at the last. A Bézier curve (G5, G5.1) has as many control points as its order.
struct ControlPoint {
  double x = 0;  // mm
  double y = 0;
  double weight = 1;  // above 0
};
struct NurbsFeed {
  std::span<const ControlPoint> points;  // at least `order`; borrowed, valid until the next operation is pulled
  std::int32_t order = 3;
};
// Spindle-synchronised feed (G33): `pitch` in mm/rev, until the synchronised part ends.
struct StartSpeedFeedSync {
  Mm pitch;
  bool velocity_mode = false;
  std::uint8_t spindle = 0;
};
struct StopSpeedFeedSync {};
// G33.1: moves to `end`, synchronised with the spindle, and with the spindle reversed back to the start. Then the
// spindle turns as before. It comes between StartSpeedFeedSync and StopSpeedFeedSync.
struct RigidTap {
  Point end;
};
// G38: moves towards `end` until the probe is triggered (`toward`) or opens. It comes between TurnProbe on and off.
struct StraightProbe {
  Point end;
  bool toward = true;
  bool must_touch = true;  // error if the probe does not change during the move: G38.2, G38.4
};
struct TurnProbe {
  bool on = false;
};
struct Dwell {
  Seconds time;
};
// With constant surface speed (SetSpindleMode), the value is in m/min, or in ft/min if lengths are in inches.
struct SetSpindleSpeed {
  double revolutions_per_minute = 0;
  std::uint8_t spindle = 0;
};
// Above 0: constant surface speed (G96), with this limit in rpm. 0: constant speed (G97).
struct SetSpindleMode {
  double surface_limit = 0;
  std::uint8_t spindle = 0;
};
struct TurnSpindle {
  SpindleDirection direction = SpindleDirection::off;
  std::uint8_t spindle = 0;
};
// M19: turns the spindle to this angle and holds it there. AwaitSpindle (M19 Q) waits until the spindle is there.
struct OrientSpindle {
  enum class Way : std::uint8_t { shortest, clockwise, counterclockwise };
  double degrees = 0;
  Way way = Way::shortest;
  std::uint8_t spindle = 0;
};
struct AwaitSpindle {
  Seconds timeout;
  std::uint8_t spindle = 0;
};
struct SetMist {
  bool on = false;
};
struct SetFlood {
  bool on = false;
};
// M48 to M53: whether the operator's overrides of feed and spindle speed, the machine's own feed factor, and the feed
// hold button have an effect.
struct SetFeedOverride {
  bool on = true;
};
struct SetSpeedOverride {
  bool on = true;
  std::uint8_t spindle = 0;
};
struct SetAdaptiveFeed {
  bool on = true;
};
struct SetFeedHold {
  bool on = true;
};
// M62 to M68: sets an output with the next move, or immediately.
struct SetDigitalOutput {
  std::int32_t output = 0;
  bool on = false;
  bool with_motion = false;
};
struct SetAnalogOutput {
  std::int32_t output = 0;
  double value = 0;
  bool with_motion = false;
};
// M66: reads an input, or waits for it. rs274 prints no call for this.
struct ReadInput {
  enum class Until : std::uint8_t { now, rise, fall, high, low };
  std::int32_t input = 0;
  bool analog = false;
  Until until = Until::now;
  Seconds timeout;
};
// M100 to M199: the meaning depends on the machine. A missing word is -1.
struct UserCode {
  std::int32_t number = 100;
  double p = -1;
  double q = -1;
};
struct SelectTool {
  std::int32_t tool = 0;
};
struct StartToolChange {};  // M6 begins; ChangeTool follows
struct ChangeTool {
  std::int32_t tool = 0;
  bool by_machine = false;  // the tool is already in the spindle, so nobody is asked
};
struct SetToolNumber {
  std::int32_t tool = 0;
};  // M61
// G10 L1, L10, L11: an entry of the tool table has changed. `place` 0: the entry of the tool in the spindle.
struct SetToolTableEntry {
  std::int32_t place = 0;
  const Tool* tool = nullptr;  // borrowed, valid until the next operation is pulled
};
struct ReloadTools {};          // G10 L0
struct ProgramStop {};          // M0
struct OptionalProgramStop {};  // M1
struct ProgramEnd {};           // M2, M30
struct PalletShuttle {};        // M30, M60
struct Finish {};               // the program ended at its closing '%'
struct Comment {
  std::string_view text;
};
struct Message {
  std::string_view text;
};
struct Print {
  std::string_view text;
};  // (PRINT,…): a line for the operator
// (LOG,…) and similar comments: a line for a file, or which file. The interpreter never writes the file.
struct Log {
  enum class Kind : std::uint8_t { line, open, append, close };
  Kind kind = Kind::line;
  std::string_view text;
};
struct Reset {};             // ON_RESET: the interpreter (re)starts
struct SetFeedReference {};  // always XYZ

}  // namespace operation

using OperationKind =
    std::variant<operation::SetLengthUnits, operation::SetWorkOffset, operation::SetG92Offset, operation::SetRotation,
                 operation::SetToolOffset, operation::SelectPlane, operation::SetFeedMode, operation::SetFeedRate,
                 operation::SetPathMode, operation::SetMergeTolerance, operation::StraightTraverse,
                 operation::StraightFeed, operation::ArcFeed, operation::NurbsFeed, operation::StartSpeedFeedSync,
                 operation::StopSpeedFeedSync, operation::RigidTap, operation::Dwell, operation::SetSpindleSpeed,
                 operation::SetSpindleMode, operation::TurnSpindle, operation::SetMist, operation::SetFlood,
                 operation::SetFeedOverride, operation::SetSpeedOverride, operation::SelectTool,
                 operation::StraightProbe, operation::TurnProbe, operation::OrientSpindle, operation::AwaitSpindle,
                 operation::SetAdaptiveFeed, operation::SetFeedHold, operation::SetDigitalOutput,
                 operation::SetAnalogOutput, operation::ReadInput, operation::UserCode, operation::StartToolChange,
                 operation::ChangeTool, operation::SetToolNumber, operation::SetToolTableEntry, operation::ReloadTools,
                 operation::ProgramStop, operation::OptionalProgramStop, operation::ProgramEnd,
                 operation::PalletShuttle, operation::Finish, operation::Comment, operation::Message, operation::Print,
                 operation::Log, operation::Reset, operation::SetFeedReference>;

// The origin of an operation, for diagnostics.
struct OperationSource {
  std::uint32_t line = 0;         // line number in the file, from 1
  std::int64_t line_number = -1;  // N word; -1: none
  bool inserted = false;          // by the machine file: part of a tool change or of a hook
};

// A part of the line. The column counts from 1, in bytes. Column 0: there is no such part.
struct WordPlace {
  std::uint32_t column = 0;
  std::uint32_t length = 0;
  friend bool operator==(const WordPlace&, const WordPlace&) = default;
};
using AxisWords = PerAxis<WordPlace>;

struct Operation {
  OperationKind what;
  OperationSource source;
  // The words in the line that cause the operation, so that later stages can mark them without parsing G-code. Usually
  // this is only the code or S. For a move, it is all words of the block, with the position of each axis word (borrowed
  // until the next operation is pulled; null: none).
  WordPlace word{};
  const AxisWords* axis_words = nullptr;
  bool in_machine = false;  // a move to a machine position, by G53, G28 or G30
  // The file and the text of the line that the operation comes from, for diagnostics. Borrowed until the next operation
  // is pulled.
  std::string_view file{};
  std::string_view text{};
};

}  // namespace passo
