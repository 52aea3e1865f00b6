// TimeBound: where the path bends and two axes have limits of jerk.
//
// For two axes i and j, s⃛ drops out of the two demands |q' s⃛ + 3 q'' ṡ s̈ + q''' ṡ³| ≤ J. With the turn
// T = q''ᵢ q'ⱼ − q''ⱼ q'ᵢ, whose derivative by s is q'''ᵢ q'ⱼ − q'''ⱼ q'ᵢ, what is left is
//
//     |3 T ṡ s̈ + T' ṡ³| ≤ Jᵢ |q'ⱼ| + Jⱼ |q'ᵢ|
//
// The left side is the derivative of T ṡ³ by s. (T ṡ³ is q̈ᵢ q̇ⱼ − q̈ⱼ q̇ᵢ.) So along the path T ṡ³ changes by no more
// than the right side says. On a straight line, and at a rest, it is 0. Where the path then bends, this bounds ṡ.
#include <algorithm>
#include <cmath>

#include "rounding.hpp"
#include "time_bound.hpp"

namespace passo::proof {
namespace {

// A share of a curve's length: places that are no further apart, and turns that small, are rounding.
constexpr double rounding_of_way = 1e-9;
// Lower speeds in one place give lower speeds in others, by turning and by the axes' accelerations in turn. Three
// rounds take the worst of 2,000 programs from 1.62 times the bound to 1.18; a single one leaves it there.
constexpr int rounds = 3;
// A further round that lowers T ṡ³ by no more than this share of it is the last.
constexpr double trifle = 1e-3;

double cube_of_speed(double x) {
  return x * std::sqrt(x);
}

// Lowers x so far that turn ṡ³ is at most `most`. Returns whether that is more than a trifle.
bool lower(double& x, double turn, double most) {
  const double here = turn * cube_of_speed(x);
  if (!(here > most)) return false;
  const double root = std::cbrt(most / turn);
  x = std::min(x, root * root);
  return here > most * (1 + trifle);
}

}  // namespace

void TimeBound::find_turning_pairs() {
  const auto counts = [&](const ProvenAxis& axis) {
    return axis.jerk > MmPerSecond3(0) && axis.velocity > MmPerSecond(0) && axis.acceleration > MmPerSecond2(0);
  };
  std::size_t place = 0;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j, ++place) {
      if (counts(axes_[i]) && counts(axes_[j])) turning_pairs_.push_back({.i = i, .j = j, .place = place});
    }
  }
}

// Each |q'| is greatest at an end of the cell. On a cubic T is a parabola.
void TimeBound::add_turns(const ExactCurve& curve, const Place& from, const Place& middle, const Place& to) {
  const double way = to.s - from.s + rounding_of_way * curve.length();
  for (const AxisPair& pair : turning_pairs_) {
    const auto steepest = [&](std::size_t axis) {
      return std::max(std::abs(from.slope[axis]), std::abs(to.slope[axis]));
    };
    const double rate = axes_[pair.i].jerk.value() * steepest(pair.j) + axes_[pair.j].jerk.value() * steepest(pair.i);
    turns_.push_back({.entry = std::abs(from.turn[pair.place]),
                      .exit = std::abs(to.turn[pair.place]),
                      .least = least_through(from.turn[pair.place], middle.turn[pair.place], to.turn[pair.place]),
                      .change = rate * way});
  }
}

// What rounding allows where two curves join: the axes' accelerations and velocities may jump a little.
TimeBound::Turn TimeBound::jump_of(const AxisPair& pair, const Place& start) const {
  const ProvenAxis& i = axes_[pair.i];
  const ProvenAxis& j = axes_[pair.j];
  const double strength_i = i.acceleration.value();
  const double strength_j = j.acceleration.value();
  return {.jump = acceleration_rounding *
                  (strength_i * std::abs(start.slope[pair.j]) + strength_j * std::abs(start.slope[pair.i])),
          .kink = velocity_rounding * (strength_i * j.velocity.value() + strength_j * i.velocity.value())};
}

void TimeBound::add_jumps(std::size_t cell, const Place& start) {
  for (std::size_t k = 0; k < turning_pairs_.size(); ++k) {
    Turn& turn = turns_[cell * turning_pairs_.size() + k];
    const Turn jump = jump_of(turning_pairs_[k], start);
    turn.jump = jump.jump;
    turn.kink = jump.kink;
  }
}

// The greatest x after a joint: T ṡ³ jumps there by no more than rounding allows. `scale`: x after it, divided by x
// before it.
double TimeBound::bend_cap(const Place& before, const Place& after, double scale) const {
  double cap = fastest;
  for (const AxisPair& pair : turning_pairs_) {
    const double jump = std::abs(after.turn[pair.place] - before.turn[pair.place] / cube_of_speed(scale));
    const Turn allowed = jump_of(pair, after);
    const double speed = std::sqrt(allowed.jump / jump) + std::cbrt(allowed.kink / jump);
    if (jump > 0) cap = std::min(cap, speed * speed);
  }
  return cap;
}

// The greatest T ṡ³ at the ends of a cell, and by how much it may jump at the joint before the cell.
double TimeBound::turn_at_entry(std::size_t cell, std::size_t pair) const {
  return turn_of(cell, pair).entry * cube_of_speed(cells_[cell].entry.cap);
}
double TimeBound::turn_at_exit(std::size_t cell, std::size_t pair) const {
  return turn_of(cell, pair).exit * cube_of_speed(cells_[cell].exit.cap);
}
double TimeBound::turn_at_joint(std::size_t cell, std::size_t pair) const {
  return turn_of(cell, pair).jump * std::sqrt(cells_[cell].entry.cap) + turn_of(cell, pair).kink;
}

// Lowers the caps of all cells, forwards and backwards. Returns whether any of them falls by more than a trifle.
// `at_end` is the largest x at the end of the last cell.
bool TimeBound::lower_where_it_turns(double at_end) {
  bool lowers = false;
  const std::size_t pairs = turning_pairs_.size();
  cells_.front().entry.cap = std::min(cells_.front().entry.cap, x_);
  cells_.back().exit.cap = std::min(cells_.back().exit.cap, at_end);
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    for (std::size_t k = 0; i > 0 && k < pairs; ++k) {
      lowers |= lower(cells_[i].entry.cap, turn_of(i, k).entry, turn_at_exit(i - 1, k) + turn_at_joint(i, k));
    }
    for (std::size_t k = 0; k < pairs; ++k) {
      lowers |= lower(cells_[i].exit.cap, turn_of(i, k).exit, turn_at_entry(i, k) + turn_of(i, k).change);
    }
  }
  for (std::size_t i = cells_.size(); i-- > 0;) {
    for (std::size_t k = 0; i + 1 < cells_.size() && k < pairs; ++k) {
      lowers |= lower(cells_[i].exit.cap, turn_of(i, k).exit, turn_at_entry(i + 1, k) + turn_at_joint(i + 1, k));
    }
    for (std::size_t k = 0; k < pairs; ++k) {
      lowers |= lower(cells_[i].entry.cap, turn_of(i, k).entry, turn_at_exit(i, k) + turn_of(i, k).change);
    }
    for (std::size_t k = 0; k < pairs; ++k) {
      const Turn& turn = turn_of(i, k);
      lowers |= lower(cells_[i].cap, turn.least, (turn_at_entry(i, k) + turn_at_exit(i, k) + turn.change) / 2);
    }
  }
  return lowers;
}

// Lowers the caps by turning, and by what the axes' accelerations then allow. `at_end` is the largest x at the end,
// where the path rests or goes on.
void TimeBound::lower_caps(double at_end, bool rests) {
  for (int round = 0; round < rounds; ++round) {
    if (!lower_where_it_turns(rests ? at_end : fastest) && round > 0) return;
    plan_backwards(at_end);
    double x = x_;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      Cell& cell = cells_[i];
      x = std::min(x * cell.entry_scale, cell.controllable);
      cell.entry.cap = std::min(cell.entry.cap, x);
      x = exit_of(i, x, at_end);
      cell.exit.cap = std::min(cell.exit.cap, x);
    }
  }
}

}  // namespace passo::proof
