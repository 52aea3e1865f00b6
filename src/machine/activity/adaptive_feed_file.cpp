#include "passo/activity/adaptive_feed_file.hpp"

#include <algorithm>

#include "passo/base/read_double.hpp"
#include "passo/base/trimmed.hpp"
#include "passo/diagnostics/file_bytes.hpp"

namespace passo {
namespace {

constexpr std::size_t largest_file = std::size_t{64} << 20U;
constexpr double longest_time = 1e6;  // s; a later time is a typing error
constexpr std::string_view blanks = " \t\r";

// A number that is the whole text, in a range.
std::optional<double> number_within(std::string_view text, double most) {
  double value = 0;
  const auto [end, error] = read_double(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value >= 0 && value <= most ? std::optional(value) : std::nullopt;
}

bool begins_with_a_letter(std::string_view line) {
  const char first = line.front();
  return (first >= 'a' && first <= 'z') || (first >= 'A' && first <= 'Z');
}

class AdaptiveFeedReader {
 public:
  AdaptiveFeedReader(const std::string& file, Diagnostics& diagnostics) : file_(file), diagnostics_(diagnostics) {}

  void read(std::string_view text) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty() && !diagnostics_.full()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      ++number_;
      read_line(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }
  std::vector<AdaptiveFeedChange> take() { return std::move(changes_); }

 private:
  void read_line(std::string_view whole) {
    const std::string_view line = trimmed(whole, blanks);
    if (line.empty() || line.front() == '#') return;
    const bool is_header = changes_.empty() && !has_header_ && begins_with_a_letter(line);
    if (is_header) {
      has_header_ = true;
      return;
    }
    const std::size_t comma = std::min(line.find(','), line.size());
    const auto at = number_within(trimmed(line.substr(0, comma), blanks), longest_time);
    const auto factor =
        comma < line.size() ? number_within(trimmed(line.substr(comma + 1), blanks), 1) : std::optional<double>();
    if (!at || !factor) {
      return refuse(whole, "adaptive-feed.bad-line", "this line is not a time and a factor",
                    "SECONDS,FACTOR with a factor from 0 to 1, e.g. 2.5,0.4");
    }
    if (!changes_.empty() && Seconds(*at) < changes_.back().at) {
      return refuse(whole, "adaptive-feed.bad-order", "this time is before that of the line above",
                    "times in ascending order");
    }
    changes_.push_back({.at = Seconds(*at), .factor = *factor});
  }
  void refuse(std::string_view line, const char* code, const char* message, const char* expected) {
    diagnostics_.add({.severity = Severity::error,
                      .code = code,
                      .file = file_,
                      .place = {.line = number_, .column = 1, .length = 1},
                      .message = std::string(message),
                      .expected = std::string(expected),
                      .text = std::string(line)});
  }

  const std::string& file_;
  Diagnostics& diagnostics_;
  std::uint32_t number_ = 0;
  bool has_header_ = false;
  std::vector<AdaptiveFeedChange> changes_;
};

}  // namespace

std::optional<std::vector<AdaptiveFeedChange>> parse_adaptive_feed(std::string_view text, const std::string& file,
                                                                   Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errors();
  AdaptiveFeedReader reader(file, diagnostics);
  reader.read(text);
  if (diagnostics.errors() > errors) return std::nullopt;
  return reader.take();
}

std::optional<std::vector<AdaptiveFeedChange>> read_adaptive_feed(const std::string& path, Diagnostics& diagnostics) {
  const auto text = read_bytes(
      path, {.area = "adaptive-feed", .expected = "a CSV file with SECONDS,FACTOR in each line", .most = largest_file},
      diagnostics);
  if (!text) return std::nullopt;
  return parse_adaptive_feed(*text, path, diagnostics);
}

}  // namespace passo
