// The documents' pictures: each is drawn by the command that stands beside it.
#include <algorithm>
#include <sstream>

#include "kit/command_line.hpp"
#include <gmock/gmock.h>

namespace {

namespace fs = std::filesystem;
using passo::test::Outcome;
using passo::test::read;

const fs::path source_dir = PASSO_SOURCE_DIR;

class Documents : public passo::test::CommandLine {};

TEST_F(Documents, each_picture_is_drawn_by_the_command_beside_it) {
  const std::string program = "build/release/passo ";
  std::size_t drawn = 0;
  for (const auto& entry : fs::recursive_directory_iterator(source_dir / "docs")) {
    if (entry.path().extension() != ".md") continue;
    std::istringstream text(read(entry.path()));
    for (std::string line; std::getline(text, line);) {
      for (std::string rest;
           line.ends_with('\\') && std::getline(text, rest);) {  // the command goes on in the next line
        line.back() = ' ';
        line += rest.substr(std::min(rest.find_first_not_of(' '), rest.size()));
      }
      const std::size_t picture = line.find("docs/pictures/");
      if (!line.starts_with(program) || picture == std::string::npos) continue;
      const std::string name = line.substr(picture, line.find(' ', picture) - picture);
      EXPECT_TRUE(fs::exists(source_dir / name)) << name << " of " << entry.path() << ": scripts/pictures.sh draws it";
      line.replace(picture, name.size(), path("picture" + fs::path(name).extension().string()));
      const Outcome outcome = passo(line.substr(program.size()), "cd " + source_dir.string() + " &&");
      EXPECT_EQ(outcome.code, 0) << line << "\n" << outcome.err;
      EXPECT_GT(fs::file_size(path("picture" + fs::path(name).extension().string())), 1000U);
      ++drawn;
    }
  }
  EXPECT_GE(drawn, 8U);
}

}  // namespace
