// ScrewMap: converts the true position of an axis into the nominal position that its motor must be commanded to, which
// corrects the errors and the backlash of its screw.
//
// The *true* position is that of the axis. The *nominal* position is the position that the axis would have with a
// perfect screw. Both are in millimetres or degrees of the axis. The backlash is taken up in one of two directions.
// After motion in the positive direction, the nominal position corrects only the errors. After motion in the negative
// direction, it is lower by the backlash.
#pragma once

#include <vector>

namespace passo {

class ScrewMap {
 public:
  struct Error {
    double at = 0;   // nominal position
    double off = 0;  // true position minus nominal position
  };
  // `errors` may be empty. In ascending order of `at`; between two entries the error is interpolated, and beyond the
  // ends it is constant. The slope of the error must be below 1 in magnitude.
  explicit ScrewMap(double backlash, std::vector<Error> errors = {});

  double backlash() const { return backlash_; }
  // Whether the motor may take up the backlash while the axis moves. Pitch errors depend on the position of the axis,
  // which does not follow from the motor's position at that time. So a screw with pitch errors takes up its backlash at
  // a stop.
  bool can_take_up_in_motion() const { return backlash_ > 0 && pieces_.size() <= 2; }

  // A linear piece of the map: nominal = offset + slope * place, for true positions from low to high.
  struct Piece {
    double low = 0;
    double high = 0;
    double slope = 1;
    double offset = 0;
  };
  // The piece that contains `place`. Within `border` of a border, `above` selects one of the two pieces.
  const Piece& piece_at(double place, bool above, double border) const;

  double nominal(double place, bool down) const;
  // The inverse of nominal().
  double place(double nominal, bool down) const;

 private:
  double backlash_;
  std::vector<Piece> pieces_;
};

}  // namespace passo
