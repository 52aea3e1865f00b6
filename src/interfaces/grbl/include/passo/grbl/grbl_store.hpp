// GrblStore: the persistent data of a Grbl controller: settings of senders (report mask, inches, start-up lines, build
// info), and numbered settings, which are part of the machine file and take effect at the next start.
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
  // Both return false on failure. A file is written only if it still has the contents passed as the first argument.
  using WriteFile = std::function<bool(const std::string& before, const std::string& after)>;
  using WriteMemory = std::function<bool(const GrblMemory&)>;

  // `machine` must outlive the store.
  explicit GrblStore(const MachineDescription& machine) : machine_(machine) {}

  void remember(GrblMemory memory, WriteMemory write);
  const GrblMemory& memory() const { return memory_; }
  // Returns false if it cannot be written; nothing has changed then.
  [[nodiscard]] bool keep(const GrblMemory& memory);

  void keep_settings(std::string text, WriteFile write);
  bool keeps_settings() const { return settings_.has_value(); }
  // Returns the machine with the current settings, including those that are not yet in effect.
  MachineDescription machine() const { return settings_ ? settings_->machine() : machine_; }
  // Requires keep_settings(). Returns the reason for a failure, as a sentence without a full stop; empty on success.
  std::optional<std::string> keep(int number, double value);

 private:
  const MachineDescription& machine_;
  GrblMemory memory_;
  WriteMemory write_memory_;
  std::optional<KeptSettings> settings_;
  WriteFile write_file_;
};

}  // namespace passo
