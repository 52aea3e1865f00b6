// GrblBoardMotion: the planner and the motion of a StrictGrbl, in virtual time: blocks with junction deviation and
// trapezoids, as GrblPlanner predicts them, and beyond that what only a running board does: feed holds, cancelled
// jogs, overrides.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "passo/geometry/axes.hpp"

namespace passo {

class GrblBoardMotion {
 public:
  struct Limits {
    Point steps_per_mm;
    Point velocity;      // mm/s
    Point acceleration;  // mm/s^2
    double junction_deviation = 0.01;
    std::size_t blocks = 15;
    double block_time = 0;  // s; above 0: the duration of each block, whatever its length
  };
  struct Move {
    Point end;  // machine coordinates, mm
    double feed = std::numeric_limits<double>::infinity();
    bool fixed_feed = false;   // the feed override has no effect
    std::uint32_t number = 0;  // N word
    std::string line = {};     // the line that ends with this move
  };

  void set_limits(const Limits& limits) { limits_ = limits; }
  bool full() const { return blocks_.size() >= limits_.blocks; }
  bool empty() const { return blocks_.empty(); }
  std::size_t free_blocks() const { return limits_.blocks - std::min(limits_.blocks, blocks_.size()); }
  std::uint32_t number() const { return blocks_.empty() ? 0 : blocks_.front().move.number; }

  // Position of the motors, mm.
  Point place() const {
    if (blocks_.empty() || limits_.block_time > 0) return at_;
    const Block& first = blocks_.front();
    return at_ + first.direction * std::min(done_, first.length);
  }
  double speed() const { return speed_; }

  void add(Move move) {
    const Point end = to_steps(move.end);
    const Point way = end - planned_;
    const double length = std::sqrt(dot(way, way));
    if (length <= 0 && limits_.block_time <= 0) {
      if (!move.line.empty()) ends_with_last(std::move(move.line));
      return;
    }
    Block block{.move = std::move(move), .end = end, .length = length};
    if (length > 0) block.direction = way * (1 / length);
    block.acceleration = limit_along(block.direction, limits_.acceleration);
    block.fastest = limit_along(block.direction, limits_.velocity);
    planned_ = end;
    blocks_.push_back(std::move(block));
    plan();
  }
  void set_overrides(double feed, double rapid) {
    feed_override_ = feed;
    rapid_override_ = rapid;
    plan();
  }

  void start() {
    moves_ = !blocks_.empty();
    brakes_ = false;
    left_ = limits_.block_time;
  }
  // Brakes along the path. moves() becomes false when that is done.
  void brake() { brakes_ = moves_; }
  // Ends all motion where the motors are.
  void drop() {
    at_ = planned_ = to_steps(place());
    blocks_.clear();
    done_ = speed_ = 0;
    moves_ = brakes_ = false;
  }
  void set_place(const Point& place) {
    at_ = planned_ = place;
    blocks_.clear();
  }
  bool moves() const { return moves_; }
  bool brakes() const { return brakes_; }
  // Lines whose last block has ended since the last call.
  std::vector<std::string> take_done() { return std::exchange(done_lines_, {}); }

  // Time until the motion changes, s.
  double next_event() const {
    if (!moves_) return std::numeric_limits<double>::infinity();
    return limits_.block_time > 0 ? std::max(left_, 0.0) : phase().duration;
  }
  // `time` is at most next_event().
  void advance(double time) {
    if (!moves_) return;
    if (limits_.block_time > 0) return advance_block(time);
    const Phase now = phase();
    const bool ends = time >= now.duration - shortest;
    if (ends) time = now.duration;
    done_ += (speed_ + now.acceleration * time / 2) * time;
    speed_ = std::max(0.0, speed_ + now.acceleration * time);
    if (ends) speed_ = now.end_speed;
    if (brakes_ && speed_ <= 0) {
      moves_ = brakes_ = false;
      return plan();
    }
    if (ends && (now.ends_block || done_ >= blocks_.front().length)) end_block();
  }

 private:
  static constexpr double shortest = 1e-10;  // s; the clock has no finer ticks

  struct Block {
    Move move;
    Point end;
    Point direction = {};
    double length = 0;
    double acceleration = 0;
    double fastest = 0;
    double junction2 = 0;  // square of the highest speed at its beginning, by the directions
    double entry2 = 0;     // planned
  };
  struct Phase {
    double acceleration = 0;
    double duration = 0;
    double end_speed = 0;
    bool ends_block = false;
  };

  static double dot(const Point& a, const Point& b) {
    double sum = 0;
    for (std::size_t i = 0; i < axis_count; ++i) sum += a.values[i] * b.values[i];
    return sum;
  }
  static double limit_along(const Point& direction, const Point& limits) {
    double limit = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < axis_count; ++i) {
      const double part = std::abs(direction.values[i]);
      if (part > 0) limit = std::min(limit, limits.values[i] / part);
    }
    return limit;
  }
  Point to_steps(Point place) const {
    for (std::size_t i = 0; i < axis_count; ++i) {
      const double per_mm = limits_.steps_per_mm.values[i];
      place.values[i] = per_mm > 0 ? std::round(place.values[i] * per_mm) / per_mm : 0;
    }
    return place;
  }
  double nominal(const Block& block) const {
    constexpr double slowest = 1.0 / 60;
    if (std::isinf(block.move.feed)) return std::max(slowest, block.fastest * rapid_override_);
    const double feed = block.move.feed * (block.move.fixed_feed ? 1 : feed_override_);
    return std::clamp(feed, slowest, std::max(slowest, block.fastest));
  }
  double junction2(const Block& before, const Block& after) const {
    constexpr double straight = 0.999999;
    const double cosine = -dot(before.direction, after.direction);
    if (cosine > straight) return 0;
    if (cosine < -straight) return std::numeric_limits<double>::max();
    Point change = after.direction - before.direction;
    change = change * (1 / std::sqrt(dot(change, change)));
    const double sine = std::sqrt((1 - cosine) / 2);
    return limit_along(change, limits_.acceleration) * limits_.junction_deviation * sine / (1 - sine);
  }
  void plan() {
    double exit2 = 0;
    for (std::size_t i = blocks_.size(); i-- > 1;) {
      Block& block = blocks_[i];
      const double own = nominal(block);
      const double before = nominal(blocks_[i - 1]);
      const double most = std::min({junction2(blocks_[i - 1], block), own * own, before * before});
      block.entry2 = std::min(most, exit2 + 2 * block.acceleration * block.length);
      exit2 = block.entry2;
    }
  }
  Phase phase() const {
    const Block& first = blocks_.front();
    const double rest = std::max(0.0, first.length - done_);
    const double gain2 = 2 * first.acceleration * rest;
    const double speed2 = speed_ * speed_;
    const auto brake_to = [&](double end_speed, bool ends) {
      return Phase{.acceleration = -first.acceleration,
                   .duration = (speed_ - end_speed) / first.acceleration,
                   .end_speed = end_speed,
                   .ends_block = ends};
    };
    if (brakes_) return speed2 <= gain2 ? brake_to(0, false) : brake_to(std::sqrt(speed2 - gain2), true);
    const double wanted2 = blocks_.size() > 1 ? blocks_[1].entry2 : 0;
    const double exit2 = std::clamp(wanted2, std::max(0.0, speed2 - gain2), speed2 + gain2);
    const double top = nominal(first);
    if (speed_ > top * (1 + 1e-12)) {  // an override has lowered it
      const double end2 = std::max({speed2 - gain2, top * top, exit2});
      return brake_to(std::sqrt(end2), speed2 - gain2 >= end2);
    }
    const double top2 = std::min(top * top, (speed2 + exit2 + gain2) / 2);
    if (top2 > speed2 * (1 + 1e-9) + 1e-12) {
      const double peak = std::sqrt(top2);
      return {.acceleration = first.acceleration,
              .duration = (peak - speed_) / first.acceleration,
              .end_speed = peak,
              .ends_block = top2 >= (speed2 + exit2 + gain2) / 2 && exit2 >= top2};
    }
    const double level = rest - (speed2 - exit2) / (2 * first.acceleration);
    if (level > 1e-9) {
      return {.duration = level / speed_, .end_speed = speed_, .ends_block = exit2 >= speed2};
    }
    return brake_to(std::sqrt(exit2), true);
  }
  void end_block() {
    if (!blocks_.front().move.line.empty()) done_lines_.push_back(std::move(blocks_.front().move.line));
    at_ = blocks_.front().end;
    done_ = 0;
    blocks_.pop_front();
    left_ += limits_.block_time;
    if (blocks_.empty()) {
      speed_ = 0;
      moves_ = brakes_ = false;
    }
  }
  void advance_block(double time) {
    left_ -= time;
    if (left_ > 1e-12) return;
    const bool stops = brakes_;
    end_block();
    if (stops) moves_ = brakes_ = false;
  }
  void ends_with_last(std::string line) {
    if (blocks_.empty()) {
      done_lines_.push_back(std::move(line));
    } else {
      blocks_.back().move.line = std::move(line);
    }
  }

  Limits limits_;
  std::deque<Block> blocks_;
  Point at_;       // start of the first block
  Point planned_;  // end of the last block
  double done_ = 0;
  double speed_ = 0;
  double left_ = 0;
  bool moves_ = false;
  bool brakes_ = false;
  double feed_override_ = 1;
  double rapid_override_ = 1;
  std::vector<std::string> done_lines_;
};

}  // namespace passo
