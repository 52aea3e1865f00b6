// MachineControl: determines who is in control of the machine. Any number of clients may watch; only one may move the
// machine.
//
// In control is a G-code sender (a Grbl client), a client of the API, or nobody. Control passes explicitly: a
// connecting sender takes control if nobody has it; a client of the API requests control, and releases it. Control
// never passes while the machine moves for a connected owner. Everyone may hold and stop. A pendant takes control while
// it is used, and gives it back afterwards (docs/decisions/0206).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "passo/units/units.hpp"

namespace passo {

class MachineControl {
 public:
  // A client in control loses control after this time without a request while the machine was idle.
  static constexpr Seconds silent_for{300};
  // The time within which a client may reconnect after all its streams have ended.
  static constexpr Seconds returns_within{5};

  enum class Kind : std::uint8_t { nobody, sender, client };

  Kind kind() const { return kind_; }
  // The client's name, as given by itself, for display.
  const std::string& name() const { return name_; }
  bool is_sender() const { return kind_ == Kind::sender; }
  bool is_client(std::string_view key) const { return kind_ == Kind::client && !key.empty() && key == key_; }

  // Requests control for a connected sender. Returns false if a client is in control.
  bool claim_for_sender() {
    if (kind_ == Kind::nobody) set(Kind::sender, "sender", "");
    return is_sender();
  }
  // Gives control to a client. `key` later authenticates its requests.
  void claim_for_client(std::string name, std::string key) { set(Kind::client, std::move(name), std::move(key)); }
  void release() { set(Kind::nobody, "", ""); }
  // Gives control back to the one who had it before a pendant was used.
  void give_back_to(const MachineControl& before) {
    set(before.kind_, before.name_, before.key_);
    number_ = before.number_;
  }
  // Increases with each change of the owner.
  std::uint64_t changes() const { return changes_; }
  // The number of the present ownership. It is the same again after it was given back.
  std::uint64_t number() const { return number_; }

 private:
  void set(Kind kind, std::string name, std::string key) {
    kind_ = kind;
    name_ = std::move(name);
    key_ = std::move(key);
    number_ = ++changes_;
  }

  Kind kind_ = Kind::nobody;
  std::string name_;
  std::string key_;
  std::uint64_t changes_ = 0;
  std::uint64_t number_ = 0;
};

}  // namespace passo
