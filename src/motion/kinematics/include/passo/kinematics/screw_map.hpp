// ScrewMap: which place a motor must be told so that its axis truly stands at a place: the inverse of the errors and of
// the backlash of its screw.
//
// A *true* place is one of the axis. A *nominal* place is the one that a perfect screw would have at the motor's
// present step. Both are in millimetres or degrees of the axis. The backlash is taken up in one of two directions.
// After motion up, the nominal place is as the errors alone demand. After motion down, it is lower by the backlash.
#pragma once

#include <vector>

namespace passo {

class ScrewMap {
 public:
  struct Error {
    double at = 0;   // nominal place
    double off = 0;  // true place minus nominal place
  };
  // `errors` may be empty. In ascending order of `at`; between two the error is in proportion, and beyond the ends it
  // stays. The error changes by less than the way.
  explicit ScrewMap(double backlash, std::vector<Error> errors = {});

  double backlash() const { return backlash_; }

  // Where the nominal place follows the true place in proportion: nominal = offset + slope * place, for places from
  // low to high.
  struct Piece {
    double low = 0;
    double high = 0;
    double slope = 1;
    double offset = 0;
  };
  // The piece that holds `place` and, if the place is a border within `border`, what lies above or below.
  const Piece& piece_at(double place, bool above, double border) const;

  double nominal(double place, bool down) const;
  // The inverse of nominal().
  double place(double nominal, bool down) const;

 private:
  double backlash_;
  std::vector<Piece> pieces_;
};

}  // namespace passo
