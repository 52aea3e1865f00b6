// BrowserCheck: what "Check my program" does in a browser: the machine's text and the program in, the results out as
// JSON. It does what `passo check --json` does, with the same functions, and keeps the path for the scene.
//
// Not computed here: the cost of a serial link, and the cutting force. Memory is bounded by the path's points
// (ProgramPath::most_points).
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "passo/api/program_path.hpp"

namespace passo {

// What is under way.
enum class CheckStage : std::uint8_t { reading, planning, proposals };

class BrowserCheck {
 public:
  // Called from time to time with the completed fraction of a stage. 0 also when it is unknown.
  using Progress = std::function<void(CheckStage stage, double share)>;

  explicit BrowserCheck(Progress progress) : progress_(std::move(progress)) {}

  // `request`: {"program": file, "machine": {"name", "text", "motor"}, "dialect", "inches", "block_delete", "tools":
  // file, "proposals"}. `motor`: keys of [axis.X.torque], for each axis without a motor. Returns the key "machine" (its
  // findings, and what it is), the keys of `passo check --json`, and "path" (as the API's path index).
  std::string check(const std::string& request);

  const ProgramPath& path() const { return path_; }

 private:
  Progress progress_;
  ProgramPath path_;
};

}  // namespace passo
