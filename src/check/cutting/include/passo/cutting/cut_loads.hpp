// CutLoads: the cutting force along a program, as a load of the axes' motors.
//
// A height field is cut along the path that the machine executes. Each feed move yields the volume that it removes:
//
//   area  = volume / distance                     mm², across the path
//   force = k · area · v / (2π · r · n)           N
//
// k is the specific cutting force of the material (N/mm²), v the feed rate of the tool, n the spindle speed in rev/s, r
// the tool's radius at the depth of the cut. The result is the mean tangential force: the spindle power divided by the
// cutting speed. A feed move is evaluated in pieces as long as the tool's radius, and the greatest force of its pieces
// applies to the whole move. Not included: the force ripple from tooth to tooth, and the thrust of a drilling tool.
//
// Memory: 12 bytes per feed move, and that of the field.
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
  // Adds a feed move; must be called for each one, in path order. Returns its index.
  std::size_t add(const Segment& feed);
  void raise(std::size_t index, double newtons_per_speed);

  // Returns the force per speed, N per mm/s, for a move of the same path. Must be called for every move, in order.
  double of(const PlannedMove& move);
  std::size_t feeds() const { return loads_.size(); }
  // Returns the number of planned feed moves that were not cut; 0 unless the path depends on a probe.
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
  std::optional<double> revolutions_per_minute = {};  // speed of a spindle that the program does not command
};

struct CutOutcome {
  CutLoads loads;
  Simulation simulation;
  LargestOf force;  // cutting force, N, at the programmed feed rates
  // The first line that cuts without a spindle speed, so that its force is not included; 0: there is none.
  std::uint32_t silent_line = 0;
};

// Cuts the stock by the program. `look`, `tools` and `field` must be those of this program; `field` is the uncut stock.
CutOutcome cut_with_force(const StockJob& job, const StockWishes& wishes, const FeedLook& look,
                          const std::vector<ToolShape>& tools, HeightField field, const CutMaterial& material);

}  // namespace passo
