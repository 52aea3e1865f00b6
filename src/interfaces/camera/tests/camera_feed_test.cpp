// CameraFeed at a camera of its own, over a real socket.
#include "passo/camera/camera_feed.hpp"

#include <chrono>

#include "kit/fake_camera.hpp"

namespace passo {
namespace {

using test::FakeCamera;
using Habit = FakeCamera::Habit;
using State = CameraStatus::State;

constexpr CameraPace patient{.connect_within = Seconds(10),
                             .picture_within = Seconds(60),
                             .first_retry = Seconds(0.02),
                             .last_retry = Seconds(0.1),
                             .between_snapshots = Seconds(0.01),
                             .wants_within = Seconds(60),
                             .lingers = Seconds(0.05)};

// Notices soon that a camera is silent.
CameraPace impatient() {
  CameraPace pace = patient;
  pace.picture_within = Seconds(0.3);
  return pace;
}

CameraFeed feed_of(const std::string& url, const std::string& snapshot = "", const CameraPace& pace = patient) {
  return {*parse_http_url(url), snapshot.empty() ? std::nullopt : parse_http_url(snapshot), pace};
}

template <class Condition>
bool soon(Condition condition) {
  for (int i = 0; i < 15'000 && !condition(); ++i) usleep(2000);
  return condition();
}

TEST(CameraFeed, fetches_pictures_only_while_they_are_wanted) {
  const FakeCamera camera(Habit::stream);
  CameraFeed feed = feed_of(camera.url("/stream?fps=9"));
  usleep(50'000);
  EXPECT_EQ(camera.connections(), 0);
  EXPECT_EQ(feed.status().state, State::off);
  EXPECT_FALSE(feed.status().age);
  feed.watch(true);
  ASSERT_TRUE(soon([&] { return feed.newest().number > 5; }));
  EXPECT_EQ(feed.status().state, State::live);
  EXPECT_LT(*feed.status().age, Seconds(1));
  EXPECT_TRUE(feed.newest().jpeg->starts_with("\xFF\xD8\xFF\xE0picture "));
  EXPECT_EQ(camera.connections(), 1);
  feed.watch(false);
  ASSERT_TRUE(soon([&] { return camera.open() == 0 && feed.status().state == State::off; }));
  EXPECT_TRUE(camera.last_request().starts_with("GET /stream?fps=9 HTTP/1.1\r\nHost: 127.0.0.1:"));
}

TEST(CameraFeed, reads_every_kind_of_stream) {
  for (const Habit habit : {Habit::chunked, Habit::without_length, Habit::still, Habit::slow}) {
    const FakeCamera camera(habit);
    CameraFeed feed = feed_of(camera.url());
    feed.watch(true);
    EXPECT_TRUE(soon([&] { return feed.newest().number >= 3; })) << static_cast<int>(habit);
    EXPECT_EQ(feed.status().problem.code, "");
  }
}

TEST(CameraFeed, gives_a_single_picture_of_the_stream_or_of_the_snapshot) {
  const FakeCamera camera(Habit::stream);
  CameraFeed alone = feed_of(camera.url());
  EXPECT_EQ(alone.want_picture(), 0U);
  ASSERT_TRUE(soon([&] { return alone.newest().number >= 1 && camera.open() == 0; }));
  CameraFeed feed = feed_of(camera.url(), camera.url("/snapshot"));
  const std::uint64_t before = feed.want_picture();
  ASSERT_TRUE(soon([&] { return feed.newest().number > before && camera.open() == 0; }));
  EXPECT_TRUE(camera.last_request().starts_with("GET /snapshot "));
  EXPECT_EQ(feed.newest().number, 1U);
}

TEST(CameraFeed, reports_a_bad_camera_and_tries_again) {
  const std::pair<Habit, const char*> faults[] = {{Habit::silent, "camera.silent"},
                                                  {Habit::stalls, "camera.silent"},
                                                  {Habit::short_length, "camera.wrong-length"},
                                                  {Habit::long_length, "camera.wrong-length"},
                                                  {Habit::huge, "camera.too-large"},
                                                  {Habit::endless, "camera.too-large"},
                                                  {Habit::text, "camera.no-pictures"},
                                                  {Habit::redirects, "camera.status"},
                                                  {Habit::closes, "camera.ended"},
                                                  {Habit::broken_boundary, ""}};
  for (const auto& [habit, code] : faults) {
    const bool is_silent = habit == Habit::silent || habit == Habit::stalls;
    FakeCamera camera(habit);
    CameraFeed feed = feed_of(camera.url(), "", is_silent ? impatient() : patient);
    feed.watch(true);
    CameraStatus seen;
    ASSERT_TRUE(soon([&] {
      seen = feed.status();
      return seen.state == State::waiting;
    })) << static_cast<int>(habit);
    if (*code != '\0') EXPECT_EQ(seen.problem.code, code) << static_cast<int>(habit);
    camera.change(Habit::stream);
    const std::uint64_t before = feed.newest().number;
    EXPECT_TRUE(soon([&] {
      const CameraStatus status = feed.status();
      return feed.newest().number > before + 3 && status.state == State::live && status.problem.code.empty();
    })) << static_cast<int>(habit);
  }
}

TEST(CameraFeed, waits_longer_and_longer_for_a_camera_that_is_gone_and_finds_it_again) {
  FakeCamera camera(Habit::stream);
  CameraFeed feed = feed_of(camera.url());
  feed.watch(true);
  ASSERT_TRUE(soon([&] { return feed.newest().number > 2; }));
  camera.go();
  ASSERT_TRUE(soon([&] { return feed.status().problem.code == "camera.unreachable"; }));
  EXPECT_EQ(feed.status().state, State::waiting);
  const std::uint64_t before = feed.newest().number;
  camera.come_back();
  EXPECT_TRUE(soon([&] { return feed.newest().number > before; }));
  EXPECT_EQ(feed.status().problem.code, "");
}

TEST(CameraFeed, counts_few_attempts_at_a_camera_that_refuses) {
  const FakeCamera camera(Habit::redirects);
  CameraFeed feed = feed_of(camera.url());
  feed.watch(true);
  const auto begin = std::chrono::steady_clock::now();
  ASSERT_TRUE(soon([&] { return camera.connections() >= 6; }));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_GT(took.count(), 0.3) << "0.02, 0.04, 0.08, then 0.1 s each";
}

TEST(CameraFeed, does_not_find_a_host_that_does_not_exist) {
  CameraFeed feed = feed_of("http://camera.invalid/stream");
  feed.want_picture();
  EXPECT_TRUE(soon([&] { return feed.status().problem.code == "camera.unreachable"; }));
}

TEST(CameraFeed, ends_at_any_time) {
  for (int i = 0; i < 10; ++i) {
    const FakeCamera camera(i % 2 == 0 ? Habit::stream : Habit::silent);
    CameraFeed feed = feed_of(camera.url());
    feed.watch(true);
    usleep(static_cast<unsigned>(i) * 1000);
  }
}

}  // namespace
}  // namespace passo
