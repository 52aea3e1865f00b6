// SimulatedPath: the path of a tool's tip through a program, in work coordinates.
//
// Machine coordinates are those of the spindle: with a tool length offset (G43) the tip is lower by the tool's length.
// The tip's position is machine - tool offset, minus the zero of the work coordinate system that is active at the first
// move. A part that is cut in both G54 and G55 is therefore positioned as on the machine.
#pragma once

#include <deque>
#include <memory>
#include <optional>

#include "passo/activity/stage_options.hpp"
#include "passo/base/tap.hpp"
#include "passo/geometry/axes.hpp"
#include "passo/interpreter/interpreter.hpp"
#include "passo/machine_file/machine_description.hpp"
#include "passo/path/path_builder.hpp"
#include "passo/path/path_smoother.hpp"

namespace passo {

struct TipMove {
  const Segment* segment = nullptr;   // in machine coordinates; valid until the next move
  Point zero;                         // tip = machine - zero
  std::int32_t tool = 0;              // tool number; 0: no tool was loaded
  Seconds time{0};                    // at the programmed feed rate; 0 for a rapid without a machine
  double revolutions_per_minute = 0;  // commanded spindle speed; 0: stopped, or without a speed
};

class SimulatedPath {
 public:
  // `machine`: the machine whose path is followed, with rounded corners; null: the programmed path. `diagnostics` and
  // `machine` must outlive the path. `beside`: the program's axes other than X Y Z, used without a machine.
  SimulatedPath(ProgramReader program, const InterpreterOptions& options, const MachineDescription* machine,
                Diagnostics& diagnostics, AxisSet beside = {});

  [[nodiscard]] bool next(TipMove& move);

 private:
  // The work zero in spindle coordinates, and the part of it that is the tool offset.
  struct Zeros {
    Point work;
    Point tool;
  };

  void record_zeros(const PathItem& item);
  Point zero_of(const Segment& segment);

  Diagnostics& diagnostics_;
  PathOptions path_options_;
  std::optional<MotionLimits> limits_;
  Interpreter interpreter_;
  PathBuilder builder_;
  Tap<PathItem> watched_;
  std::unique_ptr<PathSmoother> smoother_;  // null without a machine
  std::deque<Zeros> zeros_;                 // the zeros of the segments that are still in the smoother, each once
  std::optional<Point> first_zero_;
  std::int32_t tool_ = 0;
  double revolutions_per_minute_ = 0;
  PathItem item_;
};

}  // namespace passo
