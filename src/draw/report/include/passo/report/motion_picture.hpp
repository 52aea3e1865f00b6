// A picture of a planned motion: the path within its tolerance, the speed along the path with its limit, and the
// acceleration and jerk of the axes over time.
//
// MotionRecorder records the programmed path and the planned motion. It keeps the first `most_samples` points, so the
// picture of a long program shows its beginning.
#pragma once

#include <cstddef>
#include <vector>

#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"
#include "passo/trajectory/motion_limits.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

struct MotionSample {
  double time = 0;   // s
  double way = 0;    // distance from the start, mm, over all axes; a degree counts as a millimetre
  double speed = 0;  // mm/s along that distance
  double cap = 0;    // mm/s: the maximum speed at which some acceleration along the path keeps all limits
  Point place;
  Point acceleration;  // of each axis, mm/s²
  Point jerk;          // mm/s³
  bool begins_phase = false;
};

class MotionRecorder {
 public:
  static constexpr std::size_t most_samples = 200'000;

  explicit MotionRecorder(const MotionLimits& limits) : limits_(limits) {}

  void watch(const PathItem& item);
  void watch(const MotionItem& item);

  struct ProgrammedPiece {  // a line, or a short piece of a curve
    Point from;
    Point to;
    double tolerance = 0;
  };
  const MotionLimits& limits() const { return limits_; }
  const std::vector<ProgrammedPiece>& programmed() const { return programmed_; }
  const std::vector<MotionSample>& samples() const { return samples_; }

 private:
  void add(const PlannedMove& move, const Phase& phase);
  double cap_at(const Segment& segment, const Point& slope, const Point& bend) const;

  MotionLimits limits_;
  std::vector<ProgrammedPiece> programmed_;
  std::vector<MotionSample> samples_;
  double time_ = 0;
  double way_ = 0;
};

// options.program is the title, options.machine the line below it.
Status<OutputError> draw_motion_picture(const MotionRecorder& motion, const PictureOptions& options, OutputFile& file);

}  // namespace passo
