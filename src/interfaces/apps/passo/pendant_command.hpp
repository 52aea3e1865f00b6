// passo pendant: lists the HID devices that can be pendants, and shows what is done at one.
#pragma once

#include <cstdint>
#include <string>

namespace passo {

struct PendantListArguments {
  std::string system;  // a folder with system files, as for `board list`
  bool json = false;
};
int pendant_list(const PendantListArguments& arguments);

struct PendantWatchArguments {
  std::string pendant = "auto";
  std::string system;
  std::uint64_t count = 0;  // reports after which it ends; 0: until Ctrl-C
};
int pendant_watch(const PendantWatchArguments& arguments);

}  // namespace passo
