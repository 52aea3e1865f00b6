// A sender that comes, speaks, is held up and goes: over TCP and through a pseudo-terminal.
#include "passo/transport/sender_connection.hpp"

#include <filesystem>

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace passo {
namespace {

int connect_to(unsigned port) {
  const int made = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  EXPECT_EQ(connect(made, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  return made;
}

// Looks again and again until there is news of the wanted kind.
template <class Wanted>
SenderConnection::News look_for(SenderConnection& line, const Wanted& wanted, bool reads = true) {
  SenderConnection::News news;
  for (int i = 0; i < 2000; ++i, usleep(1000)) {
    news = line.poll(reads);
    if (wanted(news)) break;
  }
  return news;
}
bool came(const SenderConnection::News& news) {
  return news.came;
}
bool went(const SenderConnection::News& news) {
  return news.went;
}
bool spoke(const SenderConnection::News& news) {
  return !news.bytes.empty();
}

std::string read_from(int descriptor, std::size_t size) {
  std::string text;
  char c = 0;
  while (text.size() < size && read(descriptor, &c, 1) == 1) text += c;
  return text;
}

TEST(SenderConnection, serves_one_sender_over_tcp_and_sends_a_second_one_away) {
  auto line = SenderConnection::listen("127.0.0.1", 0);
  ASSERT_TRUE(line) << line.error();
  const int first = connect_to((*line)->port());
  EXPECT_TRUE(look_for(**line, came).came);
  const int second = connect_to((*line)->port());
  ASSERT_EQ(write(first, "G0\n", 3), 3);
  EXPECT_EQ(look_for(**line, spoke).bytes, "G0\n");
  (*line)->send("ok\r\n");
  EXPECT_EQ(read_from(first, 4), "ok\r\n");
  static_cast<void>((*line)->poll(true));
  EXPECT_TRUE(read_from(second, 1000).starts_with("[MSG:Another sender"));
  close(second);
  close(first);
  EXPECT_TRUE(look_for(**line, went).went);
  const int third = connect_to((*line)->port());
  EXPECT_TRUE(look_for(**line, came).came);
  close(third);
}

TEST(SenderConnection, leaves_bytes_where_they_are_until_it_is_to_read) {
  auto line = SenderConnection::listen("127.0.0.1", 0);
  ASSERT_TRUE(line);
  const int sender = connect_to((*line)->port());
  EXPECT_TRUE(look_for(**line, came, false).came);
  ASSERT_EQ(write(sender, "G0\n", 3), 3);
  for (int i = 0; i < 20; ++i, usleep(1000)) EXPECT_TRUE((*line)->poll(false).bytes.empty());
  EXPECT_EQ(look_for(**line, spoke).bytes, "G0\n");
  close(sender);
}

TEST(SenderConnection, a_pseudo_terminal_serves_one_sender_after_the_other_without_an_echo) {
  const std::string link =
      (std::filesystem::temp_directory_path() / ("passo-tty-" + std::to_string(getpid()))).string();
  {
    auto line = SenderConnection::open_terminal(link);
    ASSERT_TRUE(line) << line.error();
    EXPECT_FALSE((*line)->poll(true).came) << "nobody has come yet";
    for (int round = 0; round < 2; ++round) {
      const int sender = open(link.c_str(), O_RDWR | O_NOCTTY);
      ASSERT_GE(sender, 0);
      EXPECT_TRUE(look_for(**line, came).came);
      (*line)->send("hello\r\n");
      EXPECT_EQ(read_from(sender, 7), "hello\r\n");
      for (int i = 0; i < 20; ++i, usleep(1000)) EXPECT_TRUE((*line)->poll(true).bytes.empty()) << "an echo";
      ASSERT_EQ(write(sender, "?\n", 2), 2);
      EXPECT_EQ(look_for(**line, spoke).bytes, "?\n");
      close(sender);
      EXPECT_TRUE(look_for(**line, went).went);
    }
  }
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(link)));
}

// The other end of a pseudo-terminal is a serial port like any other.
TEST(SenderConnection, of_a_serial_port_has_a_sender_when_somebody_speaks_and_none_when_the_device_is_gone) {
  const int sender = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(sender >= 0 && grantpt(sender) == 0 && unlockpt(sender) == 0);
  auto line = SenderConnection::open_serial(ptsname(sender), 115'200);
  ASSERT_TRUE(line) << line.error();
  EXPECT_FALSE(SenderConnection::open_serial(ptsname(sender), 115'200)) << "it is this program's";
  EXPECT_FALSE((*line)->poll(true).came);
  ASSERT_EQ(write(sender, "?", 1), 1);
  const SenderConnection::News news = look_for(**line, came);
  EXPECT_TRUE(news.came);
  EXPECT_EQ(news.bytes, "?");
  EXPECT_FALSE((*line)->yields()) << "it has just spoken";
  (*line)->send("<Idle>\r\n");
  EXPECT_EQ(read_from(sender, 8), "<Idle>\r\n");
  close(sender);
  EXPECT_TRUE(look_for(**line, went).went);
  EXPECT_FALSE((*line)->is_connected());
  EXPECT_FALSE(SenderConnection::open_serial("/dev/null", 115'200));
  EXPECT_FALSE(SenderConnection::open_serial("/nowhere", 115'200));
}

// What a browser sends for a page's fetch(), in pieces: nothing of it is heard, and it is sent away.
TEST(SenderConnection, over_tcp_sends_a_stranger_away_unheard) {
  auto line = SenderConnection::listen("127.0.0.1", 0);
  ASSERT_TRUE(line) << line.error();
  const int stranger = connect_to((*line)->port());
  EXPECT_TRUE(look_for(**line, came).came);
  ASSERT_EQ(write(stranger, "PO", 2), 2);
  for (int i = 0; i < 20; ++i, usleep(1000)) EXPECT_TRUE((*line)->poll(true).bytes.empty());
  const std::string_view rest = "ST /?~ HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\nM3S12000\n";
  ASSERT_EQ(write(stranger, rest.data(), rest.size()), static_cast<ssize_t>(rest.size()));
  const SenderConnection::News news = look_for(**line, [](const auto& one) { return spoke(one) || went(one); });
  EXPECT_TRUE(news.went);
  EXPECT_TRUE(news.bytes.empty());
  close(stranger);
  const int sender = connect_to((*line)->port());
  ASSERT_EQ(write(sender, "G0\n", 3), 3);
  EXPECT_EQ(look_for(**line, spoke).bytes, "G0\n") << "the next one is judged by what it says itself";
  close(sender);
}

TEST(SenderConnection, of_a_terminal_hears_nothing_of_a_stranger_until_it_has_gone) {
  const std::string link =
      (std::filesystem::temp_directory_path() / ("passo-strange-" + std::to_string(getpid()))).string();
  auto line = SenderConnection::open_terminal(link);
  ASSERT_TRUE(line) << line.error();
  const int stranger = open(link.c_str(), O_RDWR | O_NOCTTY);
  EXPECT_TRUE(look_for(**line, came).came);
  for (const std::string_view piece : {"GET / HTTP/1.1\r\n", "\r\nG0X9\n", "?~\n"}) {
    ASSERT_EQ(write(stranger, piece.data(), piece.size()), static_cast<ssize_t>(piece.size()));
    for (int i = 0; i < 20; ++i, usleep(1000)) EXPECT_TRUE((*line)->poll(true).bytes.empty());
  }
  close(stranger);
  EXPECT_TRUE(look_for(**line, went).went);
  const int sender = open(link.c_str(), O_RDWR | O_NOCTTY);
  EXPECT_TRUE(look_for(**line, came).came);
  ASSERT_EQ(write(sender, "?\n", 2), 2);
  EXPECT_EQ(look_for(**line, spoke).bytes, "?\n");
  close(sender);
}

TEST(SenderConnection, of_a_serial_port_hears_a_sender_again_after_a_stranger_and_a_pause) {
  const int sender = posix_openpt(O_RDWR | O_NOCTTY);
  ASSERT_TRUE(sender >= 0 && grantpt(sender) == 0 && unlockpt(sender) == 0);
  auto line = SenderConnection::open_serial(ptsname(sender), 115'200);
  ASSERT_TRUE(line) << line.error();
  const std::string_view request = "GET /?~ HTTP/1.1\r\n\r\nM3S1000\n";
  ASSERT_EQ(write(sender, request.data(), request.size()), static_cast<ssize_t>(request.size()));
  for (int i = 0; i < 20; ++i, usleep(1000)) EXPECT_FALSE((*line)->poll(true).came);
  usleep(1'100'000);
  ASSERT_EQ(write(sender, "?", 1), 1);
  EXPECT_EQ(look_for(**line, came).bytes, "?");
  close(sender);
}

TEST(SenderConnection, a_file_in_the_place_of_the_link_is_never_replaced) {
  const std::string link =
      (std::filesystem::temp_directory_path() / ("passo-file-" + std::to_string(getpid()))).string();
  close(open(link.c_str(), O_CREAT | O_WRONLY, 0600));
  EXPECT_FALSE(SenderConnection::open_terminal(link));
  EXPECT_TRUE(std::filesystem::is_regular_file(link));
  std::filesystem::remove(link);
}

}  // namespace
}  // namespace passo
