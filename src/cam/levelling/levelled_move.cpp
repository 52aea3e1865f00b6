#include "passo/levelling/levelled_move.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace passo {
namespace {

// Of a move: closer ends of pieces are one.
constexpr double same_part = 1e-12;
// No move is divided into more pieces between two lines of the grid.
constexpr double most_pieces = 1e6;

// A place along a move, as a part of it, and the height there.
struct Vertex {
  double part = 0;
  double z = 0;
};

// Leaves vertices out while the rest, joined in proportion, passes all vertices within `tolerance`. The ends stay.
// Each vertex narrows the slopes that a piece may have from its beginning on.
std::vector<Vertex> joined(const std::vector<Vertex>& vertices, double tolerance) {
  constexpr double endless = std::numeric_limits<double>::infinity();
  std::vector<Vertex> kept{vertices.front()};
  for (std::size_t from = 0; from + 1 < vertices.size();) {
    double low = -endless;
    double high = endless;
    std::size_t to = from + 1;
    for (std::size_t i = from + 1; i < vertices.size(); ++i) {
      const double part = vertices[i].part - vertices[from].part;
      const double rise = vertices[i].z - vertices[from].z;
      if (rise / part >= low && rise / part <= high) to = i;
      low = std::max(low, (rise - tolerance) / part);
      high = std::min(high, (rise + tolerance) / part);
      if (low > high) break;
    }
    kept.push_back(vertices[to]);
    from = to;
  }
  return kept;
}

// The parts of a move at which it passes from one cell of the map to another, sorted, with the move's ends.
void sort_parts(std::vector<double>& parts) {
  parts.push_back(0);
  parts.push_back(1);
  std::ranges::sort(parts);
  const auto is_same = [](double a, double b) { return b - a < same_part; };
  parts.erase(std::unique(parts.begin(), parts.end(), is_same), parts.end());
  parts.back() = 1;
}

int pieces_for(double wanted) {
  return static_cast<int>(std::clamp(std::ceil(wanted), 1.0, most_pieces));
}

// Divides what is between two parts evenly into pieces.
template <class HeightAt>
void add_vertices(std::vector<Vertex>& vertices, double from, double to, int pieces, const HeightAt& height_at) {
  for (int i = 1; i <= pieces; ++i) {
    const double part = i == pieces ? to : from + (to - from) * i / pieces;
    vertices.push_back({part, height_at(part)});
  }
}

void cut_line(std::vector<double>& parts, const std::vector<double>& lines, double from, double to) {
  if (from == to) return;
  const auto first = std::ranges::upper_bound(lines, std::min(from, to));
  for (auto line = first; line != lines.end() && *line < std::max(from, to); ++line) {
    parts.push_back((*line - from) / (to - from));
  }
}

struct Arc {
  double center_x = 0;
  double center_y = 0;
  double start_radius = 0;
  double end_radius = 0;
  double start_angle = 0;
  double sweep = 0;

  double radius(double part) const { return start_radius + (end_radius - start_radius) * part; }
  double angle(double part) const { return start_angle + sweep * part; }
  double x(double part) const { return center_x + radius(part) * std::cos(angle(part)); }
  double y(double part) const { return center_y + radius(part) * std::sin(angle(part)); }
};

// Where an arc passes a line of the grid. `share`: how far the line is from the centre, in radii; `quarter`: the angle
// of the axis that crosses the lines.
void cut_arc(std::vector<double>& parts, const Arc& arc, double share, double quarter) {
  if (std::abs(share) >= 1) return;
  constexpr double turn = 2 * std::numbers::pi;
  const double half = std::acos(share);
  for (const double angle : {quarter + half, quarter - half}) {
    // The turns from the arc's beginning to this angle, in the arc's direction.
    double way = std::fmod((angle - arc.start_angle) * (arc.sweep > 0 ? 1 : -1), turn);
    if (way < 0) way += turn;
    for (; way < std::abs(arc.sweep); way += turn) parts.push_back(way / std::abs(arc.sweep));
  }
}

void cut_arc(std::vector<double>& parts, const Arc& arc, const HeightMap& map) {
  const double radius = std::max(arc.start_radius, arc.end_radius);
  const auto cut = [&](const std::vector<double>& lines, double center, double quarter) {
    const auto first = std::ranges::lower_bound(lines, center - radius);
    for (auto line = first; line != lines.end() && *line <= center + radius; ++line) {
      cut_arc(parts, arc, (*line - center) / radius, quarter);
    }
  };
  cut(map.columns(), arc.center_x, 0);
  cut(map.rows(), arc.center_y, std::numbers::pi / 2);
}

// A bound of |d²z/dangle²| on an arc within a cell.
double curvature_on(const HeightMap::Cell& cell, const Arc& arc) {
  const double radius = std::max(arc.start_radius, arc.end_radius);
  const double along_x = cell.along_x + cell.twist * (arc.center_y - cell.y0);
  const double along_y = cell.along_y + cell.twist * (arc.center_x - cell.x0);
  return radius * std::hypot(along_x, along_y) + 2 * std::abs(cell.twist) * radius * radius;
}

}  // namespace

std::vector<LevelledPiece> level_line(const HeightMap& map, const LevelPoint& from, const LevelPoint& to,
                                      double tolerance) {
  const double dx = to.x - from.x;
  const double dy = to.y - from.y;
  const auto height_at = [&](double part) {
    return from.z + (to.z - from.z) * part + map.height(from.x + dx * part, from.y + dy * part);
  };
  const LevelledPiece whole{.end = {to.x, to.y, to.z + map.height(to.x, to.y)}};
  if (dx == 0 && dy == 0) return {whole};
  std::vector<double> parts;
  cut_line(parts, map.columns(), from.x, to.x);
  cut_line(parts, map.rows(), from.y, to.y);
  sort_parts(parts);
  std::vector<Vertex> vertices{{0, height_at(0)}};
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    const double middle = (parts[i] + parts[i + 1]) / 2;
    const double bend = std::abs(map.cell_at(from.x + dx * middle, from.y + dy * middle).twist * dx * dy);
    // A chord over a part p of the parabola is bend p² / 4 off, at most.
    const double wanted = (parts[i + 1] - parts[i]) * std::sqrt(bend / (4 * tolerance / 2));
    add_vertices(vertices, parts[i], parts[i + 1], pieces_for(wanted), height_at);
  }
  std::vector<LevelledPiece> pieces;
  for (const Vertex& end : joined(vertices, tolerance / 2)) {
    if (end.part == 0) continue;
    pieces.push_back({.end = {from.x + dx * end.part, from.y + dy * end.part, end.z}, .part = end.part});
  }
  pieces.back() = whole;
  return pieces;
}

std::vector<LevelledPiece> level_arc(const HeightMap& map, const LevelPoint& from, const LevelPoint& to,
                                     double center_x, double center_y, double sweep, double tolerance) {
  const Arc arc{.center_x = center_x,
                .center_y = center_y,
                .start_radius = std::hypot(from.x - center_x, from.y - center_y),
                .end_radius = std::hypot(to.x - center_x, to.y - center_y),
                .start_angle = std::atan2(from.y - center_y, from.x - center_x),
                .sweep = sweep};
  const auto height_at = [&](double part) {
    return from.z + (to.z - from.z) * part + map.height(arc.x(part), arc.y(part));
  };
  std::vector<double> parts;
  cut_arc(parts, arc, map);
  sort_parts(parts);
  std::vector<Vertex> vertices{{0, height_at(0)}};
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    const double middle = (parts[i] + parts[i + 1]) / 2;
    const double bend = curvature_on(map.cell_at(arc.x(middle), arc.y(middle)), arc);
    // A chord over an angle a is bend a² / 8 off, at most.
    const double wanted = (parts[i + 1] - parts[i]) * std::abs(sweep) * std::sqrt(bend / (8 * tolerance / 2));
    add_vertices(vertices, parts[i], parts[i + 1], pieces_for(wanted), height_at);
  }
  std::vector<LevelledPiece> pieces;
  for (const Vertex& end : joined(vertices, tolerance / 2)) {
    if (end.part == 0) continue;
    pieces.push_back({.end = {arc.x(end.part), arc.y(end.part), end.z}, .part = end.part});
  }
  pieces.back() = {.end = {to.x, to.y, to.z + map.height(to.x, to.y)}};
  return pieces;
}

}  // namespace passo
