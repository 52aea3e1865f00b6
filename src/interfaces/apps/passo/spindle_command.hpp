// passo spindle: sets up the drive of a spindle on an RS-485 bus: shows what it reports, runs it, and looks for it.
#pragma once

#include <string>

namespace passo {

struct SpindleShowArguments {
  std::string machine;
  bool json = false;
};
int spindle_show(const SpindleShowArguments& arguments);

struct SpindleRunArguments {
  std::string machine;
  double rpm = 0;
  double seconds = 5;  // at that speed
  bool reverse = false;
  bool json = false;
};
int spindle_run(const SpindleRunArguments& arguments);

struct SpindleScanArguments {
  std::string machine;
  int addresses = 4;  // from 1
  bool json = false;
};
int spindle_scan(const SpindleScanArguments& arguments);

}  // namespace passo
