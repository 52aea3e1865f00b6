#include "svg_document.hpp"

#include <algorithm>

#include "svg_style.hpp"
#include <fmt/format.h>

#include "passo/base/trimmed.hpp"
#include "passo/diagnostics/xml_parser.hpp"

namespace passo {
namespace {

constexpr std::size_t most_svg_elements = 1'000'000;
constexpr std::size_t deepest_svg_element = 200;

std::string_view without_prefix(std::string_view name) {
  const std::size_t colon = name.rfind(':');
  return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

class SvgTreeReader {
 public:
  SvgTreeReader(const std::string& name, Diagnostics& diagnostics) : name_(name), diagnostics_(diagnostics) {}

  SvgDocument read(std::string_view text) {
    if (parser_.get() == nullptr) return {};
    XML_SetCharacterDataHandler(parser_.get(), &SvgTreeReader::add_text);
    XML_SetProcessingInstructionHandler(parser_.get(), &SvgTreeReader::instruct);
    if (!parser_.take(text, true) && !diagnostics_.any_error()) {
      refuse("svg.syntax", fmt::format("the drawing cannot be read: {}", parser_.fault()),
             "an SVG drawing, which is XML");
    }
    if (diagnostics_.any_error()) return {};
    if (document_.elements.empty() || document_.elements.front().name != "svg") {
      refuse("svg.no-drawing", "this is XML, but not an SVG drawing", "<svg> as the outermost element");
      return {};
    }
    document_.skipped_rules += sheet_.skipped();
    if (!sheet_.apply(document_)) {
      refuse("svg.too-large", "the style sheet has too many rules for a drawing of this size", "a simpler style sheet");
      return {};
    }
    return std::move(document_);
  }

  void begin(const char* name, const char** attributes) {
    if (document_.elements.size() >= most_svg_elements || open_.size() >= deepest_svg_element) {
      refuse("svg.too-large",
             fmt::format("the drawing has more than {} elements, or they are nested more than {} deep",
                         most_svg_elements, deepest_svg_element),
             "a smaller drawing");
      return parser_.stop();
    }
    const auto index = static_cast<std::uint32_t>(document_.elements.size());
    SvgElement& element = document_.elements.emplace_back();
    element.name = without_prefix(name);
    element.line = parser_.line();
    for (const char** at = attributes; at[0] != nullptr; at += 2) find_prefix(at[0], at[1]);
    for (const char** at = attributes; at[0] != nullptr; at += 2) {
      const std::string key = key_of(at[0]);
      if (key == "id") document_.ids.try_emplace(at[1], index);
      if (key == "inkscape:version" && index == 0) document_.inkscape_version = at[1];
      element.attributes.emplace_back(key, at[1]);
    }
    element.parent = open_.empty() ? 0 : open_.back();
    if (!open_.empty()) document_.elements[open_.back()].children.push_back(index);
    open_.push_back(index);
  }

  void end(const char* /*name*/) {
    if (open_.empty()) return;
    if (in_style()) {
      sheet_.add(css_);
      css_.clear();
    }
    open_.pop_back();
  }

 private:
  static void XMLCALL add_text(void* self, const XML_Char* text, int size) {
    auto& reader = *static_cast<SvgTreeReader*>(self);
    if (reader.in_style()) reader.css_.append(text, static_cast<std::size_t>(size));
  }
  // <?xml-stylesheet ...?> refers to a sheet in another file.
  static void XMLCALL instruct(void* self, const XML_Char* target, const XML_Char* /*data*/) {
    if (std::string_view(target) == "xml-stylesheet") ++static_cast<SvgTreeReader*>(self)->document_.skipped_rules;
  }

  bool in_style() const {
    if (open_.empty()) return false;
    const SvgElement& element = document_.elements[open_.back()];
    if (element.name != "style") return false;
    const std::string_view type = element.attribute("type");
    const std::string_view media = element.attribute("media");
    return (type.empty() || type == "text/css") && (media.empty() || media == "all" || media == "screen");
  }

  // xmlns:PREFIX="http://www.inkscape.org/..." declares the prefix of Inkscape's attributes, usually "inkscape".
  void find_prefix(std::string_view name, std::string_view value) {
    constexpr std::string_view declares = "xmlns:";
    if (name.starts_with(declares) && value == "http://www.inkscape.org/namespaces/inkscape") {
      inkscape_ = std::string(name.substr(declares.size())) + ':';
    }
  }
  // The name of an attribute with the usual prefix; a link has none.
  std::string key_of(std::string_view name) const {
    if (name.ends_with(":href")) return "href";
    return name.starts_with(inkscape_) ? "inkscape:" + std::string(name.substr(inkscape_.size())) : std::string(name);
  }

  void refuse(const char* code, std::string message, const char* expected) {
    diagnostics_.add(parser_.refusal(code, name_, std::move(message), expected));
  }

  const std::string& name_;
  Diagnostics& diagnostics_;
  XmlParser parser_{*this};
  SvgDocument document_;
  std::vector<std::uint32_t> open_;
  std::string inkscape_ = "inkscape:";  // the prefix of its attributes in this file
  std::string css_;                     // of the <style> element that is open
  SvgStyleSheet sheet_;
};

}  // namespace

std::string_view SvgElement::attribute(std::string_view wanted) const {
  for (const auto& [key, value] : attributes) {
    if (key == wanted) return value;
  }
  return {};
}

std::string_view SvgElement::property(std::string_view wanted) const {
  if (is_styled) {
    const auto found = std::ranges::find(style, wanted, &std::pair<std::string, std::string>::first);
    return found == style.end() ? attribute(wanted) : std::string_view(found->second);
  }
  constexpr std::string_view blanks = " \t\r\n\f";
  std::string_view found;
  bool is_important = false;
  std::string_view rest = attribute("style");
  while (!rest.empty()) {
    const std::string_view one = rest.substr(0, rest.find(';'));
    rest.remove_prefix(std::min(rest.size(), one.size() + 1));
    const std::size_t colon = one.find(':');
    if (colon == std::string_view::npos || !is_css_word(trimmed(one.substr(0, colon), blanks), wanted)) continue;
    const std::string_view value = one.substr(colon + 1);
    const std::size_t mark = value.rfind('!');
    const bool matters = mark != std::string_view::npos;
    if (is_important && !matters) continue;
    is_important = matters;
    found = trimmed(value.substr(0, mark), blanks);
  }
  return found.empty() ? attribute(wanted) : found;
}

SvgDocument read_svg_document(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  return SvgTreeReader(name, diagnostics).read(text);
}

}  // namespace passo
