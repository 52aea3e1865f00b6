#include "passo/cam/lettering.hpp"

#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "curve_chords.hpp"
#include "drawing_builder.hpp"
#include "letter_line.hpp"
#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H
#include FT_TRUETYPE_TABLES_H
#include <harfbuzz/hb.h>

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

struct HarfBuzzEnd {
  void operator()(hb_blob_t* blob) const { hb_blob_destroy(blob); }
  void operator()(hb_face_t* face) const { hb_face_destroy(face); }
  void operator()(hb_font_t* font) const { hb_font_destroy(font); }
  void operator()(hb_buffer_t* buffer) const { hb_buffer_destroy(buffer); }
};
template <class T>
using HarfBuzzThing = std::unique_ptr<T, HarfBuzzEnd>;

struct FreeTypeEnd {
  void operator()(FT_Library library) const { FT_Done_FreeType(library); }
  void operator()(FT_Face face) const { FT_Done_Face(face); }
};

class Letterer {
 public:
  Letterer(const Lettering& lettering, const std::string& name, Diagnostics& diagnostics)
      : lettering_(lettering), name_(name), diagnostics_(diagnostics), builder_(name, diagnostics) {
    builder_.layer("");
  }

  Drawing letter(std::string_view font) {
    if (open(font)) {
      for_letter_lines(lettering_, [&](std::string_view words, double base_line) { write(words, base_line); });
    }
    return builder_.take();
  }

 private:
  bool open(std::string_view font);
  bool refuse(std::string code, std::string message, std::string expected);
  double capital_height() const;
  void write(std::string_view words, double base_line);
  void draw(std::uint32_t glyph, double x, double y, double middle);
  void put(double x, double y);
  void end_contour();
  static int move_to(const FT_Vector* to, void* self);
  static int line_to(const FT_Vector* to, void* self);
  static int conic_to(const FT_Vector* control, const FT_Vector* to, void* self);
  static int cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* self);
  int curve_to(std::span<const FT_Vector> points);

  const Lettering& lettering_;
  const std::string& name_;
  Diagnostics& diagnostics_;
  DrawingBuilder builder_;
  std::unique_ptr<FT_LibraryRec_, FreeTypeEnd> library_;
  std::unique_ptr<FT_FaceRec_, FreeTypeEnd> face_;
  HarfBuzzThing<hb_font_t> shaper_;
  double scale_ = 1;  // mm of a unit of the font
  // Of the letter that is drawn: its line, its place in the line, and its middle, mm.
  LetterLine line_;
  double at_x_ = 0;
  double at_y_ = 0;
  double middle_ = 0;
  LetterSpot pen_;
  DrawnPath contour_;
};

bool Letterer::refuse(std::string code, std::string message, std::string expected) {
  diagnostics_.add(of_file(std::move(code), name_, std::move(message), std::move(expected)));
  return false;
}

bool Letterer::open(std::string_view font) {
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  const bool has_library = FT_Init_FreeType(&library) == 0;
  library_.reset(library);
  const auto* const bytes = reinterpret_cast<const FT_Byte*>(font.data());
  if (!has_library ||
      FT_New_Memory_Face(library, bytes, static_cast<FT_Long>(font.size()), lettering_.face, &face) != 0) {
    return refuse("engrave.no-font", "this font format is not supported",
                  "an outline font (.ttf, .otf) or a single-line font (.lff, .jhf)");
  }
  face_.reset(face);
  if (!FT_IS_SCALABLE(face) || face->units_per_EM == 0) {
    return refuse("engrave.no-font", "the letters of this font are bitmaps, not outlines",
                  "a TrueType or OpenType font");
  }
  const HarfBuzzThing<hb_blob_t> blob(
      hb_blob_create(font.data(), static_cast<unsigned>(font.size()), HB_MEMORY_MODE_READONLY, nullptr, nullptr));
  const HarfBuzzThing<hb_face_t> shapes(hb_face_create(blob.get(), static_cast<unsigned>(lettering_.face) & 0xFFFFU));
  shaper_.reset(hb_font_create(shapes.get()));
  const unsigned instance = static_cast<unsigned>(lettering_.face) >> 16U;
  if (instance > 0) hb_font_set_var_named_instance(shaper_.get(), instance - 1);
  hb_font_set_scale(shaper_.get(), face->units_per_EM, face->units_per_EM);
  scale_ = lettering_.height.value() / capital_height();
  return true;
}

double Letterer::capital_height() const {
  const auto* const os2 = static_cast<const TT_OS2*>(FT_Get_Sfnt_Table(face_.get(), FT_SFNT_OS2));
  if (os2 != nullptr && os2->version >= 2 && os2->sCapHeight > 0) return os2->sCapHeight;
  const FT_UInt capital = FT_Get_Char_Index(face_.get(), 'H');
  if (capital != 0 && FT_Load_Glyph(face_.get(), capital, FT_LOAD_NO_SCALE) == 0 &&
      face_->glyph->metrics.horiBearingY > 0) {
    return static_cast<double>(face_->glyph->metrics.horiBearingY);
  }
  constexpr double usual = 0.7;
  return usual * face_->units_per_EM;
}

void Letterer::write(std::string_view words, double base_line) {
  const HarfBuzzThing<hb_buffer_t> buffer(hb_buffer_create());
  hb_buffer_add_utf8(buffer.get(), words.data(), static_cast<int>(words.size()), 0, static_cast<int>(words.size()));
  hb_buffer_guess_segment_properties(buffer.get());
  hb_shape(shaper_.get(), buffer.get(), nullptr, 0);
  unsigned count = 0;
  const hb_glyph_info_t* const glyphs = hb_buffer_get_glyph_infos(buffer.get(), &count);
  const hb_glyph_position_t* const places = hb_buffer_get_glyph_positions(buffer.get(), &count);
  double length = 0;
  std::size_t letters = 0;  // marks on letters have no room of their own
  for (unsigned i = 0; i < count; ++i) {
    length += places[i].x_advance * scale_;
    if (places[i].x_advance != 0) ++letters;
  }
  line_ = LetterLine(lettering_, length, letters);
  if (line_.is_too_long()) return refuse_long_line(name_, words, diagnostics_);
  double x = line_.begin();
  for (unsigned i = 0; i < count; ++i) {
    const double advance = places[i].x_advance * scale_;
    if (glyphs[i].codepoint == 0) {
      const std::size_t from = glyphs[i].cluster;
      std::size_t to = from + 1;
      while (to < words.size() && (static_cast<unsigned char>(words[to]) & 0xC0U) == 0x80U) ++to;
      refuse_letter(name_, words.substr(from, to - from), diagnostics_);
    } else {
      draw(glyphs[i].codepoint, x + places[i].x_offset * scale_, base_line + places[i].y_offset * scale_,
           x + advance / 2);
    }
    x += advance + (places[i].x_advance != 0 ? line_.space() : 0);
  }
}

void Letterer::draw(std::uint32_t glyph, double x, double y, double middle) {
  if (FT_Load_Glyph(face_.get(), glyph, FT_LOAD_NO_SCALE | FT_LOAD_NO_BITMAP) != 0) {
    refuse("engrave.no-font", fmt::format("glyph {} of this font is damaged", glyph), "another font");
    return;
  }
  if (face_->glyph->format != FT_GLYPH_FORMAT_OUTLINE) return;
  at_x_ = x;
  at_y_ = y;
  middle_ = middle;
  const FT_Outline_Funcs to = {&Letterer::move_to, &Letterer::line_to, &Letterer::conic_to, &Letterer::cubic_to, 0, 0};
  FT_Outline_Decompose(&face_->glyph->outline, &to, this);
  end_contour();
}

void Letterer::put(double x, double y) {
  const LetterSpot spot = line_.placed(at_x_ + x * scale_, at_y_ + y * scale_, middle_);
  if (!builder_.has_room_for(1, {}, "")) return;
  if (const auto at = builder_.point(Mm(spot.x), Mm(spot.y), {}, "")) contour_.points.push_back({*at, 0});
}

void Letterer::end_contour() {
  std::vector<PathPoint>& points = contour_.points;
  if (points.size() > 2 && points.front().at == points.back().at) points.pop_back();
  contour_.is_closed = true;
  if (points.size() > 2) builder_.add_path(std::move(contour_));
  contour_ = {};
}

int Letterer::move_to(const FT_Vector* to, void* self) {
  auto& letterer = *static_cast<Letterer*>(self);
  letterer.end_contour();
  return line_to(to, self);
}

int Letterer::line_to(const FT_Vector* to, void* self) {
  auto& letterer = *static_cast<Letterer*>(self);
  letterer.pen_ = {static_cast<double>(to->x), static_cast<double>(to->y)};
  letterer.put(letterer.pen_.x, letterer.pen_.y);
  return 0;
}

int Letterer::curve_to(std::span<const FT_Vector> points) {
  std::vector<LetterSpot> all = {pen_};
  for (const FT_Vector& point : points) all.push_back({static_cast<double>(point.x), static_cast<double>(point.y)});
  const auto take = [&](double x, double y) {
    put(x, y);
    return true;
  };
  pen_ = all.back();
  return for_chords(std::span<const LetterSpot>(all), scale_, lettering_.tolerance.value(), take) ? 0 : 1;
}

int Letterer::conic_to(const FT_Vector* control, const FT_Vector* to, void* self) {
  return static_cast<Letterer*>(self)->curve_to(std::array{*control, *to});
}

int Letterer::cubic_to(const FT_Vector* first, const FT_Vector* second, const FT_Vector* to, void* self) {
  return static_cast<Letterer*>(self)->curve_to(std::array{*first, *second, *to});
}

}  // namespace

Drawing letter(const Lettering& lettering, const std::string& name, std::string_view font, Diagnostics& diagnostics) {
  if (looks_like_stroke_font(font)) {
    return letter_strokes(lettering, name, read_stroke_font(name, font, diagnostics), diagnostics);
  }
  return Letterer(lettering, name, diagnostics).letter(font);
}

Drawing letter_simplex(const Lettering& lettering, Diagnostics& diagnostics) {
  return letter_strokes(lettering, "simplex", built_in_stroke_font(), diagnostics);
}

}  // namespace passo
