#include "passo/judge/link_delay_words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "passo/base/counted.hpp"
#include "passo/report/line_words.hpp"

namespace passo {
namespace {

std::string so_often(int count) {
  return count == 1 ? "once" : fmt::format("{} times", count);
}

}  // namespace

std::string to_text(const LinkDelay& cost) {
  std::string words = fmt::format("serial link     to a board with a queue of {}: ", counted(cost.held_items, "item"));
  if (!cost.trouble.empty()) return words + cost.trouble + "\n";
  if (cost.cost() < least_cost_of_line) {
    words += "costs no time";
  } else {
    words += fmt::format("{:.3f} s longer, {}", cost.cost().value(), percent_of(cost.cost(), cost.without));
  }
  if (cost.slowdowns > 0) words += fmt::format("; slower {} because the queue was full", so_often(cost.slowdowns));
  if (cost.rests > 0) words += fmt::format("; stopped {} because motion arrived too late", so_often(cost.rests));
  return words + "\n";
}

nlohmann::ordered_json as_json(const LinkDelay& cost) {
  nlohmann::ordered_json json = {{"held_items", cost.held_items},
                                 {"time_s", cost.over.value()},
                                 {"cost_s", cost.cost().value()},
                                 {"cost_share", cost.share()},
                                 {"slowdowns", cost.slowdowns},
                                 {"rests", cost.rests},
                                 {"trouble", nullptr}};
  if (!cost.trouble.empty()) json["trouble"] = cost.trouble;
  return json;
}

}  // namespace passo
