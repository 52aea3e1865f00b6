#include "json_source.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

constexpr std::size_t longest_key = 60;  // bytes, in messages

// RFC 6901, section 3. A key that is too long for a message is cut.
std::string pointer_token(const std::string& key) {
  std::string token;
  for (const char c : key.substr(0, longest_key)) {
    const auto byte = static_cast<unsigned char>(c);
    token += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, byte < 0x20U || byte == 0x7fU ? '?' : c);
  }
  return key.size() > longest_key ? token + "…" : token;
}

SourceLocation location_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, std::min(offset, text.size()));
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  return {.line = static_cast<std::uint32_t>(std::ranges::count(before, '\n') + 1),
          .column = static_cast<std::uint32_t>(before.size() - line_start + 1)};
}

std::string line_at(std::string_view text, std::size_t offset) {
  constexpr std::size_t longest = 2000;
  offset = std::min(offset, text.size());
  const std::size_t before = text.substr(0, offset).rfind('\n');
  const std::size_t start = before == std::string_view::npos ? 0 : before + 1;
  return std::string(text.substr(start, std::min(text.find('\n', offset), text.size()) - start).substr(0, longest));
}

class UnusedFinder {
 public:
  explicit UnusedFinder(const std::unordered_set<const JsonSource::Json*>& used) : used_(used) {}

  // The depth is limited by the reader.
  void look(const JsonSource::Json& value, const std::string& field, const std::string& place) {
    if (used_.contains(&value)) return;
    if (value.is_object() && !value.empty()) {
      for (const auto& [key, member] : value.items()) {
        const std::string token = "/" + pointer_token(key);
        look(member, field + token, place + token);
      }
    } else if (value.is_array() && !value.empty()) {
      for (std::size_t i = 0; i < value.size(); ++i) look(value[i], field + "/*", place + fmt::format("/{}", i));
    } else {
      count(field, place);
    }
  }
  std::vector<UnusedField> take() { return std::move(fields_); }

 private:
  void count(const std::string& field, const std::string& place) {
    const auto known = index_.find(field);
    if (known != index_.end()) {
      ++fields_[known->second].count;
    } else if (fields_.size() < ImportedTools::most_fields) {
      index_.emplace(field, fields_.size());
      fields_.push_back({.field = field, .count = 1, .first = place});
    }
  }

  const std::unordered_set<const JsonSource::Json*>& used_;
  std::map<std::string, std::size_t> index_;
  std::vector<UnusedField> fields_;
};

}  // namespace

std::optional<JsonSource> JsonSource::parse(std::string_view text, const std::string& file, Diagnostics& diagnostics) {
  const auto refuse = [&](std::string code, std::string message, std::string expected, std::size_t offset) {
    Diagnostic finding = of_file(std::move(code), file, std::move(message), std::move(expected));
    finding.place = location_of(text, offset);
    finding.text = line_at(text, offset);
    if (finding.place.column > finding.text.size() + 1) finding.text.clear();
    diagnostics.add(std::move(finding));
  };
  if (text.size() > largest) {
    diagnostics.add(of_file("tool-import.too-large", file, "the tool library is too large", "at most 16 MiB"));
    return std::nullopt;
  }
  JsonSource source;
  bool is_too_deep = false;
  const auto guard = [&](int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
    is_too_deep = is_too_deep || depth > deepest;
    return depth <= deepest;
  };
  try {
    source.root_ = Json::parse(text.begin(), text.end(), guard);
  } catch (const Json::parse_error& error) {
    refuse("tool-import.json", "the file is not valid JSON", "JSON as another program has exported it",
           error.byte > 0 ? error.byte - 1 : 0);
    return std::nullopt;
  } catch (const Json::exception&) {  // a number that is too large
    refuse("tool-import.json", "a number in the file is too large", "numbers as another program has exported them", 0);
    return std::nullopt;
  }
  if (is_too_deep) {
    refuse("tool-import.too-deep", "the JSON is nested too deeply", fmt::format("at most {} levels", deepest), 0);
    return std::nullopt;
  }
  return source;
}

const JsonSource::Json* JsonSource::find(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto member = object.find(key);
  return member == object.end() ? nullptr : &*member;
}

std::optional<double> JsonSource::number(const Json& object, const char* key) {
  const Json* const value = find(object, key);
  if (value == nullptr || !value->is_number()) return std::nullopt;
  const auto number = value->get<double>();
  if (!std::isfinite(number)) return std::nullopt;
  use(*value);
  return number;
}

std::optional<std::int32_t> JsonSource::tool_number(const Json& object, const char* key) {
  const auto value = number(object, key);
  const bool is_one = value && *value == std::floor(*value) && *value >= 0 && *value < 100'000;
  return is_one ? std::optional(static_cast<std::int32_t>(*value)) : std::nullopt;
}

std::optional<std::string> JsonSource::text(const Json& object, const char* key) {
  const Json* const value = find(object, key);
  if (value == nullptr || !value->is_string()) return std::nullopt;
  use(*value);
  return value->get<std::string>();
}

std::optional<bool> JsonSource::flag(const Json& object, const char* key) {
  const Json* const value = find(object, key);
  if (value == nullptr || !value->is_boolean()) return std::nullopt;
  use(*value);
  return value->get<bool>();
}

std::vector<UnusedField> JsonSource::unused() const {
  UnusedFinder finder(used_);
  finder.look(root_, "", "");
  return finder.take();
}

}  // namespace passo
