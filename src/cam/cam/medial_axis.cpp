#include "medial_axis.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <boost/polygon/voronoi.hpp>

namespace passo {
namespace {

struct VoronoiPoint {
  std::int32_t px;
  std::int32_t py;
};
struct VoronoiSegment {
  VoronoiPoint from;
  VoronoiPoint to;
  bool from_is_reflex;  // the region is wider than a half turn there
  bool to_is_reflex;
  std::uint32_t owner;
};

}  // namespace
}  // namespace passo

namespace boost::polygon {

template <>
struct geometry_concept<passo::VoronoiPoint> {
  using type = point_concept;
};
template <>
struct point_traits<passo::VoronoiPoint> {
  using coordinate_type = std::int32_t;
  static coordinate_type get(const passo::VoronoiPoint& point, orientation_2d axis) {
    return axis == HORIZONTAL ? point.px : point.py;
  }
};
template <>
struct geometry_concept<passo::VoronoiSegment> {
  using type = segment_concept;
};
template <>
struct segment_traits<passo::VoronoiSegment> {
  using coordinate_type = std::int32_t;
  using point_type = passo::VoronoiPoint;
  static point_type get(const passo::VoronoiSegment& segment, direction_1d end) {
    return end.to_int() != 0 ? segment.to : segment.from;
  }
};

}  // namespace boost::polygon

namespace passo {
namespace {

using VoronoiDiagram = boost::polygon::voronoi_diagram<double>;

// What a cell of the diagram belongs to: an edge of the region, or an end of one.
struct MedialSite {
  const VoronoiSegment* segment;
  bool is_point;
  bool is_from;  // of a point: the edge's first end

  double x() const { return is_from ? segment->from.px : segment->to.px; }
  double y() const { return is_from ? segment->from.py : segment->to.py; }
  bool is_reflex() const { return is_from ? segment->from_is_reflex : segment->to_is_reflex; }

  // The place of the site that is nearest to a place.
  std::pair<double, double> foot(double px, double py) const {
    if (is_point) return {x(), y()};
    const double dx = static_cast<double>(segment->to.px) - segment->from.px;
    const double dy = static_cast<double>(segment->to.py) - segment->from.py;
    const double share =
        std::clamp(((px - segment->from.px) * dx + (py - segment->from.py) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
    return {segment->from.px + share * dx, segment->from.py + share * dy};
  }
  double away(double px, double py) const {
    const auto [fx, fy] = foot(px, py);
    return std::hypot(px - fx, py - fy);
  }
};

class MedialFinder {
 public:
  MedialFinder(const Region& region, const MedialOptions& options)
      : region_(region), options_(options), tolerance_(options.tolerance_nm) {}

  std::optional<MedialAxis> find() {
    const auto box = bounds(region_);
    if (!box) return MedialAxis{};
    middle_x_ = (box->least.x.count + box->most.x.count) / 2;
    middle_y_ = (box->least.y.count + box->most.y.count) / 2;
    constexpr std::int64_t farthest = 2'000'000'000;
    if (box->most.x.count - middle_x_ > farthest || box->most.y.count - middle_y_ > farthest) return std::nullopt;
    for (std::size_t i = 0; i < region_.rings.size(); ++i) {
      add(region_.rings[i], options_.owners.empty() ? nobody : options_.owners[i]);
    }
    VoronoiDiagram diagram;
    boost::polygon::construct_voronoi(segments_.begin(), segments_.end(), &diagram);
    for (const auto& edge : diagram.edges()) {
      if (&edge < edge.twin()) take(edge);
    }
    return std::move(axis_);
  }

 private:
  using Edge = VoronoiDiagram::edge_type;
  using Vertex = VoronoiDiagram::vertex_type;

  void add(const DrawnRing& ring, std::uint32_t owner);
  MedialSite site_of(const VoronoiDiagram::cell_type& cell) const;
  static bool is_inside(const MedialSite& site, double x, double y);
  bool is_between_owners(const MedialSite& a, const MedialSite& b) const;
  void take(const Edge& edge);
  void bend(const Edge& edge, const MedialSite& a, const MedialSite& b, std::vector<MedialPoint>& points) const;
  MedialPoint point(double x, double y, const MedialSite& site) const {
    return {x + static_cast<double>(middle_x_), y + static_cast<double>(middle_y_), site.away(x, y)};
  }
  std::uint32_t node(const Vertex* vertex) {
    const auto [entry, is_new] = nodes_.try_emplace(vertex, axis_.nodes);
    if (is_new) ++axis_.nodes;
    return entry->second;
  }

  const Region& region_;
  const MedialOptions& options_;
  double tolerance_;
  std::int64_t middle_x_ = 0;
  std::int64_t middle_y_ = 0;
  std::vector<VoronoiSegment> segments_;
  std::unordered_map<const Vertex*, std::uint32_t> nodes_;
  MedialAxis axis_;
};

void MedialFinder::add(const DrawnRing& ring, std::uint32_t owner) {
  const std::size_t count = ring.size();
  const auto at = [&](std::size_t i) {
    return VoronoiPoint{static_cast<std::int32_t>(ring[i % count].x.count - middle_x_),
                        static_cast<std::int32_t>(ring[i % count].y.count - middle_y_)};
  };
  const auto is_reflex = [&](std::size_t i) {
    const VoronoiPoint a = at(i + count - 1);
    const VoronoiPoint b = at(i);
    const VoronoiPoint c = at(i + 1);
    return (static_cast<double>(b.px) - a.px) * (static_cast<double>(c.py) - b.py) -
               (static_cast<double>(b.py) - a.py) * (static_cast<double>(c.px) - b.px) <
           0;
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (ring[i] == ring[(i + 1) % count]) continue;
    segments_.push_back({at(i), at(i + 1), is_reflex(i), is_reflex((i + 1) % count), owner});
  }
}

MedialSite MedialFinder::site_of(const VoronoiDiagram::cell_type& cell) const {
  return {&segments_[cell.source_index()], cell.contains_point(),
          cell.source_category() == boost::polygon::SOURCE_CATEGORY_SEGMENT_START_POINT};
}

// The region lies to the left of its edges. Of the places nearest to a corner those inside are beside a reflex one.
bool MedialFinder::is_inside(const MedialSite& site, double x, double y) {
  if (site.is_point) return site.is_reflex();
  const VoronoiSegment& s = *site.segment;
  return (static_cast<double>(s.to.px) - s.from.px) * (y - s.from.py) -
             (static_cast<double>(s.to.py) - s.from.py) * (x - s.from.px) >
         0;
}

bool MedialFinder::is_between_owners(const MedialSite& a, const MedialSite& b) const {
  if (options_.owners.empty()) return true;
  const std::uint32_t one = a.segment->owner;
  const std::uint32_t other = b.segment->owner;
  return one != other && one != nobody && other != nobody;
}

void MedialFinder::take(const Edge& edge) {
  if (!edge.is_primary() || !edge.is_finite()) return;
  const MedialSite a = site_of(*edge.cell());
  const MedialSite b = site_of(*edge.twin()->cell());
  if (!is_between_owners(a, b)) return;
  std::vector<MedialPoint> points = {point(edge.vertex0()->x(), edge.vertex0()->y(), a)};
  bend(edge, a, b, points);
  points.push_back(point(edge.vertex1()->x(), edge.vertex1()->y(), a));
  // The middle tells where the piece lies, and how far it is turned from one foot to the other.
  const MedialPoint& p = points[points.size() / 2 - (points.size() == 2 ? 1 : 0)];
  const MedialPoint& q = points[points.size() / 2];
  const double x = (p.x + q.x) / 2 - static_cast<double>(middle_x_);
  const double y = (p.y + q.y) / 2 - static_cast<double>(middle_y_);
  if (!is_inside(a, x, y)) return;
  const auto [ax, ay] = a.foot(x, y);
  const auto [bx, by] = b.foot(x, y);
  const double turn =
      std::abs(std::atan2((ax - x) * (by - y) - (ay - y) * (bx - x), (ax - x) * (bx - x) + (ay - y) * (by - y)));
  if (turn < options_.least_turn) return;
  axis_.pieces.push_back({node(edge.vertex0()), node(edge.vertex1()), std::move(points)});
}

// The places between the ends: of a parabola, and where the clearance is no straight line.
void MedialFinder::bend(const Edge& edge, const MedialSite& a, const MedialSite& b,
                        std::vector<MedialPoint>& points) const {
  if (!a.is_point && !b.is_point) return;
  const MedialSite& focus = a.is_point ? a : b;
  const MedialSite& other = a.is_point ? b : a;
  const double x0 = edge.vertex0()->x();
  const double y0 = edge.vertex0()->y();
  const double x1 = edge.vertex1()->x();
  const double y1 = edge.vertex1()->y();
  const double length = std::hypot(x1 - x0, y1 - y0);
  if (!(length > tolerance_)) return;
  constexpr double most = 200;
  const double smallest = std::max(tolerance_, std::min(focus.away(x0, y0), focus.away(x1, y1)));
  const double parts = std::min(most, std::ceil(length / std::sqrt(4 * tolerance_ * smallest)));
  for (double i = 1; i < parts; ++i) {
    const double share = i / parts;
    double x = x0 + share * (x1 - x0);
    double y = y0 + share * (y1 - y0);
    if (!other.is_point) {
      // The place above this one's foot on the edge that is as far from the focus as from the edge.
      const double dx = static_cast<double>(other.segment->to.px) - other.segment->from.px;
      const double dy = static_cast<double>(other.segment->to.py) - other.segment->from.py;
      const double size = std::hypot(dx, dy);
      const double along = ((x - other.segment->from.px) * dx + (y - other.segment->from.py) * dy) / size;
      const double fx = other.segment->from.px + along * dx / size;
      const double fy = other.segment->from.py + along * dy / size;
      const double up = ((focus.x() - fx) * -dy + (focus.y() - fy) * dx) / size;
      const double across = ((focus.x() - fx) * dx + (focus.y() - fy) * dy) / size;
      if (std::abs(up) < 1) continue;
      const double height = (up * up + across * across) / (2 * up);
      x = fx - height * dy / size;
      y = fy + height * dx / size;
    }
    points.push_back(point(x, y, focus));
  }
}

}  // namespace

std::optional<MedialAxis> medial_axis(const Region& region, const MedialOptions& options) {
  return MedialFinder(region, options).find();
}

}  // namespace passo
