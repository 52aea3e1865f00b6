// BoardMirror: the host's copy of the board's state: executed items, inputs, and events such as stops.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "passo/link/link.hpp"
#include "passo/wire/message.hpp"

namespace passo {

class BoardMirror {
 public:
  // Stores a status and the time of its arrival. Returns true if the board has executed events since the previous
  // status.
  bool update(const BoardStatus& status, Seconds now);
  const std::optional<BoardStatus>& status() const { return status_; }
  Seconds status_time() const { return status_time_; }
  void forget_status() { status_.reset(); }
  // The motors' counts in the last status; null: there is none.
  std::int32_t* counts() { return status_ ? static_cast<std::int32_t*>(status_->positions) : nullptr; }

  // The board's answer to `about`.
  void update(const About& about) { about_ = about; }
  const std::optional<About>& about() const { return about_; }
  void forget_about() { about_.reset(); }

  // Stores the last executed item, and the free places of the board's queue at that time.
  void update_items(ItemNumber executed, int free);
  void set_room(int free) { free_ = free; }
  ItemNumber executed() const { return executed_; }
  int free() const { return free_; }
  // True: the board has received all frames, its queue is empty, and it is stopped.
  void record_rest(bool rests) { rests_ = rests; }
  bool rests() const { return rests_; }

  // Inputs are bits of BoardInput. `ignored`: the input that is used for captures and not as a switch. Returns true if
  // an input was activated.
  bool update_inputs(const BoardStatus& status, std::uint16_t ignored);
  bool record_pressed(std::uint16_t inputs);
  void set_inputs(std::uint16_t inputs) { inputs_ = inputs; }
  std::uint16_t inputs() const { return inputs_; }
  std::uint16_t take_pressed() { return std::exchange(pressed_, std::uint16_t{0}); }

  // The motors were stopped instantly by these inputs; 0: by those that are active.
  void record_stop(std::uint16_t inputs);
  void record_stop();
  std::uint16_t stopped_by() const { return stopped_by_; }
  // The motors stopped during motion, because the board could not make its events in time.
  void on_standstill(const BoardStatus& status) { standstill_ = status; }
  const std::optional<BoardStatus>& standstill() const { return standstill_; }
  // The board switches its outputs off when the host is silent, until the host sends outputs.
  void on_timeout(const BoardStatus& status, ItemNumber sent);
  void end_timeout() { outputs_timed_out_ = false; }
  bool outputs_timed_out() const { return outputs_timed_out_; }

  // Clears the events, as a handshake does. The counts, the inputs and the last status are kept.
  void forget_events();
  void begin(ItemNumber executed) { executed_ = executed; }

 private:
  std::optional<About> about_;
  std::optional<BoardStatus> status_;
  Seconds status_time_{0};
  ItemNumber executed_ = 0;
  int free_ = 0;
  bool rests_ = false;
  std::uint16_t inputs_ = 0;
  std::uint16_t pressed_ = 0;
  std::uint16_t stopped_by_ = 0;
  bool outputs_timed_out_ = false;
  std::optional<BoardStatus> standstill_;
};

}  // namespace passo
