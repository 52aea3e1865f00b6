// Pieces of the stock that the cuts separate from the rest: islands of scrap between the slots of neighbouring copies,
// and parts without tabs. Nothing holds them while the cutter still runs.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "passo/cam/mill_plan.hpp"
#include "passo/cam/region.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/stock/height_field.hpp"

namespace passo {

struct LoosePiece {
  DrawnBox box = {};
  double area_mm2 = 0;
  bool is_part = false;
};

// The plan's cuts at `depth` go through the sheet. `parts`: their areas on it. The largest piece at the edge of the
// sheet is the rest; the others are returned, the largest first.
std::vector<LoosePiece> pieces_cut_free(const MillPlan& plan, Nanometres depth, const DrawnBox& sheet,
                                        const Region& parts);
// The same in the stock that is left.
std::vector<LoosePiece> pieces_cut_free(const HeightField& field, const Region& parts);

// "3 pieces of scrap come loose, the largest of 12.5 x 9 mm at X31.2 Y80.4". `sheet`: its number, if there are several,
// or else 0.
std::string describe(const std::vector<LoosePiece>& pieces, std::size_t sheet);
nlohmann::ordered_json loose_json(const std::vector<LoosePiece>& pieces);

}  // namespace passo
