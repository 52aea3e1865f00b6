// CutLoads: the force that the cut takes along a program, as a load of the axes' motors.
//
// A height field is cut along the path that the machine drives. Of each feed there comes out how much it takes off:
//
//   area  = volume / way                          mm², across the way
//   force = k · area · v / (2π · r · n)           N
//
// k is the specific cutting force of the material (N/mm²), v the speed of the tool along its way, n the spindle's turns
// a second, r the tool's radius at the depth of the cut. This is the mean tangential force: the spindle's power over
// the cutting speed. A feed is looked at in pieces as long as the tool's radius, and its hardest piece counts for all
// of it. Left out: the ripple from tooth to tooth, and the thrust of a tool that drills.
//
// Memory: 12 bytes a feed, and that of the field.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/cutting/simulation.hpp"
#include "passo/cutting/stock_job.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class CutLoads {
 public:
  // Call it for each feed, in the order of the path. Returns its index.
  std::size_t add(const Segment& feed);
  void raise(std::size_t index, double newtons_per_speed);

  // N for each mm/s of a move of the same path. Call it for every move, in order.
  double of(const PlannedMove& move);
  std::size_t feeds() const { return loads_.size(); }
  // Feeds that were planned and are not among those that were cut. 0, but for a path that a probe decides.
  std::size_t unknown() const { return unknown_; }

 private:
  struct Load {
    std::uint32_t line = 0;
    float length = 0;
    float newtons_per_speed = 0;
  };
  bool fits(const Load& load, const Segment& feed) const;

  std::vector<Load> loads_;
  std::size_t next_ = 0;
  double present_ = 0;
  std::size_t unknown_ = 0;
};

struct CutMaterial {
  double specific_force = 0;                          // N/mm²
  std::optional<double> revolutions_per_minute = {};  // of a spindle that the program does not command
};

struct CutOutcome {
  CutLoads loads;
  Simulation simulation;
  LargestOf force;  // N, at the programmed speeds
  // The first line that cuts and has no spindle speed, so that the force of such cuts is left out; 0: all have one.
  std::uint32_t silent_line = 0;
};

// Cuts the stock by the program. `look` is of the same program, `tools` its shapes, and `field` its stock before.
CutOutcome cut_with_force(const StockJob& job, const StockWishes& wishes, const FeedLook& look,
                          const std::vector<ToolShape>& tools, HeightField field, const CutMaterial& material);

}  // namespace passo
