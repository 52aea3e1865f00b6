// PendantFinder: finds the pendant that a user has named, also after it was unplugged and has come back.
//
//   auto             the first device that a built-in table describes
//   hidraw:DEVICE    this device
//   FILE.toml        the first device that this table describes
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "passo/base/result.hpp"
#include "passo/diagnostics/diagnostic.hpp"
#include "passo/pendant/hid_devices.hpp"
#include "passo/pendant/pendant_device.hpp"
#include "passo/pendant/pendant_table.hpp"

namespace passo {

// Returns the built-in table of a device; null if there is none.
const PendantTable* known_pendant(const HidDevice& device);

struct FoundPendant {
  HidDevice device;
  const PendantTable* table = nullptr;  // null: no table describes it
};
Result<std::unique_ptr<HidrawDevice>, std::string> open_pendant(const FoundPendant& pendant);

class PendantFinder {
 public:
  // `root`: as in list_hid_devices(). Nothing, with findings: the name or the table is wrong.
  static std::optional<PendantFinder> make(const std::string& wanted, const std::string& root,
                                           Diagnostics& diagnostics);

  // Empty: it is not connected.
  std::optional<FoundPendant> find() const;

 private:
  std::string root_;
  std::string device_;                         // empty: any
  std::shared_ptr<const PendantTable> table_;  // null: the built-in ones
};

}  // namespace passo
