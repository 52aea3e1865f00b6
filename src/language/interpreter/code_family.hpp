// CodeFamily: the base of all families of codes (drilling, tools, probing …). They read the words of the current block,
// report errors in it, and push operations.
//
// Each family is a class that defines its codes and their state from block to block. BlockExecutor calls the families
// in the order of execution. A method that returns false has reported an error; the rest of the block is then not
// executed. Lengths are millimetres, whatever the program's units.
#pragma once

#include <string>
#include <string_view>

#include "block_context.hpp"

namespace passo {

class CodeFamily {
 protected:
  explicit CodeFamily(BlockContext& block)
      : block_(block),
        state_(block.state),
        parameters_(block.parameters),
        operations_(block.operations),
        reporter_(block.reporter),
        cutter_(block.cutter),
        words_(block.words) {}
  ~CodeFamily() = default;

  // Errors. fail() returns false.
  bool fail(std::string_view code, Span span, FindingWords message, FindingWords expected = {});
  bool speaks_grbl() const { return block_.options.dialect == Dialect::grbl; }
  // Returns whether the word is negative by more than a rounding error, as in P[0.3-0.1-0.2].
  bool is_negative(char letter) const { return words_[letter] <= -equality_tolerance; }
  // Returns the word, or 0 if it is negative because of a rounding error.
  double never_negative(char letter) const { return words_[letter] < 0 ? 0 : words_[letter]; }
  bool whole_word(char letter, double lowest, double highest, std::int32_t& value);
  bool fail_at_origin(char polar_letter);
  bool report_arc(const ArcCenter& arc);
  // Returns whether a failed line would have moved an axis of the plane.
  bool starts_in_doubt() const;
  // Returns the position of a diagnostic about a motion: the motion's code or, if the code is modal, the first word
  // that caused the move.
  Span motion_span() const;
  LetterSet letters_of(const CodeEntry& entry) const;

  // Positions. end_point: the end position given by the block's axis words, in work coordinates.
  double axis_word(Axis axis) const { return words_[letter_of(axis)] * state_.units_of(axis) * diameter_factor(axis); }
  // Returns 0.5 for X words if they are diameters (G7), otherwise 1.
  double diameter_factor(Axis axis) const;
  // Without G51, returns the programmed value bit for bit.
  double scaled_place(Axis axis, double value) const {
    return state_.scaling.factor(axis) == 1 ? value : state_.scaling.place(axis, value);
  }
  double scaled_way(Axis axis, double value) const { return state_.scaling.way(axis, value); }
  bool end_point(Point& end);

  bool check_feed();
  void emit_inverse_time_feed(double length, bool rotary);
  void emit_feed_rate(double units);

  // The spindles selected by `$`: from first, up to but excluding end.
  struct SpindleRange {
    std::uint8_t first = 0;
    std::uint8_t end = 1;
  };
  enum class SpindleChoice : std::uint8_t { one, one_or_all };
  bool spindle_word(SpindleChoice choice, SpindleRange& range);

  void emit(const OperationKind& what) {
    operations_.push(operations_.holding() ? kept_operation(what) : operation_of(what));
  }
  // Pushes an operation before the moves held back by cutter compensation: one that addresses the operator, or moves
  // nothing.
  void emit_ahead(const OperationKind& what) { operations_.push_ahead(operation_of(what)); }
  // LinuxCNC reports changes of its modes as comments. Passo does the same, so that its canonical calls can be
  // compared.
  void emit_comment(std::string_view text) { emit(operation::Comment{text}); }
  Operation operation_of(const OperationKind& what) const {
    return {what, block_.source, block_.word, &block_.axis_words, goes_to_machine()};
  }
  // Returns an operation that is held back while other lines are read, so it owns the text of its line.
  Operation kept_operation(const OperationKind& what = operation::Comment{}) const {
    return {what,
            block_.source,
            block_.word,
            &block_.axis_words,
            goes_to_machine(),
            reporter_.file(),
            reporter_.block().text};
  }

  BlockContext& block_;
  ProgramState& state_;
  Parameters& parameters_;
  OperationQueue& operations_;
  Reporter& reporter_;
  CutterCompensation& cutter_;
  BlockWords& words_;

 private:
  bool goes_to_machine() const {
    const CodeEntry* const entry = words_.code(ModalGroup::non_modal);
    return entry != nullptr && (entry->number == code(53) || entry->number == code(28) || entry->number == code(30));
  }
  bool machine_end_point(Point& end);
  bool apply_polar(Point& end);
};

}  // namespace passo
