#include "path_drawing.hpp"

#include <cmath>

namespace passo {
namespace {

using Kind = PathRecorder::Kind;

double distance(Spot a, Spot b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

// Collects pieces of the same look and draws them in one stroke. A few long strokes keep an SVG small, but strokes that
// are too long make cairo slow. Pieces that are too short to be seen are joined.
class Stroke {
 public:
  void piece(Canvas& canvas, const Pen& pen, Spot from, Spot to) {
    constexpr double joined = 1e-9;
    constexpr double visible = 0.35;
    constexpr std::size_t longest = 1500;
    if (spots_.empty() || distance(from, end_) > joined) {
      close();
      spots_.push_back({from, true});
      length_ = 0;
    }
    length_ += distance(from, to);
    end_ = to;
    if (length_ < visible) return;
    spots_.push_back({to, false});
    length_ = 0;
    if (spots_.size() >= longest) flush(canvas, pen);
  }

  void flush(Canvas& canvas, const Pen& pen) {
    close();
    if (spots_.empty()) return;
    for (const auto& [spot, begins] : spots_) begins ? canvas.move_to(spot) : canvas.line_to(spot);
    canvas.stroke(pen);
    spots_.clear();
    length_ = 0;
  }

 private:
  struct Step {
    Spot spot;
    bool begins;
  };

  // Adds the last short pieces, so that they are drawn too. Seen from above, a plunge is only a dot.
  void close() {
    if (!spots_.empty() && (length_ > 0 || spots_.back().begins)) spots_.push_back({end_, false});
    length_ = 0;
  }

  std::vector<Step> spots_;
  Spot end_;
  double length_ = 0;
};

template <class Visit>
void for_each_piece(const PathRecorder& path, const Projection& projection, const Visit& visit) {
  const Point& base = path.base();
  Spot from;
  for (const PathRecorder::Vertex& vertex : path.vertices()) {
    const Spot to = projection.spot(base[Axis::x] + double{vertex.x}, base[Axis::y] + double{vertex.y},
                                    base[Axis::z] + double{vertex.z});
    if (vertex.kind != Kind::jump) visit(vertex, from, to);
    from = to;
  }
}

// The width that leaves about half of the paper white between neighbouring lines.
double feed_width(const PathRecorder& path, const Projection& projection) {
  double length = 0;
  Spot low{1e9, 1e9};
  Spot high{-1e9, -1e9};
  for_each_piece(path, projection, [&](const PathRecorder::Vertex& vertex, Spot from, Spot to) {
    if (vertex.kind != Kind::feed) return;
    length += distance(from, to);
    low = {std::min(low.x, to.x), std::min(low.y, to.y)};
    high = {std::max(high.x, to.x), std::max(high.y, to.y)};
  });
  constexpr double finest = 0.25;
  constexpr double broadest = 2.2;
  constexpr double least = 60;  // a narrow path has blank paper beside it
  const double paper = std::max(high.x - low.x, least) * std::max(high.y - low.y, least);
  return length > 0 ? std::clamp(0.4 * paper / length, finest, broadest) : broadest;
}

// A piece that points at the eye, like a plunge seen from above, is only a dot. A dot as wide as a line would be lost.
Pen dot_pen(Pen pen) {
  pen.width = 2.2 * pen.width;
  return pen;
}

}  // namespace

Pen rapid_pen() {
  return {.colour = {0.86, 0.36, 0.26}, .width = 0.8, .opacity = 0.75, .dashes = {5, 4}};
}

void draw_path(Canvas& canvas, const PathRecorder& path, const Projection& projection) {
  Stroke rapids;
  for_each_piece(path, projection, [&](const PathRecorder::Vertex& vertex, Spot from, Spot to) {
    if (vertex.kind == Kind::rapid) rapids.piece(canvas, rapid_pen(), from, to);
  });
  rapids.flush(canvas, rapid_pen());

  const SpeedColours colours(path.fastest_feed());
  const double width = feed_width(path, projection);
  const auto pen = [&](std::size_t index) {
    return Pen{.colour = SpeedColours::of_class(index), .width = width, .opacity = 1};
  };
  std::vector<Stroke> feeds(SpeedColours::classes);
  std::vector<Stroke> dots(SpeedColours::classes);
  for_each_piece(path, projection, [&](const PathRecorder::Vertex& vertex, Spot from, Spot to) {
    if (vertex.kind != Kind::feed) return;
    const std::size_t index = colours.class_of(double{vertex.speed});
    if (from.x == to.x && from.y == to.y) {
      dots[index].piece(canvas, dot_pen(pen(index)), from, to);
    } else {
      feeds[index].piece(canvas, pen(index), from, to);
    }
  });
  for (std::size_t index = 0; index < feeds.size(); ++index) {
    feeds[index].flush(canvas, pen(index));
    dots[index].flush(canvas, dot_pen(pen(index)));
  }
}

}  // namespace passo
