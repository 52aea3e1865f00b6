#include "passo/report/foam_body.hpp"

#include "triangle_writer.hpp"

#include "passo/stock/foam_skin.hpp"

namespace passo {

std::size_t usual_body_step(const FoamBlock& foam) {
  constexpr std::size_t most_cells = 10'000'000;
  std::size_t step = 1;
  while (foam.columns() / step * (foam.rows() / step) * foam.slices() > most_cells) ++step;
  return step;
}

std::uint64_t write_foam_body(const FoamBlock& foam, std::size_t step, OutputFile& file) {
  const auto corner = [](const Vector3& place) {
    return Corner{static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)};
  };
  return write_triangles("passo simulate: the foam after the wire, mm", file, [&](TriangleWriter& out) {
    foam_skin(foam, step, [&](const SkinTriangle& triangle) {
      out.add(corner(triangle.corners[0]), corner(triangle.corners[1]), corner(triangle.corners[2]));
    });
  });
}

}  // namespace passo
