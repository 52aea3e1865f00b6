// Jog: axes moved by hand, for as long as someone holds the button: a dead man's lease.
//
// A jog goes straight, at the given speed, and only so far as the travel of the machine or the distance given. It
// needs a lease that is renewed: nothing is committed beyond the lease's end but braking, so that the machine begins to
// brake at that very time at the latest, whatever the horizon. A lease that is lost does not come back: it takes
// another jog. Limits of the axes hold as in a job; steps are counted as in a job.
#pragma once

#include <cstdint>

#include "passo/controller/motion_drive.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

struct JogRequest {
  Point direction;       // of any length; on the axes that the machine has
  MmPerSecond speed{0};  // along it, above 0; the axes' limits hold
  Mm distance{0};        // 0: as far as the travel goes
  Seconds lease{0.2};    // of the start, and of each renewal; longer than the horizon
  LiveOptions live = {};
};

class Jog {
 public:
  // From rest at `start`, in machine coordinates. A direction that is 0 or leaves the travel at once is no motion.
  // `machine` outlives the jog.
  Jog(const MachineDescription& description, VirtualMachine& machine, const Point& start, const JogRequest& request);

  // Goes on a little. False at rest, at the end.
  [[nodiscard]] bool advance();
  // For another lease from now on; without effect on a jog that has begun to brake.
  void renew() { lease_end_ = drive_.now() + request_.lease; }
  // Brakes at once, behind what is committed.
  void stop() { drive_.stop(); }

  // Where it would come to rest if nobody stopped it.
  const Point& target() const { return path_.target; }
  // Where it is, or ended: the end of the motion that is committed.
  const Point& place() const { return place_; }
  MotionDrive& drive() { return drive_; }

 private:
  // One line, and its end.
  struct Line final : Source<PathItem> {
    Line(const MachineDescription& description, const Point& from, const JogRequest& request);
    [[nodiscard]] bool next(PathItem& item) override;
    Point start;
    Point target;
    MmPerSecond speed{0};
    bool given = false;
  };

  JogRequest request_;
  Line path_;
  MotionDrive drive_;
  Seconds lease_end_{0};
  Point place_;
};

}  // namespace passo
