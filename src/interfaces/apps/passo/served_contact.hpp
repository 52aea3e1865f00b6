// ServedContact: the serial ports of this computer for the API, and the first contact with a machine on one of them: a
// separate process (background_process.hpp) opens the port.
#pragma once

#include <chrono>
#include <string>

#include "background_process.hpp"
#include "commands.hpp"

#include "passo/api/first_contact.hpp"

namespace passo {

class ServedContact final : public FirstContact {
 public:
  // An Arduino is in its boot loader for 2 s, and answers within another second.
  static constexpr std::chrono::seconds longest_contact{30};
  // The list is not read more often than this, however many clients ask for it.
  static constexpr std::chrono::milliseconds between_lists{500};

  explicit ServedContact(const ServeArguments& arguments) : arguments_(arguments) {}

  const std::string& board() const override { return arguments_.board; }
  std::string ports() override;
  bool begin(const std::string& device, const std::string& board) override;
  const ContactResult& result() override;
  bool keeps(const std::string& name) const override;
  Result<KeptMachine, std::string> keep(const std::string& name, const std::string& text) override;

 private:
  using Clock = std::chrono::steady_clock;
  std::string folder_of_machines() const;
  std::string command_with(const std::string& machine) const;

  const ServeArguments arguments_;
  std::string list_;
  Clock::time_point listed_{};
  TemporaryFolder folder_;
  BackgroundProcess process_;
  Clock::time_point begun_{};
  ContactResult result_;
};

}  // namespace passo
