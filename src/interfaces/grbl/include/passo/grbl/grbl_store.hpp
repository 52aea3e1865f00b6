// GrblStore: what a Grbl controller keeps over a restart: what senders have chosen (report mask, inches, start lines,
// the build's words), and numbered settings, which stand in the machine file and count from the next start on.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "passo/grbl/grbl_memory.hpp"
#include "passo/grbl/kept_settings.hpp"
#include "passo/machine_file/machine_description.hpp"

namespace passo {

class GrblStore {
 public:
  // Both return false if that is not possible. A file is written only if it is still the text that is given first.
  using WriteFile = std::function<bool(const std::string& before, const std::string& after)>;
  using WriteMemory = std::function<bool(const GrblMemory&)>;

  // `machine` outlives the store.
  explicit GrblStore(const MachineDescription& machine) : machine_(machine) {}

  void remember(GrblMemory memory, WriteMemory write);
  const GrblMemory& memory() const { return memory_; }
  // False: it cannot be written, and nothing has changed.
  [[nodiscard]] bool keep(const GrblMemory& memory);

  void keep_settings(std::string text, WriteFile write);
  bool keeps_settings() const { return settings_.has_value(); }
  // The machine as its settings say, also those that do not count yet.
  MachineDescription machine() const { return settings_ ? settings_->machine() : machine_; }
  // Only with keep_settings(). Empty: it is kept; else why not, as a sentence without a full stop.
  std::optional<std::string> keep(int number, double value);

 private:
  const MachineDescription& machine_;
  GrblMemory memory_;
  WriteMemory write_memory_;
  std::optional<KeptSettings> settings_;
  WriteFile write_file_;
};

}  // namespace passo
