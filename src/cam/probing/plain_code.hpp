// PlainCode: writes moves, and what is between them, as plain G-code: G0 to G3 in absolute millimetres. Private to
// probing/.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "passo/geometry/axes.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

struct PlainMove {
  bool rapid = false;
  double feed = 0;        // mm/min
  AxisSet named = {};     // axes specified by the program: written even if their position does not change
  AxisSet absolute = {};  // axes of which the end position is specified, not the distance
  Point to;
  struct Arc {
    double center_x = 0;
    double center_y = 0;
    bool clockwise = false;
  };
  std::optional<Arc> arc = {};
};

// Writes only changes: codes, axes and feeds are modal.
//
// An axis whose work position is known or specified is written with its absolute position (G90). Any other axis moves
// by its programmed distance (G91), wherever the machine is.
class PlainCode {
 public:
  explicit PlainCode(const std::function<void(std::string_view)>& write) : write_(write) {}

  // Sets the machine's current work coordinates: axes that do not move from there are not written.
  void stand_at(const Point& place);
  // Marks the work position of these axes as unknown.
  void forget(AxisSet axes);
  void line(std::string_view text);
  void move(const PlainMove& move);
  // G53: moves to a position in machine coordinates.
  void machine_move(bool rapid, double feed, AxisSet axes, const Point& machine);
  // Writes a cycle at a position in X and Y. `code` with "G98" or "G99". `is_height_known`: whether its final height is
  // known.
  void cycle(std::string_view code, std::string_view words, double feed, const Point& end, bool is_height_known);
  // Writes G28 or G30 from the current position, for these axes, or for all if none is given.
  void home(std::string_view code, AxisSet axes);

 private:
  void write_mode(bool incremental);
  void write_feed(double feed);
  void write_line();

  const std::function<void(std::string_view)>& write_;
  std::string text_;
  PerAxis<std::int64_t> at_;  // the position as written
  AxisSet known_;             // axes whose position was written, so it is known
  std::int64_t feed_ = -1;
  int code_ = -1;
  bool is_incremental_ = false;
};

std::string code_of_system(int system);
int system_of_code(std::string_view code);
// `merge`: used as `mode.tolerance` if the program specifies none.
std::string path_mode_line(const operation::SetPathMode& mode, Mm merge);
// Returns an equivalent line. Empty: nothing needs to be written. Nothing: the operation cannot be expressed.
std::optional<std::string> plain_line_of(const Operation& operation);

}  // namespace passo
