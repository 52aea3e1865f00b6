// medial_axis: the places in a region that are equally far from two or more of its edges. Private to cam/.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

struct MedialPoint {
  double x = 0;  // nm
  double y = 0;
  double clearance = 0;  // how far the nearest edge is
};

// A piece of the axis from one node to another. Between two points it is straight, and so is the clearance, within the
// tolerance.
struct MedialPiece {
  std::uint32_t from = 0;  // nodes
  std::uint32_t to = 0;
  std::vector<MedialPoint> points = {};  // from end to end, two or more
};

struct MedialAxis {
  std::uint32_t nodes = 0;
  std::vector<MedialPiece> pieces = {};
};

struct MedialOptions {
  double least_turn = 0;  // radians; pieces between two edges that meet at a smaller turn are left out
  double tolerance_nm = 1'000;
  // Of each ring of the region; pieces between edges of one owner, and between an edge and nobody's, are left out.
  // Empty: all pieces count.
  std::vector<std::uint32_t> owners = {};
};
inline constexpr std::uint32_t nobody = 0xffffffff;

// Nothing: the region is wider than 4 m.
std::optional<MedialAxis> medial_axis(const Region& region, const MedialOptions& options);

}  // namespace passo
