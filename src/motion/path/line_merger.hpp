// LineMerger: merges consecutive lines that are straight within the merge tolerance into one line.
//
// A line may include the next one as long as all vertices in between are within `Segment::merge` of the chord from its
// start to the new end. Instead of the vertices, the merger stores a ball of directions. Every chord whose direction (a
// unit vector) is in the ball passes all vertices so far closely enough. A vertex at the distance r allows directions
// within merge/r of its own direction. The new ball is the largest ball in the intersection of the old ball and these
// directions. So each vertex has the same cost. A line that was programmed in pieces becomes one line again, with the
// total length and time.
//
// First, an arc that hardly leaves its chord becomes this chord. So the short arcs with which CAM programs write a
// curve are merged and fitted like chords, and the circles of a few micrometres with which they drill become lines.
//
// Only lines with equal speed, kind, tolerance and length-defining axes are merged. No merged line reverses.
#pragma once

#include "passo/base/source.hpp"
#include "passo/path/segment.hpp"

namespace passo {

// Whether two segments have the same speed, the same enabled overrides and holds, the same spindle synchronisation, and
// the same outputs.
bool are_played_alike(const Segment& before, const Segment& after);
// Whether only the curve changes from a segment to the next, and the path is continuous between them.
bool are_alike(const Segment& before, const Segment& after);

class LineMerger {
 public:
  // Limits the time that an item can make its caller wait.
  static constexpr int most_merged = 10'000;

  explicit LineMerger(Source<PathItem>& path) : path_(path) {}

  // Like Source::next. `deviation`: the maximum distance of the programmed path from the returned segment.
  [[nodiscard]] bool next(PathItem& item, double& deviation);

 private:
  // The directions that a merged line may take.
  struct Cone {
    Point center;  // not quite a unit vector
    double radius = 0;
    double tolerance = 0;  // mm
    void begin(const Point& direction, double length, double within);
    bool has(const Point& direction) const;
    void narrow(const Point& direction, double length);
  };

  // The vector from the start of the merged line to a vertex.
  struct Chord {
    explicit Chord(const Point& way);
    Point travel;
    double length = 0;
    Point direction;
  };

  bool pull();
  void straighten(Segment& segment);
  // `merged`: the first line, with the mode of the last; `line`: the next line.
  bool absorbs(const Segment& merged, const Segment& line, const Chord& chord) const;
  void begin(const Segment& merged);
  bool extend(Segment& merged, double& deviation);
  bool stays_apart(const Segment& line) const;
  double merge_tolerance(const Segment& merged) const;

  Source<PathItem>& path_;
  PathItem ahead_;        // read and not yet returned
  double ahead_off_ = 0;  // distance of an arc from the chord that replaces it
  // The junction before what was read last.
  PathMode mode_read_ = PathMode::exact_stop;
  double tolerance_read_ = 0;
  bool has_ahead_ = false;
  bool at_end_ = false;

  // For the line being merged: the end of its last piece, the number of its pieces, and the sum of their lengths.
  Point end_;
  int taken_ = 0;
  double programmed_ = 0;
  double off_ = 0;  // the largest distance of its arcs from their chords
  // The mode of the junction before the merged line.
  PathMode mode_before_ = PathMode::exact_stop;
  double tolerance_before_ = 0;
  Cone cone_;
  Cone exact_;  // the directions allowed for rounding errors only
};

}  // namespace passo
