// The first line of a connection: senders of G-code get through byte by byte, and nothing of anybody else.
#include "passo/transport/client_filter.hpp"

#include <random>
#include <string>

#include <gtest/gtest.h>

namespace passo {
namespace {

using Verdict = ClientFilter::Caller;
using namespace std::string_literals;

// What a page wants to do with the machine, behind the protocol's own first bytes.
const std::string body = "\r\n\r\nM3S12000\nG10L2P1X-50\nG91G0X30\n?!~\x18\x90\n";

const std::string strangers[] = {
    "GET / HTTP/1.1",
    "GET /?!~\x18 HTTP/1.1",
    "POST / HTTP/1.1\r\nHost: 127.0.0.1:7071",
    "HEAD / HTTP/1.0",
    "PUT / HTTP/1.1",
    "DELETE / HTTP/1.1",
    "OPTIONS * HTTP/1.1",
    "PATCH / HTTP/1.1",
    "TRACE / HTTP/1.1",
    "CONNECT 127.0.0.1:7071 HTTP/1.1",
    "PRI * HTTP/2.0",
    "M-SEARCH * HTTP/1.1",
    "VERSION-CONTROL / HTTP/1.1",
    "get / http/1.1",
    "\r\nGET / HTTP/1.1",
    "GET /index.html",                                // HTTP/0.9
    "PROXY TCP4 127.0.0.1 127.0.0.1 40000 7071",      // a proxy in front of a browser
    "\r\n\r\n\0\r\nQUIT\n"s,                          // the same, binary
    "OPTIONS rtsp://127.0.0.1:7071/ RTSP/1.0",        //
    "REGISTER sip:127.0.0.1 SIP/2.0",                 //
    "SSH-2.0-OpenSSH_9.6",                            //
    "EHLO page.example",                              // mail
    "USER anonymous",                                 // FTP
    "NICK page",                                      // IRC
    "\x16\x03\x01\x02\x00\x01\x00\x01\xFC\x03\x03"s,  // TLS
    "\x00\x01\x00\x58\x21\x12\xA4\x42"s,              // STUN, as WebRTC sends it over TCP
    "\x03\x00\x00\x13\x0E\xE0"s,                      // RDP
    "\x00\x00\x00\x85\xFFSMB"s,                       // SMB
    "\x10\x0C\x00\x04MQTT"s,                          //
    "\x05\x01\x00"s,                                  // SOCKS
};

const std::string senders[] = {
    "?",
    "\x18",
    "\n\n$G\n!",
    "\r\n",
    "$I\n",
    "G0 X1\n",
    "G91G0X5",
    "g1 x1 f100\n",
    "M3\n",
    "\x87\x87",
    "\xC2\x87?",
    "version\n",
    "\n\x18version\n",
    "GO X10\n",
    "%\nN10 G0",
    "(MSG,GET /)\n",
    "; GET / HTTP/1.1\n",
    "T1 M6\n",
    "X-5\n",
    "N10 G90\n",
    "F100\n",
    "G\n",
    "G!\n",
    "GE?",
    "GET\n",
    "$J=G91X1F100\n",
    "/G0 X1\n",
    "Z--2\n",
    "S-SH\n",
    "~",
};

TEST(ClientFilter, lets_nothing_of_a_stranger_through_however_it_is_cut) {
  std::mt19937 random(7);
  for (const std::string& first : strangers) {
    const std::string all = first + body;
    for (int trial = 0; trial < 20; ++trial) {
      ClientFilter check;
      std::string passed;
      for (std::size_t at = 0; at < all.size();) {
        const std::size_t size = trial == 0 ? 1 : 1 + random() % all.size();
        passed += check.pass(all.substr(at, size));
        at += size;
      }
      EXPECT_EQ(check.caller(), Verdict::stranger) << first;
      EXPECT_EQ(passed.find_first_not_of("\r\n"), std::string::npos) << first;
    }
  }
}

TEST(ClientFilter, lets_a_sender_through_and_real_time_bytes_at_once) {
  for (const std::string& first : senders) {
    ClientFilter check;
    std::string passed;
    for (const char c : first) passed += check.pass({&c, 1});
    passed += check.pass("\n");
    EXPECT_EQ(passed, first + "\n");
    EXPECT_NE(check.caller(), Verdict::stranger) << first;
  }
  ClientFilter check;
  EXPECT_EQ(check.pass("?"), "?");
  EXPECT_EQ(check.caller(), Verdict::unknown);
  EXPECT_EQ(check.pass("G"), "") << "this may become GET";
  EXPECT_EQ(check.pass("!"), "G!");
  EXPECT_EQ(check.pass("GET / HTTP/1.1\n"), "GET / HTTP/1.1\n") << "only the first line tells who calls";
}

TEST(ClientFilter, on_a_serial_port_noise_is_dropped_and_a_line_that_has_begun_is_kept) {
  ClientFilter check(ClientFilter::Noise::possible);
  EXPECT_EQ(check.pass("\x00\x01?"s), "?");
  EXPECT_EQ(check.pass("G"), "");
  check.begin_anew();
  EXPECT_EQ(check.pass("0\n"), "G0\n");
  check.begin_anew();
  EXPECT_EQ(check.pass("POST / HTTP/1.1\r\nG0X1\n"), "");
  check.begin_anew();
  EXPECT_EQ(check.pass("$G\n"), "$G\n");
}

}  // namespace
}  // namespace passo
