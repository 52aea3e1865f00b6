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
  double feed = 0;     // mm/min
  AxisSet named = {};  // by the program: axes that are written even if they seem to stand there
  Point to;
  struct Arc {
    double center_x = 0;
    double center_y = 0;
    bool clockwise = false;
  };
  std::optional<Arc> arc = {};
};

// Writes what is said to change, and no more: codes, axes and feeds are modal.
class PlainCode {
 public:
  explicit PlainCode(const std::function<void(std::string_view)>& write) : write_(write) {}

  // Where the machine stands in the work coordinates in force: what does not move from there is not written.
  void stand_at(const Point& place);
  void line(std::string_view text);
  void move(const PlainMove& move);

 private:
  const std::function<void(std::string_view)>& write_;
  std::string text_;
  PerAxis<std::int64_t> at_;  // as it was written
  AxisSet sure_;              // axes that were written, so they stand there
  std::int64_t feed_ = -1;
  int code_ = -1;
};

std::string code_of_system(int system);
// `merge` as `mode.tolerance`: the program gives none.
std::string path_mode_line(const operation::SetPathMode& mode, Mm merge);
// The line that says the same. Empty: there is nothing to say. Nothing: it cannot be said.
std::optional<std::string> plain_line_of(const Operation& operation);
// The words of a line that sets the tool's offset. Nothing: they depend on more than the line.
std::optional<std::string> tool_offset_words(std::string_view line, const Point& offset);
// True: the line moves to a place of the machine, not of the work: G53, G28, G30.
bool names_machine_place(std::string_view line);

}  // namespace passo
