// PicLog: reads what gpsim has logged of the writes to a PIC's ports, piece after piece.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "pic_pins.hpp"

namespace passo {

class PicLog {
 public:
  // `pins` must outlive the log.
  explicit PicLog(const PicPins& pins) : pins_(pins) {}

  // Adds the changes in gpsim's log file to `run`. The file continues the one that was read before it.
  void read(const std::filesystem::path& log, FollowerRun& run);
  // Whether the program has ever written to a port.
  bool has_writes() const { return has_writes_; }

 private:
  void read_write(const std::string& words, FollowerRun& run);

  const PicPins& pins_;
  std::map<std::string, unsigned> values_;  // of the outputs
  Nanoseconds at_ = 0;
  Nanoseconds sampled_ = 0;  // the last sample of the clock lines
  bool has_writes_ = false;
};

}  // namespace passo
