// GrblMotion: the whole motion of a program on a Grbl board, as GrblForecast predicts it, in the form of planned moves.
// So everything that examines the motion of our planner, e.g. whether the motors lose steps, also examines this.
//
// At a junction the speeds of the axes jump, because the board permits this within its junction deviation. Time in
// which the board rests because lines are late is a dwell.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "passo/activity/program.hpp"
#include "passo/sender/grbl_code.hpp"
#include "passo/sender/grbl_forecast.hpp"
#include "passo/session/program_motion.hpp"
#include "passo/trajectory/phase.hpp"

namespace passo {

class GrblMotion final : public ProgramMotion {
 public:
  // The program must have passed check_for_grbl(). `machine` must outlive this object.
  GrblMotion(const ProgramReader& program, const MachineDescription& machine, const InterpreterOptions& options,
             const GrblLimits& limits, const GrblLine& line, const GrblTarget& target);

  [[nodiscard]] bool next(MotionItem& item) override;
  void watch_operations(std::function<void(const Operation&)> watcher) override;
  void watch_path(std::function<void(const PathItem&)> watcher) override { path_watcher_ = std::move(watcher); }
  Seconds nominal_time() const override { return checker_.result().nominal_time; }

  // The times, after the last item.
  const GrblForecast::Result& result() const { return result_; }

 private:
  void add(const PathItem& item);
  void add(const GrblPhase& phase);
  void end_move();
  void rest(Seconds time);

  Diagnostics unheard_;
  ProgramChecker checker_;
  GrblCode code_;
  GrblForecast forecast_;
  std::function<void(const PathItem&)> path_watcher_;
  std::vector<std::string> lines_;
  std::optional<PlannedMove> move_;  // the one that gets phases
  std::deque<MotionItem> ready_;
  Seconds now_{0};  // end of the last phase or dwell
  bool ended_ = false;
  GrblForecast::Result result_;
};

}  // namespace passo
