#include "import_context.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "passo/base/utf8.hpp"

namespace passo {
namespace {

constexpr std::size_t most_listed = 500;  // entries of one list of the report
constexpr std::size_t longest_shown = 80;

}  // namespace

const SourceNode* SourceNode::child(std::string_view wanted) const {
  const auto found = std::ranges::find(children, wanted, &SourceNode::name);
  return found == children.end() ? nullptr : &*found;
}

void ImportContext::mark_all(const SourceNode& node) {
  mark(node);
  for (const SourceNode& child : node.children) mark_all(child);
}

std::string ImportContext::printable(std::string_view text) {
  std::string result;
  while (!text.empty() && result.size() < longest_shown) {
    const CodePoint point = first_code_point(text);
    if (point.length == 0 || point.value < 0x20 || (point.value >= 0x7f && point.value < 0xa0)) {
      result += point.value == '\t' ? ' ' : '?';
    } else {
      result += text.substr(0, point.length);
    }
    text.remove_prefix(std::max<std::size_t>(point.length, 1));
  }
  return result;
}

std::optional<SourcedNumber> ImportContext::read(const SourceNode* node, std::string key, UnitFactor unit,
                                                 bool is_needed) {
  if (node == nullptr) return std::nullopt;
  mark(*node);
  std::string_view text = node->text;
  if (numbers_end_at_blanks_) text = text.substr(0, std::min(text.find_first_of(" \t#;"), text.size()));
  if (const auto number = DecimalNumber::parse(text)) {
    return SourcedNumber{number->scaled(unit.factor, unit.divisor), origin(*node, std::move(key))};
  }
  const ValueOrigin from = origin(*node, std::move(key));
  if (is_needed) {
    error("import.not-a-number", from, fmt::format("{} is \"{}\"", from.key, from.value),
          "a number with a decimal point, e.g. 250 or 0.5");
  } else {
    unmapped(from, "this is not a number");
  }
  return std::nullopt;
}

std::optional<SourcedNumber> ImportContext::number(const SourceNode* node, std::string key, UnitFactor unit) {
  return read(node, std::move(key), unit, true);
}

std::optional<SourcedNumber> ImportContext::optional_number(const SourceNode* node, std::string key, UnitFactor unit) {
  return read(node, std::move(key), unit, false);
}

std::optional<unsigned> ImportContext::mask(const SourceNode* node, std::string key) {
  if (node == nullptr) return std::nullopt;
  mark(*node);
  const auto number = DecimalNumber::parse(node->text);
  if (number && number->value() >= 0 && number->value() <= 65535) {
    const auto whole = static_cast<unsigned>(number->value());
    if (number->value() == whole) return whole;
  }
  unmapped(origin(*node, std::move(key)), "this is not a whole number from 0 to 65535");
  return std::nullopt;
}

void ImportContext::understood(const ValueOrigin& origin, std::string target) {
  const bool is_listed = std::ranges::any_of(result_.understood, [&](const UnderstoodValue& value) {
    return value.source == origin.key && value.target == target;
  });
  if (is_listed || result_.understood.size() >= most_listed) return;
  result_.understood.push_back({origin.key, origin.value, std::move(target), origin.line});
}

void ImportContext::unmapped(const ValueOrigin& origin, std::string reason) {
  const std::string key = printable(origin.key);
  const bool is_listed = std::ranges::any_of(result_.unmapped, [&](const UnmappedValue& value) {
    return value.source == key && value.line == origin.line && value.value == origin.value;
  });
  if (is_listed) return;
  if (result_.unmapped.size() > most_listed) return;
  if (result_.unmapped.size() == most_listed) {
    result_.unmapped.push_back({"...", "", "this list is cut off here", 0});
    return;
  }
  result_.unmapped.push_back({key, origin.value, std::move(reason), origin.line});
}

void ImportContext::unmapped(const SourceNode* node, std::string key, std::string reason) {
  if (node == nullptr) return;
  mark(*node);
  unmapped(origin(*node, std::move(key)), std::move(reason));
}

void ImportContext::assumed(std::string target, std::string reason) {
  result_.assumed.push_back({std::move(target), std::move(reason)});
}

std::string ImportContext::line_text(std::uint32_t line) const {
  std::string_view text = source_.text;
  for (; line > 1; --line) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  text = text.substr(0, text.find('\n'));
  if (text.ends_with('\r')) text.remove_suffix(1);
  return std::string(text.substr(0, std::size_t{1} << 16));
}

void ImportContext::error(const char* code, const ValueOrigin& origin, std::string message, std::string expected) {
  Diagnostic finding{.code = code,
                     .file = source_.file,
                     .place = {},
                     .message = std::move(message),
                     .expected = std::move(expected),
                     .text = {}};
  if (origin.line > 0) {
    finding.place = {.line = origin.line,
                     .column = std::max(origin.column, 1U),
                     .length = static_cast<std::uint32_t>(std::max<std::size_t>(origin.value.size(), 1))};
    finding.text = line_text(origin.line);
  }
  // Mach3 writes its file as one long line, of which only the beginning is kept.
  if (finding.place.column > finding.text.size() + 1) finding.text.clear();
  diagnostics_.add(std::move(finding));
}

void ImportContext::list_rest(const SourceNode& node, const std::string& path, std::string_view separator,
                              const std::string& reason) {
  for (const SourceNode& child : node.children) {
    if (done_.contains(&child)) continue;
    const std::string name = path.empty() ? child.name : fmt::format("{}{}{}", path, separator, child.name);
    if (child.children.empty()) {
      unmapped(&child, name, reason);
    } else {
      list_rest(child, name, separator, reason);
    }
  }
}

}  // namespace passo
