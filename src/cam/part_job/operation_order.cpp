#include "passo/part_job/operation_order.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

namespace passo {
namespace {

class OrderSearch {
 public:
  explicit OrderSearch(const PartJob& job) : job_(job), operations_(job.operations) {}

  std::vector<OrderedOperation> find();

 private:
  // The reason why `first` must come before `then`; empty: there is none.
  std::string must_precede(std::size_t first, std::size_t then) const;
  bool is_ready(std::size_t index) const;
  std::size_t best_of_ready() const;
  void give_reasons(std::vector<OrderedOperation>& order) const;
  bool share_layers(const PartOperation& a, const PartOperation& b) const;
  double width_of(const PartOperation& operation) const {
    return job_.tools.at(operation.tool).shape.cutter.radius.value();
  }

  const PartJob& job_;
  const std::vector<PartOperation>& operations_;
  std::vector<bool> done_;
  std::optional<std::int32_t> tool_;
};

// A profile after which the part or its scrap is loose.
bool is_inside(const PartOperation& operation) {
  const auto* profile = std::get_if<CamProfileArguments>(&operation.arguments);
  return profile != nullptr && profile->side == "inside";
}
bool frees_the_part(const PartOperation& operation) {
  const auto* profile = std::get_if<CamProfileArguments>(&operation.arguments);
  return profile != nullptr && operation.kind == PartKind::profile &&
         (profile->side == "part" || profile->side == "outside");
}
std::int32_t begins_with(const PartOperation& operation) {
  return operation.first_tool > 0 ? operation.first_tool : operation.tool;
}
bool is_finish(PartKind kind) {
  return kind == PartKind::chamfer || kind == PartKind::engrave || kind == PartKind::thread_mill;
}

bool OrderSearch::share_layers(const PartOperation& a, const PartOperation& b) const {
  if (a.files != b.files || a.files.empty()) return false;
  const auto may_meet = [](const std::vector<std::string>& some, const std::vector<std::string>& others) {
    return some.empty() || others.empty() || std::ranges::any_of(some, [&](const std::string& one) {
             return std::ranges::find(others, one) != others.end();
           });
  };
  return may_meet(a.layers, b.layers) && may_meet(a.colors, b.colors) && may_meet(a.names, b.names);
}

std::string OrderSearch::must_precede(std::size_t first, std::size_t then) const {
  const PartOperation& a = operations_[first];
  const PartOperation& b = operations_[then];
  if (a.kind == PartKind::face && b.kind != PartKind::face) return "facing comes first";
  if (b.kind == PartKind::face) return "";
  if (frees_the_part(b) && !frees_the_part(a)) {
    return is_inside(a) ? "inside contours are cut before the profile around them"
                        : "it frees the part, so it comes last";
  }
  if (frees_the_part(a)) return "";
  if (is_finish(b.kind) && !is_finish(a.kind) && (a.kind == PartKind::relief || share_layers(a, b))) {
    return fmt::format("it follows '{}', which cuts the same area", a.title);
  }
  if (a.kind == b.kind && a.kind == PartKind::pocket && share_layers(a, b) && width_of(a) > width_of(b)) {
    return "a wider cutter clears first";
  }
  if (a.kind == PartKind::relief && is_inside(b)) return "inside contours are cut after the relief above them";
  return "";
}

bool OrderSearch::is_ready(std::size_t index) const {
  for (std::size_t other = 0; other < operations_.size(); ++other) {
    if (!done_[other] && other != index && !must_precede(other, index).empty()) return false;
  }
  return !done_[index];
}

// The first one with the tool in the spindle; otherwise the first one whose tool is needed once only; otherwise the
// first one.
std::size_t OrderSearch::best_of_ready() const {
  std::optional<std::size_t> first;
  std::optional<std::size_t> first_at_once;
  for (std::size_t i = 0; i < operations_.size(); ++i) {
    if (!is_ready(i)) continue;
    const std::int32_t tool = begins_with(operations_[i]);
    if (tool_ == tool) return i;
    if (!first) first = i;
    bool is_at_once = true;
    for (std::size_t k = 0; k < operations_.size(); ++k) {
      if (!done_[k] && begins_with(operations_[k]) == tool && !is_ready(k)) is_at_once = false;
    }
    if (is_at_once && !first_at_once) first_at_once = i;
  }
  return first_at_once ? *first_at_once : *first;
}

// An operation gets a reason if a later one of the file must come before it, or if it was moved before an earlier one
// without need. An operation that only moves up because another one must wait gets none.
void OrderSearch::give_reasons(std::vector<OrderedOperation>& order) const {
  for (std::size_t at = 0; at < order.size(); ++at) {
    OrderedOperation& one = order[at];
    for (std::size_t earlier = 0; earlier < at && one.reason.empty(); ++earlier) {
      if (order[earlier].index > one.index) one.reason = must_precede(order[earlier].index, one.index);
    }
    for (std::size_t later = at + 1; later < order.size() && one.reason.empty(); ++later) {
      const bool is_passed = order[later].index < one.index && must_precede(one.index, order[later].index).empty();
      if (is_passed) one.reason = "fewer tool changes";
    }
  }
}

std::vector<OrderedOperation> OrderSearch::find() {
  std::vector<OrderedOperation> order;
  done_.assign(operations_.size(), false);
  while (order.size() < operations_.size()) {
    const std::size_t next = best_of_ready();
    done_[next] = true;
    tool_ = operations_[next].tool;
    order.push_back({next, ""});
  }
  give_reasons(order);
  return order;
}

}  // namespace

std::vector<OrderedOperation> order_operations(const PartJob& job) {
  if (!job.keeps_order) return OrderSearch(job).find();
  std::vector<OrderedOperation> order;
  for (std::size_t i = 0; i < job.operations.size(); ++i) order.push_back({i, ""});
  return order;
}

std::size_t tool_changes(const PartJob& job, const std::vector<OrderedOperation>& order) {
  std::size_t changes = 0;
  std::int32_t tool = 0;
  for (const OrderedOperation& ordered : order) {
    const PartOperation& operation = job.operations[ordered.index];
    for (const std::int32_t next : {begins_with(operation), operation.tool}) {
      if (tool != 0 && next != tool) ++changes;
      tool = next;
    }
  }
  return changes;
}

}  // namespace passo
