#include "passo/camera/camera_response.hpp"

#include <vector>

#include "kit/fake_camera.hpp"

namespace passo {
namespace {

using test::fake_jpeg;

const std::string multipart = "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=cut\r\n\r\n";

std::string part(const std::string& picture) {
  return "--cut\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(picture.size()) + "\r\n\r\n" +
         picture + "\r\n";
}

struct Outcome {
  std::vector<std::string> pictures;
  std::string problem;  // its code
  bool reads_on = true;
};
// Reads a response in pieces of that length.
Outcome outcome_of(const std::string& response, std::size_t piece = 1'000'000, bool ends = false) {
  CameraResponse reader;
  Outcome outcome;
  const auto take = [&] {
    if (auto picture = reader.take_picture()) outcome.pictures.push_back(std::move(*picture));
  };
  for (std::size_t at = 0; at < response.size() && outcome.reads_on; at += piece) {
    outcome.reads_on = reader.read(std::string_view(response).substr(at, piece));
    take();
  }
  if (ends) reader.end();
  take();
  outcome.problem = reader.problem().code;
  return outcome;
}
using Pictures = std::vector<std::string>;

TEST(CameraResponse, gives_each_picture_wherever_the_pieces_are_cut) {
  const Pictures both = {fake_jpeg(1), fake_jpeg(2, 3000)};
  const std::string chunked =
      "HTTP/1.1 200 OK\r\nTransfer-Encoding: chunked\r\nContent-Type: multipart/x-mixed-replace;boundary=cut\r\n\r\n";
  const auto in_chunks = [](std::string text) {
    std::string chunks;
    while (!text.empty()) {
      const std::string now = text.substr(0, 0x47);
      text.erase(0, now.size());
      char size[20];
      static_cast<void>(std::snprintf(size, sizeof size, "%zX;x=y\r\n", now.size()));
      chunks += size + now + "\r\n";
    }
    return chunks;
  };
  const std::string parts = part(both[0]) + part(both[1]) + "--cut\r\n";
  const std::string esp = "Content-Type: image/jpeg\r\nContent-Length: " + std::to_string(both[0].size()) + "\r\n\r\n" +
                          both[0] + "\r\n--cut\r\n" + part(both[1]).substr(7);
  const std::string plain =
      "--cut\r\nContent-Type: image/jpeg\r\n\r\n" + both[0] + "\r\n--cut\r\n\r\n" + both[1] + "\r\n--cut\r\n";
  const std::string dashes =
      "HTTP/1.0 200 OK\r\nContent-type: multipart/x-mixed-replace; boundary=\"--cut\"\r\n\r\npreamble\r\n";
  for (const std::size_t piece : {1U, 2U, 7U, 100U}) {
    EXPECT_EQ(outcome_of(multipart + parts, piece).pictures, both) << piece;
    EXPECT_EQ(outcome_of(chunked + in_chunks(esp), piece).pictures, both) << piece;
    EXPECT_EQ(outcome_of(multipart + plain, piece).pictures, both) << piece;
    EXPECT_EQ(outcome_of(dashes + plain, piece).pictures, both) << piece;
    EXPECT_EQ(outcome_of(multipart + parts, piece).problem, "");
  }
}

TEST(CameraResponse, gives_only_the_newest_of_the_pictures_in_one_piece) {
  EXPECT_EQ(outcome_of(multipart + part(fake_jpeg(1)) + part(fake_jpeg(2))).pictures, Pictures{fake_jpeg(2)});
}

TEST(CameraResponse, gives_a_single_picture_with_a_length_in_chunks_or_up_to_the_end) {
  const std::string picture = fake_jpeg(1);
  const std::string head = "HTTP/1.1 200 OK\r\nContent-Type: image/jpeg\r\n";
  const Outcome with_length =
      outcome_of(head + "Content-Length: " + std::to_string(picture.size()) + "\r\n\r\n" + picture, 10);
  EXPECT_EQ(with_length.pictures, Pictures{picture});
  EXPECT_FALSE(with_length.reads_on);
  EXPECT_EQ(with_length.problem, "");
  EXPECT_EQ(outcome_of(head + "\r\n" + picture, 10, true).pictures, Pictures{picture});
  char size[20];
  static_cast<void>(std::snprintf(size, sizeof size, "%zx\r\n", picture.size()));
  const Outcome chunked =
      outcome_of(head + "Transfer-Encoding: chunked\r\n\r\n" + size + picture + "\r\n0\r\n\r\n", 10);
  EXPECT_EQ(chunked.pictures, Pictures{picture});
  EXPECT_EQ(chunked.problem, "");
}

TEST(CameraResponse, ends_with_the_reason_if_it_cannot_be_read) {
  const auto problem = [](const std::string& response, bool ends = false) {
    const Outcome outcome = outcome_of(response, 1000, ends);
    EXPECT_TRUE(ends || !outcome.reads_on) << response.substr(0, 100);
    return outcome.problem;
  };
  const std::string head = "HTTP/1.1 200 OK\r\nContent-Type: ";
  const std::string picture = fake_jpeg(1, 20'000);
  const auto of_length = [&](std::size_t length) {
    return multipart + "--cut\r\nContent-Length: " + std::to_string(length) + "\r\n\r\n" + picture +
           "\r\n--cut\r\n\r\n";
  };
  EXPECT_EQ(problem("SSH-2.0-OpenSSH\r\n"), "camera.bad-response");
  EXPECT_EQ(problem("HTTP/1.1 2\r\n"), "camera.bad-response");
  EXPECT_EQ(problem(std::string(20'000, 'x')), "camera.bad-response");
  EXPECT_EQ(problem("HTTP/1.1 302 Found\r\nLocation: http://other/\r\n\r\n"), "camera.status");
  EXPECT_EQ(problem("HTTP/1.1 404 Not Found\r\n\r\n"), "camera.status");
  EXPECT_EQ(problem(head + "text/html\r\n\r\n<html>"), "camera.no-pictures");
  EXPECT_EQ(problem("HTTP/1.1 200 OK\r\n\r\n"), "camera.no-pictures");
  EXPECT_EQ(problem(head + "multipart/x-mixed-replace\r\n\r\n"), "camera.bad-response") << "without a boundary";
  EXPECT_EQ(problem(head + "image/jpeg\r\nContent-Length: -5\r\n\r\n"), "camera.bad-response");
  EXPECT_EQ(problem(head + "image/jpeg\r\nContent-Length: 99999999999\r\n\r\n"), "camera.too-large");
  EXPECT_EQ(problem(head + "image/jpeg\r\nContent-Length: 5\r\n\r\nhello"), "camera.no-pictures");
  EXPECT_EQ(problem(multipart + "--cut\r\nContent-Length: 99999999\r\n\r\n"), "camera.too-large");
  EXPECT_EQ(problem(multipart + "--cut\r\nno field\r\n"), "camera.bad-response");
  EXPECT_EQ(problem(of_length(picture.size() - 500)), "camera.wrong-length");
  EXPECT_EQ(problem(of_length(picture.size() + 3)), "camera.wrong-length");
  EXPECT_EQ(problem(of_length(picture.size() + 8)), "camera.wrong-length");
  EXPECT_EQ(problem(multipart + "--cut\r\n\r\n" + std::string(9'000'000, 'x')), "camera.too-large");
  EXPECT_EQ(problem(multipart + "--cut\r\n\r\n" + picture, true), "camera.ended");
  EXPECT_EQ(problem(multipart.substr(0, 40), true), "camera.ended");
  const std::string chunks = head + "image/jpeg\r\nTransfer-Encoding: chunked\r\n\r\n";
  EXPECT_EQ(problem(chunks + "xyz\r\n"), "camera.bad-response");
  EXPECT_EQ(problem(chunks + "fffffffffffffffff\r\n"), "camera.bad-response");
  EXPECT_EQ(problem(chunks + std::string(1000, '1')), "camera.bad-response");
  EXPECT_EQ(problem(chunks + "0\r\n"), "camera.ended");
}

TEST(CameraResponse, gives_the_whole_picture_before_the_fault) {
  const std::string picture = fake_jpeg(1);
  const Outcome outcome = outcome_of(multipart + part(picture) + "--other\r\n", 50);
  EXPECT_EQ(outcome.pictures, Pictures{picture});
  EXPECT_EQ(outcome.problem, "camera.wrong-length");
}

}  // namespace
}  // namespace passo
