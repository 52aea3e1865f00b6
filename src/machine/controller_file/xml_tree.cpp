#include <utility>
#include <vector>

#include "source_readers.hpp"
#include <fmt/format.h>

#include "passo/base/utf8.hpp"
#include "passo/diagnostics/xml_parser.hpp"

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
    if (parser_.get() == nullptr) return std::nullopt;
    if (is_latin) XML_SetEncoding(parser_.get(), "ISO-8859-1");
    XML_SetCharacterDataHandler(parser_.get(), &XmlTree::add_text);
    XML_SetEntityDeclHandler(parser_.get(), &XmlTree::refuse_entity);
    if (!parser_.take(source_.text, true) && !is_refused_) {
      refuse("import.syntax", fmt::format("this is not XML: {}", parser_.fault()), "a profile of Mach3");
    }
    if (is_refused_ || root_.children.empty()) return std::nullopt;
    return std::move(root_.children.front());
  }

  void begin(const char* name, const char** /*attributes*/) {
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
  void end(const char* /*name*/) {
    if (!open_.empty()) open_.pop_back();
  }

 private:
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
    node.line = parser_.line();
    node.column = parser_.column();
  }

  void refuse(const char* code, std::string message, std::string expected) {
    if (is_refused_) return;
    is_refused_ = true;
    add_source_error(source_, diagnostics_, code, parser_.line(), parser_.column(), std::move(message),
                     std::move(expected));
    parser_.stop();
  }

  static constexpr std::size_t longest_text = 4096;

  const ImportSource& source_;
  Diagnostics& diagnostics_;
  XmlParser parser_{*this};
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
