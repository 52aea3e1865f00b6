// CutSummary: what the moves of a program did to the stock, in figures and in a list of what is wrong.
//
// Engagement and removal rate are those of a stretch of feeds: one move, or as many short moves in a row as make a way
// of the tool's radius. So a cell more or less in a tiny move does not count. The engagement is the width of the
// material that the stretch has cut, seen from above, as a share of the tool's diameter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "passo/stock/stock_cutter.hpp"

namespace passo {

// Something that should not happen: where, and how deep (mm).
struct CutTrouble {
  enum class Kind : std::uint8_t {
    rapid,   // a rapid move through the stock
    flutes,  // deeper than the tool's flutes are long
    holder,  // the tool's holder in the stock
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

// The largest of something, and the line that did it.
struct LargestOf {
  double value = 0;
  std::uint32_t line = 0;
};

class CutSummary {
 public:
  // Of each kind, so many troubles are kept. All are counted.
  static constexpr std::size_t most_kept = 10;
  // mm: less is rounding.
  static constexpr double least_depth = 0.005;

  explicit CutSummary(std::vector<ToolShape> tools) : tools_(std::move(tools)) {}

  void add(const MoveCut& cut);

  std::uint64_t moves() const { return moves_; }
  std::uint64_t cutting_moves() const { return cutting_moves_; }
  double volume() const { return volume_; }            // mm³
  double cutting_way() const { return cutting_way_; }  // mm, of the feeds that cut
  Seconds cutting_time() const { return Seconds(cutting_time_); }
  // mm³/s, over the time of the feeds that cut.
  double mean_rate() const { return cutting_time_ > 0 ? cut_by_feeds_ / cutting_time_ : 0; }
  const LargestOf& depth() const { return depth_; }            // mm, of a feed
  const LargestOf& engagement() const { return engagement_; }  // 0 to 1
  const LargestOf& rate() const { return rate_; }              // mm³/s

  // In the order of the program, at most `most_kept` of each kind. Moves that follow each other and have the same
  // trouble are one, with the greatest depth.
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

  // The trouble of this kind that the move before had, if any: which of `troubles_`.
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
  LargestOf depth_;
  LargestOf engagement_;
  LargestOf rate_;
  Stretch stretch_;
  std::vector<CutTrouble> troubles_;
  std::array<std::uint64_t, CutTrouble::kinds> counts_{};
  std::array<Going, CutTrouble::kinds> going_{};
};

}  // namespace passo
