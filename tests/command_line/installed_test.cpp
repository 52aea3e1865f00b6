// Passo as `cmake --install` leaves it: the program finds its files by its own location, no file tells where it was
// built, and the manual pages and the completion name every command and option.
#include <algorithm>
#include <regex>

#include "kit/served_http.hpp"
#include <gmock/gmock.h>

namespace {

namespace fs = std::filesystem;
using passo::test::checkout;
using passo::test::contains;
using passo::test::lacks_an_emulator;
using passo::test::Outcome;
using passo::test::read;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

const fs::path build_folder = fs::path(PASSO_PROGRAM).parent_path();

class Installed : public passo::test::ServedHttp {
 protected:
  Installed() {
    const std::string install = "DESTDIR=" + path("root") + " cmake --install " + build_folder.string() +
                                " --prefix /usr >" + path("install.log") + " 2>&1";
    is_installed_ = std::system(install.c_str()) == 0;
    program_ = root("usr/bin/passo");
  }
  void SetUp() override { ASSERT_TRUE(is_installed_) << read(path("install.log")); }

  std::string root(const std::string& name) const { return path("root/" + name); }
  // Runs the program that is installed.
  Outcome installed(const std::string& arguments) const {
    const int status = std::system((program_ + " " + arguments + " >" + path("out") + " 2>" + path("err")).c_str());
    return {.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1, .out = read(path("out")), .err = read(path("err"))};
  }

  bool is_installed_ = false;
};

TEST_F(Installed, no_file_tells_where_it_was_built) {
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(root("usr"))) {
    if (!entry.is_regular_file()) continue;
    ++files;
    EXPECT_FALSE(contains(read(entry.path()), checkout + "/")) << entry.path();
  }
  EXPECT_GT(files, 50U);
}

TEST_F(Installed, emulated_boards_are_found_beside_the_program) {
  const std::string info = "board info sim:uno";
  const Outcome outcome = installed(info);
  if (lacks_an_emulator(outcome) || !fs::exists(root("usr/libexec/passo/passo-emulate-avr")))
    GTEST_SKIP() << outcome.err;
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  // The whole tree moves, and is found where it is now.
  fs::rename(path("root"), path("elsewhere"));
  program_ = path("elsewhere/usr/bin/passo");
  EXPECT_EQ(installed(info).code, 0);
  // The build folder, which has all of this, is not the installed program's.
  fs::remove(path("elsewhere/usr/libexec/passo/passo-emulate-avr"));
  EXPECT_THAT(installed(info).err, HasSubstr("package passo-emulators"));
  fs::remove_all(path("elsewhere/usr/libexec/passo/firmware"));
  EXPECT_THAT(installed(info).err, HasSubstr("motion_uno.elf is missing"));
}

TEST_F(Installed, the_image_for_a_board_is_found_beside_the_program) {
  if (!fs::exists(root("usr/share/passo/firmware/motion_uno.hex"))) GTEST_SKIP() << "no compiler for the chip";
  // What is installed is read: it is not a program any more.
  write("root/usr/share/passo/firmware/motion_uno.hex", "no image");
  const Outcome outcome = installed("board flash uno --device /dev/null");
  EXPECT_THAT(outcome.err, HasSubstr("usr/share/passo/firmware/motion_uno.hex"));
}

TEST_F(Installed, the_web_interface_is_found_beside_the_program) {
  fs::remove_all(root("usr/share/passo/page"));  // built elsewhere, and compressed
  fs::create_directories(root("usr/share/passo/page"));
  write("root/usr/share/passo/page/index.html", "the installed page");
  serve();
  EXPECT_THAT(ask("GET", "/"), HasSubstr("the installed page"));
}

// --- manual pages and completion

struct Help {
  std::string path;  // "passo cam drill"
  std::vector<std::string> options;
};

// All commands with their options, as the help lists them.
class CommandDocuments : public Installed {
 protected:
  void add_help(const std::string& words, std::vector<Help>& all) const {
    const std::string text = installed(words + " --help").out;
    Help help{.path = words.empty() ? "passo" : "passo " + words, .options = {}};
    static const std::regex option("\n  (-[a-zA-Z])?,?(--[a-z0-9-]+)");
    static const std::regex command("\n  ([a-z][a-z0-9]*) {2,}");
    for (std::sregex_iterator it(text.begin(), text.end(), option), end; it != end; ++it) {
      for (const std::string& name : {(*it)[1].str(), (*it)[2].str()}) {
        if (!name.empty()) help.options.push_back(name);
      }
    }
    all.push_back(std::move(help));
    const std::size_t begin = text.find("\nSubcommands:");
    if (begin == std::string::npos) return;
    const std::string commands = text.substr(begin, text.find("\n\n", begin) - begin);
    for (std::sregex_iterator it(commands.begin(), commands.end(), command), end; it != end; ++it) {
      add_help(words.empty() ? (*it)[1].str() : words + " " + (*it)[1].str(), all);
    }
  }
  std::vector<Help> all_help() const {
    std::vector<Help> all;
    add_help("", all);
    return all;
  }
  // The words that bash proposes after a line.
  std::vector<std::string> proposed(const std::string& line) const {
    const std::string script =
        write("ask.bash", "source " + root("usr/share/bash-completion/completions/passo") + "\nCOMP_WORDS=(" + line +
                              ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_passo\n"
                              "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    EXPECT_EQ(std::system(("bash " + script + " >" + path("proposed")).c_str()), 0);
    std::istringstream lines(read(path("proposed")));
    std::vector<std::string> words;
    for (std::string word; std::getline(lines, word);) words.push_back(word);
    return words;
  }
};

TEST_F(CommandDocuments, manual_pages_cover_each_command_and_option) {
  const std::vector<Help> all = all_help();
  EXPECT_GT(all.size(), 40U);
  for (const Help& help : all) {
    std::string name = help.path;
    std::ranges::replace(name, ' ', '-');
    const std::string page =
        std::regex_replace(read(root("usr/share/man/man1/" + name + ".1")), std::regex("\\\\-"), "-");
    EXPECT_THAT(page, HasSubstr(".SH NAME\n" + name + " - ")) << help.path;
    EXPECT_FALSE(help.options.empty()) << help.path;
    for (const std::string& option : help.options) EXPECT_THAT(page, HasSubstr("\\fB" + option + "\\fR")) << help.path;
  }
  std::size_t pages = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(root("usr/share/man/man1"))) ++pages;
  EXPECT_EQ(pages, all.size());
}

TEST_F(CommandDocuments, completion_covers_each_command_and_option) {
  const std::string zsh = read(root("usr/share/zsh/site-functions/_passo"));
  const std::string fish = read(root("usr/share/fish/vendor_completions.d/passo.fish"));
  for (const Help& help : all_help()) {
    EXPECT_THAT(zsh, HasSubstr("    '" + help.path + "')\n"));
    const std::vector<std::string> options = proposed(help.path + " -");
    for (const std::string& option : help.options) {
      EXPECT_THAT(options, Contains(option)) << help.path;
      EXPECT_THAT(zsh, HasSubstr("'" + option + ":")) << help.path;
      const std::string in_fish = option.starts_with("--") ? " -l " + option.substr(2) : " -s " + option.substr(1);
      EXPECT_THAT(fish, testing::ContainsRegex("= \"" + help.path + "\"'[^\n]*" + in_fish + " ")) << help.path;
    }
  }
}

TEST_F(CommandDocuments, bash_proposes_commands_values_and_files) {
  EXPECT_EQ(proposed("passo ru"), std::vector<std::string>{"run"});
  EXPECT_THAT(proposed("passo cam ''"), Contains("drill"));
  EXPECT_EQ(proposed("passo run p.ngc --view to"), std::vector<std::string>{"top"});
  EXPECT_EQ(proposed("passo run " + path("install.l")), std::vector<std::string>{path("install.log")});
  EXPECT_THAT(proposed("passo cam drill --mach"), Contains("--machine"));
}

// --- the version

TEST_F(Installed, the_version_is_the_same_everywhere) {
  const std::string said = installed("--version").out;  // "passo 1.2.3\n"
  const std::string version = said.substr(6, said.size() - 7);
  const std::string release = version.substr(0, version.find('-'));
  EXPECT_THAT(read(checkout + "/CMakeLists.txt"), HasSubstr("project(passo VERSION " + release + " "));
  EXPECT_THAT(read(checkout + "/README.md"), HasSubstr("**Status.** Version " + version + ","));
  EXPECT_THAT(read(checkout + "/CHANGELOG.md"), HasSubstr("\n## " + version + ","));
  EXPECT_THAT(read(checkout + "/docs/api/openapi.json"), HasSubstr("\"version\": \"" + version + "\""));
  EXPECT_THAT(read(checkout + "/CITATION.cff"), HasSubstr("\nversion: " + version + "\n"));
  EXPECT_THAT(read(root("usr/share/man/man1/passo.1")), HasSubstr("\"Passo " + version + "\""));
  // A Debian package of a release candidate is 1.2.3~rc1.
  const std::string package = std::regex_replace(version, std::regex("-"), "~");
  EXPECT_TRUE(read(checkout + "/debian/changelog").starts_with("passo (" + package + ")"));
}

}  // namespace
