// Executor: gives a block's words their meaning, in the order of RS274/NGC (NIST RS274/NGC 3.8), and emits operations.
//
// executor.cpp has the order and the modal words, moves.cpp what moves, offsets.cpp what moves the frame.
#pragma once

#include <vector>

#include "arc_geometry.hpp"
#include "block_words.hpp"
#include "modal_state.hpp"
#include "reporter.hpp"

#include "passo/interpreter/operation.hpp"

namespace passo {

class Executor {
 public:
  Executor(ModalState& state, const Reporter& reporter, std::vector<Operation>& operations)
      : state_(state), reporter_(reporter), operations_(operations) {}

  // What every program begins with.
  void begin();
  // False when the block is wrong. What it emitted before is then of no use.
  [[nodiscard]] bool execute(BlockWords& words, const OperationSource& source);
  bool program_ended() const { return ended_; }

  void emit(OperationKind what);
  void set_source(const OperationSource& source) { source_ = source; }

 private:
  // executor.cpp
  bool check_words(BlockWords& words);
  bool feed_mode(BlockWords& words);
  bool feed_rate(BlockWords& words);
  bool spindle_speed(BlockWords& words);
  bool tool(BlockWords& words);
  void spindle(const BlockWords& words);
  void coolant(const BlockWords& words);
  bool dwell(BlockWords& words);
  void plane_and_units(const BlockWords& words);
  bool path_mode(BlockWords& words);
  void distance_modes(const BlockWords& words);
  void stop(const BlockWords& words);
  void end_program();

  // offsets.cpp
  bool tool_length(BlockWords& words);
  void work_offset(const BlockWords& words);
  bool non_modal(BlockWords& words);
  bool set_work_offset(BlockWords& words);
  void set_g92(BlockWords& words);
  bool go_home(BlockWords& words, std::size_t which);
  bool system_of(BlockWords& words, std::size_t& system);
  void emit_work_offset();

  // Changes the frame while the tool stays where it is: afterwards its work position is another one.
  template <class Change>
  void change_frame(Change change) {
    const Point machine = state_.frame.machine_from_work(state_.work);
    change();
    state_.work = state_.frame.work_from_machine(machine);
  }

  // moves.cpp
  bool motion(BlockWords& words);
  bool straight(BlockWords& words, bool rapid);
  bool arc(BlockWords& words, bool clockwise);
  bool arc_center(BlockWords& words, const Point& end, bool clockwise, PlanePoint& center);
  bool synchronised(BlockWords& words);
  bool feed_is_set(BlockWords& words);
  void inverse_time(BlockWords& words, double length);
  bool end_point(BlockWords& words, Point& end);
  bool polar_point(const BlockWords& words, Point& end) const;
  double length_word(BlockWords& words, char letter) { return words.take(letter) * state_.scale(); }

  ModalState& state_;
  const Reporter& reporter_;
  std::vector<Operation>& operations_;
  OperationSource source_;
  bool ended_ = false;
};

}  // namespace passo
