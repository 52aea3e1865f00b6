// passo board files and the YAML of FluidNC, on boards with a card.
#include <fstream>
#include <string>

#include "kit/board_on_port.hpp"
#include "kit/board_with_files.hpp"
#include "kit/command_line.hpp"
#include "kit/served_http.hpp"
#include "kit/strict_card_board.hpp"
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace {

using nlohmann::json;
using passo::test::BoardWithFiles;
using testing::HasSubstr;
using CardBoard = passo::test::BoardOnPort<BoardWithFiles>;

namespace test = passo::test;

void put_file(const std::string& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

class BoardFiles : public passo::test::CommandLine {
 protected:
  static BoardWithFiles grblhal_with_card() {
    test::FirmwareTraits traits = test::grblhal();
    for (std::string& line : traits.more_about) {
      if (line.starts_with("[NEWOPT:")) line = "[NEWOPT:ENUMS,RT+,TC,SED,SD,YM]";
    }
    return {traits, false};
  }
  passo::test::Outcome files(const CardBoard& board, const std::string& options) const {
    EXPECT_TRUE(board.listens());
    return passo("board files " + board.address() + " " + options);
  }
};

TEST_F(BoardFiles, are_sent_listed_and_run) {
  put_file(path("part.nc"), "G21 G90\nG1 X10 F600\nM2\n");
  const CardBoard grblhal{grblhal_with_card()};
  const CardBoard fluidnc{BoardWithFiles(test::fluidnc(), true)};
  for (const CardBoard* const board : {&grblhal, &fluidnc}) {
    const std::string at = board == &grblhal ? "/part.nc" : "/sd/part.nc";
    auto outcome = files(*board, "");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "no files\n");
    outcome = files(*board, "--upload " + path("part.nc"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, at + ": 23 bytes sent\n");
    outcome = files(*board, "--json");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const json all = json::parse(outcome.out);
    ASSERT_EQ(all["files"].size(), 1U);
    EXPECT_EQ(all["files"][0]["path"], at);
    EXPECT_EQ(all["files"][0]["bytes"], 23);
    outcome = files(*board, "--run " + at);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr(at + ": "));
    EXPECT_THAT(outcome.out, HasSubstr("stopped at X10.000"));
    outcome = files(*board, "--run " + at + "x");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, HasSubstr("the board rejects"));
    outcome = files(*board, "--delete " + at + "x");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("no such file"));
    outcome = files(*board, "--delete " + at);
    EXPECT_EQ(outcome.out, at + " deleted\n");
    EXPECT_EQ(files(*board, "").out, "no files\n");
  }
}

TEST_F(BoardFiles, bad_calls_say_what_is_expected) {
  EXPECT_EQ(passo("board files serial:/dev/ttyUSB0").code, 2);
  const CardBoard grbl{BoardWithFiles(test::grbl_mega(), false)};
  auto outcome = files(grbl, "");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("[board.no-files]"));
  const CardBoard board{grblhal_with_card()};
  outcome = files(board, "--upload " + path("missing.nc"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(files(board, "--run 'a?b'").err, HasSubstr("a name without ?"));
}

TEST_F(BoardFiles, of_fluidnc_include_its_yaml) {
  const CardBoard board{BoardWithFiles(test::fluidnc(), true)};
  auto outcome = passo("board settings " + board.address() + " --config");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("name: Foam\naxes:\n  x:\n"));
  put_file(path("new.yaml"), "name: Router\n\naxes:\n  x:\n    steps_per_mm: 100\n");
  outcome = passo("board settings " + board.address() + " --write-config " + path("new.yaml"));
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("config.yaml written and read back"));
  outcome = files(board, "--json");
  EXPECT_EQ(json::parse(outcome.out)["files"][0]["path"], "/localfs/config.yaml");
  put_file(path("bad.yaml"), "$100=250\n");
  outcome = passo("board settings " + board.address() + " --write-config " + path("bad.yaml"));
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("[settings.bad-yaml]"));
  const CardBoard grbl{BoardWithFiles(test::grbl_mega(), false)};
  EXPECT_THAT(passo("board settings " + grbl.address() + " --config").err, HasSubstr("[board.no-yaml]"));
}

class ServedBoardFiles : public passo::test::ServedHttp {};

// Over the real server: all that is between a client and the board.
TEST_F(ServedBoardFiles, are_sent_and_run) {
  auto card = test::strict_grblhal_with_card();
  for (const int axis : {0, 1, 2}) {
    card.inner().put(110 + axis, 6000);
    card.inner().put(120 + axis, 500);
    card.inner().put(130 + axis, 400);
  }
  const passo::test::BoardOnPort<test::StrictCardBoard> board(std::move(card));
  ASSERT_TRUE(board.listens());
  serve({"-m", PASSO_SOURCE_DIR "/examples/machines/router.toml", "--board", board.address()});
  const std::string key = new_key();
  json("PUT", "/board/files/part.nc", "G21 G90\nG1 X30 F3000\nG1 X0\nM2\n", key);
  ASSERT_TRUE(until([&] { return this->json("GET", "/board/files")["state"] == "done"; }));
  const auto files = json("GET", "/board/files")["files"];
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0]["path"], "/part.nc");
  EXPECT_TRUE(files[0]["program"].is_number());
  json("POST", "/board/run", R"({"path": "/part.nc"})", key);
  ASSERT_TRUE(until([&] { return this->json("GET", "/status")["board_file"] == "/part.nc"; }));
  ASSERT_TRUE(until([&] { return this->json("GET", "/status")["job"]["state"] == "done"; }))
      << json("GET", "/status")["job"];
  json("DELETE", "/board/files/part.nc", "", key);
  ASSERT_TRUE(until([&] { return this->json("GET", "/board/files")["files"].empty(); }));
}

}  // namespace
