// The moves of the lathe cycles G70 to G72 along and toward a contour, a few at a time.
//
// Roughing goes down the contour's first segment in steps; from each step it cuts along Z to where the contour is met,
// lifts off, goes back and down the next step. Where the contour no longer falls, it is followed up to its end, or to
// where it falls again: that is a pocket, which is cleared in the same way from there.
#pragma once

#include <optional>

#include "lathe_profile.hpp"

namespace passo {

struct LatheMove {
  enum class Kind : std::uint8_t { rapid, line, clockwise, counterclockwise };
  Kind kind = Kind::rapid;
  LathePoint end;
  LathePoint center{};
};

class LatheMoves {
 public:
  static constexpr std::size_t capacity = 8;
  void rapid(LathePoint end) { add({LatheMove::Kind::rapid, end, {}}); }
  void line(LathePoint end) { add({LatheMove::Kind::line, end, {}}); }
  void arc(const LatheSegment& along, LathePoint end);
  void along(const LatheSegment& segment);
  void clear() { count_ = 0; }
  std::size_t size() const { return count_; }
  const LatheMove* begin() const { return moves_; }
  const LatheMove* end() const { return moves_ + count_; }

 private:
  void add(const LatheMove& move) { moves_[count_++] = move; }
  LatheMove moves_[capacity];
  std::size_t count_ = 0;
};

class LatheRoughing {
 public:
  enum class Extent : std::uint8_t { everything, no_pockets, only_pockets };  // G71, G71.1, G71.2
  LatheRoughing(LatheContour contour, Extent extent, double depth_of_cut, double lift);

  const LatheOrientation& orientation() const { return contour_.orientation; }
  // At most LatheMoves::capacity moves. False when it is done, or at a fault.
  bool step(LatheMoves& moves);
  LatheFault fault() const { return fault_; }

 private:
  enum class Phase : std::uint8_t { begin, skip, down, up, up_only, done };
  const LatheSegment& segment() const { return contour_.segments[at_]; }
  bool at_end() const { return at_ >= contour_.segments.size(); }
  void next_step(LatheMoves& moves);
  void go_down(LatheMoves& moves);
  void cut(LatheMoves& moves);
  void go_up(LatheMoves& moves);
  void enter_pocket();
  // False: the segment is none of that kind.
  bool dive(double x, LatheMoves& moves);
  bool dive_line(double x, LatheMoves& moves);
  bool dive_arc(double x, LatheMoves& moves);
  // False: the contour falls from here on.
  bool climb(LatheMoves& moves);
  bool climb_arc(LatheMoves& moves);
  void climb_only(LatheMoves& moves);
  void follow_arc(LathePoint end, LatheMoves& moves);
  LathePoint end_of_climb() const;

  LatheContour contour_;
  Extent extent_;
  double depth_of_cut_;
  double lift_;
  Phase phase_ = Phase::begin;
  std::size_t at_ = 0;  // the segment
  LathePoint tool_;
  double level_ = 0;      // X of the next cut
  double top_level_ = 0;  // X that levels are counted from
  std::optional<double> pocket_level_;
  int idle_steps_ = 0;
  LatheFault fault_ = LatheFault::none;
};

// G70: along the contour, in passes that come nearer.
class LatheFinishing {
 public:
  LatheFinishing(LatheContour contour, double first_distance, double last_distance, std::int32_t passes);
  const LatheOrientation& orientation() const { return contour_.orientation; }
  bool step(LatheMoves& moves);
  LatheFault fault() const { return fault_; }

 private:
  LatheContour contour_;
  double first_distance_;
  double last_distance_;
  std::int32_t passes_;
  std::int32_t left_;
  LatheContour path_;  // of this pass
  std::size_t at_ = 0;
  LatheFault fault_ = LatheFault::none;
};

}  // namespace passo
