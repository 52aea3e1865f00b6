// WindingRecord: windings, phase currents and rotors over time, in three formats. A record is started with the motors'
// names, receives each pulse, and is finished.
//
//   CSV      a row per pulse: the time, then for each motor its position, F1 to F4, the currents of A and B, the angle
//            of the rotor in degrees
//   VCD      the same as waveforms for GTKWave: x_F1 … x_F4, x_place, and the real numbers x_A, x_B, x_deg
//   picture  draw_windings()
//
// Where the motor and the stage that switches it are known, the currents rise and fall over time, and CSV and VCD have
// further rows between the pulses while they do. Else a current is at once what the pattern says. The rotor is ideal:
// it follows the direction of the field, like an unloaded rotor at standstill.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "passo/motor/excitation.hpp"
#include "passo/motor/winding_current.hpp"
#include "passo/report/output_file.hpp"
#include "passo/report/picture.hpp"
#include "passo/study/step_move.hpp"
#include "passo/units/units.hpp"

namespace passo {

inline constexpr unsigned winding_outputs = 4;  // outputs of each motor: F1 to F4

// One transistor for each output, with its winding. `rated` is the current that counts as 1.
struct WindingStage {
  WindingCircuit circuit = {};
  Amperes rated = {};
};

struct WindingMotors {
  Excitation excitation;
  std::int32_t full_steps_per_turn = 200;
  std::size_t count = 1;                   // number of motors x, y, z …
  std::optional<WindingStage> stage = {};  // none: currents without a rise
};

// A pulse and its time.
struct TimedPulse {
  Seconds time{0};
  Pulse pulse;
};

class PhaseCurrents;

class WindingRecord {
 public:
  virtual ~WindingRecord() = default;
  virtual void add(const TimedPulse& pulse) = 0;
  // Must be called after the last pulse; `end` is the end of the last step.
  virtual void finish(Seconds end) = 0;
};

// Both begin at position 0 and write into `file`, which must outlive them; the caller commits it.
class WindingCsv final : public WindingRecord {
 public:
  WindingCsv(const WindingMotors& motors, OutputFile& file);
  ~WindingCsv() override;
  void add(const TimedPulse& pulse) override;
  void finish(Seconds end) override;

 private:
  void put_row(Seconds time);

  WindingMotors motors_;
  OutputFile& file_;
  Place place_;
  std::unique_ptr<PhaseCurrents> currents_;
};

class WindingVcd final : public WindingRecord {
 public:
  WindingVcd(const WindingMotors& motors, OutputFile& file);
  ~WindingVcd() override;
  void add(const TimedPulse& pulse) override;
  void finish(Seconds end) override;

 private:
  void put_motor(std::string& text, std::size_t motor) const;
  void put_currents(std::string& text, std::size_t motor) const;
  void put_moment();
  void put_time(std::string& text, Seconds time);

  WindingMotors motors_;
  OutputFile& file_;
  Place place_;
  std::unique_ptr<PhaseCurrents> currents_;
  std::int64_t now_ = 0;  // ns
};

struct WindingScene {
  static constexpr std::size_t most_pulses = 2000;

  WindingMotors motors;
  std::vector<TimedPulse> pulses = {};
  Seconds end{0};
};

// Draws a column for each motor: its four outputs, the currents of its phases, and its rotor, over time. Draws into
// `file`; the caller commits it.
Status<OutputError> draw_windings(const WindingScene& scene, const PictureOptions& options, OutputFile& file);

}  // namespace passo
