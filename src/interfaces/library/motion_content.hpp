// Motion::Content: a planned motion in memory. MotionRecording makes it from the planner's items, StoredMoves gives the
// items again, to the step generator. Private to library/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "passo/base/source.hpp"
#include "passo/library/motion.hpp"
#include "passo/stepgen/step_generator.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo::v1 {

// A move along a curve, or a rest at a point.
struct StoredMove {
  std::uint32_t curve = 0;  // an index. A rest: of the curve at whose end the tool is
  std::uint32_t first_phase = 0;
  std::uint16_t phase_count = 0;  // 0: a rest
  passo::AxisSet downs = {};
  bool takes_up_backlash = false;
  std::uint32_t line = 0;
  double begin = 0;  // s from the start of the motion
  double rest = 0;   // s
  double to = 0;     // mm of the curve
};

struct Motion::Content {
  static constexpr std::size_t most_moves = 4'000'000;

  std::vector<passo::Curve> curves;
  std::vector<passo::Phase> phases;
  std::vector<StoredMove> moves;
  passo::Point start;
  double duration = 0;
  double length = 0;
  passo::PerAxis<passo::MmPerSecond> velocities;  // the limits of the axes
  bool has_backlash = false;
  std::optional<passo::StepOptions> machine = {};  // the motors of the program's machine
};

class MotionRecording {
 public:
  MotionRecording(const passo::Point& start, const passo::PerAxis<passo::MmPerSecond>& velocities);
  // Returns false if there is no room.
  [[nodiscard]] bool add(const passo::MotionItem& item);
  // Ends the recording. `machine`: the motors of the machine, if the motion is that of a program.
  Motion motion(std::optional<passo::StepOptions> machine = {});

 private:
  void add(const passo::PlannedMove& move);
  void add_rest(const passo::Action& action);

  std::shared_ptr<Motion::Content> content_;
  // The segment before was on the same curve: it has more phases than fit into a move.
  bool goes_on_ = false;
};

// The motion again. `motion` must outlive the stage.
class StoredMoves final : public passo::Source<passo::MotionItem> {
 public:
  explicit StoredMoves(const Motion::Content& motion) : motion_(motion) {}
  [[nodiscard]] bool next(passo::MotionItem& item) override;

 private:
  const Motion::Content& motion_;
  std::size_t next_ = 0;
};

// Finds the state at a time; fast if the times ascend.
class MotionCursor {
 public:
  explicit MotionCursor(const Motion::Content& motion) : motion_(motion) {}
  MotionState at(double time);

 private:
  void seek(double time);

  const Motion::Content& motion_;
  std::size_t move_ = 0;
};

}  // namespace passo::v1
