#include "grade_page.hpp"

#include <map>

#include "check_style.hpp"
#include "html_page.hpp"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/base/utf8.hpp"
#include "passo/report/html.hpp"

namespace passo {
namespace {

constexpr const char* grade_style =
    ".fault { overflow-wrap: anywhere; } details { margin: .4rem 0; } summary { cursor: pointer; padding: .3rem 0; }";

std::string printable(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const CodePoint point = first_code_point(text);
    const std::size_t length = std::max<std::size_t>(point.length, 1);
    const bool is_control = point.value < 0x20 || (point.value >= 0x7f && point.value < 0xa0);
    if (point.length == 0) {
      clean += "\uFFFD";
    } else {
      clean += is_control ? std::string_view(" ") : text.substr(0, length);
    }
    text.remove_prefix(length);
  }
  return clean;
}

std::string mark_words(const Grade& grade) {
  return fmt::format("{} of {} ({:.0f} %)", grade.right(), grade.cases, grade.mark());
}

// A spreadsheet would calculate a cell that begins like a formula.
std::string cell(std::string text) {
  if (!text.empty() && std::string_view("=+-@").find(text[0]) != std::string_view::npos) text.insert(0, "'");
  if (text.find_first_of(",\"\n;") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted += letter == '"' ? std::string("\"\"") : std::string(1, letter);
  return quoted + "\"";
}

const char* class_of_mark(const Grade& grade) {
  if (grade.cases > 0 && grade.right() == grade.cases) return "good";
  return grade.right() > 0 ? "doubt" : "bad";
}

std::string summary_html(const GradePage& page) {
  std::string html =
      "<div class=\"table\"><table class=\"stack\"><thead><tr><th>student</th><th class=\"n\">right</th>"
      "<th class=\"n\">mark</th><th>first fault</th></tr></thead><tbody>\n";
  for (const Grade& grade : page.grades) {
    const std::string fault = grade.first_fault();
    html += fmt::format(
        "<tr><td data-h=\"student\">{}</td><td class=\"n\" data-h=\"right\">{} of {}</td><td class=\"n {}\" "
        "data-h=\"mark\">{:.0f} %</td><td class=\"fault\" data-h=\"first fault\">{}</td></tr>\n",
        html_text(grade.student), grade.right(), grade.cases, class_of_mark(grade), grade.mark(),
        fault.empty() ? "none" : html_text(fault));
  }
  return html + "</tbody></table></div>\n";
}

// How many students have each case right: what a class has not understood.
std::string cases_html(const GradePage& page) {
  struct Count {
    std::size_t right = 0;
    std::size_t played = 0;
    std::string why;
  };
  std::vector<std::string> order;
  std::map<std::string, Count> counts;
  for (const Grade& grade : page.grades) {
    for (const CaseGrade& one : grade.played) {
      const auto [place, is_new] = counts.try_emplace(one.name);
      if (is_new) order.push_back(one.name);
      ++place->second.played;
      if (one.is_right) ++place->second.right;
      place->second.why = one.why;
    }
  }
  if (order.empty()) return "";
  std::string html =
      "<h2>Cases</h2>\n<div class=\"table\"><table class=\"stack\"><thead><tr><th>case</th>"
      "<th>what it is about</th><th class=\"n\">right</th><th></th></tr></thead><tbody>\n";
  for (const std::string& name : order) {
    const Count& count = counts[name];
    html += fmt::format(
        "<tr><td data-h=\"case\">{}</td><td data-h=\"about\">{}</td><td class=\"n\" data-h=\"right\">{} of {}</td><td "
        "class=\"bars\"><span class=\"bar\" style=\"width:{:.1f}%\"></span></td></tr>\n",
        html_text(name), html_text(count.why), count.right, count.played,
        100.0 * static_cast<double>(count.right) / static_cast<double>(count.played));
  }
  return html + "</tbody></table></div>\n";
}

std::string student_html(const Grade& grade, bool is_open) {
  std::string html =
      fmt::format("<details{}><summary>{}: <span class=\"{}\">{}</span></summary>\n", is_open ? " open" : "",
                  html_text(grade.student), class_of_mark(grade), mark_words(grade));
  if (!grade.program.empty()) html += fmt::format("<p>Program: <code>{}</code></p>\n", html_text(grade.program));
  if (!grade.trouble.empty()) html += fmt::format("<p class=\"bad\">{}</p>\n", html_text(grade.trouble));
  if (!grade.remark.empty()) html += fmt::format("<p class=\"quiet\">{}</p>\n", html_text(grade.remark));
  html += "<ul class=\"findings\">";
  for (const CaseGrade& one : grade.played) {
    if (one.is_right) continue;
    html += fmt::format("<li class=\"error\">{}", html_text(one.fault));
    if (!one.why.empty()) html += fmt::format("<br><span class=\"quiet\">{}</span>", html_text(one.why));
    html += "</li>\n";
  }
  return html + "</ul></details>\n";
}

nlohmann::ordered_json as_json(const CaseGrade& one) {
  nlohmann::ordered_json json = {{"case", one.name}, {"right", one.is_right}};
  if (!one.why.empty()) json["why"] = one.why;
  if (one.is_right) return json;
  json["fault"] = one.fault;
  if (!one.output.empty()) {
    json["output"] = one.output;
    json["change"] = one.pulse;
    json["time_s"] = one.at;
  } else if (one.pulse > 0) {
    json["pulse"] = one.pulse;
  }
  json["expected"] = one.expected;
  json["found"] = one.found;
  return json;
}

}  // namespace

void make_printable(Grade& grade) {
  for (std::string* text : {&grade.student, &grade.program, &grade.trouble, &grade.remark}) *text = printable(*text);
  for (CaseGrade& one : grade.played) {
    for (std::string* text : {&one.fault, &one.expected, &one.found}) *text = printable(*text);
  }
}

std::string to_text(const GradePage& page) {
  std::string text;
  for (const Grade& grade : page.grades) {
    text += fmt::format("{}: {}\n", grade.student, mark_words(grade));
    if (!grade.trouble.empty()) text += fmt::format("  {}\n", grade.trouble);
    if (!grade.remark.empty()) text += fmt::format("  {}\n", grade.remark);
    for (const CaseGrade& one : grade.played) {
      if (one.is_right) continue;
      text += fmt::format("  {}\n", one.fault);
      if (page.is_class) break;  // the others are in the report
      if (!one.why.empty()) text += fmt::format("    {}: {}\n", one.name, one.why);
    }
  }
  return text;
}

std::string to_csv(const GradePage& page) {
  std::string csv = "student,program,right,cases,mark_percent,first_fault,remark\n";
  for (const Grade& grade : page.grades) {
    csv += fmt::format("{},{},{},{},{:.1f},{},{}\n", cell(grade.student), cell(grade.program), grade.right(),
                       grade.cases, grade.mark(), cell(grade.first_fault()), cell(grade.remark));
  }
  return csv;
}

std::string to_json(const GradePage& page) {
  nlohmann::ordered_json students = nlohmann::ordered_json::array();
  for (const Grade& grade : page.grades) {
    nlohmann::ordered_json played = nlohmann::ordered_json::array();
    for (const CaseGrade& one : grade.played) played.push_back(as_json(one));
    students.push_back({{"student", grade.student},
                        {"program", grade.program},
                        {"right", grade.right()},
                        {"cases", grade.cases},
                        {"mark_percent", grade.mark()},
                        {"first_fault", grade.first_fault()},
                        {"remark", grade.remark},
                        {"played", std::move(played)}});
  }
  const nlohmann::ordered_json json = {{"graded", page.title}, {"students", std::move(students)}};
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string to_html(const GradePage& page) {
  std::string html = html_page_begin("Marks \u2013 passo grade", std::string(check_style) + grade_style);
  std::size_t all_right = 0;
  double marks = 0;
  for (const Grade& grade : page.grades) {
    if (grade.cases > 0 && grade.right() == grade.cases) ++all_right;
    marks += grade.mark();
  }
  html += fmt::format(
      "<h1>{}</h1>\n<dl><div><dt>students</dt><dd>{}</dd></div><div><dt>all cases right</dt><dd>{}</dd></div>",
      html_text(page.title), page.grades.size(), all_right);
  if (!page.grades.empty()) {
    html +=
        fmt::format("<div><dt>mean mark</dt><dd>{:.0f} %</dd></div>", marks / static_cast<double>(page.grades.size()));
  }
  html += "</dl>\n<h2>Marks</h2>\n" + summary_html(page) + cases_html(page) + "<h2>Faults</h2>\n";
  for (const Grade& grade : page.grades) html += student_html(grade, page.grades.size() == 1);
  return html + html_page_end("The manual, grading.md, describes the cases.");
}

}  // namespace passo
