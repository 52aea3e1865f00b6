// CodeFamily: what all families of codes (drilling, tools, probing …) share: they read the words of the block at hand,
// say what is wrong with it and push operations.
//
// Each family is a class of its own that knows its codes and what these remember from block to block. BlockExecutor
// calls it in the order of execution. A method that returns false has reported why; the rest of the block is then not
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

  // Faults. fail() says false.
  bool fail(std::string_view code, Span span, std::string message, std::string expected = {});
  bool whole_word(char letter, double lowest, double highest, std::int32_t& value);
  bool fail_at_origin(char polar_letter);
  bool report_arc(const ArcCenter& arc);
  // What to point at when a motion is wrong: its code, or where it is modal the first word that made it move.
  Span motion_span() const;

  // Places. end_point: where the block's axis words lead, in work coordinates.
  double axis_word(Axis axis) const;
  // Without G51 bit for bit what the program says.
  double scaled_place(Axis axis, double value) const {
    return state_.scaling.factor(axis) == 1 ? value : state_.scaling.place(axis, value);
  }
  double scaled_way(Axis axis, double value) const { return state_.scaling.way(axis, value); }
  bool end_point(Point& end);

  bool check_feed();
  void emit_inverse_time_feed(double length, bool rotary);
  void emit_feed_rate(double units);

  // Spindles: those of `$`, from first to before end.
  struct SpindleRange {
    std::uint8_t first = 0;
    std::uint8_t end = 1;
  };
  enum class SpindleChoice : std::uint8_t { one, one_or_all };
  bool spindle_word(SpindleChoice choice, SpindleRange& range);

  void emit(const OperationKind& what) {
    operations_.push(operations_.holding() ? kept_operation(what) : operation_of(what));
  }
  // Not behind the moves that cutter compensation holds back: what goes to the operator, or moves nothing.
  void emit_ahead(const OperationKind& what) { operations_.push_ahead(operation_of(what)); }
  // LinuxCNC tells changes of its own modes as comments, and its canonical calls are what others compare with.
  void note(std::string_view text) { emit(operation::Comment{text}); }
  Operation operation_of(const OperationKind& what) const {
    return {what, block_.source, block_.word, &block_.axis_words};
  }
  // One that is held back while other lines are read: with the text of its own.
  Operation kept_operation(const OperationKind& what = operation::Comment{}) const {
    return {what, block_.source, block_.word, &block_.axis_words, reporter_.file(), reporter_.block().text};
  }

  BlockContext& block_;
  ProgramState& state_;
  Parameters& parameters_;
  OperationQueue& operations_;
  Reporter& reporter_;
  CutterCompensation& cutter_;
  BlockWords& words_;

 private:
  bool machine_end_point(Point& end);
  bool apply_polar(Point& end);
};

}  // namespace passo
