#include "passo/cam/thread_size.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "passo/base/trimmed.hpp"

namespace passo {
namespace {

struct CoarsePitch {
  double major_mm;
  double pitch_mm;
};

// ISO 261, coarse pitches of the first and second choice.
constexpr std::array<CoarsePitch, 37> metric_coarse = {
    {{1, 0.25},   {1.1, 0.25}, {1.2, 0.25}, {1.4, 0.3}, {1.6, 0.35}, {1.8, 0.35}, {2, 0.4},  {2.2, 0.45},
     {2.5, 0.45}, {3, 0.5},    {3.5, 0.6},  {4, 0.7},   {4.5, 0.75}, {5, 0.8},    {6, 1},    {7, 1},
     {8, 1.25},   {10, 1.5},   {12, 1.75},  {14, 2},    {16, 2},     {18, 2.5},   {20, 2.5}, {22, 2.5},
     {24, 3},     {27, 3},     {30, 3.5},   {33, 3.5},  {36, 4},     {39, 4},     {42, 4.5}, {45, 4.5},
     {48, 5},     {52, 5},     {56, 5.5},   {60, 5.5},  {64, 6}}};

struct CoarseThreads {
  std::string_view size;
  double per_inch;
};

// ASME B1.1, UNC.
constexpr std::array<CoarseThreads, 25> unified_coarse = {
    {{"#1", 64},   {"#2", 56},   {"#3", 48},   {"#4", 40},   {"#5", 40},  {"#6", 32},   {"#8", 32},
     {"#10", 24},  {"#12", 24},  {"1/4", 20},  {"5/16", 18}, {"3/8", 16}, {"7/16", 14}, {"1/2", 13},
     {"9/16", 12}, {"5/8", 11},  {"3/4", 10},  {"7/8", 9},   {"1", 8},    {"1 1/8", 7}, {"1 1/4", 7},
     {"1 3/8", 6}, {"1 1/2", 6}, {"1 3/4", 5}, {"2", 4.5}}};

constexpr double mm_of_inch = 25.4;
// The height of the sharp triangle is sqrt(3)/2 of the pitch; a nut's thread is 5/8 of it deep, a bolt's 17/24.
constexpr double nut_depths = 1.0825317547;
constexpr double bolt_depths = 1.2268693222;

std::optional<double> number_of(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  const bool is_read = error == std::errc() && end == text.data() + text.size() && std::isfinite(number) && number > 0;
  return is_read ? std::optional(number) : std::nullopt;
}

// "1/4", "1 1/8", "0.25", "#8": inches.
std::optional<double> inches_of(std::string_view text) {
  if (text.starts_with('#')) {
    const auto number = number_of(text.substr(1));
    return number ? std::optional(0.060 + 0.013 * *number) : std::nullopt;
  }
  double whole = 0;
  if (const std::size_t blank = text.find(' '); blank != std::string_view::npos) {
    const auto before = number_of(text.substr(0, blank));
    if (!before) return std::nullopt;
    whole = *before;
    text = trimmed(text.substr(blank));
  }
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos) {
    const auto number = number_of(text);
    return number && whole == 0 ? number : std::nullopt;
  }
  const auto above = number_of(text.substr(0, slash));
  const auto below = number_of(text.substr(slash + 1));
  return above && below ? std::optional(whole + *above / *below) : std::nullopt;
}

std::optional<ThreadSize> size_of(double major_mm, double pitch_mm, std::string name) {
  constexpr double largest = 1000;  // mm
  constexpr double finest = 0.05;
  if (!(major_mm > 0 && major_mm <= largest && pitch_mm >= finest && 2 * pitch_mm <= major_mm)) return std::nullopt;
  return ThreadSize{std::move(name), to_nanometres(Mm(major_mm)), pitch_mm * nanometres_per_mm};
}

std::optional<ThreadSize> metric_of(std::string_view text) {
  const std::size_t cross = text.find_first_of("xX");
  const auto major = number_of(trimmed(text.substr(0, cross)));
  if (!major) return std::nullopt;
  if (cross != std::string_view::npos) {
    const auto pitch = number_of(trimmed(text.substr(cross + 1)));
    return pitch ? size_of(*major, *pitch, fmt::format("M{:g}x{:g}", *major, *pitch)) : std::nullopt;
  }
  const auto* const found = std::ranges::find(metric_coarse, *major, &CoarsePitch::major_mm);
  if (found == metric_coarse.end()) return std::nullopt;
  return size_of(*major, found->pitch_mm, fmt::format("M{:g}x{:g}", *major, found->pitch_mm));
}

std::optional<ThreadSize> unified_of(std::string_view text) {
  const bool is_coarse = text.ends_with("UNC");
  if (is_coarse || text.ends_with("UNF")) text = trimmed(text.substr(0, text.size() - 3));
  const std::size_t dash = text.rfind('-');
  if (dash == std::string_view::npos) {
    const auto* const found = std::ranges::find(unified_coarse, text, &CoarseThreads::size);
    if (!is_coarse || found == unified_coarse.end()) return std::nullopt;
    return size_of(*inches_of(text) * mm_of_inch, mm_of_inch / found->per_inch,
                   fmt::format("{}-{:g}", text, found->per_inch));
  }
  const auto inches = inches_of(trimmed(text.substr(0, dash)));
  const auto per_inch = number_of(trimmed(text.substr(dash + 1)));
  if (!inches || !per_inch) return std::nullopt;
  return size_of(*inches * mm_of_inch, mm_of_inch / *per_inch,
                 fmt::format("{}-{:g}", trimmed(text.substr(0, dash)), *per_inch));
}

}  // namespace

Nanometres ThreadSize::minor() const {
  return {major.count - std::llround(nut_depths * pitch_nm)};
}

Nanometres ThreadSize::root() const {
  return {major.count - std::llround(bolt_depths * pitch_nm)};
}

std::optional<ThreadSize> thread_size_of(std::string_view name) {
  const std::string_view text = trimmed(name);
  if (text.size() > 40) return std::nullopt;
  return text.starts_with('M') ? metric_of(text.substr(1)) : unified_of(text);
}

std::optional<ThreadSize> thread_size_of(Nanometres major, Nanometres pitch) {
  const double major_mm = to_mm(major).value();
  const double pitch_mm = to_mm(pitch).value();
  return size_of(major_mm, pitch_mm, fmt::format("{:.6g} x {:.6g} mm", major_mm, pitch_mm));
}

}  // namespace passo
