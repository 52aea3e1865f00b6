// RunReader: divides the path into pieces and runs. A run extends from one stop to the next, and is passed without
// stopping.
//
// The path stops at the ends of the program, at every action, at exact stops, and at corners that must not be rounded:
// where the path reverses, where the tolerance is 0, and in exact path mode where the path turns by more than a
// hundredth of a radian. Smaller turns come from rounding in programs, and are smoothed within a thousandth of a
// millimetre.
#pragma once

#include <optional>

#include "chord_fitter.hpp"

#include "passo/base/window.hpp"

namespace passo {

// A programmed segment, several merged ones, or the cubic of several chords.
struct Piece {
  Segment segment;
  double start = 0;  // s from the start of the run
  double length = 0;
  double tube = 0;  // maximum distance of the smoothed path from the piece: the tolerance minus the part used by
                    // merging
  bool rest_after = false;
  bool is_fitted = false;  // a cubic that replaces chords
  // dP/ds and d²P/ds² at the piece's ends.
  Point first_tangent;
  Point last_tangent;
  Point first_bend;
  Point last_bend;

  double end() const { return start + length; }
  bool is_line() const { return segment.curve.shape() == Curve::Shape::line; }
};

class RunReader {
 public:
  explicit RunReader(Source<PathItem>& path) : fitter_(path) {}

  // The next item: a run, an action, or the end.
  enum class Next { run, action, end };
  Next peek();
  Action take_action();

  // Begins a run: its first piece is pieces()[begin()].
  std::uint64_t begin();
  // Reads up to the piece with this number. Returns true if the run has that piece.
  bool has(std::uint64_t number);

  const Window<Piece>& pieces() const { return pieces_; }
  // Drops the pieces before this one, which must not be used again.
  void drop_before(std::uint64_t number) { pieces_.drop_before(number); }

 private:
  bool pull();
  void read_piece();
  // Returns the tolerance for rounding the junction between two pieces. 0: the junction is a stop.
  double tolerance_between(const Piece& before, const Segment& after) const;

  ChordFitter fitter_;
  PathItem ahead_;
  double ahead_deviation_ = 0;
  bool has_ahead_ = false;
  bool at_end_ = false;
  Window<Piece> pieces_;
  double junction_tolerance_ = 0;  // for the junction before the next piece; 0: that piece begins a run
};

}  // namespace passo
