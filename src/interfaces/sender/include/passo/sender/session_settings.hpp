// SessionSettings: the settings of the board of a GrblMachineSession, for senders. Each write borrows the session's
// sender, and reads the value back (FirmwareSettings).
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "passo/sender/firmware_settings.hpp"
#include "passo/session/numbered_settings.hpp"

namespace passo {

class GrblMachineSession;

class SessionSettings final : public NumberedSettings {
 public:
  static constexpr Seconds longest_wait_for_rest{5};
  static constexpr Seconds longest_write{20};

  // `session` must outlive this object.
  explicit SessionSettings(GrblMachineSession& session) : session_(session) {}

  std::vector<std::pair<int, std::string>> all() const override;
  void write(int number, std::string value) override;
  std::optional<std::string> poll_write() override;

 private:
  std::optional<std::string> begin();
  std::optional<std::string> end(std::string trouble);

  GrblMachineSession& session_;
  std::optional<std::pair<int, std::string>> wanted_;
  Seconds asked_{0};
  std::optional<FirmwareSettings> writer_;  // while the session lends its sender
};

}  // namespace passo
