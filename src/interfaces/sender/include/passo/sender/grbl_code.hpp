// GrblCode: a path as lines for a Grbl 1.1 machine.
//
// Place on the street: beside the street, after the path builder. A Grbl machine takes G-code and plans its own motion,
// so it gets the path as it was built, neither smoothed nor planned: G0, G1, G2 and G3 in absolute millimetres, with
// the spindle, the coolant and the dwells between them. Loops, subprograms, cycles, offsets, tool lengths and the
// cutter's radius are already worked in.
//
// Lines are modal: what has not changed is not written. Places are rounded to a ten-thousandth of a millimetre, and
// each is rounded by itself, so errors do not add up. A full circle is written as two halves, because the rounded ends
// of a small arc could mean a full circle to Grbl. A spline, and an arc whose radius changes, become chords within two
// thousandths of a millimetre.
//
// What Grbl cannot do is refused: other axes than X, Y and Z, probe moves, threads, taps. What it does otherwise than
// our boards: corners follow its own junction deviation ($11), and M48 to M53 have no effect. An exact stop (G61.1) is
// a dwell of no length, which waits until the machine rests.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/path/segment.hpp"

namespace passo {

class GrblCode {
 public:
  // `zero`: where the zero of the work lies in machine coordinates, X, Y and Z; the lines count from there.
  explicit GrblCode(const Point& zero = {}) : zero_(zero) {}

  // Appends the lines of an item; none where nothing changes. Stops and tool changes have no lines but those of their
  // outputs: the caller waits. The error is a clause that says what a Grbl machine cannot do.
  Status<std::string> write(const PathItem& item, std::vector<std::string>& lines);

 private:
  using Place = PerAxis<std::int64_t>;

  Status<std::string> write_segment(const Segment& segment, std::vector<std::string>& lines);
  Status<std::string> write_action(const Action& action, std::vector<std::string>& lines);
  void write_line(const Point& end, double feed, std::vector<std::string>& lines);
  void write_arc(const Curve& curve, double feed, std::vector<std::string>& lines);
  void write_chords(const Curve& curve, double feed, std::vector<std::string>& lines);
  void set_outputs(const OutputState& wanted, std::vector<std::string>& lines);
  std::string words_to(const Place& place, bool all_of_them);
  std::string code_words(int code, double feed);
  Place rounded(const Point& machine) const;

  Point zero_;
  Place at_;
  AxisSet sure_;  // axes that were written, so the machine stands there
  int code_ = -1;
  int plane_ = 17;
  std::int64_t feed_ = -1;
  OutputState outputs_;
  std::int64_t spindle_speed_ = -1;
};

}  // namespace passo
