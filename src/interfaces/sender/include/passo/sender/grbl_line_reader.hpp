// GrblLineReader: reads the lines that GrblCode writes, as the board does: which modes they set, and where they move.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "passo/geometry/axes.hpp"
#include "passo/grbl_planner/grbl_planner.hpp"
#include "passo/units/units.hpp"

namespace passo {

// The modes that such lines set, as $G reports them. Negative: not set yet.
struct GrblLineModes {
  int motion = -1;  // 0 to 3
  int plane = 17;
  double feed = -1;      // mm/min; G93: moves per minute
  bool by_time = false;  // G93
  int spindle = -1;      // 3, 4 or 5
  double speed = -1;     // rpm
};

struct GrblLineMotion {
  enum class Kind : std::uint8_t {
    modes,
    move,
    rest,     // waits until all motion is complete
    unknown,  // another one, e.g. a jog: where it leads is not known
  };
  Kind kind = Kind::modes;
  std::optional<GrblPlanner::Arc> arc = {};
  Point start = {};  // machine coordinates
  Point end = {};
  MmPerSecond feed{0};  // infinite: a rapid
  Seconds dwell{0};
};

class GrblLineReader {
 public:
  // The board is at `start`, in machine coordinates; `zero`: the work zero, as for GrblCode.
  GrblLineReader(const Point& start, const Point& zero) : at_(start), zero_(zero) {}

  GrblLineMotion read(std::string_view text);
  const GrblLineModes& modes() const { return modes_; }
  const Point& place() const { return at_; }
  const Point& zero() const { return zero_; }

 private:
  bool take(char letter, double value, GrblLineMotion& line);

  Point at_;
  Point zero_;
  GrblLineModes modes_;
  bool has_axis_ = false;
  PerAxis<double> center_;
};

}  // namespace passo
