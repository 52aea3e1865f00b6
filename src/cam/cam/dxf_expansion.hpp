// DxfExpansion: makes a drawing from the entities of a DXF file, with its blocks expanded. Private to cam/.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drawing_builder.hpp"
#include "dxf_document.hpp"
#include "dxf_plane.hpp"
#include "dxf_selection.hpp"
#include "dxf_transform.hpp"
#include "fit_spline.hpp"

#include "passo/cam/dxf.hpp"
#include "passo/geometry/parametric_curve.hpp"

namespace passo {

// A point of a path in the units of its block.
struct DxfPoint {
  double x = 0;
  double y = 0;
  double bulge = 0;
};

class DxfExpansion {
 public:
  DxfExpansion(const std::string& name, const DxfDocument& document, const DxfOptions& options,
               Diagnostics& diagnostics)
      : document_(document),
        options_(options),
        builder_(name, diagnostics),
        diagnostics_(diagnostics),
        selection_(document, options) {}

  Drawing expand();

 private:
  using Entities = std::vector<DxfEntity>;

  bool choose_layers();
  double choose_unit();
  void add_all(const Entities& entities, const DxfTransform& transform, std::optional<std::uint32_t> layer, int depth);
  void add(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_circle(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_arc(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_lwpolyline(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  std::size_t add_polyline(const Entities& entities, std::size_t index, const DxfTransform& transform,
                           std::uint32_t layer);
  void add_ellipse(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_spline(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer);
  void add_insert(const DxfEntity& entity, const DxfTransform& transform, std::uint32_t layer, int depth);
  void add_points(const DxfEntity& entity, const std::vector<DxfPoint>& points, bool is_closed, double width,
                  const DxfTransform& transform, std::uint32_t layer);
  void add_arc_chords(const DxfEntity& entity, const DxfPoint& from, const DxfPoint& to, const DxfTransform& transform,
                      DrawnPath& path);
  void add_fit_spline(const DxfEntity& entity, const FitSpline& spline, const DxfTransform& transform,
                      std::uint32_t layer);
  template <ParametricCurve C>
  void add_curve(const DxfEntity& entity, const Result<C, CurveError>& curve, double mm, bool is_closed,
                 const DxfTransform& transform, std::uint32_t layer);
  void note_what_is_left_out();

  Vector3 normal_of(const DxfEntity& entity) const {
    return {document_.number(entity, 210, 0), document_.number(entity, 220, 0), document_.number(entity, 230, 1)};
  }
  // Entities that lie in a plane of their own may be seen from behind, or at an angle.
  DxfTransform seen(const DxfEntity& entity, const DxfTransform& transform) const {
    const double z = document_.number(entity, entity.kind == DxfKind::lwpolyline ? 38 : 30, 0);
    const auto plane = seen_from_above(normal_of(entity), z);
    return plane ? transform.after(*plane) : transform;
  }
  SourceLocation place_of(const DxfEntity& entity) const { return {entity.line, entity.line == 0 ? 0U : 1U, 1}; }
  bool has_room(const DxfEntity& entity, std::size_t points) {
    return builder_.has_room_for(points, place_of(entity), "");
  }
  bool has_work_left(const DxfEntity& entity);
  std::optional<DrawnPoint> point(const DxfEntity& entity, double x, double y, const DxfTransform& transform) {
    return builder_.point(Mm(transform.x(x, y)), Mm(transform.y(x, y)), place_of(entity), "");
  }
  void refuse(const DxfEntity& entity, const char* code, std::string message, std::string expected) {
    diagnostics_.add({.code = code,
                      .file = builder_.drawing().file,
                      .place = place_of(entity),
                      .message = std::move(message),
                      .expected = std::move(expected),
                      .text = ""});
  }

  const DxfDocument& document_;
  const DxfOptions& options_;
  DrawingBuilder builder_;
  Diagnostics& diagnostics_;
  DxfSelection selection_;
  DxfSelection::Around around_ = {};  // of the blocks that are open
  std::vector<bool> is_chosen_;       // of the document's layers
  std::vector<std::uint32_t> open_blocks_;
  std::size_t work_ = 0;
  std::size_t on_layers_off_ = 0;
  std::size_t in_paper_ = 0;
  std::size_t wide_ = 0;          // polylines with a width
  std::uint32_t first_wide_ = 0;  // line of the first one
};

}  // namespace passo
