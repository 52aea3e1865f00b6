#include "passo/interpreter/canon.hpp"

#include <iterator>

#include <fmt/format.h>

namespace passo {
namespace {

// Writes calls with values in the program's units.
class Call {
 public:
  Call(std::string& out, LengthUnits units) : out_(out), scale_(units == LengthUnits::inch ? mm_per_inch : 1) {}

  template <class... T>
  void print(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...);
  }
  double length(double mm) const { return tidy(mm / scale_); }
  double length(Mm mm) const { return length(mm.value()); }
  double value(const Point& point, Axis axis) const {
    return is_rotary(axis) ? tidy(point[axis]) : length(point[axis]);
  }
  void coordinates(const Point& p) {
    print("{:.4f}, {:.4f}, {:.4f}, {:.4f}, {:.4f}, {:.4f})", value(p, Axis::x), value(p, Axis::y), value(p, Axis::z),
          value(p, Axis::a), value(p, Axis::b), value(p, Axis::c));
  }
  void point(const char* name, const Point& p) {
    print("{}(", name);
    coordinates(p);
  }
  // Speeds are printed a minute.
  double per_minute(double per_second) const { return per_second * seconds_per_minute / scale_; }

 private:
  // No minus before a zero.
  static double tidy(double value) { return value > -0.00005 && value < 0.00005 ? 0 : value; }

  std::string& out_;
  double scale_;
};

struct Printer {
  Call& call;

  void operator()(const operation::SetLengthUnits& o) const {
    call.print("USE_LENGTH_UNITS({})", o.units == LengthUnits::inch ? "CANON_UNITS_INCHES" : "CANON_UNITS_MM");
  }
  void operator()(const operation::SetWorkOffset& o) const {
    call.print("SET_G5X_OFFSET({}, ", o.system);
    call.coordinates(o.offset);
  }
  void operator()(const operation::SetG92Offset& o) const { call.point("SET_G92_OFFSET", o.offset); }
  void operator()(const operation::SetRotation& o) const { call.print("SET_XY_ROTATION({:.4f})", o.degrees); }
  void operator()(const operation::SetToolOffset& o) const {
    const auto v = [&](Axis axis) { return call.value(o.offset, axis); };
    call.print("USE_TOOL_LENGTH_OFFSET({:.4f} {:.4f} {:.4f}, {:.4f} {:.4f} {:.4f}, {:.4f} {:.4f} {:.4f})", v(Axis::x),
               v(Axis::y), v(Axis::z), v(Axis::a), v(Axis::b), v(Axis::c), v(Axis::u), v(Axis::v), v(Axis::w));
  }
  void operator()(const operation::SelectPlane& o) const {
    constexpr const char* names[] = {"XY", "XZ", "YZ"};
    call.print("SELECT_PLANE(CANON_PLANE_{})", names[static_cast<int>(o.plane)]);
  }
  void operator()(const operation::SetFeedMode& o) const {
    call.print("SET_FEED_MODE(0, {})", o.mode == FeedMode::units_per_revolution ? 1 : 0);
  }
  void operator()(const operation::SetFeedRate& o) const {
    call.print("SET_FEED_RATE({:.4f})", call.per_minute(o.rate));
  }
  void operator()(const operation::SetPathMode& o) const {
    switch (o.mode) {
      case PathMode::exact_path: call.print("SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)"); break;
      case PathMode::exact_stop: call.print("SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)"); break;
      case PathMode::continuous:
        call.print("SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, {:.6f})", call.length(o.tolerance));
    }
  }
  void operator()(const operation::SetMergeTolerance& o) const {
    call.print("SET_NAIVECAM_TOLERANCE({:.4f})", call.length(o.tolerance));
  }
  void operator()(const operation::StraightTraverse& o) const { call.point("STRAIGHT_TRAVERSE", o.end); }
  void operator()(const operation::StraightFeed& o) const { call.point("STRAIGHT_FEED", o.end); }
  void operator()(const operation::ArcFeed& o) const {
    constexpr Axis axes[][3] = {{Axis::x, Axis::y, Axis::z}, {Axis::z, Axis::x, Axis::y}, {Axis::y, Axis::z, Axis::x}};
    const auto& plane = axes[static_cast<int>(o.plane)];
    call.print("ARC_FEED({:.4f}, {:.4f}, {:.4f}, {:.4f}, {}, {:.4f}, {:.4f}, {:.4f}, {:.4f})",
               call.value(o.end, plane[0]), call.value(o.end, plane[1]), call.length(o.first_center),
               call.length(o.second_center), o.turns, call.value(o.end, plane[2]), call.value(o.end, Axis::a),
               call.value(o.end, Axis::b), call.value(o.end, Axis::c));
  }
  void operator()(const operation::StartSpeedFeedSync& o) const {
    call.print("START_SPEED_FEED_SYNC({:.6f},{})", call.length(o.pitch), o.velocity_mode ? 1 : 0);
  }
  void operator()(const operation::StopSpeedFeedSync&) const { call.print("STOP_SPEED_FEED_SYNCH()"); }
  void operator()(const operation::Dwell& o) const { call.print("DWELL({:.4f})", o.time.value()); }
  void operator()(const operation::SetSpindleSpeed& o) const {
    call.print("SET_SPINDLE_SPEED(0, {:.4f})", o.revolutions_per_minute);
  }
  void operator()(const operation::TurnSpindle& o) const {
    constexpr const char* names[] = {"STOP_SPINDLE_TURNING", "START_SPINDLE_CLOCKWISE",
                                     "START_SPINDLE_COUNTERCLOCKWISE"};
    call.print("{}(0)", names[static_cast<int>(o.direction)]);
  }
  void operator()(const operation::SetMist& o) const { call.print("MIST_{}()", o.on ? "ON" : "OFF"); }
  void operator()(const operation::SetFlood& o) const { call.print("FLOOD_{}()", o.on ? "ON" : "OFF"); }
  void operator()(const operation::SelectTool& o) const { call.print("SELECT_TOOL({})", o.tool); }
  void operator()(const operation::ChangeTool& o) const { call.print("CHANGE_TOOL({})", o.tool); }
  void operator()(const operation::SetToolNumber& o) const { call.print("CHANGE_TOOL_NUMBER({})", o.tool); }
  void operator()(const operation::ProgramStop&) const { call.print("PROGRAM_STOP()"); }
  void operator()(const operation::OptionalProgramStop&) const { call.print("OPTIONAL_PROGRAM_STOP()"); }
  void operator()(const operation::ProgramEnd&) const { call.print("PROGRAM_END()"); }
  void operator()(const operation::Comment& o) const { call.print("COMMENT(\"{}\")", o.text); }
  void operator()(const operation::Message& o) const { call.print("MESSAGE(\"{}\")", o.text); }
  void operator()(const operation::SetSpindleMode&) const { call.print("SET_SPINDLE_MODE(0 0.0000)"); }
  void operator()(const operation::Reset&) const { call.print("ON_RESET()"); }
  void operator()(const operation::SetFeedReference&) const { call.print("SET_FEED_REFERENCE(CANON_XYZ)"); }
};

}  // namespace

void CanonPrinter::print(const Operation& operation, std::string& out) {
  if (const auto* units = std::get_if<operation::SetLengthUnits>(&operation.what)) units_ = units->units;
  const std::string number =
      operation.source.line_number >= 0 ? fmt::format("N{}", operation.source.line_number) : "N.....";
  fmt::format_to(std::back_inserter(out), "{:>5} {:<6} ", ++count_, number);
  Call call(out, units_);
  std::visit(Printer{call}, operation.what);
  out += '\n';
}

}  // namespace passo
