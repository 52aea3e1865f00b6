#include "outline_tabs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

// How far two places are apart on a closed track.
double apart_on(double length, double a, double b) {
  const double there = std::fmod(std::abs(a - b), length);
  return std::min(there, length - there);
}

// The place nearest to a wish that is free, on a straight piece if `straights` has any. Negative: there is none.
double free_place(const ClosedToolpath& track, const SpreadTabs& tabs, double wish, double farthest,
                  const std::vector<std::pair<double, double>>& straights) {
  double best = -1;
  double least = farthest;
  const auto offer = [&](double place) {
    const double away = apart_on(track.length(), place, wish);
    const bool is_free = std::ranges::all_of(
        tabs.middles, [&](double other) { return apart_on(track.length(), place, other) >= 1.05 * tabs.wide_nm; });
    if (!is_free || away >= least) return;
    least = away;
    best = place;
  };
  for (const auto& [start, end] : straights) {
    const double low = start + tabs.wide_nm / 2;
    const double high = end - tabs.wide_nm / 2;
    if (low > high) continue;
    constexpr int places = 16;
    for (int i = 0; i <= places; ++i) offer(low + (high - low) * i / places);
    offer(std::clamp(wish, low, high));
  }
  return best;
}

}  // namespace

SpreadTabs spread_tabs(const ClosedToolpath& track, std::uint32_t wanted, const TabSize& size) {
  constexpr double most_of_track = 0.8;  // the rest is cut
  SpreadTabs tabs;
  if (wanted == 0 || track.length() <= 0) return tabs;
  tabs.wide_nm = static_cast<double>(size.width.count + size.cutter.count);
  const auto fitting = static_cast<std::uint32_t>(std::min(1e6, most_of_track * track.length() / tabs.wide_nm));
  const std::uint32_t count = std::max(1U, std::min(wanted, fitting));
  tabs.wide_nm = std::min(tabs.wide_nm, most_of_track * track.length());
  const double apart = track.length() / count;
  const std::vector<std::pair<double, double>> straights = track.straights();
  const std::vector<std::pair<double, double>> anywhere = {{-tabs.wide_nm / 2, track.length() + tabs.wide_nm / 2}};
  for (std::uint32_t k = 0; k < count; ++k) {
    const double wish = (k + 0.5) * apart;
    double place = free_place(track, tabs, wish, apart, straights);
    if (place < 0) place = free_place(track, tabs, wish, track.length(), anywhere);
    if (place >= 0) tabs.middles.push_back(place);
  }
  return tabs;
}

std::vector<DrawnPoint> put_tabs_on(ClosedToolpath& track, const SpreadTabs& tabs, const TabSize& size,
                                    Nanometres depth) {
  std::vector<DrawnPoint> places;
  std::vector<std::pair<double, double>> stretches;
  for (const double middle : tabs.middles) {
    stretches.emplace_back(middle - tabs.wide_nm / 2, middle + tabs.wide_nm / 2);
    places.push_back(track.at(middle));
  }
  track.keep_above({std::min<std::int64_t>(0, depth.count + size.height.count)}, std::move(stretches));
  return places;
}

std::string fewer_tabs_words(const ClosedToolpath& track, std::uint32_t wanted, const SpreadTabs& tabs) {
  if (tabs.middles.size() >= wanted) return {};
  return fmt::format("{} do not fit on a contour of {:.4g} mm, so it gets {}", counted(wanted, "tab"),
                     track.length() / nanometres_per_mm, tabs.middles.size());
}

std::string thin_tabs_words(const TabSize& size, Nanometres depth) {
  constexpr Nanometres narrowest{1'000'000};
  constexpr Nanometres lowest{300'000};
  const Nanometres height{std::min(size.height.count, -depth.count)};
  if (size.width >= narrowest && height >= lowest) return {};
  return fmt::format("tabs of {:g} x {:g} mm break easily; {:g} mm wide and {:g} mm high, or more, is safer",
                     to_mm(size.width).value(), to_mm(height).value(), to_mm(narrowest).value(), to_mm(lowest).value());
}

}  // namespace passo
