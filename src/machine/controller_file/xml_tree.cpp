#include <memory>
#include <utility>
#include <vector>

#include "source_readers.hpp"
#include <expat.h>
#include <fmt/format.h>

#include "passo/base/utf8.hpp"
#include "passo/base/xml_place.hpp"

namespace passo {
namespace {

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const CodePoint point = first_code_point(text);
    if (point.length == 0) return false;
    text.remove_prefix(point.length);
  }
  return true;
}

class XmlTree {
 public:
  XmlTree(const ImportSource& source, Diagnostics& diagnostics) : source_(source), diagnostics_(diagnostics) {}

  std::optional<SourceNode> read() {
    // Windows writes the texts of Mach3 in its own code page, without saying so.
    const bool is_latin =
        source_.text.substr(0, 200).find("encoding") == std::string_view::npos && !is_utf8(source_.text);
    const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(
        XML_ParserCreate(is_latin ? "ISO-8859-1" : nullptr), &XML_ParserFree);
    parser_ = parser.get();
    if (parser_ == nullptr) return std::nullopt;
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, &XmlTree::begin, &XmlTree::end);
    XML_SetCharacterDataHandler(parser_, &XmlTree::add_text);
    XML_SetEntityDeclHandler(parser_, &XmlTree::refuse_entity);
    const int length = static_cast<int>(source_.text.size());
    if (XML_Parse(parser_, source_.text.data(), length, 1) != XML_STATUS_OK && !is_refused_) {
      refuse("import.syntax", fmt::format("this is not XML: {}", XML_ErrorString(XML_GetErrorCode(parser_))),
             "a profile of Mach3");
    }
    if (is_refused_ || root_.children.empty()) return std::nullopt;
    return std::move(root_.children.front());
  }

 private:
  static void XMLCALL begin(void* self, const XML_Char* name, const XML_Char** /*attributes*/) {
    static_cast<XmlTree*>(self)->open(name);
  }
  static void XMLCALL end(void* self, const XML_Char* /*name*/) {
    auto& tree = *static_cast<XmlTree*>(self);
    if (!tree.open_.empty()) tree.open_.pop_back();
  }
  static void XMLCALL add_text(void* self, const XML_Char* text, int length) {
    auto& tree = *static_cast<XmlTree*>(self);
    SourceNode& node = tree.current();
    const std::string_view added(text, static_cast<std::size_t>(length));
    if (tree.open_.empty() || node.text.size() + added.size() > longest_text) return;
    if (node.text.empty() && added.find_first_not_of(" \t\r\n") == std::string_view::npos) return;
    if (node.text.empty()) tree.note_place(node);
    node.text += added;
  }
  // Entities can make a few lines a text of any size, and Mach3 declares none.
  static void XMLCALL refuse_entity(void* self, const XML_Char*, int, const XML_Char*, int, const XML_Char*,
                                    const XML_Char*, const XML_Char*, const XML_Char*) {
    static_cast<XmlTree*>(self)->refuse("import.syntax", "the file declares an entity", "a profile of Mach3");
  }

  SourceNode& current() {
    SourceNode* node = &root_;
    for (const std::size_t index : open_) node = &node->children[index];
    return *node;
  }

  void note_place(SourceNode& node) const {
    node.line = xml_line(parser_);
    node.column = xml_column(parser_) + 1;
  }

  void open(const char* name) {
    if (++nodes_ > most_source_nodes || open_.size() >= deepest_source_node) {
      refuse("import.too-large",
             fmt::format("the file has more than {} elements, or they are nested more than {} deep", most_source_nodes,
                         deepest_source_node),
             "a profile of Mach3, usually some thousand elements");
      return;
    }
    SourceNode& parent = current();
    open_.push_back(parent.children.size());
    SourceNode& node = parent.children.emplace_back();
    node.name = std::string_view(name).substr(0, longest_text);
    note_place(node);
  }

  void refuse(const char* code, std::string message, std::string expected) {
    if (is_refused_) return;
    is_refused_ = true;
    add_source_error(source_, diagnostics_, code, xml_line(parser_), xml_column(parser_) + 1, std::move(message),
                     std::move(expected));
    XML_StopParser(parser_, XML_FALSE);
  }

  static constexpr std::size_t longest_text = 4096;

  const ImportSource& source_;
  Diagnostics& diagnostics_;
  XML_Parser parser_ = nullptr;
  SourceNode root_;                // its child is the outermost element
  std::vector<std::size_t> open_;  // from the root, which child is open
  std::size_t nodes_ = 0;
  bool is_refused_ = false;
};

}  // namespace

std::optional<SourceNode> read_xml_tree(const ImportSource& source, Diagnostics& diagnostics) {
  return XmlTree(source, diagnostics).read();
}

}  // namespace passo
