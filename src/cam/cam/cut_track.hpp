// CutTrack: a closed way of the cutter by its length, and the runs that go down along it. Private to cam/.
#pragma once

#include <utility>
#include <vector>

#include "passo/cam/mill_plan.hpp"

namespace passo {

class CutTrack {
 public:
  // The last point leads back to the first.
  explicit CutTrack(const std::vector<PathPoint>& points);

  double length() const { return length_; }
  DrawnPoint at(double along) const;
  // The direction there, in radians.
  double direction(double along) const;
  // Where along the track the place nearest to `point` is, and how far away.
  std::pair<double, double> nearest(DrawnPoint point) const;
  // The straight pieces, from where to where.
  std::vector<std::pair<double, double>> straights() const;

  // In these stretches the cutter never goes below `top`. Stretches may go beyond the end, and on from the start.
  void keep_above(Nanometres top, std::vector<std::pair<double, double>> stretches);

  // Adds the way from one place to the other, which may go around several times, while the height changes evenly. The
  // run ends at `from`, or is empty.
  void append(MillRun& run, double from, double to, Nanometres from_z, Nanometres to_z) const;

 private:
  struct Piece {
    DrawnPoint from;
    DrawnPoint to;
    double bulge;
    double start;
    double length;
  };
  const Piece& piece_at(double along) const;  // 0 <= along < length
  bool is_kept(double along) const;
  double turned(double along) const;

  std::vector<Piece> pieces_;
  double length_ = 0;
  Nanometres top_ = {};
  std::vector<std::pair<double, double>> kept_;
};

}  // namespace passo
