#include "block_words.hpp"

#include <bit>
#include <cmath>

#include "interpreter_sentences.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

// G code numbers are compared with a tolerance, because 59.1 is not exact in binary.
constexpr double code_tolerance = 1e-4;
constexpr double code_limit = 1000;

// Indexed by letter_index().
constexpr auto axis_of_letter = [] {
  std::array<Axis, letter_count> axes{};
  for (const Axis axis : all_axes) axes[letter_index(letter_of(axis))] = axis;
  return axes;
}();

// Whether a word is like the G4 500 of a line that lacks a letter.
bool has_blank_between_digits(std::string_view word) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::size_t blank = word.find_first_of(" \t");
  return blank != std::string_view::npos && blank > 0 && is_digit(word[blank - 1]) && is_digit(word.back());
}

}  // namespace

void BlockWords::clear() {
  present_ = {};
  if (groups_ != 0) codes_.fill(nullptr);
  groups_ = 0;
  calls_macro_ = false;
}

bool BlockWords::read(const Block& block, const ParameterValues& parameters, Reporter& reporter) {
  clear();
  bool good = true;
  for (const Word& word : block.words) {
    double value = 0;
    if (!value_of(block, word.value, parameters, reporter, value)) {
      good = false;
    } else if (word.letter == 'G' || (word.letter == 'M' && !calls_macro_)) {
      good &= read_code(word, value, reporter);
    } else {
      good &= read_number(word, value, reporter);
    }
  }
  return good;
}

void BlockWords::find_axes(AxisWords& places) const {
  places = {};
  for (std::uint32_t bits = (present_ & axis_letters).bits(); bits != 0; bits &= bits - 1) {
    const auto letter = static_cast<std::size_t>(std::countr_zero(bits));
    places[axis_of_letter[letter]] = {spans_[letter].column, spans_[letter].length};
  }
}

bool BlockWords::is_of_another(char letter, ModalGroup group) const {
  for (std::uint32_t groups = groups_ & ~bit_of(group); groups != 0; groups &= groups - 1) {
    const CodeEntry* const entry = codes_[static_cast<std::size_t>(std::countr_zero(groups))];
    if (entry != nullptr && entry->letters.has(letter)) return true;
  }
  return false;
}

bool BlockWords::read_code(const Word& word, double value, Reporter& reporter) {
  const double tenths = std::round(value * 10);
  const bool in_range = value >= 0 && value < code_limit && std::abs(value * 10 - tenths) < code_tolerance * 10;
  const CodeEntry* const entry = in_range ? find_code(word.letter, static_cast<CodeNumber>(tenths)) : nullptr;
  if (entry == nullptr) {
    const std::string written = word.letter + plain_number(value);
    const bool readable = value >= 0 && value < code_limit;
    reporter.error(
        "gcode.unknown-code", word.span, interpreter_says::no_code.with({{"code", written}}),
        has_blank_between_digits(reporter.quote(word.span))
            ? FindingWords("a letter before the second number; a space does not end a number")
            : cure_for_unknown_code(word.letter, readable ? static_cast<CodeNumber>(tenths) : CodeNumber{-1}));
    return false;
  }
  const std::size_t group = index_of(entry->group);
  // Another motion replaces G80, because many programs begin with `G17 G40 G80 G0`.
  if (entry->group == ModalGroup::motion && codes_[group] != nullptr) {
    if (entry->number == passo::code(80)) return true;
    if (codes_[group]->number == passo::code(80)) codes_[group] = nullptr;
  }
  if (codes_[group] != nullptr) {
    reporter.error("gcode.modal-conflict", word.span,
                   interpreter_says::same_group.with({{"first", spelling(*codes_[group])},
                                                      {"second", spelling(*entry)},
                                                      {"group", std::string(row_of(entry->group).name)}}),
                   interpreter_says::one_or_two_blocks);
    return false;
  }
  calls_macro_ = calls_macro_ || (entry->group == ModalGroup::macro && entry->number != passo::code(67));
  codes_[group] = entry;
  code_spans_[group] = word.span;
  groups_ |= bit_of(entry->group);
  return true;
}

bool BlockWords::read_number(const Word& word, double value, Reporter& reporter) {
  if (present_.has(word.letter)) {
    reporter.error("gcode.repeated-word", word.span,
                   interpreter_says::second_letter.with({{"letter", std::string(1, word.letter)}}),
                   interpreter_says::letter_once);
    return false;
  }
  present_.add(word.letter);
  values_[letter_index(word.letter)] = value;
  spans_[letter_index(word.letter)] = word.span;
  return true;
}

}  // namespace passo
