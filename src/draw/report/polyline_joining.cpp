#include "polyline_joining.hpp"

#include <algorithm>
#include <cmath>

namespace passo {
namespace {

using Vertex = PathRecorder::Vertex;
using Kind = PathRecorder::Kind;

struct Vector {
  double x, y, z;
  double dot(const Vector& other) const { return x * other.x + y * other.y + z * other.z; }
  double length() const { return std::sqrt(dot(*this)); }
};

Vector between(const Vertex& from, const Vertex& to) {
  return {double{to.x} - double{from.x}, double{to.y} - double{from.y}, double{to.z} - double{from.z}};
}

// The distance of `vertex` from the piece from `begin` to `end`.
double distance(const Vertex& vertex, const Vertex& begin, const Vertex& end) {
  const Vector piece = between(begin, end);
  const Vector arm = between(begin, vertex);
  const double square = piece.dot(piece);
  const double share = square > 0 ? std::clamp(arm.dot(piece) / square, 0.0, 1.0) : 0;
  return Vector{arm.x - share * piece.x, arm.y - share * piece.y, arm.z - share * piece.z}.length();
}

// The pieces since the last kept vertex, as one piece.
class Run {
 public:
  Run(const std::vector<Vertex>& vertices, std::size_t anchor, double tolerance, double speed_step)
      : vertices_(vertices), anchor_(anchor), tolerance_(tolerance), speed_step_(speed_step) {}

  bool takes(std::size_t next) const {
    // This limits the work. The next joining can make a longer run.
    constexpr std::size_t longest = 64;
    if (next - anchor_ > longest) return false;
    const Vertex& vertex = vertices_[next];
    if (vertex.tool != vertices_[next - 1].tool || vertex.load != vertices_[next - 1].load) return false;
    const double length = between(vertices_[next - 1], vertex).length();
    if (next > anchor_ + 1 && length > tolerance_ && length_ > tolerance_) {
      if (vertex.kind != kind_) return false;
      if (kind_ == Kind::feed && std::abs(double{vertex.speed} - speed()) > speed_step_) return false;
    }
    for (std::size_t i = anchor_ + 1; i < next; ++i) {
      if (distance(vertices_[i], vertices_[anchor_], vertex) > tolerance_) return false;
    }
    return true;
  }

  void take(std::size_t next) {
    const Vertex& vertex = vertices_[next];
    const double length = between(vertices_[next - 1], vertex).length();
    if (length >= longest_piece_) {
      longest_piece_ = length;
      kind_ = vertex.kind;
    }
    length_ += length;
    if (vertex.speed > 0) time_ += length / double{vertex.speed};
    last_ = next;
  }

  Vertex joined() const {
    Vertex vertex = vertices_[last_];
    vertex.kind = kind_;
    vertex.speed = static_cast<float>(speed());
    return vertex;
  }

 private:
  double speed() const { return time_ > 0 ? length_ / time_ : double{vertices_[last_].speed}; }

  const std::vector<Vertex>& vertices_;
  std::size_t anchor_;
  double tolerance_;
  double speed_step_;
  std::size_t last_ = 0;
  double length_ = 0;
  double time_ = 0;
  double longest_piece_ = 0;
  Kind kind_ = Kind::feed;
};

}  // namespace

void join_pieces(std::vector<Vertex>& vertices, double tolerance, double speed_step) {
  const std::size_t count = vertices.size();
  std::vector<Vertex> joined;
  joined.reserve(vertices.capacity());
  for (std::size_t i = 0; i < count;) {
    if (vertices[i].kind == Kind::jump) {
      joined.push_back(vertices[i++]);
      continue;
    }
    Run run(vertices, i - 1, tolerance, speed_step);
    run.take(i++);
    while (i < count && vertices[i].kind != Kind::jump && run.takes(i)) run.take(i++);
    joined.push_back(run.joined());
  }
  vertices = std::move(joined);
}

}  // namespace passo
