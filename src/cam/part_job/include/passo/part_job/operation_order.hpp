// order_operations: the order in which the operations of a job are machined.
//
// What must be: facing first, because it makes Z0. Whatever frees the part (a profile around it) last. Of the rest,
// roughing before finishing: a pocket with a wider cutter before one with a narrower cutter on the same layer, and
// chamfers and engravings after the other cuts of their layers, and after reliefs. Profiles inside before those
// outside. Among all orders that keep to this, the one that is found has few changes of the tool; apart from that,
// operations stay as written.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "passo/part_job/part_job.hpp"

namespace passo {

struct OrderedOperation {
  std::size_t index = 0;    // in the order of the file
  std::string reason = {};  // why it is not where it was written; empty: nothing but others moved
};

std::vector<OrderedOperation> order_operations(const PartJob& job);

// The number of tool changes in this order, without the first tool.
std::size_t tool_changes(const PartJob& job, const std::vector<OrderedOperation>& order);

}  // namespace passo
