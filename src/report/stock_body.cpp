#include "passo/report/stock_body.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

namespace passo {
namespace {

using Corner = std::array<float, 3>;

// Numbers as the file has them, the lowest byte first.
template <class Number>
void append(std::string& bytes, Number number) {
  static_assert(std::endian::native == std::endian::little);
  char raw[sizeof number];  // NOLINT
  std::memcpy(raw, &number, sizeof number);
  bytes.append(raw, sizeof number);
}

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

class TriangleWriter {
 public:
  // Without a file the triangles are only counted.
  explicit TriangleWriter(OutputFile* file) : file_(file) {}

  void add(const Corner& a, const Corner& b, const Corner& c) {
    ++count_;
    if (file_ == nullptr) return;
    for (const float part : normal_of(a, b, c)) append(bytes_, part);
    for (const Corner* corner : {&a, &b, &c}) {
      for (const float part : *corner) append(bytes_, part);
    }
    append(bytes_, std::uint16_t{0});
    constexpr std::size_t written_at_once = 1 << 16;
    if (bytes_.size() >= written_at_once) flush();
  }
  void square(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
    add(a, b, c);
    add(a, c, d);
  }
  void flush() {
    if (file_ != nullptr) file_->write(bytes_);
    bytes_.clear();
  }
  std::uint64_t count() const { return count_; }

 private:
  static Corner normal_of(const Corner& a, const Corner& b, const Corner& c) {
    const Corner u = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const Corner v = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    Corner n = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const float size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (float& part : n) part = size > 0 ? part / size : 0;
    return n;
  }

  OutputFile* file_;
  std::string bytes_;
  std::uint64_t count_ = 0;
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
  TriangleWriter counter(nullptr);
  write_body(lattice, counter);
  constexpr std::size_t head_size = 80;
  std::string head = "passo simulate: the stock after the cut, mm";
  head.resize(head_size, ' ');
  append(head, static_cast<std::uint32_t>(counter.count()));
  file.write(head);
  TriangleWriter writer(&file);
  write_body(lattice, writer);
  writer.flush();
  return counter.count();
}

}  // namespace passo
