// WindingRecord: windings, phase currents and rotors over time, in three forms. A record is started with the motors'
// names, then told each pulse, then finished.
//
//   CSV   a row a pulse: the time, then for each motor its place, F1 to F4, the currents of A and B, the rotor's
//   degrees VCD   the same as waves for GTKWave: x_F1 … x_F4, x_place, and the real numbers x_A, x_B, x_deg
//
// The rotor is ideal: it follows the direction of the field, like an unloaded rotor at standstill.
#pragma once

#include <string>
#include <vector>

#include "passo/motor/excitation.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"
#include "passo/study/step_move.hpp"
#include "passo/units/units.hpp"

namespace passo {

inline constexpr unsigned winding_outputs = 4;  // of a motor: F1 to F4

struct WindingMotors {
  Excitation excitation;
  std::int32_t full_steps_per_turn = 200;
  std::size_t count = 1;  // motors x, y, z …
};

// A pulse, and when it comes.
struct TimedPulse {
  Seconds time{0};
  Pulse pulse;
};

class WindingRecord {
 public:
  virtual ~WindingRecord() = default;
  virtual void add(const TimedPulse& pulse) = 0;
  // Nothing moves any more; `end` is when the last step is over.
  virtual void finish(Seconds end) = 0;
};

// Both begin at place 0 and write into `file`, which must outlive them and which the caller commits.
class WindingCsv final : public WindingRecord {
 public:
  WindingCsv(const WindingMotors& motors, OutputFile& file);
  void add(const TimedPulse& pulse) override;
  void finish(Seconds end) override;

 private:
  void put_row(Seconds time);

  WindingMotors motors_;
  OutputFile& file_;
  Place place_;
};

class WindingVcd final : public WindingRecord {
 public:
  WindingVcd(const WindingMotors& motors, OutputFile& file);
  void add(const TimedPulse& pulse) override;
  void finish(Seconds end) override;

 private:
  void put_motor(std::string& text, std::size_t motor) const;
  void put_time(std::string& text, Seconds time);

  WindingMotors motors_;
  OutputFile& file_;
  Place place_;
  std::int64_t now_ = 0;  // ns
};

struct WindingScene {
  static constexpr std::size_t most_pulses = 2000;

  WindingMotors motors;
  std::vector<TimedPulse> pulses = {};
  Seconds end{0};
};

// A column for each motor: its four outputs, the currents of its phases, and its rotor, over time. Draws into `file`,
// which the caller commits.
Status<OutputError> draw_windings(const WindingScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
