// ProgramState: the state set by the program so far. Its modal state has one code for each modal group.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "code_table.hpp"

#include "passo/geometry/axes.hpp"
#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/operation.hpp"
#include "passo/interpreter/tool_table.hpp"
#include "passo/units/units.hpp"

namespace passo {

class ModalState {
 public:
  // Sets the state in which LinuxCNC starts.
  ModalState() {
    for (const GroupRow& row : group_rows()) set(row.group, row.at_start);
  }
  CodeNumber operator[](ModalGroup group) const { return active_[index_of(group)]; }
  void set(ModalGroup group, CodeNumber number) { active_[index_of(group)] = number; }

  Plane plane() const {
    switch ((*this)[ModalGroup::plane]) {
      case code(17, 1): return Plane::uv;
      case code(18): return Plane::zx;
      case code(18, 1): return Plane::wu;
      case code(19): return Plane::yz;
      case code(19, 1): return Plane::vw;
      default: return Plane::xy;
    }
  }
  bool incremental() const { return (*this)[ModalGroup::distance] == code(91); }
  bool inches() const { return (*this)[ModalGroup::length_units] == code(20); }
  bool inverse_time() const { return (*this)[ModalGroup::feed_mode] == code(93); }
  bool per_revolution() const { return (*this)[ModalGroup::feed_mode] == code(95); }

 private:
  std::array<CodeNumber, modal_group_count> active_{};
};

// G51 scales the program's X Y Z by a factor about a centre. It scales moves but not offsets.
struct Scaling {
  bool on = false;
  Point center;  // work coordinates
  std::array<double, 3> factors = {1, 1, 1};

  double factor(Axis axis) const { return on && index_of(axis) < factors.size() ? factors[index_of(axis)] : 1; }
  double place(Axis axis, double value) const { return center[axis] + way(axis, value - center[axis]); }
  double way(Axis axis, double value) const { return value * factor(axis); }
};

inline constexpr double highest_tool = 99999;
inline constexpr std::size_t most_spindles = 8;
struct SpindleState {
  double speed = 0;          // S: rpm, or m/min or ft/min with constant surface speed
  double surface_limit = 0;  // above 0: constant surface speed, with this maximum rpm
  SpindleDirection direction = SpindleDirection::off;
  bool speed_override = true;
  friend bool operator==(const SpindleState&, const SpindleState&) = default;
};

// The tolerances of the last G64.
struct PathTolerance {
  Mm path{0};
  Mm merge{0};
};

// What is known about the lengths of tools in this program, on a machine that measures them (ToolChangePlan). `contact`
// is the machine Z at which a tool touched.
struct MeasuredTools {
  std::int32_t tool = 0;                 // the tool in the spindle, if it was measured; 0: it was not
  double contact = 0;                    // of that tool
  std::optional<double> reference = {};  // contact of the first tool
  double work_shift = 0;                 // by which the work's Z is moved now
  bool any_change = false;               // the program has named its tool before
  bool by_plan = false;                  // M6 moves and measures
};

// Whether M50 to M53 let the machine's factor and the hold button act on the feed.
struct FeedPermissions {
  bool adaptive = false;
  bool hold = true;
};

struct ProgramState {
  ModalState modal;
  Frame frame;
  Point position;      // the programmed position, in work coordinates, millimetres and degrees
  Point cutter_shift;  // cutter compensation: from `position` to the tool centre
  double feed = 0;     // F, mm/min or mm/rev; 0: no F was given
  Scaling scaling;
  std::array<SpindleState, most_spindles> spindles;
  int spindle_count = 1;
  bool mist = false;
  bool flood = false;
  bool feed_override = true;
  FeedPermissions feed_permissions;
  PathTolerance tolerance;
  bool on_machine = false;  // false: a preview
  ToolTable tools;
  Tool spindle_tool;                // the data of the tool in the spindle, whose number is `tool`
  std::int32_t tool = 0;            // the tool in the spindle; 0: none
  std::int32_t selected_tool = -1;  // the tool of the last T; -1: no T yet
  MeasuredTools measured;
  std::uint32_t line = 0;  // the line of the block being executed
  int call_depth = 0;

  // Returns the millimetres per length unit of the program.
  double length_unit() const { return modal.inches() ? mm_per_inch : 1; }
  double units_of(Axis axis) const { return is_rotary(axis) ? 1 : length_unit(); }
  Point tool_position() const { return position + cutter_shift; }
  Point machine_position() const { return frame.machine_from_work(tool_position()); }
  bool any_spindle_turns() const {
    return std::ranges::any_of(spindles,
                               [](const SpindleState& spindle) { return spindle.direction != SpindleDirection::off; });
  }
};

}  // namespace passo
