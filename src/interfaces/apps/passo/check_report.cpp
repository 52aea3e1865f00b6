#include "check_report.hpp"

#include <algorithm>
#include <cmath>

#include "check_style.hpp"
#include "html_page.hpp"
#include "time_chart.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"
#include "passo/base/sensible_number.hpp"
#include "passo/diagnostics/shown_location.hpp"
#include "passo/judge/link_delay_words.hpp"
#include "passo/machine_file/machine_kind.hpp"
#include "passo/report/html.hpp"
#include "passo/report/picture.hpp"
#include "passo/verdict/margin_words.hpp"

namespace passo {
namespace {

const char* unit_of(Axis axis) {
  return is_rotary(axis) ? "deg" : "mm";
}

// A table whose rows become blocks on a narrow screen. A heading that begins with '#' is that of numbers.
class HtmlTable {
 public:
  explicit HtmlTable(std::vector<std::string> headings) : headings_(std::move(headings)) {
    html_ = "<div class=\"table\"><table class=\"stack\"><thead><tr>";
    for (std::string& heading : headings_) {
      numbers_.push_back(heading.starts_with('#'));
      if (numbers_.back()) heading.erase(0, 1);
      html_ += fmt::format("<th{}>{}</th>", numbers_.back() ? " class=\"n\"" : "", heading);
    }
    html_ += "</tr></thead><tbody>\n";
  }
  // The cells are HTML.
  void row(const std::vector<std::string>& cells) {
    html_ += "<tr>";
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const char* const kind = numbers_[i] ? " class=\"n\"" : headings_[i].empty() ? " class=\"bars\"" : "";
      const std::string heading = headings_[i].empty() ? "" : fmt::format(" data-h=\"{}\"", headings_[i]);
      html_ += fmt::format("<td{}{}>{}</td>", kind, heading, cells[i]);
    }
    html_ += "</tr>\n";
    ++rows_;
  }
  std::string html() const { return rows_ > 0 ? html_ + "</tbody></table></div>\n" : ""; }

 private:
  std::vector<std::string> headings_;
  std::vector<bool> numbers_;
  std::string html_;
  std::size_t rows_ = 0;
};

const char* class_of(Verdict verdict) {
  if (verdict == Verdict::safe) return "good";
  return verdict == Verdict::doubtful ? "doubt" : "bad";
}

std::string badges(const CheckReport& report) {
  const auto badge = [](const char* kind, const std::string& words) {
    return fmt::format("<li class=\"{}\">{}</li>", kind, words);
  };
  const std::size_t errors = report.findings.errors();
  const std::size_t warnings = report.findings.all().size() - std::min(report.findings.all().size(), errors);
  std::string html = "<ul class=\"badges\">";
  html += errors == 0 ? badge("good", "no errors") : badge("bad", counted(errors, "error"));
  if (warnings > 0) html += badge("doubt", counted(warnings, "warning"));
  if (report.page != nullptr) {
    const Judgement& page = *report.page;
    html += page.knows_motors
                ? badge(class_of(page.margin.verdict), fmt::format("motors: {}", name_of(page.margin.verdict)))
                : badge("quiet", "motors: not described");
  }
  return html + "</ul>\n";
}

std::string figures(const CheckReport& report) {
  const Judgement& page = *report.page;
  std::string html = "<dl>";
  const auto add = [&html](const char* what, const std::string& value) {
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", what, value);
  };
  add("time in motion", clock_words(page.summary.cutting_time + page.summary.rapid_time));
  add("of it at feed", clock_words(page.summary.cutting_time));
  add("dwells", clock_words(page.summary.dwell_time));
  add("tool changes", fmt::format("{}", page.tool_changes));
  add("feed distance", fmt::format("{:.4g} m", page.summary.cutting_distance.value() / 1000));
  add("rapid distance", fmt::format("{:.4g} m", page.summary.rapid_distance.value() / 1000));
  const double turned = page.summary.cutting_turn + page.summary.rapid_turn;
  if (turned > 0) add("rotation of A B C only", fmt::format("{:.4g} deg", turned));
  html += "</dl>\n";
  if (page.line) html += fmt::format("<pre>{}</pre>\n", html_text(to_text(*page.line)));
  if (!report.waits.empty()) html += fmt::format("<p>Stops for the operator at {}.</p>\n", html_text(report.waits));
  return html;
}

std::string share_of(double value, double limit) {
  return limit > 0 ? fmt::format(" ({:.0f} %)", 100 * value / limit) : "";
}

std::string axes(const CheckReport& report) {
  HtmlTable table({"axis", "#way", "#travel", "#highest speed", "#of at most", "#highest acceleration", "#of at most"});
  for (const AxisSummary& moved : report.page->summary.axes) {
    const AxisDescription& axis = description_of(report.machine, moved.axis);
    const char* const unit = unit_of(moved.axis);
    const std::string letter(1, letter_of(moved.axis));
    const std::string travel = fmt::format("{:g} to {:g} {}", axis.travel_low, axis.travel_high, unit);
    if (!moved.machine_extents) {
      table.row({letter, "does not move", travel, "", "", "", ""});
      continue;
    }
    table.row({letter,
               fmt::format("{:.3f} to {:.3f} {}", moved.machine_extents->low, moved.machine_extents->high, unit),
               travel, fmt::format("{} {}/s", sensible_number(moved.peak_speed.value(), 4), unit),
               fmt::format("{:g}{}", axis.velocity.value(), share_of(moved.peak_speed.value(), axis.velocity.value())),
               fmt::format("{} {}/s\u00B2", sensible_number(moved.peak_acceleration.value(), 4), unit),
               fmt::format("{}{}", sensible_number(axis.acceleration.value(), 4),
                           share_of(moved.peak_acceleration.value(), axis.acceleration.value()))});
  }
  std::string html = "<h2>Axes</h2>\n" + table.html();
  for (const WorkSummary& work : report.page->summary.work) {
    const std::string feeds = feed_words(work, report.page->summary);
    if (!feeds.empty()) html += fmt::format("<p>{}: {} at feed</p>\n", name_of_system(work.system), feeds);
  }
  return html;
}

std::string bounds(const Judgement& page) {
  const Seconds whole = page.summary.cutting_time + page.summary.rapid_time;
  HtmlTable table({"limited by", "#first in line", "#of the time", ""});
  for (const SpeedShare& share : page.speed.shares) {
    const double percent = 100 * (share.time / whole);
    table.row({html_text(limit_words(share)), fmt::format("{}", share.first_line),
               percent < 0.5 ? "below 1 %" : fmt::format("{:.0f} %", percent),
               fmt::format("<span class=\"bar\" style=\"width:{:.1f}%\"></span>", percent)});
  }
  return table.html();
}

std::string parts(const char* title, const std::vector<SpeedPart>& parts, bool by_loss) {
  HtmlTable table({"line", "#speed, mm/min", "#programmed", by_loss ? "#lost" : "#time", "limited by"});
  for (const SpeedPart& part : parts) {
    if (by_loss && !part.is_slow()) continue;
    const MmPerSecond speed = by_loss ? part.mean() : part.highest;
    const char* const unit = part.turns ? " deg" : "";
    table.row({fmt::format("{}", part.line), fmt::format("{:.0f}{}", 60 * speed.value(), unit),
               part.rapid ? "rapid" : fmt::format("{:.0f}{}", 60 * part.programmed.value(), unit),
               fmt::format("{:.2g} s", (by_loss ? part.lost : part.time).value()), describe(part.bound)});
  }
  const std::string html = table.html();
  return html.empty() ? "" : fmt::format("<h3>{}</h3>\n", title) + html;
}

std::string speed_chart(const CheckReport& report) {
  TimeChart chart{
      .label = "Speed along the program, in mm/min, or in degrees/min where only A B C move", .values = {}, .unit = ""};
  double most = 0;
  for (const LoadTrack::Stretch& stretch : report.track.stretches()) {
    chart.values.push_back({stretch.time, 60 * stretch.mean_speed().value()});
    most = std::max(most, chart.values.back().value);
  }
  if (!(most > 0)) return "";
  const double unit = std::pow(10.0, std::floor(std::log10(most)));
  const double step = most / unit < 2 ? unit / 2 : most / unit < 5 ? unit : 2 * unit;
  chart.top = 1.04 * most;
  for (double mark = 0; mark <= most; mark += step) chart.marks.push_back(mark);
  return to_html(chart);
}

std::string speed(const CheckReport& report) {
  const Judgement& page = *report.page;
  return "<h2>Speed, and what limits it</h2>\n" + speed_chart(report) + bounds(page) +
         parts("Slowest lines: the most time lost against the programmed feed", page.speed.slowest, true) +
         parts("Fastest lines", page.speed.fastest, false);
}

std::string margin_chart(const CheckReport& report) {
  TimeChart chart{
      .label = "Torque needed along the program, in % of the guaranteed torque", .values = {}, .unit = "\u00A0%"};
  double most = 0;
  for (const LoadTrack::Stretch& stretch : report.track.stretches()) {
    chart.values.push_back({stretch.time, 100 * stretch.load});
    most = std::max(most, chart.values.back().value);
  }
  chart.top = std::clamp(1.04 * most, 110.0, 205.0);
  chart.marks = {0, 50, 100};
  if (chart.top > 150) chart.marks.push_back(150);
  if (chart.top > 200) chart.marks.push_back(200);
  chart.warns_above = 100 * (1 - MarginSurvey::usual_reserve);
  return to_html(chart);
}

std::string view(const CheckReport& report, PictureView which, const char* name, const char* label) {
  // A page with tens of thousands of lines in it opens slowly, so a dense path becomes pixels.
  constexpr std::size_t most_drawn = 25'000;
  const bool dense = report.path.vertices().size() > most_drawn;
  PictureOptions options{.format = dense ? PictureFormat::png : PictureFormat::svg, .program = "", .machine = ""};
  options.colour = report.page->knows_motors ? PathColour::margin : PathColour::speed;
  options.width = 480;
  options.height = 460;
  options.pixels_per_unit = 3;
  options.is_lathe = is_lathe(report.machine);
  std::string bytes;
  OutputFile file = OutputFile::into(bytes);
  if (!draw_view(report.path, which, options, file) || !file.commit()) return "";
  return "<figure>" + (dense ? inline_png(bytes, label) : inline_svg(bytes, name, label)) + "</figure>\n";
}

std::string pictures(const CheckReport& report) {
  if (report.path.empty()) return "";
  const char* const title = report.page->knows_motors ? "The toolpath, darker where the torque margin is small"
                                                      : "The toolpath, darker where the tool is faster";
  return fmt::format("<h2>{}</h2>\n<div class=\"views\">\n", title) +
         view(report, PictureView::isometric, "iso", "The toolpath from the front, the right and above") +
         view(report, PictureView::flat, "flat", "The toolpath in one view") + "</div>\n";
}

std::string motors(const CheckReport& report) {
  const Judgement& page = *report.page;
  std::string html = "<h2>Motors</h2>\n";
  if (!page.knows_motors) {
    return html +
           "<p>The machine file has no motor data (<code>[axis.X.torque]</code>), so the torque is not checked.</p>\n";
  }
  html += margin_chart(report);
  HtmlTable worst({"axis", "verdict", "worst moment", "line"});
  const auto verdict = [](const MarginSpot& spot) {
    return fmt::format("<span class=\"{}\">{}</span>", class_of(spot.verdict), name_of(spot.verdict));
  };
  for (const AxisMargin& axis : page.margin.axes) {
    const std::string letter(1, letter_of(axis.axis));
    if (axis.worst) {
      worst.row({letter, verdict(*axis.worst), html_text(cause_of(*axis.worst)), fmt::format("{}", axis.worst->line)});
    } else {
      worst.row({letter, "", "does not move", ""});
    }
  }
  html += worst.html();
  HtmlTable lines({"line", "verdict", "cause", "cure"});
  for (const MarginSpot& spot : page.margin.worst) {
    if (spot.verdict == Verdict::safe) break;
    lines.row({fmt::format("{}", spot.line), verdict(spot), html_text(cause_of(spot)), html_text(cure_of(spot))});
  }
  const std::string list = lines.html();
  return list.empty() ? html : html + "<h3>Worst lines</h3>\n" + list;
}

// The line of the program with the wrong words marked. Of a very long line only what is around them.
std::string marked_line(const Diagnostic& finding) {
  constexpr std::size_t around = 120;
  const std::string& text = finding.text;
  if (text.empty()) return "";
  const std::size_t begin = std::min<std::size_t>(std::max(finding.place.column, 1U) - 1, text.size());
  const std::size_t end = std::min(begin + std::min<std::size_t>(finding.place.length, around), text.size());
  const std::size_t from = begin > around ? begin - around : 0;
  const std::size_t to = std::min(end + around, text.size());
  return fmt::format("<pre>{}{}<mark>{}</mark>{}{}</pre>", from > 0 ? "\u2026" : "",
                     html_text(text.substr(from, begin - from)), html_text(text.substr(begin, end - begin)),
                     html_text(text.substr(end, to - end)), to < text.size() ? "\u2026" : "");
}

std::string findings(const CheckReport& report) {
  if (report.findings.all().empty()) return "";
  std::string html = "<h2>Findings</h2>\n<ul class=\"findings\">\n";
  for (const Diagnostic& finding : report.findings.all()) {
    const bool is_error = finding.severity == Severity::error;
    html += fmt::format("<li class=\"{}\"><b>{}{}</b>: {} <code>[{}]</code>{}", is_error ? "error" : "warning",
                        is_error ? "error" : "warning",
                        finding.place.line > 0 ? fmt::format(", line {}", finding.place.line) : "",
                        html_text(finding.message), html_text(finding.code), marked_line(finding));
    if (!finding.expected.empty()) html += fmt::format("expected: {}", html_text(finding.expected));
    if (!finding.more_lines.empty()) html += fmt::format("<br>{}", more_lines_in_words(finding));
    html += "</li>\n";
  }
  return html + "</ul>\n";
}

}  // namespace

std::string to_html(const CheckReport& report) {
  const std::string name = html_text(report.program);
  std::string html = html_page_begin(name + " \u2013 passo check", check_style);
  html +=
      fmt::format("<header><h1>{}</h1>\n<p class=\"quiet\">checked for {}</p>\n", name, html_text(report.machine.name));
  html += badges(report) + "</header>\n";
  if (report.page != nullptr) html += figures(report);
  html += findings(report);
  if (report.page != nullptr) html += axes(report) + speed(report) + motors(report) + pictures(report);
  return html + html_page_end("What each part means: docs/manual/checking.md.");
}

}  // namespace passo
