#include "passo/ramp/ramp_sequence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "passo/interpolate/exact_ramp.hpp"
#include "passo/interpolate/ramp_move.hpp"
#include "passo/interpolate/ramp_table.hpp"
#include "passo/interpolate/recursive_ramp.hpp"
#include "passo/interpolate/table_ramp.hpp"
#include "passo/ramp/real_ramp.hpp"
#include "passo/ramp/s_curve_move.hpp"

namespace passo {

class RampSequence::Walk {
 public:
  Walk() = default;
  virtual ~Walk() = default;
  Walk(const Walk&) = delete;
  Walk& operator=(const Walk&) = delete;
  virtual double next() = 0;
  virtual void stop() = 0;
  virtual void go_back() = 0;
  virtual std::int64_t place() const = 0;
  virtual bool done() const = 0;
};

namespace {

using Started = Result<std::unique_ptr<RampSequence::Walk>, RampError>;

RampError because(std::string words) {
  return {std::move(words)};
}

// A table whose size is known only at run time.
class TableOfAnySize {
 public:
  explicit TableOfAnySize(std::size_t size) : factors_(size) { make_ramp_table(factors_.data(), size); }
  std::uint16_t size() const { return static_cast<std::uint16_t>(factors_.size()); }
  std::uint16_t scaled(std::uint16_t first, std::uint16_t n) const {
    return static_cast<std::uint16_t>((std::uint32_t{first} * factors_[n]) >> 16);
  }

 private:
  std::vector<std::uint16_t> factors_;
};

// The integer recursion has no way down, and nobody asks this walk for one.
class UpwardsOnly : public RecursiveRamp<> {
 public:
  using RecursiveRamp<>::RecursiveRamp;
  static std::uint32_t fastest() { return 1; }
  void fall() {}
};

template <class Ramp>
class RampWalk final : public RampSequence::Walk {
 public:
  explicit RampWalk(const Ramp& ramp) : move_(ramp) {}
  RampMove<Ramp>& move() { return move_; }
  double next() override { return move_.next(); }
  void stop() override { move_.stop(); }
  void go_back() override { move_.move_to(0); }
  std::int64_t place() const override { return move_.position(); }
  bool done() const override { return move_.done(); }

 private:
  RampMove<Ramp> move_;
};

class SCurveWalk final : public RampSequence::Walk {
 public:
  SCurveWalk(const SCurveLimits& limits, std::int64_t steps, bool whole_ticks)
      : move_(limits), whole_ticks_(whole_ticks) {
    move_.move_to({steps});
  }
  double next() override {
    const Ticks interval = move_.next();
    return whole_ticks_ ? static_cast<double>(interval.count) : move_.real_interval();
  }
  void stop() override { move_.stop(); }
  void go_back() override { move_.move_to({0}); }
  std::int64_t place() const override { return move_.position().count; }
  bool done() const override { return move_.done(); }

 private:
  SCurveMove move_;
  bool whole_ticks_;
};

// An interval in the ramp's ticks that is not faster than `rate`. Where the interval is too long for the ramp's type,
// its longest value serves as well.
template <class Interval>
Interval interval_of(Hertz rate, const RampSetup& setup) {
  const double ticks = setup.clock.value() / rate.value();
  if constexpr (std::is_floating_point_v<Interval>) {
    return ticks;
  } else {
    constexpr Interval longest = std::numeric_limits<Interval>::max();
    return static_cast<Interval>(std::min(std::ceil(ticks * (1 - 1e-15)), static_cast<double>(longest)));
  }
}

template <class Ramp>
Started walk(const Ramp& ramp, const RampRequest& request) {
  using Interval = typename Ramp::Interval;
  auto walk = std::make_unique<RampWalk<Ramp>>(ramp);
  const bool limited = request.rate > Hertz(0);
  const Interval cruise =
      limited ? std::max(interval_of<Interval>(request.rate, request.setup), ramp.fastest()) : ramp.fastest();
  const Interval start = request.start > Hertz(0) ? interval_of<Interval>(request.start, request.setup) : Interval{0};
  if (!walk->move().set_rates(start, cruise)) {
    return Failure{because(
        fmt::format("the ramp's first step has {:.6g} Hz, above the start rate of {:.6g} Hz; lower the acceleration",
                    request.setup.clock.value() / static_cast<double>(ramp.interval()), request.start.value()))};
  }
  // Upwards only is a move whose target is too far away to matter.
  const std::int64_t target = request.whole_move ? request.steps : 2 * RampRequest::most_steps;
  walk->move().move_to(static_cast<std::int32_t>(target));
  return Started(std::move(walk));
}

Started start_table(const RampRequest& request) {
  const double first = first_interval(request.setup);
  // Entries up to the middle of a move. Entries before the first index in the start/stop region are in the table too.
  const double share = request.start.value() / request.setup.clock.value() * first;
  const double before = std::min(share * share / 4, static_cast<double>(RampSequence::largest_table));
  const std::int64_t needed =
      (request.whole_move ? (request.steps + 1) / 2 : request.steps) + static_cast<std::int64_t>(std::ceil(before));
  const std::int64_t size =
      request.table_size > 0 ? request.table_size : std::min<std::int64_t>(needed, RampSequence::largest_table);
  TableRamp<TableOfAnySize> ramp(TableOfAnySize(static_cast<std::size_t>(size)));
  const double limit = TableRamp<TableOfAnySize>::longest_first_interval;
  if (!ramp.set_first_interval(static_cast<std::uint32_t>(std::min(first, limit + 1)))) {
    if (first < 1) {
      return Failure{because(fmt::format(
          "the first interval K_b = f \u221A(2\u03B1/a) = {:.6g} ticks is less than one tick; a faster clock is needed",
          first))};
    }
    const double clock = request.setup.clock.value() * (limit + 1) / first;
    return Failure{because(
        fmt::format("the first interval K_b = f \u221A(2\u03B1/a) = {:.1f} ticks is more than a table method's 16 bits "
                    "hold ({:.0f}); use a clock below {:.0f} Hz, a higher acceleration, or --method exact",
                    first, limit, std::floor(clock)))};
  }
  return walk(ramp, request);
}

Started start_whole_ticks(const RampRequest& request) {
  const double square = std::round(first_interval_squared(request.setup));
  constexpr double most = 4'294'967'295.0;
  if (square < 1 || square > most * most) {
    return Failure{because(fmt::format(
        "the first interval K_b = f \u221A(2\u03B1/a) = {:.6g} ticks is outside the range of whole ticks, 1 to {:.0f}",
        std::sqrt(square), most))};
  }
  const auto whole = static_cast<std::uint64_t>(square);
  if (request.method == RampMethod::exact) return walk(ExactRamp(whole), request);
  if (request.whole_move) {
    return Failure{because("the recursion in whole ticks cannot decelerate; use real ticks, or --method exact")};
  }
  return walk(UpwardsOnly(whole, rounded_root(whole)), request);
}

Started start_walk(const RampRequest& request) {
  if (request.jerk.value > 0) {
    if (!request.whole_move || request.method != RampMethod::exact) {
      return Failure{because("a jerk limit is only for whole moves (--move N) with --method exact")};
    }
    const double rate = request.rate > Hertz(0) ? request.rate.value() : HUGE_VAL;
    const SCurveLimits limits{
        .setup = request.setup, .jerk = request.jerk, .rate = Hertz(rate), .start = request.start};
    return Started(std::make_unique<SCurveWalk>(limits, request.steps, request.whole_ticks));
  }
  if (request.method == RampMethod::table) return start_table(request);
  if (request.whole_ticks && request.method == RampMethod::midpoint) {
    return Failure{
        because("the midpoint recursion needs a square root per step, so it is only for real ticks. In whole ticks its "
                "intervals are those of --method exact")};
  }
  if (request.whole_ticks) return start_whole_ticks(request);
  const double first = first_interval(request.setup);
  if (request.method == RampMethod::midpoint) {
    constexpr std::int64_t most = 200'000;  // from index 100 000 down to rest the recursion loses all but six digits
    if (request.whole_move && request.steps > most) {
      return Failure{
          because(fmt::format("the midpoint recursion loses precision while decelerating, so a --move has at most {} "
                              "steps; use --method exact",
                              most))};
    }
    return walk(RealMidpointRamp(first), request);
  }
  return request.method == RampMethod::exact ? walk(RealExactRamp(first), request)
                                             : walk(RealRecursiveRamp(first), request);
}

}  // namespace

RampSequence::RampSequence(std::unique_ptr<Walk> walk, const RampRequest& request)
    : walk_(std::move(walk)),
      left_(request.steps),
      to_stop_(request.whole_move ? request.stop_after : 0),
      to_reverse_(request.whole_move ? request.reverse_after : 0),
      whole_move_(request.whole_move),
      whole_ticks_(request.whole_ticks || request.method == RampMethod::table) {}
RampSequence::RampSequence(RampSequence&&) noexcept = default;
RampSequence& RampSequence::operator=(RampSequence&&) noexcept = default;
RampSequence::~RampSequence() = default;

Result<RampSequence, RampError> RampSequence::start(const RampRequest& request) {
  Started started = start_walk(request);
  if (!started) return Failure{started.error()};
  return RampSequence(std::move(*started), request);
}

bool RampSequence::done() const {
  return (!whole_move_ && left_ == 0) || walk_->done();
}

double RampSequence::next() {
  --left_;
  const double interval = walk_->next();
  if (to_stop_ > 0 && --to_stop_ == 0) walk_->stop();
  if (to_reverse_ > 0 && --to_reverse_ == 0) walk_->go_back();
  return interval;
}

std::int64_t RampSequence::place() const {
  return walk_->place();
}

}  // namespace passo
