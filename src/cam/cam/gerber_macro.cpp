#include "gerber_macro.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "gerber_numbers.hpp"
#include "gerber_shapes.hpp"
#include <fmt/format.h>

#include "passo/base/counted.hpp"

namespace passo {
namespace {

constexpr int deepest_brackets = 32;
constexpr double degree = std::numbers::pi / 180;

using Variables = std::map<std::size_t, double>;

// An expression of a macro: + - x / ( ) and $1. Operators of one rank go from left to right.
class MacroExpression {
 public:
  MacroExpression(std::string_view text, std::size_t at, const Variables& variables)
      : text_(text), at_(at), variables_(variables) {}

  // Empty: at() is where it is wrong.
  std::optional<double> value() { return sum(0); }
  std::size_t at() const { return at_; }

 private:
  char next() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  std::optional<double> sum(int depth) {
    std::optional<double> left = product(depth);
    while (left && (next() == '+' || next() == '-')) {
      const bool adds = text_[at_++] == '+';
      const std::optional<double> right = product(depth);
      if (!right) return right;
      *left += adds ? *right : -*right;
    }
    return left;
  }

  std::optional<double> product(int depth) {
    std::optional<double> left = factor(depth);
    while (left && (next() == 'x' || next() == 'X' || next() == '/')) {
      const bool divides = text_[at_++] == '/';
      const std::optional<double> right = factor(depth);
      if (!right) return right;
      *left = divides ? *left / *right : *left * *right;
    }
    return left;
  }

  std::optional<double> factor(int depth) {
    if (depth > deepest_brackets) return std::nullopt;
    const char c = next();
    if (c == '+' || c == '-') {
      ++at_;
      const std::optional<double> value = factor(depth + 1);
      return value && c == '-' ? -*value : value;
    }
    if (c == '(') {
      ++at_;
      const std::optional<double> value = sum(depth + 1);
      if (!value || next() != ')') return std::nullopt;
      ++at_;
      return value;
    }
    const std::size_t begin = at_ + (c == '$' ? 1 : 0);
    const std::size_t end = std::min(text_.find_first_not_of(".0123456789", begin), text_.size());
    const std::optional<double> number = read_gerber_decimal(text_.substr(std::min(begin, text_.size()), end - begin));
    if (!number) return std::nullopt;
    at_ = end;
    if (c != '$') return number;
    const auto found = variables_.find(static_cast<std::size_t>(std::min(*number, 1e9)));
    return found == variables_.end() ? 0 : found->second;
  }

  std::string_view text_;
  std::size_t at_;
  const Variables& variables_;
};

// The primitives of one macro, one after the other.
class MacroComposer {
 public:
  MacroComposer(const GerberMacroLimits& limits, std::vector<GerberMacroFault>& faults)
      : limits_(limits), faults_(faults) {}

  bool obey(const GerberMacro::Statement& statement, Variables& variables);
  Region take() {
    flush();
    return std::move(shape_);
  }

 private:
  bool assign(Variables& variables);
  bool read_arguments(const Variables& variables);
  bool add_primitive();
  bool add_outline();
  bool add_polygon();
  bool add_moire();
  bool add_thermal();
  bool refuse(std::size_t at, std::string message, std::string expected);
  bool has_arguments(std::size_t least);

  double number(std::size_t index) const { return index < numbers_.size() ? numbers_[index] : 0; }
  double nm(std::size_t index) const { return number(index) * limits_.nm_per_unit; }
  double angle(std::size_t index) const { return number(index) * degree; }
  bool has_room_for_disc(double diameter) {
    return diameter >= 0 && limits_.has_room_for(4 * chords_of_arc(diameter / 2, std::numbers::pi / 2));
  }

  // Turns the ring about zero and adds it, or takes it away.
  void add(DrawnRing ring, double radians);
  void flush();

  const GerberMacroLimits& limits_;
  std::vector<GerberMacroFault>& faults_;
  const GerberMacro::Statement* statement_ = nullptr;
  std::vector<double> numbers_;  // behind the primitive's code
  int code_ = 0;
  bool is_on_ = true;             // exposure of this primitive
  bool rings_are_on_ = true;      // of those that wait
  std::vector<DrawnRing> rings_;  // wait to become part of the shape
  Region shape_;
};

bool MacroComposer::refuse(std::size_t at, std::string message, std::string expected) {
  faults_.push_back({statement_, at, std::move(message), std::move(expected)});
  return false;
}

void MacroComposer::flush() {
  if (rings_.empty()) return;
  std::vector<DrawnRing> all = rings_;
  all.insert(all.end(), shape_.rings.begin(), shape_.rings.end());
  if (!limits_.can_unite(all)) {
    rings_.clear();
    return;
  }
  const Region added = filled(std::move(rings_));
  rings_.clear();
  if (rings_are_on_) shape_ = shape_.empty() ? added : united(shape_, added);
  if (!rings_are_on_ && !shape_.empty()) shape_ = subtracted(shape_, added);
}

void MacroComposer::add(DrawnRing ring, double radians) {
  if (is_on_ != rings_are_on_) flush();
  rings_are_on_ = is_on_;
  rings_.push_back(turned(std::move(ring), radians));
}

bool MacroComposer::obey(const GerberMacro::Statement& statement, Variables& variables) {
  statement_ = &statement;
  const std::string_view words = statement.words;
  if (!limits_.has_room_for(1)) return false;
  const std::size_t first = words.find_first_not_of(' ');
  if (first == std::string_view::npos) return true;
  if (words[first] == '$') return assign(variables);
  if (words[first] == '0' && words.find_first_not_of("0123456789", first) == first + 1 && words[first + 1] != ',') {
    return true;  // a comment
  }
  if (words == "0") return true;
  return read_arguments(variables) && add_primitive();
}

bool MacroComposer::assign(Variables& variables) {
  const std::string_view words = statement_->words;
  const std::size_t equals = words.find('=');
  const std::size_t dollar = words.find('$');
  const std::optional<double> index = equals == std::string_view::npos
                                          ? std::nullopt
                                          : read_gerber_decimal(words.substr(dollar + 1, equals - dollar - 1));
  if (!index || !(*index >= 1 && *index <= 1e6)) return refuse(dollar, "this is not a variable", "$4=$1x0.75");
  MacroExpression expression(words, equals + 1, variables);
  const std::optional<double> value = expression.value();
  if (!value || expression.at() != words.size()) {
    return refuse(expression.at(), "this is not an expression", "numbers, $1, + - x / and brackets");
  }
  variables[static_cast<std::size_t>(*index)] = *value;
  return true;
}

bool MacroComposer::read_arguments(const Variables& variables) {
  const std::string_view words = statement_->words;
  numbers_.clear();
  for (std::size_t at = 0; at <= words.size();) {
    MacroExpression expression(words, at, variables);
    const std::optional<double> value = expression.value();
    at = expression.at();
    if (at == words.size() && !value && !numbers_.empty() && words.back() == ',') break;  // a comma too many
    if (!value || (at < words.size() && words[at] != ',')) {
      return refuse(at, "this is not an expression", "numbers, $1, + - x / and brackets, separated by commas");
    }
    if (!std::isfinite(*value) || std::abs(*value) > 1e9) {
      return refuse(at, fmt::format("the value {:g} cannot be drawn", *value), "a smaller number");
    }
    numbers_.push_back(*value);
    ++at;
  }
  code_ = static_cast<int>(std::clamp(numbers_.front(), -1.0, 1000.0));
  numbers_.erase(numbers_.begin());
  return true;
}

bool MacroComposer::has_arguments(std::size_t least) {
  if (numbers_.size() >= least) return true;
  return refuse(0, fmt::format("primitive {} has {}", code_, counted(numbers_.size(), "value")),
                fmt::format("{} or more", least));
}

bool MacroComposer::add_primitive() {
  is_on_ = true;
  if (code_ != 6 && code_ != 7) {
    // 2 is old and turns the exposure over.
    is_on_ = number(0) == 2 ? !rings_are_on_ : number(0) != 0;
  }
  switch (code_) {
    case 1:
      if (!has_arguments(4)) return false;
      if (!has_room_for_disc(nm(1))) return refuse(0, "the disc cannot be drawn", "a diameter of 0 or more");
      add(disc_ring({nm(2), nm(3)}, nm(1)), angle(4));
      return true;
    case 2:
    case 20:
      if (!has_arguments(6)) return false;
      add(bar_ring({nm(2), nm(3)}, {nm(4), nm(5)}, std::abs(nm(1))), angle(6));
      return true;
    case 21:
      if (!has_arguments(5)) return false;
      add(rectangle_ring({nm(3), nm(4)}, nm(1), nm(2)), angle(5));
      return true;
    case 22:
      if (!has_arguments(5)) return false;
      add(rectangle_ring({nm(3) + nm(1) / 2, nm(4) + nm(2) / 2}, nm(1), nm(2)), angle(5));
      return true;
    case 4: return add_outline();
    case 5: return add_polygon();
    case 6: return add_moire();
    case 7: return add_thermal();
    default: return refuse(0, fmt::format("there is no primitive {}", code_), "1, 4, 5, 6, 7, 20, 21 or 22");
  }
}

bool MacroComposer::add_outline() {
  if (!has_arguments(2)) return false;
  const double corners = number(1);
  if (!(corners >= 1) || corners * 2 + 4 > static_cast<double>(numbers_.size())) {
    return refuse(
        0,
        fmt::format("the outline of {:g} corner{} has {}", corners, plural_end(corners == 1),
                    counted(numbers_.size(), "value")),
        "exposure, the number of corners, X and Y of each corner and again of the first, and optionally an angle");
  }
  const auto count = static_cast<std::size_t>(corners);
  if (!limits_.has_room_for(count)) return false;
  DrawnRing ring;  // some files do not repeat the first corner, and mean the last as one more
  for (std::size_t i = 0; i <= count; ++i) ring.push_back(rounded({nm(2 + 2 * i), nm(3 + 2 * i)}));
  add(std::move(ring), angle(4 + 2 * count));
  return true;
}

bool MacroComposer::add_polygon() {
  if (!has_arguments(5)) return false;
  const double corners = number(1);
  if (!(corners >= 3 && corners <= 1000)) {
    return refuse(0, fmt::format("a polygon of {:g} corners", corners), "3 to 12 corners");
  }
  const auto count = static_cast<std::size_t>(corners);
  if (!limits_.has_room_for(count)) return false;
  add(regular_ring({nm(2), nm(3)}, std::abs(nm(4)), count, 0), angle(5));
  return true;
}

// 6: rings about a centre, from the outermost inwards, and a cross.
bool MacroComposer::add_moire() {
  if (!has_arguments(8)) return false;
  const Offset centre{nm(0), nm(1)};
  const double step = nm(3) + nm(4);
  double diameter = nm(2);
  flush();
  std::vector<Region> parts;
  for (double i = 0; i < number(5) && diameter > 0; ++i, diameter -= 2 * step) {
    if (!has_room_for_disc(diameter) || !has_room_for_disc(diameter)) return false;
    const double inner = diameter - 2 * nm(3);
    const Region disc{{disc_ring(centre, diameter)}};
    parts.push_back(inner > 0 ? subtracted(disc, {{disc_ring(centre, inner)}}) : disc);
    if (!(step > 0)) break;
  }
  for (Region& part : parts) {
    for (DrawnRing& ring : part.rings) ring = turned(std::move(ring), angle(8));
  }
  parts.push_back(std::move(shape_));
  shape_ = united(parts);
  add(rectangle_ring(centre, nm(7), nm(6)), angle(8));
  add(rectangle_ring(centre, nm(6), nm(7)), angle(8));
  return true;
}

// 7: a ring with four gaps.
bool MacroComposer::add_thermal() {
  if (!has_arguments(5)) return false;
  const Offset centre{nm(0), nm(1)};
  const double outer = nm(2);
  const double gap = nm(4);
  if (!has_room_for_disc(outer) || !has_room_for_disc(outer)) return refuse(0, "the ring cannot be drawn", "diameters");
  std::vector<DrawnRing> gaps = {rectangle_ring(centre, 2 * outer, gap), rectangle_ring(centre, gap, 2 * outer)};
  if (nm(3) > 0) gaps.push_back(disc_ring(centre, nm(3)));
  if (!(gap > 0)) gaps.erase(gaps.begin(), gaps.begin() + 2);
  Region ring = subtracted({{disc_ring(centre, outer)}}, filled(std::move(gaps)));
  for (DrawnRing& side : ring.rings) side = turned(std::move(side), angle(5));
  flush();
  shape_ = united(shape_, ring);
  return true;
}

}  // namespace

Region shape_of(const GerberMacro& macro, const std::vector<double>& arguments, const GerberMacroLimits& limits,
                std::vector<GerberMacroFault>& faults) {
  Variables variables;
  for (std::size_t i = 0; i < arguments.size(); ++i) variables[i + 1] = arguments[i];
  MacroComposer composer(limits, faults);
  for (const GerberMacro::Statement& statement : macro.statements) {
    if (!composer.obey(statement, variables)) break;
  }
  return composer.take();
}

}  // namespace passo
