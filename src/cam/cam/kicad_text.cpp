#include "kicad_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t deepest = 64;
constexpr std::size_t most_nodes = 4'000'000;

bool is_blank(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

}  // namespace

void KicadText::refuse_at(std::size_t offset, std::size_t length, std::string code, std::string message,
                          std::string expected) {
  const std::size_t at = std::min(offset, text_.size());
  const std::size_t newline = at == 0 ? std::string_view::npos : text_.rfind('\n', at - 1);
  const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
  const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(begin), '\n');
  const std::string_view words = text_.substr(begin, std::min(text_.find('\n', begin), text_.size()) - begin);
  const std::size_t column = at - begin;
  diagnostics_.add({.code = std::move(code),
                    .file = file_,
                    .place = {static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(column + 1),
                              static_cast<std::uint32_t>(std::clamp<std::size_t>(length, 1, 80))},
                    .message = std::move(message),
                    .expected = std::move(expected),
                    .text = std::string(words)});
}

// Items are asked for in about the order of the text: only what lies between two of them is counted.
std::uint32_t KicadText::line_of(KicadItem item) {
  const std::size_t offset = item.node().offset;
  const auto lines_between = [this](std::size_t from, std::size_t to) {
    const auto at = [this](std::size_t place) { return text_.begin() + static_cast<std::ptrdiff_t>(place); };
    return static_cast<std::uint32_t>(std::count(at(from), at(to), '\n'));
  };
  if (offset >= counted_) {
    lines_ += lines_between(counted_, offset);
  } else {
    lines_ -= lines_between(offset, counted_);
  }
  counted_ = offset;
  return lines_;
}

void KicadText::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

// A word, or what is between quotes. A quote may stand in it behind a backslash.
bool KicadText::read_word(std::string_view& word) {
  const std::size_t begin = at_;
  if (text_[at_] != '"') {
    while (at_ < text_.size() && !is_blank(text_[at_]) && text_[at_] != '(' && text_[at_] != ')') ++at_;
    word = text_.substr(begin, at_ - begin);
    return true;
  }
  ++at_;
  while (at_ < text_.size() && text_[at_] != '"') at_ += text_[at_] == '\\' ? 2 : 1;
  if (at_ >= text_.size()) {
    refuse_at(begin, 1, "kicad.cut-off", "the text that starts here is not closed", "a second \"");
    return false;
  }
  word = text_.substr(begin + 1, at_ - begin - 1);
  ++at_;
  return true;
}

bool KicadText::begins_with(std::string_view name) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  skip_blanks();
  const std::size_t begin = at_;
  std::string_view word;
  if (at_ < text_.size() && text_[at_] == '(') {
    ++at_;
    skip_blanks();
    if (at_ < text_.size() && read_word(word) && word == name) return true;
  }
  refuse_at(begin, 1, "kicad.no-board", "this is not a KiCad board", fmt::format("({} at the start", name));
  is_over_ = true;
  return false;
}

std::uint32_t KicadText::add(const KicadNode& node, std::vector<std::uint32_t>& parents, std::uint32_t& last) {
  const auto index = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(node);
  if (last != 0) {
    nodes_[last].next = index;
  } else if (!parents.empty()) {
    nodes_[parents.back()].first = index;
  }
  last = index;
  return index;
}

KicadItem KicadText::next() {
  nodes_.assign(1, {});
  std::vector<std::uint32_t> parents;
  std::uint32_t last = 0;  // of the innermost list, so far
  while (!is_over_) {
    skip_blanks();
    const auto offset = static_cast<std::uint32_t>(at_);
    const bool too_many = nodes_.size() > most_nodes;
    if (too_many || parents.size() > deepest) {
      refuse_at(at_, 1, too_many ? "kicad.too-large" : "kicad.too-deep",
                too_many ? "this item has too many words" : "lists are nested too deeply",
                fmt::format("at most {}", too_many ? most_nodes : deepest));
      break;
    }
    if (at_ >= text_.size()) {
      refuse_at(at_, 1, "kicad.cut-off", "the file ends inside a list", ")");
      break;
    }
    std::string_view word;
    if (text_[at_] == ')') {
      ++at_;
      if (parents.empty()) break;  // of the outermost list
      last = parents.back();
      parents.pop_back();
      if (parents.empty()) return {nodes_, last};
    } else if (text_[at_] == '(') {
      ++at_;
      skip_blanks();
      const bool has_name = at_ < text_.size() && text_[at_] != '(' && text_[at_] != ')';
      if (has_name && !read_word(word)) break;
      const std::uint32_t index = add({word, 0, 0, offset, true}, parents, last);
      parents.push_back(index);
      last = 0;
    } else {
      if (!read_word(word)) break;
      if (!parents.empty()) add({word, 0, 0, offset, false}, parents, last);  // else a word of the outermost list
    }
  }
  is_over_ = true;
  return {};
}

double KicadText::number(KicadItem list, std::size_t place) {
  const KicadItem found = list.word(place);
  double value = 0;
  if (!found) {
    refuse(list, "kicad.bad-number", fmt::format("a number is missing in ({} ...)", list.name()), "one more number");
    return 0;
  }
  std::string_view text = found.name();
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  constexpr double most = 1e12;
  if (error == std::errc() && end == text.data() + text.size() && std::abs(value) <= most) return value;
  refuse(found, "kicad.bad-number", fmt::format("'{}' is not a number", found.name()), "a number, e.g. 1.27");
  return 0;
}

Nanometres KicadText::length(KicadItem list, std::size_t place) {
  const double mm = number(list, place);
  if (std::abs(mm) <= to_mm(farthest_drawn).value()) return to_nanometres(Mm(mm));
  refuse(list.word(place), "kicad.bad-number", fmt::format("{:g} mm is too far from zero", mm), "at most 100 m");
  return {};
}

}  // namespace passo
