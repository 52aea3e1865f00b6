// ModalState: what stays in force from block to block. Lengths in millimetres, feeds in millimetres a second.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "passo/interpreter/frame.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

inline constexpr std::size_t work_offset_count = 9;

struct ModalState {
  std::optional<std::int32_t> motion;  // code in tenths; none at the start and after G80
  Plane plane = Plane::xy;
  LengthUnits units = LengthUnits::mm;
  bool incremental = false;
  bool diameters = false;  // G7: X words are diameters; positions are radii all the same
  bool arc_centers_absolute = false;
  FeedMode feed_mode = FeedMode::units_per_minute;
  double feed_rate = 0;  // as SetFeedRate; 0: none is set
  double spindle_speed = 0;
  SpindleDirection spindle = SpindleDirection::off;
  bool mist = false;
  bool flood = false;
  std::int32_t selected_tool = 0;
  std::int32_t tool = 0;
  PathMode path_mode = PathMode::continuous;

  std::size_t work_system = 0;  // 0 = G54
  std::array<Point, work_offset_count> work_offsets;
  std::array<double, work_offset_count> rotations{};
  Point g92_offset;
  bool g92_active = false;
  Point tool_offset;
  std::array<Point, 2> homes;  // G28, G30: machine positions

  Point work;  // where the tool is, in the work frame
  Frame frame;

  double scale() const { return units == LengthUnits::inch ? mm_per_inch : 1.0; }
};

}  // namespace passo
