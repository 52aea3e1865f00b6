#include "passo/camera/camera_response.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "camera_sentences.hpp"

#include "passo/base/lower_case.hpp"

namespace passo {
namespace {

constexpr std::string_view jpeg_start = "\xFF\xD8\xFF";
constexpr std::string_view jpeg_end = "\xFF\xD9";
constexpr std::size_t most_chunk_line = 256;
constexpr std::size_t most_boundary = 200;
constexpr std::uint64_t most_chunk = std::uint64_t{1} << 31U;
constexpr std::string_view ok_status = "200";

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

// Some cameras pad a picture behind its end.
bool is_jpeg(std::string_view bytes) {
  return bytes.starts_with(jpeg_start) && bytes.rfind(jpeg_end) != std::string_view::npos;
}

struct HeaderField {
  std::string name;  // in lower case
  std::string_view value;
};

// Empty: the line is not a field.
std::optional<HeaderField> field_of(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == 0 || colon == std::string_view::npos) return {};
  const std::string_view name = line.substr(0, colon);
  if (!std::ranges::none_of(name, is_blank)) return {};
  return HeaderField{.name = lower_case(std::string(name)), .value = without_blanks(line.substr(colon + 1))};
}

std::optional<std::uint64_t> length_of(std::string_view digits) {
  std::uint64_t length = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), length);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  return is_number ? std::optional(length) : std::nullopt;
}

// The parameter boundary of a Content-Type, with or without quotes. Empty: there is none.
std::string boundary_of(std::string_view type) {
  constexpr std::string_view key = "boundary=";
  const std::size_t at = lower_case(std::string(type)).find(key);
  if (at == std::string::npos) return {};
  std::string_view value = type.substr(at + key.size());
  if (value.starts_with('"')) {
    value.remove_prefix(1);
    value = value.substr(0, value.find('"'));
  } else {
    value = without_blanks(value.substr(0, value.find(';')));
  }
  while (value.starts_with('-')) value.remove_prefix(1);
  return std::string(value.substr(0, most_boundary));
}

}  // namespace

bool CameraResponse::read(std::string_view bytes) {
  if (step_ == Step::header) {
    head_ += bytes;
    if (!read_header()) return step_ != Step::done;
    const std::string rest = std::exchange(head_, {});
    return read(rest);
  }
  if (is_chunked_) {
    read_chunks(bytes);
  } else {
    body_ += bytes;
  }
  advance_all();
  return step_ != Step::done;
}

void CameraResponse::end() {
  if (step_ == Step::done) return;
  if (step_ == Step::single && !length_ && is_jpeg(body_)) {
    keep_picture(body_.size());
    step_ = Step::done;
  } else {
    fail(camera_says::ended);
  }
}

std::optional<std::string> CameraResponse::take_picture() {
  return std::exchange(newest_, {});
}

void CameraResponse::fail(const SentenceRow& row, SentenceArguments arguments) {
  problem_ = row.with(std::move(arguments));
  step_ = Step::done;
  body_.clear();
}

// Returns false if there is no whole line yet. A line that is too long is an error.
bool CameraResponse::cut_line(std::string& from, std::string& line) {
  const std::size_t end = from.find('\n');
  if (std::min(end, from.size()) > most_header) fail(camera_says::bad_response);
  if (end == std::string::npos || step_ == Step::done) return false;
  line.assign(from, 0, end);
  from.erase(0, end + 1);
  if (line.ends_with('\r')) line.pop_back();
  return true;
}

// Returns true if the header is complete.
bool CameraResponse::read_header() {
  std::string line;
  while (step_ == Step::header && cut_line(head_, line)) {
    if (!std::exchange(has_status_, true)) {
      if (!read_status(line)) return false;
    } else if (line.empty()) {
      choose_body();
      return step_ != Step::done;
    } else {
      read_field(line);
    }
  }
  return false;
}

// "HTTP/1.1 200 OK"
bool CameraResponse::read_status(std::string_view line) {
  const std::size_t blank = line.find(' ');
  const std::string_view status =
      blank == std::string_view::npos ? std::string_view() : line.substr(blank + 1, ok_status.size());
  if (!line.starts_with("HTTP/1.") || status.size() != ok_status.size() || !length_of(status)) {
    fail(camera_says::bad_response);
  } else if (status != ok_status) {
    fail(camera_says::status, {{"status", std::string(status)}});
  }
  return step_ != Step::done;
}

void CameraResponse::read_field(std::string_view line) {
  const auto field = field_of(line);
  if (!field) return fail(camera_says::bad_response);
  if (field->name == "content-type") type_ = field->value;
  if (field->name == "transfer-encoding") is_chunked_ = lower_case(std::string(field->value)) == "chunked";
  if (field->name != "content-length") return;
  length_ = length_of(field->value);
  if (!length_) fail(camera_says::bad_response);
}

void CameraResponse::choose_body() {
  const std::string type = lower_case(type_);
  if (type.starts_with("multipart/")) {
    length_.reset();
    boundary_ = boundary_of(type_);
    step_ = Step::before_part;
    if (boundary_.empty()) fail(camera_says::bad_response);
  } else if (type.starts_with("image/jpeg") || type.starts_with("image/jpg")) {
    step_ = Step::single;
    if (is_chunked_) length_.reset();
  } else {
    fail(camera_says::no_pictures);
  }
}

// The size of each chunk stands in a line of its own, in hexadecimal digits; its data end with a line end.
void CameraResponse::read_chunks(std::string_view bytes) {
  while (!bytes.empty() && step_ != Step::done) {
    if (chunk_left_ > 0) {
      const std::size_t now = static_cast<std::size_t>(std::min<std::uint64_t>(chunk_left_, bytes.size()));
      body_ += bytes.substr(0, now);
      bytes.remove_prefix(now);
      chunk_left_ -= now;
      continue;
    }
    const char c = bytes.front();
    bytes.remove_prefix(1);
    if (c != '\n') {
      chunk_line_ += c;
      if (chunk_line_.size() > most_chunk_line) fail_behind_body();
      continue;
    }
    const std::string line = std::exchange(chunk_line_, {});
    const std::string_view digits = without_blanks(std::string_view(line).substr(0, line.find(';')));
    if (digits.empty()) continue;  // the line end of the previous chunk
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), chunk_left_, 16);
    if (error != std::errc() || end != digits.data() + digits.size() || chunk_left_ > most_chunk) {
      return fail_behind_body();
    }
    if (chunk_left_ > 0) continue;
    advance_all();
    return this->end();
  }
}

// What came before a wrong chunk counts.
void CameraResponse::fail_behind_body() {
  advance_all();
  if (step_ != Step::done) fail(camera_says::bad_response);
}

void CameraResponse::advance_all() {
  while (step_ != Step::done && advance()) {
  }
}

// Returns true if it has processed something, so that more may follow.
bool CameraResponse::advance() {
  switch (step_) {
    case Step::single: return advance_single();
    case Step::before_part:
    case Step::after_part: return advance_between();
    case Step::part_header: return advance_part_header();
    case Step::part_data: return advance_part_data();
    case Step::header:
    case Step::done: break;
  }
  return false;
}

bool CameraResponse::advance_single() {
  if (length_.value_or(0) > most_picture || body_.size() > most_picture) {
    fail(camera_says::too_large);
  } else if (length_ && body_.size() >= *length_) {
    keep_picture(static_cast<std::size_t>(*length_));
    step_ = Step::done;
  }
  return false;
}

// Text before the first delimiter is skipped. Nothing but a delimiter follows a picture.
bool CameraResponse::advance_between() {
  std::string line;
  if (!cut_line(body_, line)) return false;
  if (is_delimiter(line)) {
    length_.reset();
    step_ = Step::part_header;
  } else if (step_ == Step::after_part) {
    if (!line.empty()) fail(camera_says::wrong_length);
  } else if (const auto field = field_of(line); field && field->name.starts_with("content-")) {
    step_ = Step::part_header;
    body_.insert(0, line + "\n");
  }
  return true;
}

bool CameraResponse::advance_part_header() {
  std::string line;
  if (!cut_line(body_, line)) return false;
  if (line.empty()) {
    searched_ = 0;
    step_ = Step::part_data;
    if (length_.value_or(0) > most_picture) fail(camera_says::too_large);
    return true;
  }
  const auto field = field_of(line);
  if (!field) {
    fail(camera_says::bad_response);
  } else if (field->name == "content-length") {
    length_ = length_of(field->value);
    if (!length_) fail(camera_says::bad_response);
  }
  return true;
}

bool CameraResponse::advance_part_data() {
  if (!length_) return find_delimiter();
  if (body_.size() < *length_) return false;
  const auto length = static_cast<std::size_t>(*length_);
  if (std::string_view(body_).substr(0, length).find("--" + boundary_) != std::string_view::npos) {
    fail(camera_says::wrong_length);
    return false;
  }
  keep_picture(length);
  if (step_ != Step::done) step_ = Step::after_part;
  return true;
}

// A part without a length ends at the next delimiter.
bool CameraResponse::find_delimiter() {
  const std::string delimiter = "--" + boundary_;
  const std::size_t at = body_.find(delimiter, searched_);
  if (at == std::string::npos) {
    searched_ = body_.size() - std::min(body_.size(), delimiter.size());
    if (body_.size() > most_picture) fail(camera_says::too_large);
    return false;
  }
  std::size_t length = at;
  while (length > 0 && body_[length - 1] == '-') --length;
  if (length > 0 && body_[length - 1] == '\n') --length;
  if (length > 0 && body_[length - 1] == '\r') --length;
  keep_picture(length);
  if (step_ != Step::done) step_ = Step::after_part;
  return true;
}

bool CameraResponse::is_delimiter(std::string_view line) const {
  if (!line.starts_with("--")) return false;
  while (line.starts_with('-')) line.remove_prefix(1);
  line = without_blanks(line);
  return line == boundary_ || line == boundary_ + "--";
}

// Cuts the picture off the body.
void CameraResponse::keep_picture(std::size_t length) {
  const std::string_view bytes = std::string_view(body_).substr(0, length);
  if (is_jpeg(bytes)) {
    newest_ = std::string(bytes);
    body_.erase(0, length);
  } else {
    fail(bytes.starts_with(jpeg_start) ? camera_says::wrong_length : camera_says::no_pictures);
  }
}

}  // namespace passo
