#include "passo/web/web_access.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

constexpr auto no = std::nullopt;

TEST(WebAccess, knows_the_server_by_its_own_names_alone) {
  const WebAccess access{.names = {"localhost", "127.0.0.1", "[::1]"}, .token = ""};
  EXPECT_EQ(access.refuse({.host = "localhost:7080"}), no);
  EXPECT_EQ(access.refuse({.host = "LocalHost"}), no);
  EXPECT_EQ(access.refuse({.host = "[::1]:80"}), no);
  EXPECT_EQ(access.refuse({.host = "[::1]"}), no);
  EXPECT_EQ(access.refuse({.host = ""}), 400U);
  // A name that a foreign page has given to this address.
  for (const char* host : {"evil.example", "evil.example:7080", "localhost.evil.example", "127.0.0.1.evil.example",
                           "localhost:7080:7080", ":7080", "[::1", "localhost,evil"}) {
    EXPECT_EQ(access.refuse({.host = host}), 403U) << host;
  }
}

TEST(WebAccess, refuses_pages_of_others) {
  const WebAccess access{.names = {"localhost"}, .token = ""};
  EXPECT_EQ(access.refuse({.host = "localhost:7080", .origin = "http://localhost:7080"}), no);
  EXPECT_EQ(access.refuse({.host = "localhost:7080", .origin = "https://localhost:7080"}), no) << "behind a proxy";
  for (const char* origin : {"null", "http://evil.example", "http://localhost", "http://localhost:7081", "file://",
                             "http://localhost:7080.evil.example", "HTTP://localhost:7080/"}) {
    EXPECT_EQ(access.refuse({.host = "localhost:7080", .origin = origin}), 403U) << origin;
  }
}

TEST(WebAccess, asks_for_the_token_where_there_is_one) {
  const WebAccess access{.names = {"shop"}, .token = "s3cret"};
  EXPECT_EQ(access.refuse({.host = "shop"}), 401U);
  EXPECT_EQ(access.refuse({.host = "shop", .authorization = "Bearer s3cret"}), no);
  EXPECT_EQ(access.refuse({.host = "shop", .query = "hz=5&token=s3cret"}), no);
  EXPECT_EQ(access.refuse({.host = "shop", .authorization = "Bearer wrong", .query = "token=s3cret"}), 401U);
  for (const char* given : {"", "Bearer", "Bearer ", "Bearer s3cre", "Bearer s3crett", "s3cret", "Basic s3cret"}) {
    EXPECT_EQ(access.refuse({.host = "shop", .authorization = given}), 401U) << given;
  }
  EXPECT_EQ(access.refuse({.host = "other", .authorization = "Bearer s3cret"}), 403U) << "the name counts first";
  EXPECT_EQ(access.refuse({.host = "shop", .query = "token=s3cre%74"}), no) << "percent-encoded";
  EXPECT_EQ((WebAccess{.names = {"shop"}, .token = "a%zz"}.refuse({.host = "shop", .query = "token=a%zz"})), no);
}

TEST(QueryValue, finds_whole_keys) {
  EXPECT_EQ(query_value("hz=5&token=a=b", "token"), "a=b");
  EXPECT_EQ(query_value("hz=5", "hz"), "5");
  EXPECT_EQ(query_value("xhz=5&hzz=3", "hz"), "");
  EXPECT_EQ(query_value("hz=", "hz"), "");
  EXPECT_EQ(query_value("&&&", "hz"), "");
  EXPECT_EQ(query_value("", "hz"), "");
  EXPECT_EQ(percent_decoded("a%20b%2fc%2Bd+%E9%9B%B6"), "a b/c+d+零");
  EXPECT_EQ(percent_decoded(""), "");
  for (const char* text : {"%", "a%4", "%zz", "%4g", "%%41"}) EXPECT_EQ(percent_decoded(text), std::nullopt) << text;
}

}  // namespace
}  // namespace passo
