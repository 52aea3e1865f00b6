// GpsimProcess: a gpsim that executes commands from its standard input.
#pragma once

#include <filesystem>
#include <string>

#include "passo/emulator/child_process.hpp"

namespace passo {

class GpsimProcess {
 public:
  // Starts gpsim in the folder `work`. `image`: a .cod or .hex file, with its whole path.
  GpsimProcess(const std::filesystem::path& work, const std::string& image);
  GpsimProcess(const GpsimProcess&) = delete;
  ~GpsimProcess();

  // Sends commands, each ended by a newline, and waits until gpsim has executed them. Returns false if gpsim has ended,
  // or hangs.
  [[nodiscard]] bool execute(const std::string& commands);
  // The last line of gpsim's output.
  std::string last_line() const;

 private:
  bool wait_for(const std::string& mark);

  ChildProcess child_;
  unsigned executed_ = 0;  // number of calls
  std::string said_;       // the end of the output
};

}  // namespace passo
