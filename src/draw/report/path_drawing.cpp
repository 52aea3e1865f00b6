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

struct Piece {
  const PathRecorder::Vertex& end;
  Spot from;
  Spot to;
  double from_z;  // relative to the base of the path, like the vertex
};

template <class Visit>
void for_each_piece(const PathRecorder& path, const Projection& projection, const Visit& visit) {
  const Point& base = path.base();
  Spot from;
  double from_z = 0;
  for (const PathRecorder::Vertex& vertex : path.vertices()) {
    const Spot to = projection.spot(base[Axis::x] + double{vertex.x}, base[Axis::y] + double{vertex.y},
                                    base[Axis::z] + double{vertex.z});
    if (vertex.kind != Kind::jump) visit(Piece{vertex, from, to, from_z});
    from = to;
    from_z = double{vertex.z};
  }
}

// The width that leaves about half of the paper white between neighbouring lines.
double feed_width(const PathRecorder& path, const Projection& projection) {
  double length = 0;
  Spot low{1e9, 1e9};
  Spot high{-1e9, -1e9};
  for_each_piece(path, projection, [&](const Piece& piece) {
    if (piece.end.kind != Kind::feed) return;
    length += distance(piece.from, piece.to);
    low = {std::min(low.x, piece.to.x), std::min(low.y, piece.to.y)};
    high = {std::max(high.x, piece.to.x), std::max(high.y, piece.to.y)};
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

void draw_path(Canvas& canvas, const PathRecorder& path, const Projection& projection, const PathColours& colours,
               bool shows_rapids) {
  Stroke rapids;
  for_each_piece(path, projection, [&](const Piece& piece) {
    if (piece.end.kind == Kind::rapid && shows_rapids) rapids.piece(canvas, rapid_pen(), piece.from, piece.to);
  });
  rapids.flush(canvas, rapid_pen());

  const double width = feed_width(path, projection);
  const auto pen = [&](std::size_t index) {
    return Pen{.colour = colours.of_class(index), .width = width, .opacity = 1};
  };
  std::vector<Stroke> feeds(colours.classes());
  std::vector<Stroke> dots(colours.classes());
  for_each_piece(path, projection, [&](const Piece& piece) {
    if (piece.end.kind != Kind::feed) return;
    const int parts = colours.parts_between(piece.from_z, double{piece.end.z});
    for (int part = 0; part < parts; ++part) {
      const auto place = [&](int index) {
        const double share = static_cast<double>(index) / parts;
        return index == parts ? piece.to
                              : Spot{piece.from.x + share * (piece.to.x - piece.from.x),
                                     piece.from.y + share * (piece.to.y - piece.from.y)};
      };
      const double z = piece.from_z + (part + 0.5) / parts * (double{piece.end.z} - piece.from_z);
      const std::size_t index = colours.class_of(piece.end, z);
      const bool is_dot = piece.from.x == piece.to.x && piece.from.y == piece.to.y;
      if (is_dot) {
        dots[index].piece(canvas, dot_pen(pen(index)), piece.from, piece.to);
      } else {
        feeds[index].piece(canvas, pen(index), part == 0 ? piece.from : place(part), place(part + 1));
      }
    }
  });
  for (std::size_t index = 0; index < feeds.size(); ++index) {
    feeds[index].flush(canvas, pen(index));
    dots[index].flush(canvas, dot_pen(pen(index)));
  }
}

}  // namespace passo
