// ClosedToolpath: a closed toolpath parametrised by its length, with runs that ramp down along it. Private to cam/.
#pragma once

#include <utility>
#include <vector>

#include "passo/cam/mill_plan.hpp"

namespace passo {

class ClosedToolpath {
 public:
  // The track is closed: the last point leads back to the first.
  explicit ClosedToolpath(const std::vector<PathPoint>& points);

  double length() const { return length_; }
  DrawnPoint at(double along) const;
  // Returns the direction of travel at this length, in radians.
  double direction(double along) const;
  // Returns the length along the track at the point nearest to `point`, and the distance to that point.
  std::pair<double, double> nearest(DrawnPoint point) const;
  // Returns whether all of the track lies in the disc, within a micrometre.
  bool is_within(DrawnPoint centre, double radius) const;
  // Returns the same track, beginning at this length.
  ClosedToolpath from(double along) const;
  // Returns the start and end of each straight piece.
  std::vector<std::pair<double, double>> straights() const;

  // Keeps the cutter at or above `top` in these stretches. A stretch may extend beyond the end of the track; it then
  // continues at the start.
  void keep_above(Nanometres top, std::vector<std::pair<double, double>> stretches);

  // Returns whether the cutter is kept up anywhere between the two lengths.
  bool keeps(double from, double to) const;

  // Appends the toolpath between the two lengths, which may go around several times; the height changes linearly. The
  // run must end at `from` or be empty.
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
