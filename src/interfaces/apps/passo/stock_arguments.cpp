#include "stock_arguments.hpp"

#include <charconv>
#include <vector>

#include <fmt/format.h>

#include "passo/operations/length_text.hpp"

namespace passo {
namespace {

constexpr const char* block_words = "ranges of axes in mm, e.g. X0:100,Y0:80,Z-10:0";

std::vector<std::string_view> parts_between(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = std::min(text.find(separator), text.size());
    parts.push_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

// An end that is left out is not wished.
bool read_end(std::string_view text, std::optional<double>& end) {
  if (text.empty()) return true;
  const Result<Mm, std::string> length = parse_length("", text, 1);
  if (!length) return false;
  end = length->value();
  return true;
}

}  // namespace

Result<WishedBlock, std::string> parse_block(const char* option, std::string_view text) {
  const Failure<std::string> refusal{fmt::format("{}: expected {}, found '{}'", option, block_words, text)};
  WishedBlock block;
  for (std::string_view word : parts_between(text, ',')) {
    if (word.empty()) return refusal;
    const char letter = word.front();
    WishedRange* const range = letter == 'X' || letter == 'x'   ? &block.x
                               : letter == 'Y' || letter == 'y' ? &block.y
                               : letter == 'Z' || letter == 'z' ? &block.z
                                                                : nullptr;
    const std::size_t colon = word.find(':');
    if (range == nullptr || colon == std::string_view::npos) return refusal;
    if (!read_end(word.substr(1, colon - 1), range->low) || !read_end(word.substr(colon + 1), range->high))
      return refusal;
    if (range->low && range->high && !(*range->low < *range->high)) return refusal;
  }
  return block;
}

Result<StockBlock, std::string> parse_clamp(std::string_view text) {
  const std::string refusal =
      fmt::format("--clamp: expected position and height, e.g. X0:10,Y0:20,Z15, found '{}'", text);
  std::string ranges;
  for (const std::string_view word : parts_between(text, ',')) {
    const bool is_top = word.find(':') == std::string_view::npos && word.size() > 1;
    if (!ranges.empty()) ranges += ',';
    // A top alone: the clamp goes down from there.
    ranges += is_top ? fmt::format("{}:{}", word.front(), word.substr(1)) : std::string(word);
  }
  const Result<WishedBlock, std::string> block = parse_block("--clamp", ranges);
  if (!block) return Failure{refusal};
  const bool is_whole = block->x.low && block->x.high && block->y.low && block->y.high && block->z.high;
  if (!is_whole) return Failure{refusal};
  constexpr double depth = 900;  // mm
  const double low = block->z.low.value_or(*block->z.high - depth);
  return StockBlock{{*block->x.low, *block->y.low, low}, {*block->x.high, *block->y.high, *block->z.high}};
}

Result<WishedTool, std::string> parse_tool(std::string_view text) {
  WishedTool tool;
  std::string_view words = text;
  if (const std::size_t equals = text.find('='); equals != std::string_view::npos) {
    std::int32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + equals, number);
    if (error != std::errc() || end != text.data() + equals || number < 0) {
      return Failure{fmt::format("--tool '{}': expected a tool number before the '=', e.g. 2=ball:3", text)};
    }
    tool.number = number;
    words = text.substr(equals + 1);
  }
  const Result<Cutter, std::string> cutter = parse_cutter(words);
  if (!cutter) return Failure{"--tool " + cutter.error()};
  tool.shape.cutter = *cutter;
  return tool;
}

}  // namespace passo
