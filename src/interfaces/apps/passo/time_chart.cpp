#include "time_chart.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "passo/judge/check_page.hpp"
#include "passo/report/html.hpp"

namespace passo {
namespace {

constexpr double width = 1000;
constexpr double height = 100;

Seconds whole_of(const TimeChart& chart) {
  Seconds whole{0};
  for (const TimeChart::Value& value : chart.values) whole += value.time;
  return whole;
}

// The area below the values that are greater than `above`, as the data of a path.
std::string area_above(const TimeChart& chart, Seconds whole, double above) {
  std::string data;
  Seconds now{0};
  bool open = false;
  for (const TimeChart::Value& value : chart.values) {
    const double begin = width * (now / whole);
    now += value.time;
    const double end = width * (now / whole);
    const double y = height * (1 - std::min(value.value / chart.top, 1.0));
    if (!(value.value > above)) {
      if (open) data += fmt::format("V{:g}Z", height);
      open = false;
      continue;
    }
    if (!open) data += fmt::format("M{:.2f} {:g}", begin, height);
    open = true;
    data += fmt::format("V{:.2f}H{:.2f}", y, end);
  }
  if (open) data += fmt::format("V{:g}Z", height);
  return data;
}

}  // namespace

std::string to_html(const TimeChart& chart) {
  const Seconds whole = whole_of(chart);
  if (!(whole > Seconds(0)) || !(chart.top > 0)) return "";
  std::string html =
      fmt::format("<figure class=\"chart\"><figcaption>{}</figcaption>\n<div class=\"plot\">", html_text(chart.label));
  for (const double mark : chart.marks) {
    html += fmt::format("<span class=\"y\" style=\"bottom:{:.1f}%\">{:g}{}</span>", 100 * mark / chart.top, mark,
                        html_text(chart.unit));
  }
  html += fmt::format("<svg viewBox=\"0 0 {:g} {:g}\" preserveAspectRatio=\"none\" role=\"img\" aria-label=\"{}\">\n",
                      width, height, html_text(chart.label));
  html += fmt::format("<path class=\"fill\" d=\"{}\"/>\n", area_above(chart, whole, 0));
  if (chart.warns_above > 0) {
    html += fmt::format("<path class=\"warn\" d=\"{}\"/>\n", area_above(chart, whole, chart.warns_above));
  }
  for (const double mark : chart.marks) {
    const double y = height * (1 - mark / chart.top);
    html += fmt::format("<line x1=\"0\" x2=\"{:g}\" y1=\"{:.2f}\" y2=\"{:.2f}\"/>\n", width, y, y);
  }
  html += "</svg></div>\n<div class=\"times\">";
  constexpr int ticks = 4;
  for (int i = 0; i <= ticks; ++i) html += fmt::format("<span>{}</span>", clock_words(whole * i / ticks));
  return html + "</div></figure>\n";
}

}  // namespace passo
