// passo serve with a camera: the program itself, between a camera and its viewers.
#include <string>
#include <vector>

#include "kit/fake_camera.hpp"
#include "kit/served_http.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace {

using passo::test::FakeCamera;
using passo::test::read;
using Habit = FakeCamera::Habit;
using testing::HasSubstr;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

class ServeCamera : public passo::test::ServedHttp {
 protected:
  // Serves a machine with this camera.
  void serve_with(const FakeCamera& camera, std::vector<std::string> more = {}) {
    const std::string machine = path("with-camera.toml");
    write("with-camera.toml", read(std::string(PASSO_SOURCE_DIR) + "/examples/machines/router.toml") +
                                  "\n[camera]\nurl = \"" + camera.url("/cam?fps=5") + "\"\noffset_mm = [30, -12.5]\n");
    more.insert(more.end(), {"--machine", machine});
    serve(more);
  }
  // Asks for the stream. Returns the socket.
  int view(const std::string& query = "") const {
    const int line = connected();
    const std::string text = "GET /api/v1/camera/stream" + query + " HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n";
    static_cast<void>(send(line, text.data(), text.size(), MSG_NOSIGNAL));
    return line;
  }
  // Reads until that many pictures have come, or the connection ends.
  static std::string pictures_from(int line, std::size_t pictures) {
    std::string answer;
    char bytes[4096];
    while (count_of(answer, "\xFF\xD9") < pictures) {
      pollfd one{.fd = line, .events = POLLIN, .revents = 0};
      const ssize_t got = poll(&one, 1, 30'000) > 0 ? recv(line, bytes, sizeof bytes, 0) : 0;
      if (got <= 0) break;
      answer.append(bytes, static_cast<std::size_t>(got));
    }
    return answer;
  }
  std::string watch(std::size_t pictures, const std::string& query = "") const {
    const int line = view(query);
    std::string answer = pictures_from(line, pictures);
    close(line);
    return answer;
  }
};

TEST_F(ServeCamera, passes_the_pictures_on_from_one_connection) {
  FakeCamera camera(Habit::stream);
  serve_with(camera);
  EXPECT_EQ(json("GET", "/machine")["camera"]["offset"]["x"], 30.0);
  EXPECT_EQ(json("GET", "/status")["camera"]["state"], "off");
  EXPECT_EQ(camera.connections(), 0) << "nobody watches";
  const int viewer = view("?url=http://127.0.0.1:1/secret");
  const std::string stream = pictures_from(viewer, 3);
  EXPECT_THAT(stream, HasSubstr("HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=picture\r\n"));
  EXPECT_THAT(stream, HasSubstr("\xFF\xD8\xFF\xE0picture "));
  EXPECT_EQ(json("GET", "/status")["camera"]["state"], "live");
  EXPECT_THAT(watch(3), HasSubstr("\xFF\xD9"));
  const std::string still = ask("GET", "/api/v1/camera/still");
  EXPECT_THAT(still, HasSubstr("Content-Type: image/jpeg\r\n"));
  EXPECT_TRUE(still.ends_with("\xFF\xD9"));
  EXPECT_EQ(camera.connections(), 1) << "for two viewers and a still";
  EXPECT_THAT(camera.last_request(), HasSubstr("GET /cam?fps=5 HTTP/1.1\r\n")) << "whatever a viewer asks for";
  close(viewer);
  EXPECT_EQ(end(SIGTERM), 0);
}

TEST_F(ServeCamera, shows_nothing_without_the_token_or_to_another_page) {
  FakeCamera camera(Habit::stream);
  write("token", "a-long-secret-token\n");
  serve_with(camera, {"--http-token", path("token")});
  EXPECT_THAT(watch(1), HasSubstr("401 Unauthorized"));
  EXPECT_THAT(ask("GET", "/api/v1/camera/still"), HasSubstr("401 Unauthorized"));
  EXPECT_THAT(watch(1, "?token=a-long-secret-token"), HasSubstr("\xFF\xD9"));
  const std::string foreign = "Origin: http://evil.example\r\nAuthorization: Bearer a-long-secret-token\r\n";
  EXPECT_THAT(ask("GET", "/api/v1/camera/stream", "", foreign), HasSubstr("403 Forbidden"));
}

TEST_F(ServeCamera, works_on_while_the_camera_is_silent_and_finds_it_again) {
  FakeCamera camera(Habit::silent);
  serve_with(camera, {"--data", path("data")});
  const std::string key = new_key();
  const auto run_job = [&](const std::string& name) {
    const auto program = json("POST", "/programs?name=" + name, "G21 G90\nG1 X1 F3000\nG1 X0\nM2\n");
    json("POST", fmt::format("/programs/{}/run", program.value("id", 0)), "", key);
    return until([&] {
      const auto job = json("GET", "/status")["job"];
      return job["name"] == name && job["state"] == "done";
    });
  };
  EXPECT_TRUE(run_job("silent.ngc"));
  EXPECT_TRUE(until([&] { return camera.open() == 1; }));
  camera.go();
  camera.change(Habit::stream);
  camera.come_back();
  EXPECT_TRUE(run_job("live.ngc"));
  EXPECT_TRUE(until([&] { return json("GET", "/history")["jobs"][0]["stills"].size() == 2; }))
      << json("GET", "/history");
  const int still = json("GET", "/history")["jobs"][0]["stills"][0]["id"];
  EXPECT_TRUE(ask("GET", fmt::format("/api/v1/history/stills/{}", still)).ends_with("\xFF\xD9"));
}

TEST_F(ServeCamera, refuses_an_address_that_is_not_plain_http) {
  write("bad.toml", read(std::string(PASSO_SOURCE_DIR) + "/examples/machines/router.toml") +
                        "\n[camera]\nurl = \"file:///etc/passwd\"\n");
  const auto refused = passo("serve --http 127.0.0.1:0 --machine " + path("bad.toml"));
  EXPECT_EQ(refused.code, 3);
  EXPECT_THAT(refused.err, HasSubstr("[machine.camera]"));
  EXPECT_THAT(refused.err, HasSubstr("camera.url is not a plain http address"));
}

}  // namespace
