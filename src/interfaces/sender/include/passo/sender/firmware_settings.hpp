// FirmwareSettings: reads and writes the settings of a Grbl board through a GrblSender.
//
//   FirmwareSettings settings(sender);          // the sender is ready(), and no program runs
//   settings.read();                            // or write("$110", "600"), any number of them
//   while (settings.busy()) { …; settings.poll(); }   // the owner sends and receives, as always
//   settings.all(), settings.take_changes()
//
// Nothing is written without write(). Settings are written one by one: each is checked against its range, sent, and
// read back with $$. If the board rejects a value, or has made another one of it, the old value is in force afterwards,
// and the change says why. A lost connection or an alarm ends what was asked for, and each open change says so.
//
// Like GrblSender, this class uses no sockets and no clock.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

#include "passo/sender/firmware_setting.hpp"
#include "passo/sender/grbl_sender.hpp"

namespace passo {

// What has become of a write().
struct SettingChange {
  std::string name;                    // "$110"
  std::string before;                  // empty: the board does not have the setting
  std::string wanted;                  // asterisks for a password
  std::string after;                   // as read back
  std::string trouble;                 // why it was not written, a sentence without a full stop; empty: it was
  std::vector<std::string> also = {};  // other settings that the board has changed with it: "$20: 1 -> 0"
};

class FirmwareSettings {
 public:
  // `sender` must outlive this object.
  explicit FirmwareSettings(GrblSender& sender) : sender_(sender) {}

  // Asks for all settings, and the first time for their descriptions.
  void read();
  // Asks for a change. The settings are read first if they have not been. `name`: with or without '$'.
  void write(std::string_view name, std::string_view value);
  // Processes the machine's answers. Call it after each GrblSender::receive().
  void poll();
  bool busy() const { return stage_ != Stage::idle || !wanted_.empty(); }

  // Returns the settings as last read, in the order of the board. Empty: they have not been read.
  const std::vector<FirmwareSetting>& all() const { return settings_; }
  // Returns null if the board has no such setting. `name`: with or without '$'.
  const FirmwareSetting* find(std::string_view name) const;
  // Returns the changes that are complete, in the order of write(), and forgets them.
  std::vector<SettingChange> take_changes();
  // Returns whether a written setting takes effect only when the board has restarted.
  bool needs_restart() const { return needs_restart_; }
  // Returns why the settings could not be read, a sentence without a full stop. Empty: they could, or are being read.
  const std::string& trouble() const { return trouble_; }

 private:
  enum class Stage : std::uint8_t { idle, reading, writing, reading_back, undoing, reading_old, saving };
  void begin_next();
  void take(const GrblAnswer& answer);
  void take_settings(const GrblAnswer& answer);
  void take_read_back();
  void ask_for_settings(Stage stage);
  std::string shown_of_wanted() const;
  void end_change(std::string trouble);
  void end_all(const std::string& trouble);

  GrblSender& sender_;
  Stage stage_ = Stage::idle;
  SettingDescriptions descriptions_;
  std::vector<FirmwareSetting> settings_;
  std::vector<FirmwareSetting> before_;  // before the change
  std::deque<SettingChange> wanted_;     // the first one is being written
  std::vector<SettingChange> done_;
  bool was_described_ = false;
  bool needs_restart_ = false;
  bool is_unsaved_ = false;
  std::string trouble_;
};

}  // namespace passo
