// letters_of: the outlines of a text on one line, for DrawnSolid, by FreeType alone: advances and kerning pairs, but no
// other shaping.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include "kit/drawn_solid.hpp"

namespace passo::test {

// A glyph that FreeType draws.
struct DrawnGlyph {
  DrawnShapes& shapes;
  double scale = 1;
  FlatPoint at = {};
  FlatRing ring = {};

  FlatPoint point(const FT_Vector* to) const {
    return {at.x + scale * static_cast<double>(to->x), at.y + scale * static_cast<double>(to->y)};
  }
  void end() {
    if (ring.size() > 2) shapes.add(std::move(ring));
    ring = {};
  }
};

// `middle`: X of the middle of the text, Y of its base line. Lengths are mm.
inline DrawnShapes letters_of(const std::string& text, const std::string& font, double capital_height,
                              FlatPoint middle) {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  if (FT_Init_FreeType(&library) != 0) throw std::runtime_error("no FreeType");
  const std::unique_ptr<FT_LibraryRec_, decltype(&FT_Done_FreeType)> end(library, &FT_Done_FreeType);
  if (FT_New_Face(library, font.c_str(), 0, &face) != 0) throw std::runtime_error("no font " + font);
  DrawnShapes shapes;
  FT_Load_Glyph(face, FT_Get_Char_Index(face, 'H'), FT_LOAD_NO_SCALE);
  DrawnGlyph glyph{.shapes = shapes, .scale = capital_height / static_cast<double>(face->glyph->metrics.horiBearingY)};
  const auto walk = [&](double x, auto&& visit) {
    FT_UInt before = 0;
    for (const char letter : text) {
      const FT_UInt now = FT_Get_Char_Index(face, static_cast<FT_ULong>(letter));
      FT_Vector kerning{};
      FT_Get_Kerning(face, before, now, FT_KERNING_UNSCALED, &kerning);
      x += glyph.scale * static_cast<double>(kerning.x);
      FT_Load_Glyph(face, now, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP);
      visit(x);
      x += glyph.scale * static_cast<double>(face->glyph->metrics.horiAdvance);
      before = now;
    }
    return x;
  };
  const double length = walk(0, [](double) {});
  FT_Outline_Funcs draw{};
  draw.move_to = [](const FT_Vector* to, void* self) {
    auto& one = *static_cast<DrawnGlyph*>(self);
    one.end();
    one.ring.push_back(one.point(to));
    return 0;
  };
  draw.line_to = [](const FT_Vector* to, void* self) {
    auto& one = *static_cast<DrawnGlyph*>(self);
    one.ring.push_back(one.point(to));
    return 0;
  };
  draw.conic_to = [](const FT_Vector* control, const FT_Vector* to, void* self) {
    auto& one = *static_cast<DrawnGlyph*>(self);
    add_quadratic(one.ring, one.point(control), one.point(to));
    return 0;
  };
  draw.cubic_to = [](const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* self) {
    auto& one = *static_cast<DrawnGlyph*>(self);
    add_cubic(one.ring, one.point(first), one.point(second), one.point(to));
    return 0;
  };
  walk(middle.x - length / 2, [&](double x) {
    glyph.at = {x, middle.y};
    FT_Outline_Decompose(&face->glyph->outline, &draw, &glyph);
    glyph.end();
  });
  return shapes;
}

}  // namespace passo::test
