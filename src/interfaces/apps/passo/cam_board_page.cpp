#include "cam_board_page.hpp"

#include "check_style.hpp"
#include "html_page.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/judge/check_page.hpp"
#include "passo/report/html.hpp"

namespace passo {
namespace {

constexpr const char* picture_style =
    "figure { margin: 1rem 0; } figure svg { display: block; width: 100%; height: auto; background: var(--sheet); } "
    "figure img { max-width: 100%; height: auto; }";

std::string list_of(const std::vector<std::string>& items, const char* kind) {
  std::string html = fmt::format("<{}>", kind);
  for (const std::string& item : items) html += fmt::format("<li>{}</li>", html_text(item));
  return html + fmt::format("</{}>\n", kind);
}

std::string step_html(const BoardStep& step, std::size_t number) {
  std::string html = fmt::format("<section><h2>{}. {}</h2>\n", number, html_text(step.title));
  html += list_of(step.words, "ol");
  // A letter for each step makes the ids of the pictures differ.
  const std::string name(1, static_cast<char>('a' + static_cast<char>(number % 26)));
  std::string figure =
      step.picture.empty() ? "" : "<figure>" + inline_svg(step.picture, name, step.title) + "</figure>\n";
  if (!step.photo.empty()) figure += "<figure>" + inline_png(step.photo, step.title) + "</figure>\n";
  if (step.program.empty()) return html + figure + "</section>\n";
  html += fmt::format("<dl><div><dt>Program</dt><dd>{}</dd></div>", html_text(step.program));
  for (std::size_t i = 0; i < step.tools.size(); ++i) {
    html += fmt::format("<div><dt>Tool {}</dt><dd>{}</dd></div>", i + 1, html_text(step.tools[i]));
  }
  if (step.time) html += fmt::format("<div><dt>Time</dt><dd>{}</dd></div>", clock_words(*step.time));
  return html + "</dl>\n" + figure + fmt::format("<pre>{}</pre></section>\n", html_text(step.figures));
}

}  // namespace

std::string words_for(const BoardPageFile& file) {
  return fmt::format("{}: {} ({})", file.name, file.layer,
                     file.told_by == "you" ? "given with --as" : "from its " + file.told_by);
}

nlohmann::ordered_json to_json(const BoardPage& page) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const BoardPageFile& file : page.files) {
    files.push_back({{"file", file.name},
                     {"name", file.short_name},
                     {"layer", file.layer},
                     {"told_by", file.told_by},
                     {"drill_file", file.is_drill_file}});
  }
  nlohmann::ordered_json steps = nlohmann::ordered_json::array();
  for (const BoardStep& step : page.steps) {
    steps.push_back({{"step", step.kind},
                     {"title", step.title},
                     {"words", step.words},
                     {"program", step.program},
                     {"tools", step.tools},
                     {"figures", step.figures},
                     {"time_s", step.time ? nlohmann::ordered_json(step.time->value()) : nlohmann::ordered_json()}});
  }
  nlohmann::ordered_json json = {{"name", page.name},
                                 {"machine", page.machine},
                                 {"files", std::move(files)},
                                 {"left_out", page.left_out},
                                 {"board", {{"across_mm", page.width}, {"up_mm", page.height}}},
                                 {"margin_mm", page.margin},
                                 {"up", page.up},
                                 {"turn", page.turn},
                                 {"holes", page.holes},
                                 {"steps", std::move(steps)}};
  if (page.copies > 1) {
    json["copies"] = {{"count", page.copies}, {"across_mm", page.copy_width}, {"up_mm", page.copy_height}};
  }
  if (page.registration) {
    nlohmann::ordered_json holes = nlohmann::ordered_json::array();
    for (const auto& [x, y] : page.registration->holes) holes.push_back({{"x_mm", x}, {"y_mm", y}});
    json["registration"] = {{"holes", std::move(holes)}, {"axis_mm", page.registration->axis}};
  }
  return json;
}

std::string to_html(const BoardPage& page) {
  const std::string name = html_text(page.name);
  std::string html =
      html_page_begin(name + " \u2013 passo cam " + page.command, std::string(check_style) + picture_style);
  html += fmt::format("<header><h1>{}</h1>\n", name);
  html += !page.lead.empty() ? fmt::format("<p class=\"quiet\">{}</p></header>\n", html_text(page.lead))
          : page.machine.empty()
              ? "<p class=\"quiet\">Without a machine file (-m) the times are unknown.</p></header>\n"
              : fmt::format("<p class=\"quiet\">The times are those on {}.</p></header>\n", html_text(page.machine));
  for (std::size_t i = 0; i < page.steps.size(); ++i) html += step_html(page.steps[i], i + 1);
  std::vector<std::string> files;
  for (const BoardPageFile& file : page.files) files.push_back(words_for(file));
  html += "<section><h2>What was read</h2>\n" + list_of(files, "ul");
  if (!page.left_out.empty()) html += "<p>Ignored:</p>\n" + list_of(page.left_out, "ul");
  return html + "</section>\n" + html_page_end(fmt::format("All options: docs/manual/{}.md.", page.manual));
}

}  // namespace passo
