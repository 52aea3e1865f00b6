// SvgSelection: selects shapes of an SVG drawing by their colours and names. Private to cam/.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "svg_document.hpp"
#include "svg_figure.hpp"

#include "passo/cam/svg.hpp"

namespace passo {

// Returns a colour as "#rrggbb": from #f00, #ff0000, rgb(255, 0, 0) or a usual name. Other texts are returned in small
// letters.
std::string svg_colour(std::string_view text);

class SvgSelection {
 public:
  explicit SvgSelection(const SvgOptions& options);

  // What an element has of itself and of the groups around it.
  struct Paint {
    bool is_named = false;  // by one of the wanted names
    std::string_view stroke = {};
    std::string_view fill = {};
    std::string names = {};  // each after a line end; only with SvgOptions::tells_shapes
  };
  // `paint`: that of the group around the element. The element must outlive it.
  void enter(const SvgElement& element, Paint& paint);
  bool takes(const Paint& paint);
  // Returns a note for each colour and name that was not found.
  std::vector<std::string> missing() const;

 private:
  const SvgOptions& options_;
  std::vector<std::string> colours_;  // as svg_colour() returns them
  std::set<std::string> found_;
};

// The space of a shape on a layer that tells its colour and names (SvgOptions::tells_shapes).
SvgSpace told(SvgSpace space, const SvgSelection::Paint& paint, DrawingBuilder& builder);

}  // namespace passo
