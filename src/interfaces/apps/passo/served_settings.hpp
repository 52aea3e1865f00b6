// ServedSettings: the settings of a Grbl board for the API. Those of the board that this server drives are read over
// its own connection; those of a board at the first contact in a separate process (background_process.hpp).
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "background_process.hpp"
#include "served_contact.hpp"

#include "passo/api/board_settings.hpp"
#include "passo/sender/firmware_settings.hpp"
#include "passo/sender/grbl_machine_session.hpp"

namespace passo {

class ServedSettings final : public BoardSettings {
 public:
  static constexpr std::chrono::seconds longest_order{60};

  // Must outlive this object.
  explicit ServedSettings(FirstContact& contact) : contact_(contact) {}
  // Reads the settings of this board from now on. It must outlive this object.
  void use(GrblMachineSession& board) { live_ = &board; }

  bool has_board() const override;
  bool begin(const SettingsOrder& order) override;
  const SettingsResult& result() override;
  // Processes the answers of this server's board. Must be called in each pass of the daemon's loop.
  void poll();

 private:
  using Clock = std::chrono::steady_clock;
  bool begin_process(const SettingsOrder& order);
  bool begin_live(const SettingsOrder& order);
  void end_live(std::string trouble);
  void fail(std::string words);

  FirstContact& contact_;
  GrblMachineSession* live_ = nullptr;
  std::optional<FirmwareSettings> settings_;  // while the session lends its sender
  SettingsOrder order_;
  std::vector<NamedSetting> wanted_;  // of the order's file
  bool was_read_ = false;
  TemporaryFolder folder_;
  BackgroundProcess process_;
  Clock::time_point begun_{};
  SettingsResult result_;
};

// What the API does with boards beside the machine.
struct ServedBoards {
  explicit ServedBoards(const ServeArguments& arguments) : contact(arguments) {}

  ServedContact contact;
  ServedSettings settings{contact};
};

}  // namespace passo
