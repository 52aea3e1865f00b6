// EncoderDrive: a motor's drive with an encoder on the shaft. The drive measures the following error, and with
// `closes_loop` it corrects the rotor's position.
//
//   error = commanded (the pulses so far) − counted        sampled once per cycle
//
//   in reach:      field = commanded                       like an open-loop drive
//   out of reach:  field = counted + lead                  the rotor stays synchronous under any load
//                  lead  = wanted speed − counted speed, at most a full step; the wanted speed is that of the pulses,
//                          plus a part that falls with the error, so that the rotor arrives smoothly
//
// The rotor of an open-loop drive loses synchronism when the error exceeds two full steps, and the steps stay lost. All
// positions are in driver steps. docs/decisions/0087 explains why the loop is closed here and not in the host.
#pragma once

#include <cstdint>

#include "passo/motor/bounded_motor.hpp"

namespace passo {

struct EncoderModel {
  double counts_per_step = 1;
  double most_error = 0;     // steps; a larger error triggers the drive's alarm. 0: no limit
  bool closes_loop = false;  // false: the drive only measures
};

class EncoderDrive {
 public:
  static constexpr Seconds cycle{0.25e-3};

  EncoderDrive(const EncoderModel& model, const MotorSetup& setup);

  // Processes pulses of the board at the present time.
  void pulse(BoundedMotor& rotor, std::int64_t steps);
  // Lets time pass, with one sample per cycle.
  void run(BoundedMotor& rotor, Seconds time);

  // Returns true if the drive is settled, and stays so until the next pulse.
  bool rests(const BoundedMotor& rotor) const { return rotor.rests() && !recovers_ && settled_; }
  // The error counted in the last cycle, in steps. Positive: the rotor is behind.
  double error() const { return error_; }
  double most_error() const { return model_.most_error; }
  bool is_alarmed() const { return is_alarmed_; }
  bool closes_loop() const { return model_.closes_loop; }

 private:
  void update(BoundedMotor& rotor);
  void recover(BoundedMotor& rotor);
  void set_field(BoundedMotor& rotor, std::int64_t place);
  double counted(const BoundedMotor& rotor) const;
  double reach() const;

  EncoderModel model_;
  double full_step_;  // in steps
  double strength_;   // acceleration of the free rotor per full step of lead, in steps/s²
  double delay_;      // delay of the currents, in seconds
  std::int64_t commanded_ = 0;
  std::int64_t field_ = 0;
  Seconds since_{0};  // time since the last sample
  double last_counted_ = 0;
  double last_commanded_ = 0;
  double speed_ = 0;   // counted, steps/s
  double wanted_ = 0;  // speed of the pulses, steps/s
  double error_ = 0;
  Seconds slow_{0};  // how long the rotor has hardly moved during recovery
  bool recovers_ = false;
  bool settled_ = true;
  bool is_alarmed_ = false;
};

}  // namespace passo
