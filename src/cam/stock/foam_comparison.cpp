#include "passo/stock/foam_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace passo {
namespace {

// A line of the body's section. It goes up or down in Y as the body's surface is turned.
struct SectionLine {
  Vector3 from;
  Vector3 to;
};

// The section of a body at a place along the wire.
class Section {
 public:
  Section(const FoamBlock& foam, const std::vector<BodyTriangle>& body, std::size_t slice) : foam_(foam) {
    // A face of the block is mostly a face of the body, and has no section: it is taken a hair inside.
    constexpr double hair = 1e-4;
    const double z = std::clamp(foam.z_of(slice), foam.block().low.z + hair, foam.block().high.z - hair);
    bins_.resize(foam.rows() / bin_rows + 1);
    for (const BodyTriangle& triangle : body) add(triangle, z);
  }

  // Sets `inside` for the cells of the slice.
  void mark(FoamDifference::Cell* cells, FoamDifference::Cell inside) const {
    struct Crossing {
      double x = 0;
      int turns = 0;
    };
    std::vector<std::vector<Crossing>> rows(foam_.rows());
    for (const SectionLine& line : lines_) {
      const auto [low, high] = std::minmax(line.from.y, line.to.y);
      for (std::size_t row = row_after(low); row < foam_.rows() && foam_.y_of(row) < high; ++row) {
        const double y = foam_.y_of(row);
        if (y < low) continue;
        const double share = (y - line.from.y) / (line.to.y - line.from.y);
        rows[row].push_back({line.from.x + (line.to.x - line.from.x) * share, line.to.y > line.from.y ? 1 : -1});
      }
    }
    for (std::size_t row = 0; row < rows.size(); ++row) {
      std::vector<Crossing>& crossings = rows[row];
      std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) { return a.x < b.x; });
      int turns = 0;
      std::size_t next = 0;
      for (std::size_t column = 0; column < foam_.columns(); ++column) {
        for (; next < crossings.size() && crossings[next].x <= foam_.x_of(column); ++next)
          turns += crossings[next].turns;
        if (turns != 0) cells[row * foam_.columns() + column] = inside;
      }
    }
  }

  // From the body's surface. Infinite, if there is no section.
  double distance(std::size_t column, std::size_t row) const {
    const Vector3 place{foam_.x_of(column), foam_.y_of(row), 0};
    const auto home = static_cast<std::ptrdiff_t>(row / bin_rows);
    const auto bins = static_cast<std::ptrdiff_t>(bins_.size());
    double nearest = std::numeric_limits<double>::infinity();
    for (std::ptrdiff_t away = 0; away < bins; ++away) {
      // Lines of a bin so far away are at least this far.
      if (nearest < static_cast<double>((away - 1) * bin_rows) * foam_.cell()) break;
      for (const std::ptrdiff_t bin : {home - away, home + away}) {
        if (bin < 0 || bin >= bins) continue;
        for (const std::size_t line : bins_[static_cast<std::size_t>(bin)]) {
          nearest = std::min(nearest, length(nearest_of(lines_[line].from, lines_[line].to, place) - place));
        }
        if (away == 0) break;
      }
    }
    return nearest;
  }

 private:
  static constexpr std::ptrdiff_t bin_rows = 16;

  std::size_t row_after(double y) const {
    const double row = std::ceil((y - foam_.block().low.y) / foam_.cell() - 0.5);
    return static_cast<std::size_t>(std::clamp(row, 0.0, static_cast<double>(foam_.rows())));
  }

  void add(const BodyTriangle& triangle, double z) {
    // A corner in the plane counts as below it.
    Vector3 up{};
    Vector3 down{};
    int found = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3& a = triangle[i];
      const Vector3& b = triangle[(i + 1) % 3];
      if ((a.z > z) == (b.z > z)) continue;
      // Of an edge both triangles find the same place.
      const Vector3& low = a.z > z ? b : a;
      const Vector3& high = a.z > z ? a : b;
      Vector3 at = low + (high - low) * ((z - low.z) / (high.z - low.z));
      at.z = 0;
      (b.z > z ? up : down) = at;
      ++found;
    }
    if (found != 2 || up == down) return;
    const std::size_t line = lines_.size();
    lines_.push_back({up, down});
    const auto [low, high] = std::minmax(up.y, down.y);
    const auto last = std::min(row_after(high), foam_.rows() - 1) / bin_rows;
    for (std::size_t bin = std::min(row_after(low), foam_.rows() - 1) / bin_rows; bin <= last; ++bin) {
      bins_[bin].push_back(line);
    }
  }

  const FoamBlock& foam_;
  std::vector<SectionLine> lines_;
  std::vector<std::vector<std::size_t>> bins_;  // the lines that come near so many rows
};

// Which pieces are the part.
std::vector<bool> parts_of(const FoamBlock& foam, const FoamPieces& pieces,
                           const std::vector<FoamDifference::Cell>& marks) {
  std::vector<std::uint64_t> shared(pieces.pieces.size());
  std::uint64_t body = 0;
  std::size_t cell = 0;
  for (std::size_t slice = 0; slice < foam.slices(); ++slice) {
    for (std::size_t i = 0; i < foam.columns() * foam.rows(); ++i, ++cell) {
      if (marks[cell] != FoamDifference::Cell::even) continue;
      body += foam.weight(slice);
      if (pieces.of[cell] != FoamPieces::none) shared[pieces.of[cell]] += foam.weight(slice);
    }
  }
  std::vector<bool> parts(shared.size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i] = 2 * shared[i] > pieces.pieces[i].cells || (shared[i] > 0 && 100 * shared[i] >= body);
  }
  return parts;
}

}  // namespace

FoamDifference compare_foam(const FoamBlock& foam, const FoamPieces& pieces, const std::vector<BodyTriangle>& body,
                            Mm tolerance) {
  using Cell = FoamDifference::Cell;
  FoamDifference difference;
  const std::size_t a_slice = foam.columns() * foam.rows();
  difference.of.assign(a_slice * foam.slices(), Cell::beside);
  for (std::size_t slice = 0; slice < foam.slices(); ++slice) {
    Section(foam, body, slice).mark(difference.of.data() + slice * a_slice, Cell::even);
  }
  const std::vector<bool> is_part = parts_of(foam, pieces, difference.of);
  for (std::size_t slice = 0; slice < foam.slices(); ++slice) {
    const Section section(foam, body, slice);
    for (std::size_t row = 0; row < foam.rows(); ++row) {
      for (std::size_t column = 0; column < foam.columns(); ++column) {
        const std::size_t number = slice * a_slice + row * foam.columns() + column;
        const bool in_body = difference.of[number] == Cell::even;
        const bool in_part = pieces.of[number] != FoamPieces::none && is_part[pieces.of[number]];
        const bool is_melted = pieces.of[number] == FoamPieces::none;
        if (in_body ? !is_melted : !in_part) continue;
        const double away = section.distance(column, row);
        if (!in_body) difference.of[number] = Cell::even;
        if (!(away > tolerance.value())) continue;
        FieldDifference::Side& side = in_body ? difference.sides.gouge : difference.sides.left;
        difference.of[number] = in_body ? Cell::gouge : Cell::left;
        side.volume += foam.volume_of_cell() * foam.weight(slice);
        ++side.cells;
        if (std::isfinite(away) && away > side.largest) {
          side.largest = away;
          side.place = {foam.x_of(column), foam.y_of(row), foam.z_of(slice)};
        }
      }
    }
  }
  return difference;
}

}  // namespace passo
