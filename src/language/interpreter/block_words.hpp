// BlockWords: the words of one block with their values: codes by modal group, numbers by letter.
#pragma once

#include <array>

#include "code_table.hpp"
#include "reporter.hpp"

#include "passo/gcode/block.hpp"
#include "passo/gcode/expression.hpp"
#include "passo/interpreter/operation.hpp"

namespace passo {

// Returns the bit of a group in BlockWords::groups().
constexpr std::uint32_t bit_of(ModalGroup group) {
  return std::uint32_t{1} << index_of(group);
}

class BlockWords {
 public:
  // Evaluates the words of `block`. Returns false if a word is unknown, has no value, occurs twice, or belongs to a
  // group that already has a code. All such words are reported.
  [[nodiscard]] bool read(const Block& block, const ParameterValues& parameters, Reporter& reporter);
  void clear();

  bool has(char letter) const { return present_.has(letter); }
  double operator[](char letter) const { return values_[letter_index(letter)]; }
  Span span(char letter) const { return spans_[letter_index(letter)]; }
  LetterSet present() const { return present_; }  // without G and codes of M
  // Returns whether the block has G65 or G66. The words after it are arguments, including M.
  bool calls_macro() const { return calls_macro_; }
  // Sets the positions of the axis words in the line.
  void find_axes(AxisWords& places) const;
  bool any_axis() const { return (present_ & (axis_letters | polar_letters)).any(); }

  const CodeEntry* code(ModalGroup group) const { return codes_[index_of(group)]; }
  bool has_code(ModalGroup group, CodeNumber number) const {
    const CodeEntry* const entry = code(group);
    return entry != nullptr && entry->number == number;
  }
  Span span(ModalGroup group) const { return code_spans_[index_of(group)]; }
  // Returns whether a code of another group uses the word.
  bool is_of_another(char letter, ModalGroup group) const;
  // Returns the bits of the groups of which the block has a code.
  std::uint32_t groups() const { return groups_; }

 private:
  bool read_code(const Word& word, double value, Reporter& reporter);
  bool read_number(const Word& word, double value, Reporter& reporter);

  LetterSet present_;
  bool calls_macro_ = false;
  std::uint32_t groups_ = 0;
  // Only the entries listed in present_ and groups_ are up to date. codes_ is up to date as a whole.
  std::array<double, letter_count> values_{};
  std::array<Span, letter_count> spans_{};
  std::array<const CodeEntry*, modal_group_count> codes_{};
  std::array<Span, modal_group_count> code_spans_{};
};

// Evaluates an expression; reports an expression without a value. Most expressions are a single number, which is fast.
inline bool value_of(const Block& block, const Expression& expression, const ParameterValues& parameters,
                     Reporter& reporter, double& value) {
  const Instruction& first = block.code[expression.first];
  if (expression.count == 1 && first.op == ExpressionOp::number) {
    value = first.number;
    return true;
  }
  UnsetParameter unset;
  const Evaluation evaluation = evaluate(block, expression, parameters, &unset);
  if (unset.number != 0) reporter.warn_of(unset);
  if (evaluation) {
    value = *evaluation;
    return true;
  }
  reporter.error(evaluation.error());
  return false;
}

}  // namespace passo
