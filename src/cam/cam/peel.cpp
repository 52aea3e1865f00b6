#include "peel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "arc_fit.hpp"
#include "medial_axis.hpp"
#include "peel_discs.hpp"

namespace passo {
namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

// The greatest angle of its edge that a cutter has in the stock while its middle follows the rim of `next`, when all is
// free that it has reached from within `before`. Behind it, it has just been.
double engagement_on_rim(const PeelDisc& before, const PeelDisc& next, double cutter) {
  const double apart = std::hypot(next.x - before.x, next.y - before.y);
  const double free = before.radius + cutter;
  double widest = whole_turn / 2;  // the part of the rim outside of `before`, to each side
  if (apart > 0) {
    const double cosine = (before.radius * before.radius - apart * apart - next.radius * next.radius) /
                          (2 * apart * std::max(1.0, next.radius));
    if (cosine >= 1) return 0;
    widest = std::acos(std::max(-1.0, cosine));
  }
  constexpr int places = 32;
  double most = 0;
  for (int i = -places; i <= places; ++i) {
    const double along = widest * i / places;
    const double x = apart + next.radius * std::cos(along);
    const double y = next.radius * std::sin(along);
    const double away = std::hypot(x, y);
    if (away <= before.radius || away <= 0) continue;
    // The stock begins at this angle from the direction away from `before`, to each side.
    const double half =
        std::acos(std::clamp((free * free - away * away - cutter * cutter) / (2 * away * cutter), -1.0, 1.0));
    const double lean = std::remainder(std::atan2(y, x) - along, whole_turn);
    most = std::max(most, std::min(whole_turn / 2, lean + half) - std::max(0.0, lean - half));
  }
  return most;
}

class Peeler {
 public:
  Peeler(const Region& ground, const PeelOptions& options)
      : ground_(ground),
        options_(options),
        cutter_(static_cast<double>(options.cutter.count) / 2),
        most_(options.most_degrees / 360 * whole_turn),
        least_beyond_(cutter_ / 50) {}

  PeelWay find(const WorkProgress& progress) {
    constexpr double chords = 2'000;  // nm
    axis_ = medial_axis(ground_, {.tolerance_nm = chords});
    if (!axis_ || axis_->pieces.empty()) return {};
    at_node_.resize(axis_->nodes);
    std::vector<std::pair<double, std::uint32_t>> clearances;
    for (std::uint32_t i = 0; i < axis_->pieces.size(); ++i) {
      const MedialPiece& piece = axis_->pieces[i];
      at_node_[piece.from].push_back(i);
      at_node_[piece.to].push_back(i);
      clearances.emplace_back(piece.points.front().clearance, piece.from);
      clearances.emplace_back(piece.points.back().clearance, piece.to);
    }
    const std::uint32_t root = std::max_element(clearances.begin(), clearances.end())->second;
    const MedialPiece& piece = axis_->pieces[at_node_[root].front()];
    open(disc_of(piece.from == root ? piece.points.front() : piece.points.back()));
    prune(root);
    walk(root, progress.part(0.2, 0.9));
    if (is_too_long()) return {};
    for (const DrawnRing& ring : ground_.rings) go_along_wall(ring);
    lift();
    way_.discs = discs_.size();
    way_.is_whole = !is_too_long();
    return std::move(way_);
  }

 private:
  // A piece of the axis to walk along, and the last disc on the way there.
  struct Branch {
    std::uint32_t piece;
    std::uint32_t from;
    PeelDisc last;
  };

  static PeelDisc disc_of(const MedialPoint& point) { return {point.x, point.y, point.clearance}; }
  static double beyond(const PeelDisc& before, const PeelDisc& next) {
    return std::hypot(next.x - before.x, next.y - before.y) + next.radius - before.radius;
  }
  bool may_follow(const PeelDisc& before, const PeelDisc& next) const {
    const double step = beyond(before, next);
    return step <= 0 || (step < cutter_ && engagement_on_rim(before, next, cutter_) <= most_);
  }
  void open(const PeelDisc& disc);
  void widen(const PeelDisc& disc, double radius);
  void prune(std::uint32_t root);
  void walk(std::uint32_t root, const WorkProgress& progress);
  void walk_piece(const Branch& branch, std::vector<Branch>& branches);
  void take(const PeelDisc& before, const PeelDisc& disc);
  std::vector<std::pair<double, double>> rim_outside(const PeelDisc& disc, double from) const;
  void go_along_wall(const DrawnRing& ring);

  void go_to(double x, double y, const PeelDisc& through);
  bool is_free(DrawnPoint from, double x, double y) const;
  void arc(double x, double y, double radius, double from, double sweep);
  bool is_too_long() const { return length_ > longest_peel * cutter_; }
  void lift() {
    if (run_.size() > 1) way_.runs.push_back(std::move(run_));
    run_.clear();
  }
  void add(double x, double y) { run_.push_back({{{std::llround(x)}, {std::llround(y)}}, 0, {}}); }

  const Region& ground_;
  const PeelOptions& options_;
  double cutter_;  // radius, nm
  double most_;    // radians
  double least_beyond_;
  std::optional<MedialAxis> axis_;
  std::vector<std::vector<std::uint32_t>> at_node_;  // pieces
  std::vector<bool> is_walked_;
  std::vector<bool> is_passed_;
  PeelDiscs discs_;
  double length_ = 0;  // of all rims, nm
  MillRun run_;
  PeelWay way_;
};

// Adds an arc about x, y. Where climbing, discs are followed counterclockwise: the stock is on the right.
void Peeler::arc(double x, double y, double radius, double from, double sweep) {
  length_ += radius * std::abs(sweep) + cutter_ / 100;
  const double parts = std::ceil(std::abs(sweep) / (whole_turn / 3) - 1e-9);
  for (double i = 0; i < parts; ++i) {
    run_.back().bulge = std::tan(sweep / parts / 4);
    const double angle = from + sweep * (i + 1) / parts;
    add(x + radius * std::cos(angle), y + radius * std::sin(angle));
  }
}

// The hole of the helix, and from there to the first disc.
void Peeler::open(const PeelDisc& disc) {
  const double way = options_.climb ? 1 : -1;
  const double hole = std::min(disc.radius, 0.8 * cutter_);
  add(disc.x + hole, disc.y);
  arc(disc.x, disc.y, hole, 0, way * whole_turn);
  way_.entry = run_;
  run_ = {way_.entry.back()};
  widen(disc, hole);
  discs_.add(disc);
}

// A spiral of half circles about two middles: each turn is wider than the one before by what the angle allows.
void Peeler::widen(const PeelDisc& disc, double radius) {
  const double half = (options_.climb ? 1 : -1) * whole_turn / 2;
  while (radius < disc.radius - 1 && !is_too_long()) {
    double step = std::min(disc.radius - radius, cutter_);
    while (engagement_on_rim({disc.x, disc.y, radius}, {disc.x, disc.y, radius + step}, cutter_) > most_) step *= 0.97;
    arc(disc.x, disc.y, radius, 0, half);
    arc(disc.x + step / 2, disc.y, radius + step / 2, whole_turn / 2, half);
    radius += step;
  }
  arc(disc.x, disc.y, radius, 0, 2 * half);
}

// Leaves out ends of the axis whose discs add next to nothing to those where they begin: rays into the corners between
// the chords of round walls.
void Peeler::prune(std::uint32_t root) {
  is_walked_.assign(axis_->pieces.size(), false);
  std::vector<std::size_t> degree(at_node_.size());
  for (std::size_t node = 0; node < degree.size(); ++node) degree[node] = at_node_[node].size();
  std::vector<double> lost(at_node_.size(), 0);
  std::vector<std::uint32_t> ends;
  for (std::uint32_t node = 0; node < degree.size(); ++node) {
    if (degree[node] == 1) ends.push_back(node);
  }
  while (!ends.empty()) {
    const std::uint32_t node = ends.back();
    ends.pop_back();
    if (node == root) continue;
    const auto found = std::find_if(at_node_[node].begin(), at_node_[node].end(),
                                    [&](std::uint32_t piece) { return !is_walked_[piece]; });
    if (found == at_node_[node].end()) continue;
    const MedialPiece& piece = axis_->pieces[*found];
    const bool is_from = piece.from == node;
    const PeelDisc far = disc_of(is_from ? piece.points.front() : piece.points.back());
    const PeelDisc near = disc_of(is_from ? piece.points.back() : piece.points.front());
    const double sum = lost[node] + beyond(near, far);
    if (sum > least_beyond_) continue;
    is_walked_[*found] = true;
    const std::uint32_t other = is_from ? piece.to : piece.from;
    lost[other] = std::max(lost[other], sum);
    if (--degree[other] == 1) ends.push_back(other);
  }
}

void Peeler::walk(std::uint32_t root, const WorkProgress& progress) {
  is_passed_.assign(at_node_.size(), false);
  is_passed_[root] = true;
  const auto left = static_cast<std::size_t>(std::ranges::count(is_walked_, false));
  std::size_t walked = 0;
  std::vector<Branch> branches;
  const MedialPiece& any = axis_->pieces[at_node_[root].front()];
  const PeelDisc first = disc_of(any.from == root ? any.points.front() : any.points.back());
  for (const std::uint32_t piece : at_node_[root]) branches.push_back({piece, root, first});
  while (!branches.empty() && !is_too_long()) {
    const Branch branch = branches.back();
    branches.pop_back();
    if (is_walked_[branch.piece]) continue;
    is_walked_[branch.piece] = true;
    walk_piece(branch, branches);
    progress.stage(walked++, left).update(1);
  }
}

void Peeler::walk_piece(const Branch& branch, std::vector<Branch>& branches) {
  const MedialPiece& piece = axis_->pieces[branch.piece];
  std::vector<MedialPoint> points = piece.points;
  const bool is_ahead = piece.from == branch.from;
  if (!is_ahead) std::reverse(points.begin(), points.end());
  PeelDisc last = branch.last;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const PeelDisc begin = disc_of(points[i]);
    const PeelDisc end = disc_of(points[i + 1]);
    const auto at = [&](double share) {
      return PeelDisc{begin.x + share * (end.x - begin.x), begin.y + share * (end.y - begin.y),
                      begin.radius + share * (end.radius - begin.radius)};
    };
    double share = 0;
    while (!may_follow(last, end) && !is_too_long()) {
      double low = share;
      double high = 1;
      for (int k = 0; k < 16; ++k) {
        const double middle = (low + high) / 2;
        (may_follow(last, at(middle)) ? low : high) = middle;
      }
      // At least a little: the disc before was on the way here.
      share = std::max(low, std::min(1.0, share + 1e-6));
      take(last, at(share));
      last = at(share);
    }
  }
  const std::uint32_t node = is_ahead ? piece.to : piece.from;
  const PeelDisc end = disc_of(points.back());
  std::vector<std::uint32_t> on;
  for (const std::uint32_t next : at_node_[node]) {
    if (!is_walked_[next]) on.push_back(next);
  }
  const bool ends = is_passed_[node] || on.empty();
  if (beyond(last, end) > (ends ? 1 : 10) * least_beyond_) {
    take(last, end);
    last = end;
  }
  if (is_passed_[node]) return;
  is_passed_[node] = true;
  for (const std::uint32_t next : on) branches.push_back({next, node, last});
}

// The angles of the disc's rim, each from and to, that lie in no disc so far, counterclockwise from `from` on.
std::vector<std::pair<double, double>> Peeler::rim_outside(const PeelDisc& disc, double from) const {
  std::vector<std::pair<double, double>> inside;
  const auto cover = [&](double begin, double end) {
    begin -= whole_turn * std::floor((begin - from) / whole_turn);
    end -= whole_turn * std::floor((end - from) / whole_turn);
    if (begin <= end) {
      inside.emplace_back(begin, end);
    } else {
      inside.emplace_back(from, end);
      inside.emplace_back(begin, from + whole_turn);
    }
  };
  discs_.for_near(disc.x, disc.y, disc.radius, [&](const PeelDisc& other) {
    const double apart = std::hypot(other.x - disc.x, other.y - disc.y);
    if (apart + disc.radius <= other.radius) {
      inside.emplace_back(from, from + whole_turn);
    } else if (apart < disc.radius + other.radius && apart + other.radius > disc.radius) {
      const double half = std::acos(std::clamp(
          (apart * apart + disc.radius * disc.radius - other.radius * other.radius) / (2 * apart * disc.radius), -1.0,
          1.0));
      const double middle = std::atan2(other.y - disc.y, other.x - disc.x);
      cover(middle - half, middle + half);
    }
  });
  std::sort(inside.begin(), inside.end());
  std::vector<std::pair<double, double>> outside;
  double reached = from;
  for (const auto& [begin, end] : inside) {
    if (begin > reached) outside.emplace_back(reached, begin);
    reached = std::max(reached, end);
  }
  if (reached < from + whole_turn) outside.emplace_back(reached, from + whole_turn);
  return outside;
}

void Peeler::take(const PeelDisc& before, const PeelDisc& disc) {
  // From the side of the disc before, which is free.
  const double from = std::atan2(before.y - disc.y, before.x - disc.x);
  std::vector<std::pair<double, double>> rim = rim_outside(disc, from);
  if (!options_.climb) std::reverse(rim.begin(), rim.end());
  for (auto [begin, end] : rim) {
    if ((end - begin) * disc.radius < least_beyond_) continue;
    if (!options_.climb) std::swap(begin, end);
    go_to(disc.x + disc.radius * std::cos(begin), disc.y + disc.radius * std::sin(begin), before);
    arc(disc.x, disc.y, disc.radius, begin, end - begin);
  }
  discs_.add(disc);
}

bool Peeler::is_free(DrawnPoint from, double x, double y) const {
  const auto from_x = static_cast<double>(from.x.count);
  const auto from_y = static_cast<double>(from.y.count);
  const double length = std::hypot(x - from_x, y - from_y);
  constexpr double farthest = 40;  // radii; farther the cutter lifts
  if (length > farthest * cutter_) return false;
  const double parts = std::ceil(length / cutter_ * 8);
  for (double i = 1; i < parts; ++i) {
    if (!discs_.contain(from_x + (x - from_x) * i / parts, from_y + (y - from_y) * i / parts)) return false;
  }
  return true;
}

// On free ground, or lifted, and down again where it is free.
void Peeler::go_to(double x, double y, const PeelDisc& through) {
  if (run_.empty() || !is_free(run_.back().at, x, y)) {
    lift();
    add(through.x, through.y);
  }
  // Nothing is in the way: the disc is cleared.
  if (through.radius > 0) run_.back().pace = MillPace::link;
  add(x, y);
}

// Begins where a disc touches the wall, from its middle.
void Peeler::go_along_wall(const DrawnRing& ring) {
  std::size_t best = 0;
  PeelDisc touching;
  double least = 1e18;
  const std::size_t each = ring.size() / 1000 + 1;
  for (std::size_t i = 0; i < ring.size(); i += each) {
    const auto x = static_cast<double>(ring[i].x.count);
    const auto y = static_cast<double>(ring[i].y.count);
    discs_.for_near(x, y, cutter_ / 4, [&](const PeelDisc& disc) {
      const double away = std::hypot(disc.x - x, disc.y - y) - disc.radius;
      if (away >= least) return;
      least = away;
      best = i;
      touching = disc;
    });
  }
  DrawnRing wall = ring;
  std::rotate(wall.begin(), wall.begin() + static_cast<std::ptrdiff_t>(best), wall.end());
  if (!options_.climb) std::reverse(wall.begin() + 1, wall.end());
  wall.push_back(wall.front());
  const auto x = static_cast<double>(wall.front().x.count);
  const auto y = static_cast<double>(wall.front().y.count);
  if (touching.radius == 0) touching = {x, y, 0};
  go_to(x, y, touching);
  PeelLap lap{.run = way_.runs.size(), .first = run_.size() - 1};
  for (const PathPoint& point : with_arcs(wall, {})) {
    if (point.at != run_.back().at) run_.push_back({point.at, 0, {}});
    run_.back().bulge = point.bulge;
    run_.back().pace = MillPace::cut;
  }
  lap.last = run_.size() - 1;
  way_.laps.push_back(lap);
}

}  // namespace

PeelWay peel(const Region& ground, const PeelOptions& options, const WorkProgress& progress) {
  return Peeler(ground, options).find(progress);
}

}  // namespace passo
