// PlainCode: moves and what is between them as plain G-code: G0 to G3 in absolute millimetres. Private to probing/.
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
  AxisSet named = {};     // by the program: axes that are written even if they seem to stand there
  AxisSet absolute = {};  // named where they end, not how far they go
  Point to;
  struct Arc {
    double center_x = 0;
    double center_y = 0;
    bool clockwise = false;
  };
  std::optional<Arc> arc = {};
};

// Writes what is said to change, and no more: codes, axes and feeds are modal.
//
// An axis whose place in the work is known, or is named, is written as a place (G90). Any other axis only goes so far
// as it is meant to go (G91), wherever the machine stands.
class PlainCode {
 public:
  explicit PlainCode(const std::function<void(std::string_view)>& write) : write_(write) {}

  // Where the machine stands in the work coordinates in force: what does not move from there is not written.
  void stand_at(const Point& place);
  // Nobody knows any more where these axes stand in the work.
  void forget(AxisSet axes);
  void line(std::string_view text);
  void move(const PlainMove& move);
  // G53: to a place of the machine.
  void machine_move(bool rapid, double feed, AxisSet axes, const Point& machine);
  // A cycle at a place in X and Y. `code` with "G98" or "G99": whether it ends at a height that is known.
  void cycle(std::string_view code, std::string_view words, double feed, const Point& end, bool is_height_known);
  // G28 or G30, from here: of these axes, or of all where none is given.
  void home(std::string_view code, AxisSet axes);

 private:
  void write_mode(bool incremental);
  void write_feed(double feed);
  void write_line();

  const std::function<void(std::string_view)>& write_;
  std::string text_;
  PerAxis<std::int64_t> at_;  // as it was written
  AxisSet known_;             // axes that were written as a place, so they stand there
  std::int64_t feed_ = -1;
  int code_ = -1;
  bool is_incremental_ = false;
};

std::string code_of_system(int system);
int system_of_code(std::string_view code);
// `merge` as `mode.tolerance`: the program gives none.
std::string path_mode_line(const operation::SetPathMode& mode, Mm merge);
// The line that says the same. Empty: there is nothing to say. Nothing: it cannot be said.
std::optional<std::string> plain_line_of(const Operation& operation);

}  // namespace passo
