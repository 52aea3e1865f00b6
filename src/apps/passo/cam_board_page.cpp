#include "cam_board_page.hpp"

#include "check_style.hpp"
#include "html_page.hpp"
#include <fmt/format.h>

#include "passo/report/html.hpp"

namespace passo {
namespace {

constexpr const char* picture_style =
    "figure { margin: 1rem 0; } figure svg { display: block; width: 100%; height: auto; background: var(--sheet); }";

std::string list_of(const std::vector<std::string>& items, const char* kind) {
  std::string html = fmt::format("<{}>", kind);
  for (const std::string& item : items) html += fmt::format("<li>{}</li>", html_text(item));
  return html + fmt::format("</{}>\n", kind);
}

std::string step_html(const BoardStep& step, std::size_t number) {
  std::string html = fmt::format("<section><h2>{}. {}</h2>\n", number, html_text(step.title));
  html += list_of(step.words, "ol");
  if (step.program.empty()) return html + "</section>\n";
  html += fmt::format("<dl><div><dt>Program</dt><dd>{}</dd></div>", html_text(step.program));
  for (std::size_t i = 0; i < step.tools.size(); ++i) {
    html += fmt::format("<div><dt>Tool {}</dt><dd>{}</dd></div>", i + 1, html_text(step.tools[i]));
  }
  if (!step.time.empty()) html += fmt::format("<div><dt>Time</dt><dd>{}</dd></div>", html_text(step.time));
  html += "</dl>\n";
  // A letter for each step makes the ids of the pictures differ.
  const std::string name(1, static_cast<char>('a' + static_cast<char>(number % 26)));
  if (!step.picture.empty()) html += "<figure>" + inline_svg(step.picture, name, step.title) + "</figure>\n";
  return html + fmt::format("<pre>{}</pre></section>\n", html_text(step.figures));
}

}  // namespace

std::string to_html(const BoardPage& page) {
  const std::string name = html_text(page.name);
  std::string html = html_page_begin(name + " \u2013 passo cam board", std::string(check_style) + picture_style);
  html += fmt::format("<header><h1>{}</h1>\n", name);
  html += page.machine.empty()
              ? "<p class=\"quiet\">Without a machine file (-m) the times are unknown.</p></header>\n"
              : fmt::format("<p class=\"quiet\">The times are those on {}.</p></header>\n", html_text(page.machine));
  for (std::size_t i = 0; i < page.steps.size(); ++i) html += step_html(page.steps[i], i + 1);
  html += "<section><h2>What was read</h2>\n" + list_of(page.files, "ul");
  if (!page.left_out.empty()) html += "<p>Left out:</p>\n" + list_of(page.left_out, "ul");
  return html + "</section>\n" + html_page_end("Every option: docs/manual/circuit-boards.md.");
}

}  // namespace passo
