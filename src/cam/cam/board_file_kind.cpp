// What a board's file is for, by its attribute or its name.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include <fmt/format.h>

#include "passo/cam/board_job.hpp"

namespace passo {
namespace {

using enum BoardRole;
using enum BoardSide;

struct NamedKind {
  std::string_view name;
  BoardRole role;
  BoardSide side;
};

// Extensions that mean one thing: Protel, Altium and KiCad; Eagle; OrCAD.
constexpr std::array extensions = {
    NamedKind{"gtl", copper, top},    NamedKind{"gbl", copper, bottom},  NamedKind{"gts", mask, top},
    NamedKind{"gbs", mask, bottom},   NamedKind{"gto", print, top},      NamedKind{"gbo", print, bottom},
    NamedKind{"gtp", paste, top},     NamedKind{"gbp", paste, bottom},   NamedKind{"gko", outline, both},
    NamedKind{"gml", outline, both},  NamedKind{"cmp", copper, top},     NamedKind{"sol", copper, bottom},
    NamedKind{"stc", mask, top},      NamedKind{"sts", mask, bottom},    NamedKind{"plc", print, top},
    NamedKind{"pls", print, bottom},  NamedKind{"crc", paste, top},      NamedKind{"crs", paste, bottom},
    NamedKind{"dim", outline, both},  NamedKind{"mil", outline, both},   NamedKind{"top", copper, top},
    NamedKind{"bot", copper, bottom}, NamedKind{"smt", mask, top},       NamedKind{"smb", mask, bottom},
    NamedKind{"tsm", mask, top},      NamedKind{"bsm", mask, bottom},    NamedKind{"sst", print, top},
    NamedKind{"ssb", print, bottom},  NamedKind{"tsk", print, top},      NamedKind{"bsk", print, bottom},
    NamedKind{"spt", paste, top},     NamedKind{"spb", paste, bottom},   NamedKind{"tsp", paste, top},
    NamedKind{"bsp", paste, bottom},  NamedKind{"drl", drill, both},     NamedKind{"xln", drill, both},
    NamedKind{"exc", drill, both},    NamedKind{"tap", drill, both},     NamedKind{"npt", drill, both},
    NamedKind{"drd", drill, both},    NamedKind{"gd1", drawing, both},   NamedKind{"gg1", drawing, both},
    NamedKind{"gpt", drawing, top},   NamedKind{"gpb", drawing, bottom}, NamedKind{"fab", outline, both}};

// Parts of names that tell the role, the strongest first.
constexpr std::array role_words = {
    NamedKind{"mask", mask, both},        NamedKind{"paste", paste, both},      NamedKind{"cream", paste, both},
    NamedKind{"stencil", paste, both},    NamedKind{"silk", print, both},       NamedKind{"legend", print, both},
    NamedKind{"overlay", print, both},    NamedKind{"assembly", drawing, both}, NamedKind{"courtyard", drawing, both},
    NamedKind{"adhes", drawing, both},    NamedKind{".fab", drawing, both},     NamedKind{"_fab", drawing, both},
    NamedKind{"drillmap", drawing, both}, NamedKind{"drawing", drawing, both},  NamedKind{"edge", outline, both},
    NamedKind{"outline", outline, both},  NamedKind{"profile", outline, both},  NamedKind{"dimension", outline, both},
    NamedKind{"contour", outline, both},  NamedKind{"drill", drill, both},      NamedKind{"pth", drill, both}};
constexpr std::array side_words = {
    NamedKind{"bottom", unknown, bottom}, NamedKind{"back", unknown, bottom}, NamedKind{"b_cu", copper, bottom},
    NamedKind{"b.cu", copper, bottom},    NamedKind{"top", unknown, top},     NamedKind{"front", unknown, top},
    NamedKind{"f_cu", copper, top},       NamedKind{"f.cu", copper, top},     NamedKind{"inner", copper, inner},
    NamedKind{"internal", copper, inner}, NamedKind{"bcream", paste, bottom}, NamedKind{"tcream", paste, top},
    NamedKind{"bot", unknown, bottom}};

std::string lower(std::string_view text) {
  std::string result(text);
  std::ranges::transform(result, result.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return result;
}

bool is_digit_of_name(char c) {
  return c >= '0' && c <= '9';
}

std::uint32_t number_in(std::string_view text) {
  std::uint32_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

// ".g1", ".g2l", ".gp1", ".ly2", ".in1": copper inside. ".gm13": a mechanical layer, often the outline.
BoardFileKind kind_by_numbered_extension(std::string_view extension) {
  for (const std::string_view prefix : {"gp", "ly", "in", "gm", "g"}) {
    if (!extension.starts_with(prefix)) continue;
    std::string_view rest = extension.substr(prefix.size());
    if (rest.ends_with('l')) rest.remove_suffix(1);
    if (rest.empty() || !std::ranges::all_of(rest, is_digit_of_name)) continue;
    if (prefix == "gm") return {outline, both, 0, "name"};
    return {copper, inner, number_in(rest), "name"};
  }
  return {};
}

// Between marks, "f" and "b" are the front and the back: "board-F_Mask.gbr", "board.b.silks".
BoardSide side_by_letter(std::string_view name) {
  constexpr std::string_view marks = "-_. ";
  for (std::size_t i = 1; i + 1 < name.size(); ++i) {
    if (marks.find(name[i - 1]) == std::string_view::npos || marks.find(name[i + 1]) == std::string_view::npos)
      continue;
    if (name[i] == 'f') return top;
    if (name[i] == 'b') return bottom;
  }
  return both;
}

// "In1_Cu", "In2.Cu"
bool is_inner_copper(std::string_view name, std::uint32_t& number) {
  for (std::size_t at = name.find("in"); at != std::string_view::npos; at = name.find("in", at + 1)) {
    std::size_t end = at + 2;
    while (end < name.size() && is_digit_of_name(name[end])) ++end;
    if (end == at + 2) continue;
    const std::string_view rest = name.substr(end, 3);
    if (rest != "_cu" && rest != ".cu") continue;
    number = number_in(name.substr(at + 2));
    return true;
  }
  return false;
}

std::uint32_t last_number(std::string_view stem) {
  const std::size_t last = stem.find_last_of("0123456789");
  if (last == std::string_view::npos) return 0;
  std::size_t begin = last;
  while (begin > 0 && is_digit_of_name(stem[begin - 1])) --begin;
  return number_in(stem.substr(begin));
}

BoardSide side_of_word(std::string_view word) {
  if (word == "Top") return top;
  if (word == "Bot") return bottom;
  return word == "Inr" ? inner : both;
}

}  // namespace

BoardFileKind kind_by_function(std::string_view function) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= function.size();) {
    const std::size_t end = std::min(function.find(',', at), function.size());
    parts.push_back(function.substr(at, end - at));
    at = end + 1;
  }
  const auto part = [&](std::size_t index) { return index < parts.size() ? parts[index] : std::string_view(); };
  const std::string_view name = part(0);
  BoardFileKind kind{unknown, both, 0, "attribute"};
  if (name.empty()) return {};
  if (name == "Copper") {
    kind = {copper, side_of_word(part(2)), 0, "attribute"};
    if (kind.side == inner && part(1).starts_with('L')) kind.copper_layer = number_in(part(1).substr(1));
    return kind;
  }
  kind.side = side_of_word(part(1));
  if (name == "Soldermask") kind.role = mask;
  if (name == "Paste") kind.role = paste;
  if (name == "Legend") kind.role = print;
  if (name == "Profile") kind = {outline, both, 0, "attribute"};
  if (name == "Plated" || name == "NonPlated") kind = {drill, both, 0, "attribute"};
  if (kind.role == unknown) kind.role = drawing;
  return kind;
}

BoardFileKind kind_by_name(std::string_view name) {
  const std::string all = lower(name);
  const std::size_t dot = all.rfind('.');
  const std::string extension = dot == std::string::npos ? "" : all.substr(dot + 1);
  const std::string_view stem = std::string_view(all).substr(0, dot);
  const auto known = std::ranges::find(extensions, extension, &NamedKind::name);
  if (known != extensions.end()) return {known->role, known->side, 0, "name"};
  if (const BoardFileKind numbered = kind_by_numbered_extension(extension); numbered.role != unknown) return numbered;
  BoardFileKind kind{unknown, both, 0, "name"};
  const auto is_in_name = [&](const NamedKind& word) { return all.find(word.name) != std::string::npos; };
  const auto side = std::ranges::find_if(side_words, is_in_name);
  const auto role = std::ranges::find_if(role_words, is_in_name);
  kind.side = side != side_words.end() ? side->side : side_by_letter(all);
  if (is_inner_copper(all, kind.copper_layer)) return {copper, inner, kind.copper_layer, "name"};
  if (role != role_words.end()) {
    kind.role = role->role;
  } else if (side != side_words.end()) {
    kind.role = copper;
    if (kind.side == inner) kind.copper_layer = last_number(stem);
  }
  if (kind.role == outline || kind.role == drill) kind.side = both;
  if (kind.role == unknown) return {};
  return kind;
}

std::string words_for(const BoardFileKind& kind) {
  constexpr std::array roles = {"unknown", "copper", "mask", "paste", "print", "outline", "drill", "drawing"};
  constexpr std::array sides = {"", "top ", "bottom ", "inner "};
  std::string words =
      std::string(sides.at(static_cast<std::size_t>(kind.side))) + roles.at(static_cast<std::size_t>(kind.role));
  if (kind.copper_layer != 0) words += fmt::format(" {}", kind.copper_layer);
  return words;
}

std::optional<BoardFileKind> kind_of_words(std::string_view words) {
  if (words == "nothing") return BoardFileKind{unknown, both, 0, "you"};
  for (const BoardRole role : {copper, mask, paste, print, outline, drill, drawing}) {
    for (const BoardSide side : {both, top, bottom, inner}) {
      const BoardFileKind kind{role, side, 0, "you"};
      const bool needs_side = role == copper;
      if (words == words_for(kind) && !(needs_side && side == both)) return kind;
    }
  }
  return {};
}

std::string short_name(const BoardFile& file) {
  const std::size_t inside = file.name.rfind(": ");
  const std::string name = inside == std::string::npos ? file.name : file.name.substr(inside + 2);
  return name.substr(name.rfind('/') + 1);
}

std::string set_kind(BoardJob& job, std::string_view name, std::string_view words) {
  const std::optional<BoardFileKind> kind = kind_of_words(words);
  if (!kind) {
    return fmt::format("'{}' is no layer: expected top copper, bottom copper, outline, drill or nothing", words);
  }
  bool is_found = false;
  for (BoardFile& file : job.files) {
    if (file.name != name && short_name(file) != name) continue;
    is_found = true;
    const bool needs_drills = kind->role == BoardRole::drill;
    if (kind->role != BoardRole::unknown && needs_drills != file.drills.has_value()) {
      return fmt::format("{} is {} drill file", file.name, needs_drills ? "no" : "a");
    }
    file.kind = *kind;
  }
  return is_found ? std::string() : fmt::format("there is no file '{}' among those that were read", name);
}

}  // namespace passo
