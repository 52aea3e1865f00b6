#include <algorithm>
#include <array>

#include "json_text.hpp"

#include "passo/lab/answers.hpp"
#include "passo/study/faulty_listing.hpp"
#include "passo/study/ideal_path.hpp"
#include "passo/study/measure.hpp"
#include "passo/study/pulse_details.hpp"

namespace passo {
namespace {

constexpr std::array<const char*, speed_rules> rule_names = {"beats", "roots", "exact"};
constexpr int most_chords = 96;  // of the ideal path's polyline

void add_figures(const Measures& found, JsonText& json) {
  json.number("pulses", static_cast<double>(found.pulses));
  json.number("together", static_cast<double>(found.together));
  json.number("idle", static_cast<double>(found.idle));
  json.number("largest", found.largest_deviation);
  json.number("mean", found.mean_deviation);
  JsonText lag;
  JsonText ratio;
  for (std::size_t rule = 0; rule < speed_rules; ++rule) {
    lag.number(rule_names[rule], found.evenness[rule].lag);
    ratio.number(rule_names[rule], found.evenness[rule].ratio);
  }
  json.raw("lag", lag.take());
  json.raw("ratio", ratio.take());
}

void add_method(const Method& method, JsonText& json) {
  json.words("name", method_names()[static_cast<std::size_t>(method.name)]);
  json.flag("half_loaded", method.half_loaded);
  json.words("title", title(method));
}

void add_ideal(const StepMove& move, JsonText& json) {
  const IdealPath path(move);
  const int chords = move.arc ? most_chords : 1;
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i <= chords; ++i) {
    const auto point = path.at(static_cast<double>(i) / chords);
    x.push_back(point[0]);
    y.push_back(point[1]);
  }
  JsonText ideal;
  ideal.list("x", x);
  ideal.list("y", y);
  json.raw("ideal", ideal.take());
}

// Pulse by pulse, as `passo interpolate --beats` writes it.
struct PulseColumns {
  std::vector<std::int64_t> steps = {};
  std::vector<std::int64_t> directions = {};
  std::vector<std::vector<std::int64_t>> places = {};  // a column for each axis
  std::vector<std::vector<double>> feet = {};          // the place of the ideal path nearest to the tool
  std::vector<double> deviation = {};
  std::array<std::vector<double>, speed_rules> clock = {};
  std::vector<std::vector<std::string>> judge = {};  // a column for each name
  std::vector<std::vector<std::int64_t>> decisions = {};
  std::vector<std::vector<std::string>> end = {};
};

template <class T>
void add_row(const std::vector<T>& row, std::vector<std::vector<T>>& columns) {
  columns.resize(row.size());
  for (std::size_t i = 0; i < row.size(); ++i) columns[i].push_back(row[i]);
}

PulseColumns columns_of(const Method& method, const StepMove& move, std::int64_t pulses, double way) {
  PulseColumns columns;
  const auto source = start(method, move);
  const PulseDetails beats(method, move, pulses);
  std::array<SpeedClock, speed_rules> clocks = {SpeedClock(SpeedRule::beats, pulses, way),
                                                SpeedClock(SpeedRule::roots, pulses, way),
                                                SpeedClock(SpeedRule::exact, pulses, way)};
  IdealPath path(move);
  Place place = move.from;
  std::vector<std::int64_t> values;
  (*source)->decisions(values);
  for (std::int64_t k = 1; !(*source)->done(); ++k) {
    add_row(beats.judge(k, place, values), columns.judge);
    const Pulse pulse = (*source)->next();
    apply(pulse, place);
    (*source)->decisions(values);
    add_row(values, columns.decisions);
    add_row(beats.end(k, place), columns.end);
    columns.steps.push_back(pulse.steps);
    columns.directions.push_back(pulse.directions);
    add_row(place, columns.places);
    const Followed now{
        .pulse = pulse, .place = place, .progress = path.progress(place), .deviation = path.distance(place)};
    columns.deviation.push_back(now.deviation);
    const auto foot = path.at(now.progress);
    add_row(std::vector<double>(foot.begin(), foot.begin() + static_cast<std::ptrdiff_t>(move.axes())), columns.feet);
    // A faulty listing may go beyond the end, where its time would be up.
    for (std::size_t rule = 0; rule < speed_rules; ++rule) {
      columns.clock[rule].push_back(std::min(clocks[rule].after(now), 1.0));
    }
  }
  return columns;
}

template <class T>
std::string named_columns(const std::vector<std::string>& names, const std::vector<std::vector<T>>& columns) {
  JsonText json;
  for (std::size_t i = 0; i < columns.size(); ++i) json.list(names[i], columns[i]);
  return json.take();
}

// Lists of equal kind, as one list.
template <class T>
std::string lists(const std::vector<std::vector<T>>& columns) {
  std::string text;
  for (const std::vector<T>& column : columns) {
    JsonText one;
    one.list("", column);
    const std::string json = one.take();  // {"":[…]}
    text += (text.empty() ? "" : ",") + json.substr(4, json.size() - 5);
  }
  return "[" + text + "]";
}

// What a faulty listing gets wrong: the numbers of its wrong pulses, the first wrong or missing one, and where it ends.
void add_fault(const Method& method, const StepMove& move, const PulseColumns& columns, JsonText& json) {
  const std::optional<Method> right = right_method_of(method);
  if (!right) return;
  ListingCheck check(method, move);
  std::vector<std::int64_t> wrong;
  for (std::size_t k = 0; k < columns.steps.size(); ++k) {
    const Pulse pulse{static_cast<std::uint8_t>(columns.steps[k]), static_cast<std::uint8_t>(columns.directions[k])};
    if (check.is_wrong(pulse)) wrong.push_back(static_cast<std::int64_t>(k) + 1);
  }
  check.end();
  JsonText fault;
  fault.words("right", title(*right));
  fault.number("first", static_cast<double>(check.first_wrong()));
  fault.list("wrong", wrong);
  fault.list("end", check.place());
  fault.flag("ends_right", check.place() == move.to);
  json.raw("fault", fault.take());
}

}  // namespace

std::string error_answer(const std::string& words) {
  JsonText json;
  json.words("error", words);
  return json.take();
}

std::string interpolation_answer(const Method& method, const StepMove& move) {
  if (const Status<std::string> good = check(move); !good) return error_answer("the move " + good.error());
  if (move.axes() < 2) return error_answer("the move has fewer than two axes");
  const auto source = start(method, move);
  if (!source) return error_answer(title(method) + " " + source.error());
  const std::vector<std::string> decision_names = (*source)->decision_names();
  std::int64_t pulses = 0;
  double way = 0;
  for (; !(*source)->done(); ++pulses) {
    if (pulses == most_entries) return error_answer(fmt::format("the move has more than {} pulses", most_entries));
    way += way_of((*source)->next());
  }
  const PulseColumns columns = columns_of(method, move, pulses, way);
  const PulseDetails beats(method, move, pulses);
  JsonText json;
  add_method(method, json);
  json.number("length", IdealPath(move).length());
  add_figures(*measure(method, move), json);
  add_ideal(move, json);
  json.list("steps", columns.steps);
  json.list("directions", columns.directions);
  json.list("x", columns.places.empty() ? std::vector<std::int64_t>() : columns.places[0]);
  json.list("y", columns.places.empty() ? std::vector<std::int64_t>() : columns.places[1]);
  json.list("foot_x", columns.feet.empty() ? std::vector<double>() : columns.feet[0]);
  json.list("foot_y", columns.feet.empty() ? std::vector<double>() : columns.feet[1]);
  json.raw("places", lists(columns.places));
  json.raw("feet", lists(columns.feet));
  json.list("deviation", columns.deviation);
  JsonText clock;
  for (std::size_t rule = 0; rule < speed_rules; ++rule) clock.list(rule_names[rule], columns.clock[rule]);
  json.raw("clock", clock.take());
  json.raw("judge", named_columns(beats.judge_names(), columns.judge));
  json.raw("decisions", named_columns(decision_names, columns.decisions));
  json.raw("end", named_columns(beats.end_names(), columns.end));
  add_fault(method, move, columns, json);
  return json.take();
}

std::string comparison_answer(const StepMove& move) {
  if (const Status<std::string> good = check(move); !good) return error_answer("the move " + good.error());
  // Bounded before it is measured: no method makes more than four pulses for each step of the path's length.
  if (IdealPath(move).length() > static_cast<double>(most_entries) / 4) return error_answer("the move is too long");
  std::string all;
  for (const Method& method : methods_for(move)) {
    JsonText one;
    add_method(method, one);
    add_figures(*measure(method, move), one);
    all += (all.empty() ? "" : ",") + one.take();
  }
  JsonText json;
  json.raw("methods", "[" + all + "]");
  return json.take();
}

}  // namespace passo
