#include "engagement.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "passo/cam/bulge.hpp"

namespace passo {
namespace {

constexpr double turn = 2 * std::numbers::pi;

struct CutterPlace {
  double x = 0;  // in radii of the cutter
  double y = 0;
  double ahead = 0;  // the direction of its way, radians
};

class EngagementFinder {
 public:
  EngagementFinder(const std::vector<MillRun>& entry, const std::vector<MillRun>& runs, Nanometres cutter)
      : radius_(static_cast<double>(cutter.count) / 2) {
    for (const MillRun& run : entry) add(run);
    first_ = places_.size();
    for (const MillRun& run : runs) add(run);
  }

  Engagement find(const WorkProgress& progress) {
    if (places_.empty()) return {};
    lay_out();
    // Very long ways are looked at here and there.
    constexpr std::size_t most_looks = 50'000;
    const std::size_t each = (places_.size() - first_) / most_looks + 1;
    Engagement most;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (i >= first_ && i % each == 0) {
        const double degrees = engagement_at(places_[i]) * 360 / turn;
        if (degrees > most.most_degrees) most = {degrees, drawn(places_[i])};
        progress.stage(i, places_.size()).update(1);
      }
      cell_of(places_[i]).push_back(static_cast<std::uint32_t>(i));
    }
    return most;
  }

 private:
  // So many places on a way of the cutter's radius: what stays between them is at most 1/288 of the radius high. It
  // makes 60 degrees 0.2 more.
  static constexpr double places_a_radius = 6;
  static constexpr double cell = 2;  // radii

  void add(const MillRun& run) {
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      const MillPoint& from = run[i];
      const MillPoint& to = run[i + 1];
      const double way = way_nm(from.at, to.at, from.bulge);
      const double parts = std::ceil(way / radius_ * places_a_radius);
      for (double k = 1; k <= parts; ++k) add(from, to, k / parts);
    }
  }
  void add(const MillPoint& from, const MillPoint& to, double share) {
    const DrawnPoint at = point_along(from.at, to.at, from.bulge, share);
    const double chord = std::atan2(static_cast<double>(to.at.y.count - from.at.y.count),
                                    static_cast<double>(to.at.x.count - from.at.x.count));
    const double lean = from.bulge == 0 ? 0 : passo::sweep_of(from.bulge) * (share - 0.5);
    places_.push_back({static_cast<double>(at.x.count) / radius_, static_cast<double>(at.y.count) / radius_,
                       std::remainder(chord + lean, turn)});
  }
  DrawnPoint drawn(const CutterPlace& place) const {
    return {{std::llround(place.x * radius_)}, {std::llround(place.y * radius_)}};
  }

  void lay_out() {
    double most_x = places_.front().x;
    double most_y = places_.front().y;
    least_x_ = most_x;
    least_y_ = most_y;
    for (const CutterPlace& place : places_) {
      least_x_ = std::min(least_x_, place.x);
      least_y_ = std::min(least_y_, place.y);
      most_x = std::max(most_x, place.x);
      most_y = std::max(most_y, place.y);
    }
    // A rim of empty cells around all.
    columns_ = static_cast<std::size_t>((most_x - least_x_) / cell) + 3;
    const auto rows = static_cast<std::size_t>((most_y - least_y_) / cell) + 3;
    cells_.resize(columns_ * rows);
  }
  std::size_t index_of(const CutterPlace& place) const {
    return (static_cast<std::size_t>((place.y - least_y_) / cell) + 1) * columns_ +
           static_cast<std::size_t>((place.x - least_x_) / cell) + 1;
  }
  std::vector<std::uint32_t>& cell_of(const CutterPlace& place) { return cells_[index_of(place)]; }

  // The directions from the cutter's middle that are free, from `from` on, `width` radians.
  void free(double from, double width) {
    const double begin = from < 0 ? from + turn : from >= turn ? from - turn : from;
    free_.emplace_back(begin, std::min(turn, begin + width));
    if (begin + width > turn) free_.emplace_back(0, begin + width - turn);
  }

  double engagement_at(const CutterPlace& place) {
    free_.clear();
    free(std::remainder(place.ahead + turn / 4, turn), turn / 2);  // behind it the cutter has just been
    const std::size_t middle = index_of(place);
    for (const std::size_t row : {middle - columns_, middle, middle + columns_}) {
      for (std::size_t index = row - 1; index <= row + 1; ++index) {
        for (const std::uint32_t i : cells_[index]) {
          const double x = places_[i].x - place.x;
          const double y = places_[i].y - place.y;
          const double away2 = x * x + y * y;
          if (away2 >= 4 || away2 < 1e-12) continue;
          const double half = std::acos(std::sqrt(away2) / 2);
          free(std::atan2(y, x) - half, 2 * half);
        }
      }
    }
    std::sort(free_.begin(), free_.end());
    double in_stock = 0;
    double reached = 0;
    for (const auto& [from, to] : free_) {
      in_stock += std::max(0.0, from - reached);
      reached = std::max(reached, to);
    }
    return in_stock + std::max(0.0, turn - reached);
  }

  double radius_;
  std::vector<CutterPlace> places_;
  std::size_t first_ = 0;  // that counts
  double least_x_ = 0;
  double least_y_ = 0;
  std::size_t columns_ = 0;
  std::vector<std::vector<std::uint32_t>> cells_;
  std::vector<std::pair<double, double>> free_;
};

}  // namespace

Engagement find_engagement(const std::vector<MillRun>& entry, const std::vector<MillRun>& runs, Nanometres cutter,
                           const WorkProgress& progress) {
  return EngagementFinder(entry, runs, cutter).find(progress);
}

}  // namespace passo
