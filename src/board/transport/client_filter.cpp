#include "passo/transport/client_filter.hpp"

#include <utility>

namespace passo {
namespace {

constexpr std::size_t shortest_word = 3;  // GET, PUT, PRI
constexpr std::size_t longest_word = 32;

bool is_letter(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

// Real-time commands of grbl, and what may stand before a line.
bool means_nothing_to_others(char c) {
  const auto byte = static_cast<unsigned char>(c);
  constexpr unsigned char reset = 0x18;
  constexpr unsigned char first_high = 0x80;
  return byte >= first_high || byte == reset || std::string_view("?!~ \t\r\n").find(c) != std::string_view::npos;
}

// TLS begins with 0x16, others with 0 to 4.
bool is_control(char c) {
  constexpr unsigned char del = 0x7F;
  const auto byte = static_cast<unsigned char>(c);
  return byte < ' ' || byte == del;
}

}  // namespace

std::string ClientFilter::pass(std::string_view bytes) {
  passed_.clear();
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (caller_ == Caller::sender) {
      passed_ += bytes.substr(i);
      break;
    }
    if (caller_ == Caller::stranger) break;
    judge(bytes[i]);
  }
  return std::exchange(passed_, {});
}

void ClientFilter::judge(char c) {
  if (held_.empty() && !is_letter(c)) return judge_start(c);
  const bool goes_on = is_letter(c) || c == '-';  // M-SEARCH
  if (goes_on && held_.size() < longest_word) {
    held_ += c;
    return;
  }
  const bool is_request = c == ' ' && held_.size() >= shortest_word;
  if (is_request || held_ == "SSH-") {
    reset();
    caller_ = Caller::stranger;
    return;
  }
  caller_ = Caller::sender;
  passed_ += std::exchange(held_, {});
  passed_ += c;
}

void ClientFilter::judge_start(char c) {
  if (means_nothing_to_others(c)) {
    passed_ += c;
  } else if (is_control(c)) {
    if (noise_ == Noise::none) caller_ = Caller::stranger;
  } else {
    caller_ = Caller::sender;
    passed_ += c;
  }
}

void ClientFilter::begin_anew() {
  if (held_.empty()) caller_ = Caller::unknown;
}

void ClientFilter::reset() {
  held_.clear();
  caller_ = Caller::unknown;
}

}  // namespace passo
