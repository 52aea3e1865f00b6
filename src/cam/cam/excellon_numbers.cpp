#include "excellon_numbers.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "text_lines.hpp"
#include <fmt/format.h>

namespace passo {
namespace {

constexpr std::size_t most_digits_of_number = 15;  // more is beyond what a double holds exactly

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool all_digits(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, is_digit);
}

// "000.000" or "3:3": the digits before and after the mark.
bool read_format(std::string_view text, std::size_t& whole, std::size_t& decimals) {
  const std::size_t mark = text.find_first_of(".:");
  if (mark == std::string_view::npos) return false;
  const std::string_view before = text.substr(0, mark);
  const std::string_view after = text.substr(mark + 1);
  if (!all_digits(before) || !all_digits(after)) return false;
  const bool counted = text[mark] == ':';
  if (counted && (before.size() != 1 || after.size() != 1)) return false;
  whole = counted ? static_cast<std::size_t>(before[0] - '0') : before.size();
  decimals = counted ? static_cast<std::size_t>(after[0] - '0') : after.size();
  return whole >= 1 && whole <= 6 && decimals <= 7;
}

std::optional<double> plain_number(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const auto good = [](char c) { return is_digit(c) || c == '.'; };
  if (text.empty() || text.size() > most_digits_of_number + 1 || !std::ranges::all_of(text, good)) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return negative ? -value : value;
}

// How many millimetres the unit has that a comment names as a word. 0: it names none, or two.
double unit_in_words(std::string_view comment) {
  double found = 0;
  while (!comment.empty()) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto begin = std::ranges::find_if(comment, is_letter);
    const auto end = std::find_if_not(begin, comment.end(), is_letter);
    std::string word(begin, end);
    for (char& c : word) c = static_cast<char>(c >= 'a' ? c - 'a' + 'A' : c);
    comment.remove_prefix(static_cast<std::size_t>(end - comment.begin()));
    double unit = 0;
    if (word == "MIL" || word == "MILS") unit = 0.0254;
    if (word == "INCH" || word == "INCHES") unit = 25.4;
    if (word == "MM" || word == "MILLIMETERS" || word == "MILLIMETRES" || word == "METRIC") unit = 1;
    if (unit == 0) continue;
    if (found != 0 && found != unit) return 0;
    found = unit;
  }
  return found;
}

}  // namespace

ExcellonNumbers::ExcellonNumbers(std::string_view text, const ExcellonOptions& options, std::vector<std::string>& notes)
    : known_(options) {
  guess(scan_evidence(text), notes);
}

bool ExcellonNumbers::read_units(std::string_view line) {
  const std::size_t comma = std::min(line.find(','), line.size());
  const std::string_view unit = trimmed(line.substr(0, comma));
  const bool is_inch = unit == "INCH" || unit == "M72";
  if (!is_inch && unit != "METRIC" && unit != "M71") return false;
  use_inches(is_inch);
  while (comma < line.size()) {
    line.remove_prefix(std::min(line.find(','), line.size() - 1) + 1);
    const std::string_view part = trimmed(line.substr(0, line.find(',')));
    // LZ: leading zeros are kept, so the trailing ones are left out. TZ: the other way round.
    if (part == "LZ") zeros_ = LeftOutZeros::trailing;
    if (part == "TZ") zeros_ = LeftOutZeros::leading;
    std::size_t whole = 0;
    std::size_t decimals = 0;
    if (read_format(part, whole, decimals)) {
      whole_digits_ = whole;
      decimals_ = decimals;
    }
    if (line.find(',') == std::string_view::npos) break;
  }
  if (known_.zeros) zeros_ = *known_.zeros;
  return true;
}

void ExcellonNumbers::scan_coordinates(std::string_view line, Evidence& evidence) {
  for (std::size_t at = line.find_first_of("XY"); at != std::string_view::npos; at = line.find_first_of("XY", at)) {
    std::size_t begin = ++at;
    if (begin < line.size() && (line[begin] == '-' || line[begin] == '+')) ++begin;
    std::size_t end = begin;
    while (end < line.size() && is_digit(line[end])) ++end;
    at = end;
    if (end == begin || (end < line.size() && line[end] == '.')) continue;
    const std::string_view digits = line.substr(begin, end - begin);
    if (digits.find_first_not_of('0') == std::string_view::npos) continue;  // zero is zero
    evidence.has_digits = true;
    evidence.starts_with_0 = evidence.starts_with_0 || digits.front() == '0';
    evidence.ends_with_0 = evidence.ends_with_0 || digits.back() == '0';
    evidence.most_digits = std::max(evidence.most_digits, digits.size());
  }
}

std::optional<CommentedTool> ExcellonNumbers::commented_tool(std::string_view comment) const {
  const std::size_t word = comment.find("Holesize");
  const std::size_t sign = word == std::string_view::npos ? word : comment.find('=', word);
  if (sign == std::string_view::npos) return std::nullopt;
  // The number of the tool stands before the word as T01, in older files only behind it.
  std::string_view number = comment.substr(word + 8, sign - word - 8);
  if (const std::size_t t = comment.find('T'); t < word) number = comment.substr(t + 1, word - t - 1);
  number = trimmed(number);
  CommentedTool tool;
  if (std::from_chars(number.data(), number.data() + number.size(), tool.number).ec != std::errc()) return std::nullopt;
  std::string_view size = trimmed(comment.substr(sign + 1));
  size = size.substr(0, size.find(' '));
  const std::optional<double> value = plain_number(size);
  const double unit = unit_in_words(comment.substr(sign));
  if (!value || *value <= 0 || tool.number < 0) return std::nullopt;
  tool.diameter = Mm(*value * (unit != 0 ? unit : inch_ ? 25.4 : 1));
  return tool;
}

void ExcellonNumbers::read_comment(std::string_view comment, Evidence& evidence) {
  const double unit = unit_in_words(comment);
  evidence.comments_say_inch = evidence.comments_say_inch || unit > 1 || (unit > 0 && unit < 1);
  evidence.comments_say_mm = evidence.comments_say_mm || unit == 1;
  std::size_t at = comment.find("FORMAT=");
  if (at == std::string_view::npos) return;
  std::string_view format = comment.substr(at + 7);
  if (format.starts_with('{')) format.remove_prefix(1);
  std::size_t whole = 0;
  std::size_t decimals = 0;
  if (read_format(format.substr(0, 3), whole, decimals)) {
    whole_digits_ = whole;
    decimals_ = decimals;
  }
  const auto says = [&](std::string_view words) { return format.find(words) != std::string_view::npos; };
  if (says("suppress leading zeros") || says("keep zeros")) zeros_ = LeftOutZeros::leading;
  if (says("suppress trailing zeros")) zeros_ = LeftOutZeros::trailing;
  evidence.says_zeros = evidence.says_zeros || says("zeros");
}

ExcellonNumbers::Evidence ExcellonNumbers::scan_evidence(std::string_view text) {
  Evidence evidence;
  TextLines lines(text);
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line);
    if (line.starts_with(';')) {
      read_comment(line, evidence);
      continue;
    }
    if (line.starts_with("METRIC") || line.starts_with("INCH")) {
      evidence.says_unit = true;
      evidence.says_zeros = evidence.says_zeros || line.find("LZ") != line.npos || line.find("TZ") != line.npos;
      if (!read_units(line)) continue;
    } else if (line.starts_with("M71") || line.starts_with("M72")) {
      if (!evidence.says_unit) inch_ = line.starts_with("M72");
      evidence.says_unit = true;
      evidence.says_zeros = evidence.says_zeros || line.find("LZ") != line.npos || line.find("TZ") != line.npos;
      read_units(line);
    } else if (line.starts_with('T') && line.find('C') != std::string_view::npos) {
      const std::size_t c = line.find('C') + 1;
      std::size_t end = c;
      while (end < line.size() && (is_digit(line[end]) || line[end] == '.')) ++end;
      evidence.largest_tool = std::max(evidence.largest_tool, plain_number(line.substr(c, end - c)).value_or(0));
    } else {
      scan_coordinates(line, evidence);
    }
  }
  return evidence;
}

void ExcellonNumbers::guess(const Evidence& evidence, std::vector<std::string>& notes) {
  if (known_.inch) {
    inch_ = *known_.inch;
  } else if (!evidence.says_unit && evidence.comments_say_inch != evidence.comments_say_mm) {
    inch_ = evidence.comments_say_inch;
  } else if (!evidence.says_unit) {
    // No drill file has only drills below 0.3 mm, and none has drills of 0.3 inch alone.
    inch_ = evidence.largest_tool > 0 && evidence.largest_tool < 0.3;
    notes.push_back(fmt::format("the file does not give its unit; {} is assumed from its {}", inch_ ? "inch" : "mm",
                                evidence.largest_tool > 0 ? "drills" : "silence"));
  }
  if (known_.zeros) zeros_ = *known_.zeros;
  if (!evidence.has_digits || evidence.says_zeros || known_.zeros) return;
  const std::size_t all = whole_digits() + decimals();
  const char* reason = "it cannot be inferred from the numbers";
  if (evidence.starts_with_0 && !evidence.ends_with_0) {
    zeros_ = LeftOutZeros::trailing;
    reason = "numbers start with 0, and none ends with 0";
  } else if (evidence.ends_with_0 && !evidence.starts_with_0) {
    zeros_ = LeftOutZeros::leading;
    reason = "numbers end with 0, and none starts with 0";
  } else if (evidence.starts_with_0 && evidence.ends_with_0) {
    reason = "no zeros seem to be omitted";
    if (evidence.most_digits != all) zeros_ = LeftOutZeros::leading;
  }
  notes.push_back(fmt::format("the file does not say which zeros are omitted; '{} zeros' is assumed: {}",
                              zeros_ == LeftOutZeros::leading ? "leading" : "trailing", reason));
}

std::optional<Mm> ExcellonNumbers::coordinate(std::string_view text) const {
  if (text.find('.') != std::string_view::npos) return diameter(text);
  const std::string_view digits = text.substr(text.starts_with('-') || text.starts_with('+') ? 1 : 0);
  std::optional<double> value = plain_number(text);
  if (!value) return std::nullopt;
  std::size_t behind = decimals();
  if (zeros_ == LeftOutZeros::trailing) behind = digits.size() > whole_digits() ? digits.size() - whole_digits() : 0;
  double scaled = *value / std::pow(10.0, static_cast<double>(behind));
  if (zeros_ == LeftOutZeros::trailing && digits.size() < whole_digits()) {
    scaled *= std::pow(10.0, static_cast<double>(whole_digits() - digits.size()));
  }
  return Mm(inch_ ? scaled * mm_per_inch : scaled);
}

std::optional<Mm> ExcellonNumbers::diameter(std::string_view text) const {
  const std::optional<double> value = plain_number(text);
  if (!value) return std::nullopt;
  return Mm(inch_ ? *value * mm_per_inch : *value);
}

}  // namespace passo
