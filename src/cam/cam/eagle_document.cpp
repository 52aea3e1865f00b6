#include "eagle_document.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "passo/diagnostics/xml_parser.hpp"

namespace passo {
namespace {

constexpr std::size_t most_eagle_items = 2'000'000;
constexpr std::size_t deepest_eagle_item = 50;

class EagleTreeReader {
 public:
  EagleTreeReader(const std::string& name, Diagnostics& diagnostics) : name_(name), diagnostics_(diagnostics) {}

  std::optional<EagleItem> read(std::string_view text) {
    open_.emplace_back();
    if (!parser_.take(text, true) && !diagnostics_.any_error()) {
      refuse("eagle.syntax", fmt::format("the board cannot be read: {}", parser_.fault()),
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

  void begin(const char* name, const char** attributes) {
    if (++items_ > most_eagle_items || open_.size() >= deepest_eagle_item) {
      refuse("eagle.too-large",
             fmt::format("the board has more than {} elements, or they are nested more than {} deep", most_eagle_items,
                         deepest_eagle_item),
             "a smaller board");
      return parser_.stop();
    }
    EagleItem& item = open_.emplace_back();
    item.name = name;
    item.line = parser_.line();
    for (const char** at = attributes; at[0] != nullptr; at += 2) item.attributes.emplace_back(at[0], at[1]);
  }
  void end(const char* /*name*/) {
    if (open_.size() < 2) return;
    EagleItem item = std::move(open_.back());
    open_.pop_back();
    open_.back().children.push_back(std::move(item));
  }

 private:
  void refuse(const char* code, std::string message, const char* expected) {
    diagnostics_.add(parser_.refusal(code, name_, std::move(message), expected));
  }

  const std::string& name_;
  Diagnostics& diagnostics_;
  XmlParser parser_{*this};
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
