// order_operations: the order in which the operations of a job are machined.
//
// Facing is first, because it makes Z0. The profile around the part, which frees it, is last. Roughing comes before
// finishing: a pocket with a wider cutter before one with a narrower cutter on the same layer, and chamfers and
// engravings after the other cuts of their layers and after reliefs. Inside profiles come before outside profiles.
// Within these rules, the search looks for an order with few tool changes. Otherwise operations stay in the order of
// the file.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "passo/part_job/part_job.hpp"

namespace passo {

struct OrderedOperation {
  std::size_t index = 0;    // in the order of the file
  std::string reason = {};  // why it was moved; empty: it was not, or only because others were
};

std::vector<OrderedOperation> order_operations(const PartJob& job);

// The number of tool changes in this order, without the first tool.
std::size_t tool_changes(const PartJob& job, const std::vector<OrderedOperation>& order);

}  // namespace passo
