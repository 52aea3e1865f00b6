#include "block_words.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "evaluation.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

std::string code_text(char letter, std::int32_t tenths) {
  return tenths % 10 == 0 ? fmt::format("{}{}", letter, tenths / 10)
                          : fmt::format("{}{}.{}", letter, tenths / 10, tenths % 10);
}

// What LinuxCNC or others have and this release does not.
bool is_known_elsewhere(char letter, std::int32_t tenths) {
  constexpr std::array g = {50,  51,  52,  53,  60,  171, 181, 191, 382, 383, 384, 385, 410, 411, 420,
                            421, 432, 500, 510, 520, 650, 660, 670, 700, 710, 711, 712, 720, 721, 722,
                            730, 740, 760, 810, 820, 830, 840, 850, 860, 870, 880, 890, 960};
  if (letter == 'G') return std::ranges::binary_search(g, tenths);
  const std::int32_t m = tenths / 10;
  return m == 19 || m == 56 || (m >= 50 && m <= 53) || (m >= 62 && m <= 73) || m == 98 || m == 99 ||
         (m >= 100 && m <= 199);
}

std::string nearest_code(char letter, std::int32_t tenths) {
  std::string wanted = code_text(letter, tenths);
  std::vector<std::string> names;
  for (const Code& code : all_codes()) {
    if (code.letter == letter) names.push_back(code_text(code.letter, code.number));
  }
  const std::string_view found = nearest(wanted, {names.begin(), names.end()});
  return found.empty() ? "a word from docs/gcode.md" : fmt::format("perhaps {}; all words are in docs/gcode.md", found);
}

constexpr std::string_view axis_letters = "XYZABCUVW";

}  // namespace

bool BlockWords::add_code(const Word& word, double value, const Reporter& reporter) {
  const double scaled = value * 10;
  const double rounded = std::round(scaled);
  const auto tenths = static_cast<std::int32_t>(std::clamp(rounded, -1.0, 1e6));
  const Code* code = std::fabs(scaled - rounded) < 1e-3 ? find_code(word.letter, tenths) : nullptr;
  if (code == nullptr) {
    if (is_known_elsewhere(word.letter, tenths)) {
      return reporter.error("gcode.unsupported-code", word.span,
                            fmt::format("{} is not supported by this release", code_text(word.letter, tenths)),
                            "only words that docs/gcode.md lists");
    }
    return reporter.error("gcode.unknown-code", word.span, fmt::format("there is no {}{}", word.letter, value),
                          nearest_code(word.letter, tenths));
  }
  CodeWord& place = codes_[static_cast<std::size_t>(code->group)];
  // Many programs begin with "G80 G0": the end of canned cycles gives way to any motion beside it.
  if (code->group == ModalGroup::motion && place && code->number == 800) return true;
  if (code->group == ModalGroup::motion && place.is(800)) place = {};
  // M7 and M8 may stand together; all other codes of a group exclude each other.
  if (place && !(code->group == ModalGroup::coolant && !place.is(90) && code->number != 90)) {
    return reporter.error(
        "gcode.two-of-a-group", word.span,
        fmt::format("{} and {} are both of the group \"{}\"", code_text(place.code->letter, place.code->number),
                    code_text(code->letter, code->number), group_name(code->group)),
        "one of them, or two blocks");
  }
  if (code->group == ModalGroup::coolant) (code->number == 70 ? mist_ : flood_) |= code->number != 90;
  place = {.code = code, .span = word.span};
  return true;
}

bool BlockWords::gather(const Block& block, const Parameters& parameters, const Reporter& reporter) {
  *this = BlockWords();
  bool good = true;
  for (const Word& word : block.words) {
    if (first_.column == 0) first_ = word.span;
    double value = 0;
    if (!evaluate(block, word.value, parameters, reporter, value)) {
      good = false;
      continue;
    }
    if (word.letter == 'G' || word.letter == 'M') {
      good = add_code(word, value, reporter) && good;
      continue;
    }
    if (word.letter == '@' || word.letter == '^') {
      std::optional<double>& polar = word.letter == '@' ? polar_radius_ : polar_angle_;
      good = good && (!polar || reporter.error("gcode.word-twice", word.span,
                                               fmt::format("{} stands twice in this block", word.letter)));
      polar = value;
      continue;
    }
    if (word.letter < 'A' || word.letter > 'Z') {
      good = reporter.error("gcode.unsupported-word", word.span,
                            fmt::format("'{}' is not supported by this release", word.letter),
                            "only words that docs/gcode.md lists");
      continue;
    }
    if (values_[index(word.letter)]) {
      good = reporter.error("gcode.word-twice", word.span, fmt::format("{} stands twice in this block", word.letter),
                            "each letter but G and M once");
      continue;
    }
    values_[index(word.letter)] = value;
    spans_[index(word.letter)] = word.span;
  }
  return good;
}

bool BlockWords::has_axis_word() const {
  return has_polar() || std::ranges::any_of(axis_letters, [this](char letter) { return has(letter); });
}

char BlockWords::unused() const {
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (has(letter) && !used_[index(letter)]) return letter;
  }
  return 0;
}

}  // namespace passo
