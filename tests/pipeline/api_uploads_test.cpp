// Programs that are uploaded in pieces, by the API.
#include "api_kit.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "passo/api/program_uploads.hpp"

namespace passo::test {
namespace {

// A program that comes in pieces: its progress is told, a piece that was sent twice or too early changes nothing, and
// after a broken connection the client goes on where the server says.
TEST(ApiUploads, come_in_pieces_and_go_on_after_a_broken_connection) {
  ApiRun run;
  const std::string text = "G21 G1 X9 F100\nM2\n";
  const auto piece = [&](std::uint64_t id, std::size_t from, std::size_t count) {
    return run.ask("POST", fmt::format("/uploads/{}?from={}", id, from), text.substr(from, count));
  };
  const Json begun = run.post(fmt::format("/uploads?name=part.ngc&bytes={}", text.size()));
  ASSERT_EQ(run.status, 201U) << begun;
  expect_members(openapi()["components"]["schemas"]["Upload"], begun, "Upload");
  const std::uint64_t id = begun["id"];
  EXPECT_EQ(piece(id, 0, 5)["received"], 5);
  EXPECT_EQ(piece(id, 7, 3)["error"]["code"], "uploads.gap");
  EXPECT_EQ(piece(id, 0, 5)["error"]["message"], "the next piece begins at byte 5, not 0");
  EXPECT_EQ(run.get(fmt::format("/uploads/{}", id))["received"], 5);
  EXPECT_EQ(run.get("/uploads")["uploads"].size(), 1U);
  EXPECT_EQ(run.ask("POST", fmt::format("/uploads/{}?from=5", id), text)["error"]["code"], "uploads.too-long");
  const Json whole = piece(id, 5, text.size());
  EXPECT_EQ(run.status, 201U);
  EXPECT_EQ(whole["name"], "part.ngc");
  EXPECT_EQ(whole["lines"], 2);
  EXPECT_TRUE(run.get("/uploads")["uploads"].empty());
  run.get(fmt::format("/uploads/{}", id));
  EXPECT_EQ(run.status, 404U);
}

TEST(ApiUploads, are_bounded_and_may_be_dropped) {
  ApiRun run;
  for (const char* query : {"", "?bytes=", "?bytes=0", "?bytes=-1", "?bytes=x", "?bytes=5&dialect=other"}) {
    EXPECT_EQ(run.post(std::string("/uploads") + query)["error"]["code"], "http.bad-body") << query;
  }
  run.post("/uploads?bytes=67108865");
  EXPECT_EQ(run.status, 413U);
  const std::uint64_t first = run.post("/uploads?bytes=67108864")["id"];
  EXPECT_EQ(run.post("/uploads?bytes=67108864")["received"], 0);
  run.post("/uploads?bytes=1");
  EXPECT_EQ(run.status, 507U) << "what was announced is reserved";
  run.ask("DELETE", fmt::format("/uploads/{}", first));
  EXPECT_EQ(run.status, 200U);
  for (std::size_t i = 1; i < ProgramUploads::most_uploads; ++i) {
    run.post("/uploads?bytes=1");
    EXPECT_EQ(run.status, 201U) << i;
  }
  run.post("/uploads?bytes=1");
  EXPECT_EQ(run.status, 507U);
  run.ask("POST", "/uploads/99?from=0", "x");
  EXPECT_EQ(run.status, 404U);
  run.ask("POST", "/uploads/2?from=x", "x");
  EXPECT_EQ(run.status, 400U);
  ProgramUploads uploads;
  const std::uint64_t silent = uploads.begin("a", Dialect::linuxcnc, ProgramUploads::most_bytes, Seconds(0))->id;
  EXPECT_EQ(uploads.begin("b", Dialect::linuxcnc, 1, Seconds(600)), nullptr);
  EXPECT_NE(uploads.begin("b", Dialect::linuxcnc, 1, Seconds(601)), nullptr) << "who is silent makes room";
  EXPECT_EQ(uploads.find(silent), nullptr);
}

TEST(ApiPath, has_the_tool_of_the_machine_file_where_no_tool_table_has_one) {
  ApiRun run;
  const std::string id = fmt::format("/programs/{}", run.upload("G1 X5 F600\nM2\n"));
  run.post(id + "/check");
  ASSERT_TRUE(run.turn_until([&] { return run.get(id)["state"] == "good"; }));
  const double diameter = run.run.description().tool.diameter.value();
  ASSERT_GT(diameter, 0);
  EXPECT_EQ(run.get(id + "/path")["tools"][0]["diameter"], diameter);
}

}  // namespace
}  // namespace passo::test
