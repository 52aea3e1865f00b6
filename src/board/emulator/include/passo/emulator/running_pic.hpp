// RunningPic: a PIC16F877A with the follower's program in gpsim, run piece by piece: the chip keeps its state from one
// piece to the next, and memory stays bounded. Where gpsim stops within an instruction of two cycles, the chip may be a
// cycle early from there on. With a piece a second this is at most 1 ppm, far less than the tolerance of a crystal.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "passo/base/result.hpp"
#include "passo/emulator/emulated_follower.hpp"

namespace passo {

class RunningPic {
 public:
  // Starts gpsim in the folder `work`, which it needs until its end. `keys`: the keys that will be pressed, e.g.
  // "key.*". The error is a sentence with the reason.
  static Result<std::unique_ptr<RunningPic>, std::string> start(PicFollower board, const std::filesystem::path& image,
                                                                const std::filesystem::path& work,
                                                                std::span<const std::string> keys,
                                                                Turns turns = Turns::unwatched);
  ~RunningPic();
  RunningPic(const RunningPic&) = delete;
  RunningPic& operator=(const RunningPic&) = delete;

  // Adds changes of the inputs, in order of time, none earlier than now() or than changes added before.
  void add(std::span<const LineChange> lines);
  // Runs up to a time shortly before `end`, at which no input changes; perhaps not at all. All changes before `end`
  // must have been added. Returns the changes of the outputs since the last call. The error is a sentence with the
  // reason.
  Result<FollowerRun, std::string> run_before(Nanoseconds end);
  // Runs up to `end` itself. Changes that are added later must be later by more than two cycles.
  Result<FollowerRun, std::string> run_to(Nanoseconds end);
  // The time up to which the chip has run.
  Nanoseconds now() const;
  // Whether the program has ever written to a port. Firmware for another chip never does.
  bool has_written() const;

 private:
  struct State;
  explicit RunningPic(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace passo
