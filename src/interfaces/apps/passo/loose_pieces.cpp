#include "loose_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/cam/edge_loops.hpp"

namespace passo {
namespace {

// Less is a chip.
constexpr double least_piece_mm2 = 1;

bool is_at_edge(const DrawnBox& box, const DrawnBox& sheet) {
  constexpr Nanometres rounding{1'000};
  return box.least.x <= sheet.least.x + rounding || box.least.y <= sheet.least.y + rounding ||
         box.most.x + rounding >= sheet.most.x || box.most.y + rounding >= sheet.most.y;
}

// Without the rest of the sheet.
std::vector<LoosePiece> without_rest(std::vector<LoosePiece> pieces, const DrawnBox& sheet) {
  std::ranges::stable_sort(pieces, std::greater<>(), &LoosePiece::area_mm2);
  const auto rest = std::ranges::find_if(pieces, [&](const LoosePiece& piece) { return is_at_edge(piece.box, sheet); });
  if (rest != pieces.end()) pieces.erase(rest);
  std::erase_if(pieces, [](const LoosePiece& piece) { return piece.area_mm2 < least_piece_mm2; });
  return pieces;
}

// The ways of the cutter's centre at full depth.
std::vector<DrawnRing> ways_through(const MillTool& tool, Nanometres depth) {
  constexpr std::int64_t rounding = 1'000;
  std::vector<DrawnRing> ways;
  const auto is_deep = [&](const MillPoint& point) { return point.z.count <= depth.count + rounding; };
  for (const MillRun& run : tool.runs) {
    for (std::size_t i = 0; i + 1 < run.size(); ++i) {
      if (!is_deep(run[i]) || !is_deep(run[i + 1])) continue;
      const DrawnRing chords = chords_of_path({{run[i].at, run[i].bulge}, {run[i + 1].at, 0}}, false, {10'000});
      const bool goes_on = !ways.empty() && ways.back().back() == chords.front();
      if (!goes_on) ways.emplace_back();
      ways.back().insert(ways.back().end(), chords.begin() + (goes_on ? 1 : 0), chords.end());
    }
  }
  return ways;
}

// The cells of a field that hang together.
class FieldPieces {
 public:
  explicit FieldPieces(const HeightField& field)
      : field_(field), seen_(field.columns() * field.rows(), false), low_(field.bottom() - field.top() + 0.01) {}

  std::vector<LoosePiece> pieces(const Region& parts) {
    std::vector<LoosePiece> all;
    for (std::size_t cell = 0; cell < seen_.size(); ++cell) {
      if (!seen_[cell] && is_solid(cell)) all.push_back(piece_at(cell, parts));
    }
    return all;
  }

 private:
  bool is_solid(std::size_t cell) const {
    return static_cast<double>(field_.below_top(cell / field_.columns())[cell % field_.columns()]) > low_;
  }
  DrawnPoint middle(std::size_t cell) const {
    return {to_nanometres(Mm(field_.x_of(cell % field_.columns()))),
            to_nanometres(Mm(field_.y_of(cell / field_.columns())))};
  }
  LoosePiece piece_at(std::size_t first, const Region& parts);

  const HeightField& field_;
  std::vector<bool> seen_;
  double low_;  // the height of a cell that is cut through, from the top
  std::vector<std::size_t> open_;
};

LoosePiece FieldPieces::piece_at(std::size_t first, const Region& parts) {
  constexpr std::size_t between_samples = 97;
  LoosePiece piece{.box = {middle(first), middle(first)}};
  std::size_t count = 0;
  std::size_t sampled = 0;
  std::size_t in_parts = 0;
  const auto visit = [&](bool is_there, std::size_t cell) {
    if (!is_there || seen_[cell] || !is_solid(cell)) return;
    seen_[cell] = true;
    open_.push_back(cell);
  };
  visit(true, first);
  while (!open_.empty()) {
    const std::size_t cell = open_.back();
    open_.pop_back();
    const DrawnPoint at = middle(cell);
    piece.box.least = {std::min(piece.box.least.x, at.x), std::min(piece.box.least.y, at.y)};
    piece.box.most = {std::max(piece.box.most.x, at.x), std::max(piece.box.most.y, at.y)};
    if (count++ % between_samples == 0 && sampled < 500) {
      ++sampled;
      in_parts += contains(parts, at) ? 1 : 0;
    }
    const std::size_t across = field_.columns();
    visit(cell % across > 0, cell - 1);
    visit(cell % across + 1 < across, cell + 1);
    visit(cell >= across, cell - across);
    visit(cell + across < seen_.size(), cell + across);
  }
  const Nanometres half = to_nanometres(Mm(field_.cell() / 2));
  piece.box = {{piece.box.least.x - half, piece.box.least.y - half},
               {piece.box.most.x + half, piece.box.most.y + half}};
  piece.area_mm2 = static_cast<double>(count) * field_.cell() * field_.cell();
  piece.is_part = 2 * in_parts > sampled;
  return piece;
}

double rounded_mm(Nanometres length) {
  return std::round(to_mm(length).value() * 10) / 10 + 0.0;
}

}  // namespace

std::vector<LoosePiece> pieces_cut_free(const MillPlan& plan, Nanometres depth, const DrawnBox& sheet,
                                        const Region& parts) {
  std::vector<Region> slots;
  for (const MillTool& tool : plan.tools) {
    slots.push_back(swept(ways_through(tool, depth), {tool.width.count / 2}, {10'000}));
  }
  std::vector<LoosePiece> pieces;
  for (const Region& piece : parts_of(subtracted(filled({rectangle(sheet)}), united(slots)))) {
    const double area = area_mm2(piece);
    if (area < least_piece_mm2) continue;
    pieces.push_back({box_of(piece.rings.front()), area, 2 * area_mm2(common(piece, parts)) > area});
  }
  return without_rest(std::move(pieces), sheet);
}

std::vector<LoosePiece> pieces_cut_free(const HeightField& field, const Region& parts) {
  const StockBlock& block = field.block();
  const DrawnBox sheet{{to_nanometres(Mm(block.low.x)), to_nanometres(Mm(block.low.y))},
                       {to_nanometres(Mm(block.high.x)), to_nanometres(Mm(block.high.y))}};
  return without_rest(FieldPieces(field).pieces(parts), sheet);
}

std::string describe(const std::vector<LoosePiece>& pieces, std::size_t sheet) {
  const auto parts = static_cast<std::size_t>(std::ranges::count_if(pieces, &LoosePiece::is_part));
  const std::size_t scrap = pieces.size() - parts;
  std::string what = parts > 0 ? counted(parts, "part") : "";
  if (scrap > 0) {
    what += fmt::format("{}{} of scrap", what.empty() ? "" : " and ", counted(scrap, "piece"));
  }
  const DrawnBox& box = pieces.front().box;
  const bool is_one = pieces.size() == 1;
  return fmt::format("{} {} loose, {}{:g} x {:g} mm at X{:g} Y{:g}{}", what, is_one ? "comes" : "come",
                     is_one ? "" : "the largest of ", rounded_mm(box.most.x - box.least.x),
                     rounded_mm(box.most.y - box.least.y), rounded_mm(box.least.x), rounded_mm(box.least.y),
                     sheet > 0 ? fmt::format(" of sheet {}", sheet) : "");
}

nlohmann::ordered_json loose_json(const std::vector<LoosePiece>& pieces) {
  constexpr std::size_t most = 100;
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const LoosePiece& piece : pieces) {
    if (all.size() == most) break;
    all.push_back({{"part", piece.is_part},
                   {"x_mm", rounded_mm(piece.box.least.x)},
                   {"y_mm", rounded_mm(piece.box.least.y)},
                   {"width_mm", rounded_mm(piece.box.most.x - piece.box.least.x)},
                   {"length_mm", rounded_mm(piece.box.most.y - piece.box.least.y)},
                   {"area_mm2", std::round(piece.area_mm2 * 10) / 10}});
  }
  return all;
}

}  // namespace passo
