#include "pendant_command.hpp"

#include <span>

#include "program_input.hpp"
#include "run_signals.hpp"
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <poll.h>

#include "passo/pendant/pendant_decoder.hpp"
#include "passo/pendant/pendant_finder.hpp"

namespace passo {
namespace {

constexpr int looks_every = 200;  // ms, for Ctrl-C

std::string ids_of(const HidDevice& device) {
  return fmt::format("{:04x}:{:04x}", device.vendor, device.product);
}

// The bytes, and what the table says about them.
void print_report(std::span<const std::uint8_t> report, PendantDecoder* decoder, const PendantTable* table) {
  std::string words;
  if (decoder != nullptr) {
    for (const PendantEvent& event : decoder->decode(report)) {
      words += (words.empty() ? "" : ", ") + describe(event, *table);
    }
  }
  fmt::print("{:02x}{}{}\n", fmt::join(report, " "), words.empty() ? "" : "   ", words);
}

int watch(PendantDevice& device, const PendantTable* table, std::uint64_t count) {
  std::optional<PendantDecoder> decoder;
  if (table != nullptr) decoder.emplace(*table);
  PendantDevice::Report report;
  for (std::uint64_t shown = 0; interrupted_by() == 0 && (count == 0 || shown < count);) {
    switch (device.read(report)) {
      case PendantDevice::Read::gone: return fail(exit_failed, "the pendant was unplugged");
      case PendantDevice::Read::report:
        print_report(report, decoder ? &*decoder : nullptr, table);
        ++shown;
        if (const int printed = flush_output(); printed != exit_done) return printed;
        break;
      case PendantDevice::Read::nothing:
        pollfd waits{.fd = device.descriptor(), .events = POLLIN, .revents = 0};
        static_cast<void>(::poll(&waits, 1, looks_every));
    }
  }
  return exit_done;
}

}  // namespace

int pendant_list(const PendantListArguments& arguments) {
  const auto devices = list_hid_devices(arguments.system);
  auto json = nlohmann::ordered_json::array();
  for (const HidDevice& device : devices) {
    const PendantTable* const table = known_pendant(device);
    json.push_back({{"device", device.device},
                    {"ids", ids_of(device)},
                    {"name", device.name},
                    {"pendant", table != nullptr ? nlohmann::ordered_json(table->name) : nlohmann::ordered_json()}});
    if (!arguments.json) {
      fmt::print("hidraw:{}  {}  {}{}\n", device.device, ids_of(device), device.name,
                 table != nullptr ? fmt::format("  (pendant: {})", table->name) : "");
    }
  }
  if (arguments.json) fmt::print("{}\n", json.dump(2));
  if (devices.empty()) note("this computer has no HID devices");
  return exit_done;
}

int pendant_watch(const PendantWatchArguments& arguments) {
  Diagnostics diagnostics;
  const auto finder = PendantFinder::make(arguments.pendant, arguments.system, diagnostics);
  show(diagnostics);
  if (!finder) return exit_bad_program;
  const auto found = finder->find();
  if (!found) {
    return fail(exit_failed, "no such pendant is connected; `passo pendant list` lists the devices [pendant.none]");
  }
  const auto device = open_pendant(*found);
  if (!device) return fail(exit_failed, device.error() + " [pendant.open]");
  catch_signals();
  note(found->table != nullptr ? fmt::format("{} at {}", found->table->name, found->device.device)
                               : fmt::format("{}: no table describes {}; only its bytes are shown",
                                             found->device.device, ids_of(found->device)));
  return watch(**device, found->table, arguments.count);
}

}  // namespace passo
