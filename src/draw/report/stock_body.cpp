#include "passo/report/stock_body.hpp"

#include <algorithm>
#include <vector>

#include "triangle_writer.hpp"

namespace passo {
namespace {

constexpr std::size_t wall_parts = WallHeights::parts;

// The corners of the body: those of a coarser or equal grid, with the stock's edges around it. A square of this grid
// that a wall crosses has points between its corners.
class Lattice {
 public:
  Lattice(const HeightField& field, std::size_t step, const WallHeights& walls) : field_(field), walls_(walls) {
    columns_ = places(field.columns(), step);
    rows_ = places(field.rows(), step);
    for (const std::size_t column : columns_) x_.push_back(static_cast<float>(field.x_of(column)));
    for (const std::size_t row : rows_) y_.push_back(static_cast<float>(field.y_of(row)));
    x_.front() = static_cast<float>(field.block().low.x);
    y_.front() = static_cast<float>(field.block().low.y);
    x_.back() = static_cast<float>(field.block().low.x + static_cast<double>(field.columns()) * field.cell());
    y_.back() = static_cast<float>(field.block().low.y + static_cast<double>(field.rows()) * field.cell());
  }

  std::size_t across() const { return x_.size(); }
  std::size_t up() const { return y_.size(); }
  Corner top(std::size_t i, std::size_t j) const {
    return {x_[i], y_[j], static_cast<float>(field_.height(columns_[i], rows_[j]))};
  }
  Corner below(const Corner& top) const { return {top[0], top[1], static_cast<float>(field_.bottom())}; }
  // Whether face and bottom meet: the stock is cut through.
  bool is_low(const Corner& top) const { return top[2] <= static_cast<float>(field_.bottom()); }
  bool any_low() const {
    for (std::size_t j = 0; j < up(); ++j) {
      for (std::size_t i = 0; i < across(); ++i) {
        if (is_low(top(i, j)) || (is_wall(i, j) && any_point_low(i, j))) return true;
      }
    }
    return false;
  }
  Corner bottom_middle() const {
    return {(x_.front() + x_.back()) / 2, (y_.front() + y_.back()) / 2, static_cast<float>(field_.bottom())};
  }

  // Whether a wall crosses the square between (i, j) and (i + 1, j + 1). Those at the edges have no points.
  bool is_wall(std::size_t i, std::size_t j) const { return i > 0 && j > 0 && walls_.crosses(i - 1, j - 1); }
  // A point of such a square. On a side that two of them share, the point is that of the later one.
  Corner point(std::size_t i, std::size_t j, std::size_t k, std::size_t l) const {
    const bool is_corner = k % wall_parts == 0 && l % wall_parts == 0;
    if (is_corner) return top(i + k / wall_parts, j + l / wall_parts);
    if (k == wall_parts && is_wall(i + 1, j)) return point(i + 1, j, 0, l);
    if (l == wall_parts && is_wall(i, j + 1)) return point(i, j + 1, k, 0);
    const auto share = [](std::size_t n) { return static_cast<float>(n) / static_cast<float>(wall_parts); };
    const auto between = [&](const std::vector<float>& at, std::size_t n, std::size_t part) {
      return part == wall_parts ? at[n + 1] : at[n] + (at[n + 1] - at[n]) * share(part);
    };
    return {between(x_, i, k), between(y_, j, l), static_cast<float>(walls_.height(i - 1, j - 1, k, l))};
  }
  bool is_beside_wall(std::size_t i, std::size_t j) const {
    return is_wall(i + 1, j) || is_wall(i, j + 1) || (i > 0 && is_wall(i - 1, j)) || (j > 0 && is_wall(i, j - 1));
  }
  // The outline of a square without a wall, counterclockwise: its corners, and the points of its neighbours.
  std::vector<Corner> outline(std::size_t i, std::size_t j) const;

 private:
  // The first cell stands for the edge too, and so does the last.
  static std::vector<std::size_t> places(std::size_t cells, std::size_t step) {
    std::vector<std::size_t> all = {0};
    for (std::size_t cell = WallHeights::first_place(cells, step); cell < cells; cell += step) all.push_back(cell);
    all.push_back(cells - 1);
    return all;
  }

  bool any_point_low(std::size_t i, std::size_t j) const {
    for (std::size_t n = 0; n < (wall_parts + 1) * (wall_parts + 1); ++n) {
      if (is_low(point(i, j, n % (wall_parts + 1), n / (wall_parts + 1)))) return true;
    }
    return false;
  }

  const HeightField& field_;
  const WallHeights& walls_;
  std::vector<std::size_t> columns_;
  std::vector<std::size_t> rows_;
  std::vector<float> x_;
  std::vector<float> y_;
};

std::vector<Corner> Lattice::outline(std::size_t i, std::size_t j) const {
  std::vector<Corner> corners;
  const auto add = [&](bool has_points, const Corner& corner, const auto& point_at) {
    corners.push_back(corner);
    for (std::size_t n = 1; has_points && n < wall_parts; ++n) corners.push_back(point_at(n));
  };
  add(j > 0 && is_wall(i, j - 1), top(i, j), [&](std::size_t n) { return point(i, j - 1, n, wall_parts); });
  add(is_wall(i + 1, j), top(i + 1, j), [&](std::size_t n) { return point(i + 1, j, 0, n); });
  add(is_wall(i, j + 1), top(i + 1, j + 1), [&](std::size_t n) { return point(i, j + 1, wall_parts - n, 0); });
  add(i > 0 && is_wall(i - 1, j), top(i, j + 1),
      [&](std::size_t n) { return point(i - 1, j, wall_parts, wall_parts - n); });
  return corners;
}

// Writes the face and the bottom. Corners in the order that looks counterclockwise from outside.
class BodyWriter {
 public:
  BodyWriter(const Lattice& lattice, TriangleWriter& out)
      : lattice_(lattice), out_(out), is_cut_through_(lattice.any_low()), middle_(lattice.bottom_middle()) {}

  void add_square(std::size_t i, std::size_t j) {
    if (lattice_.is_wall(i, j)) return add_wall(i, j);
    const Corner low = lattice_.top(i, j);
    const Corner high = lattice_.top(i + 1, j + 1);
    if (!lattice_.is_beside_wall(i, j)) {
      add_piece(low, lattice_.top(i + 1, j), high);
      add_piece(low, high, lattice_.top(i, j + 1));
      return;
    }
    Corner middle = low;
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] = (low[axis] + high[axis]) / 2;
    const std::vector<Corner> corners = lattice_.outline(i, j);
    for (std::size_t n = 0; n < corners.size(); ++n) add_piece(middle, corners[n], corners[(n + 1) % corners.size()]);
  }
  // A side of the stock.
  void add_side(const Corner& a, const Corner& b) {
    if (lattice_.is_low(a) && lattice_.is_low(b)) return;
    out_.square(lattice_.below(a), lattice_.below(b), b, a);
    if (!is_cut_through_) out_.add(lattice_.below(b), lattice_.below(a), middle_);
  }

 private:
  // A piece of the face, and the piece of the bottom below it.
  void add_piece(const Corner& a, const Corner& b, const Corner& c) {
    if (lattice_.is_low(a) && lattice_.is_low(b) && lattice_.is_low(c)) return;
    out_.add(a, b, c);
    if (is_cut_through_) out_.add(lattice_.below(a), lattice_.below(c), lattice_.below(b));
  }
  void add_wall(std::size_t i, std::size_t j) {
    for (std::size_t l = 0; l < wall_parts; ++l) {
      for (std::size_t k = 0; k < wall_parts; ++k) {
        const Corner low = lattice_.point(i, j, k, l);
        const Corner high = lattice_.point(i, j, k + 1, l + 1);
        add_piece(low, lattice_.point(i, j, k + 1, l), high);
        add_piece(low, high, lattice_.point(i, j, k, l + 1));
      }
    }
  }

  const Lattice& lattice_;
  TriangleWriter& out_;
  // Where the stock is cut through nowhere, the bottom is a fan. Otherwise it has the pieces of the face.
  bool is_cut_through_;
  Corner middle_;
};

void write_body(const Lattice& lattice, TriangleWriter& out) {
  BodyWriter body(lattice, out);
  const std::size_t last_i = lattice.across() - 1;
  const std::size_t last_j = lattice.up() - 1;
  for (std::size_t j = 0; j < last_j; ++j) {
    for (std::size_t i = 0; i < last_i; ++i) body.add_square(i, j);
  }
  for (std::size_t i = 0; i < last_i; ++i) {
    body.add_side(lattice.top(i, 0), lattice.top(i + 1, 0));
    body.add_side(lattice.top(i + 1, last_j), lattice.top(i, last_j));
  }
  for (std::size_t j = 0; j < last_j; ++j) {
    body.add_side(lattice.top(last_i, j), lattice.top(last_i, j + 1));
    body.add_side(lattice.top(0, j + 1), lattice.top(0, j));
  }
}

}  // namespace

std::size_t usual_body_step(const HeightField& field) {
  constexpr std::size_t most_cells = 1'000'000;
  std::size_t step = 1;
  while (field.columns() / step * (field.rows() / step) > most_cells) ++step;
  return step;
}

std::uint64_t write_stock_body(const HeightField& field, std::size_t step, const WallHeights& walls, OutputFile& file) {
  const Lattice lattice(field, std::max<std::size_t>(1, step), walls);
  return write_triangles("passo simulate: the stock after the cut, mm", file,
                         [&](TriangleWriter& out) { write_body(lattice, out); });
}

}  // namespace passo
