// MotionOwner: who may move the machine. Any number of clients watch; one at a time moves.
//
// The owner is a sender of G-code (a Grbl client), a client of the API, or nobody. Ownership passes explicitly: a
// sender becomes the owner when it comes and nobody else is; a client of the API takes ownership, and gives it back. It
// never passes while the machine moves for an owner who is there. Everybody may hold and stop.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "passo/units/units.hpp"

namespace passo {

class MotionOwner {
 public:
  // A client that owns the motion, and was not heard for so long while nothing moved, owns it no longer.
  static constexpr Seconds silent_for{300};
  // One whose streams have all ended may come back so long.
  static constexpr Seconds returns_within{5};

  enum class Kind : std::uint8_t { nobody, sender, client };

  Kind kind() const { return kind_; }
  // Of a client, as it calls itself; for people.
  const std::string& name() const { return name_; }
  bool is_sender() const { return kind_ == Kind::sender; }
  bool is_client(std::string_view key) const { return kind_ == Kind::client && !key.empty() && key == key_; }

  // A sender is there and asks. False: a client owns the machine.
  bool claim_for_sender() {
    if (kind_ == Kind::nobody) set(Kind::sender, "sender", "");
    return is_sender();
  }
  // `key` proves later that a request is the owner's.
  void claim_for_client(std::string name, std::string key) { set(Kind::client, std::move(name), std::move(key)); }
  void release() { set(Kind::nobody, "", ""); }
  // Grows with each change of the owner.
  std::uint64_t changes() const { return changes_; }

 private:
  void set(Kind kind, std::string name, std::string key) {
    kind_ = kind;
    name_ = std::move(name);
    key_ = std::move(key);
    ++changes_;
  }

  Kind kind_ = Kind::nobody;
  std::string name_;
  std::string key_;
  std::uint64_t changes_ = 0;
};

}  // namespace passo
