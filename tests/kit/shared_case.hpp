// Runs a script of ../shared/cases/serve, which reproduces what a user did, with the program under test.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

#include "kit/command_line.hpp"

namespace passo::test {

// Returns the output of the script, which is also written to the file `out`. Nothing if the script or one of its tools
// is missing. The scripts listen on fixed ports, so only one of them runs at a time on this computer.
inline std::optional<std::string> run_shared_case(const std::string& script, const std::string& tools,
                                                  const std::string& out) {
  const std::string cases = PASSO_SOURCE_DIR "/../shared/cases/serve";
  if (!std::filesystem::exists(cases + "/" + script)) return std::nullopt;
  if (std::system(("for tool in flock " + tools + "; do command -v $tool || exit 1; done >/dev/null").c_str()) != 0)
    return std::nullopt;
  const int status = std::system(("cd " PASSO_SOURCE_DIR " && PASSO=" PASSO_PROGRAM " flock " + cases + " bash " +
                                  cases + "/" + script + " >" + out + " 2>&1")
                                     .c_str());
  EXPECT_TRUE(WIFEXITED(status)) << script;
  return read(out);
}

}  // namespace passo::test
