// PendantJog: turns the motion of a wheel or a ring into jogs.
//
// Step mode: each detent is one step. Detents that come while a jog runs are added up, and become the next one. What
// is left of the jog and what waits are together never more than the machine moves in `most_behind`, or one step: a
// wheel that is turned faster than the machine can move queues up no motion; the detents in excess are dropped.
//
// Continuous mode, and the ring: the machine moves as long as the wheel turns or the ring is held. It asks for the end
// as soon as the wheel pauses.
//
// Invariant: at most one jog runs. Nothing begins while the machine does something else, and nothing waits for it.
#pragma once

#include <cstdint>
#include <optional>

#include "passo/geometry/axes.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/units/units.hpp"

namespace passo {

// A jog of one axis.
struct PendantMove {
  Axis axis = Axis::x;
  int sign = 1;
  MmPerSecond speed{0};  // the highest
  double share = 1;      // of the speed
  double distance = 0;   // mm or degrees; 0: until it is stopped

  bool is_same_way(const PendantMove& other) const { return axis == other.axis && sign == other.sign; }
};

// The machine, as PendantJog sees it.
class PendantJogPort {
 public:
  virtual ~PendantJogPort() = default;
  // Returns false if the machine refuses.
  virtual bool begin(const PendantMove& move) = 0;
  virtual void renew(double share) = 0;
  virtual void stop() = 0;
  // Whether the jog that has begun is still running.
  virtual bool jogs() const = 0;
};

class PendantJog {
 public:
  static constexpr Seconds most_behind{0.1};
  static constexpr Seconds renews_every{0.03};

  // Both must outlive this object. `pause`: after that time without a detent the wheel has stopped.
  PendantJog(const MachineDescription& machine, PendantJogPort& port, Seconds pause)
      : machine_(machine), port_(port), pause_(pause) {}

  // Selects the axis; empty: none. What moves ends.
  void select(std::optional<Axis> axis);
  std::optional<Axis> axis() const { return axis_; }

  // The wheel was turned in step mode. `step`: of one detent.
  void step(int detents, double step, double share, Seconds now);
  // The wheel was turned in continuous mode.
  void turn(int detents, double share, Seconds now);
  // The ring was moved. `sign` 0: let go.
  void hold_ring(int sign, double share);
  // Ends what moves, and drops what waits.
  void end();
  void poll(Seconds now);

 private:
  const AxisDescription* selected() const;
  void drop();
  void watch_end();
  void watch_pause(Seconds now);
  void keep_going(Seconds now);
  void begin_next(Seconds now);
  double left_of_jog(Seconds now) const;

  const MachineDescription& machine_;
  PendantJogPort& port_;
  const Seconds pause_;
  std::optional<Axis> axis_;
  double waiting_ = 0;  // signed distance
  double step_share_ = 1;
  std::optional<PendantMove> held_;     // by the wheel or the ring
  bool by_ring_ = false;                // held_ lasts until the ring is let go
  std::optional<PendantMove> current_;  // the jog
  bool brakes_ = false;
  std::optional<PendantMove> barred_;  // ended by itself or was refused: it begins again after a pause only
  Seconds turned_at_{0};
  Seconds begun_at_{0};
  Seconds renewed_at_{0};
};

}  // namespace passo
