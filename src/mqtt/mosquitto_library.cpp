#include "mosquitto_library.hpp"

#include <optional>

#include <dlfcn.h>

namespace passo {
namespace {

std::optional<MosquittoLibrary> load_library() {
  void* const library = dlopen(PASSO_MOSQUITTO_NAME, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) return std::nullopt;
  MosquittoLibrary found;
  bool has_all = true;
  const auto find = [&]<class Function>(const char* name, Function& function) {
    function = reinterpret_cast<Function>(dlsym(library, name));
    has_all = has_all && function != nullptr;
  };
  find("mosquitto_lib_init", found.lib_init);
  find("mosquitto_lib_cleanup", found.lib_cleanup);
  find("mosquitto_new", found.create);
  find("mosquitto_destroy", found.destroy);
  find("mosquitto_threaded_set", found.threaded_set);
  find("mosquitto_will_set", found.will_set);
  find("mosquitto_username_pw_set", found.username_pw_set);
  find("mosquitto_connect_callback_set", found.connect_callback_set);
  find("mosquitto_connect_async", found.connect_async);
  find("mosquitto_loop", found.loop);
  find("mosquitto_publish", found.publish);
  find("mosquitto_disconnect", found.disconnect);
  find("mosquitto_strerror", found.strerror);
  if (!has_all) return std::nullopt;
  return found;
}

}  // namespace

const MosquittoLibrary* mosquitto_library() {
  static const std::optional<MosquittoLibrary> library = load_library();
  return library ? &*library : nullptr;
}

}  // namespace passo
