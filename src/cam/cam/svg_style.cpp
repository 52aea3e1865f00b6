#include "svg_style.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <tuple>

#include "svg_document.hpp"

#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

constexpr std::string_view css_blanks = " \t\r\n\f";
constexpr std::size_t most_css_selectors = 20'000;
constexpr std::size_t most_css_work = 50'000'000;  // compounds compared with elements
constexpr int deepest_css_block = 4;

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

bool is_name_letter(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
         (static_cast<unsigned char>(c) & 0x80U) != 0;
}

// The text without CSS comments and without HTML comment marks.
std::string without_css_comments(std::string_view css) {
  std::string text;
  while (!css.empty()) {
    if (css.starts_with("/*")) {
      const std::size_t end = css.find("*/", 2);
      css.remove_prefix(end == std::string_view::npos ? css.size() : end + 2);
      text += ' ';
    } else if (css.starts_with("<!--") || css.starts_with("-->")) {
      css.remove_prefix(css.front() == '<' ? 4 : 3);
    } else {
      text += css.front();
      css.remove_prefix(1);
    }
  }
  return text;
}

// Returns the position of the first of these characters outside of strings and other brackets.
std::size_t find_css(std::string_view text, std::string_view wanted) {
  char quote = 0;
  int round = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '\\') {
      ++i;
    } else if (quote != 0) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '(') {
      ++round;
    } else if (c == ')') {
      round = std::max(0, round - 1);
    } else if (round == 0 && wanted.find(c) != std::string_view::npos) {
      return i;
    }
  }
  return std::string_view::npos;
}

// Returns the position of the brace that closes the block, or the end of the text.
std::size_t end_of_css_block(std::string_view text) {
  int depth = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t next = find_css(text.substr(at), "{}");
    if (next == std::string_view::npos) break;
    at += next;
    if (text[at] == '{') ++depth;
    if (text[at] == '}' && --depth < 0) return at;
    ++at;
  }
  return text.size();
}

// Reads the compounds of a selector from left to right.
class CssSelectorReader {
 public:
  explicit CssSelectorReader(std::string_view text) : rest_(text) {}

  // Empty: an unsupported selector.
  std::optional<std::vector<CssCompound>> read() {
    constexpr std::size_t most_compounds = 32;
    std::vector<CssCompound> compounds;
    bool is_child = false;
    while (!rest_.empty() && compounds.size() < most_compounds) {
      CssCompound compound{.is_child = is_child};
      if (!read_compound(compound)) return std::nullopt;
      compounds.push_back(std::move(compound));
      const std::size_t next = rest_.find_first_not_of(css_blanks);
      rest_ = next == std::string_view::npos ? std::string_view() : rest_.substr(next);
      is_child = rest_.starts_with('>');
      if (!is_child) continue;
      rest_.remove_prefix(1);
      rest_ = trimmed(rest_, css_blanks);
      if (rest_.empty()) return std::nullopt;
    }
    if (compounds.empty() || !rest_.empty()) return std::nullopt;
    return compounds;
  }

 private:
  std::string name() {
    std::size_t size = 0;
    while (size < rest_.size() && is_name_letter(rest_[size])) ++size;
    std::string found(rest_.substr(0, size));
    rest_.remove_prefix(size);
    return found;
  }

  bool read_compound(CssCompound& compound) {
    bool is_any = false;
    if (rest_.starts_with('*')) {
      rest_.remove_prefix(1);
      is_any = true;
    } else {
      compound.type = name();
    }
    while (!rest_.empty() && (rest_.front() == '.' || rest_.front() == '#' || rest_.front() == '[')) {
      const char kind = rest_.front();
      rest_.remove_prefix(1);
      if (kind == '[') {
        if (!read_attribute(compound)) return false;
        continue;
      }
      std::string found = name();
      if (found.empty()) return false;
      if (kind == '.') {
        compound.classes.push_back(std::move(found));
      } else if (compound.id.empty() || compound.id == found) {
        compound.id = std::move(found);
      } else {
        return false;
      }
    }
    const bool has_any = is_any || !compound.type.empty() || !compound.id.empty() || !compound.classes.empty() ||
                         !compound.attributes.empty();
    const bool ends = rest_.empty() || rest_.front() == '>' || css_blanks.find(rest_.front()) != std::string_view::npos;
    return has_any && ends;
  }

  bool read_attribute(CssCompound& compound) {
    const std::size_t end = rest_.find(']');
    if (end == std::string_view::npos) return false;
    std::string_view inside = rest_.substr(0, end);
    rest_.remove_prefix(end + 1);
    CssCompound::Attribute attribute;
    const std::size_t equals = inside.find('=');
    if (equals != std::string_view::npos) {
      std::string_view value = trimmed(inside.substr(equals + 1), css_blanks);
      inside = inside.substr(0, equals);
      attribute.match = '=';
      if (!inside.empty() && std::string_view("~^$*|").find(inside.back()) != std::string_view::npos) {
        attribute.match = inside.back();
        inside.remove_suffix(1);
      }
      if (value.size() > 1 && (value.front() == '"' || value.front() == '\'') && value.back() == value.front()) {
        value = value.substr(1, value.size() - 2);
      }
      attribute.value = value;
    }
    attribute.name = trimmed(inside, css_blanks);
    const bool is_good = std::ranges::all_of(attribute.name, [](char c) { return is_name_letter(c) || c == ':'; }) &&
                         !attribute.name.empty() && attribute.match != '|';
    compound.attributes.push_back(std::move(attribute));
    return is_good;
  }

  std::string_view rest_;
};

bool has_word(std::string_view words, std::string_view word) {
  while (!words.empty()) {
    const std::string_view one = words.substr(0, words.find_first_of(css_blanks));
    if (one == word) return true;
    words.remove_prefix(std::min(words.size(), one.size() + 1));
  }
  return false;
}

bool matches_attribute(const CssCompound::Attribute& attribute, const SvgElement& element) {
  const bool exists =
      std::ranges::any_of(element.attributes, [&](const auto& one) { return one.first == attribute.name; });
  const std::string_view found = element.attribute(attribute.name);
  switch (attribute.match) {
    case 0: return exists;
    case '=': return exists && found == attribute.value;
    case '~': return has_word(found, attribute.value);
    case '^': return !attribute.value.empty() && found.starts_with(attribute.value);
    case '$': return !attribute.value.empty() && found.ends_with(attribute.value);
    default: return !attribute.value.empty() && found.find(attribute.value) != std::string_view::npos;
  }
}

}  // namespace

bool is_drawn_property(std::string_view property) {
  constexpr std::string_view all[] = {"display",
                                      "visibility",
                                      "clip-path",
                                      "clip-rule",
                                      "mask",
                                      "marker",
                                      "marker-start",
                                      "marker-mid",
                                      "marker-end",
                                      "overflow",
                                      "transform",
                                      "transform-origin",
                                      "transform-box",
                                      "x",
                                      "y",
                                      "width",
                                      "height",
                                      "cx",
                                      "cy",
                                      "r",
                                      "rx",
                                      "ry"};
  return std::ranges::find(all, property) != std::end(all);
}

// Colours select shapes, but do not change them.
bool is_paint(std::string_view property) {
  return property == "stroke" || property == "fill";
}

bool is_css_word(std::string_view value, std::string_view word) {
  return std::ranges::equal(value, word, {}, [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
}

std::vector<CssDeclaration> css_declarations(std::string_view text) {
  std::vector<CssDeclaration> all;
  while (!text.empty()) {
    const std::string_view one = text.substr(0, find_css(text, ";"));
    text.remove_prefix(std::min(text.size(), one.size() + 1));
    const std::size_t colon = one.find(':');
    if (colon == std::string_view::npos) continue;
    CssDeclaration declaration{.property = in_small_letters(trimmed(one.substr(0, colon), css_blanks)), .value = {}};
    std::string_view value = trimmed(one.substr(colon + 1), css_blanks);
    constexpr std::string_view important = "important";
    const std::size_t mark = value.rfind('!');
    if (mark != std::string_view::npos && is_css_word(trimmed(value.substr(mark + 1), css_blanks), important)) {
      declaration.is_important = true;
      value = trimmed(value.substr(0, mark), css_blanks);
    }
    declaration.value = value;
    const bool is_kept = is_drawn_property(declaration.property) || is_paint(declaration.property);
    if (is_kept && !value.empty()) all.push_back(std::move(declaration));
  }
  return all;
}

void SvgStyleSheet::add(std::string_view css) {
  add_rules(without_css_comments(css), 0);
}

void SvgStyleSheet::add_rules(std::string_view css, int depth) {
  while (!(css = trimmed(css, css_blanks)).empty()) {
    const bool is_at_rule = css.front() == '@';
    const std::size_t open = find_css(css, is_at_rule ? "{;" : "{");
    if (open == std::string_view::npos) return;
    const std::string_view prelude = trimmed(css.substr(0, open), css_blanks);
    const bool has_block = css[open] == '{';
    css.remove_prefix(open + 1);
    if (!has_block) {
      if (is_css_word(prelude.substr(0, 7), "@import")) ++skipped_;
      continue;
    }
    const std::size_t end = end_of_css_block(css);
    const std::string_view block = css.substr(0, end);
    css.remove_prefix(std::min(css.size(), end + 1));
    if (!is_at_rule) {
      add_rule(prelude, block);
    } else if (is_css_word(prelude.substr(0, 6), "@media") && depth < deepest_css_block) {
      const std::string media = in_small_letters(trimmed(prelude.substr(6), css_blanks));
      if (media.empty() || media == "all" || media == "screen") {
        add_rules(block, depth + 1);
      } else if (media != "print") {
        ++skipped_;
      }
    }
  }
}

void SvgStyleSheet::add_rule(std::string_view selectors, std::string_view declarations) {
  std::vector<CssDeclaration> kept = css_declarations(declarations);
  if (kept.empty()) return;
  const bool is_drawn = std::ranges::any_of(kept, is_drawn_property, &CssDeclaration::property);
  rules_.push_back(std::move(kept));
  while (!selectors.empty()) {
    const std::string_view one = selectors.substr(0, find_css(selectors, ","));
    selectors.remove_prefix(std::min(selectors.size(), one.size() + 1));
    auto compounds = CssSelectorReader(trimmed(one, css_blanks)).read();
    if (!compounds || selectors_.size() >= most_css_selectors) {
      skipped_ += is_drawn ? 1 : 0;
      continue;
    }
    Selector selector{.compounds = std::move(*compounds), .rule = rules_.size() - 1};
    for (const CssCompound& compound : selector.compounds) {
      selector.specificity[0] += compound.id.empty() ? 0 : 1;
      selector.specificity[1] += static_cast<std::uint32_t>(compound.classes.size() + compound.attributes.size());
      selector.specificity[2] += compound.type.empty() ? 0 : 1;
    }
    const CssCompound& last = selector.compounds.back();
    const auto index = static_cast<std::uint32_t>(selectors_.size());
    if (!last.id.empty()) {
      by_id_[last.id].push_back(index);
    } else if (!last.classes.empty()) {
      by_class_[last.classes.front()].push_back(index);
    } else if (!last.type.empty()) {
      by_type_[last.type].push_back(index);
    } else {
      universal_.push_back(index);
    }
    selectors_.push_back(std::move(selector));
  }
}

bool SvgStyleSheet::matches(const CssCompound& compound, const SvgElement& element) {
  work_ += 1 + compound.classes.size() + compound.attributes.size();
  if (!compound.type.empty() && compound.type != element.name) return false;
  if (!compound.id.empty() && compound.id != element.attribute("id")) return false;
  const std::string_view classes = compound.classes.empty() ? std::string_view() : element.attribute("class");
  return std::ranges::all_of(compound.classes, [&](const std::string& name) { return has_word(classes, name); }) &&
         std::ranges::all_of(compound.attributes,
                             [&](const auto& attribute) { return matches_attribute(attribute, element); });
}

// Whether the compounds up to `last` match the element and its ancestors.
bool SvgStyleSheet::matches(const Selector& selector, std::size_t last, std::uint32_t element,
                            const SvgDocument& document) {
  if (work_ > most_css_work || !matches(selector.compounds[last], document.elements[element])) return false;
  if (last == 0) return true;
  for (std::uint32_t at = element; at != 0 && work_ <= most_css_work;) {
    at = document.elements[at].parent;
    if (matches(selector, last - 1, at, document)) return true;
    if (selector.compounds[last].is_child) break;
  }
  return false;
}

void SvgStyleSheet::collect(const Index& index, std::string_view key, std::vector<std::uint32_t>& found) const {
  if (index.empty() || key.empty()) return;
  const auto entry = index.find(std::string(key));
  if (entry != index.end()) found.insert(found.end(), entry->second.begin(), entry->second.end());
}

void SvgStyleSheet::style(std::uint32_t index, SvgDocument& document) {
  SvgElement& element = document.elements[index];
  std::vector<std::uint32_t> found = universal_;
  collect(by_id_, element.attribute("id"), found);
  collect(by_type_, element.name, found);
  for (std::string_view classes = element.attribute("class"); !classes.empty();) {
    const std::string_view one = classes.substr(0, classes.find_first_of(css_blanks));
    classes.remove_prefix(std::min(classes.size(), one.size() + 1));
    collect(by_class_, one, found);
  }
  std::erase_if(found, [&](std::uint32_t i) {
    return !matches(selectors_[i], selectors_[i].compounds.size() - 1, index, document);
  });
  if (found.empty()) return;
  std::ranges::stable_sort(found, {},
                           [&](std::uint32_t i) { return std::tuple(selectors_[i].specificity, selectors_[i].rule); });
  // Later ones win: rules, the style attribute, important rules, important declarations of the attribute.
  const std::vector<CssDeclaration> own = css_declarations(element.attribute("style"));
  std::vector<std::pair<std::string, std::string>> style;
  const auto take = [&](const std::vector<CssDeclaration>& declarations, bool important) {
    for (const CssDeclaration& one : declarations) {
      if (one.is_important != important) continue;
      const auto same = std::ranges::find(style, one.property, &std::pair<std::string, std::string>::first);
      if (same == style.end()) {
        style.emplace_back(one.property, one.value);
      } else {
        same->second = one.value;
      }
    }
  };
  for (const bool important : {false, true}) {
    for (const std::uint32_t i : found) take(rules_[selectors_[i].rule], important);
    take(own, important);
  }
  element.style = std::move(style);
  element.is_styled = true;
}

bool SvgStyleSheet::apply(SvgDocument& document) {
  if (selectors_.empty()) return true;
  for (std::uint32_t i = 0; i < document.elements.size() && work_ <= most_css_work; ++i) style(i, document);
  return work_ <= most_css_work;
}

}  // namespace passo
