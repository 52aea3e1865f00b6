#include "passo/transport/board_address.hpp"

#include <gtest/gtest.h>

namespace passo {
namespace {

using Kind = BoardAddress::Kind;

TEST(BoardAddress, is_read_as_a_user_writes_it) {
  EXPECT_EQ(*parse_board_address("virtual"), BoardAddress());
  EXPECT_EQ(*parse_board_address("sim:uno"), (BoardAddress{.kind = Kind::emulated, .place = "uno", .port = ""}));
  EXPECT_EQ(*parse_board_address("serial:/dev/ttyUSB0"),
            (BoardAddress{.kind = Kind::serial, .place = "/dev/ttyUSB0", .port = "", .baud = 500'000}));
  EXPECT_EQ(*parse_board_address("serial:/dev/serial/by-id/a@b@115200"),
            (BoardAddress{.kind = Kind::serial, .place = "/dev/serial/by-id/a@b", .port = "", .baud = 115'200}));
  EXPECT_EQ(*parse_board_address("tcp:localhost:7070"),
            (BoardAddress{.kind = Kind::tcp, .place = "localhost", .port = "7070"}));
  EXPECT_EQ(*parse_board_address("tcp:[::1]:7070"), (BoardAddress{.kind = Kind::tcp, .place = "::1", .port = "7070"}));
}

TEST(BoardAddress, may_be_of_a_machine_that_speaks_grbl) {
  EXPECT_EQ(
      *parse_board_address("grbl:/dev/ttyUSB0"),
      (BoardAddress{.kind = Kind::serial, .place = "/dev/ttyUSB0", .port = "", .baud = 115'200, .speaks_grbl = true}));
  EXPECT_EQ(
      *parse_board_address("grbl:serial:/dev/ttyUSB0@230400"),
      (BoardAddress{.kind = Kind::serial, .place = "/dev/ttyUSB0", .port = "", .baud = 230'400, .speaks_grbl = true}));
  EXPECT_EQ(*parse_board_address("grbl:tcp:fluid.local:23"),
            (BoardAddress{.kind = Kind::tcp, .place = "fluid.local", .port = "23", .speaks_grbl = true}));
  EXPECT_EQ(
      *parse_board_address("grbl:tcp:192.168.1.7:8888@115200"),
      (BoardAddress{
          .kind = Kind::tcp, .place = "192.168.1.7", .port = "8888", .behind_baud = 115'200, .speaks_grbl = true}));
  EXPECT_EQ(*parse_board_address("grbl:ws://fluidnc.local"),
            (BoardAddress{.kind = Kind::websocket, .place = "fluidnc.local", .port = "81", .speaks_grbl = true}));
  EXPECT_EQ(*parse_board_address("grbl:ws://[::1]:8080/"),
            (BoardAddress{.kind = Kind::websocket, .place = "::1", .port = "8080", .speaks_grbl = true}));
  EXPECT_EQ(parse_board_address("grbl:ws://[::1]")->port, "81");
  for (const char* text : {"grbl:", "grbl", "grbl:ws:", "grbl:ws://", "grbl:ws://host/path", "grbl:ws://host:x",
                           "ws://host", "grbl:tcp:", "grbl:tcp:host", "grbl:tcp:host:23@", "grbl:tcp:host:23@fast",
                           "grbl:virtual", "grbl:sim:uno", "grbl:/dev/a@", "grbl:serial:"}) {
    EXPECT_FALSE(parse_board_address(text)) << text;
  }
}

TEST(BoardAddress, that_is_none_says_what_was_expected) {
  for (const char* text : {"", "serial", "serial:", "serial:@500000", "serial:/dev/a@", "serial:/dev/a@fast",
                           "serial:/dev/a@99999999", "tcp:", "tcp:host", "tcp:host:", "tcp::1", "tcp:host:0",
                           "tcp:host:65536", "tcp:::1:80", "tcp:[]:80", "/dev/ttyUSB0", "Virtual", "sim:", "sim"}) {
    const auto address = parse_board_address(text);
    ASSERT_FALSE(address) << text;
    EXPECT_NE(address.error().find("expected virtual, serial:DEVICE"), std::string::npos) << address.error();
  }
}

}  // namespace
}  // namespace passo
