// CheckReport: the complete results of `passo check` as one HTML page.
//
// The page is a single file: it needs no network and runs no script. It is readable on paper, on a narrow screen, and
// in light and dark mode. All text from the program and its name is escaped.
#pragma once

#include <string>

#include "passo/diagnostics/diagnostic.hpp"
#include "passo/judge/check_page.hpp"

namespace passo {

struct CheckReport {
  std::string program;  // program name
  const MachineDescription& machine;
  const Diagnostics& findings;
  std::string waits;                // where the program stops for the operator; empty: nowhere
  const Judgement* page = nullptr;  // null: the program has errors
  const PathRecorder& path;
  const LoadTrack& track;
};

std::string to_html(const CheckReport& report);

}  // namespace passo
