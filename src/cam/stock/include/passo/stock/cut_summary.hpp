// CutSummary: the effect of a program's moves on the stock, as figures and as a list of problems.
//
// Engagement and removal rate are evaluated per stretch of feed moves: one move, or consecutive short moves that
// together are as long as the tool's radius. This keeps single cells in tiny moves from distorting the figures. The
// engagement is the width of the material that the stretch has cut, seen from above, as a fraction of the tool's
// diameter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "passo/stock/stock_cutter.hpp"

namespace passo {

// A problem: its position, and its depth (mm).
struct CutTrouble {
  enum class Kind : std::uint8_t {
    rapid,   // a rapid move through the stock
    flutes,  // deeper than the flute length of the tool
    holder,  // the tool holder in the stock
    clamp,   // the tool or its holder in a clamp
    below,   // below the stock's bottom: into the table
  };
  static constexpr std::size_t kinds = 5;
  Kind kind = Kind::rapid;
  std::uint32_t line = 0;
  std::size_t tool = 0;
  double depth = 0;
  Vector3 place{};
};

// The maximum of a quantity, and the line that caused it.
struct LargestOf {
  double value = 0;
  std::uint32_t line = 0;
};

class CutSummary {
 public:
  // The maximum number of problems kept of each kind; all are counted.
  static constexpr std::size_t most_kept = 10;
  // mm: smaller values are rounding errors.
  static constexpr double least_depth = 0.005;
  // A cut wider than this fraction of the diameter is heavy: a slot, or an inside corner.
  static constexpr double heavy_engagement = 0.7;

  explicit CutSummary(std::vector<ToolShape> tools) : tools_(std::move(tools)) {}

  void add(const MoveCut& cut);

  std::uint64_t moves() const { return moves_; }
  std::uint64_t cutting_moves() const { return cutting_moves_; }
  double volume() const { return volume_; }            // mm³
  double cutting_way() const { return cutting_way_; }  // mm, distance of the feed moves that cut
  Seconds cutting_time() const { return Seconds(cutting_time_); }
  // mm³/s, averaged over the time of the feed moves that cut.
  double mean_rate() const { return cutting_time_ > 0 ? cut_by_feeds_ / cutting_time_ : 0; }
  const LargestOf& depth() const { return depth_; }            // mm, in a feed move
  const LargestOf& engagement() const { return engagement_; }  // 0 to 1
  const LargestOf& rate() const { return rate_; }              // mm³/s
  // mm of cutting_way() above heavy_engagement, without descents: a helix cuts a slot, but a thin one.
  double heavy_way() const { return heavy_way_; }

  // In program order, at most `most_kept` of each kind. Consecutive moves with the same problem are merged into one,
  // with the maximum depth.
  const std::vector<CutTrouble>& troubles() const { return troubles_; }
  std::uint64_t count(CutTrouble::Kind kind) const { return counts_[static_cast<std::size_t>(kind)]; }

 private:
  struct Stretch {
    double way = 0;
    double way_level = 0;
    double time = 0;
    double volume = 0;
    double area = 0;
    LargestOf most;  // mm³
  };

  void judge(const Stretch& stretch, const ToolShape& tool);
  void add_to_stretch(const MoveCut& cut);
  void find_troubles(const MoveCut& cut);
  void record(CutTrouble::Kind kind, const MoveCut& cut, double depth, const Vector3& place);

  // The current problem of this kind if the previous move had one: index into `troubles_`.
  struct Going {
    bool on = false;
    std::size_t index = 0;
    bool kept = false;
  };

  std::vector<ToolShape> tools_;
  std::uint64_t moves_ = 0;
  std::uint64_t cutting_moves_ = 0;
  double volume_ = 0;
  double cut_by_feeds_ = 0;
  double cutting_way_ = 0;
  double cutting_time_ = 0;
  double heavy_way_ = 0;
  LargestOf depth_;
  LargestOf engagement_;
  LargestOf rate_;
  Stretch stretch_;
  std::vector<CutTrouble> troubles_;
  std::array<std::uint64_t, CutTrouble::kinds> counts_{};
  std::array<Going, CutTrouble::kinds> going_{};
};

}  // namespace passo
