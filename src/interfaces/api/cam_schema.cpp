#include "cam_schema.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace passo {
namespace {

constexpr std::size_t longest_value = 200;

const char* kind_name(CamKind kind) {
  switch (kind) {
    case CamKind::drawings: return "drawings";
    case CamKind::flag: return "flag";
    case CamKind::choice: return "choice";
    case CamKind::place: return "place";
    case CamKind::file: return "file";
    case CamKind::text: return "text";
    case CamKind::length: return "length";
    case CamKind::feed: return "feed";
    case CamKind::number: return "number";
    case CamKind::degrees: return "degrees";
    case CamKind::percent: return "percent";
    case CamKind::turns: return "turns";
    case CamKind::removal: return "removal";
  }
  return "";
}

bool is_ordered(const CamOption& option) {
  return option.kind != CamKind::drawings && option.traits.matters_to != CamFor::command_line;
}

Json type_of(const CamOption& option) {
  if (option.kind == CamKind::flag) return "boolean";
  if (is_list(option)) return {"string", "array"};
  if (is_number(option.kind)) return {"number", "string"};
  if (option.kind == CamKind::length || option.kind == CamKind::feed) return {"string", "number"};
  return "string";
}

// A font's default is a file of this computer, which no order can name.
Json default_of(const CamOption& option) {
  if (option.kind == CamKind::flag || option.kind == CamKind::file) return nullptr;
  std::string text = text_of(option);
  if (text.empty()) text = option.traits.usual;
  if (text.empty()) return nullptr;
  return is_number(option.kind) ? Json::parse(text) : Json(text);
}

Json schema_of(const CamOption& option) {
  const CamTraits& traits = option.traits;
  std::string help(option.help);
  std::ranges::replace(help, '\n', ' ');
  Json schema = {{"type", type_of(option)}};
  if (is_list(option)) schema["items"] = {{"type", "string"}};
  for (const std::string_view choice : traits.choices) {
    schema[option.kind == CamKind::choice ? "enum" : "examples"].push_back(std::string(choice));
  }
  if (traits.range) {
    schema["minimum"] = traits.range->least;
    schema["maximum"] = traits.range->most;
  }
  if (const Json value = default_of(option); !value.is_null()) schema["default"] = value;
  schema["description"] = help;
  schema["x-kind"] = kind_name(option.kind);
  if (traits.matters_to == CamFor::experts) schema["x-for"] = "experts";
  if (traits.matters_to == CamFor::programs) schema["x-for"] = "programs";
  if (!traits.names.empty()) schema["x-names"] = std::string(traits.names);
  if (traits.is_of_job) schema["x-of-job"] = true;
  if (traits.is_of_machine) schema["x-of-machine"] = true;
  return schema;
}

// Lengths, names and numbers: 1/32in has a slash between digits, and no other value has one.
bool is_harmless(std::string_view value) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (value.size() > longest_value || value.find("..") != std::string_view::npos) return false;
  for (std::size_t i = 0; i < value.size(); ++i) {
    const char c = value[i];
    if (c == '/') {
      if (i == 0 || i + 1 == value.size() || !is_digit(value[i - 1]) || !is_digit(value[i + 1])) return false;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '\\') {
      return false;
    }
  }
  return true;
}

template <class List>
bool is_among(const List& list, std::string_view one) {
  return std::ranges::find(list, one) != std::ranges::end(list);
}

std::string expected_of(const CamOption& option) {
  const CamTraits& traits = option.traits;
  if (option.kind == CamKind::flag) return "true or false";
  if (option.kind == CamKind::choice) return fmt::format("one of {}", fmt::join(traits.choices, ", "));
  if (option.kind == CamKind::file) {
    std::vector<std::string_view> others = traits.choices;
    if (!traits.names.empty()) others.push_back(traits.names);
    return fmt::format("a file that was sent{}{}", others.empty() ? "" : ", or ", fmt::join(others, ", "));
  }
  if (traits.range) return fmt::format("a number from {:g} to {:g}", traits.range->least, traits.range->most);
  if (is_number(option.kind)) return "a number";
  return is_list(option) ? "a text, or a list of texts" : "a text or a number";
}

// A text is judged by the operation itself, which says what is wrong with it: a person may be typing it.
bool is_good(const CamOption& option, const Json& value, const std::vector<std::string>& files) {
  if (value.is_number()) {
    const auto& range = option.traits.range;
    const double number = value.get<double>();
    const bool fits = !range || (number >= range->least && number <= range->most);
    return option.kind != CamKind::choice && option.kind != CamKind::file && std::isfinite(number) && fits;
  }
  if (!value.is_string()) return false;
  const auto& text = value.get_ref<const std::string&>();
  if (text.empty()) return true;
  if (option.kind == CamKind::choice) return is_among(option.traits.choices, text);
  if (option.kind == CamKind::file && (is_among(files, text) || is_among(option.traits.choices, text))) return true;
  // The name has no extension and no folders, so it is not one of the daemon's files.
  if (option.kind == CamKind::file && (option.traits.names.empty() || text.find_first_of("./") != std::string::npos))
    return false;
  return is_harmless(text);
}

}  // namespace

Json schema_of(const CamOperation& operation) {
  Json schema = {{"type", "object"}, {"title", operation.name}, {"description", operation.purpose}};
  if (*operation.accepts != 0) schema["x-accepts"] = operation.accepts;
  const std::string_view instead = operation.instead_of_files;
  if (!instead.empty()) schema["x-instead-of-files"] = std::string(instead);
  for (const char* part : operation.parts) schema["x-parts"].push_back(part);
  schema["properties"] = Json::object();
  for (const CamOption& option : operation.options()) {
    if (option.kind == CamKind::drawings && option.traits.most_files > 0) {
      schema["x-most-files"] = option.traits.most_files;
    }
    if (is_ordered(option)) schema["properties"][std::string(option.name)] = schema_of(option);
  }
  schema["additionalProperties"] = false;
  return schema;
}

const CamOption* find_ordered(std::span<const CamOption> options, std::string_view name) {
  const CamOption* const option = find_option(options, name);
  return option != nullptr && is_ordered(*option) ? option : nullptr;
}

Result<std::vector<std::string>, std::string> ordered_values(const CamOption& option, const Json& value,
                                                             const std::vector<std::string>& files) {
  std::vector<std::string> texts;
  const Failure refusal{fmt::format("\"{}\": expected {}", option.name, expected_of(option))};
  if (option.kind == CamKind::flag) {
    if (!value.is_boolean()) return refusal;
    if (value.get<bool>()) texts.emplace_back();
    return texts;
  }
  if (value.is_array() && !is_list(option)) return refusal;
  for (const Json& one : value.is_array() ? value : Json::array({value})) {
    if (!is_good(option, one, files)) return refusal;
    const std::string text = one.is_number() ? fmt::format("{}", one.get<double>()) : one.get<std::string>();
    if (!text.empty()) texts.push_back(text);
  }
  return texts;
}

}  // namespace passo
