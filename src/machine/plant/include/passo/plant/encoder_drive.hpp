// EncoderDrive: a motor's drive with an encoder on the shaft. The drive measures how far the rotor is behind its
// commanded place, and with `closes_loop` it brings the rotor back.
//
//   error = commanded (the pulses so far) − counted        looked at once in each cycle
//
//   in reach:      field = commanded                       as an open-loop drive
//   out of reach:  field = counted + lead                  the rotor keeps step, whatever holds it
//                  lead  = wanted speed − counted speed, at most a full step; the wanted speed is that of the pulses,
//                          and a part that falls with the error, so that the rotor arrives without a jump
//
// The rotor of an open-loop drive falls out of step when the error is more than two full steps, and never comes back.
// All places are in steps of the driver. docs/decisions/0087 says why the loop is closed here and not in the host.
#pragma once

#include <cstdint>

#include "passo/motor/bounded_motor.hpp"

namespace passo {

struct EncoderModel {
  double counts_per_step = 1;
  double most_error = 0;     // steps; beyond it the drive gives its alarm. 0: no limit
  bool closes_loop = false;  // false: the drive only measures
};

class EncoderDrive {
 public:
  static constexpr Seconds cycle{0.25e-3};

  EncoderDrive(const EncoderModel& model, const MotorSetup& setup);

  // Pulses of the board, at once.
  void pulse(BoundedMotor& rotor, std::int64_t steps);
  // Lets time pass, with a look in each cycle.
  void run(BoundedMotor& rotor, Seconds time);

  // Nothing is going on, and nothing will until the next pulse.
  bool rests(const BoundedMotor& rotor) const { return rotor.rests() && !recovers_ && settled_; }
  // As counted in the last cycle, in steps. Positive: the rotor is behind.
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
  double strength_;   // steps/s² that a full step of lead gives to the free rotor
  double delay_;      // s, of the currents
  std::int64_t commanded_ = 0;
  std::int64_t field_ = 0;
  Seconds since_{0};  // the last look
  double last_counted_ = 0;
  double last_commanded_ = 0;
  double speed_ = 0;   // counted, steps/s
  double wanted_ = 0;  // of the pulses, steps/s
  double error_ = 0;
  Seconds slow_{0};  // how long the rotor has hardly moved, in recovery
  bool recovers_ = false;
  bool settled_ = true;
  bool is_alarmed_ = false;
};

}  // namespace passo
