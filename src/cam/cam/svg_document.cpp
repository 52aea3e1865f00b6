#include "svg_document.hpp"

#include <memory>

#include "text_lines.hpp"
#include <expat.h>
#include <fmt/format.h>

#include "passo/base/xml_place.hpp"

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
    const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(
        XML_ParserCreate(nullptr), &XML_ParserFree);
    parser_ = parser.get();
    if (parser_ == nullptr) return {};
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, &SvgTreeReader::begin, &SvgTreeReader::end);
    constexpr std::size_t piece = std::size_t{1} << 20;
    XML_Status status = XML_STATUS_OK;
    do {
      const std::string_view part = text.substr(0, piece);
      text.remove_prefix(part.size());
      status = XML_Parse(parser_, part.data(), static_cast<int>(part.size()), text.empty() ? 1 : 0);
    } while (!text.empty() && status == XML_STATUS_OK);
    if (status != XML_STATUS_OK && !diagnostics_.any_error()) {
      refuse("svg.syntax", fmt::format("the drawing cannot be read: {}", XML_ErrorString(XML_GetErrorCode(parser_))),
             "an SVG drawing, which is XML");
    }
    if (diagnostics_.any_error()) return {};
    if (document_.elements.empty() || document_.elements.front().name != "svg") {
      refuse("svg.no-drawing", "this is XML, but not an SVG drawing", "<svg> as the outermost element");
      return {};
    }
    return std::move(document_);
  }

 private:
  static void XMLCALL begin(void* self, const XML_Char* name, const XML_Char** attributes) {
    static_cast<SvgTreeReader*>(self)->add(name, attributes);
  }
  static void XMLCALL end(void* self, const XML_Char* /*name*/) {
    auto& reader = *static_cast<SvgTreeReader*>(self);
    if (!reader.open_.empty()) reader.open_.pop_back();
  }

  void add(const char* name, const char** attributes) {
    if (document_.elements.size() >= most_svg_elements || open_.size() >= deepest_svg_element) {
      refuse("svg.too-large",
             fmt::format("the drawing has more than {} elements, or they are nested more than {} deep",
                         most_svg_elements, deepest_svg_element),
             "a smaller drawing");
      XML_StopParser(parser_, XML_FALSE);
      return;
    }
    const auto index = static_cast<std::uint32_t>(document_.elements.size());
    SvgElement& element = document_.elements.emplace_back();
    element.name = without_prefix(name);
    element.line = xml_line(parser_);
    for (const char** at = attributes; at[0] != nullptr; at += 2) {
      // A label of Inkscape keeps its prefix; of the others only the link has one.
      const std::string_view key = std::string_view(at[0]) == "xlink:href" ? "href" : std::string_view(at[0]);
      element.attributes.emplace_back(key, at[1]);
      if (key == "id") document_.ids.try_emplace(at[1], index);
    }
    if (!open_.empty()) document_.elements[open_.back()].children.push_back(index);
    open_.push_back(index);
  }

  void refuse(std::string code, std::string message, std::string expected) {
    diagnostics_.add({.code = std::move(code),
                      .file = name_,
                      .place = {xml_line(parser_), xml_column(parser_) + 1, 1},
                      .message = std::move(message),
                      .expected = std::move(expected),
                      .text = ""});
  }

  const std::string& name_;
  Diagnostics& diagnostics_;
  XML_Parser parser_ = nullptr;
  SvgDocument document_;
  std::vector<std::uint32_t> open_;
};

}  // namespace

std::string_view SvgElement::attribute(std::string_view wanted) const {
  for (const auto& [key, value] : attributes) {
    if (key == wanted) return value;
  }
  return {};
}

std::string_view SvgElement::property(std::string_view wanted) const {
  std::string_view style = attribute("style");
  while (!style.empty()) {
    const std::string_view one = style.substr(0, style.find(';'));
    style.remove_prefix(std::min(style.size(), one.size() + 1));
    const std::size_t colon = one.find(':');
    if (colon != std::string_view::npos && trimmed(one.substr(0, colon)) == wanted)
      return trimmed(one.substr(colon + 1));
  }
  return attribute(wanted);
}

SvgDocument read_svg_document(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  return SvgTreeReader(name, diagnostics).read(text);
}

}  // namespace passo
