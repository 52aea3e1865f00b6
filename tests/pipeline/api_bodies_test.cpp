// What clients send to the API: names in their own letters, and bodies of the right type.
#include "api_kit.hpp"
#include <gtest/gtest.h>

#include "passo/api/api_routes.hpp"

namespace passo::test {
namespace {

std::string percent_encoded(std::string_view text) {
  std::string all;
  for (const char c : text) all += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return all;
}

TEST(ApiNames, keep_their_own_letters) {
  ApiRun run;
  const std::pair<const char*, const char*> names[] = {{"my%20part.ngc", "my part.ngc"},
                                                       {"Gr%C3%B6%C3%9Fe.ngc", "Größe.ngc"},
                                                       {"%E9%9B%B6%E4%BB%B6.ngc", "零件.ngc"},
                                                       {"%e9%9b%b6.ngc", "零.ngc"},
                                                       {"\xE9\x9B\xB6.ngc", "零.ngc"},
                                                       {"a%26b%3D%25.ngc", "a&b=%.ngc"},
                                                       {"a+b.ngc", "a+b.ngc"},
                                                       {"a..b.ngc", "a..b.ngc"},
                                                       {"%F0%9F%94%A9.ngc", "🔩.ngc"},
                                                       {"CON", "CON"},
                                                       {"%3Cb%3E.ngc", "<b>.ngc"}};
  for (const auto& [written, name] : names) {
    EXPECT_EQ(run.get(fmt::format("/programs/{}", run.upload("M2\n", std::string("?name=") + written)))["name"], name);
    const Json begun = run.post(std::string("/uploads?bytes=3&name=") + written);
    EXPECT_EQ(begun["name"], name) << begun;
    run.ask("DELETE", fmt::format("/uploads/{}", begun["id"].get<std::uint64_t>()));
  }
  EXPECT_EQ(run.get(fmt::format("/programs/{}", run.upload("M2\n")))["name"], "program");
}

TEST(ApiNames, that_would_do_harm_are_refused) {
  ApiRun run;
  std::vector<std::string> names = {"a%2Fb", "%2e%2E%2fx", "..",           ".",         ".hidden",     "a/b",
                                    "a%5Cb", "%00",        "a%00.ngc",     "%",         "%4",          "a%zzb",
                                    "%C3",   "%C0%AF",     "%ED%A0%80",    "%FF",       "%1b%5b2J",    "a%0Ab",
                                    "%7F",   "%C2%85",     "%E2%80%AEcgn", "%E2%80%A8", "%F4%90%80%80"};
  names.push_back(std::string(201, 'a'));
  std::string chinese;
  for (int i = 0; i < 67; ++i) chinese += "%E9%9B%B6";
  names.push_back(chinese);
  for (int c = 1; c < 32; ++c) names.push_back("a" + percent_encoded(std::string(1, static_cast<char>(c))));
  for (const std::string& name : names) {
    for (const char* path : {"/programs?name=", "/uploads?bytes=3&name="}) {
      const Json answer = run.ask("POST", path + name, std::string(path).starts_with("/p") ? "M2\n" : "");
      EXPECT_EQ(run.status, 400U) << path << name;
      EXPECT_EQ(answer["error"]["code"], "http.bad-name") << path << name;
    }
  }
  EXPECT_TRUE(run.get("/programs")["programs"].empty());
  EXPECT_TRUE(run.get("/uploads")["uploads"].empty());
  run.upload("M2\n", "?name=" + std::string(200, 'a'));
}

TEST(ApiNames, of_owners_are_words_without_control_characters) {
  ApiRun run;
  EXPECT_EQ(run.post("/owner", Json({{"name", "Büro / Tablet\x1b[31m"}}).dump())["name"], "Büro / Tablet[31m");
  std::string longest;
  for (int i = 0; i < 100; ++i) longest += "零";
  EXPECT_EQ(run.post("/owner", Json({{"name", longest}}).dump())["name"], longest.substr(0, 198)) << "no half letter";
}

TEST(ApiBodies, are_checked_by_type_and_shape_on_each_route) {
  int routes = 0;
  for (const ApiRoute& route : api_routes()) {
    const std::string method(route.method);
    ++routes;
    ApiRun run;
    run.own();
    std::string to(route.path);
    if (const std::size_t id = to.find("{id}"); id != std::string::npos) to.replace(id, 4, "1");
    const auto status_of = [&](const std::string& body, const std::string& type) {
      const Json answer = run.ask(method, to, body, "", type);
      if (run.status == 415) {
        EXPECT_EQ(answer["error"]["code"], "http.wrong-type") << to;
      }
      return run.status;
    };
    // A form of a page, and a picture that is no drawing.
    const bool has_body = route.body != BodyKind::none;
    EXPECT_EQ(status_of("x", "multipart/form-data; boundary=x"), has_body ? 415U : 400U) << method << to;
    const bool takes_files = route.body == BodyKind::bytes;
    if (has_body && !takes_files) {
      for (const char* type : {"image/png", "application/zip", "text/html", "application/xml", "video/mp4"}) {
        EXPECT_EQ(status_of("x", type), 415U) << to << " " << type;
      }
    }
    // JSON where a program, a table or a file belongs.
    const std::string json = R"({"line": "G0 X1"})";
    if (has_body && route.body != BodyKind::json) {
      EXPECT_EQ(status_of(json, "application/json"), 415U) << to;
      EXPECT_EQ(status_of(json, "application/problem+json"), 415U) << to;
    }
    if (route.body == BodyKind::program) {
      for (const char* type : {"", "application/x-www-form-urlencoded", "text/plain", "application/octet-stream"}) {
        EXPECT_EQ(status_of(json, type), 415U) << to << " " << type;
        EXPECT_EQ(status_of("\n [1, 2]", type), 415U) << to << " " << type;
      }
    }
    // A program, and JSON of another shape, where an object belongs.
    if (route.body == BodyKind::json) {
      for (const char* body : {"G21 G90", "[]", "\"x\"", "5", "null", "{", "{} {}"}) {
        EXPECT_EQ(status_of(body, "application/json"), 400U) << to << " " << body;
        EXPECT_EQ(status_of(body, ""), 400U) << to << " " << body;
      }
    }
    if (!has_body) {
      EXPECT_EQ(status_of("G21", ""), 400U) << method << to;
      EXPECT_EQ(status_of(json, "application/json"), 400U) << method << to;
    }
    EXPECT_TRUE(run.get("/programs")["programs"].empty()) << to;
    EXPECT_EQ(run.get("/status")["state"], "Idle") << to;
  }
  EXPECT_EQ(routes, 99);
}

// What curl, scripts and browsers say of a program.
TEST(ApiBodies, of_programs_have_the_types_that_clients_send) {
  ApiRun run;
  for (const char* type : {"", "text/plain", "Text/Plain; charset=UTF-8", "application/octet-stream", "text/x-gcode",
                           "application/x-www-form-urlencoded"}) {
    run.ask("POST", "/programs", "M2\n", "", type);
    EXPECT_EQ(run.status, 201U) << type;
  }
  run.own();
  for (const char* type : {"", "application/json", "application/json;charset=utf-8", "text/plain;charset=UTF-8",
                           "application/x-www-form-urlencoded"}) {
    EXPECT_EQ(run.ask("POST", "/work", R"({"place": {"x": 0}})", "", type)["work_offset"]["x"], 0.0) << type;
  }
  EXPECT_EQ(run.ask("POST", "/reset", "{}", "", "application/json")["error"]["code"], nullptr) << "an empty object";
}

TEST(ApiBodies, over_the_stream_are_json) {
  ApiRun run;
  run.own();
  const auto say = [&](const Json& words) { return Json::parse(run.api.hear(words.dump(), 1)); };
  for (const char* path : {"/api/v1/programs", "/api/v1/uploads/1"}) {
    EXPECT_EQ(say({{"do", path}, {"key", run.key}, {"body", "M2"}})["status"], 415) << path;
  }
  EXPECT_TRUE(run.get("/programs")["programs"].empty());
}

// The owner's stream ends: the page may come back for a while. Nobody takes a machine that moves from an owner who is
// there.
TEST(ApiOwner, whose_streams_have_ended_loses_the_motion) {
  ApiRun run;
  run.own();
  const auto renew = [&](std::uint64_t client) {
    return run.api.hear(Json({{"do", "/api/v1/owner/renew"}, {"key", run.key}}).dump(), client);
  };
  EXPECT_EQ(Json::parse(renew(1))["status"], 200);
  renew(2);
  run.api.gone(1);
  run.pass(MachineControl::returns_within + Seconds(5));
  EXPECT_EQ(run.owner.kind(), MachineControl::Kind::client) << "its other stream is there";
  run.api.gone(2);
  run.pass(MachineControl::returns_within - Seconds(1));
  renew(3);
  run.pass(MachineControl::returns_within + Seconds(5));
  EXPECT_EQ(run.owner.kind(), MachineControl::Kind::client) << "it came back";
  run.api.gone(9);
  run.api.gone(3);
  run.pass(MachineControl::returns_within + Seconds(1));
  EXPECT_EQ(run.owner.kind(), MachineControl::Kind::nobody);
}

TEST(ApiOwner, who_never_used_the_stream_stays_the_owner) {
  ApiRun run;
  run.own();
  run.api.gone(1);
  run.pass(MachineControl::returns_within + Seconds(60));
  EXPECT_EQ(run.owner.kind(), MachineControl::Kind::client);
}

// A job goes on when its owner's page dies. Another page may take over at once, and the job still goes on.
TEST(ApiOwner, who_is_gone_amid_a_job_gives_way_and_the_job_goes_on) {
  ApiRun run;
  run.own();
  run.api.hear(Json({{"do", "/api/v1/owner/renew"}, {"key", run.key}}).dump(), 1);
  run.post(fmt::format("/programs/{}/run", run.upload("G21 G90\nG1 X100 F600\nM2\n")));
  ASSERT_TRUE(run.turn_until_state("Run"));
  run.key.clear();
  run.api.gone(1);
  EXPECT_EQ(run.ask("POST", "/owner", R"({"name": "other"})")["error"]["code"], "owner.moves");
  run.pass(MachineControl::returns_within + Seconds(1));
  EXPECT_EQ(run.owner.kind(), MachineControl::Kind::client) << "a sender gets no machine that moves";
  EXPECT_EQ(run.get("/status")["state"], "Run");
  EXPECT_EQ(run.ask("POST", "/owner", R"({"name": "other"})")["name"], "other");
  EXPECT_EQ(run.get("/status")["state"], "Run");
  EXPECT_TRUE(run.turn_until([&] { return run.get("/status")["job"]["state"] == "done"; }));
}

// A full disk: the zero stays what it was, and says so.
TEST(ApiDisk, that_is_full_lets_no_zero_be_set) {
  ApiRun run;
  run.own();
  run.post("/work", R"({"place": {"x": 3}})");
  run.disk_trouble = "no space left on device";
  const Json refused = run.post("/work", R"({"place": {"x": 8}})");
  EXPECT_EQ(run.status, 507U);
  EXPECT_EQ(refused["error"]["code"], "data.unwritten");
  EXPECT_EQ(refused["error"]["message"], "the zero of the work cannot be written: no space left on device");
  EXPECT_EQ(run.get("/status")["work_offset"]["x"], -3.0);
  EXPECT_EQ(run.get("/status")["unkept"], "the offsets cannot be written: no space left on device");
  run.disk_trouble.clear();
  run.pass(Seconds(2));
  EXPECT_EQ(run.get("/status")["unkept"], "");
  run.post("/work", R"({"place": {"x": 8}})");
  EXPECT_EQ(run.status, 200U);
}

}  // namespace
}  // namespace passo::test
