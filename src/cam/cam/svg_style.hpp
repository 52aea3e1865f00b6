// SvgStyleSheet: the rules of the <style> elements of an SVG drawing. Private to cam/.
//
// Reads rule sets, and those in @media blocks for all media or for the screen. Selectors consist of element names, *,
// classes, ids and attributes ([a], [a=b], ~= ^= $= *=), alone or combined ("g.cut > path"), for descendants and
// children. A rule with any other selector is skipped. Only the declarations that select or place geometry are kept
// (is_drawn_property). The cascade is that of CSS: importance, style attributes, specificity, order.
//
// Source: Cascading Style Sheets Level 2 Revision 1, W3C, 2011, chapters 4 to 6.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace passo {

struct SvgDocument;
struct SvgElement;

// One simple selector of a chain such as "g.cut > path".
struct CssCompound {
  struct Attribute {
    std::string name;
    char match = 0;  // '=', '~', '^', '$', '*'; 0: the attribute exists
    std::string value = {};
  };
  std::string type = {};  // empty: every element
  std::string id = {};
  std::vector<std::string> classes = {};
  std::vector<Attribute> attributes = {};
  bool is_child = false;  // of the compound before it: a child, otherwise any descendant
};

struct CssDeclaration {
  std::string property;  // in small letters
  std::string value;
  bool is_important = false;
};

// Reads declarations up to the end of the text, e.g. "display:none; fill:red !important".
std::vector<CssDeclaration> css_declarations(std::string_view text);
// Whether the property selects or places geometry, so that the reader of drawings uses it.
bool is_drawn_property(std::string_view property);
// Whether the property is a colour, which selects shapes.
bool is_paint(std::string_view property);
// Whether the value is this keyword, in lower or upper case. `word` is in lower case.
bool is_css_word(std::string_view value, std::string_view word);

class SvgStyleSheet {
 public:
  // Adds the rules of a text.
  void add(std::string_view css);
  // Stores in each element the properties that result from the rules and its style attribute. Returns false if there
  // are too many rules for so many elements; some elements then lack their properties.
  bool apply(SvgDocument& document);
  // Returns the number of rules that were skipped although they have properties that the reader uses.
  std::size_t skipped() const { return skipped_; }

 private:
  struct Selector {
    std::vector<CssCompound> compounds;
    std::array<std::uint32_t, 3> specificity = {};  // ids; classes and attributes; names
    std::size_t rule = 0;                           // index into rules_
  };
  using Index = std::unordered_map<std::string, std::vector<std::uint32_t>>;

  void add_rules(std::string_view css, int depth);
  void add_rule(std::string_view selectors, std::string_view declarations);
  bool matches(const Selector& selector, std::size_t last, std::uint32_t element, const SvgDocument& document);
  bool matches(const CssCompound& compound, const SvgElement& element);
  void style(std::uint32_t element, SvgDocument& document);
  void collect(const Index& index, std::string_view key, std::vector<std::uint32_t>& found) const;

  std::vector<std::vector<CssDeclaration>> rules_;
  std::vector<Selector> selectors_;
  // Selectors by the id, class or name that their last compound requires, and those that require none.
  Index by_id_;
  Index by_class_;
  Index by_type_;
  std::vector<std::uint32_t> universal_;
  std::size_t skipped_ = 0;
  std::size_t work_ = 0;
};

}  // namespace passo
