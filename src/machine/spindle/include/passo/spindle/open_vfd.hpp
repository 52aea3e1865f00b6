// open_vfd: the drive that a machine file describes, on its serial port.
#pragma once

#include <memory>
#include <string>

#include "passo/base/result.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/machine_file/spindle_bus_description.hpp"
#include "passo/spindle/vfd.hpp"

namespace passo {

struct OpenedVfd {
  std::unique_ptr<Vfd> vfd;
  std::string name;             // for people: "Huanyang HY"
  std::string timeout_setting;  // by which the drive stops by itself when the computer falls silent; empty: unknown
};

// The error is a sentence with the reason. Errors of a table file go to `diagnostics`, and the sentence names the file.
Result<OpenedVfd, std::string> open_vfd(const SpindleBusDescription& bus, Diagnostics& diagnostics);

}  // namespace passo
