#include "eagle_document.hpp"

#include <algorithm>
#include <memory>
#include <type_traits>

#include <expat.h>
#include <fmt/format.h>

#include "passo/base/xml_place.hpp"

namespace passo {
namespace {

constexpr std::size_t most_eagle_items = 2'000'000;
constexpr std::size_t deepest_eagle_item = 50;

class EagleTreeReader {
 public:
  EagleTreeReader(const std::string& name, Diagnostics& diagnostics) : name_(name), diagnostics_(diagnostics) {}

  std::optional<EagleItem> read(std::string_view text) {
    const std::unique_ptr<std::remove_pointer_t<XML_Parser>, decltype(&XML_ParserFree)> parser(
        XML_ParserCreate(nullptr), &XML_ParserFree);
    parser_ = parser.get();
    if (parser_ == nullptr) return std::nullopt;
    open_.emplace_back();
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(parser_, &EagleTreeReader::begin, &EagleTreeReader::end);
    constexpr std::size_t piece = std::size_t{1} << 20;
    XML_Status status = XML_STATUS_OK;
    do {
      const std::string_view part = text.substr(0, piece);
      text.remove_prefix(part.size());
      status = XML_Parse(parser_, part.data(), static_cast<int>(part.size()), text.empty() ? 1 : 0);
    } while (!text.empty() && status == XML_STATUS_OK);
    if (status != XML_STATUS_OK && !diagnostics_.any_error()) {
      refuse("eagle.syntax", fmt::format("the board cannot be read: {}", XML_ErrorString(XML_GetErrorCode(parser_))),
             "a board of EAGLE 6 or newer, which is XML");
    }
    if (diagnostics_.any_error()) return std::nullopt;
    const EagleItem* const eagle = open_.front().child("eagle");
    const EagleItem* const drawing = eagle == nullptr ? nullptr : eagle->child("drawing");
    const EagleItem* const board = drawing == nullptr ? nullptr : drawing->child("board");
    if (board != nullptr) return *board;
    refuse("eagle.no-board", "this file of EAGLE is no board", "<board>, as in a .brd file");
    return std::nullopt;
  }

 private:
  static void XMLCALL begin(void* self, const XML_Char* name, const XML_Char** attributes) {
    static_cast<EagleTreeReader*>(self)->add(name, attributes);
  }
  static void XMLCALL end(void* self, const XML_Char* /*name*/) {
    auto& reader = *static_cast<EagleTreeReader*>(self);
    if (reader.open_.size() < 2) return;
    EagleItem item = std::move(reader.open_.back());
    reader.open_.pop_back();
    reader.open_.back().children.push_back(std::move(item));
  }

  void add(const char* name, const char** attributes) {
    if (++items_ > most_eagle_items || open_.size() >= deepest_eagle_item) {
      refuse("eagle.too-large",
             fmt::format("the board has more than {} elements, or they are nested more than {} deep", most_eagle_items,
                         deepest_eagle_item),
             "a smaller board");
      XML_StopParser(parser_, XML_FALSE);
      return;
    }
    EagleItem& item = open_.emplace_back();
    item.name = name;
    item.line = xml_line(parser_);
    for (const char** at = attributes; at[0] != nullptr; at += 2) item.attributes.emplace_back(at[0], at[1]);
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
  std::vector<EagleItem> open_;  // the first one is around all
  std::size_t items_ = 0;
};

}  // namespace

std::string_view EagleItem::text(std::string_view attribute) const {
  for (const auto& [key, value] : attributes) {
    if (key == attribute) return value;
  }
  return {};
}

const EagleItem* EagleItem::child(std::string_view wanted) const {
  const auto found = std::ranges::find(children, wanted, &EagleItem::name);
  return found == children.end() ? nullptr : &*found;
}

std::optional<EagleItem> read_eagle_document(const std::string& name, std::string_view text, Diagnostics& diagnostics) {
  return EagleTreeReader(name, diagnostics).read(text);
}

}  // namespace passo
