#include "face_view.hpp"

#include <algorithm>
#include <cmath>

#include "axis_ticks.hpp"
#include "sheet.hpp"

namespace passo {
Area fitted(const FaceExtent& face, const Area& room) {
  const double shape = face.size_x / face.size_y;
  const double width = std::min(room.width, room.height * shape);
  return {room.x, room.y, std::max(1.0, std::floor(width)), std::max(1.0, std::floor(width / shape))};
}

void draw_scales(Canvas& canvas, const FaceExtent& face, const Area& area) {
  const double pixels = area.width / face.size_x;
  const auto room_x = [&](const std::string& text) { return canvas.text_width(text, sheet::label) + 24; };
  for (const Tick& tick : ticks(face.low_x, face.low_x + face.size_x, pixels, room_x)) {
    const double x = area.x + (tick.value - face.low_x) * pixels;
    canvas.line({x, area.bottom()}, {x, area.bottom() + 5}, sheet::edge);
    canvas.text({x, area.bottom() + 16}, tick.label, sheet::label, Align::centre);
  }
  const auto room_y = [](const std::string&) { return 30.0; };
  for (const Tick& tick : ticks(face.low_y, face.low_y + face.size_y, area.height / face.size_y, room_y)) {
    const double y = area.bottom() - (tick.value - face.low_y) * area.height / face.size_y;
    canvas.line({area.x - 5, y}, {area.x, y}, sheet::edge);
    canvas.text({area.x - 9, y}, tick.label, sheet::label, Align::right);
  }
  canvas.text({area.x + area.width / 2, area.bottom() + 36}, "X, mm", sheet::axis_title, Align::centre);
  canvas.text({area.x - 9, area.y - 16}, "Y, mm", sheet::axis_title, Align::right);
}

}  // namespace passo
