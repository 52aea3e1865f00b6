// SimulatedPath: the way of a tool's tip through a program, in the coordinates of the work.
//
// The machine's coordinates are those of the spindle: with a tool length offset (G43) the tip is lower by the tool's
// length. A tip's place is machine - tool offset, less the zero of the work system in force at the first move. So a
// part that is cut in G54 and G55 lies as on the machine.
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
  const Segment* segment = nullptr;   // in machine coordinates, until the next move
  Point zero;                         // tip = machine - zero
  std::int32_t tool = 0;              // its number; 0: none was changed to
  Seconds time{0};                    // at the programmed speed; 0 for a rapid of an unknown machine
  double revolutions_per_minute = 0;  // of the spindle as commanded; 0: it stands, or has no speed
};

class SimulatedPath {
 public:
  // `machine`: whose path is followed, with its corners rounded; null: the path as the program has it. `diagnostics`
  // and `machine` outlive the path. `beside`: axes that a program has beside X Y Z, where there is no machine.
  SimulatedPath(ProgramReader program, const InterpreterOptions& options, const MachineDescription* machine,
                Diagnostics& diagnostics, AxisSet beside = {});

  [[nodiscard]] bool next(TipMove& move);

 private:
  // Where the zero of the work lies for the spindle, and how much of that is the tool's offset.
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
  std::unique_ptr<PathSmoother> smoother_;  // null: no machine
  std::deque<Zeros> zeros_;                 // of the segments that the smoother still has, each once
  std::optional<Point> first_zero_;
  std::int32_t tool_ = 0;
  double revolutions_per_minute_ = 0;
  PathItem item_;
};

}  // namespace passo
