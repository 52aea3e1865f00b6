// same_meaning: compares two blocks, ignoring positions in their lines. This defines parse(print(b)) == b.
#pragma once

#include <algorithm>
#include <bit>

#include "passo/gcode/block.hpp"

namespace passo {

inline bool same_meaning(const Block& a, const Block& b) {
  const auto same_instruction = [](const Instruction& x, const Instruction& y) {
    // Compares the bits, so that 0 and -0 differ.
    return x.op == y.op && x.symbol == y.symbol &&
           std::bit_cast<std::uint64_t>(x.number) == std::bit_cast<std::uint64_t>(y.number);
  };
  const auto same_expression = [&](const Expression& x, const Expression& y) {
    return x.count == y.count && std::equal(a.code.begin() + x.first, a.code.begin() + x.first + x.count,
                                            b.code.begin() + y.first, same_instruction);
  };
  const auto same_optional = [&](const auto& x, const auto& y) {
    return x.has_value() == y.has_value() && (!x || same_expression(*x, *y));
  };
  const auto same_control = [&](const Control& x, const Control& y) {
    return x.kind == y.kind && x.label == y.label && same_optional(x.computed_label, y.computed_label) &&
           std::ranges::equal(x.arguments, y.arguments, same_expression);
  };
  return a.block_delete == b.block_delete && a.percent == b.percent && a.line_number == b.line_number &&
         std::ranges::equal(
             a.words, b.words,
             [&](const Word& x, const Word& y) { return x.letter == y.letter && same_expression(x.value, y.value); }) &&
         std::ranges::equal(a.assignments, b.assignments,
                            [&](const Assignment& x, const Assignment& y) {
                              return same_optional(x.index, y.index) && x.symbol == y.symbol &&
                                     same_expression(x.value, y.value);
                            }) &&
         std::ranges::equal(
             a.comments, b.comments,
             [](const BlockComment& x, const BlockComment& y) { return x.kind == y.kind && x.text == y.text; }) &&
         a.control.has_value() == b.control.has_value() && (!a.control || same_control(*a.control, *b.control));
}

}  // namespace passo
