#include "svg_ink.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "cairo_ink.hpp"
#include "letter_widths.hpp"
#include <fmt/format.h>

#include "passo/report/html.hpp"

namespace passo {
namespace {

// Letters are left to the viewer; Verdana is as wide as DejaVu Sans, others are narrower.
constexpr std::string_view beginning =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0}px\" "
    "height=\"{1}px\" viewBox=\"0 0 {0} {1}\" fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\" "
    "font-family=\"'DejaVu Sans',Verdana,sans-serif\">\n";

// A thousandth of a unit is finer than any screen shows a picture.
void put(std::string& text, double value) {
  constexpr double widest = 1e9;
  constexpr long thousand = 1000;
  const long thousandths = std::lround(std::clamp(std::isfinite(value) ? value : 0, -widest, widest) * thousand);
  if (thousandths < 0) text += '-';
  const long size = std::abs(thousandths);
  fmt::format_to(std::back_inserter(text), "{}", size / thousand);
  long part = size % thousand;
  if (part == 0) return;
  text += '.';
  for (long digit = thousand / 10; part > 0; part %= digit, digit /= 10) {
    text += static_cast<char>('0' + part / digit);
    if (digit == 1) return;
  }
}

std::string number(double value) {
  std::string text;
  put(text, value);
  return text;
}

std::string code_of(const Colour& colour) {
  const auto byte = [](double part) { return static_cast<unsigned>(std::lround(std::clamp(part, 0.0, 1.0) * 255)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour.red), byte(colour.green), byte(colour.blue));
}

std::string opacity_of(std::string_view what, double opacity) {
  return opacity < 1 ? fmt::format(" {}-opacity=\"{}\"", what, number(opacity)) : "";
}

std::string rectangle(const Area& area) {
  return fmt::format("x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", number(area.x), number(area.y), number(area.width),
                     number(area.height));
}

class SvgInk final : public Ink {
 public:
  SvgInk(const PictureOptions& options, OutputFile& file) : file_(file) {
    write(fmt::format(beginning, options.width, options.height));
  }

  void move_to(Spot spot) override {
    write(is_in_path_ ? "M" : "<path d=\"M");
    is_in_path_ = true;
    put_spot(spot);
  }
  // After M the next places are lines.
  void line_to(Spot spot) override {
    if (!is_in_path_) return move_to(spot);
    write(" ");
    put_spot(spot);
  }
  void close() override { write("z"); }

  void stroke(const Pen& pen) override {
    std::string dashes;
    for (const double length : pen.dashes) dashes += (dashes.empty() ? " stroke-dasharray=\"" : " ") + number(length);
    if (!dashes.empty()) dashes += '"';
    end_path(fmt::format("stroke=\"{}\" stroke-width=\"{}\"{}{}", code_of(pen.colour), number(pen.width),
                         opacity_of("stroke", pen.opacity), dashes));
  }
  void fill(const Colour& colour, double opacity, Rule rule) override {
    end_path(fmt::format("fill=\"{}\"{}{}", code_of(colour), opacity_of("fill", opacity),
                         rule == Rule::even_odd ? " fill-rule=\"evenodd\"" : ""));
  }

  void fill_with_speeds(const Area& area) override {
    std::string stops;
    for (std::size_t i = 0; i <= SpeedColours::classes; ++i) {
      const double share = static_cast<double>(i) / SpeedColours::classes;
      stops += fmt::format("<stop offset=\"{}\" stop-color=\"{}\"/>", number(share), code_of(SpeedColours::at(share)));
    }
    const unsigned id = ++ids_;
    write(fmt::format("<linearGradient id=\"s{}\">{}</linearGradient>\n<rect {} fill=\"url(#s{})\"/>\n", id, stops,
                      rectangle(area), id));
  }
  void disc(Spot centre, double radius, const Colour& colour) override {
    write(fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", number(centre.x), number(centre.y),
                      number(radius), code_of(colour)));
  }
  void image(const Area& area, PixelMap map) override {
    const auto png = png_of(std::move(map));
    if (!png) {
      if (status_) status_ = Failure{png.error()};
      return;
    }
    write(fmt::format("<image {} preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,{}\"/>\n",
                      rectangle(area), base64(*png)));
  }

  void text(Spot place, const std::string& text, const Font& font, Align align) override {
    const std::string_view anchor = align == Align::centre  ? " text-anchor=\"middle\""
                                    : align == Align::right ? " text-anchor=\"end\""
                                                            : "";
    write(fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"{}\"{}{} fill=\"{}\">{}</text>\n", number(place.x),
                      number(place.y), number(font.size), font.bold ? " font-weight=\"bold\"" : "", anchor,
                      code_of(font.colour), html_text(text)));
  }
  double text_width(const std::string& text, const Font& font) override {
    return width_of_letters(text, font.bold) * font.size;
  }

  void clip(const Area& area) override {
    const unsigned id = ++ids_;
    write(fmt::format("<clipPath id=\"c{}\"><rect {}/></clipPath>\n<g clip-path=\"url(#c{})\">\n", id, rectangle(area),
                      id));
  }
  void end_clip() override { write("</g>\n"); }

  Status<OutputError> finish() override {
    write("</svg>\n");
    return status_;
  }

 private:
  void write(std::string_view text) { file_.write(text); }
  void put_spot(Spot spot) {
    spot_.clear();
    put(spot_, spot.x);
    spot_ += ' ';
    put(spot_, spot.y);
    write(spot_);
  }
  void end_path(std::string_view look) {
    if (is_in_path_) write(fmt::format("\" {}/>\n", look));
    is_in_path_ = false;
  }

  OutputFile& file_;
  std::string spot_;
  bool is_in_path_ = false;
  unsigned ids_ = 0;
  Status<OutputError> status_ = Unit{};
};

}  // namespace

std::unique_ptr<Ink> svg_ink(const PictureOptions& options, OutputFile& file) {
  return std::make_unique<SvgInk>(options, file);
}

}  // namespace passo
