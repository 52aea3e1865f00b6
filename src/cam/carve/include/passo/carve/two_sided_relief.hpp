// split_relief: the surfaces of a part that is carved from both sides of a piece of stock, which is as thick as the
// part.
//
// Seen from above, the stock consists of the part, a trench around it for the cutters, and the frame, which remains.
// The first side, the top, is cut down to the web: a layer of the stock at the parting height, in the trench and in
// openings of the part. The second side, the bottom, cuts through the web, except at the tabs, which hold the part in
// the frame. The parting height is the height at which the web meets the longest part of the edge, so that it hides as
// little of the part as possible.
//
// The edge of an egg is thinner than a tab. The tabs then reach onto the part, to where it is as thick as they are, and
// the web lies below the edge, so that the top can be cut down to it. Below the edge of a pyramid there is no room for
// a web; then both sides cut the trench through, except at the tabs.
//
// Heights are relative to the top of the stock on each side. Both grids have their node (0, 0) at the lower left, as
// seen from above; the bottom is seen after the flip.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "passo/carve/height_grid.hpp"

namespace passo {

// `left_to_right` flips about a line parallel to Y, `front_to_back` about one parallel to X.
enum class StockFlip : std::uint8_t { left_to_right, front_to_back };

struct SplitOptions {
  StockFlip flip = StockFlip::left_to_right;
  Mm trench{10};                   // width
  Mm tab_height{2};                // also the thickness of the web
  Mm tab_width{6};                 // 0: no tabs, and the whole web remains
  std::optional<Mm> parting = {};  // below the top; empty: chosen
  Mm through{0.1};                 // how far the bottom is cut below the web
};

struct SplitRelief {
  HeightGrid top = {};
  HeightGrid bottom = {};
  Mm beside_x{};  // distance of the part's edge from node (0, 0): the trench and the frame
  Mm beside_y{};
  Mm parting{};  // the middle of the web, below the top
  std::size_t tabs = 0;
  Mm on_part{};         // how far the tabs reach onto the part, at most
  bool has_web = true;  // false: the top leaves only the tabs
  // The fraction of the part's edge that lies above or below the web, 0 to 1.
  double hidden = 0;
  std::vector<bool> part = {};  // for each node of `top`: whether it belongs to the part
};

// `top`, `bottom`: the part seen from both sides, with as many nodes, and with the height of its lowest point where
// there is no part. `high`: the height of the part, above that of the web.
SplitRelief split_relief(const HeightGrid& top, const HeightGrid& bottom, Mm high, const SplitOptions& options);

}  // namespace passo
