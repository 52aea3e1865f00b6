// medial_axis: computes the points in a region that are equally far from two or more of its edges. Private to cam/.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "passo/cam/region.hpp"

namespace passo {

struct MedialPoint {
  double x = 0;  // nm
  double y = 0;
  double clearance = 0;  // distance of the nearest edge
};

// A piece of the axis between two nodes. Between two of its points the axis is straight and the clearance changes
// linearly, both within the tolerance.
struct MedialPiece {
  std::uint32_t from = 0;  // index of the node at each end
  std::uint32_t to = 0;
  std::vector<MedialPoint> points = {};  // from one end to the other, at least two
};

struct MedialAxis {
  std::uint32_t nodes = 0;
  std::vector<MedialPiece> pieces = {};
};

struct MedialOptions {
  double least_turn = 0;  // radians; omits pieces between two edges that meet at a smaller turn
  double tolerance_nm = 1'000;
  // The owner of each ring of the region. Pieces between edges of the same owner, and between an edge and one without
  // an owner, are omitted. Empty: all pieces are kept.
  std::vector<std::uint32_t> owners = {};
};
inline constexpr std::uint32_t nobody = 0xffffffff;

// Returns nothing if the region is wider than 4 m.
std::optional<MedialAxis> medial_axis(const Region& region, const MedialOptions& options);

}  // namespace passo
