// SvgFigureReader: reads the shape of one SVG element as paths and circles. Private to cam/.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "drawing_builder.hpp"
#include "dxf_transform.hpp"
#include "svg_document.hpp"
#include "svg_path.hpp"
#include "svg_view.hpp"

namespace passo {

// The position of an element in the drawing.
struct SvgSpace {
  DxfTransform transform = {};
  SvgView view = {};
  std::uint32_t layer = 0;
};

// The lines of one element or of several.
struct SvgFigure {
  std::vector<DrawnPath> paths = {};
  std::vector<DrawnHole> holes = {};
};

class SvgFigureReader {
 public:
  // `inch`: the number of pixels per inch. `builder` limits the number of points and the lengths.
  SvgFigureReader(const std::string& name, Mm tolerance, double inch, DrawingBuilder& builder, Diagnostics& diagnostics)
      : name_(name), tolerance_(tolerance.value()), inch_(inch), builder_(builder), diagnostics_(diagnostics) {}

  static bool is_shape(std::string_view element);
  // Adds the shape to the figure.
  void read(const SvgElement& element, const SvgSpace& space, SvgFigure& figure);

  // Reads a length in pixels; reports an error for an invalid one. `whole`: the length of 100 %.
  double length(const SvgElement& element, std::string_view attribute, double whole, double otherwise = 0);
  void refuse(const SvgElement& element, std::string code, std::string message, std::string expected);
  static SourceLocation place_of(const SvgElement& element) { return {element.line, element.line == 0 ? 0U : 1U, 1}; }

 private:
  void read_rect(const SvgElement& element, const SvgSpace& space);
  void read_ellipse(const SvgElement& element, const SvgSpace& space, SvgSpot middle, double rx, double ry);
  void read_points(const SvgElement& element, const SvgSpace& space);
  void read_path(const SvgElement& element, const SvgSpace& space);
  void read_subpath(const SvgElement& element, const SvgSpace& space, const SvgSubpath& subpath);
  void add(DrawnPath path);
  bool put(DrawnPath& path, const SvgElement& element, const SvgSpace& space, SvgSpot spot, double bulge = 0);
  void put_arc(DrawnPath& path, const SvgElement& element, const SvgSpace& space, const SvgArc& arc);
  void put_curve(DrawnPath& path, const SvgElement& element, const SvgSpace& space, SvgSpot from,
                 const SvgPiece& piece);

  const std::string& name_;
  double tolerance_;
  double inch_;
  DrawingBuilder& builder_;
  Diagnostics& diagnostics_;
  SvgFigure* figure_ = nullptr;
};

}  // namespace passo
