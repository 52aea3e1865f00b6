#include "canvas.hpp"

#include <utility>

#include "cairo_ink.hpp"
#include "svg_ink.hpp"

namespace passo {

Canvas::Canvas(const PictureOptions& options, OutputFile& file)
    : ink_(options.format == PictureFormat::svg ? svg_ink(options, file) : cairo_ink(options, file)) {}

Canvas::~Canvas() = default;

void Canvas::outline(const Area& area) {
  ink_->move_to({area.x, area.y});
  ink_->line_to({area.right(), area.y});
  ink_->line_to({area.right(), area.bottom()});
  ink_->line_to({area.x, area.bottom()});
  ink_->close();
}

void Canvas::fill(const Area& area, const Colour& colour) {
  outline(area);
  ink_->fill(colour, 1, Ink::Rule::winding);
}

void Canvas::fill(const std::vector<Spot>& polygon, const Colour& colour, double opacity) {
  if (polygon.empty()) return;
  ink_->move_to(polygon.front());
  for (std::size_t i = 1; i < polygon.size(); ++i) ink_->line_to(polygon[i]);
  ink_->close();
  ink_->fill(colour, opacity, Ink::Rule::winding);
}

void Canvas::fill_with_speeds(const Area& area) {
  ink_->fill_with_speeds(area);
}

void Canvas::image(const Area& area, PixelMap map) {
  ink_->image(area, std::move(map));
}

void Canvas::frame(const Area& area, const Pen& pen) {
  outline(area);
  ink_->stroke(pen);
}

void Canvas::line(Spot from, Spot to, const Pen& pen) {
  ink_->move_to(from);
  ink_->line_to(to);
  ink_->stroke(pen);
}

void Canvas::disc(Spot centre, double radius, const Colour& colour) {
  ink_->disc(centre, radius, colour);
}

void Canvas::text(Spot place, const std::string& text, const Font& font, Align align) {
  constexpr double half_digit = 0.364;  // of the font size
  ink_->text({place.x, place.y + half_digit * font.size}, text, font, align);
}

double Canvas::text_width(const std::string& text, const Font& font) {
  return ink_->text_width(text, font);
}

void Canvas::move_to(Spot spot) {
  ink_->move_to(spot);
}

void Canvas::line_to(Spot spot) {
  ink_->line_to(spot);
}

void Canvas::stroke(const Pen& pen) {
  ink_->stroke(pen);
}

void Canvas::fill_path(const Colour& colour) {
  ink_->fill(colour, 1, Ink::Rule::even_odd);
}

void Canvas::clip(const Area& area) {
  ink_->clip(area);
}

void Canvas::end_clip() {
  ink_->end_clip();
}

Status<OutputError> Canvas::finish() {
  return ink_->finish();
}

}  // namespace passo
