#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <variant>

#include "decimal_text.hpp"

#include "passo/interpreter/canon.hpp"
#include "passo/interpreter/tool_table.hpp"

namespace passo {
namespace {

constexpr std::size_t counter_width = 5;
constexpr std::size_t line_number_digits = 6;

// A value below this rounds to zero. It is printed as 0.0000, never as -0.0000, because the sign of a rounding error
// means nothing.
constexpr double smallest_shown = 0.00005;
constexpr char zero[] = "0.0000";

// The text of one operation. It is put together in a buffer of its own and given to `out` at once.
class Line {
 public:
  Line(std::string& out, LengthUnits units) : out_(out), scale_(units == LengthUnits::inch ? mm_per_inch : 1) {}
  Line(const Line&) = delete;
  Line& operator=(const Line&) = delete;
  ~Line() { flush(); }

  // A text of the program's own: its size is known when Passo is compiled.
  template <std::size_t size>
  Line& operator<<(const char (&text)[size]) {
    static_assert(size <= longest_decimal_text);
    make_room();
    std::memcpy(at_, text, size - 1);
    at_ += size - 1;
    return *this;
  }
  Line& operator<<(std::string_view text) {
    if (text.size() > static_cast<std::size_t>(end() - at_)) {
      flush();
      if (text.size() > buffer_.size()) return out_ += text, *this;
    }
    std::memcpy(at_, text.data(), text.size());
    at_ += text.size();
    return *this;
  }
  Line& whole(std::int64_t value) {
    make_room();
    if (value < 0) *at_++ = '-';
    at_ = write_whole(at_, value < 0 ? 0 - static_cast<std::uint64_t>(value) : static_cast<std::uint64_t>(value));
    return *this;
  }
  Line& number(double value) {
    if (std::abs(value) < smallest_shown) return *this << zero;
    make_room();
    at_ = write_decimal_4(at_, value);
    return *this;
  }
  Line& six_digits(double value) {
    make_room();
    at_ = write_decimal_6(at_, value);
    return *this;
  }
  // A length in the program's units.
  Line& length(double mm) { return number(mm / scale_); }
  Line& length(const Point& point, Axis axis) { return is_rotary(axis) ? number(point[axis]) : length(point[axis]); }
  // X Y Z A B C: the axes that rs274 is compiled for.
  Line& point(const Point& point) {
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) (length(point, axis)) << ", ";
    return rotary(point);
  }
  Line& rotary(const Point& point) {
    const auto is_zero = [&](Axis axis) { return std::abs(point[axis]) < smallest_shown; };
    if (is_zero(Axis::a) && is_zero(Axis::b) && is_zero(Axis::c)) return *this << "0.0000, 0.0000, 0.0000";
    return (((length(point, Axis::a)) << ", ").length(point, Axis::b) << ", ").length(point, Axis::c);
  }
  // The counter and the line number, each in its column.
  Line& head(std::uint64_t count, std::int64_t line_number) {
    std::array<char, longest_decimal_text> digits;
    const auto size = static_cast<std::size_t>(write_whole(digits.data(), count) - digits.data());
    for (std::size_t i = size; i < counter_width; ++i) *this << " ";
    *this << std::string_view(digits.data(), size);
    if (line_number < 0) return *this << " N..... ";
    const char* const number = (*this << " N").at_;
    whole(line_number);
    for (auto i = static_cast<std::size_t>(at_ - number); i < line_number_digits; ++i) *this << " ";
    return *this;
  }
  double scale() const { return scale_; }

 private:
  char* end() { return buffer_.data() + buffer_.size(); }
  // Gives the buffer away if the longest number no longer fits.
  void make_room() {
    if (end() - at_ < static_cast<std::ptrdiff_t>(longest_decimal_text)) flush();
  }
  void flush() {
    out_.append(buffer_.data(), static_cast<std::size_t>(at_ - buffer_.data()));
    at_ = buffer_.data();
  }

  std::string& out_;
  double scale_;
  std::array<char, 1024> buffer_;
  char* at_ = buffer_.data();
};

const char* canon_plane(Plane plane) {
  switch (plane) {
    case Plane::xy: return "XY";
    case Plane::zx: return "XZ";
    case Plane::yz: return "YZ";
    default: return "UNKNOWN";  // rs274 has no names for the planes of U V W
  }
}

// Each call below is named and written exactly as in saicanon.cc of LinuxCNC 2.9. The first number of a spindle call is
// the number of the spindle.
struct Call {
  Line& line;
  LengthUnits machine_units;

  void operator()(const operation::SetLengthUnits& set) const {
    line << (set.units == LengthUnits::inch ? "USE_LENGTH_UNITS(CANON_UNITS_INCHES)"
                                            : "USE_LENGTH_UNITS(CANON_UNITS_MM)");
  }
  void operator()(const operation::SetWorkOffset& set) const {
    ((line << "SET_G5X_OFFSET(").whole(set.system) << ", ").point(set.offset) << ")";
  }
  void operator()(const operation::SetG92Offset& set) const { (line << "SET_G92_OFFSET(").point(set.offset) << ")"; }
  void operator()(const operation::SetRotation& set) const { (line << "SET_XY_ROTATION(").number(set.degrees) << ")"; }
  void operator()(const operation::SetToolOffset& set) const {
    line << "USE_TOOL_LENGTH_OFFSET(";
    for (const Axis axis : all_axes) {
      const bool last_of_three = axis == Axis::z || axis == Axis::c;
      line.length(set.offset, axis) << (axis == Axis::w ? ")" : last_of_three ? ", " : " ");
    }
  }
  void operator()(const operation::SelectPlane& select) const {
    line << "SELECT_PLANE(CANON_PLANE_" << canon_plane(select.plane) << ")";
  }
  void operator()(const operation::SetFeedMode& set) const {
    line << (set.mode == FeedMode::units_per_revolution ? "SET_FEED_MODE(0, 1)" : "SET_FEED_MODE(0, 0)");
  }
  void operator()(const operation::SetFeedRate& set) const {
    const auto* per_second = std::get_if<operation::FeedPerSecond>(&set.feed);
    const double feed = per_second != nullptr ? per_second->linear.value() * seconds_per_minute
                                              : std::get<operation::FeedPerRevolution>(set.feed).linear.value();
    (line << "SET_FEED_RATE(").length(feed) << ")";
  }
  void operator()(const operation::SetPathMode& set) const {
    if (set.mode == PathMode::continuous) {
      (line << "SET_MOTION_CONTROL_MODE(CANON_CONTINUOUS, ").six_digits(set.tolerance.value() / line.scale()) << ")";
    } else {
      line << (set.mode == PathMode::exact_path ? "SET_MOTION_CONTROL_MODE(CANON_EXACT_PATH)"
                                                : "SET_MOTION_CONTROL_MODE(CANON_EXACT_STOP)");
    }
  }
  void operator()(const operation::SetMergeTolerance& set) const {
    (line << "SET_NAIVECAM_TOLERANCE(").length(set.tolerance.value()) << ")";
  }
  void operator()(const operation::StraightTraverse& move) const {
    (line << "STRAIGHT_TRAVERSE(").point(move.end) << ")";
  }
  void operator()(const operation::StraightFeed& move) const { (line << "STRAIGHT_FEED(").point(move.end) << ")"; }
  void operator()(const operation::ArcFeed& arc) const {
    constexpr Axis axes[][3] = {{Axis::x, Axis::y, Axis::z}, {Axis::z, Axis::x, Axis::y}, {Axis::y, Axis::z, Axis::x}};
    const Axis* const plane = axes[static_cast<std::size_t>(arc.plane)];
    (line << "ARC_FEED(").length(arc.end, plane[0]) << ", ";
    line.length(arc.end, plane[1]) << ", ";
    line.length(arc.first_center.value()) << ", ";
    line.length(arc.second_center.value()) << ", ";
    line.whole(arc.turns) << ", ";
    line.length(arc.end, plane[2]) << ", ";
    line.rotary(arc.end) << ")";
  }
  // rs274 prints only the number of control points.
  void operator()(const operation::NurbsFeed& curve) const {
    (line << "NURBS_FEED(").whole(static_cast<std::int64_t>(curve.points.size())) << ", ...)";
  }
  void operator()(const operation::StartSpeedFeedSync& start) const {
    (line << "START_SPEED_FEED_SYNC(").six_digits(start.pitch.value() / line.scale())
        << (start.velocity_mode ? ",1)" : ",0)");
  }
  void operator()(const operation::StopSpeedFeedSync&) const { line << "STOP_SPEED_FEED_SYNCH()"; }
  void operator()(const operation::RigidTap& tap) const {
    (line << "RIGID_TAP(").length(tap.end, Axis::x) << ", ";
    (line.length(tap.end, Axis::y) << ", ").length(tap.end, Axis::z) << ")";
  }
  void operator()(const operation::Dwell& dwell) const { (line << "DWELL(").number(dwell.time.value()) << ")"; }
  void operator()(const operation::SetSpindleSpeed& set) const {
    ((line << "SET_SPINDLE_SPEED(").whole(set.spindle) << ", ").number(set.revolutions_per_minute) << ")";
  }
  void operator()(const operation::SetSpindleMode& set) const {
    ((line << "SET_SPINDLE_MODE(").whole(set.spindle) << " ").number(set.surface_limit) << ")";
  }
  void operator()(const operation::TurnSpindle& turn) const {
    constexpr const char* calls[] = {"STOP_SPINDLE_TURNING(", "START_SPINDLE_CLOCKWISE(",
                                     "START_SPINDLE_COUNTERCLOCKWISE("};
    (line << calls[static_cast<std::size_t>(turn.direction)]).whole(turn.spindle) << ")";
  }
  void operator()(const operation::SetMist& set) const { line << (set.on ? "MIST_ON()" : "MIST_OFF()"); }
  void operator()(const operation::SetFlood& set) const { line << (set.on ? "FLOOD_ON()" : "FLOOD_OFF()"); }
  void operator()(const operation::SetFeedOverride& set) const {
    line << (set.on ? "ENABLE_FEED_OVERRIDE()" : "DISABLE_FEED_OVERRIDE()");
  }
  void operator()(const operation::SetSpeedOverride& set) const {
    (line << (set.on ? "ENABLE_SPEED_OVERRIDE(" : "DISABLE_SPEED_OVERRIDE(")).whole(set.spindle) << ")";
  }
  void operator()(const operation::SetAdaptiveFeed& set) const {
    line << (set.on ? "ENABLE_ADAPTIVE_FEED()" : "DISABLE_ADAPTIVE_FEED()");
  }
  void operator()(const operation::SetFeedHold& set) const {
    line << (set.on ? "ENABLE_FEED_HOLD()" : "DISABLE_FEED_HOLD()");
  }
  void operator()(const operation::StraightProbe& probe) const { (line << "STRAIGHT_PROBE(").point(probe.end) << ")"; }
  void operator()(const operation::TurnProbe& turn) const {
    line << (turn.on ? "TURN_PROBE_ON()" : "TURN_PROBE_OFF()");
  }
  void operator()(const operation::OrientSpindle& orient) const {
    ((line << "ORIENT_SPINDLE(").whole(orient.spindle) << ", ").number(orient.degrees) << ", ";
    line.whole(static_cast<int>(orient.way)) << ")";
  }
  void operator()(const operation::AwaitSpindle& await) const {
    (line << "SPINDLE.").whole(await.spindle) << ".WAIT_ORIENT_COMPLETE(";
    line.number(await.timeout.value()) << ")";
  }
  void operator()(const operation::SetDigitalOutput& set) const {
    line << (set.on ? "SET_" : "CLEAR_") << (set.with_motion ? "MOTION" : "AUX");
    (line << "_OUTPUT_BIT(").whole(set.output) << ")";
  }
  void operator()(const operation::SetAnalogOutput& set) const {
    (line << (set.with_motion ? "SET_MOTION_OUTPUT_VALUE(" : "SET_AUX_OUTPUT_VALUE(")).whole(set.output) << ",";
    line.six_digits(set.value) << ")";
  }
  void operator()(const operation::ReadInput&) const {}
  void operator()(const operation::UserCode& user) const {
    (line << "USER_DEFINED_FUNCTION(").whole(user.number) << ", ";
    (line.six_digits(user.p) << ", ").six_digits(user.q) << ")";
  }
  void operator()(const operation::SelectTool& select) const { (line << "SELECT_TOOL(").whole(select.tool) << ")"; }
  void operator()(const operation::StartToolChange&) const { line << "START_CHANGE()"; }
  void operator()(const operation::ChangeTool& change) const { (line << "CHANGE_TOOL(").whole(change.tool) << ")"; }
  void operator()(const operation::SetToolNumber& set) const { (line << "CHANGE_TOOL_NUMBER(").whole(set.tool) << ")"; }
  void operator()(const operation::SetToolTableEntry& set) const {
    const double unit = machine_units == LengthUnits::inch ? mm_per_inch : 1;
    ((line << "SET_TOOL_TABLE_ENTRY(").whole(set.place) << ", ").whole(set.tool->number) << ", ";
    for (const Axis axis : all_axes) {
      line.number(set.tool->offset[axis] / (is_rotary(axis) ? 1 : unit)) << (axis == Axis::w ? ", " : " ");
    }
    (line.number(set.tool->front_angle_deg) << ", ").number(set.tool->back_angle_deg) << ", ";
    line.whole(set.tool->orientation) << ")";
  }
  void operator()(const operation::ReloadTools&) const { line << "RELOAD_TOOLDATA()"; }
  void operator()(const operation::ProgramStop&) const { line << "PROGRAM_STOP()"; }
  void operator()(const operation::OptionalProgramStop&) const { line << "OPTIONAL_PROGRAM_STOP()"; }
  void operator()(const operation::ProgramEnd&) const { line << "PROGRAM_END()"; }
  void operator()(const operation::PalletShuttle&) const { line << "PALLET_SHUTTLE()"; }
  void operator()(const operation::Finish&) const { line << "FINISH()"; }
  void operator()(const operation::Comment& comment) const { line << "COMMENT(\"" << comment.text << "\")"; }
  void operator()(const operation::Message& message) const { line << "MESSAGE(\"" << message.text << "\")"; }
  void operator()(const operation::Print& print) const { line << print.text; }
  void operator()(const operation::Log& log) const {
    switch (log.kind) {
      case operation::Log::Kind::line: line << "LOG(\"" << log.text << "\")"; return;
      case operation::Log::Kind::open: line << "LOGOPEN(\"" << log.text << "\")"; return;
      case operation::Log::Kind::append: line << "LOGAPPEND(\"" << log.text << "\")"; return;
      case operation::Log::Kind::close: line << "LOGCLOSE()"; return;
    }
  }
  void operator()(const operation::Reset&) const { line << "ON_RESET()"; }
  void operator()(const operation::SetFeedReference&) const { line << "SET_FEED_REFERENCE(CANON_XYZ)"; }
};

}  // namespace

void CanonPrinter::print(const Operation& operation, std::string& out) {
  if (const auto* set = std::get_if<operation::SetLengthUnits>(&operation.what)) units_ = set->units;
  if (std::holds_alternative<operation::ReadInput>(operation.what)) return;  // rs274 prints nothing for it
  // The text of (PRINT,…) goes to the operator unchanged. rs274 prints no counter and no N before it.
  Line line(out, units_);
  if (!std::holds_alternative<operation::Print>(operation.what)) {
    line.head(++count_, operation.source.line_number);
  }
  std::visit(Call{line, machine_units_}, operation.what);
  line << "\n";
}

}  // namespace passo
