// LatheRoughing and LatheFinishing: the moves of the lathe cycles G70 to G72, a few at a time.
//
// Roughing descends the contour's first segment in steps. At each step the tool cuts along Z up to the contour, lifts
// off, returns, and descends to the next step. Where the contour stops descending, the tool follows the contour to its
// end, or to the point where it descends again. There a pocket begins, which is cleared in the same way.
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
  // The codes: G71 and G72; G71.1 and G72.1; G71.2 and G72.2.
  enum class Extent : std::uint8_t { everything, no_pockets, only_pockets };
  LatheRoughing(LatheContour contour, Extent extent, double depth_of_cut, double lift);

  const LatheOrientation& orientation() const { return contour_.orientation; }
  // Adds at most LatheMoves::capacity moves. Returns false when roughing is done, or if there is an error.
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
  // Descend the segment to the height x or to the segment's end. Return false where the segment stops descending.
  bool dive(double x, LatheMoves& moves);
  bool dive_line(double x, LatheMoves& moves);
  bool dive_arc(double x, LatheMoves& moves);
  // Ascend the segment. Return false where the contour descends.
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
  std::size_t at_ = 0;  // index of the current segment
  LathePoint tool_;
  double level_ = 0;      // X of the next cut
  double top_level_ = 0;  // X from which levels are counted
  std::optional<double> pocket_level_;
  int idle_steps_ = 0;
  LatheFault fault_ = LatheFault::none;
};

// G70: passes along the contour, each closer to it than the previous one.
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
  LatheContour path_;  // the contour, offset by the distance of this pass
  std::size_t at_ = 0;
  LatheFault fault_ = LatheFault::none;
};

}  // namespace passo
