#include "sheet.hpp"

#include <algorithm>

namespace passo {
namespace {

constexpr double sample = 40;  // the length of a line
constexpr double before_words = 12;
constexpr double between_entries = 44;  // entries
const Area patch_area{0, -8, 28, 16};

// Cuts text out of the middle if the text is wider than `room`. The start of a name tells the job, the end tells the
// kind of file.
std::string shortened(Canvas& canvas, const std::string& text, const Font& font, double room) {
  std::string shown = text;
  for (std::size_t kept = text.size(); canvas.text_width(shown, font) > room && kept > 8;) {
    kept -= std::max<std::size_t>(1, kept / 16);
    shown = text.substr(0, kept / 2) + "\u2026" + text.substr(text.size() - kept / 2);
  }
  return shown;
}

}  // namespace

void begin_sheet(Canvas& canvas, const PictureOptions& options, const std::string& words) {
  canvas.fill({0, 0, static_cast<double>(options.width), static_cast<double>(options.height)}, sheet::paper);
  const double room = options.width - 2 * sheet::margin;
  canvas.text({sheet::margin, 42}, shortened(canvas, options.program, sheet::title, room), sheet::title);
  canvas.text({sheet::margin, 74}, shortened(canvas, words, sheet::subtitle, room), sheet::subtitle);
}

void begin_sheet(Canvas& canvas, const PictureOptions& options) {
  begin_sheet(canvas, options, options.machine);
}

void Legend::words(const std::string& words) {
  canvas_.text(place_, words, sheet::caption);
  place_.x += canvas_.text_width(words, sheet::caption) + between_entries;
}

void Legend::line(const Pen& pen, const std::string& words) {
  canvas_.line(place_, {place_.x + sample, place_.y}, pen);
  place_.x += sample + before_words;
  this->words(words);
}

void Legend::patch(const Colour& colour, const std::string& words) {
  const Area area{place_.x + patch_area.x, place_.y + patch_area.y, patch_area.width, patch_area.height};
  canvas_.fill(area, colour);
  canvas_.frame(area, {.colour = {0.75, 0.77, 0.80}, .width = 0.8});
  place_.x += patch_area.width + before_words;
  this->words(words);
}

void Legend::dot(double radius, const Colour& colour, const std::string& words) {
  canvas_.disc({place_.x + radius, place_.y}, radius, colour);
  place_.x += 2 * radius + before_words;
  this->words(words);
}

double Legend::width_of_lines(Canvas& canvas, const std::vector<std::string>& words) {
  double width = -between_entries;
  for (const std::string& entry : words) {
    width += sample + before_words + canvas.text_width(entry, sheet::caption) + between_entries;
  }
  return width;
}

}  // namespace passo
