// What the body of a request is: its type by the header, and its shape.
#include <algorithm>
#include <array>
#include <utility>

#include "api_json.hpp"
#include <fmt/format.h>

#include "passo/base/lower_case.hpp"

namespace passo {
namespace {

// "Text/Plain; charset=utf-8" → "text/plain"
std::string media_type(std::string_view header) {
  std::string type(header.substr(0, header.find(';')));
  std::erase_if(type, [](char c) { return c == ' ' || c == '\t'; });
  return lower_case(std::move(type));
}

// No type, text/plain, and the type that curl gives to any data, say nothing about a body.
bool says_nothing(std::string_view type) {
  return type.empty() || type == "text/plain" || type == "application/x-www-form-urlencoded";
}

bool is_json(std::string_view type) {
  return type == "application/json" || type == "text/json" || type.ends_with("+json");
}

bool fits(BodyKind kind, std::string_view type) {
  constexpr std::array<std::string_view, 4> of_programs = {"application/octet-stream", "text/x-gcode", "text/x.gcode",
                                                           "application/x-gcode"};
  switch (kind) {
    case BodyKind::none: return true;  // no byte, of whatever type
    case BodyKind::json: return says_nothing(type) || is_json(type);
    case BodyKind::program: return says_nothing(type) || std::ranges::find(of_programs, type) != of_programs.end();
    case BodyKind::table: return says_nothing(type) || type == "text/csv" || type == "application/octet-stream";
    case BodyKind::bytes: return !is_json(type) && !type.starts_with("multipart/");
  }
  return false;
}

std::string_view describe(BodyKind kind) {
  switch (kind) {
    case BodyKind::none: return "nothing";
    case BodyKind::json: return "JSON: application/json";
    case BodyKind::program: return "the text of a program: text/plain or application/octet-stream";
    case BodyKind::table: return "a table: text/csv";
    case BodyKind::bytes: return "the bytes of a file: application/octet-stream, or the type of the file";
  }
  return "";
}

// No program begins with a bracket. A body of a megabyte is parsed only where it does.
bool is_json_text(std::string_view body) {
  const std::size_t first = body.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || (body[first] != '{' && body[first] != '[')) return false;
  return Json::accept(body);
}

}  // namespace

Result<Json, WebAnswer> read_body(BodyKind kind, const WebRequest& request, std::optional<Json> said) {
  const std::string type = media_type(request.type);
  const auto wrong_type = [&](std::string_view what) {
    return Failure{
        error_answer(415, "http.wrong-type", fmt::format("the body is {}; expected {}", what, describe(kind)))};
  };
  if (!fits(kind, type)) return wrong_type(type.substr(0, 60));
  if (!said && request.body.empty()) return Json(Json::value_t::discarded);
  if (kind == BodyKind::program && is_json_text(request.body)) return wrong_type("JSON");
  if (kind != BodyKind::json && kind != BodyKind::none) return Json(Json::value_t::discarded);
  if (!said) said = Json::parse(request.body, nullptr, false);
  const bool is_empty = said->is_object() && said->empty();
  if (kind == BodyKind::none && !is_empty) return Failure{bad_body("this request has no body")};
  if (!said->is_object()) return Failure{bad_body("the body is not a JSON object")};
  return std::move(*said);
}

}  // namespace passo
