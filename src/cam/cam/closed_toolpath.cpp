#include "closed_toolpath.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "passo/cam/bulge.hpp"

namespace passo {
namespace {

constexpr double least_way = 50;  // nm: less is no move

}  // namespace

ClosedToolpath::ClosedToolpath(const std::vector<PathPoint>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const DrawnPoint to = points[(i + 1) % points.size()].at;
    const double way = way_nm(points[i].at, to, points[i].bulge);
    if (way <= 0) continue;
    pieces_.push_back({points[i].at, to, points[i].bulge, length_, way});
    length_ += way;
  }
}

double ClosedToolpath::turned(double along) const {
  const double rest = std::fmod(along, length_);
  return rest < 0 ? rest + length_ : rest;
}

const ClosedToolpath::Piece& ClosedToolpath::piece_at(double along) const {
  const auto after = std::ranges::upper_bound(pieces_, along, {}, &Piece::start);
  return after == pieces_.begin() ? pieces_.front() : *(after - 1);
}

DrawnPoint ClosedToolpath::at(double along) const {
  const Piece& piece = piece_at(turned(along));
  const double share = std::clamp((turned(along) - piece.start) / piece.length, 0.0, 1.0);
  return point_along(piece.from, piece.to, piece.bulge, share);
}

double ClosedToolpath::direction(double along) const {
  const Piece& piece = piece_at(turned(along));
  const double chord = std::atan2(static_cast<double>(piece.to.y.count - piece.from.y.count),
                                  static_cast<double>(piece.to.x.count - piece.from.x.count));
  const double share = (turned(along) - piece.start) / piece.length;
  return chord + sweep_of(piece.bulge) * (share - 0.5);
}

std::pair<double, double> ClosedToolpath::nearest(DrawnPoint point) const {
  std::pair<double, double> best(0, std::numeric_limits<double>::max());
  for (const Piece& piece : pieces_) {
    if (piece.bulge == 0) {
      const auto dx = static_cast<double>(piece.to.x.count - piece.from.x.count);
      const auto dy = static_cast<double>(piece.to.y.count - piece.from.y.count);
      const double dot = dx * static_cast<double>(point.x.count - piece.from.x.count) +
                         dy * static_cast<double>(point.y.count - piece.from.y.count);
      const double share = std::clamp(dot / (dx * dx + dy * dy), 0.0, 1.0);
      const double distance = distance_nm(point, point_along(piece.from, piece.to, 0, share));
      if (distance < best.second) best = {piece.start + share * piece.length, distance};
      continue;
    }
    constexpr int tried = 64;  // places of a piece: tabs need no better place
    for (int k = 0; k < tried; ++k) {
      const double share = static_cast<double>(k) / tried;
      const double distance = distance_nm(point, point_along(piece.from, piece.to, piece.bulge, share));
      if (distance < best.second) best = {piece.start + share * piece.length, distance};
    }
  }
  return best;
}

bool ClosedToolpath::is_within(DrawnPoint centre, double radius) const {
  constexpr int tried = 4;  // places of a piece
  constexpr double close = 1'000;
  return std::ranges::all_of(pieces_, [&](const Piece& piece) {
    for (int k = 0; k < tried; ++k) {
      const DrawnPoint place = point_along(piece.from, piece.to, piece.bulge, static_cast<double>(k) / tried);
      if (distance_nm(place, centre) > radius + close) return false;
    }
    return true;
  });
}

ClosedToolpath ClosedToolpath::from(double along) const {
  MillRun run;
  append(run, along, along + length_, {}, {});
  std::vector<PathPoint> points;
  for (const MillPoint& point : run) points.push_back({point.at, point.bulge});
  if (!points.empty()) points.pop_back();
  return ClosedToolpath(points);
}

std::vector<std::pair<double, double>> ClosedToolpath::straights() const {
  std::vector<std::pair<double, double>> straights;
  for (const Piece& piece : pieces_) {
    if (piece.bulge == 0) straights.emplace_back(piece.start, piece.start + piece.length);
  }
  return straights;
}

void ClosedToolpath::keep_above(Nanometres top, std::vector<std::pair<double, double>> stretches) {
  top_ = top;
  kept_ = std::move(stretches);
}

bool ClosedToolpath::is_kept(double along) const {
  return std::ranges::any_of(kept_, [&](const auto& stretch) {
    const double off = turned(along - stretch.first);
    return off < stretch.second - stretch.first;
  });
}

bool ClosedToolpath::keeps(double from, double to) const {
  return std::ranges::any_of(kept_, [&](const auto& stretch) {
    return turned(from - stretch.first) < stretch.second - stretch.first || turned(stretch.first - from) < to - from;
  });
}

void ClosedToolpath::append(MillRun& run, double from, double to, Nanometres from_z, Nanometres to_z) const {
  // Where anything changes: a piece ends, a stretch begins or ends, the ramp passes the top of the stretches.
  std::vector<double> stops = {from, to};
  const auto add_all = [&](double place) {
    for (double stop = from + turned(place - from); stop < to; stop += length_) stops.push_back(stop);
  };
  for (const Piece& piece : pieces_) add_all(piece.start);
  for (const auto& [start, end] : kept_) {
    add_all(start);
    add_all(end);
  }
  const auto down = static_cast<double>(to_z.count - from_z.count);
  if (!kept_.empty() && down != 0) {
    const double share = static_cast<double>(top_.count - from_z.count) / down;
    if (share > 0 && share < 1) stops.push_back(from + share * (to - from));
  }
  std::ranges::sort(stops);
  double at_stop = from;
  for (const double stop : stops) {
    if (stop - at_stop < least_way) continue;
    const double middle = (at_stop + stop) / 2;
    const bool kept = is_kept(middle);
    const auto height = [&](double along) {
      const Nanometres z{from_z.count + std::llround(down * (along - from) / (to - from))};
      return kept ? std::max(z, top_) : z;
    };
    const Piece& piece = piece_at(turned(middle));
    const double bulge = std::tan(std::atan(piece.bulge) * (stop - at_stop) / piece.length);
    const DrawnPoint start = at(at_stop);
    if (run.empty() || run.back().at != start || run.back().z != height(at_stop)) {
      run.push_back({start, 0, height(at_stop)});
    }
    run.back().bulge = piece.bulge == 0 ? 0 : bulge;
    run.push_back({at(stop), 0, height(stop)});
    at_stop = stop;
  }
}

}  // namespace passo
