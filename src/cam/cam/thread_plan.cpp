#include "passo/cam/thread_plan.hpp"

#include <algorithm>
#include <cmath>

#include "passo/cam/route.hpp"

namespace passo {
namespace {

constexpr double room_nm = 500'000;  // between a boss and the cutter that goes down beside it

class ThreadWay {
 public:
  explicit ThreadWay(const ThreadOptions& options) : options_(options) {
    const double minor = static_cast<double>((options.is_external ? options.size.root() : options.size.minor()).count);
    const auto major = static_cast<double>(options.size.major.count);
    const auto over = static_cast<double>(options.oversize.count);
    depth_ = (major - minor + over) / 2;
    // In a bore the cut grows outwards from the minor diameter; on a boss inwards from the major.
    wall_ = options.is_external ? major / 2 : minor / 2;
    const auto length = static_cast<double>(-options.depth.count);
    const bool has_one = options.teeth < 2;
    turns_ = has_one ? std::max<std::size_t>(1, count_of(length / options.size.pitch_nm)) : 1;
    stations_ = has_one ? 1 : std::max<std::size_t>(1, count_of(length / step()));
  }

  std::size_t turns() const { return turns_ * stations_; }
  bool goes_up() const {
    const bool rises_ccw = !options_.is_left_hand;
    const bool wants_ccw = options_.is_external != options_.climb;
    return rises_ccw == wants_ccw;
  }
  double feed_factor() const {
    const double tooth = options_.is_external ? wall_ - depth_ : wall_ + depth_;
    return radius_of(options_.passes) / tooth;
  }
  MillRun run_at(DrawnPoint axis) const {
    MillRun run;
    for (std::uint32_t pass = 1; pass <= options_.passes; ++pass) {
      for (std::size_t i = 0; i < stations_; ++i) {
        MillRun turn = turns_at(pass, goes_up() ? i : stations_ - 1 - i, axis);
        // A rapid leads down beside the wall. The height at which a run begins is not written.
        const Nanometres above{turn.front().z.count + 1'000'000};
        if (run.empty()) run.push_back({turn.front().at, 0, above});
        run.back().pace = MillPace::rapid;
        run.insert(run.end(), turn.begin(), turn.end());
      }
    }
    return run;
  }

 private:
  static std::size_t count_of(double turns) { return static_cast<std::size_t>(std::ceil(turns - 1e-6)); }
  double step() const { return options_.teeth * options_.size.pitch_nm; }
  // Passes of the same area: the chip of a tooth widens with its depth.
  double depth_of(std::uint32_t pass) const {
    return depth_ * std::sqrt(static_cast<double>(pass) / static_cast<double>(options_.passes));
  }
  // From the axis to the cutter's centre.
  double radius_of(std::uint32_t pass) const {
    const double cutter = static_cast<double>(options_.cutter.count) / 2;
    return options_.is_external ? wall_ - depth_of(pass) + cutter : wall_ + depth_of(pass) - cutter;
  }
  double away() const { return wall_ + static_cast<double>(options_.cutter.count) / 2 + room_nm; }
  DrawnPoint entry_of(DrawnPoint axis) const {
    return options_.is_external ? DrawnPoint{{axis.x.count + std::llround(away())}, axis.y} : axis;
  }
  // Counterclockwise and up, then turned around and mirrored as needed.
  MillRun turns_at(std::uint32_t pass, std::size_t station, DrawnPoint axis) const;

  const ThreadOptions& options_;
  double depth_ = 0;
  double wall_ = 0;
  std::size_t turns_ = 0;
  std::size_t stations_ = 0;
};

MillRun ThreadWay::turns_at(std::uint32_t pass, std::size_t station, DrawnPoint axis) const {
  const double pitch = options_.size.pitch_nm;
  const double lead_rise = options_.is_external ? 0 : pitch / 4;  // the middle of a bore sees half the lead's angle
  const double low = static_cast<double>(options_.depth.count) + step() * static_cast<double>(station);
  const double high = low + 2 * lead_rise + pitch * static_cast<double>(turns_);
  const std::int64_t radius = std::llround(radius_of(pass));
  const DrawnPoint right{{axis.x.count + radius}, axis.y};
  const DrawnPoint left{{axis.x.count - radius}, axis.y};
  const DrawnPoint entry = entry_of(axis);
  const auto z = [](double height) { return Nanometres{std::llround(height)}; };
  const double lead = options_.is_external ? -1 : 1;
  MillRun run{{entry, lead, z(low)}};
  for (std::size_t half = 0; half <= 2 * turns_; ++half) {
    const double height = low + lead_rise + pitch / 2 * static_cast<double>(half);
    run.push_back({half % 2 == 0 ? right : left, half == 2 * turns_ ? lead : 1, z(height)});
  }
  run.push_back({entry, 0, z(high)});
  if (options_.is_left_hand) {
    for (MillPoint& point : run) point.bulge = -point.bulge;
  }
  if (!goes_up()) {
    std::ranges::reverse(run);
    for (std::size_t i = 0; i + 1 < run.size(); ++i) run[i].bulge = -run[i + 1].bulge;
    run.back().bulge = 0;
  }
  return run;
}

}  // namespace

ThreadPlan plan_threads(const std::vector<DrawnPoint>& places, const ThreadOptions& options) {
  const ThreadWay way(options);
  constexpr std::uint64_t enough_a_place = 20'000;
  const auto order = shorten_route(places, options.park, options.park, enough_steps(places.size(), enough_a_place));
  ThreadPlan plan{.mill = {}, .turns = way.turns(), .goes_up = way.goes_up(), .feed_factor = way.feed_factor()};
  MillTool tool{.width = options.cutter, .words = {}, .runs = {}};
  for (const std::uint32_t index : order) tool.runs.push_back(way.run_at(places[index]));
  if (!tool.runs.empty()) plan.mill.tools.push_back(std::move(tool));
  return plan;
}

}  // namespace passo
