// CameraResponse: finds the pictures in the response of an MJPEG camera, piece by piece as it arrives.
//
// Position in the pipeline: outside it, below CameraFeed. The response is HTTP/1.x (RFC 9112), whole or in chunks. Its
// body is one JPEG, or a stream of parts (multipart, RFC 2046 section 5.1.1) with one JPEG each. Real cameras differ
// from that: some write the dashes of the delimiter into the boundary, some begin without a delimiter (ESP32-CAM), and
// some parts have no length. All of these are accepted.
//
// Invariant: at most one picture and one piece are in memory, whatever the camera sends. Redirects are not followed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "passo/base/sentence.hpp"

namespace passo {

class CameraResponse {
 public:
  static constexpr std::size_t most_header = 8192;                    // bytes, also of the header of a part
  static constexpr std::size_t most_picture = std::size_t{8} << 20U;  // bytes

  // Processes received bytes. Returns false if nothing more can be read: a single picture is complete, or there is a
  // problem().
  bool read(std::string_view bytes);
  // The camera has closed the connection.
  void end();

  // Returns the newest complete picture that has not been taken. Empty: there is none.
  std::optional<std::string> take_picture();
  // Returns why reading has stopped. Empty: there was no problem.
  const Sentence& problem() const { return problem_; }

 private:
  enum class Step : std::uint8_t { header, single, before_part, part_header, part_data, after_part, done };

  void fail(const SentenceRow& row, SentenceArguments arguments = {});
  bool cut_line(std::string& from, std::string& line);
  bool read_header();
  bool read_status(std::string_view line);
  void read_field(std::string_view line);
  void choose_body();
  void read_chunks(std::string_view bytes);
  void fail_behind_body();
  void advance_all();
  bool advance();
  bool advance_single();
  bool advance_between();
  bool advance_part_header();
  bool advance_part_data();
  bool find_delimiter();
  bool is_delimiter(std::string_view line) const;
  void keep_picture(std::size_t length);

  Step step_ = Step::header;
  std::string head_;                     // the received part of the header
  std::string type_;                     // Content-Type of the response
  std::string boundary_;                 // without leading dashes
  std::string body_;                     // decoded, not processed yet
  std::size_t searched_ = 0;             // the beginning of body_ has no delimiter
  std::optional<std::uint64_t> length_;  // of the single picture or of the part
  bool has_status_ = false;
  bool is_chunked_ = false;
  std::string chunk_line_;        // the received part of a chunk's header
  std::uint64_t chunk_left_ = 0;  // bytes of the chunk that have not come yet
  std::optional<std::string> newest_;
  Sentence problem_;
};

}  // namespace passo
