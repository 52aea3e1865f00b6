#include "passo/report/stock_body.hpp"

#include <algorithm>
#include <vector>

#include "triangle_writer.hpp"

namespace passo {
namespace {

// The corners of the body: those of a coarser or equal grid, with the stock's edges around it.
class Lattice {
 public:
  Lattice(const HeightField& field, std::size_t step) : field_(field) {
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
  Corner bottom(std::size_t i, std::size_t j) const { return {x_[i], y_[j], static_cast<float>(field_.bottom())}; }
  // Whether face and bottom meet: the stock is cut through.
  bool is_low(std::size_t i, std::size_t j) const { return top(i, j)[2] <= bottom(i, j)[2]; }
  bool any_low() const {
    for (std::size_t j = 0; j < up(); ++j) {
      for (std::size_t i = 0; i < across(); ++i) {
        if (is_low(i, j)) return true;
      }
    }
    return false;
  }
  Corner bottom_middle() const {
    return {(x_.front() + x_.back()) / 2, (y_.front() + y_.back()) / 2, static_cast<float>(field_.bottom())};
  }

 private:
  // The first cell stands for the edge too, and so does the last.
  static std::vector<std::size_t> places(std::size_t cells, std::size_t step) {
    std::vector<std::size_t> all = {0};
    for (std::size_t cell = std::min(step / 2, cells - 1); cell < cells; cell += step) all.push_back(cell);
    all.push_back(cells - 1);
    return all;
  }

  const HeightField& field_;
  std::vector<std::size_t> columns_;
  std::vector<std::size_t> rows_;
  std::vector<float> x_;
  std::vector<float> y_;
};

struct LatticePlace {
  std::size_t i = 0;
  std::size_t j = 0;
};

// Corners in the order that looks counterclockwise from outside.
void write_body(const Lattice& lattice, TriangleWriter& out) {
  // Where the stock is cut through nowhere, the bottom is a fan. Otherwise it has the pieces of the face.
  const bool is_cut_through = lattice.any_low();
  // A piece of the face, and the piece of the bottom below it.
  const auto piece = [&](const LatticePlace& a, const LatticePlace& b, const LatticePlace& c) {
    if (lattice.is_low(a.i, a.j) && lattice.is_low(b.i, b.j) && lattice.is_low(c.i, c.j)) return;
    out.add(lattice.top(a.i, a.j), lattice.top(b.i, b.j), lattice.top(c.i, c.j));
    if (is_cut_through) out.add(lattice.bottom(a.i, a.j), lattice.bottom(c.i, c.j), lattice.bottom(b.i, b.j));
  };
  const Corner middle = lattice.bottom_middle();
  const auto wall = [&](const LatticePlace& a, const LatticePlace& b) {
    if (lattice.is_low(a.i, a.j) && lattice.is_low(b.i, b.j)) return;
    out.square(lattice.bottom(a.i, a.j), lattice.bottom(b.i, b.j), lattice.top(b.i, b.j), lattice.top(a.i, a.j));
    if (!is_cut_through) out.add(lattice.bottom(b.i, b.j), lattice.bottom(a.i, a.j), middle);
  };
  const std::size_t last_i = lattice.across() - 1;
  const std::size_t last_j = lattice.up() - 1;
  for (std::size_t j = 0; j < last_j; ++j) {
    for (std::size_t i = 0; i < last_i; ++i) {
      piece({i, j}, {i + 1, j}, {i + 1, j + 1});
      piece({i, j}, {i + 1, j + 1}, {i, j + 1});
    }
  }
  for (std::size_t i = 0; i < last_i; ++i) {
    wall({i, 0}, {i + 1, 0});
    wall({i + 1, last_j}, {i, last_j});
  }
  for (std::size_t j = 0; j < last_j; ++j) {
    wall({last_i, j}, {last_i, j + 1});
    wall({0, j + 1}, {0, j});
  }
}

}  // namespace

std::size_t usual_body_step(const HeightField& field) {
  constexpr std::size_t most_cells = 1'000'000;
  std::size_t step = 1;
  while (field.columns() / step * (field.rows() / step) > most_cells) ++step;
  return step;
}

std::uint64_t write_stock_body(const HeightField& field, std::size_t step, OutputFile& file) {
  const Lattice lattice(field, std::max<std::size_t>(1, step));
  return write_triangles("passo simulate: the stock after the cut, mm", file,
                         [&](TriangleWriter& out) { write_body(lattice, out); });
}

}  // namespace passo
