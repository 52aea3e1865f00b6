// FollowerOnPort: the first control board at the end of a parallel port, with a plant behind its windings.
//
// Position in the pipeline: after the simulated board, as its motors. Its steps become writes of the port's registers,
// the pins' levels go into the PIC (gpsim), and each change of the windings turns a motor of the plant. No information
// flows back, so the steps are collected and played in pieces: memory is bounded for a run of any length.
//
// Times are the machine's, in nanoseconds. The chip begins `lead` earlier, and somebody presses `*`, which the board
// waits for. Before its first step a motor has no current; its rotor is assumed to stand where the first pattern of the
// table holds it.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "passo/base/result.hpp"
#include "passo/emulator/emulated_follower.hpp"
#include "passo/emulator/running_pic.hpp"
#include "passo/plant/plant.hpp"
#include "passo/port/parallel_port.hpp"
#include "passo/port/port_driver.hpp"

namespace passo {

class FollowerOnPort {
 public:
  static constexpr Nanoseconds lead = 300'000'000;
  static constexpr std::size_t most_losses = 1000;  // number of lost pulses that are recorded individually

  // Steps of one motor. A sampled step is a change of its windings.
  struct Counts {
    std::int64_t commanded = 0;      // up and down
    std::int64_t sampled = 0;        // up and down
    std::int64_t commanded_net = 0;  // up minus down
    std::int64_t sampled_net = 0;    // up minus down
    std::int64_t lost() const { return commanded - sampled; }
  };
  // A pulse without a change of the windings. Among pulses that are closer than two turns of the loop it may be any.
  struct LostPulse {
    Nanoseconds at = 0;  // of its step
    std::size_t motor = 0;
  };

  // `work`: a folder for gpsim's files. `pulse`: see PortDriver. The plant must outlive the board. The error is a
  // sentence with the reason.
  static Result<std::unique_ptr<FollowerOnPort>, std::string> start(const std::filesystem::path& image,
                                                                    const std::filesystem::path& work,
                                                                    Nanoseconds pulse, Plant& plant);

  // `watch` is called before each turn of a motor, when the plant's time has come to it.
  void set_watch(std::function<void(Seconds)> watch) { watch_ = std::move(watch); }
  // Adds a step, or a change of the tool's line, in order of time. See PortDriver.
  void step(Nanoseconds at, unsigned stepped, unsigned down);
  void switch_tool(Nanoseconds at, bool on);
  // Lets time pass: later steps are not earlier than `now`. Plays what was added if it is enough for a piece. Returns
  // false if the emulator failed; error() then gives the reason.
  [[nodiscard]] bool pass_to(Nanoseconds now);
  // Plays all that was added, and on until the last step has come out. `now`: the machine's time at the end.
  [[nodiscard]] bool finish(Nanoseconds now);

  const std::string& error() const { return error_; }
  // The time up to which the plant has been driven.
  Nanoseconds played() const { return pic_->now() - lead; }
  const Counts& counts(std::size_t motor) const { return counts_[motor]; }
  const std::vector<LostPulse>& lost_pulses() const { return lost_; }
  std::int64_t register_writes() const { return writes_; }
  int relay_closings() const { return relay_closings_; }
  bool relay_is_closed() const { return relay_is_closed_; }

 private:
  struct Pulse {
    Nanoseconds at = 0;  // of the step; the clock rises a pulse length later
    bool down = false;
  };

  FollowerOnPort(std::unique_ptr<RunningPic> pic, Nanoseconds pulse, Plant& plant);
  [[nodiscard]] bool play(Nanoseconds end, bool is_last);
  std::vector<LineChange> lines_of(const std::vector<PortWrite>& writes);
  bool take(const OutputChange& change);
  bool turn(std::size_t motor, Nanoseconds at, const std::string& windings);
  void find_pulse_of(std::size_t motor, Nanoseconds at, bool down);
  void record_lost(std::size_t motor, const Pulse& pulse);

  std::unique_ptr<RunningPic> pic_;
  Nanoseconds pulse_;
  Plant& plant_;
  PortDriver driver_;
  ParallelPort port_;
  std::array<bool, 2 * port_axes + 1> levels_{};  // of the pins of all signals
  std::array<Counts, port_axes> counts_;
  std::array<unsigned, port_axes> places_{};  // in the table of the windings
  std::array<std::deque<Pulse>, port_axes> pulses_;
  std::vector<LostPulse> lost_;
  std::int64_t writes_ = 0;
  std::int64_t steps_in_piece_ = 0;
  int relay_closings_ = 0;
  bool relay_is_closed_ = false;
  std::function<void(Seconds)> watch_;
  std::string error_;
};

}  // namespace passo
