#include "board_claim.hpp"

#include <cerrno>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "passo/base/fingerprint.hpp"

namespace passo {
namespace {

namespace fs = std::filesystem;

// A serial line may be named by a link and at any rate; it is one line all the same.
std::string usual_name(const BoardAddress& address) {
  if (address.kind == BoardAddress::Kind::tcp || address.kind == BoardAddress::Kind::websocket) {
    return "tcp:" + (address.place == "localhost" ? "127.0.0.1" : address.place) + ":" + address.port;
  }
  std::error_code none;
  const fs::path device = fs::weakly_canonical(address.place, none);
  return "serial:" + (none ? address.place : device.string());
}

// A name without a file: the kernel frees it with its socket (man 7 unix, abstract).
sockaddr_un address_of(const std::string& name, socklen_t& size) {
  Fingerprint fingerprint;
  fingerprint.add(name);
  const std::string text = fmt::format("passo-board-{:016x}", fingerprint.value());
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path + 1, text.data(), text.size());
  size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
  return address;
}

std::optional<pid_t> owner_of(const sockaddr_un& address, socklen_t size) {
  const int asking = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ucred owner{};
  socklen_t owner_size = sizeof owner;
  const bool found = connect(asking, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
                     getsockopt(asking, SOL_SOCKET, SO_PEERCRED, &owner, &owner_size) == 0;
  close(asking);
  return found ? std::optional(owner.pid) : std::nullopt;
}

}  // namespace

Result<BoardClaim, std::string> BoardClaim::acquire(const BoardAddress& address) {
  const std::string name = usual_name(address);
  socklen_t size = 0;
  const sockaddr_un unique = address_of(name, size);
  BoardClaim claim(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const auto* const plain = reinterpret_cast<const sockaddr*>(&unique);
  const bool is_taken = bind(claim.descriptor_, plain, size) != 0 && errno == EADDRINUSE;
  static_cast<void>(listen(claim.descriptor_, 1));  // so that another program can ask whose it is
  if (!is_taken) return claim;
  const auto owner = owner_of(unique, size);
  return Failure{fmt::format("{}: in use by another passo{}; only one program at a time can use a board [board.in-use]",
                             name, owner ? fmt::format(", process {}", *owner) : "")};
}

BoardClaim::~BoardClaim() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace passo
