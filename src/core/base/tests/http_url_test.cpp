#include "passo/base/http_url.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

TEST(HttpUrl, has_a_host_a_port_and_a_target) {
  const auto full = parse_http_url("http://mill-cam.local:8080/stream?fps=5&x=%20");
  ASSERT_TRUE(full);
  EXPECT_EQ(full->host, "mill-cam.local");
  EXPECT_EQ(full->port, 8080);
  EXPECT_EQ(full->target, "/stream?fps=5&x=%20");
  EXPECT_EQ(full->host_and_port(), "mill-cam.local:8080");
  EXPECT_EQ(parse_http_url("http://10.0.0.7"), (HttpUrl{.host = "10.0.0.7", .port = 80, .target = "/"}));
  EXPECT_EQ(parse_http_url("http://10.0.0.7")->host_and_port(), "10.0.0.7");
  EXPECT_EQ(parse_http_url("http://cam?action=stream")->target, "/?action=stream");
  EXPECT_EQ(parse_http_url("http://[fe80::1]:81/x"), (HttpUrl{.host = "fe80::1", .port = 81, .target = "/x"}));
  EXPECT_EQ(parse_http_url("http://[fe80::1]:81/x")->host_and_port(), "[fe80::1]:81");
}

TEST(HttpUrl, is_refused_if_it_is_of_another_kind_or_could_forge_a_request) {
  for (const char* const text : {"",
                                 "http://",
                                 "https://cam/",
                                 "ftp://cam/",
                                 "file:///etc/passwd",
                                 "HTTP//cam",
                                 "http:///x",
                                 "http://cam:/",
                                 "http://cam:0/",
                                 "http://cam:65536/",
                                 "http://cam:80x/",
                                 "http://cam:-1/",
                                 "http://user:secret@cam/",
                                 "http://cam/a b",
                                 "http://cam/\r\nHost: other",
                                 "http://cam/#top",
                                 "http://ca m/",
                                 "http://cam\n/",
                                 "http://[::1",
                                 "http://[]/",
                                 "http://cam\\x",
                                 "http://c\xC3\xA4m/"}) {
    EXPECT_FALSE(parse_http_url(text)) << text;
  }
  EXPECT_FALSE(parse_http_url("http://cam/" + std::string(3000, 'x')));
  EXPECT_FALSE(parse_http_url("http://" + std::string(300, 'x')));
}

}  // namespace
}  // namespace passo
