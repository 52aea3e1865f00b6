// GrblCode: converts a path to G-code lines for a Grbl 1.1 machine.
//
// Position in the pipeline: a branch after the path builder. A Grbl machine plans its own motion, so it gets the path
// as it was built, neither smoothed nor planned: G0, G1, G2 and G3 in absolute millimetres, with the spindle, the
// coolant and the dwells between them. Loops, subroutines, cycles, offsets, tool lengths and cutter compensation have
// already been applied.
//
// Lines are modal: unchanged words are not written. Positions are rounded to a ten-thousandth of a millimetre, each
// independently, so errors do not accumulate. A full circle is written as two halves, because Grbl could take the
// rounded ends of a small arc for a full circle. A spline, and an arc with a changing radius, become chords within two
// thousandths of a millimetre.
//
// Axes are those of the board. Grbl divides the root of the sum of squares over all axes, mm and degrees alike, by F.
// So F is written such that a move takes as long as the program says. Where it depends on the build what F applies to,
// moves of rotary together with linear axes are written in inverse time (G93). An arc during which another axis than X,
// Y and Z moves becomes chords.
//
// Features that the board lacks are refused: axes, M7, probe moves, threads, taps. Differences from our boards: corners
// follow Grbl's junction deviation ($11), and M48 to M53 have no effect. An exact stop (G61.1) is a dwell of zero
// length, which waits until the machine has stopped.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/path/segment.hpp"
#include "passo/sender/grbl_target.hpp"

namespace passo {

class GrblCode {
 public:
  explicit GrblCode(const GrblTarget& target = {}) : target_(target) {}

  // A line that is answered when all motion is complete.
  static constexpr const char* wait_for_rest = "G4P0";
  // The modes that the lines need.
  static constexpr const char* known_modes = "G21G90G94G17G40G49G54";

  // Returns the line of the program to which an item belongs.
  static std::uint32_t source_line(const PathItem& item) {
    return std::visit([](const auto& one) { return one.source.line; }, item);
  }

  // Appends the lines of an item; none if nothing changes. Stops and tool changes produce only the lines of their
  // outputs; the caller must wait. The error is a clause that names what a Grbl machine does not support.
  Status<std::string> write(const PathItem& item, std::vector<std::string>& lines);
  // Lines of another origin have changed modes or the position: the next lines have all words.
  void forget_modes() {
    code_ = -1;
    plane_ = -1;
    feed_ = -1;
    by_time_ = false;
    sure_ = {};
  }
  // Returns whether the last line was in inverse time (G93).
  bool is_by_time() const { return by_time_; }

 private:
  using Place = PerAxis<std::int64_t>;

  Status<std::string> write_segment(const Segment& segment, std::vector<std::string>& lines);
  Status<std::string> write_action(const Action& action, std::vector<std::string>& lines);
  // `feed`: along the curve, mm/min or degrees/min; 0: a rapid.
  void write_line(const Point& start, const Point& end, double feed, double length, std::vector<std::string>& lines);
  void write_arc(const Curve& curve, double feed, std::vector<std::string>& lines);
  void write_chords(const Curve& curve, double feed, std::vector<std::string>& lines);
  void set_outputs(const OutputState& wanted, std::vector<std::string>& lines);
  std::string words_to(const Place& place, bool all_of_xyz);
  std::string code_words(int code, double feed, bool by_time = false);
  Place rounded(const Point& machine) const;

  GrblTarget target_;
  Place at_;
  AxisSet sure_;      // axes that were written, so their machine position is known
  AxisSet moved_{7};  // X, Y, Z, and other axes that have moved
  int code_ = -1;
  int plane_ = 17;
  bool by_time_ = false;  // G93
  std::int64_t feed_ = -1;
  OutputState outputs_;
  std::int64_t spindle_speed_ = -1;
};

}  // namespace passo
