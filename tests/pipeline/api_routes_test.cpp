// The rows of the API and its description: the same requests, bodies and owners in both. And what a path without such a
// row is answered with.
#include "passo/api/api_routes.hpp"

#include <map>
#include <set>

#include "api_kit.hpp"
#include <gtest/gtest.h>

#include "passo/api/program_store.hpp"

namespace passo::test {
namespace {

std::string lower(std::string_view method) {
  std::string text(method);
  for (char& c : text) c = static_cast<char>(c - 'A' + 'a');
  return text;
}

const char* name_of(BodyKind kind) {
  constexpr const char* names[] = {"no body", "JSON", "a program", "a table", "bytes"};
  return names[static_cast<std::size_t>(kind)];
}

// What the description says that the body is.
BodyKind described_body(const Json& operation) {
  const Json content = operation.value("requestBody", Json::object()).value("content", Json::object());
  if (content.contains("application/json")) return BodyKind::json;
  if (content.contains("text/plain")) return BodyKind::program;
  if (content.contains("text/csv")) return BodyKind::table;
  return content.empty() ? BodyKind::none : BodyKind::bytes;
}

std::string line_of(const std::string& method, const std::string& path, const std::string& operation, bool moves,
                    BodyKind body) {
  return fmt::format("{} {}: {}, {}, by {}", method, path, operation, name_of(body), moves ? "the owner" : "anybody");
}

TEST(ApiRoutes, are_those_of_the_description) {
  std::set<std::string> described;
  std::set<std::string> served;
  std::set<std::string> operations;
  const Json document = openapi();
  for (const auto& [path, all] : document["paths"].items()) {
    for (const auto& [method, operation] : all.items()) {
      if (method == "parameters") continue;
      const std::string id = operation.value("operationId", "");
      EXPECT_TRUE(operations.insert(id).second) << id << " stands there twice";
      described.insert(line_of(method, path, id, operation.value("x-owner", false), described_body(operation)));
    }
  }
  for (const ApiRoute& route : api_routes()) {
    EXPECT_FALSE(route.operation.empty()) << route.path;
    const auto line =
        line_of(lower(route.method), std::string(route.path), std::string(route.operation), route.moves, route.body);
    EXPECT_TRUE(served.insert(line).second) << line << " stands there twice";
  }
  EXPECT_EQ(described, served);
}

// The number of a path is described where a row has one, and nowhere else.
TEST(ApiRoutes, have_the_described_numbers_in_their_paths) {
  const Json document = openapi();
  for (const auto& [path, all] : document["paths"].items()) {
    bool is_described = false;
    for (const Json& parameter : all.value("parameters", Json::array())) {
      is_described = is_described || (parameter["name"] == "id" && parameter["in"] == "path");
    }
    EXPECT_EQ(is_described, path.find("{id}") != std::string::npos) << path;
  }
}

TEST(ApiRoutes, of_another_method_say_which_ones_there_are) {
  std::map<std::string, std::set<std::string>> methods;
  for (const ApiRoute& route : api_routes()) methods[std::string(route.path)].insert(std::string(route.method));
  ApiRun run;
  run.own();
  for (const auto& [path, known] : methods) {
    std::string to = std::string(api_root) + path;
    if (const std::size_t id = to.find("{id}"); id != std::string::npos) to.replace(id, 4, "1");
    for (const char* method : {"GET", "POST", "DELETE", "PUT", "PATCH", "HEAD", "OPTIONS"}) {
      if (known.contains(method)) continue;
      const WebAnswer answer = run.api.answer({.method = method, .path = to, .key = run.key});
      EXPECT_EQ(answer.status, 405U) << method << to;
      EXPECT_EQ(Json::parse(answer.body)["error"]["code"], "http.method");
      for (const std::string& one : known) EXPECT_NE(answer.allow.find(one), std::string::npos) << to << one;
    }
  }
}

TEST(ApiRoutes, of_other_paths_are_none) {
  ApiRun run;
  run.own();
  for (const char* path : {"", "/", "/jogs", "/jog/", "/programs/", "/programs/x", "/programs/1/", "/programs/1/runs",
                           "/programs/-1", "/programs/ 1", "/programs/99999999999999999999", "/cam/file"}) {
    for (const char* method : {"GET", "POST"}) {
      const Json answer = run.ask(method, path);
      EXPECT_EQ(run.status, 404U) << method << path;
      EXPECT_EQ(answer["error"]["code"], "http.not-found") << path;
    }
  }
  EXPECT_EQ(find_route("GET", "/status").route, nullptr) << "without api_root";
  EXPECT_EQ(find_route("GET", "/api/v1/programs/17/text").id, 17U);
}

// What a server lacks is not there, whatever the body is.
TEST(ApiRoutes, need_what_a_server_may_lack) {
  constexpr const char* codes[] = {"",           "camera.none",   "data.none", "make.none",
                                   "ports.none", "settings.none", "study.none"};
  ApiRun run;
  run.own();
  for (const ApiRoute& route : api_routes()) {
    if (route.needs == Needs::nothing) continue;
    std::string to(route.path);
    if (const std::size_t id = to.find("{id}"); id != std::string::npos) to.replace(id, 4, "1");
    const Json answer = run.ask(std::string(route.method), to);
    EXPECT_EQ(run.status, 404U) << to;
    EXPECT_EQ(answer["error"]["code"], codes[static_cast<std::size_t>(route.needs)]) << to;
    const std::string path = std::string(api_root) + to;
    EXPECT_EQ(run.api.find({.method = std::string(route.method), .path = path}).longest_body, std::size_t{1} << 16)
        << to;
  }
}

// Before a body is read, its longest length is known by the row.
TEST(ApiRoutes, know_how_long_a_body_may_be) {
  ApiRun run;
  const auto longest = [&](const char* method, const char* path) {
    return run.api.find({.method = method, .path = std::string(api_root) + path}).longest_body;
  };
  EXPECT_EQ(longest("POST", "/programs"), ProgramStore::longest_program);
  EXPECT_EQ(longest("POST", "/uploads/1"), ProgramStore::longest_program);
  EXPECT_EQ(longest("POST", "/programs/1/height-map"), std::size_t{1} << 22);
  for (const char* path : {"/jog", "/programs/1/run", "/nothing", "/uploads"}) {
    EXPECT_EQ(longest("POST", path), std::size_t{1} << 16) << path;
  }
  EXPECT_EQ(longest("GET", "/programs"), std::size_t{1} << 16);
}

// A client that was written for another version learns which one it has met.
TEST(ApiRoutes, of_other_versions_are_refused_by_name) {
  ApiRun run;
  for (const char* path : {"/api/", "/api/status", "/api/v2/status", "/api/v10/status", "/api/v0/hold"}) {
    for (const char* method : {"GET", "POST"}) {
      const WebAnswer answer = run.api.answer({.method = method, .path = path});
      EXPECT_EQ(answer.status, 404U) << path;
      EXPECT_EQ(Json::parse(answer.body)["error"]["code"], "http.other-version") << path;
      EXPECT_THAT(answer.body, testing::HasSubstr("the API of this server is /api/v1")) << path;
    }
  }
  for (const char* path : {"/api/v1", "/api/v1/", "/api/v1/statuses", "/api/v1/make", "/apis/v2"}) {
    const WebAnswer answer = run.api.answer({.method = "POST", .path = path});
    EXPECT_EQ(Json::parse(answer.body)["error"]["code"], "http.not-found") << path;
  }
}

}  // namespace
}  // namespace passo::test
