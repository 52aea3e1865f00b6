#include "passo/cam/wire_cut.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "wire_match.hpp"
#include <fmt/format.h>

#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

using WireRow = std::vector<FlatVector>;

constexpr double wire_step_nm = 1'000;  // less is no step
constexpr Nanometres wire_chords{500};

// One side's way: places, and the kerf of the way to each.
struct SideWay {
  WireRow places;
  std::vector<double> kerfs;  // mm
};

FlatVector unit_of(FlatVector v) {
  const double length = std::hypot(v.x, v.y);
  return length > 0 ? FlatVector{v.x / length, v.y / length} : FlatVector{};
}
double gap(FlatVector a, FlatVector b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}
FlatVector moved(FlatVector at, FlatVector along, double by) {
  return {at.x + along.x * by, at.y + along.y * by};
}
DrawnPoint drawn(FlatVector at) {
  return {{std::llround(at.x)}, {std::llround(at.y)}};
}

// Where the lines through these places in these directions cross.
std::optional<FlatVector> crossing(FlatVector a, FlatVector along_a, FlatVector b, FlatVector along_b) {
  const double across = cross(along_a, along_b);
  if (std::abs(across) < 1e-9) return std::nullopt;
  return moved(a, along_a, cross({b.x - a.x, b.y - a.y}, along_b) / across);
}

class WirePlanner {
 public:
  WirePlanner(const WireProfile& left, const WireProfile& right, const WireOptions& options, Diagnostics& diagnostics)
      : left_(left),
        right_(right),
        options_(options),
        diagnostics_(diagnostics),
        rows_(match_rows(left, right, options.tolerance)) {}

  WirePlan plan();

 private:
  // The two sides of a section move at one ratio. Half of the kerf of each section, nm.
  void find_kerfs();
  double duration(double left_mm, double right_mm) const;
  std::size_t steps_around(const WireRow& row, const std::vector<double>& kerfs, std::size_t i) const;
  void put_corner(const WireRow& row, const std::vector<double>& kerfs, std::size_t i, std::size_t steps,
                  SideWay& way) const;
  void take_out_turned(const WireRow& row, const std::vector<std::size_t>& first, SideWay& way, const char* side);
  void add_leads();
  void finish();
  void measure(const WireProfile& profile, const SideWay& way, WireSide& side) const;

  const WireProfile& left_;
  const WireProfile& right_;
  const WireOptions& options_;
  Diagnostics& diagnostics_;
  MatchedRows rows_;
  std::vector<double> kerfs_left_;  // mm, of the way from each place to the next
  std::vector<double> kerfs_right_;
  SideWay way_left_;
  SideWay way_right_;
  WirePlan plan_;
};

double WirePlanner::duration(double left_mm, double right_mm) const {
  return std::max(std::min(left_mm, right_mm) / options_.feed, std::max(left_mm, right_mm) / options_.most_feed);
}

void WirePlanner::find_kerfs() {
  for (std::size_t k = 0; k + 1 < rows_.marks.size(); ++k) {
    double left = 0;
    double right = 0;
    for (std::size_t i = rows_.marks[k]; i < rows_.marks[k + 1]; ++i) {
      left += gap(rows_.left[i], rows_.left[i + 1]) / nanometres_per_mm;
      right += gap(rows_.right[i], rows_.right[i + 1]) / nanometres_per_mm;
    }
    const double time = duration(left, right);
    const double of_left = kerf_at(options_.kerf, left / time);
    const double of_right = kerf_at(options_.kerf, right / time);
    for (std::size_t i = rows_.marks[k]; i < rows_.marks[k + 1]; ++i) {
      kerfs_left_.push_back(of_left);
      kerfs_right_.push_back(of_right);
    }
  }
}

// A profile goes counterclockwise: what stays inside is to the left of the way, and the wire to its right.
double side_of_wire(WireKeeps keeps) {
  return keeps == WireKeeps::inside ? -1 : keeps == WireKeeps::outside ? 1 : 0;
}

// Around an outer corner the wire goes on an arc: how many chords that has. 0: the corner is one place.
std::size_t WirePlanner::steps_around(const WireRow& row, const std::vector<double>& kerfs, std::size_t i) const {
  const double side = side_of_wire(options_.keeps);
  if (i == 0 || i + 1 >= row.size() || side == 0) return 0;
  const FlatVector in = unit_of({row[i].x - row[i - 1].x, row[i].y - row[i - 1].y});
  const FlatVector out = unit_of({row[i + 1].x - row[i].x, row[i + 1].y - row[i].y});
  const double turn = std::atan2(cross(in, out), dot(in, out));
  constexpr double blunt = 20 * std::numbers::pi / 180;
  if (turn * side > 0 || std::abs(turn) < blunt) return 0;
  const double radius = std::max({kerfs[i - 1], kerfs[i], 1e-3}) / 2 * nanometres_per_mm;
  const double share = std::clamp(static_cast<double>(options_.tolerance.count) / radius, 1e-3, 0.5);
  return static_cast<std::size_t>(std::ceil(std::abs(turn) / (2 * std::acos(1 - share))));
}

// The places of the wire at a place of the profile: `steps` + 1 of them.
void WirePlanner::put_corner(const WireRow& row, const std::vector<double>& kerfs, std::size_t i, std::size_t steps,
                             SideWay& way) const {
  const double side = side_of_wire(options_.keeps) / 2 * nanometres_per_mm;
  const std::size_t before = i == 0 ? 0 : i - 1;
  const std::size_t behind = i + 1 == row.size() ? before : i;
  const FlatVector in = unit_of({row[before + 1].x - row[before].x, row[before + 1].y - row[before].y});
  const FlatVector out = unit_of({row[behind + 1].x - row[behind].x, row[behind + 1].y - row[behind].y});
  const auto normal = [](FlatVector v) { return FlatVector{-v.y, v.x}; };
  const FlatVector first = moved(row[i], normal(in), kerfs[before] * side);
  const FlatVector last = moved(row[i], normal(out), kerfs[behind] * side);
  const bool is_corner = steps_around(row, kerfs, i) > 0;
  for (std::size_t k = 0; k <= steps; ++k) {
    const double share = steps == 0 ? 0.5 : static_cast<double>(k) / static_cast<double>(steps);
    FlatVector at{};
    if (is_corner) {
      const double turn = std::atan2(cross(in, out), dot(in, out)) * share;
      const FlatVector along{in.x * std::cos(turn) - in.y * std::sin(turn),
                             in.x * std::sin(turn) + in.y * std::cos(turn)};
      at = moved(row[i], normal(along), (kerfs[before] + (kerfs[behind] - kerfs[before]) * share) * side);
    } else {
      const std::optional<FlatVector> cut = crossing(first, in, last, out);
      // Where the way hardly turns, a change of the kerf would put the crossing far away.
      const double most = 2 * std::abs(side) * std::max(kerfs[before], kerfs[behind]) + wire_step_nm;
      const double turn = std::abs(std::atan2(cross(in, out), dot(in, out)));
      const FlatVector middle{(first.x + last.x) / 2, (first.y + last.y) / 2};
      at = cut && turn > 0.05 && (turn > 1 || gap(*cut, row[i]) < most) ? *cut : middle;
    }
    way.kerfs.push_back(kerfs[before]);
    way.places.push_back(at);
  }
}

// Where an inner corner is tighter than the wire melts, places come in the wrong order: they become the one place where
// the ways around them cross. `first`: the first place of the way at each place of the row.
void WirePlanner::take_out_turned(const WireRow& row, const std::vector<std::size_t>& first, SideWay& way,
                                  const char* side) {
  const auto is_turned = [&](std::size_t i) {
    const FlatVector was{row[i + 1].x - row[i].x, row[i + 1].y - row[i].y};
    const FlatVector a = way.places[first[i + 1] - 1];
    const FlatVector b = way.places[first[i + 1]];
    return gap(a, b) > wire_step_nm && dot(was, {b.x - a.x, b.y - a.y}) < 0;
  };
  bool is_told = false;
  constexpr int most_rounds = 200;
  for (int round = 0; round < most_rounds; ++round) {
    bool is_done = true;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      if (!is_turned(i)) continue;
      is_done = false;
      std::size_t end = i + 1;
      while (end + 1 < row.size() && is_turned(end)) ++end;
      // Chords beside, which go on in the right way.
      const std::size_t from = i == 0 ? 0 : i - 1;
      const std::size_t to = std::min(end + 1, row.size() - 1);
      const FlatVector a = way.places[first[from + 1] - 1];
      const FlatVector along_a{row[from + 1].x - row[from].x, row[from + 1].y - row[from].y};
      const FlatVector b = way.places[first[to]];
      const FlatVector along_b{row[to].x - row[to - 1].x, row[to].y - row[to - 1].y};
      const FlatVector middle{(a.x + b.x) / 2, (a.y + b.y) / 2};
      const FlatVector at = crossing(a, unit_of(along_a), b, unit_of(along_b)).value_or(middle);
      for (std::size_t k = first[i]; k < (end + 1 < row.size() ? first[end + 1] : way.places.size()); ++k) {
        way.places[k] = at;
      }
      if (!is_told) {
        diagnostics_.add(
            {.severity = Severity::warning,
             .code = "wire.narrow",
             .file = "",
             .place = {},
             .message = fmt::format("the curve of the {} profile at X{:.6g} Y{:.6g} mm is tighter than the kerf allows",
                                    side, row[i].x / nanometres_per_mm, row[i].y / nanometres_per_mm),
             .expected = "a higher --feed or a thinner wire",
             .text = ""});
      }
      is_told = true;
      i = end;
    }
    if (is_done) return;
  }
}

void WirePlanner::add_leads() {
  // Both ends begin beyond the block, however far the two profiles go.
  double most = options_.block_end.count > 0 ? static_cast<double>(options_.block_end.count) : way_left_.places[0].x;
  for (const SideWay* const way : {&way_left_, &way_right_}) {
    for (const FlatVector& at : way->places) most = std::max(most, at.x);
  }
  most += static_cast<double>(options_.lead.count);
  for (SideWay* const way : {&way_left_, &way_right_}) {
    way->places.insert(way->places.begin(), {most, way->places.front().y});
    way->places.push_back({most, way->places.back().y});
    const double kerf = kerf_at(options_.kerf, options_.feed);
    way->kerfs.insert(way->kerfs.begin(), kerf);
    way->kerfs[1] = kerf;
    way->kerfs.push_back(kerf);
  }
}

// Times, and the ends of the wire.
void WirePlanner::finish() {
  const auto width = static_cast<double>(options_.right_face.count - options_.left_face.count);
  for (std::size_t i = 0; i < way_left_.places.size(); ++i) {
    const WirePlace at{drawn(way_left_.places[i]), drawn(way_right_.places[i])};
    double time = 0;
    if (!plan_.faces.empty()) {
      const double left = distance_nm(plan_.faces.back().left, at.left) / nanometres_per_mm;
      const double right = distance_nm(plan_.faces.back().right, at.right) / nanometres_per_mm;
      if (std::max(left, right) * nanometres_per_mm < wire_step_nm) continue;
      time = duration(left, right);
      for (auto& [side, way] : {std::pair(&plan_.left, left), {&plan_.right, right}}) {
        side->way += way;
        side->most_speed = std::max(side->most_speed, way / time);
      }
    }
    WirePlace towers = at;
    if (width > 0) {
      const double before = static_cast<double>(options_.left_face.count) / width;
      const double behind = static_cast<double>(options_.span.count - options_.right_face.count) / width;
      const FlatVector across = from_to(at.left, at.right);
      towers = {shifted(at.left, {-across.x * before, -across.y * before}),
                shifted(at.right, {across.x * behind, across.y * behind})};
    }
    plan_.faces.push_back(at);
    plan_.towers.push_back(towers);
    plan_.minutes.push_back(time);
    plan_.kerfs_left.push_back(way_left_.kerfs[i]);
    plan_.kerfs_right.push_back(way_right_.kerfs[i]);
  }
}

// What the wire takes of the profile: a sweep of each part of its way by half of the kerf there.
void WirePlanner::measure(const WireProfile& profile, const SideWay& way, WireSide& side) const {
  const auto [least, most] = std::ranges::minmax(way.kerfs);
  side.least_kerf = least;
  side.most_kerf = most;
  if (!profile.is_closed) return;
  side.face = filled({chords_of_path(profile.points, true, options_.tolerance)});
  if (options_.keeps != WireKeeps::inside) return;
  std::map<std::int64_t, std::vector<DrawnRing>> ways;  // by half of the kerf, nm
  // The leads lie beside the profile.
  for (std::size_t i = 2; i + 1 < way.places.size(); ++i) {
    const std::int64_t half = std::llround(way.kerfs[i] / 2 * nanometres_per_mm);
    std::vector<DrawnRing>& same = ways[half];
    if (same.empty() || same.back().back() != drawn(way.places[i - 1])) same.push_back({drawn(way.places[i - 1])});
    same.back().push_back(drawn(way.places[i]));
  }
  // Chords on curves, and where two kerfs meet, take a little.
  constexpr std::int64_t rounding = 2'000;
  const std::int64_t allowed = rounding + 2 * options_.tolerance.count;
  for (const auto& [half, rows] : ways) {
    if (half <= allowed) continue;
    side.lost_mm2 += area_mm2(common(side.face, swept(rows, {half - allowed}, wire_chords)));
  }
}

WirePlan WirePlanner::plan() {
  if (rows_.left.empty()) {
    diagnostics_.add({.code = "wire.no-line",
                      .file = "",
                      .place = {},
                      .message = "there is no line for the wire to follow",
                      .expected = "one line, arc, curve or circle for each side",
                      .text = ""});
    return {};
  }
  find_kerfs();
  plan_.sections = rows_.marks.size() - 1;
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < rows_.left.size(); ++i) {
    first.push_back(way_left_.places.size());
    const std::size_t steps =
        std::max(steps_around(rows_.left, kerfs_left_, i), steps_around(rows_.right, kerfs_right_, i));
    put_corner(rows_.left, kerfs_left_, i, steps, way_left_);
    put_corner(rows_.right, kerfs_right_, i, steps, way_right_);
  }
  if (options_.keeps != WireKeeps::line) {
    take_out_turned(rows_.left, first, way_left_, "left");
    take_out_turned(rows_.right, first, way_right_, "right");
  }
  if (left_.is_closed && right_.is_closed) add_leads();
  finish();
  measure(left_, way_left_, plan_.left);
  measure(right_, way_right_, plan_.right);
  return std::move(plan_);
}

}  // namespace

double kerf_at(const std::vector<WireKerf>& measured, double speed) {
  if (measured.empty()) return 0;
  if (measured.size() == 1) return measured[0].width * measured[0].speed / speed;
  // The two measured speeds around this one, or at that end.
  std::size_t i = 1;
  while (i + 1 < measured.size() && measured[i].speed < speed) ++i;
  const WireKerf& a = measured[i - 1];
  const WireKerf& b = measured[i];
  const double share = (1 / speed - 1 / a.speed) / (1 / b.speed - 1 / a.speed);
  return std::max(0.0, a.width + (b.width - a.width) * share);
}

WirePlan plan_wire_cut(const WireProfile& left, const WireProfile& right, const WireOptions& options,
                       Diagnostics& diagnostics) {
  return WirePlanner(left, right, options, diagnostics).plan();
}

}  // namespace passo
