// BlockWords: the words of one block with their values, sorted by what they are: codes by modal group, values by
// letter.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "code_table.hpp"
#include "parameters.hpp"
#include "reporter.hpp"

#include "passo/gcode/block.hpp"

namespace passo {

struct CodeWord {
  const Code* code = nullptr;
  Span span;
  explicit operator bool() const { return code != nullptr; }
  bool is(std::int32_t tenths) const { return code != nullptr && code->number == tenths; }
};

class BlockWords {
 public:
  // Evaluates and sorts. False when a word is wrong or stands twice; that is reported.
  [[nodiscard]] bool gather(const Block& block, const Parameters& parameters, const Reporter& reporter);

  bool has(char letter) const { return values_[index(letter)].has_value(); }
  // Asks for a word's value, and takes it as used. Zero where it is not there.
  double take(char letter) {
    used_[index(letter)] = true;
    return values_[index(letter)].value_or(0);
  }
  std::optional<double> take_if(char letter) {
    used_[index(letter)] = true;
    return values_[index(letter)];
  }
  double peek(char letter) const { return values_[index(letter)].value_or(0); }
  Span span(char letter) const { return spans_[index(letter)]; }
  bool has_axis_word() const;
  // A letter that nothing has taken; zero if none.
  char unused() const;

  const CodeWord& code(ModalGroup group) const { return codes_[static_cast<std::size_t>(group)]; }
  // The polar words @ (distance) and ^ (angle).
  const std::optional<double>& polar_radius() const { return polar_radius_; }
  const std::optional<double>& polar_angle() const { return polar_angle_; }
  bool has_polar() const { return polar_radius_ || polar_angle_; }
  // M7 and M8, which may stand together.
  bool mist() const { return mist_; }
  bool flood() const { return flood_; }
  // What the block begins with, for messages about the whole block.
  Span first() const { return first_; }

 private:
  static std::size_t index(char letter) { return static_cast<std::size_t>(letter - 'A'); }
  [[nodiscard]] bool add_code(const Word& word, double value, const Reporter& reporter);

  std::array<std::optional<double>, 26> values_;
  std::array<Span, 26> spans_;
  std::array<bool, 26> used_{};
  std::array<CodeWord, modal_group_count> codes_;
  std::optional<double> polar_radius_;
  std::optional<double> polar_angle_;
  bool mist_ = false;
  bool flood_ = false;
  Span first_;
};

}  // namespace passo
