#include "cairo_canvas.hpp"

#include <algorithm>
#include <string_view>

#include "characters.hpp"
#include <cairo-svg.h>
#include <cairo.h>

namespace passo {
namespace {

cairo_status_t write_to(void* file, const unsigned char* bytes, unsigned int count) {
  auto& output = *static_cast<OutputFile*>(file);
  output.write({reinterpret_cast<const char*>(bytes), count});
  return output.failed() ? CAIRO_STATUS_WRITE_ERROR : CAIRO_STATUS_SUCCESS;
}

cairo_surface_t* make_surface(const PictureOptions& options, OutputFile& file) {
  if (options.format == PictureFormat::svg) {
    cairo_surface_t* surface = cairo_svg_surface_create_for_stream(write_to, &file, options.width, options.height);
    cairo_svg_surface_set_document_unit(surface, CAIRO_SVG_UNIT_PX);
    return surface;
  }
  const int scale = options.pixels_per_unit;
  cairo_surface_t* surface =
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, options.width * scale, options.height * scale);
  cairo_surface_set_device_scale(surface, scale, scale);
  return surface;
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

}  // namespace

void Canvas::Free::operator()(cairo_t* context) const {
  cairo_destroy(context);
}
void Canvas::Free::operator()(cairo_surface_t* surface) const {
  cairo_surface_destroy(surface);
}

Canvas::Canvas(const PictureOptions& options, OutputFile& file)
    : format_(options.format),
      file_(file),
      surface_(make_surface(options, file)),
      context_(cairo_create(surface_.get())) {
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  // With this, letters keep their shape and distance at any scale.
  cairo_font_options_t* font_options = cairo_font_options_create();
  cairo_font_options_set_antialias(font_options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(font_options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(font_options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context_.get(), font_options);
  cairo_font_options_destroy(font_options);
}

Canvas::~Canvas() = default;

void Canvas::fill(const Area& area, const Colour& colour) {
  cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
  cairo_rectangle(context_.get(), area.x, area.y, area.width, area.height);
  cairo_fill(context_.get());
}

void Canvas::fill(const std::vector<Spot>& polygon, const Colour& colour, double opacity) {
  cairo_set_source_rgba(context_.get(), colour.red, colour.green, colour.blue, opacity);
  for (const Spot& spot : polygon) cairo_line_to(context_.get(), spot.x, spot.y);
  cairo_close_path(context_.get());
  cairo_fill(context_.get());
}

void Canvas::fill_with_speeds(const Area& area) {
  cairo_pattern_t* pattern = cairo_pattern_create_linear(area.x, 0, area.right(), 0);
  for (std::size_t i = 0; i <= SpeedColours::classes; ++i) {
    const double share = static_cast<double>(i) / SpeedColours::classes;
    const Colour colour = SpeedColours::at(share);
    cairo_pattern_add_color_stop_rgb(pattern, share, colour.red, colour.green, colour.blue);
  }
  cairo_set_source(context_.get(), pattern);
  cairo_rectangle(context_.get(), area.x, area.y, area.width, area.height);
  cairo_fill(context_.get());
  cairo_pattern_destroy(pattern);
}

void Canvas::image(const Area& area, PixelMap map) {
  auto* const bytes = reinterpret_cast<unsigned char*>(map.pixels.data());
  const int stride = map.width * static_cast<int>(sizeof(std::uint32_t));
  cairo_surface_t* const image =
      cairo_image_surface_create_for_data(bytes, CAIRO_FORMAT_ARGB32, map.width, map.height, stride);
  cairo_save(context_.get());
  cairo_translate(context_.get(), area.x, area.y);
  cairo_scale(context_.get(), area.width / map.width, area.height / map.height);
  cairo_set_source_surface(context_.get(), image, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context_.get()), CAIRO_FILTER_FAST);
  cairo_paint(context_.get());
  cairo_restore(context_.get());
  // A drawing that is written at its end (SVG) has its own copy of the pixels from here on.
  cairo_surface_finish(image);
  cairo_surface_destroy(image);
}

void Canvas::frame(const Area& area, const Pen& pen) {
  cairo_rectangle(context_.get(), area.x, area.y, area.width, area.height);
  stroke(pen);
}

void Canvas::line(Spot from, Spot to, const Pen& pen) {
  move_to(from);
  line_to(to);
  stroke(pen);
}

void Canvas::disc(Spot centre, double radius, const Colour& colour) {
  constexpr double full_turn = 6.283185307179586;
  cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
  cairo_new_sub_path(context_.get());
  cairo_arc(context_.get(), centre.x, centre.y, radius, 0, full_turn);
  cairo_fill(context_.get());
}

void Canvas::use(const Font& font) {
  cairo_select_font_face(context_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         font.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context_.get(), font.size);
}

double Canvas::text_width(const std::string& text, const Font& font) {
  use(font);
  cairo_text_extents_t extents;
  cairo_text_extents(context_.get(), drawable(text).c_str(), &extents);
  return extents.x_advance;
}

void Canvas::text(Spot place, const std::string& text, const Font& font, Align align) {
  const double width = text_width(text, font);
  constexpr double half_digit = 0.364;  // of the font size
  const double x = align == Align::left ? place.x : align == Align::centre ? place.x - width / 2 : place.x - width;
  cairo_set_source_rgb(context_.get(), font.colour.red, font.colour.green, font.colour.blue);
  cairo_move_to(context_.get(), x, place.y + half_digit * font.size);
  cairo_show_text(context_.get(), drawable(text).c_str());
  cairo_new_path(context_.get());
}

void Canvas::move_to(Spot spot) {
  cairo_move_to(context_.get(), spot.x, spot.y);
}

void Canvas::line_to(Spot spot) {
  cairo_line_to(context_.get(), spot.x, spot.y);
}

void Canvas::stroke(const Pen& pen) {
  cairo_set_source_rgba(context_.get(), pen.colour.red, pen.colour.green, pen.colour.blue, pen.opacity);
  cairo_set_line_width(context_.get(), pen.width);
  cairo_set_dash(context_.get(), pen.dashes.data(), static_cast<int>(pen.dashes.size()), 0);
  cairo_stroke(context_.get());
}

void Canvas::fill_path(const Colour& colour) {
  cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
  cairo_set_fill_rule(context_.get(), CAIRO_FILL_RULE_EVEN_ODD);
  cairo_fill(context_.get());
  cairo_set_fill_rule(context_.get(), CAIRO_FILL_RULE_WINDING);
}

void Canvas::clip(const Area& area) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), area.x, area.y, area.width, area.height);
  cairo_clip(context_.get());
}

void Canvas::end_clip() {
  cairo_restore(context_.get());
}

Status<OutputError> Canvas::finish() {
  cairo_status_t status = cairo_status(context_.get());
  if (status == CAIRO_STATUS_SUCCESS && format_ == PictureFormat::png) {
    status = cairo_surface_write_to_png_stream(surface_.get(), write_to, &file_);
  }
  cairo_surface_finish(surface_.get());
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_.get());
  // If the file failed, its commit() explains that better.
  if (status == CAIRO_STATUS_SUCCESS || file_.failed()) return Unit{};
  return Failure{OutputError{std::string("cannot draw the picture: ") + cairo_status_to_string(status)}};
}

}  // namespace passo
