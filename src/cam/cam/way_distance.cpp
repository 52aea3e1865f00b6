#include "way_distance.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat_vector.hpp"

namespace passo {
namespace {

// A part of the way from 0 to 1; empty where the end comes before the begin.
struct ShareSpan {
  double begin;
  double end;
};
constexpr ShareSpan no_span{2, -1};

ShareSpan joined(ShareSpan a, ShareSpan b) {
  if (a.begin > a.end) return b;
  return b.begin > b.end ? a : ShareSpan{std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

// Where offset + share * slope lies between two bounds.
ShareSpan between(double offset, double slope, double low, double high) {
  if (slope == 0) return offset >= low && offset <= high ? ShareSpan{0, 1} : no_span;
  const auto [begin, end] = std::minmax({(low - offset) / slope, (high - offset) / slope});
  return {std::max(0.0, begin), std::min(1.0, end)};
}

// Where the line from a to b is within a distance of a point.
ShareSpan within_disc(FlatVector to_a, FlatVector along, double distance) {
  const double square = dot(along, along);
  const double beyond = dot(to_a, to_a) - distance * distance;
  if (square == 0) return beyond <= 0 ? ShareSpan{0, 1} : no_span;
  const double middle = -dot(to_a, along) / square;
  const double half_square = middle * middle - beyond / square;
  if (half_square < 0) return no_span;
  const double half = std::sqrt(half_square);
  return {std::max(0.0, middle - half), std::min(1.0, middle + half)};
}

// What is within a distance of an edge is convex: one part of the line.
ShareSpan within(DrawnPoint a, DrawnPoint b, const EdgeGrid::Edge& edge, double distance) {
  const FlatVector along = from_to(a, b);
  const FlatVector to_a = from_to(edge.from, a);
  ShareSpan span = joined(within_disc(to_a, along, distance), within_disc(from_to(edge.to, a), along, distance));
  const FlatVector side = from_to(edge.from, edge.to);
  const double length = std::hypot(side.x, side.y);
  if (length == 0) return span;
  const ShareSpan beside = between(cross(side, to_a) / length, cross(side, along) / length, -distance, distance);
  const ShareSpan abreast = between(dot(side, to_a) / length, dot(side, along) / length, 0, length);
  return joined(span, {std::max(beside.begin, abreast.begin), std::min(beside.end, abreast.end)});
}

// The parts of a line that are within a distance of any edge, in order and apart.
std::vector<ShareSpan> spans_near(const EdgeGrid& edges, double distance, DrawnPoint a, DrawnPoint b) {
  std::vector<ShareSpan> found;
  edges.for_near(a, b, distance, [&](std::uint32_t index) {
    const ShareSpan span = within(a, b, edges.edge(index), distance);
    if (span.begin <= span.end) found.push_back(span);
  });
  std::ranges::sort(found, {}, &ShareSpan::begin);
  std::vector<ShareSpan> apart;
  for (const ShareSpan& span : found) {
    if (apart.empty() || span.begin > apart.back().end) {
      apart.push_back(span);
    } else {
      apart.back().end = std::max(apart.back().end, span.end);
    }
  }
  return apart;
}

std::vector<ShareSpan> between_spans(const std::vector<ShareSpan>& spans) {
  std::vector<ShareSpan> between;
  double from = 0;
  for (const ShareSpan& span : spans) {
    if (span.begin > from) between.push_back({from, span.begin});
    from = span.end;
  }
  if (from < 1) between.push_back({from, 1});
  return between;
}

std::vector<DrawnRing> pieces(const EdgeGrid& edges, Nanometres distance, const std::vector<DrawnRing>& lines,
                              bool is_near) {
  std::vector<DrawnRing> found;
  for (const DrawnRing& line : lines) {
    DrawnRing piece;
    const auto finish = [&] {
      if (piece.size() > 1) found.push_back(std::move(piece));
      piece.clear();
    };
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      std::vector<ShareSpan> spans = spans_near(edges, static_cast<double>(distance.count), line[i], line[i + 1]);
      if (!is_near) spans = between_spans(spans);
      const FlatVector along = from_to(line[i], line[i + 1]);
      const auto at = [&](double share) {
        return share >= 1 ? line[i + 1] : shifted(line[i], {share * along.x, share * along.y});
      };
      if (spans.empty() || spans.front().begin > 0) finish();
      for (const ShareSpan& span : spans) {
        if (span.begin > 0) finish();
        if (piece.empty()) piece.push_back(at(span.begin));
        if (at(span.end) != piece.back()) piece.push_back(at(span.end));
      }
      if (!spans.empty() && spans.back().end < 1) finish();
    }
    finish();
  }
  return found;
}

}  // namespace

std::vector<DrawnRing> pieces_far_from(const EdgeGrid& edges, Nanometres distance,
                                       const std::vector<DrawnRing>& lines) {
  return pieces(edges, distance, lines, false);
}

std::vector<DrawnRing> pieces_near(const EdgeGrid& edges, Nanometres distance, const std::vector<DrawnRing>& lines) {
  return pieces(edges, distance, lines, true);
}

bool is_near(const EdgeGrid& edges, Nanometres distance, DrawnPoint from, DrawnPoint to) {
  const auto reach = static_cast<double>(distance.count);
  bool found = false;
  edges.for_near(from, to, reach, [&](std::uint32_t index) {
    if (found) return;
    const ShareSpan span = within(from, to, edges.edge(index), reach);
    found = span.begin <= span.end;
  });
  return found;
}

}  // namespace passo
