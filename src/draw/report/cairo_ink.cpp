#include "cairo_ink.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "characters.hpp"
#include <cairo.h>

namespace passo {
namespace {

struct CairoEnd {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_pattern_t* pattern) const { cairo_pattern_destroy(pattern); }
  void operator()(cairo_font_options_t* options) const { cairo_font_options_destroy(options); }
};
template <class T>
using CairoThing = std::unique_ptr<T, CairoEnd>;

cairo_status_t write_to_file(void* file, const unsigned char* bytes, unsigned int count) {
  auto& output = *static_cast<OutputFile*>(file);
  output.write({reinterpret_cast<const char*>(bytes), count});
  return output.failed() ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
}

cairo_status_t append_to_text(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

CairoThing<cairo_surface_t> paper_of(const PictureOptions& options) {
  const int scale = options.pixels_per_unit;
  CairoThing<cairo_surface_t> paper(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, options.width * scale, options.height * scale));
  cairo_surface_set_device_scale(paper.get(), scale, scale);
  return paper;
}

// Of the pixels in `map`, which outlives the surface.
CairoThing<cairo_surface_t> surface_of(PixelMap& map) {
  auto* const bytes = reinterpret_cast<unsigned char*>(map.pixels.data());
  const int stride = map.width * static_cast<int>(sizeof(std::uint32_t));
  return CairoThing<cairo_surface_t>(
      cairo_image_surface_create_for_data(bytes, CAIRO_FORMAT_ARGB32, map.width, map.height, stride));
}

// File names may hold any bytes. cairo would stop drawing at the first byte that is no character.
std::string drawable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    result += length > 0 ? text.substr(0, length) : "?";
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

class CairoInk final : public Ink {
 public:
  CairoInk(const PictureOptions& options, OutputFile& file)
      : file_(file), surface_(paper_of(options)), owned_(cairo_create(surface_.get())), context_(owned_.get()) {
    cairo_set_line_cap(context_, CAIRO_LINE_CAP_ROUND);
    cairo_set_line_join(context_, CAIRO_LINE_JOIN_ROUND);
    // With this, letters keep their shape and distance at any scale.
    const CairoThing<cairo_font_options_t> letters(cairo_font_options_create());
    cairo_font_options_set_antialias(letters.get(), CAIRO_ANTIALIAS_GRAY);
    cairo_font_options_set_hint_style(letters.get(), CAIRO_HINT_STYLE_NONE);
    cairo_font_options_set_hint_metrics(letters.get(), CAIRO_HINT_METRICS_OFF);
    cairo_set_font_options(context_, letters.get());
  }

  void move_to(Spot spot) override { cairo_move_to(context_, spot.x, spot.y); }
  void line_to(Spot spot) override { cairo_line_to(context_, spot.x, spot.y); }
  void close() override { cairo_close_path(context_); }
  void stroke(const Pen& pen) override {
    cairo_set_source_rgba(context_, pen.colour.red, pen.colour.green, pen.colour.blue, pen.opacity);
    cairo_set_line_width(context_, pen.width);
    cairo_set_dash(context_, pen.dashes.data(), static_cast<int>(pen.dashes.size()), 0);
    cairo_stroke(context_);
  }
  void fill(const Colour& colour, double opacity, Rule rule) override {
    cairo_set_source_rgba(context_, colour.red, colour.green, colour.blue, opacity);
    cairo_set_fill_rule(context_, rule == Rule::even_odd ? CAIRO_FILL_RULE_EVEN_ODD : CAIRO_FILL_RULE_WINDING);
    cairo_fill(context_);
  }

  void fill_with_speeds(const Area& area) override {
    const CairoThing<cairo_pattern_t> pattern(cairo_pattern_create_linear(area.x, 0, area.right(), 0));
    for (std::size_t i = 0; i <= SpeedColours::classes; ++i) {
      const double share = static_cast<double>(i) / SpeedColours::classes;
      const Colour colour = SpeedColours::at(share);
      cairo_pattern_add_color_stop_rgb(pattern.get(), share, colour.red, colour.green, colour.blue);
    }
    cairo_set_source(context_, pattern.get());
    cairo_rectangle(context_, area.x, area.y, area.width, area.height);
    cairo_fill(context_);
  }
  void disc(Spot centre, double radius, const Colour& colour) override {
    constexpr double full_turn = 6.283185307179586;
    cairo_set_source_rgb(context_, colour.red, colour.green, colour.blue);
    cairo_new_sub_path(context_);
    cairo_arc(context_, centre.x, centre.y, radius, 0, full_turn);
    cairo_fill(context_);
  }
  void image(const Area& area, PixelMap map) override {
    const CairoThing<cairo_surface_t> image = surface_of(map);
    cairo_save(context_);
    cairo_translate(context_, area.x, area.y);
    cairo_scale(context_, area.width / map.width, area.height / map.height);
    cairo_set_source_surface(context_, image.get(), 0, 0);
    cairo_pattern_set_filter(cairo_get_source(context_), CAIRO_FILTER_FAST);
    cairo_paint(context_);
    cairo_restore(context_);
    cairo_surface_finish(image.get());
  }

  void text(Spot place, const std::string& text, const Font& font, Align align) override {
    const double width = text_width(text, font);
    const double x = align == Align::left ? place.x : align == Align::centre ? place.x - width / 2 : place.x - width;
    cairo_set_source_rgb(context_, font.colour.red, font.colour.green, font.colour.blue);
    cairo_move_to(context_, x, place.y);
    cairo_show_text(context_, drawable(text).c_str());
    cairo_new_path(context_);
  }
  double text_width(const std::string& text, const Font& font) override {
    cairo_select_font_face(context_, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                           font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(context_, font.size);
    cairo_text_extents_t extents;
    cairo_text_extents(context_, drawable(text).c_str(), &extents);
    return extents.x_advance;
  }

  void clip(const Area& area) override {
    cairo_save(context_);
    cairo_rectangle(context_, area.x, area.y, area.width, area.height);
    cairo_clip(context_);
  }
  void end_clip() override { cairo_restore(context_); }

  Status<OutputError> finish() override {
    cairo_status_t status = cairo_status(context_);
    if (status == CAIRO_STATUS_SUCCESS) {
      status = cairo_surface_write_to_png_stream(surface_.get(), write_to_file, &file_);
    }
    // If the file failed, its commit() explains that better.
    if (status == CAIRO_STATUS_SUCCESS || file_.failed()) return Unit{};
    return Failure{OutputError{std::string("cannot draw the picture: ") + cairo_status_to_string(status)}};
  }

 private:
  OutputFile& file_;
  CairoThing<cairo_surface_t> surface_;
  CairoThing<cairo_t> owned_;  // must be destroyed before its surface, so it is declared after it
  cairo_t* context_;
};

}  // namespace

std::unique_ptr<Ink> cairo_ink(const PictureOptions& options, OutputFile& file) {
  return std::make_unique<CairoInk>(options, file);
}

Result<std::string, OutputError> png_of(PixelMap map) {
  const CairoThing<cairo_surface_t> image = surface_of(map);
  std::string bytes;
  const cairo_status_t status = cairo_surface_write_to_png_stream(image.get(), append_to_text, &bytes);
  if (status == CAIRO_STATUS_SUCCESS) return bytes;
  return Failure{OutputError{std::string("cannot draw the picture: ") + cairo_status_to_string(status)}};
}

}  // namespace passo
