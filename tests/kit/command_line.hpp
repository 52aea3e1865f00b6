// Runs `passo` as a user starts it. Tests can examine its output, its files and its exit code.
//
// A test program that includes this file must define PASSO_PROGRAM.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

namespace passo::test {

namespace fs = std::filesystem;

inline const std::string checkout = PASSO_SOURCE_DIR;
inline const fs::path examples = fs::path(checkout) / "examples";
inline const std::string router_file = (examples / "machines" / "router.toml").string();
inline const std::string on_router = " -m " + router_file + " ";

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

// Returns whether a `sim:` board was refused because the chip's compiler, which builds the images, or an emulator is
// not installed.
inline bool lacks_an_emulator(const Outcome& outcome) {
#ifndef PASSO_MAKES_FIRMWARE
  if (outcome.err.find("is not there") != std::string::npos) return true;
#endif
  return outcome.err.find("is not installed") != std::string::npos ||
         outcome.err.find("was built without") != std::string::npos;
}

inline std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// Each test has a separate directory, which is removed after the test and also contains the command's persistent state.
class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    fs::create_directories(dir_);
    setenv("XDG_STATE_HOME", path("state").c_str(), 1);
  }
  ~CommandLine() override { fs::remove_all(dir_); }

  std::string path(const std::string& name) const { return (dir_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(dir_ / name, std::ios::binary) << text;
    return path(name);
  }
  Outcome passo(const std::string& arguments, const std::string& before = "") const {
    const std::string command = before + " " PASSO_PROGRAM " " + arguments + " >" + path("out") + " 2>" + path("err");
    const int status = std::system(command.c_str());
    return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1, .out = read(path("out")), .err = read(path("err"))};
  }
  // Returns the files in the directory, except the G-code program, the machine file and the captured output.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(dir_)) {
      const std::string name = entry.path().filename().string();
      if (name != "out" && name != "err" && name != "p.ngc" && name != "m.toml" && name != "state")
        names.push_back(name);
    }
    return names;
  }

  fs::path dir_ = fs::temp_directory_path() / ("passo-test-" + std::to_string(getpid()));
};

}  // namespace passo::test
